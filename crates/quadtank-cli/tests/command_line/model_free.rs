//! The commands on runs under the model-free law, version 3.

use approx::assert_relative_eq;
use serde_json::{Value, json};

use super::{assert_described, pipe, run, stderr, stdout};

fn case(name: &str) -> Value {
    serde_json::from_str(&stdout(&run(&["cases", name]))).unwrap()
}

fn answer(arguments: &[&str], scenario: &Value) -> Value {
    serde_json::from_str(&stdout(&pipe(arguments, scenario.to_string().as_bytes()))).unwrap()
}

#[test]
fn the_nine_cases_are_listed_and_described() {
    let list = stdout(&run(&["cases"]));
    let names: Vec<&str> =
        list.lines().filter(|line| line.contains("Junqueira")).filter_map(|line| line.split(' ').next()).collect();
    assert_eq!(names.len(), 9);
    let schema: Value = serde_json::from_str(&stdout(&run(&["schema", "--version", "3"]))).unwrap();
    for name in names {
        let scenario = case(name);
        assert_eq!(scenario["version"], json!(3));
        assert_described(&schema, &schema, &scenario);
        assert!(answer(&["simulate", "-", "--format", "json"], &scenario)["figures"].is_array());
    }
}

#[test]
fn analyse_finds_the_zero_and_what_it_attracts() {
    let mut scenario = case("junqueira-b-s1");
    let found = answer(&["analyse", "-"], &scenario);
    // Both levels end at 10 cm: zeros, relative gain and index of the published case b.
    let zero = found["at_rest"]["zeros"][1]["re"].as_f64().unwrap();
    assert_relative_eq!(zero, 0.00919, epsilon = 0.5e-5);
    assert_relative_eq!(found["at_rest"]["rga_11"].as_f64().unwrap(), -0.8, epsilon = 0.5e-3);
    assert_relative_eq!(found["at_rest"]["niederlinski_diagonal"].as_f64().unwrap(), -1.25, epsilon = 0.5e-3);
    assert_eq!(found["closed_loop"]["stability"], json!("unstable"));
    assert_eq!(found["smallest_model_gain"], Value::Null);
    // With the other pairing gentle gains are stable.
    let controller = &mut scenario["model_free"]["controller"];
    (controller["pairing"], controller["estimator"]) = (json!("swapped"), Value::Null);
    for i in 0..2 {
        controller["loops"][i]["proportional"] = json!(0.05);
        controller["loops"][i]["integral"] = json!(0.0005);
    }
    assert_eq!(answer(&["analyse", "-"], &scenario)["closed_loop"]["stability"], json!("stable"));
    // Where the valves sum to 1, unequal levels have no rest, and the report says why in its place.
    let found = answer(&["analyse", "-"], &case("junqueira-c-s3"));
    assert_eq!(found["rest"]["error"], json!("singular-plant"));
    assert_eq!(found["at_rest"], Value::Null);
}

#[test]
fn simulate_and_plot_show_what_two_levels_hide() {
    let mut scenario = case("junqueira-b-s3");
    let found = answer(&["simulate", "-", "--format", "json"], &scenario);
    let lost = found["figures"][0]["lost_at_s"].as_f64().unwrap();
    let predicted = &found["predicted"];
    assert_eq!(predicted["ends"]["pump_at_its_limit"], json!(1));
    let limited = predicted["from_s"].as_f64().unwrap() + predicted["ends"]["after_s"].as_f64().unwrap();
    assert!((limited..limited + 40.0).contains(&lost), "{limited} {lost}");
    let csv = stdout(&pipe(&["simulate", "-"], scenario.to_string().as_bytes()));
    assert_eq!(csv.lines().count(), 322);
    assert!(csv.starts_with("time_s,level_1_m,level_2_m,level_3_m,level_4_m,reference_1_m,"));
    assert!(csv.lines().all(|line| line.split(',').count() == 16));
    let svg = stdout(&pipe(&["plot", "-", "--svg", "-"], scenario.to_string().as_bytes()));
    let document = roxmltree::Document::parse(&svg).unwrap();
    assert!(document.descendants().filter(|node| node.has_tag_name("path")).count() > 10);
    // Two PI loops in the same experiment have the same fate: it is the pairing.
    let settings = json!({
        "gain": 3.0, "integral_time_s": 40.0, "set_point_weight": 1.0, "anti_windup": "off", "mode": "automatic",
    });
    scenario["model_free"]["compare"] =
        json!({ "pairing": "diagonal", "loops": [settings, settings], "sampling_time_s": 1.0 });
    scenario["model_free"]["experiment"]["duration_s"] = json!(2000);
    let found = answer(&["simulate", "-", "--format", "json"], &scenario);
    assert!(found["comparison"][0]["lost_at_s"].as_f64().unwrap() > lost, "{}", found["comparison"]);
}

#[test]
fn what_cannot_work_is_said() {
    let refused = |change: &dyn Fn(&mut Value)| {
        let mut scenario = case("junqueira-a-s1");
        change(&mut scenario["model_free"]);
        let output = pipe(&["simulate", "-"], scenario.to_string().as_bytes());
        assert_eq!(output.status.code(), Some(2));
        stderr(&output)
    };
    let window = |window_s: f64| refused(&|run| run["controller"]["estimator"]["window_s"] = json!(window_s));
    assert!(window(1.5).contains("model_free.controller.estimator.window_s: the window of 1.5 s is shorter than two"));
    assert!(window(10.5).contains("is no multiple of the sampling time of 1 s"));
    assert!(window(1e5).contains("more than 1000 samples"));
    let gain = refused(&|run| run["controller"]["loops"][1]["model_gain"] = json!(0));
    assert!(gain.contains("model_free.controller.loops[1].model_gain: 0 is outside"), "{gain}");
    let valve = json!({ "sine": { "mean": 0.5, "amplitude": 0.6, "frequency": 0.2, "phase": 0 } });
    let valve = refused(&|run| run["valves"][0] = valve.clone());
    assert!(valve.contains("model_free.valves[0]: -0.0") && valve.contains("is outside 0 to 1"), "{valve}");
    let ramp = json!({ "ramp": { "from": 0.2, "to": 0.6, "begin_s": 50, "end_s": 20 } });
    assert!(refused(&|run| run["valves"][1] = ramp.clone()).contains("model_free.valves[1].ramp.end_s: 20"));
    // Levels that nothing holds.
    let uneven = refused(&|run| {
        run["start"] = json!({ "rest": [0.1, 0.12] });
        run["valves"] = json!([{ "constant": { "gamma": 0.5 } }, { "constant": { "gamma": 0.5 } }]);
    });
    assert!(uneven.contains("singular"), "{uneven}");
    let output = pipe(&["tune", "-"], case("junqueira-a-s1").to_string().as_bytes());
    assert_eq!(output.status.code(), Some(2));
    let mut later = case("junqueira-a-s1");
    later["version"] = json!(5);
    let output = pipe(&["analyse", "-"], later.to_string().as_bytes());
    assert!(stderr(&output).contains("version: 5 is unknown, this program reads 1 to 4"));
}
