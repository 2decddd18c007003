//! Links: a document as text for the fragment of a URL.
//!
//! `q`, the version of the document and a point, and then, in base64url without padding, the [packed](super::pack) JSON on one line.
//! What it is packed against holds field names and published settings, so a link to a published rig takes some twenty characters and
//! one with every number changed stays under the limit.

use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;

use super::codec::{DOCUMENT_LIMIT, Document, DocumentKind, NEWEST, document_from_json, to_json};
use super::pack::{pack, unpack};
use super::{BenchDocument, ScenarioError};

/// Longest link that is written or read (characters), the prefix included.
pub const LINK_LIMIT: usize = 2000;

/// First character of every link; the version of its document follows.
const MARK: char = 'q';

/// Writes the document of a bench as text for the fragment of a URL: only letters, digits, `.`, `-` and `_`.
///
/// # Errors
/// [`ScenarioError::NoLink`] beyond [`LINK_LIMIT`], or what [`BenchDocument::validate`] finds.
///
/// # Examples
/// ```
/// use quadtank_scenario::{Document, Scenario, document_from_link, to_link};
///
/// let scenario = Scenario::default();
/// let link = to_link(&scenario)?;
/// assert_eq!(document_from_link(&link)?, Document::Quadruple(scenario));
/// # Ok::<(), quadtank_scenario::ScenarioError>(())
/// ```
pub fn to_link<D: BenchDocument>(document: &D) -> Result<String, ScenarioError> {
    // Without the indentation: a string of a document has no line breaks, so every line starts with it.
    let line: String = to_json(document)?.lines().map(str::trim_start).collect();
    let mut link = format!("{MARK}{}.", D::VERSION);
    // Three bytes take four characters.
    let room = (LINK_LIMIT - link.len()) * 3 / 4;
    let packed = pack(D::DICTIONARY, line.as_bytes(), room).ok_or(ScenarioError::NoLink { max: LINK_LIMIT })?;
    URL_SAFE_NO_PAD.encode_string(packed, &mut link);
    Ok(link)
}

impl Document {
    /// Writes a document of any kind as text for the fragment of a URL.
    ///
    /// # Errors
    /// As [`to_link`].
    pub fn to_link(&self) -> Result<String, ScenarioError> {
        match self {
            Self::Quadruple(scenario) => to_link(scenario),
            Self::Tuning(scenario) => to_link(scenario),
            Self::ModelFree(scenario) => to_link(scenario),
            Self::LevelLoop(scenario) => to_link(scenario),
        }
    }
}

/// Reads a document from the text that [`to_link`] writes.
///
/// # Errors
/// [`ScenarioError::DamagedLink`], and those of [`document_from_json`].
pub fn document_from_link(link: &str) -> Result<Document, ScenarioError> {
    document_from_json(&json_of_link(link)?)
}

/// The JSON in the text that [`to_link`] writes.
///
/// # Errors
/// [`ScenarioError::TooLong`] beyond [`LINK_LIMIT`]; [`ScenarioError::UnknownVersion`] for a format of a later program;
/// [`ScenarioError::DamagedLink`] when it is cut off, changed or no link at all.
fn json_of_link(link: &str) -> Result<String, ScenarioError> {
    if link.len() > LINK_LIMIT {
        return Err(ScenarioError::TooLong { length: link.len(), max: LINK_LIMIT });
    }
    let (format, payload) =
        link.strip_prefix(MARK).and_then(|rest| rest.split_once('.')).ok_or(ScenarioError::DamagedLink)?;
    let found: u64 = format.parse().map_err(|_| ScenarioError::DamagedLink)?;
    let kind = DocumentKind::of_version(found).ok_or(ScenarioError::UnknownVersion { found, newest: NEWEST })?;
    let packed = URL_SAFE_NO_PAD.decode(payload).map_err(|_| ScenarioError::DamagedLink)?;
    let text = unpack(kind.dictionary, &packed, DOCUMENT_LIMIT).ok_or(ScenarioError::DamagedLink)?;
    String::from_utf8(text).map_err(|_| ScenarioError::DamagedLink)
}
