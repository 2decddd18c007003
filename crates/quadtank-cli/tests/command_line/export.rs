//! An experiment as a script.

use quadtank::literature::PresetId;
use quadtank_export::{Language, export, latex};
use quadtank_scenario::from_json;

use super::{pipe, preset, run, stderr, stdout};

#[test]
fn export_prints_the_script_of_each_language() {
    let document = preset(PresetId::CocotaNonMinimumPhase);
    for (name, language) in [("python", Language::Python), ("octave", Language::Octave), ("julia", Language::Julia)] {
        let script = stdout(&pipe(&["export", "-", "--as", name], document.as_bytes()));
        assert_eq!(script, export(&from_json(&document).unwrap(), language).unwrap());
    }
}

#[test]
fn export_prints_model_and_controller_as_latex() {
    let document = preset(PresetId::CocotaNonMinimumPhase);
    let text = stdout(&pipe(&["export", "-", "--as", "latex"], document.as_bytes()));
    assert_eq!(text, latex(&from_json(&document).unwrap()).unwrap());
}

#[test]
fn a_value_that_is_set_is_one_of_the_script() {
    let document = preset(PresetId::JohanssonMinimumPhase);
    let setting = "setup.controller.loops[0].gain=2.5";
    let script = stdout(&pipe(&["export", "-", "--as", "python", "--set", setting], document.as_bytes()));
    assert!(script.contains("GAIN = np.array([2.5, 2.7])"));
}

#[test]
fn what_cannot_be_exported_ends_with_code_2_and_says_why() {
    let tuning = stdout(&run(&["cases", "table-6-row-1"]));
    let singular = preset(PresetId::JohanssonMinimumPhase);
    let settings = ["setup.valves=[0.5,0.5]", "setup.operating_point={\"levels\":[0.1,0.1]}"];
    for (document, settings, reason) in [
        (tuning, &[][..], "this command needs an experiment of the quadruple tank, version 1"),
        (singular, &settings[..], "setup.operating_point: the plant is singular at steady state"),
    ] {
        let settings = settings.iter().flat_map(|setting| ["--set", setting]);
        let arguments: Vec<&str> = ["export", "-", "--as", "python"].into_iter().chain(settings).collect();
        let output = pipe(&arguments, document.as_bytes());
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0));
        assert!(stderr(&output).contains(reason), "{}", stderr(&output));
    }
}
