use super::fields::{self, Part, malformed};
use super::model_free::ModelFreeScenario;
use super::path::path_at;
use super::tree::Tree;
use super::tuning::TuningScenario;
use super::{Scenario, ScenarioError};

/// Longest document that is read (bytes): far more than any scenario needs.
pub const DOCUMENT_LIMIT: usize = 64 * 1024;

/// A document of any kind.
#[derive(Clone, Debug, PartialEq)]
pub enum Document {
    /// A run of the quadruple tank, version 1.
    Quadruple(Scenario),
    /// A relay-tuning session, version 2.
    Tuning(TuningScenario),
    /// A run under the model-free law, version 3.
    ModelFree(ModelFreeScenario),
}

/// Reads a scenario from JSON: length, then version, then shape, then every number.
///
/// # Errors
/// [`ScenarioError::TooLong`], [`ScenarioError::UnknownVersion`], [`ScenarioError::Malformed`] (which names the field),
/// or what [`Scenario::validate`] finds.
pub fn from_json(text: &str) -> Result<Scenario, ScenarioError> {
    let tree = tree_of(text)?;
    match version_of(&tree)? {
        1 => read(Scenario::default(), &tree),
        found => Err(ScenarioError::UnknownVersion { found, newest: Scenario::VERSION }),
    }
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
/// A later version of a document is read here too: into its own types, then brought up to date.
///
/// # Errors
/// As [`document_from_json`], but for what concerns the text.
pub fn document_from_tree(tree: &Tree) -> Result<Document, ScenarioError> {
    match version_of(tree)? {
        1 => read(Scenario::default(), tree).map(Document::Quadruple),
        2 => read(TuningScenario::default(), tree).map(Document::Tuning),
        3 => read(ModelFreeScenario::default(), tree).map(Document::ModelFree),
        found => Err(ScenarioError::UnknownVersion { found, newest: ModelFreeScenario::VERSION }),
    }
}

fn tree_of(text: &str) -> Result<Tree, ScenarioError> {
    if text.len() > DOCUMENT_LIMIT {
        return Err(ScenarioError::TooLong { length: text.len(), max: DOCUMENT_LIMIT });
    }
    serde_json::from_str(text)
        .map_err(|error| malformed(path_at(text, error.line(), error.column()), error.to_string()))
}

/// The version of a document, which comes before anything else.
fn version_of(tree: &Tree) -> Result<u64, ScenarioError> {
    match tree.get("version") {
        Some(Tree::Unsigned(version)) => Ok(*version),
        Some(_) => Err(malformed("version".to_owned(), "no whole number".to_owned())),
        None => Err(malformed(String::new(), "missing field `version`".to_owned())),
    }
}

/// Reads a document into `blank`, which is one of its type whose optional fields are as they are where they are absent.
fn read<T: Part>(mut blank: T, tree: &Tree) -> Result<T, ScenarioError> {
    fields::read(&mut blank, tree).map(|()| blank)
}

/// Writes a scenario as JSON, indented; all digits of all numbers are kept.
///
/// # Errors
/// What [`Scenario::validate`] finds: a document that could not be read again is not written.
pub fn to_json(scenario: &Scenario) -> Result<String, ScenarioError> {
    fields::write(&mut scenario.clone())
}

/// Writes a relay-tuning session as JSON, as [`to_json`] writes a scenario.
///
/// # Errors
/// What [`TuningScenario::validate`] finds.
pub fn tuning_to_json(scenario: &TuningScenario) -> Result<String, ScenarioError> {
    fields::write(&mut scenario.clone())
}

/// Writes a run under the model-free law as JSON, as [`to_json`] writes a scenario.
///
/// # Errors
/// What [`ModelFreeScenario::validate`] finds.
pub fn model_free_to_json(scenario: &ModelFreeScenario) -> Result<String, ScenarioError> {
    fields::write(&mut scenario.clone())
}

/// The JSON Schema of the documents of a version; `None` for one that is not known.
#[cfg(not(target_arch = "wasm32"))]
pub fn schema_of(version: u32) -> Option<serde_json::Value> {
    Some(match version {
        1 => fields::schema(&mut Scenario::default(), "Scenario"),
        2 => fields::schema(&mut TuningScenario::default(), "TuningScenario"),
        3 => fields::schema(&mut ModelFreeScenario::default(), "ModelFreeScenario"),
        _ => return None,
    })
}
