//! JSON by the parser of the browser, which is there anyway: the one of the core, with its tables for numbers, would be 10 KB of
//! transfer. It takes the last of two fields of one name, where the core refuses both.

use js_sys::{Array, Error, JSON, Object};
use leptos::wasm_bindgen::{JsCast, JsValue};

use crate::scenario::{DOCUMENT_LIMIT, Document, ScenarioError, Tree, document_from_tree};

/// Deepest nesting that is followed: more than any document has.
const DEEPEST: u32 = 64;
/// Whole numbers up to this size are exact in JavaScript.
const LARGEST_WHOLE: f64 = 9_007_199_254_740_992.0;

/// Reads a document.
pub fn read(text: &str) -> Result<Document, ScenarioError> {
    if text.len() > DOCUMENT_LIMIT {
        return Err(ScenarioError::TooLong { length: text.len(), max: DOCUMENT_LIMIT });
    }
    let malformed = |reason: String| ScenarioError::Malformed { path: "document".to_owned(), reason };
    let value = JSON::parse(text).map_err(|error| malformed(error.unchecked_into::<Error>().message().into()))?;
    let tree = tree_of(&value, DEEPEST).ok_or_else(|| malformed("nested too deeply".to_owned()))?;
    document_from_tree(&tree)
}

fn tree_of(value: &JsValue, depth: u32) -> Option<Tree> {
    let depth = depth.checked_sub(1)?;
    Some(if let Some(number) = value.as_f64() {
        number_of(number)
    } else if let Some(text) = value.as_string() {
        Tree::Text(text)
    } else if let Some(truth) = value.as_bool() {
        Tree::Bool(truth)
    } else if let Some(list) = value.dyn_ref::<Array>() {
        Tree::List(list.iter().map(|item| tree_of(&item, depth)).collect::<Option<_>>()?)
    } else if let Some(object) = value.dyn_ref::<Object>() {
        let entry = |pair: JsValue| {
            let pair: Array = pair.unchecked_into();
            Some((pair.get(0).as_string()?, tree_of(&pair.get(1), depth)?))
        };
        Tree::Map(Object::entries(object).iter().map(entry).collect::<Option<_>>()?)
    } else {
        Tree::Null
    })
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole and not too large")]
fn number_of(number: f64) -> Tree {
    if number.fract() != 0.0 || number.abs() > LARGEST_WHOLE {
        Tree::Float(number)
    } else if number >= 0.0 {
        Tree::Unsigned(number as u64)
    } else {
        Tree::Signed(number as i64)
    }
}
