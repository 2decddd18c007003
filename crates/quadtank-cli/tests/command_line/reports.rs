//! What commands print as JSON is what its schema says.

use quadtank::literature::PresetId;
use serde_json::{Value, json};

use super::schema::described;
use super::{pipe, preset, run, stderr, stdout};

/// What a command prints as JSON.
const REPORTS: [(&str, &[&str]); 3] =
    [("analyse", &["analyse", "-"]), ("simulate", &["simulate", "-", "--format", "json"]), ("tune", &["tune", "-"])];

fn parsed(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

/// The schema of what a command reports about documents of a version; `None` where it refuses them.
fn schema(report: &str, version: u64) -> Option<Value> {
    let output = run(&["schema", "--report", report, "--version", &version.to_string()]);
    output.status.success().then(|| parsed(&stdout(&output)))
}

/// Why a value is not what a schema says, with its path. Keys that the schema does not know are faults.
fn fault(schema: &Value, value: &Value, path: &str) -> Option<String> {
    let choices: Vec<&Value> = ["oneOf", "anyOf"].iter().filter_map(|name| schema[name].as_array()).flatten().collect();
    if !choices.is_empty() {
        let faults: Option<Vec<String>> = choices.iter().map(|choice| fault(choice, value, path)).collect();
        return faults.map(|faults| faults.join("; "));
    }
    let types = schema["type"].as_array().cloned().unwrap_or_else(|| vec![schema["type"].clone()]);
    let is_of = |name: &Value| match name.as_str() {
        Some("null") => value.is_null(),
        Some("boolean") => value.is_boolean(),
        Some("integer") => value.is_u64(),
        Some("number") => value.is_number(),
        Some("string") => value.is_string(),
        Some("array") => value.is_array(),
        Some("object") => value.is_object(),
        _ => false,
    };
    let is_named = schema["enum"].as_array().is_none_or(|names| names.contains(value));
    let is_constant = schema["const"].is_null() || schema["const"] == *value;
    if !(types.iter().any(is_of) && is_named && is_constant) {
        return Some(format!("{path}: {value}"));
    }
    match value {
        Value::Object(fields) => {
            let mut required = schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str);
            let missing =
                required.find(|name| !fields.contains_key(*name)).map(|name| format!("{path}.{name}: missing"));
            let of_field = |(name, value): (&String, &Value)| {
                let path = format!("{path}.{name}");
                match &schema["properties"][name] {
                    Value::Null => Some(format!("{path}: unknown")),
                    property => fault(property, value, &path),
                }
            };
            missing.or_else(|| fields.iter().find_map(of_field))
        }
        Value::Array(items) => {
            let length = items.len() as u64;
            let is_long = schema["maxItems"].as_u64().is_none_or(|most| length <= most)
                && schema["minItems"].as_u64().is_none_or(|least| length >= least);
            if !is_long {
                return Some(format!("{path}: {length} items"));
            }
            items.iter().find_map(|item| fault(&schema["items"], item, &format!("{path}[]")))
        }
        _ => None,
    }
}

/// Asserts that all reports about some documents of a version are what their schemas say.
fn assert_reported(version: u64, documents: &[Value]) {
    for (name, command) in REPORTS {
        let Some(schema) = schema(name, version) else { continue };
        for document in documents {
            let report = parsed(&stdout(&pipe(command, document.to_string().as_bytes())));
            assert_eq!(fault(&schema, &report, name), None, "{document}");
        }
    }
}

/// The documents of all published cases of a version.
fn cases(version: u64) -> Vec<Value> {
    let list = stdout(&run(&["cases"]));
    let names = list.lines().filter_map(|line| line.split(' ').next());
    names.map(|name| parsed(&stdout(&run(&["cases", name])))).filter(|case| case["version"] == json!(version)).collect()
}

/// A document with values at pointers.
fn with(document: &Value, values: &[(&str, Value)]) -> Value {
    let mut document = document.clone();
    for (pointer, value) in values {
        *document.pointer_mut(pointer).unwrap() = value.clone();
    }
    document
}

#[test]
fn reports_about_the_quadruple_tank_are_what_their_schemas_say() {
    let mut documents = PresetId::ALL.map(|id| parsed(&preset(id))).to_vec();
    let first = documents[0].clone();
    documents.extend([
        // Without zeros, relative gain or margins; overflowing; without a step.
        with(&first, &[("/setup/valves", json!([1.0, 0.0]))]),
        with(&first, &[("/setup/valves", json!([0.3, 0.7]))]),
        with(&first, &[("/setup/valves", json!([0.0, 0.0])), ("/setup/experiment/set_point_steps", json!([]))]),
        with(&first, &[("/setup/experiment/set_point_steps/0/size", json!(1e-10))]),
        // On the border of stability; after the end; not at rest; noisy.
        with(&first, &[("/setup/valves", json!([0.625, 0.375]))]),
        with(&first, &[("/setup/experiment/set_point_steps/0/time_s", json!(4000.0))]),
        with(&first, &[("/setup/experiment/set_point_steps/1/time_s", json!(120.0))]),
        with(&first, &[("/setup/experiment/measurement/noise_std", json!(1e-3))]),
    ]);
    assert_reported(1, &documents);
}

#[test]
fn reports_about_relay_tuning_are_what_their_schemas_say() {
    let mut documents = cases(2);
    assert_eq!(documents.len(), 41);
    let case = documents[0].clone();
    // Given controllers on a plant without an ultimate point, and in an open loop.
    documents.extend(["importance", "open"].map(|what| {
        let gain = if what == "open" { 0.0 } else { 1.0 };
        let lag = |gain: f64| json!({ "numerator": [gain], "denominator": [1, 10] });
        let plant = json!({ "elements": [[lag(2.0), lag(0.5)], [lag(-0.5), lag(1.0)]] });
        let given = json!({ "controllers": [{ "gain": gain, "integral_time": 5 }, { "gain": gain }] });
        with(&case, &[("/tuning/plant", plant), ("/tuning/design", given)])
    }));
    let element = |gain: f64| json!({ "numerator": [gain], "denominator": [1, 10, 20], "dead_time": 0 });
    let elements = |gains: [f64; 4]| {
        let [g11, g12, g21, g22] = gains.map(element);
        json!({ "elements": [[g11, g12], [g21, g22]] })
    };
    for kind in ["single", "independent", "sequential", "simultaneous"] {
        documents.extend([
            with(&case, &[("/tuning/test/kind", json!(kind)), ("/tuning/response/compare", json!("full"))]),
            // Relays that chatter, controllers without integral action, and a curve with real poles and no limits at all.
            with(
                &case,
                &[
                    ("/tuning/test/kind", json!(kind)),
                    ("/tuning/test/rule", json!("ziegler-nichols-p")),
                    ("/tuning/plant", elements([1.0, 2.0, 1.5, 1.0])),
                    ("/tuning/design/critical", json!({ "importance": 1 })),
                ],
            ),
        ]);
    }
    assert_reported(2, &documents);
    // Loops without a gain of their own have no curve, and no design.
    let report = pipe(
        &["analyse", "-"],
        with(&case, &[("/tuning/plant", elements([0.0, 1.0, 1.0, 0.0]))]).to_string().as_bytes(),
    );
    let report = parsed(&stdout(&report));
    assert_eq!(report["critical_curve"]["error"], json!("no-own-gain"));
    assert_eq!(fault(&schema("analyse", 2).unwrap(), &report, ""), None);
}

#[test]
fn reports_about_model_free_control_are_what_their_schemas_say() {
    let mut documents = cases(3);
    assert_eq!(documents.len(), 9);
    let compared = parsed(&preset(PresetId::JunqueiraA))["setup"]["controller"].clone();
    let mut with_comparison = documents[0].clone();
    with_comparison["model_free"]["compare"] = compared;
    let mut noisy = with_comparison.clone();
    noisy["model_free"]["experiment"]["measurement"]["noise_std"] = json!(1e-4);
    documents.extend([with_comparison, noisy]);
    assert_reported(3, &documents);
}

#[test]
fn reports_about_level_loops_are_what_their_schemas_say() {
    let mut documents = cases(4);
    assert_eq!(documents.len(), 10);
    let case = documents[0].clone();
    let parameters = |change: &dyn Fn(&mut Value)| {
        let text = include_str!("../../../quadtank-scenario/tests/data/everything-acts-level-loop.json");
        let mut document = parsed(text);
        change(&mut document["level_loop"]);
        document
    };
    documents.extend([
        parameters(&|_| {}),
        // Integrating; a quick valve that is closed; an empty tank; by hand, with a test that never settles.
        parameters(&|setup| setup["plant"]["parameters"]["tank"]["outflow"] = json!({ "pumped": { "flow": 0.03 } })),
        with(&case, &[("/level_loop/objective", json!({ "averaging": { "band": [0.99, 1.01] } }))]),
        with(&case, &[("/level_loop/controller", json!({ "manual": { "steps": [{ "time_s": 0, "size": 20 }] } }))]),
        with(&case, &[("/level_loop/test/duration_s", json!(900.0))]),
        with(&case, &[("/level_loop/test/level", json!(50.0))]),
        with(&case, &[("/level_loop/experiment/disturbance/signal", json!("none"))]),
        with(&case, &[("/level_loop/controller/pi/gain", json!(200.0))]),
        with(&case, &[("/level_loop/controller/pi/gain", json!(0))]),
        with(&case, &[("/level_loop/harris", json!({ "dead_time_rows": 400, "order": 50 }))]),
    ]);
    // Plants, controllers and disturbances of every kind.
    documents.extend(include_str!("../../../quadtank-scenario/src/dictionary-4.jsonl").lines().map(parsed));
    assert_reported(4, &documents);
    // Where nothing can be held, analyse says so in place; the other two refuse.
    let out = with(&case, &[("/level_loop/experiment/level", json!(0.0))]);
    let report = parsed(&stdout(&pipe(&["analyse", "-"], out.to_string().as_bytes())));
    assert_eq!(report["rest"]["error"], json!("valve-out-of-reach"));
    assert_eq!(fault(&schema("analyse", 4).unwrap(), &report, ""), None);
}

#[test]
fn a_report_that_is_not_what_its_schema_says_is_found() {
    let schema = schema("analyse", 1).unwrap();
    let report = parsed(&stdout(&pipe(&["analyse", "-"], preset(PresetId::JohanssonMinimumPhase).as_bytes())));
    for (pointer, value) in [
        ("/poles/0/re", json!("high")),
        ("/zeros/0/value", json!({ "re": 1.0 })),
        ("/niederlinski", json!({ "diagonal": null, "swapped": 1.0, "both": 2.0 })),
        ("/dc_gain", json!([[1.0, 2.0]])),
        ("/suggestion/reason/rule", json!("none")),
        ("/closed_loop/stability", json!("unknown")),
    ] {
        assert!(fault(&schema, &with(&report, &[(pointer, value)]), "").is_some(), "{pointer}");
    }
}

#[test]
fn every_property_of_a_report_is_described() {
    for (name, _) in REPORTS {
        for schema in (1..=4).filter_map(|version| schema(name, version)) {
            let described = described(&schema);
            assert!(described > 15, "{name}: {described}");
            assert!(!schema.to_string().contains("[`"), "{name}: a link of rustdoc");
        }
    }
}

#[test]
fn tune_reports_on_relay_tuning_and_level_loops() {
    assert_eq!(Some(parsed(&stdout(&run(&["schema", "--report", "tune"])))), schema("tune", 2));
    assert_eq!(schema("simulate", 2), schema("tune", 2));
    let refused = run(&["schema", "--report", "tune", "--version", "3"]);
    assert_eq!((refused.status.code(), refused.stdout.len()), (Some(2), 0));
    assert_eq!(stderr(&refused).lines().count(), 1);
    assert!(stderr(&refused).contains("versions 2 and 4; this is version 3"), "{}", stderr(&refused));
}
