//! The command line as a reader of the README uses it: every example there, the exit codes, and what goes wrong.
#![cfg(not(target_arch = "wasm32"))]

use std::fs;
use std::io::{Read, Write};
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

use approx::assert_relative_eq;
use quadtank::plant::PresetId;
use quadtank::scenario::{Scenario, from_json, setup_of};
use serde_json::{Value, json};

fn quadtank() -> Command {
    Command::new(env!("CARGO_BIN_EXE_quadtank"))
}

fn run(arguments: &[&str]) -> Output {
    quadtank().args(arguments).output().unwrap()
}

/// Runs with a text on standard input.
fn pipe(arguments: &[&str], input: &[u8]) -> Output {
    let mut child =
        quadtank().args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    // The program may stop reading early when the text is too long.
    let _ = child.stdin.take().unwrap().write_all(input);
    child.wait_with_output().unwrap()
}

fn stdout(output: &Output) -> String {
    assert!(output.status.success(), "{}", stderr(output));
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

fn preset(id: PresetId) -> String {
    stdout(&run(&["presets", id.name()]))
}

/// A folder of its own for the files of a test.
fn folder(test: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(test);
    fs::create_dir_all(&folder).unwrap();
    folder
}

#[test]
fn presets_lists_every_rig() {
    let list = stdout(&run(&["presets"]));
    let names: Vec<&str> = list.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert_eq!(names, PresetId::ALL.map(PresetId::name));
}

#[test]
fn presets_prints_the_scenario_of_a_rig() {
    for id in PresetId::ALL {
        assert_eq!(from_json(&preset(id)), Ok(Scenario::from(setup_of(id))));
    }
}

#[test]
fn analyse_prints_the_numbers_of_the_oracle() {
    let oracle: Value = serde_json::from_str(include_str!("data/quadruple-tank.json")).unwrap();
    for id in PresetId::ALL {
        let report: Value = serde_json::from_str(&stdout(&pipe(&["analyse", "-"], preset(id).as_bytes()))).unwrap();
        let expected = oracle["cases"].as_array().unwrap().iter().find(|case| case["name"] == id.name()).unwrap();
        // The parameters of Junqueira et al. have seven digits in the oracle.
        let tolerance = if id.name().starts_with("junqueira") { 3e-7 } else { 1e-9 };
        let close = |found: &Value, expected: &Value| {
            assert_relative_eq!(found.as_f64().unwrap(), expected.as_f64().unwrap(), max_relative = tolerance);
        };
        close(&report["rga_11"], &expected["rga_11"]);
        close(&report["niederlinski"]["diagonal"], &expected["niederlinski_diagonal"]);
        close(&report["niederlinski"]["swapped"], &expected["niederlinski_swapped"]);
        for index in 0..2 {
            close(&report["zeros"][index]["value"]["re"], &expected["zeros"][index]);
            for other in 0..2 {
                close(&report["dc_gain"][index][other], &expected["dc_gain"][index][other]);
            }
        }
        for tank in 0..4 {
            close(&report["operating_point"]["levels"][tank], &expected["levels"][tank]);
            close(&report["time_constants_s"][tank], &expected["time_constants"][tank]);
            for other in 0..4 {
                let (found, expected) = (&report["model"]["a"][tank][other], &expected["a"][tank][other]);
                close(found, expected);
            }
        }
        assert_eq!(report["closed_loop"]["stability"], "stable");
        assert_eq!(report["closed_loop"]["poles_s"].as_array().unwrap().len(), 6);
        assert!(report["closed_loop"]["guaranteed_margins"]["phase_rad"].as_f64().unwrap() > 0.0);
    }
}

#[test]
fn analyse_says_in_place_what_has_no_answer() {
    let mut scenario: Value = serde_json::from_str(&preset(PresetId::JohanssonMinimumPhase)).unwrap();
    scenario["setup"]["valves"] = json!([1.0, 0.0]);
    let output = pipe(&["analyse", "-"], scenario.to_string().as_bytes());
    let report: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(report["zeros"], json!({ "error": "degenerate-rank", "rank": 1, "size": 2 }));
    assert_eq!(report["rga_11"]["error"], "singular-gain");
    assert_eq!(report["suggestion"], json!({ "pairing": "none", "reason": { "rule": "singular-gain" } }));
}

#[test]
fn simulate_prints_a_row_per_sample() {
    let id = PresetId::CocotaMinimumPhase;
    let table = stdout(&pipe(&["simulate", "-"], preset(id).as_bytes()));
    let mut lines = table.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    assert_eq!(header[..3], ["time_s", "level_1_m", "level_2_m"]);
    let rows: Vec<Vec<f64>> =
        lines.map(|line| line.split(',').map(|number| number.parse().unwrap()).collect()).collect();
    // 1750 s at one sample per second, both ends included.
    assert_eq!(rows.len(), 1751);
    assert!(rows.iter().all(|row| row.len() == header.len() && row.iter().all(|number| number.is_finite())));
    let column = |name: &str| header.iter().position(|other| *other == name).unwrap();
    let (first, last) = (&rows[0], &rows[1750]);
    for level in 1..=2 {
        let level_now = last[column(&format!("level_{level}_m"))];
        let reference = last[column(&format!("reference_{level}_m"))];
        assert_relative_eq!(reference, 1.05 * first[column(&format!("level_{level}_m"))], max_relative = 1e-12);
        // 750 s after the last step the slowest pole, −0.0069 1/s, has left 0.6 % of it.
        assert_relative_eq!(level_now, reference, epsilon = 0.006 * 0.05 * reference);
    }
}

#[test]
fn simulate_gives_trajectories_events_and_metrics_as_json() {
    let scenario = preset(PresetId::JohanssonMinimumPhase);
    let output = pipe(&["simulate", "-", "--format", "json"], scenario.as_bytes());
    let run: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(run["nonlinear"]["time_s"].as_array().unwrap().len(), 3001);
    assert_eq!(run["linear"]["levels"].as_array().unwrap().len(), 4);
    assert_eq!(run["nonlinear"]["events"], json!([]));
    assert_eq!(run["metrics"][0]["step_time_s"], json!(100.0));
    assert!(run["metrics"][0]["settling_2_percent"]["after"]["time_s"].as_f64().unwrap() > 0.0);
}

#[test]
fn plot_draws_every_chart_in_both_themes() {
    let folder = folder("plot");
    let scenario = folder.join("scenario.json");
    fs::write(&scenario, preset(PresetId::CocotaNonMinimumPhase)).unwrap();
    let mut drawings = Vec::new();
    for chart in ["responses", "valve-plane", "pole-zero"] {
        for theme in ["light", "dark"] {
            let drawing = folder.join(format!("{chart}-{theme}.svg"));
            let files = [scenario.to_str().unwrap(), drawing.to_str().unwrap()];
            let output = run(&["plot", files[0], "--svg", files[1], "--chart", chart, "--theme", theme]);
            assert_eq!(stdout(&output), "");
            let svg = fs::read_to_string(&drawing).unwrap();
            assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n") && !svg.contains("NaN"), "{chart} {theme}");
            drawings.push(svg);
        }
    }
    drawings.sort();
    drawings.dedup();
    assert_eq!(drawings.len(), 6);
    let output = run(&["plot", scenario.to_str().unwrap(), "--svg", "-"]);
    assert!(stdout(&output).starts_with("<svg "));
}

#[test]
fn schema_describes_what_presets_prints() {
    let schema: Value = serde_json::from_str(&stdout(&run(&["schema"]))).unwrap();
    assert_eq!(schema["title"], "Scenario");
    let scenario: Value = serde_json::from_str(&preset(PresetId::JohanssonMinimumPhase)).unwrap();
    assert_described(&schema, &schema, &scenario);
}

/// Every key of a document has its property in the schema, in depth.
fn assert_described(root: &Value, schema: &Value, document: &Value) {
    let schema = match schema["$ref"].as_str() {
        Some(reference) => root.pointer(reference.trim_start_matches('#')).unwrap(),
        None => schema,
    };
    match document {
        Value::Object(fields) => {
            for (key, value) in fields {
                let choices = ["oneOf", "anyOf"].iter().filter_map(|choice| schema[choice].as_array()).flatten();
                let property = choices.chain([schema]).map(|choice| &choice["properties"][key]).find(|p| !p.is_null());
                assert_described(root, property.unwrap_or_else(|| panic!("{key} is not in the schema")), value);
            }
        }
        Value::Array(entries) => entries.iter().for_each(|entry| assert_described(root, &schema["items"], entry)),
        _ => {}
    }
}

#[test]
fn a_broken_scenario_ends_with_code_2_and_names_the_field() {
    let good = preset(PresetId::JohanssonMinimumPhase);
    let with = |pointer: &str, value: Value| {
        let mut scenario: Value = serde_json::from_str(&good).unwrap();
        *scenario.pointer_mut(pointer).unwrap() = value;
        scenario.to_string().into_bytes()
    };
    let singular = {
        let mut scenario: Value = serde_json::from_str(&good).unwrap();
        scenario["setup"]["valves"] = json!([0.5, 0.5]);
        scenario["setup"]["operating_point"] = json!({ "levels": [0.1, 0.1] });
        scenario.to_string().into_bytes()
    };
    for (broken, message) in [
        (with("/setup/valves/0", json!(1.5)), "setup.valves[0]: 1.5 is outside 0 to 1"),
        (with("/setup/controller/loops/1/gain", json!("high")), "setup.controller.loops[1].gain: invalid type: string"),
        (with("/version", json!(7)), "version: 7 is unknown, this program reads 1 to 2"),
        (good.replace("3000.0", "1e999").into_bytes(), "setup.experiment.duration_s: number out of range"),
        (singular, "setup.operating_point: the plant is singular at steady state: gamma1 + gamma2 = 1"),
        (vec![b'['; 100_000], "the document is longer than 65536 bytes"),
        (vec![0xff, 0xfe, 0x00], "not UTF-8 text"),
        (Vec::new(), "document: EOF while parsing"),
    ] {
        for command in [&["analyse", "-"][..], &["simulate", "-"], &["plot", "-", "--svg", "-"]] {
            let output = pipe(command, &broken);
            let said = stderr(&output);
            assert_eq!(output.status.code(), Some(2), "{said}");
            assert!(said.starts_with("quadtank: standard input: ") && said.contains(message), "{said}");
            assert_eq!((said.lines().count(), output.stdout.len()), (1, 0), "{said}");
        }
    }
}

#[test]
fn a_wrong_command_ends_with_code_2() {
    for arguments in [
        &[][..],
        &["anlyse", "x.json"],
        &["analyse"],
        &["simulate", "-", "--format", "xml"],
        &["plot", "-"],
        &["presets", "johansson-1999"],
    ] {
        let output = run(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(stderr(&output).contains("Usage") || stderr(&output).contains("possible values"), "{arguments:?}");
    }
}

#[test]
fn a_file_that_cannot_be_read_or_written_ends_with_code_1() {
    let folder = folder("files");
    let missing = folder.join("missing.json");
    let output = run(&["analyse", missing.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(1));
    assert!(stderr(&output).contains("missing.json"), "{}", stderr(&output));
    let nowhere = folder.join("no-such-folder").join("chart.svg");
    let output =
        pipe(&["plot", "-", "--svg", nowhere.to_str().unwrap()], preset(PresetId::JohanssonMinimumPhase).as_bytes());
    assert_eq!(output.status.code(), Some(1));
    assert!(stderr(&output).contains("chart.svg"), "{}", stderr(&output));
}

#[test]
fn a_reader_that_stops_early_is_no_failure() {
    let folder = folder("pipe");
    let scenario = folder.join("scenario.json");
    fs::write(&scenario, preset(PresetId::JohanssonMinimumPhase)).unwrap();
    // The table is far longer than a pipe holds, so the program is still writing when the reader leaves.
    let mut child =
        quadtank().arg("simulate").arg(&scenario).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut start = [0; 10];
    child.stdout.take().unwrap().read_exact(&mut start).unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(&start, b"time_s,lev");
    assert!(output.status.success() && output.stderr.is_empty(), "{}", stderr(&output));
}

/// The lines of the README that start with `$ ` within its section on the command line, run in a shell in their order.
#[test]
fn the_examples_of_the_readme_work() {
    let readme = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/README.md")).unwrap();
    let commands: Vec<&str> =
        readme.lines().filter_map(|line| line.strip_prefix("$ ")).filter(|line| line.contains("quadtank ")).collect();
    let folder = folder("readme");
    let program = PathBuf::from(env!("CARGO_BIN_EXE_quadtank"));
    let path = format!("{}:{}", program.parent().unwrap().display(), std::env::var("PATH").unwrap_or_default());
    for subcommand in ["analyse", "simulate", "plot", "presets", "schema"] {
        let example = format!("quadtank {subcommand}");
        assert!(commands.iter().any(|command| command.contains(&example)), "no example of {example}");
    }
    for command in commands {
        let output = Command::new("sh").args(["-c", command]).current_dir(&folder).env("PATH", &path).output().unwrap();
        assert!(output.status.success() && output.stderr.is_empty(), "{command}\n{}", stderr(&output));
    }
}

fn case(name: &str) -> String {
    stdout(&run(&["cases", name]))
}

#[test]
fn cases_lists_every_published_case_and_tune_gives_its_gains() {
    let list = stdout(&run(&["cases"]));
    assert_eq!(list.lines().count(), 37);
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
    assert!(refused(&|t| t["plant"] = tank(json!({ "valves": [0.0, 0.6] }))).contains("singular"));
    let run_of_the_tank = preset(PresetId::JohanssonMinimumPhase);
    let output = pipe(&["tune", "-"], run_of_the_tank.as_bytes());
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("version 2"));
}
