//! What holds of documents of every version: whatever stands in them is read or named.

use proptest::prelude::*;
use proptest::sample::Index;
use quadtank_scenario::tuning::TuningScenario;
use quadtank_scenario::{Document, ScenarioError, document_from_json, to_json};
use serde_json::Value;

/// Documents of all versions in which most fields occur.
fn documents() -> Vec<Value> {
    let rich = |line: &str| serde_json::from_str(line).unwrap();
    let own_rig = include_str!("../data/scenario-v1-own-rig.json");
    let own_loop = include_str!("../data/everything-acts-level-loop.json");
    let [session, model_free] = [
        to_json(&TuningScenario::default()).unwrap(),
        include_str!("../../src/dictionary-3.jsonl").lines().next().unwrap().to_owned(),
    ];
    vec![rich(own_rig), rich(&session), rich(&model_free), rich(own_loop)]
}

/// JSON pointers to all values of a document.
fn pointers(value: &Value, at: &str) -> Vec<String> {
    let inside: Vec<(String, &Value)> = match value {
        Value::Object(fields) => fields.iter().map(|(key, value)| (format!("{at}/{key}"), value)).collect(),
        Value::Array(items) => items.iter().enumerate().map(|(i, value)| (format!("{at}/{i}"), value)).collect(),
        _ => Vec::new(),
    };
    inside.into_iter().flat_map(|(at, value)| [pointers(value, &at), vec![at]].concat()).collect()
}

fn written(document: &Document) -> Result<String, ScenarioError> {
    match document {
        Document::Quadruple(scenario) => to_json(scenario),
        Document::Tuning(scenario) => to_json(scenario),
        Document::ModelFree(scenario) => to_json(scenario),
        Document::LevelLoop(scenario) => to_json(scenario),
    }
}

proptest! {
    /// Anything in the place of any value: it is refused with the name of a field, or read and written again.
    #[test]
    fn whatever_stands_anywhere_is_read_or_named(
        version in 0..4_usize,
        place in any::<Index>(),
        other in any::<Index>(),
        put in prop::sample::select(vec!["null", "true", "-1", "7", "1e-3", "1e300", "\"off\"", "[]", "[0, 0]", "{}", "{\"manual\": 1}"]),
        copies in any::<bool>(),
    ) {
        let mut document = documents().swap_remove(version);
        let places = pointers(&document, "");
        let put = if copies {
            document.pointer(&places[other.index(places.len())]).cloned().unwrap()
        } else {
            serde_json::from_str(put).unwrap()
        };
        *document.pointer_mut(&places[place.index(places.len())]).unwrap() = put;
        if let Ok(read) = document_from_json(&document.to_string()) {
            prop_assert_eq!(document_from_json(&written(&read).unwrap()), Ok(read));
        }
    }

    /// A field that is left out is named, unless it may be absent; then the document can be written.
    #[test]
    fn a_field_that_is_left_out_is_named_or_spare(version in 0..4_usize, place in any::<Index>()) {
        let mut document = documents().swap_remove(version);
        let places = pointers(&document, "");
        let (parent, name) = places[place.index(places.len())].rsplit_once('/').unwrap();
        if let Some(Value::Object(fields)) = document.pointer_mut(parent) {
            fields.remove(name);
            match document_from_json(&document.to_string()) {
                Ok(read) => prop_assert!(written(&read).is_ok()),
                Err(ScenarioError::Malformed { reason, .. }) => {
                    let is_choice = reason == "invalid length 0, expected one choice";
                    prop_assert!(is_choice || reason == format!("missing field `{name}`"), "{}", reason);
                }
                Err(error) => prop_assert!(false, "{}", error),
            }
        }
    }
}
