//! The schema explains every field of a document of any version.

use serde_json::Value;

use super::{run, stdout};

fn schemas() -> impl Iterator<Item = Value> {
    ["1", "2", "3", "4"]
        .into_iter()
        .map(|version| serde_json::from_str(&stdout(&run(&["schema", "--version", version]))).unwrap())
}

/// Calls `visit` with every schema inside a schema, with its path.
fn walk<'a>(schema: &'a Value, path: &str, visit: &mut dyn FnMut(&str, &'a Value)) {
    visit(path, schema);
    for (name, property) in schema["properties"].as_object().into_iter().flatten() {
        walk(property, &format!("{path}.{name}"), visit);
    }
    if !schema["items"].is_null() {
        walk(&schema["items"], &format!("{path}[]"), visit);
    }
    for choice in ["oneOf", "anyOf"].into_iter().filter_map(|choice| schema[choice].as_array()).flatten() {
        walk(choice, path, visit);
    }
}

fn is_of(schema: &Value, name: &str) -> bool {
    schema["type"] == name || schema["type"].as_array().is_some_and(|names| names.iter().any(|of| of == name))
}

/// Asserts that every property of a schema has a description; how many there are.
pub fn described(schema: &Value) -> usize {
    let mut described = 0;
    walk(schema, "", &mut |path, schema| {
        for (name, property) in schema["properties"].as_object().into_iter().flatten() {
            let words = property["description"].as_str().unwrap_or_default();
            assert!(words.len() > 5, "{path}.{name} has no description");
            described += 1;
        }
    });
    described
}

#[test]
fn every_property_is_described() {
    for schema in schemas() {
        let described = described(&schema);
        assert!(described > 30, "{described}");
    }
}

#[test]
fn every_number_has_its_limits_and_every_list_its_length() {
    for schema in schemas() {
        walk(&schema, "", &mut |path, schema| {
            if is_of(schema, "number") || is_of(schema, "integer") {
                let limits = [&schema["minimum"], &schema["maximum"]].map(Value::as_f64);
                assert!(matches!(limits, [Some(least), Some(most)] if least <= most), "{path}: {schema}");
            }
            if is_of(schema, "array") {
                assert!(schema["maxItems"].is_u64(), "{path}: {schema}");
            }
        });
    }
}

#[test]
fn an_order_and_a_unit_are_told() {
    let [first, second, _, fourth] = &schemas().collect::<Vec<_>>()[..] else { panic!("four versions") };
    let text = |schema: &Value, start: &str| {
        let mut found = String::new();
        walk(schema, "", &mut |path, schema| {
            if path.ends_with(start) {
                found = schema["description"].as_str().unwrap_or_default().to_owned();
            }
        });
        found
    };
    assert!(text(second, "denominator").contains("by rising powers of s: [1, 10] is 1 + 10 s"));
    assert!(text(first, "setup.plant.parameters.rig.tanks[].height").ends_with("(m); from 0.01 to 10."));
    assert!(text(first, "setup.operating_point.levels").starts_with("Levels of tanks 1 and 2 at rest"));
    // The same path in another document is another number.
    assert!(text(second, "tuning.test.step").starts_with("Time between the rows"));
    assert!(text(fourth, "level_loop.test.step").starts_with("Step of the controller output"));
    assert!(text(fourth, "level_loop.experiment.duration_s").ends_with("(s); from 1 to 20000."));
    assert!(text(fourth, "actuator.curve").contains("by rising pressure"));
    assert!(text(first, "controller.pairing").contains("`swapped`: Level 1 – pump 2"));
}
