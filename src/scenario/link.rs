//! Links: a scenario as text for the fragment of a URL.
//!
//! `q1.` and then, in base64url without padding, the [packed](super::pack) JSON on one line. What it is packed against
//! holds field names and published settings, so a link to a published rig takes some thirty characters and one with every
//! number changed stays under the limit.
//!
//! `dictionary-1.jsonl` must never change, or old links break. A better one would be `q2.`, beside it.

use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;

use super::codec::{DOCUMENT_LIMIT, from_json, to_json};
use super::pack::{pack, unpack};
use super::{Scenario, ScenarioError};

/// Longest link that is written or read (characters), the prefix included.
pub const LINK_LIMIT: usize = 2000;

/// First character of every link; the number of its format follows.
const MARK: char = 'q';
/// Number of the format that this program writes, and the newest that it reads.
const FORMAT: u32 = 1;
const DICTIONARY_1: &[u8] = include_bytes!("dictionary-1.jsonl");

/// Writes a scenario as text for the fragment of a URL: only letters, digits, `.`, `-` and `_`.
///
/// # Errors
/// [`ScenarioError::TooLong`] beyond [`LINK_LIMIT`], or what [`Scenario::validate`] finds.
pub fn to_link(scenario: &Scenario) -> Result<String, ScenarioError> {
    // Without the indentation: a string of a document has no line breaks, so every line starts with it.
    let json: String = to_json(scenario)?.lines().map(str::trim_start).collect();
    let link = format!("{MARK}{FORMAT}.{}", URL_SAFE_NO_PAD.encode(pack(DICTIONARY_1, json.as_bytes())));
    if link.len() > LINK_LIMIT {
        return Err(ScenarioError::TooLong { length: link.len(), max: LINK_LIMIT });
    }
    Ok(link)
}

/// Reads a scenario from the text that [`to_link`] writes.
///
/// # Errors
/// [`ScenarioError::TooLong`] beyond [`LINK_LIMIT`]; [`ScenarioError::UnknownVersion`] for a format of a later program;
/// [`ScenarioError::DamagedLink`] when it is cut off, changed or no link at all; else as [`from_json`].
pub fn from_link(link: &str) -> Result<Scenario, ScenarioError> {
    if link.len() > LINK_LIMIT {
        return Err(ScenarioError::TooLong { length: link.len(), max: LINK_LIMIT });
    }
    let (format, payload) =
        link.strip_prefix(MARK).and_then(|rest| rest.split_once('.')).ok_or(ScenarioError::DamagedLink)?;
    match format.parse() {
        Ok(1) => {}
        Ok(found) => return Err(ScenarioError::UnknownVersion { found, newest: FORMAT }),
        Err(_) => return Err(ScenarioError::DamagedLink),
    }
    let packed = URL_SAFE_NO_PAD.decode(payload).map_err(|_| ScenarioError::DamagedLink)?;
    let text = unpack(DICTIONARY_1, &packed, DOCUMENT_LIMIT).ok_or(ScenarioError::DamagedLink)?;
    from_json(&String::from_utf8(text).map_err(|_| ScenarioError::DamagedLink)?)
}
