//! Documents in which, together, every field and every choice occurs.

use quadtank::plant::QuadrupleTank;
use quadtank_scenario::document_from_json;
use serde_json::{Value, json};

/// Files of versions 1, 3 and 4.
const FILES: [&str; 5] = [
    include_str!("../data/scenario-v1-own-rig.json"),
    include_str!("../data/scenario-v1-johansson.json"),
    include_str!("../data/everything-acts.json"),
    include_str!("../data/everything-acts-model-free.json"),
    include_str!("../data/everything-acts-level-loop.json"),
];

/// A run under the model-free law, and one with other valves, from empty tanks.
const MODEL_FREE: &str = include_str!("../../src/dictionary-3.jsonl");

/// Level loops with every kind of plant, controller and disturbance, which the dictionary has for the same reason, and one with PID.
const LEVEL_LOOPS: &str = include_str!("../../src/dictionary-4.jsonl");

/// A session on a published rig: a sequential test of two passes.
fn on_a_rig() -> Value {
    json!({
        "version": 2,
        "tuning": {
            "plant": { "quadruple_tank": {
                "preset": "johansson-2000-minimum-phase", "valves": [0.7, 0.6], "pairing": "diagonal",
                "dead_time_s": 5.0, "lag_s": 3.0, "nonlinear": false,
            } },
            "test": {
                "kind": "sequential", "number": 1, "behind": "nothing", "amplitudes": [1.0, 1.1],
                "hysteresis": [0.01, 0.02], "bias": [0.05, 0.06], "rule": "ziegler-nichols-pi", "detuning": [1.0, 1.0],
                "passes": 2, "duration": 300.0, "release": 4.0, "step": 0.1,
            },
            "design": {
                "critical": { "importance": 1.0 }, "method": "both-loci", "action": "pid", "target": [-0.3, -0.3],
                "root": 1, "decoupler": "none",
            },
            "response": { "references": [0.01, 0.02], "duration": 100.0, "step": 0.5, "compare": "nothing" },
        },
        "pinned": [],
    })
}

/// A session on transfer functions: a single test of a point with a modulus, which an element without dead time can have.
fn on_elements() -> Value {
    let element = |gain: f64, lag: f64, dead_time: f64| json!({ "numerator": [gain, 0.1], "denominator": [1.0, lag, 0.5 * lag], "dead_time": dead_time });
    let mut document = on_a_rig();
    let tuning = &mut document["tuning"];
    let rows =
        [[element(12.8, 16.7, 0.0), element(-18.9, 21.0, 3.0)], [element(6.6, 10.9, 7.0), element(-19.4, 14.4, 3.0)]];
    tuning["plant"] = json!({ "elements": rows });
    tuning["test"]["kind"] = json!("single");
    tuning["test"]["behind"] = json!({ "modulus": 0.5 });
    tuning["test"]["passes"] = json!(1);
    tuning["design"]["critical"] = json!({ "point": { "gains": [0.71, -0.264], "period": 12.7 } });
    tuning["design"]["decoupler"] = json!("static");
    tuning["response"]["compare"] = json!("ziegler-nichols");
    document
}

/// A session on the column of Wood and Berry with an independent test.
fn on_the_column() -> Value {
    let mut document = on_a_rig();
    let tuning = &mut document["tuning"];
    tuning["plant"] = json!({ "published": "wood-berry" });
    tuning["test"]["kind"] = json!("independent");
    tuning["test"]["passes"] = json!(1);
    tuning["test"]["detuning"] = json!([1.5, 2.0]);
    document
}

/// A session on the column with given controllers.
fn with_given_controllers() -> Value {
    let mut document = on_the_column();
    document["tuning"]["design"] = json!({
        "critical": { "point": { "gains": [0.71, -0.264], "period": 12.7 } }, "decoupler": "none",
        "controllers": [
            { "gain": 0.375, "integral_time": 8.29, "derivative_time": 0.5, "filter_time": 0.1 },
            { "gain": -0.075, "integral_time": 23.6, "derivative_time": 1.0, "filter_time": 0.3 },
        ],
        "pairing": "diagonal",
    });
    document
}

fn with_other_forms() -> Value {
    let mut document = with_given_controllers();
    document["tuning"]["design"]["controllers"] = json!([
        { "form": "series", "gain": 0.35, "integral_time": 8.29, "derivative_time": 0.5, "filter_time": 0.1 },
        { "form": "parallel", "gain": -0.075, "integral_gain": -0.003, "derivative_gain": -0.1, "filter_time": 0.3 },
    ]);
    document
}

/// Sessions on a rig of one's own: a sequential test on its linear model, and both relays on the nonlinear one.
pub fn on_own_rig() -> [Value; 2] {
    let own: Value = serde_json::from_str(include_str!("../data/everything-acts.json")).unwrap();
    let mut linear = on_a_rig();
    linear["tuning"]["plant"] = json!({ "parameters": {
        "rig": own["setup"]["plant"]["parameters"]["rig"], "pump_voltage": [5.0, 5.5], "pairing": "diagonal",
        "dead_time_s": 4.0, "lag_s": 2.0, "nonlinear": false,
    } });
    let mut nonlinear = linear.clone();
    nonlinear["tuning"]["test"]["kind"] = json!("simultaneous");
    nonlinear["tuning"]["test"]["passes"] = json!(1);
    nonlinear["tuning"]["design"]["critical"] = json!({ "point": { "gains": [30.0, 20.0], "period": 25.0 } });
    // Strong enough for walls and limits.
    nonlinear["tuning"]["test"]["amplitudes"] = json!([9.5, 9.8]);
    let plant = &mut nonlinear["tuning"]["plant"]["parameters"];
    for (name, value) in [("dead_time_s", json!(0.0)), ("lag_s", json!(0.0)), ("nonlinear", json!(true))] {
        plant[name] = value;
    }
    for pump in 0..2 {
        plant["rig"]["pumps"][pump]["delay_s"] = json!(0.0);
    }
    let rig: QuadrupleTank = serde_json::from_value(plant["rig"].clone()).unwrap();
    plant["pump_voltage"] = json!([9.0, 9.5]);
    for (tank, level) in rig.free_equilibrium([9.0, 9.5]).levels.into_iter().enumerate() {
        plant["rig"]["tanks"][tank]["height"] = json!(f64::max(1.01 * level, 0.0101));
    }
    [linear, nonlinear]
}

/// Sessions of version 2.
pub fn sessions() -> [Value; 5] {
    [on_a_rig(), on_elements(), on_the_column(), with_given_controllers(), with_other_forms()]
}

/// A run with a pump that is moved by hand.
pub fn by_hand() -> Value {
    let mut document: Value = serde_json::from_str(include_str!("../data/everything-acts.json")).unwrap();
    document["setup"]["experiment"]["pump_voltage_steps"] =
        json!([{ "pump": 0, "time_s": 5.0, "voltage": 4.0 }, { "pump": 0, "time_s": 20.0, "voltage": 5.0 }]);
    document
}

/// A run from a state that is not at rest.
pub fn from_a_state() -> Value {
    let mut document: Value = serde_json::from_str(include_str!("../data/everything-acts.json")).unwrap();
    document["setup"]["operating_point"] =
        json!({ "state": { "levels": [0.12, 0.13, 0.03, 0.02], "pump_voltage": [5.0, 5.5] } });
    document
}

/// All of them, each of which can be read.
pub fn all() -> Vec<Value> {
    let texts = FILES.into_iter().chain(MODEL_FREE.lines()).chain(LEVEL_LOOPS.lines());
    let documents: Vec<Value> = texts
        .map(|text| serde_json::from_str(text).unwrap())
        .chain(sessions())
        .chain(on_own_rig())
        .chain([by_hand(), from_a_state()])
        .collect();
    for document in &documents {
        assert!(document_from_json(&document.to_string()).is_ok(), "{:?}", document_from_json(&document.to_string()));
    }
    documents
}

/// What a document has that holds nothing else, with its path: numbers, flags, names and nulls.
pub fn leaves(value: &Value, path: &str) -> Vec<(String, Value)> {
    match value {
        Value::Object(fields) => fields
            .iter()
            .flat_map(|(name, value)| {
                leaves(value, &if path.is_empty() { name.clone() } else { format!("{path}.{name}") })
            })
            .collect(),
        Value::Array(items) => {
            items.iter().enumerate().flat_map(|(index, item)| leaves(item, &format!("{path}[{index}]"))).collect()
        }
        leaf => vec![(path.to_owned(), leaf.clone())],
    }
}

/// The JSON pointer of a path.
pub fn pointer(path: &str) -> String {
    format!("/{}", path.replace('[', ".").replace(']', "").replace('.', "/"))
}
