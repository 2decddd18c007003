//! Records beside runs: what is printed, and what is refused.

use std::fs;

use quadtank::literature::PresetId;
use serde_json::Value;

use super::{folder, pipe, preset, run, stderr, stdout};

/// A file of its own.
fn scratch(name: &str) -> String {
    folder("record").join(name).display().to_string()
}

/// A record of a run of a preset whose valve 1 stands otherwise than the preset says, and the preset in a file.
fn recorded(name: &str) -> (String, String) {
    let document = preset(PresetId::JohanssonMinimumPhase);
    let scenario = scratch(&format!("{name}.json"));
    fs::write(&scenario, &document).unwrap();
    let arguments = ["simulate", "-", "--set", "setup.valves[0]=0.62", "--set", "setup.experiment.duration_s=1500"];
    let record = scratch(&format!("{name}.csv"));
    fs::write(&record, stdout(&pipe(&arguments, document.as_bytes()))).unwrap();
    (scenario, record)
}

#[test]
fn a_rig_is_fitted_to_its_record() {
    let (scenario, record) = recorded("fit");
    let out = scratch("fitted.json");
    let report: Value =
        serde_json::from_str(&stdout(&run(&["record", &scenario, &record, "--fit", "gamma1", "--scenario", &out])))
            .unwrap();
    assert_eq!(report["columns"][1]["meaning"]["signal"]["level"], 0);
    let found = report["fit"]["estimates"][0]["value"].as_f64().unwrap();
    assert!((found - 0.62).abs() < 1e-3, "{found}");
    let fit = report["agreement"]["levels"][0]["fit_percent"].as_f64().unwrap();
    assert!(fit > 99.0, "{fit}");
    let written: Value = serde_json::from_str(&fs::read_to_string(out).unwrap()).unwrap();
    assert_eq!(written["setup"]["valves"][0].as_f64().unwrap(), found);
}

#[test]
fn a_fit_stays_within_the_bounds_that_are_given() {
    let (scenario, record) = recorded("bounds");
    let arguments = ["record", &scenario, &record, "--fit", "gamma1=0.8:0.7..0.9", "--fit", "gamma2:0.1..0.8"];
    let report: Value = serde_json::from_str(&stdout(&run(&arguments))).unwrap();
    let [first, second] = [0, 1].map(|index| &report["fit"]["estimates"][index]);
    assert_eq!((&first["start"], &first["bounds"]), (&0.8.into(), &serde_json::json!([0.7, 0.9])));
    assert_eq!(first["is_at_bound"], true);
    assert_eq!((&second["start"], &second["bounds"]), (&0.6.into(), &serde_json::json!([0.1, 0.8])));
    assert_eq!(report["fit"]["correlation"][0].as_array().unwrap().len(), 2);
}

#[test]
fn a_record_without_names_is_told_what_it_is() {
    let (scenario, _) = recorded("bare");
    let record = scratch("bare-columns.csv");
    fs::write(&record, "0;124;3\n10;124;3\n20;125;3\n").unwrap();
    let arguments = ["record", &scenario, &record, "--column", "2=level1:mm", "--own-experiment"];
    let report: Value = serde_json::from_str(&stdout(&run(&arguments))).unwrap();
    assert_eq!(report["agreement"]["levels"][0]["values"], 3);
    // Johansson's level 1 rests at 12.26 cm.
    let rmse = report["agreement"]["levels"][0]["rmse"].as_f64().unwrap();
    assert!(rmse < 3e-3, "{rmse}");
    assert_eq!(report["columns"][0]["unit_assumed"], true);
    assert!(report["columns"][1].get("unit_assumed").is_none());
}

#[test]
fn a_unit_that_nobody_said_is_told() {
    let (scenario, _) = recorded("units");
    let record = scratch("no-units.csv");
    fs::write(&record, "t (s),h1,u1\n0,12.4,3\n10,12.4,3\n20,12.5,3\n").unwrap();
    let told = stderr(&run(&["record", &scenario, &record, "--own-experiment"]));
    assert!(told.contains("column 2 `h1` is read in cm, column 3 `u1` is read in V"), "{told}");
    let said = ["record", &scenario, &record, "--own-experiment", "--column", "2=level1:cm", "--column", "3=pump1:V"];
    assert_eq!(stderr(&run(&said)), "");
}

#[test]
fn what_cannot_be_used_is_one_line() {
    let (scenario, record) = recorded("faults");
    let text = scratch("no-table.csv");
    fs::write(&text, "t,h1\n0,12\n1,open\n").unwrap();
    let feet = scratch("feet.csv");
    fs::write(&feet, "t (s),h1 (ft)\n0,0.4\n1,0.4\n").unwrap();
    for (arguments, words) in [
        (vec!["record", &scenario, &feet], "column 2 `h1 (ft)` is in `ft`, which is not known here"),
        (vec!["record", &scenario, &text], "line 3, column 2: `open` is not a number"),
        (vec!["record", &scenario, &record, "--column", "99=level1"], "there is no column 99"),
        (vec!["record", &scenario, &record, "--column", "2=flow"], "level1 to level4"),
        (
            vec!["record", &scenario, &record, "--column", "2=level1:V"],
            "the units of level1 are cm, m, mm, in, sensor-V",
        ),
        (vec!["record", &scenario, &record, "--fit", "gamma3"], "gamma1, gamma2"),
        (vec!["record", &scenario, &record, "--fit", "gamma1:0.3"], "`0.3` are no bounds"),
        (
            vec!["record", &scenario, &record, "--fit", "gamma1:0.9..0.3"],
            "gamma1: its bounds are two values between 0 and 1",
        ),
    ] {
        let output = run(&arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let told = stderr(&output);
        assert!(told.contains(words) && told.trim().lines().count() == 1, "{arguments:?}: {told}");
    }
}
