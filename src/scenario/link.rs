//! Links: a scenario as text for the fragment of a URL.
//!
//! `q1.` and then, in base64url without padding, what a zlib stream of *dictionary + JSON on one line* has after the
//! dictionary: deflate data that may refer back to the dictionary, and the checksum of both. A reader rebuilds the
//! beginning of the stream. The dictionary holds field names and published settings, so a link to a published rig takes
//! some fifty characters and one with every number changed stays under the limit.
//!
//! `dictionary-1.jsonl` must never change, or old links break. A better one would be `q2.`, beside it.

use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use miniz_oxide::deflate::core::{
    CompressionStrategy, CompressorOxide, TDEFLFlush, TDEFLStatus, compress_to_output,
    create_comp_flags_from_zip_params,
};
use miniz_oxide::inflate::TINFLStatus;
use miniz_oxide::inflate::core::{DecompressorOxide, decompress, inflate_flags};

use super::codec::{DOCUMENT_LIMIT, from_json, to_json};
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
    // The default strategy spends a table on good codes; short documents do better with the fixed ones.
    let packed = [CompressionStrategy::Default, CompressionStrategy::Fixed]
        .into_iter()
        .filter_map(|strategy| pack(DICTIONARY_1, json.as_bytes(), strategy))
        .min_by_key(Vec::len)
        .ok_or(ScenarioError::DamagedLink)?;
    let link = format!("{MARK}{FORMAT}.{}", URL_SAFE_NO_PAD.encode(packed));
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
    let json = unpack(DICTIONARY_1, &packed).ok_or(ScenarioError::DamagedLink)?;
    from_json(&json)
}

/// The part of the zlib stream of `dictionary + text` that follows the dictionary.
fn pack(dictionary: &[u8], text: &[u8], strategy: CompressionStrategy) -> Option<Vec<u8>> {
    const BEST: i32 = 10;
    const WINDOW_BITS: i32 = 15;
    let mut compressor = CompressorOxide::new(create_comp_flags_from_zip_params(BEST, WINDOW_BITS, strategy as i32));
    // A sync flush ends on a whole byte, which is where the stream can be cut.
    let (status, _) = compress_to_output(&mut compressor, dictionary, TDEFLFlush::Sync, |_| true);
    if status != TDEFLStatus::Okay {
        return None;
    }
    let mut packed = Vec::new();
    let (status, _) = compress_to_output(&mut compressor, text, TDEFLFlush::Finish, |bytes| {
        packed.extend_from_slice(bytes);
        true
    });
    (status == TDEFLStatus::Done).then_some(packed)
}

/// The text behind what [`pack`] made; `None` if anything is wrong with it or it is longer than any document.
fn unpack(dictionary: &[u8], packed: &[u8]) -> Option<String> {
    const FLAGS: u32 =
        inflate_flags::TINFL_FLAG_PARSE_ZLIB_HEADER | inflate_flags::TINFL_FLAG_USING_NON_WRAPPING_OUTPUT_BUF;
    let start = stream_start(dictionary)?;
    let mut text = vec![0; dictionary.len() + DOCUMENT_LIMIT];
    let mut state = Box::new(DecompressorOxide::new());
    let (status, _, skipped) =
        decompress(&mut state, &start, &mut text, 0, FLAGS | inflate_flags::TINFL_FLAG_HAS_MORE_INPUT);
    if status != TINFLStatus::NeedsMoreInput || skipped != dictionary.len() {
        return None;
    }
    let (status, read, written) = decompress(&mut state, packed, &mut text, skipped, FLAGS);
    if status != TINFLStatus::Done || read != packed.len() {
        return None;
    }
    String::from_utf8(text.get(skipped..skipped + written)?.to_vec()).ok()
}

/// The beginning of a zlib stream that holds the dictionary as it is (RFC 1950 §2.2, RFC 1951 §3.2.4).
fn stream_start(dictionary: &[u8]) -> Option<Vec<u8>> {
    const ZLIB_HEADER: [u8; 2] = [0x78, 0x01];
    const STORED_BLOCK: u8 = 0;
    let length = u16::try_from(dictionary.len()).ok()?;
    let mut start = ZLIB_HEADER.to_vec();
    start.push(STORED_BLOCK);
    start.extend(length.to_le_bytes());
    start.extend((!length).to_le_bytes());
    start.extend_from_slice(dictionary);
    Some(start)
}
