#[cfg(feature = "schema")]
use schemars::JsonSchema;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::error::{malformed, quoted};
use super::level_loop::LevelLoopScenario;
use super::model_free::ModelFreeScenario;
use super::path::{byte_at, decimal_comma, path_before};
use super::quantities::{QuantityRow, rows_of};
use super::text::text_of;
use super::tree::Tree;
use super::tuning::TuningScenario;
use super::{BenchDocument, Scenario, ScenarioError, reader};

/// Longest document that is read or written (bytes): a record of the most moves as an experiment has 4.4 MB.
pub const DOCUMENT_LIMIT: usize = 8 * 1024 * 1024;

/// A document of any kind.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Document {
    /// A run of the quadruple tank, version 1.
    Quadruple(Scenario),
    /// A relay-tuning session, version 2.
    Tuning(TuningScenario),
    /// A run under the model-free law, version 3.
    ModelFree(ModelFreeScenario),
    /// A level loop, version 4.
    LevelLoop(LevelLoopScenario),
}

/// A kind of document: what reading, links and schema need of its type.
pub(super) struct DocumentKind {
    pub version: u32,
    pub root: &'static str,
    pub dictionary: &'static [u8],
    pub bench: &'static str,
    pub quantities: fn() -> Vec<QuantityRow>,
    read: fn(&Tree) -> Result<Document, ScenarioError>,
    #[cfg(feature = "schema")]
    pub shape: fn(&mut schemars::SchemaGenerator) -> schemars::Schema,
}

/// All kinds of documents, by rising versions: a new one is a line here and a variant of [`Document`].
pub(super) const KINDS: [DocumentKind; 4] = [
    DocumentKind::of::<Scenario>(),
    DocumentKind::of::<TuningScenario>(),
    DocumentKind::of::<ModelFreeScenario>(),
    DocumentKind::of::<LevelLoopScenario>(),
];

/// The newest version.
pub(super) const NEWEST: u32 = KINDS[KINDS.len() - 1].version;

/// What stands for the trait of the schema where there is none, since a bound cannot be conditional.
#[cfg(not(feature = "schema"))]
trait JsonSchema {}
#[cfg(not(feature = "schema"))]
impl<T> JsonSchema for T {}

impl DocumentKind {
    const fn of<D: BenchDocument + DeserializeOwned + JsonSchema>() -> Self {
        Self {
            version: D::VERSION,
            root: D::ROOT,
            dictionary: D::DICTIONARY,
            bench: D::BENCH,
            quantities: rows_of::<D::Study>,
            read: |tree| read::<D>(tree).map(D::into),
            #[cfg(feature = "schema")]
            shape: schemars::SchemaGenerator::root_schema_for::<D>,
        }
    }

    /// The kind with a version.
    pub fn of_version(version: u64) -> Option<Self> {
        KINDS.into_iter().find(|kind| u64::from(kind.version) == version)
    }
}

/// Reads a scenario from JSON: length, then version, then shape, then every number.
///
/// # Errors
/// [`ScenarioError::TooLong`], [`ScenarioError::UnknownVersion`], [`ScenarioError::Malformed`] (which names the field),
/// or what [`BenchDocument::validate`] finds.
pub fn from_json(text: &str) -> Result<Scenario, ScenarioError> {
    let tree = tree_of(text)?;
    match version_of(&tree)? {
        1 => read(&tree),
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

/// Reads a document of any kind from the bytes of a file: JSON in UTF-8 or UTF-16, with or without a byte order mark.
///
/// # Errors
/// As [`from_json`]; [`ScenarioError::NotText`].
pub fn document_from_bytes(bytes: &[u8]) -> Result<Document, ScenarioError> {
    check_length(bytes.len())?;
    document_from_json(&text_of(bytes)?)
}

/// Reads any other kind of file of the laboratory from JSON, as strictly as a document and with the place of what is wrong.
///
/// # Errors
/// [`ScenarioError::TooLong`] beyond `limit` bytes, [`ScenarioError::NotText`], [`ScenarioError::Malformed`].
pub fn read_json<T: DeserializeOwned>(bytes: &[u8], limit: usize) -> Result<T, ScenarioError> {
    if bytes.len() > limit {
        return Err(ScenarioError::TooLong { length: bytes.len(), max: limit });
    }
    let text = text_of(bytes)?;
    let tree: Tree = serde_json::from_str(&text).map_err(|error| syntax_error(&text, &error))?;
    reader::read(&tree)
}

/// Reads a document of any kind from what JSON was parsed to; which kind is said by its version.
pub(super) fn document_from_tree(tree: &Tree) -> Result<Document, ScenarioError> {
    let found = version_of(tree)?;
    match DocumentKind::of_version(found) {
        Some(kind) => (kind.read)(tree),
        None => Err(ScenarioError::UnknownVersion { found, newest: NEWEST }),
    }
}

pub(super) fn tree_of(text: &str) -> Result<Tree, ScenarioError> {
    check_length(text.len())?;
    serde_json::from_str(text).map_err(|error| syntax_error(text, &error))
}

/// Refuses a document by its length (bytes), before it is read.
///
/// # Errors
/// [`ScenarioError::TooLong`] beyond [`DOCUMENT_LIMIT`].
pub fn check_length(length: usize) -> Result<(), ScenarioError> {
    if length > DOCUMENT_LIMIT { Err(ScenarioError::TooLong { length, max: DOCUMENT_LIMIT }) } else { Ok(()) }
}

/// Why a text is not JSON: a decimal comma up to the place where the parser gave up, else what the parser says.
fn syntax_error(text: &str, error: &serde_json::Error) -> ScenarioError {
    let end = byte_at(text, error.line(), error.column());
    match decimal_comma(text, end) {
        Some((comma, path)) => ScenarioError::DecimalComma {
            path: if path.is_empty() { "document".to_owned() } else { path },
            number: quoted(number_around(text, comma)),
            line: text[..comma].matches('\n').count() + 1,
            column: text[..comma].chars().rev().take_while(|&c| c != '\n').count() + 1,
        },
        None => malformed(path_before(text, end), error.to_string()),
    }
}

/// The number of which a byte of a text is a part.
fn number_around(text: &str, at: usize) -> &str {
    let is_part = |c: char| c.is_ascii_digit() || "+-.,eE".contains(c);
    let begin = text[..at].trim_end_matches(is_part).len();
    let end = text.len() - text[at..].trim_start_matches(is_part).len();
    text[begin..end].trim_end_matches(',')
}

/// The version of a document, which comes before anything else.
fn version_of(tree: &Tree) -> Result<u64, ScenarioError> {
    match tree.get("version") {
        Some(Tree::Unsigned(version)) => Ok(*version),
        Some(_) => Err(malformed("version".to_owned(), "no whole number".to_owned())),
        None => Err(malformed(String::new(), "missing field `version`".to_owned())),
    }
}

/// Reads a document into its type, shape first, then every number.
fn read<T: BenchDocument + DeserializeOwned>(tree: &Tree) -> Result<T, ScenarioError> {
    let document: T = reader::read(tree)?;
    document.validate()?;
    Ok(document)
}

/// Writes the document of a bench as JSON, indented; all digits of all numbers are kept.
///
/// # Errors
/// What [`BenchDocument::validate`] finds, and [`ScenarioError::TooLong`] beyond [`DOCUMENT_LIMIT`]: a document that could not be
/// read again is not written.
pub fn to_json(document: &impl BenchDocument) -> Result<String, ScenarioError> {
    document.validate()?;
    written(document)
}

/// Writes a validated document as the text of a file.
pub(super) fn written(value: &impl Serialize) -> Result<String, ScenarioError> {
    let text = serde_json::to_string_pretty(value).map_err(|error| malformed(String::new(), error.to_string()))?;
    check_length(text.len())?;
    Ok(text)
}

impl Document {
    /// Checks a document of any kind.
    ///
    /// # Errors
    /// As [`BenchDocument::validate`].
    pub fn validate(&self) -> Result<(), ScenarioError> {
        match self {
            Self::Quadruple(scenario) => scenario.validate(),
            Self::Tuning(scenario) => scenario.validate(),
            Self::ModelFree(scenario) => scenario.validate(),
            Self::LevelLoop(scenario) => scenario.validate(),
        }
    }

    /// Writes a document of any kind as JSON.
    ///
    /// # Errors
    /// As [`to_json`].
    pub fn to_json(&self) -> Result<String, ScenarioError> {
        match self {
            Self::Quadruple(scenario) => to_json(scenario),
            Self::Tuning(scenario) => to_json(scenario),
            Self::ModelFree(scenario) => to_json(scenario),
            Self::LevelLoop(scenario) => to_json(scenario),
        }
    }
}
