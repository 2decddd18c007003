//! The table of parameters and the documents agree.

use std::collections::BTreeSet;

use quadtank_scenario::params::{LISTS, List, PARAMS, Param};
use quadtank_scenario::{ScenarioError, document_from_json};
use serde_json::Value;

use super::examples::{all, leaves, pointer};

#[test]
fn every_number_of_a_document_has_a_row() {
    for document in all() {
        for (path, leaf) in leaves(&document, "").into_iter().filter(|(_, leaf)| !leaf.is_null()) {
            assert_eq!(Param::at(&path).is_some(), leaf.is_number(), "{path}: {leaf}");
        }
    }
}

#[test]
fn every_row_is_that_of_a_number_of_a_document() {
    let numbers = all().into_iter().flat_map(|document| leaves(&document, "")).filter(|(_, leaf)| leaf.is_number());
    let met: BTreeSet<&str> = numbers.filter_map(|(path, _)| Param::at(&path)).map(|param| param.path).collect();
    for param in PARAMS {
        assert!(met.contains(param.path), "{} matches no number", param.path);
    }
}

#[test]
fn every_limited_list_is_that_of_a_document() {
    fn lists(value: &Value, path: &str) -> Vec<&'static str> {
        let inside: Vec<_> = match value {
            Value::Object(fields) => fields.iter().map(|(name, value)| (format!("{path}.{name}"), value)).collect(),
            Value::Array(items) => items.iter().map(|item| (format!("{path}[0]"), item)).collect(),
            _ => Vec::new(),
        };
        let here = List::at(path.trim_start_matches('.')).map(|list| list.path);
        inside.iter().flat_map(|(path, value)| lists(value, path)).chain(here).collect()
    }
    let met: BTreeSet<&str> = all().iter().flat_map(|document| lists(document, "")).collect();
    assert_eq!(met, LISTS.iter().map(|list| list.path).collect());
}

/// Whatever the number, beyond the limits of its row it is refused by its path, with limits at most as wide.
#[test]
fn every_number_beyond_its_row_is_refused_by_its_path() {
    for document in all() {
        for (path, leaf) in leaves(&document, "") {
            // Another version would be another document.
            let Some(Param { limits, .. }) = Param::at(&path).filter(|_| path != "version") else { continue };
            let whole = leaf.is_u64();
            for beyond in [limits.min - 1.0, 2.0 * limits.max + 1.0] {
                let put: Value = serde_json::from_str(&beyond.to_string()).unwrap();
                let mut changed = document.clone();
                *changed.pointer_mut(&pointer(&path)).unwrap() = put;
                match document_from_json(&changed.to_string()) {
                    Err(ScenarioError::OutOfRange { field, value, min, max }) => {
                        assert_eq!((&field, value), (&path, beyond));
                        assert!(limits.min <= min && max <= limits.max, "{path}: {min} to {max}");
                    }
                    Err(ScenarioError::Malformed { path: field, reason }) if whole => {
                        assert!(field == path && reason.ends_with("expected a whole number"), "{path}: {reason}");
                    }
                    other => panic!("{path} = {beyond}: {other:?}"),
                }
            }
        }
    }
}
