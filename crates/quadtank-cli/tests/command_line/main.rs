//! The command line as a reader of the README uses it: every example there, the exit codes, and what goes wrong.

mod documents;
mod elements;
mod export;
mod lessons;
mod level_loop;
mod model_free;
mod quadruple;
mod quantities;
mod record;
mod reports;
mod schema;
mod set;
mod tables;
mod tuning;

use std::fs;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

use quadtank::literature::PresetId;
use serde_json::Value;

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

/// What a schema refers to, or itself.
fn resolved<'a>(root: &'a Value, schema: &'a Value) -> &'a Value {
    match schema["$ref"].as_str() {
        Some(reference) => root.pointer(reference.trim_start_matches('#')).unwrap(),
        None => schema,
    }
}

/// Every key of a document has its property in the schema, in depth.
fn assert_described(root: &Value, schema: &Value, document: &Value) {
    let schema = resolved(root, schema);
    match document {
        Value::Object(fields) => {
            for (key, value) in fields {
                let choices = ["oneOf", "anyOf"].iter().filter_map(|choice| schema[choice].as_array()).flatten();
                let choices = choices.map(|choice| resolved(root, choice));
                let property = choices.chain([schema]).map(|choice| &choice["properties"][key]).find(|p| !p.is_null());
                assert_described(root, property.unwrap_or_else(|| panic!("{key} is not in the schema")), value);
            }
        }
        Value::Array(entries) => entries.iter().for_each(|entry| assert_described(root, &schema["items"], entry)),
        _ => {}
    }
}
