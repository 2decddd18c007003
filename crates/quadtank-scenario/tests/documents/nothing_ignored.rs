//! Nothing is accepted and ignored: whatever is changed in a document changes an answer, or a warning, or is refused.

use quadtank::study::Study;
use quadtank::study::level_loop::{
    ContourMap, ContourSettings, LevelLoopSetup, LevelLoopStudy, Results, run_level_loop,
};
use quadtank::study::model_free::{analyse_model_free, run_model_free};
use quadtank::study::quadruple_tank::{analyse, run};
use quadtank::study::relay_tuning::tune;
use quadtank_scenario::tuning::warnings;
use quadtank_scenario::{Document, document_from_json, level_loop};
use serde_json::{Value, json};

use super::examples::{by_hand, leaves, on_own_rig, pointer, sessions};

/// What is meant to change no answer, by the beginning or the end of its path, and why.
const EXCEPTIONS: [(&str, &str); 6] = [
    ("display_unit", "the unit that a page shows levels in; answers are in SI"),
    ("parameters.rig.valves", "a rig is written with its valves, and those of the setup take their place"),
    ("transmitter.signal.unit", "the name of a unit: a gain is signal per signal, whatever their units"),
    ("output.unit", "likewise, of the pressure in the actuator"),
    ("cursor_s", "what a page shows"),
    ("version", "it is what all else is read by, and another one is another kind of document"),
];

/// Names of choices without content. A name that a field does not know is refused.
const NAMES: [&str; 62] = [
    "isa",
    "series",
    "parallel",
    "automatic",
    "off",
    "conditional",
    "diagonal",
    "swapped",
    "cm",
    "mm",
    "block",
    "sliding",
    "rectangular",
    "trapezoidal",
    "applied",
    "commanded",
    "empty",
    "single",
    "independent",
    "sequential",
    "simultaneous",
    "nothing",
    "integrator",
    "one-locus",
    "both-loci",
    "pi",
    "pid",
    "none",
    "static",
    "dynamic",
    "first-output",
    "second-output",
    "ziegler-nichols",
    "tyreus-luyben",
    "full",
    "ziegler-nichols-p",
    "ziegler-nichols-pi",
    "ziegler-nichols-pid",
    "tyreus-luyben-pi",
    "tyreus-luyben-pid",
    "process-two",
    "junqueira-case-b",
    "andreis",
    "andreis-uncertain",
    "lecture-slides",
    "linear",
    "quick_opening",
    "outlet",
    "two_point",
    "ramp",
    "tight",
    "test",
    "local",
    "level",
    "signal",
    "level_variance",
    "outflow_variance",
    "iae",
    "ise",
    "itae",
    "milliampere",
    "psi",
];

/// Everything that is computed from a document.
fn answers(document: &Document) -> String {
    match document {
        Document::Quadruple(scenario) => format!("{:?} {:?}", analyse(&scenario.setup), run(&scenario.setup)),
        Document::Tuning(scenario) => format!("{:?} {:?}", tune(&scenario.tuning), warnings(&scenario.tuning)),
        Document::ModelFree(scenario) => {
            let setup = &scenario.model_free;
            format!("{:?} {:?}", analyse_model_free(setup), run_model_free(setup))
        }
        Document::LevelLoop(scenario) => answers_of_level_loop(&scenario.level_loop),
    }
}

/// Run, test, suggestions, warnings, and what a search would compute.
fn answers_of_level_loop(setup: &LevelLoopSetup) -> String {
    let Results { plant, test, suggestions, answer, .. } = LevelLoopStudy::update(setup, &[], None);
    let map = ContourMap::new(setup, ContourSettings { size: [3, 3] }).map(|mut map| {
        map.advance(9);
        (0..9).map(|cell| (map.settings_of(cell), map.cells()[cell])).collect::<Vec<_>>()
    });
    let clipped: Vec<_> = suggestions.iter().map(|suggestion| suggestion.clipped(setup)).collect();
    format!("{plant:?} {test:?} {clipped:?} {answer:?} {map:?} {:?}", level_loop::warnings(setup))
}

fn is_answered(document: &Document) -> bool {
    match document {
        Document::Quadruple(scenario) => run(&scenario.setup).is_ok(),
        Document::Tuning(scenario) => tune(&scenario.tuning).is_ok_and(|tuning| tuning.design.is_some()),
        Document::ModelFree(scenario) => run_model_free(&scenario.model_free).is_ok(),
        Document::LevelLoop(scenario) => run_level_loop(&scenario.level_loop).is_ok(),
    }
}

/// Other values that may stand in the place of one.
fn others(value: &Value) -> Vec<Value> {
    match value {
        Value::Bool(flag) => vec![json!(!flag)],
        Value::String(name) => NAMES.iter().filter(|other| *other != name).map(|name| json!(name)).collect(),
        Value::Number(number) if number.is_u64() => {
            let whole = number.as_u64().unwrap();
            [whole + 1, whole.saturating_sub(1)].into_iter().filter(|&w| w != whole).map(|w| json!(w)).collect()
        }
        Value::Number(number) => {
            let number = number.as_f64().unwrap();
            vec![json!(number * 1.25 + 0.001), json!(number * 0.5), json!(number + 1.0), json!(0.0)]
        }
        _ => Vec::new(),
    }
}

/// Fields of documents of one kind of which no change changes an answer in any of them, though one is accepted.
fn ignored(documents: &[Value]) -> Vec<String> {
    let fields = documents.iter().map(idle).collect::<Vec<_>>();
    fields[0].iter().filter(|path| fields.iter().all(|idle| idle.contains(path))).cloned().collect()
}

/// Fields of a document of which no change changes an answer.
fn idle(document: &Value) -> Vec<String> {
    let before = answers(&document_from_json(&document.to_string()).unwrap());
    assert!(is_answered(&document_from_json(&document.to_string()).unwrap()), "{before}");
    let acts = |path: &str, value: Value| {
        let mut changed = document.clone();
        *changed.pointer_mut(&pointer(path)).unwrap() = value;
        document_from_json(&changed.to_string()).ok().map(|changed| answers(&changed) != before)
    };
    let is_exception = |path: &str| EXCEPTIONS.iter().any(|(name, _)| path.split('[').next().unwrap().ends_with(name));
    let fields = leaves(document, "").into_iter().filter(|(path, _)| !is_exception(path));
    let is_idle = |(path, value): (String, Value)| {
        let mut tried = others(&value).into_iter().filter_map(|other| acts(&path, other)).peekable();
        (tried.peek().is_some() && !tried.any(|acts| acts)).then_some(path)
    };
    fields.filter_map(is_idle).collect()
}

fn parsed(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

/// A run in which everything acts, and the same run driven to its limits: pumps stop and run at full speed, sensors saturate and
/// all tanks overflow.
fn run_and_driven(text: &str) -> [Value; 2] {
    let calm = parsed(text);
    let mut driven = calm.clone();
    let setup = driven.as_object_mut().unwrap().values_mut().find(|value| value.is_object()).unwrap();
    let rig = &mut setup["plant"]["parameters"]["rig"];
    for tank in 0..4 {
        rig["tanks"][tank]["height"] = json!(if tank < 2 { 0.08 } else { 0.06 });
    }
    rig["sensor"]["range"] = json!(0.05);
    setup["experiment"]["set_point_steps"] = json!([
        { "level": 0, "time_s": 2.0, "size": 0.2 },
        { "level": 1, "time_s": 12.0, "size": 0.2 },
        { "level": 0, "time_s": 40.0, "size": -2.0 },
        { "level": 1, "time_s": 40.0, "size": -2.0 },
        { "level": 0, "time_s": 50.0, "size": 1.8 },
        { "level": 1, "time_s": 50.0, "size": 1.8 },
    ]);
    [calm, driven]
}

#[test]
fn in_a_run_of_the_tank() {
    assert_eq!(ignored(&run_and_driven(include_str!("../data/everything-acts.json"))), [""; 0]);
}

/// A pump that is moved by hand leaves the settings of its loop idle, so this is a document of its own.
#[test]
fn in_a_run_with_a_pump_by_hand() {
    let idle = idle(&by_hand());
    assert!(idle.iter().all(|path| !path.contains("pump_voltage_steps")), "{idle:?}");
    assert!(idle.iter().any(|path| path.contains("controller.loops")), "{idle:?}");
}

#[test]
fn in_a_run_under_the_model_free_law() {
    assert_eq!(ignored(&run_and_driven(include_str!("../data/everything-acts-model-free.json"))), [""; 0]);
}

/// Every test has a rule and two amplitudes, of which a single one uses one: no value of the others says that they are not meant, so
/// there is nothing to warn of.
const IDLE_IN_A_SINGLE_TEST: [&str; 2] = ["tuning.test.amplitudes[1]", "tuning.test.rule"];

/// A level loop, and the same with a disturbance and a step of the set-point that drive it to its limits and back.
fn loop_and_driven(calm: Value) -> [Value; 2] {
    let mut driven = calm.clone();
    let experiment = &mut driven["level_loop"]["experiment"];
    let [low, high] = [-8.0, 5.0].map(|size| json!({ "time_s": if size < 0.0 { 100 } else { 60 }, "size": size }));
    experiment["set_point_steps"] = json!([high, low]);
    for signal in experiment["disturbance"]["signal"].as_object_mut().unwrap().values_mut() {
        for size in ["size", "amplitude", "std"] {
            if let Some(size) = signal.get_mut(size) {
                *size = json!(8.0 * size.as_f64().unwrap());
            }
        }
    }
    [calm, driven]
}

#[test]
fn in_level_loops() {
    let first = parsed(include_str!("../data/everything-acts-level-loop.json"));
    let with = |change: &dyn Fn(&mut Value)| {
        let mut document = first.clone();
        change(&mut document["level_loop"]);
        document
    };
    let loops = [
        first.clone(),
        with(&|setup| {
            setup["controller"] = json!({ "pi": {
                "gain": 2.0, "integral_time_s": 60.0, "anti_windup": { "back_calculation": { "tracking_ratio": 0.5 } },
            } });
            setup["plant"]["parameters"]["tank"]["outflow"] = json!({ "linear": { "resistance": 35.0 } });
            setup["test"]["method"] = json!({ "one_point": { "dead_time_s": 3.0 } });
            setup["experiment"]["disturbance"]["signal"] = json!({ "sine": { "amplitude": 0.004, "period_s": 37.0 } });
            setup["objective"] = json!("tight");
            setup["search"]["keep_band"] = json!(false);
        }),
        with(&|setup| {
            setup["controller"] = json!({ "pid": {
                "proportional": 2.0, "integral": 0.02, "derivative": 4.0, "filter_time_s": 1.0,
            } });
            setup["plant"]["parameters"]["tank"]["outflow"] = json!({ "pumped": { "flow": 0.03 } });
            setup["test"]["method"] = json!("ramp");
            // So small that the tank does not fill, in which case no method reads a model.
            setup["test"]["step"] = json!(0.05);
            let random = json!({ "simulink_normal": { "std": 0.003, "sample_time_s": 2.0, "seed": 0 } });
            setup["experiment"]["disturbance"]["signal"] = random;
        }),
        with(&|setup| {
            setup["controller"] = json!({ "manual": { "steps": [
                { "time_s": 10.0, "size": 0.5 }, { "time_s": 120.0, "size": -30.0 }, { "time_s": 200.0, "size": 60.0 },
            ] } });
            setup["plant"]["parameters"]["actuator"]["curve"] = json!([[3.0, 0.0], [8.0, 0.3], [15.0, 1.0]]);
            setup["plant"]["parameters"]["valve"] =
                json!({ "characteristic": "linear", "place": { "inlet": { "full_flow": 0.04 } } });
            setup["experiment"]["disturbance"]["signal"] = json!({ "step": { "size": 0.003 } });
        }),
    ];
    for calm in loops {
        let controller = calm["level_loop"]["controller"].to_string();
        assert_eq!(ignored(&loop_and_driven(calm)), [""; 0], "{controller}");
    }
}

#[test]
fn in_relay_tuning_sessions() {
    for session in sessions() {
        let test = &session["tuning"]["test"];
        let expected = if test["kind"] == "single" { &IDLE_IN_A_SINGLE_TEST[..] } else { &[] };
        let test = test.to_string();
        assert_eq!(ignored(&[session]), expected, "{test}");
    }
}

/// What a session has no use for stays with its rig, which goes back to the home bench with the gains: what its controllers are ahead of
/// (they act on voltages of pumps), and what limits a measured signal.
const IDLE_ON_OWN_RIG: [&str; 3] = [
    "tuning.plant.parameters.rig.power_gain",
    "tuning.plant.parameters.rig.sensor.range",
    "tuning.plant.parameters.rig.sensor.resolution",
];

#[test]
fn in_relay_tuning_sessions_on_a_rig_of_ones_own() {
    assert_eq!(ignored(&on_own_rig()), IDLE_ON_OWN_RIG);
}

/// What a document shows beside its run, and earlier runs beside it, change no answer.
#[test]
fn what_is_only_shown_is_not_computed() {
    let document = parsed(include_str!("../data/scenario-v1-own-rig.json"));
    let before = answers(&document_from_json(&document.to_string()).unwrap());
    let mut bare = document.clone();
    let fields = bare.as_object_mut().unwrap();
    assert!(fields.remove("view").is_some() && fields.remove("pinned").is_some());
    assert_eq!(answers(&document_from_json(&bare.to_string()).unwrap()), before);
}
