//! The commands on documents of the home bench, and what all commands share.

use std::fs;
use std::io::Read;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use approx::assert_relative_eq;
use quadtank::literature::PresetId;
use quadtank::study::quadruple_tank::setup_of;
use quadtank_scenario::{Scenario, from_json};
use serde_json::{Value, json};

use super::{assert_described, folder, pipe, preset, quadtank, run, stderr, stdout};

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
    let oracle: Value = serde_json::from_str(include_str!("../../../quadtank/tests/data/quadruple-tank.json")).unwrap();
    let case = |id: PresetId| oracle["cases"].as_array().unwrap().iter().find(|case| case["name"] == id.name());
    let known: Vec<_> = PresetId::ALL.into_iter().filter_map(|id| Some((id, case(id)?))).collect();
    assert_eq!(known.len(), 6);
    for (id, expected) in known {
        let report: Value = serde_json::from_str(&stdout(&pipe(&["analyse", "-"], preset(id).as_bytes()))).unwrap();
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
fn simulate_judges_every_step_of_a_published_sequence() {
    let output = pipe(&["simulate", "-", "--format", "json"], preset(PresetId::Seville).as_bytes());
    let run: Value = serde_json::from_str(&stdout(&output)).unwrap();
    for (steps, metrics) in [("steps", "metrics"), ("linear_steps", "linear_metrics")] {
        let steps = run[steps].as_array().unwrap();
        let places: Vec<_> = steps.iter().map(|step| (&step["level"], &step["time_s"], &step["window_s"])).collect();
        let expected =
            [(0, 3000.0), (1, 3000.0), (0, 6000.0), (1, 6000.0), (0, 9000.0)].map(|(l, t)| (json!(l), json!(t)));
        assert_eq!(places, expected.each_ref().map(|(level, time_s)| (level, time_s, &steps[0]["window_s"])));
        assert_eq!(steps[0]["window_s"], json!(3000.0));
        for (level, figure) in [(0, "overshoot"), (1, "overshoot"), (0, "settling_2_percent"), (1, "window_iae")] {
            assert_eq!(steps[level][figure], run[metrics][level][figure], "{figure}");
        }
        assert_relative_eq!(steps[4]["to"].as_f64().unwrap(), 0.9, max_relative = 1e-12);
    }
}

#[test]
fn plot_draws_every_chart_in_both_themes() {
    let folder = folder("plot");
    let scenario = folder.join("scenario.json");
    fs::write(&scenario, preset(PresetId::CocotaNonMinimumPhase)).unwrap();
    let mut drawings = Vec::new();
    for chart in ["responses", "valve-plane", "pole-zero", "frequency"] {
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
    assert_eq!(drawings.len(), 8);
    let output = run(&["plot", scenario.to_str().unwrap(), "--svg", "-"]);
    assert!(stdout(&output).starts_with("<svg "));
}

#[test]
fn schema_describes_what_presets_prints() {
    let schema: Value = serde_json::from_str(&stdout(&run(&["schema"]))).unwrap();
    assert_eq!(schema["title"], "Scenario");
    let scenario: Value = serde_json::from_str(&preset(PresetId::JohanssonMinimumPhase)).unwrap();
    assert_described(&schema, &schema, &scenario);
    let setup = &schema["properties"]["setup"]["properties"];
    assert_eq!(setup["valves"]["items"], json!({ "type": "number", "minimum": 0.0, "maximum": 1.0 }));
    assert_eq!(setup["controller"]["required"], json!(["pairing", "loops", "sampling_time_s"]));
    assert_eq!(setup["controller"]["properties"]["pairing"]["enum"], json!(["diagonal", "swapped"]));
    assert_eq!(schema["required"], json!(["version", "setup"]));
    assert_eq!(schema["properties"]["pinned"]["maxItems"], json!(8));
    assert_eq!(schema["properties"]["version"]["maximum"], json!(1.0));
    assert_eq!(schema["additionalProperties"], json!(false));
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
    let own_rig = include_str!("../../../quadtank-scenario/tests/data/scenario-v1-own-rig.json");
    let pulling = own_rig.replacen("\"voltage_min\": 0.0", "\"voltage_min\": -12.0", 1).into_bytes();
    for (broken, message) in [
        (with("/setup/valves/0", json!(1.5)), "setup.valves[0]: 1.5 is outside 0 to 1"),
        (pulling, "rig.pumps[0].voltage_min: -12 is outside 0 to 1000; pumps do not run backwards"),
        (with("/setup/controller/loops/1/gain", json!("high")), "setup.controller.loops[1].gain: invalid type: string"),
        (with("/version", json!(7)), "version: 7 is unknown, this program reads 1 to 4"),
        (good.replace("3000.0", "1e999").into_bytes(), "setup.experiment.duration_s: number out of range"),
        (singular, "setup.operating_point: the plant is singular at steady state: gamma1 + gamma2 = 1"),
        (vec![b'['; 9_000_000], "the document is longer than 8388608 bytes"),
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
    let readme = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../README.md")).unwrap();
    let commands: Vec<&str> =
        readme.lines().filter_map(|line| line.strip_prefix("$ ")).filter(|line| line.contains("quadtank ")).collect();
    let folder = folder("readme");
    let program = PathBuf::from(env!("CARGO_BIN_EXE_quadtank"));
    let path = format!("{}:{}", program.parent().unwrap().display(), std::env::var("PATH").unwrap_or_default());
    for subcommand in ["analyse", "simulate", "plot", "presets", "schema", "check"] {
        let example = format!("quadtank {subcommand}");
        assert!(commands.iter().any(|command| command.contains(&example)), "no example of {example}");
    }
    for command in commands {
        let output = Command::new("sh").args(["-c", command]).current_dir(&folder).env("PATH", &path).output().unwrap();
        assert!(output.status.success() && output.stderr.is_empty(), "{command}\n{}", stderr(&output));
    }
}
