use serde::Deserialize;
use serde::de::DeserializeOwned;

use super::path::path_at;
use super::tuning::TuningScenario;
use super::{Scenario, ScenarioError};

/// Longest document that is read (bytes): far more than any scenario needs.
pub const DOCUMENT_LIMIT: usize = 64 * 1024;

/// The part of a document that every version has; all else is skipped.
#[derive(Deserialize)]
struct Versioned {
    version: u64,
}

/// Reads a scenario from JSON: length, then version, then shape, then every number.
///
/// # Errors
/// [`ScenarioError::TooLong`], [`ScenarioError::UnknownVersion`], [`ScenarioError::Malformed`] (which names the field),
/// or what [`Scenario::validate`] finds.
pub fn from_json(text: &str) -> Result<Scenario, ScenarioError> {
    if text.len() > DOCUMENT_LIMIT {
        return Err(ScenarioError::TooLong { length: text.len(), max: DOCUMENT_LIMIT });
    }
    let Versioned { version } = parse(text)?;
    // A later version is read here too: into its own types, then brought up to date.
    let scenario: Scenario = match version {
        1 => parse(text)?,
        found => return Err(ScenarioError::UnknownVersion { found, newest: Scenario::VERSION }),
    };
    scenario.validate()?;
    Ok(scenario)
}

/// A document of any kind.
#[derive(Clone, Debug, PartialEq)]

pub enum Document {
    /// A run of the quadruple tank, version 1.
    Quadruple(Scenario),
    /// A relay-tuning session, version 2.
    Tuning(TuningScenario),
}

/// Reads a document of any kind from JSON.
///
/// # Errors
/// As [`from_json`].
pub fn document_from_json(text: &str) -> Result<Document, ScenarioError> {
    match from_json(text) {
        Err(ScenarioError::UnknownVersion { found: 2, .. }) => {
            let scenario: TuningScenario = parse(text)?;
            scenario.validate()?;
            Ok(Document::Tuning(scenario))
        }
        Err(ScenarioError::UnknownVersion { found, .. }) => {
            Err(ScenarioError::UnknownVersion { found, newest: TuningScenario::VERSION })
        }
        result => result.map(Document::Quadruple),
    }
}

/// Writes a relay-tuning session as JSON, indented; all digits of all numbers are kept.
///
/// # Errors
/// What [`TuningScenario::validate`] finds.
pub fn tuning_to_json(scenario: &TuningScenario) -> Result<String, ScenarioError> {
    scenario.validate()?;
    serde_json::to_string_pretty(scenario).map_err(|error| malformed(DOCUMENT, &error))
}

/// Writes a scenario as JSON, indented; all digits of all numbers are kept.
///
/// # Errors
/// What [`Scenario::validate`] finds: a document that could not be read again is not written.
pub fn to_json(scenario: &Scenario) -> Result<String, ScenarioError> {
    scenario.validate()?;
    serde_json::to_string_pretty(scenario).map_err(|error| malformed(DOCUMENT, &error))
}

/// Path of an error that concerns no single field.
const DOCUMENT: &str = "document";

/// Reads JSON to its end; an error names the field by its path.
fn parse<T: DeserializeOwned>(text: &str) -> Result<T, ScenarioError> {
    serde_json::from_str(text).map_err(|error| {
        let path = path_at(text, error.line(), error.column());
        malformed(if path.is_empty() { DOCUMENT } else { &path }, &error)
    })
}

fn malformed(path: &str, reason: &serde_json::Error) -> ScenarioError {
    ScenarioError::Malformed { path: path.to_owned(), reason: reason.to_string() }
}
