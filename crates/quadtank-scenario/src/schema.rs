//! The JSON Schema of documents and [reports](super::report): the shape from their types, what numbers of documents are from their
//! [rows](super::params).

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::{Map, Value, json};

use super::codec::DocumentKind;
use super::params::{List, Param, field_of};

type Object = Map<String, Value>;

/// The JSON Schema of the documents of a version; `None` for one that is not known.
pub fn schema_of(version: u32) -> Option<Value> {
    let shape = DocumentKind::of_version(version.into())?.shape;
    let mut schema = shape_by(SchemaSettings::draft2020_12(), shape);
    describe(&mut schema, "");
    let only = f64::from(version);
    merge(&mut schema["properties"]["version"], json!({ "minimum": only, "maximum": only }));
    Some(schema)
}

/// The JSON Schema of the [report](super::report) of a type.
pub fn schema_of_report<R: JsonSchema>() -> Value {
    let mut schema = shape_by(SchemaSettings::draft2020_12().for_serialize(), SchemaGenerator::root_schema_for::<R>);
    // No number of a report has a row: none is at this path.
    describe(&mut schema, "report");
    schema
}

fn shape_by(settings: SchemaSettings, shape: fn(&mut SchemaGenerator) -> Schema) -> Value {
    // Without references: one type stands at several places, whose numbers may have rows of their own.
    let settings = settings.with(|settings| settings.inline_subschemas = true);
    shape(&mut settings.into_generator()).to_value()
}

/// Adds limits and descriptions to the schema of the values at a path, which has `[]` for any index.
fn describe(schema: &mut Value, path: &str) {
    let Some(object) = schema.as_object_mut() else { return };
    join_names(object);
    name_null(object);
    limit(object, path);
    let described = object.get("description").cloned();
    if let Some(Value::Object(properties)) = object.get_mut("properties") {
        for (name, property) in properties {
            describe_property(property, &field_of(path, name), described.as_ref());
        }
    }
    if let Some(items) = object.get_mut("items") {
        describe(items, &format!("{path}[]"));
    }
    for choice in ["oneOf", "anyOf"] {
        if let Some(Value::Array(alternatives)) = object.get_mut(choice) {
            for alternative in alternatives {
                describe(alternative, path);
            }
        }
    }
}

/// A number, or a list of numbers or of such lists, is described by its row. What a choice contains, and has no words of its own, is described by
/// those of the choice.
fn describe_property(property: &mut Value, path: &str, choice: Option<&Value>) {
    describe(property, path);
    let row = ["", "[]", "[][]"].iter().find_map(|items| Param::at(&format!("{path}{items}")));
    if let Some(param) = row {
        merge(property, json!({ "description": words(param) }));
    } else if let (None, Some(choice)) = (property.get("description"), choice) {
        merge(property, json!({ "description": choice }));
    }
}

fn words(param: &Param) -> String {
    let Param { description, unit, limits, .. } = param;
    let unit = if unit.is_empty() { String::new() } else { format!(" ({unit})") };
    format!("{description}{unit}; from {} to {}.", limits.min, limits.max)
}

fn limit(object: &mut Object, path: &str) {
    if let Some(Param { limits, .. }) = Param::at(path) {
        // That a number is stored in 64 bits is nothing that a document has to know.
        object.remove("format");
        object.insert("minimum".to_owned(), json!(limits.min));
        object.insert("maximum".to_owned(), json!(limits.max));
    }
    if let Some(List { max, .. }) = List::at(path) {
        object.insert("maxItems".to_owned(), json!(max));
    }
}

/// What documentation of Rust calls `None` is null in JSON.
fn name_null(object: &mut Object) {
    if let Some(Value::String(description)) = object.get_mut("description") {
        *description = description.replace("`None`", "null");
    }
}

/// A choice between names alone becomes one list of names, with what they mean in one description.
fn join_names(object: &mut Object) {
    let Some(Value::Array(alternatives)) = object.get("oneOf") else { return };
    let named = |alternative: &Value| {
        let meaning = alternative.get("description").and_then(Value::as_str).unwrap_or_default();
        Some((alternative.get("const")?.clone(), format!("`{}`: {meaning}", alternative["const"].as_str()?)))
    };
    let Some((names, meanings)) = alternatives.iter().map(named).collect::<Option<(Vec<Value>, Vec<String>)>>() else {
        return;
    };
    let whole = object.get("description").and_then(Value::as_str).unwrap_or_default();
    let description = format!("{whole}\n\n{}", meanings.join("\n"));
    object.remove("oneOf");
    object.extend([
        ("type".to_owned(), json!("string")),
        ("enum".to_owned(), json!(names)),
        ("description".to_owned(), json!(description)),
    ]);
}

fn merge(schema: &mut Value, words: Value) {
    if let (Value::Object(schema), Value::Object(words)) = (schema, words) {
        schema.extend(words);
    }
}
