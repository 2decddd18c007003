use super::path::path_at;
use super::tree::{Tree, TreeError};
use super::tuning::TuningScenario;
use super::{Scenario, ScenarioError};

/// Longest document that is read (bytes): far more than any scenario needs.
pub const DOCUMENT_LIMIT: usize = 64 * 1024;

/// Reads a scenario from JSON: length, then version, then shape, then every number.
///
/// # Errors
/// [`ScenarioError::TooLong`], [`ScenarioError::UnknownVersion`], [`ScenarioError::Malformed`] (which names the field),
/// or what [`Scenario::validate`] finds.
pub fn from_json(text: &str) -> Result<Scenario, ScenarioError> {
    let tree = tree_of(text)?;
    match version_of(&tree)? {
        1 => scenario_of(&tree),
        found => Err(ScenarioError::UnknownVersion { found, newest: Scenario::VERSION }),
    }
}

pub(super) fn tree_of(text: &str) -> Result<Tree, ScenarioError> {
    if text.len() > DOCUMENT_LIMIT {
        return Err(ScenarioError::TooLong { length: text.len(), max: DOCUMENT_LIMIT });
    }
    serde_json::from_str(text).map_err(|error| {
        let path = path_at(text, error.line(), error.column());
        malformed(&path, &error)
    })
}

/// The version of a document, which comes before anything else.
pub(super) fn version_of(tree: &Tree) -> Result<u64, ScenarioError> {
    match tree.get("version") {
        Some(Tree::Unsigned(version)) => Ok(*version),
        Some(_) => Err(malformed("version", &"no whole number")),
        None => Err(malformed("", &"missing field `version`")),
    }
}

/// A later version is read here too: into its own types, then brought up to date.
fn scenario_of(tree: &Tree) -> Result<Scenario, ScenarioError> {
    let scenario: Scenario = tree.read().map_err(|error| misread(&error))?;
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
    document_from_tree(&tree_of(text)?)
}

/// Reads a document of any kind from what JSON was parsed to.
///
/// # Errors
/// As [`document_from_json`], but for what concerns the text.
pub fn document_from_tree(tree: &Tree) -> Result<Document, ScenarioError> {
    match version_of(tree)? {
        1 => scenario_of(tree).map(Document::Quadruple),
        2 => {
            let scenario: TuningScenario = tree.read().map_err(|error| misread(&error))?;
            scenario.validate()?;
            Ok(Document::Tuning(scenario))
        }
        found => Err(ScenarioError::UnknownVersion { found, newest: TuningScenario::VERSION }),
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

pub(super) fn misread(error: &TreeError) -> ScenarioError {
    malformed(error.path(), error)
}

fn malformed(path: &str, reason: &dyn std::fmt::Display) -> ScenarioError {
    let path = if path.is_empty() { DOCUMENT } else { path };
    ScenarioError::Malformed { path: path.to_owned(), reason: reason.to_string() }
}
