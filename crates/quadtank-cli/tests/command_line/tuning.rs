//! The commands on sessions of the relay-tuning bench.

use approx::assert_relative_eq;
use quadtank::literature::PresetId;
use serde_json::{Value, json};

use super::{assert_described, pipe, preset, run, stderr, stdout};

fn case(name: &str) -> String {
    stdout(&run(&["cases", name]))
}

#[test]
fn cases_lists_every_published_case_and_tune_gives_its_gains() {
    let list = stdout(&run(&["cases"]));
    assert_eq!(list.lines().filter(|line| line.contains("Campestrini")).count(), 37);
    assert!(list.contains("equation-88      Campestrini (2006), eq. 88\n"));
    // Table 6, root 1.
    let report: Value = serde_json::from_str(&stdout(&pipe(&["tune", "-"], case("table-6-row-1").as_bytes()))).unwrap();
    let root = &report["design"]["roots"][0];
    let printed = [("kp", 0.567, -0.102), ("ki", 0.336, -0.018), ("kd", 0.239, -0.144)];
    for (name, first, second) in printed {
        assert_relative_eq!(root["controllers"][0][name].as_f64().unwrap(), first, epsilon = 6e-4);
        assert_relative_eq!(root["controllers"][1][name].as_f64().unwrap(), second, epsilon = 6e-4);
    }
    assert_eq!(root["stability"]["stable"], json!(true));
    assert_eq!(report["test"]["reading"]["verdict"], json!("unimodal"));
    // G(jω) from a sine and the relays is that of the model.
    for (measured, exact) in [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| {
        let of = |name: &str| report["test"][name][i][j].clone();
        (of("recovered_g"), of("exact_g"))
    }) {
        for part in ["re", "im"] {
            let (measured, exact) = (measured[part].as_f64().unwrap(), exact[part].as_f64().unwrap());
            assert!((measured - exact).abs() < 0.02, "{measured} {exact}");
        }
    }
    let unknown = run(&["cases", "table-99-row-1"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(stderr(&unknown).contains("table-99-row-1"));
}

#[test]
fn given_controllers_are_answered_and_published_ones_compared() {
    let file = include_str!("../../../quadtank-scenario/tests/data/wood-berry-given-gains.json");
    let report: Value = serde_json::from_str(&stdout(&pipe(&["tune", "-"], file.as_bytes()))).unwrap();
    let root = &report["design"]["roots"][0];
    assert_eq!((&root["stability"]["stable"], &report["design"]["chosen"]), (&json!(true), &json!(1)));
    // Printed to two decimals by an independent computation.
    assert_relative_eq!(root["sensitivity_peak"].as_f64().unwrap(), 2.10, epsilon = 0.005);
    assert_relative_eq!(root["biggest_log_modulus_db"].as_f64().unwrap(), 3.98, epsilon = 0.005);
    let names = ["blt", "ziegler-nichols", "chen-seborg", "boyd-hast-astrom"].map(|name| format!("wood-berry-{name}"));
    let compared = report["published_controllers"].as_array().unwrap();
    assert_eq!(compared.iter().map(|row| row["case"].as_str().unwrap()).collect::<Vec<_>>(), names);
    assert_eq!(compared[0]["figures"], report["design"]["figures"]);
    let list = stdout(&run(&["cases"]));
    for (name, row) in names.iter().zip(compared) {
        assert!(list.lines().any(|line| line.starts_with(name.as_str())), "{name}");
        let alone: Value = serde_json::from_str(&stdout(&pipe(&["tune", "-"], case(name).as_bytes()))).unwrap();
        assert_eq!(alone["design"]["roots"][0]["sensitivity_peak"], row["sensitivity_peak"]);
    }
    let schema: Value = serde_json::from_str(&stdout(&run(&["schema", "--version", "2"]))).unwrap();
    assert_described(&schema, &schema, &serde_json::from_str(file).unwrap());
}

#[test]
fn every_command_takes_a_relay_tuning_session() {
    let session = case("table-14-row-1");
    let analysis: Value = serde_json::from_str(&stdout(&pipe(&["analyse", "-"], session.as_bytes()))).unwrap();
    // λ11 = 0.5455 and NI = 1.8333 of Process II, recomputed.
    assert_relative_eq!(analysis["rga_11"].as_f64().unwrap(), 0.5455, epsilon = 5.1e-5);
    assert_relative_eq!(analysis["niederlinski_diagonal"].as_f64().unwrap(), 1.8333, epsilon = 5.1e-5);
    let response = stdout(&pipe(&["simulate", "-"], session.as_bytes()));
    assert!(response.starts_with("time,output_1,output_2,input_1,input_2\n"));
    let last: Vec<f64> = response.lines().last().unwrap().split(',').map(|x| x.parse().unwrap()).collect();
    assert!((last[1] - 1.0).abs() < 0.01 && last[2].abs() < 0.01, "{last:?}");
    let record = stdout(&pipe(&["tune", "-", "--format", "csv"], session.as_bytes()));
    assert!(record.lines().count() > 8000);
    for picture in ["test", "curve", "loci", "response"] {
        let svg = stdout(&pipe(&["plot", "-", "--svg", "-", "--picture", picture], session.as_bytes()));
        let document = roxmltree::Document::parse(&svg).unwrap();
        assert!(document.descendants().filter(|node| node.has_tag_name("path")).count() > 2, "{picture}");
    }
    let schema: Value = serde_json::from_str(&stdout(&run(&["schema", "--version", "2"]))).unwrap();
    assert_described(&schema, &schema, &serde_json::from_str(&session).unwrap());
}

#[test]
fn sequential_and_independent_tests_report_every_loop() {
    let mut session: Value = serde_json::from_str(&case("table-14-row-1")).unwrap();
    session["tuning"]["test"]["kind"] = json!("sequential");
    session["tuning"]["test"]["passes"] = json!(2);
    let report = |session: &Value| -> Value {
        serde_json::from_str(&stdout(&pipe(&["tune", "-"], session.to_string().as_bytes()))).unwrap()
    };
    let steps = report(&session)["test"]["steps"].as_array().unwrap().clone();
    assert_eq!(steps.iter().map(|step| step["loop"].as_u64().unwrap()).collect::<Vec<_>>(), [1, 2, 1, 2]);
    session["tuning"]["test"]["kind"] = json!("independent");
    let loops = report(&session)["test"]["loops"].as_array().unwrap().clone();
    // 0.4 Kc of the diagonal elements, Kc = 9.000 and 2.278, which relays meet within 3 %.
    for (of_loop, gain) in loops.iter().zip([9.0, 2.278]) {
        assert_relative_eq!(of_loop["settings"]["gain"].as_f64().unwrap(), 0.4 * gain, max_relative = 0.03);
    }
}

#[test]
fn a_single_test_finds_a_point_and_the_nonlinear_tank_swings() {
    let report = |session: &Value| -> Value {
        serde_json::from_str(&stdout(&pipe(&["tune", "-"], session.to_string().as_bytes()))).unwrap()
    };
    let mut session: Value = serde_json::from_str(&case("table-14-row-1")).unwrap();
    let test = &mut session["tuning"]["test"];
    test["kind"] = json!("single");
    test["behind"] = json!("integrator");
    let single = report(&session)["test"].clone();
    let found = single["found"].clone();
    // 0.5/((0.1 s + 1)² (0.2 s + 1)²) has −90° where 0.3 ω = 1 − 0.02 ω².
    let frequency = (0.17_f64.sqrt() - 0.3) / 0.04;
    assert_relative_eq!(found["frequency"].as_f64().unwrap(), frequency, max_relative = 0.02);
    let (re, im) = (found["response"]["re"].as_f64().unwrap(), found["response"]["im"].as_f64().unwrap());
    assert_relative_eq!(found["modulus"].as_f64().unwrap(), re.hypot(im), max_relative = 0.05);
    let (cycle, read) = (&single["exact_limit_cycle"], &single["reading"]["oscillation"]);
    assert_eq!(cycle["stable"], json!(true));
    assert_relative_eq!(cycle["period"].as_f64().unwrap(), read["period"].as_f64().unwrap(), max_relative = 1e-3);

    // P+ with the swapped pairing, and hysteresis instead of a dead time.
    let tuning = &mut session["tuning"];
    let tank = json!({ "preset": "johansson-2000-non-minimum-phase", "pairing": "swapped", "nonlinear": true });
    tuning["plant"] = json!({ "quadruple_tank": tank });
    tuning["test"] = json!({
        "kind": "simultaneous", "amplitudes": [0.3, 0.3], "hysteresis": [0.05, 0.05], "rule": "ziegler-nichols-pi",
        "duration": 6000, "release": 60, "step": 0.5,
    });
    tuning["design"] = json!({
        "critical": { "importance": 1.0 }, "method": "both-loci", "action": "pid", "target": [-0.3, -0.3], "root": 1,
    });
    tuning["response"] = json!({ "references": [0.1, 0.0], "duration": 3000, "step": 1.0 });
    let report = report(&session);
    assert!(report["test"]["reading"]["oscillation"].is_object(), "{}", report["test"]["reading"]);
    // The published gains of this design are those of the linear models with rounded time constants: within 3 %.
    let first = &report["design"]["roots"][0];
    assert_eq!(first["stability"]["stable"], json!(true));
    assert_relative_eq!(first["distance_from_minus_one"].as_f64().unwrap(), 0.658, max_relative = 0.03);
    let settled = report["design"]["figures"][0]["settling_time_2_percent"].as_f64().unwrap();
    assert!((50.0..2500.0).contains(&settled), "{settled}");
    let mut with_dead_time = session.clone();
    with_dead_time["tuning"]["plant"]["quadruple_tank"]["dead_time_s"] = json!(5);
    let refused = pipe(&["tune", "-"], with_dead_time.to_string().as_bytes());
    assert!(stderr(&refused).contains("tuning.plant.quadruple_tank.dead_time_s: 5"));
}

#[test]
fn what_relay_tuning_refuses_is_said() {
    let refused = |change: &dyn Fn(&mut Value)| {
        let mut session: Value = serde_json::from_str(&case("table-5-row-1")).unwrap();
        change(&mut session["tuning"]);
        let output = pipe(&["tune", "-"], session.to_string().as_bytes());
        assert_eq!(output.status.code(), Some(2));
        stderr(&output)
    };
    assert!(refused(&|t| t["test"]["amplitudes"][0] = json!(0)).contains("tuning.test.amplitudes[0]: 0"));
    assert!(refused(&|t| t["design"]["target"] = json!([0, 0])).contains("tuning: target = 0"));
    let element =
        |dead_time: f64, slope: f64| json!({ "numerator": [1.0], "denominator": [1.0, slope], "dead_time": dead_time });
    let plant = |g: [Value; 4]| {
        let [a, b, c, d] = g;
        json!({ "elements": [[a, b], [c, d]] })
    };
    let unstable = plant([element(1.0, 1.0), element(1.0, 2.0), element(1.0, 1.0), element(1.0, -3.0)]);
    assert!(refused(&|t| t["plant"] = unstable.clone()).contains("a pole with the real part 0.333"));
    let singular = plant([element(1.0, 1.0), element(1.0, 2.0), element(1.0, 1.0), element(1.0, 3.0)]);
    assert!(refused(&|t| t["plant"] = singular.clone()).contains("singular"));
    // Documents that would ask for more steps than anyone waits for, and a product that would vanish.
    let tank = |more: Value| {
        let mut tank = json!({ "preset": "johansson-2000-minimum-phase", "pairing": "diagonal" });
        tank.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        json!({ "quadruple_tank": tank })
    };
    assert!(refused(&|t| t["plant"] = tank(json!({ "lag_s": 1e-20 }))).contains("quickest pole * duration"));
    let quick = plant([element(1e6, 1e-6), element(1.0, 2.0), element(1.0, 1.0), element(1.0, 3.0)]);
    assert!(refused(&|t| t["plant"] = quick.clone()).contains("quickest pole * "));
    let mut tiny = plant([element(1.0, 1.0), element(1.0, 2.0), element(1.0, 1.0), element(1.0, 3.0)]);
    tiny["elements"][0][1]["numerator"] = json!([1e-200]);
    assert!(refused(&|t| t["plant"] = tiny.clone()).contains("tuning.plant.elements[0][1].numerator[0]: "));
    let greedy = json!(20);
    assert!(refused(&|t| (t["test"]["passes"], t["test"]["step"]) = (greedy.clone(), json!(0.004))).contains("passes"));
    // No way from pump 1 to level 1: nothing to tune with this pairing.
    assert!(refused(&|t| t["plant"] = tank(json!({ "valves": [0.0, 0.6] }))).contains("in the other pairing"));
    let run_of_the_tank = preset(PresetId::JohanssonMinimumPhase);
    let output = pipe(&["tune", "-"], run_of_the_tank.as_bytes());
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("version 2"));
}
