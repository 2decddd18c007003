//! Values set on the command line.

use std::fs;

use quadtank::literature::PresetId;
use serde_json::{Value, json};

use super::{folder, pipe, preset, stderr, stdout};

fn analysed(settings: &[&str]) -> std::process::Output {
    let options = settings.iter().flat_map(|setting| ["--set", setting]);
    let arguments: Vec<&str> = ["analyse", "-"].into_iter().chain(options).collect();
    pipe(&arguments, preset(PresetId::JohanssonMinimumPhase).as_bytes())
}

#[test]
fn a_value_is_set_as_if_it_stood_in_the_file() {
    let mut document: Value = serde_json::from_str(&preset(PresetId::JohanssonMinimumPhase)).unwrap();
    document["setup"]["valves"] = json!([0.4, 0.3]);
    document["setup"]["plant"] = json!({ "preset": "junqueira-case-a" });
    let file = folder("set").join("changed.json");
    fs::write(&file, document.to_string()).unwrap();
    let expected = stdout(&super::run(&["analyse", file.to_str().unwrap()]));
    let found = analysed(&["setup.valves[0]=0.4", "setup.valves[1]=0.3", "setup.plant.preset=junqueira-case-a"]);
    assert_eq!(stdout(&found), expected);
    assert_eq!(
        stdout(&analysed(&["setup.valves=[0.4, 0.3]", "setup.plant={\"preset\": \"junqueira-case-a\"}"])),
        expected
    );
}

#[test]
fn what_cannot_be_set_is_refused_by_its_path() {
    for (setting, said) in [
        ("setup.valves[0]=1.5", "setup.valves[0]: 1.5 is outside 0 to 1"),
        ("setup.valves[7]=0.5", "setup.valves[7]: no such value in the document"),
        ("setup.controller.loops[0].gian=2", "setup.controller.loops[0].gian: unknown field `gian`"),
        ("setup.nothing.at=1", "setup.nothing.at: no such value in the document"),
        ("setup.controller.pairing=crossed", "setup.controller.pairing: unknown variant `crossed`"),
        ("=1", "unknown field ``"),
        ("setup", "a path, =, and a value"),
    ] {
        let output = analysed(&[setting]);
        assert_eq!(output.status.code(), Some(2), "{setting}");
        assert!(stderr(&output).contains(said), "{setting}: {}", stderr(&output));
    }
}
