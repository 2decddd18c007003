//! The commands on level loops, version 4.

use approx::assert_relative_eq;
use serde_json::{Value, json};

use super::{assert_described, pipe, run, stderr, stdout};

fn case(name: &str) -> Value {
    serde_json::from_str(&stdout(&run(&["cases", name]))).unwrap()
}

fn answer(arguments: &[&str], scenario: &Value) -> Value {
    serde_json::from_str(&stdout(&pipe(arguments, scenario.to_string().as_bytes()))).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

#[test]
fn the_ten_cases_are_listed_and_described() {
    let list = stdout(&run(&["cases"]));
    let is_level = |line: &&str| line.contains("Andreis") || line.contains("lecture slides");
    let names: Vec<&str> = list.lines().filter(is_level).filter_map(|line| line.split(' ').next()).collect();
    assert_eq!((names.len(), names[0], names[9]), (10, "andreis-sine-l", "level-slides-4"));
    assert!(list.contains("Andreis (2017), §5.1, Tables 5.3, 5.4: the model with errors"), "{list}");
    assert!(list.contains("setting 4: P = 2, I = 1/min, D = 5 min"), "{list}");
    let schema: Value = serde_json::from_str(&stdout(&run(&["schema", "--version", "4"]))).unwrap();
    for name in names {
        let scenario = case(name);
        assert_eq!(scenario["version"], json!(4));
        assert_described(&schema, &schema, &scenario);
        let output = pipe(&["simulate", "-", "--format", "json"], scenario.to_string().as_bytes());
        assert!(stderr(&output).is_empty(), "{name}: {}", stderr(&output));
    }
}

/// Table 5.1: the variance of the current loop, and what was printed for the best settings.
#[test]
fn simulate_and_tune_give_the_numbers_of_the_source() {
    let scenario = case("andreis-sine-l");
    let run = answer(&["simulate", "-", "--format", "json"], &scenario);
    assert_relative_eq!(number(&run["figures"]["level"]["variance"]), 3.5016e-4, max_relative = 1e-4);
    assert_relative_eq!(number(&run["indices"]["level"]["quality"]), 0.0130, epsilon = 5e-5);
    assert_eq!((&run["indices"]["of_objective"], &run["step"]), (&json!("level"), &Value::Null));
    for method in ["nelder-mead", "gradient", "genetic"] {
        let found = answer(&["tune", "-", "--method", method], &scenario);
        assert_eq!(found["method"], json!(method));
        assert!(number(&found["best"]["cost"]) < 4.553e-6, "{method}: {}", found["best"]);
        assert_relative_eq!(number(&found["best"]["gain"]), 93.7, epsilon = 0.5);
        let path = found["path"].as_array().unwrap();
        let last = number(&path.last().unwrap()["cost"]);
        assert_relative_eq!(last, number(&found["best"]["cost"]), max_relative = 1e-3);
        assert!(number(&found["evaluations"]) >= path.len() as f64);
        let current = &found["trade_off"]["current"];
        assert_eq!(current["level_variance"], run["figures"]["level"]["variance"]);
        assert_eq!(found["suggestions"].as_array().unwrap().len(), 5);
    }
    let seeded = |seed: &str| {
        let arguments = ["tune", "-", "--method", "genetic", "--generations", "3", "--seed", seed];
        stdout(&pipe(&arguments, scenario.to_string().as_bytes()))
    };
    assert_eq!(seeded("5"), seeded("5"));
    assert_ne!(seeded("5"), seeded("6"));
}

#[test]
fn analyse_gives_rest_model_margins_test_and_suggestions() {
    let found = answer(&["analyse", "-"], &case("andreis-sine-l"));
    assert_relative_eq!(number(&found["rest"]["output"]), 7.354, epsilon = 5e-4);
    assert_relative_eq!(number(&found["linear"]["slope_gain"]), 0.0231, epsilon = 5e-5);
    assert_relative_eq!(number(&found["ultimate_point"]["gain"]), 99.6, epsilon = 0.1);
    assert_eq!(found["closed_loop"]["stability"], json!({ "stable": true }));
    let model = &found["step_test"]["fit"]["model"]["self_regulating"];
    assert_relative_eq!(number(&model["gain"]), 5.75, epsilon = 0.01);
    assert_eq!(found["suggestions"][0]["rule"], json!("simc"));
    assert_eq!(found["suggestions"][2]["settings"]["field"], json!("dead_time_s"));
    // A test with a step back says what the tank does.
    let mut scenario = case("andreis-sine-l");
    let test = &mut scenario["level_loop"]["test"];
    (test["step"], test["return_time_s"], test["duration_s"]) = (json!(0.2), json!(5000), json!(10000));
    let found = answer(&["analyse", "-"], &scenario);
    assert_eq!(found["step_test"]["regulation"]["verdict"], json!("self-regulating"));
    assert_eq!(found["step_test"]["regulation"]["reason"]["sign"], json!("returns-to-start"));
    // What a loop cannot hold is said in place.
    scenario["level_loop"]["experiment"]["inflow"] = json!(0.05);
    let found = answer(&["analyse", "-"], &scenario);
    assert_eq!((&found["rest"]["error"], &found["linear"]), (&json!("valve-out-of-reach"), &Value::Null));
}

#[test]
fn tables_are_rows_of_the_log_and_of_the_path() {
    let scenario = case("level-slides-4").to_string();
    let table = stdout(&pipe(&["simulate", "-"], scenario.as_bytes()));
    assert_eq!(table.lines().count(), 602);
    assert!(table.starts_with("time_s,level_m,set_point_m,inflow_m3_per_s,outflow_m3_per_s,valve_flow_m3_per_s,"));
    assert!(table.lines().nth(1).unwrap().starts_with("0,0.3,0.6,0,"), "{}", table.lines().nth(1).unwrap());
    let path = stdout(&pipe(&["tune", "-", "--format", "csv"], case("andreis-random").to_string().as_bytes()));
    assert!(path.starts_with("gain,integral_time_s,cost\n") && path.lines().count() > 10, "{path}");
}

#[test]
fn a_published_table_stands_beside_the_computed_one() {
    let table = stdout(&run(&["cases", "--table", "5.1"]));
    assert!(table.starts_with("Andreis (2017), Table 5.1: variance of the level (m²)"), "{table}");
    let row = table.lines().find(|line| line.contains("gradient   nominal")).unwrap();
    let words: Vec<&str> = row.split_whitespace().collect();
    assert_eq!(words[..7], ["Sine", "L", "gradient", "nominal", "93.7", "2999.7", "4.5520e-6"], "{row}");
    assert!(table.contains("limit of stability"), "{table}");
    for wrong in [&["cases", "--table", "5.19"][..], &["cases", "andreis-random", "--table", "5.1"]] {
        let output = run(wrong);
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0));
        assert_eq!(stderr(&output).lines().count(), 1);
    }
}

#[test]
fn what_cannot_work_is_said() {
    let said = |command: &[&str], pointer: &str, value: Value| {
        let mut scenario = case("andreis-sine-l");
        *scenario.pointer_mut(&format!("/level_loop{pointer}")).unwrap() = value;
        let output = pipe(command, scenario.to_string().as_bytes());
        assert_eq!((output.status.code(), stderr(&output).lines().count()), (Some(2), 1));
        stderr(&output)
    };
    let run = ["simulate", "-"];
    let search = said(&run, "/search/gain", json!([5, 5]));
    assert!(search.contains("level_loop.search.gain[1]: 5 is outside 5.00"), "{search}");
    let level = said(&run, "/experiment/level", json!(2.5));
    assert!(level.contains("level_loop.experiment: a level of 2.5 m is outside the tank, 0 to 2 m"), "{level}");
    let work = said(&run, "/experiment/disturbance/signal/sine/period_s", json!(0.001));
    assert!(work.contains("level_loop.experiment: period_s: the run would take 4800000 steps"), "{work}");
    let tuned = said(&["tune", "-"], "/experiment/level", json!(2.5));
    assert!(tuned.contains("level_loop: a level of 2.5 m is outside the tank"), "{tuned}");
    let drawn = said(&["plot", "-", "--svg", "-"], "/experiment/level", json!(2.5));
    assert!(drawn.contains("a level of 2.5 m is outside the tank"), "{drawn}");
}

#[test]
fn every_picture_is_drawn_for_every_case() {
    for name in ["andreis-sine-l", "andreis-random", "level-slides-2"] {
        let scenario = case(name).to_string();
        for (picture, word) in
            [("run", "reference"), ("step-test", "measured"), ("trade-off", "var(h)"), ("cost-map", "Kp")]
        {
            let output = pipe(&["plot", "-", "--svg", "-", "--level-picture", picture], scenario.as_bytes());
            let svg = stdout(&output);
            assert!(svg.starts_with("<svg") && svg.contains(word), "{name} {picture}: {}", &svg[..200.min(svg.len())]);
            assert!(!svg.contains("NaN"), "{name} {picture}");
        }
    }
}

#[test]
fn what_has_no_effect_is_a_warning() {
    let setting =
        ["--set", "level_loop.search.keep_band=true", "--set", "level_loop.experiment.disturbance.until_s=50"];
    let output = pipe(&[&["simulate", "-"], &setting[..]].concat(), case("andreis-random").to_string().as_bytes());
    assert!(output.status.success());
    let said = stderr(&output);
    for field in ["experiment.disturbance", "reference", "search.keep_band"] {
        assert!(said.contains(&format!("warning: level_loop.{field}: without effect here")), "{said}");
    }
}
