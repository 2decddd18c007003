use thiserror::Error;

use quadtank::control::EstimatorError;
use quadtank::plant::level::LevelError;
use quadtank::study::StudyError;

use super::limits::Limits;
use quadtank::study::relay_tuning::ElementError;

/// Whether a number asks a pump to pull: rigs that are driven by a symmetric power module are often written so.
pub fn runs_backwards(field: &str, value: f64) -> bool {
    value < 0.0 && ["voltage_min", "voltage_max"].iter().any(|name| field.ends_with(name))
}

/// Whether an acceleration of gravity is one in cm/s².
pub fn is_gravity_in_cm(field: &str, value: f64) -> bool {
    field.ends_with("gravity") && (900.0..1100.0).contains(&value)
}

/// A hint on a value outside of its limits.
fn hint(field: &str, value: f64) -> &'static str {
    if runs_backwards(field, value) {
        "; pumps do not run backwards"
    } else if is_gravity_in_cm(field, value) {
        "; gravity is in m/s², and 981 cm/s² are 9.81 m/s²"
    } else {
        ""
    }
}

/// Why a document is not a scenario, or a scenario cannot be computed.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ScenarioError {
    /// Not JSON, or not of the right shape; `path` names the field (`setup.controller.loops[0].gain`).
    #[error("{path}: {reason}")]
    Malformed {
        /// Where in the document.
        path: String,
        /// What the parser says.
        reason: String,
    },
    /// A number with a decimal comma, which ends a number in JSON.
    #[error("{path}: `{number}` has a decimal comma (line {line}, column {column}); a number has a decimal point")]
    DecimalComma {
        /// Where in the document.
        path: String,
        /// The number as it is written.
        number: String,
        /// Line of the comma, from 1.
        line: usize,
        /// Column of the comma in characters, from 1.
        column: usize,
    },
    /// Bytes that are no text.
    #[error("not UTF-8 text, nor UTF-16, so not JSON")]
    NotText,
    /// A number that is outside its limits or not finite.
    #[error("{field}: {value} is outside {min} to {max}{}", hint(field, *value))]
    OutOfRange {
        /// Where in the document.
        field: String,
        /// The value found.
        value: f64,
        /// Smallest allowed value.
        min: f64,
        /// Largest allowed value.
        max: f64,
    },
    /// An experiment of more samples than a run may have.
    #[error(
        "{field}: {duration_s} s are more than {max} samples at `controller.sampling_time_s` {sampling_time_s} s; shorten the one or \
         lengthen the other"
    )]
    TooManySamples {
        /// The duration, where it is in the document.
        field: String,
        /// The duration (s).
        duration_s: f64,
        /// The sampling time (s).
        sampling_time_s: f64,
        /// The most samples.
        max: f64,
    },
    /// Too many of something.
    #[error("{field}: {count} entries, at most {max}")]
    TooMany {
        /// Where in the document.
        field: String,
        /// How many there are.
        count: usize,
        /// How many are allowed.
        max: usize,
    },
    /// A text that is longer than it may be.
    #[error("{field}: {length} characters, at most {max}")]
    TextTooLong {
        /// Where in the document.
        field: String,
        /// How many characters it has.
        length: usize,
        /// How many are allowed.
        max: usize,
    },
    /// A version that this program does not know.
    #[error("version: {found} is unknown, this program reads 1 to {newest}")]
    UnknownVersion {
        /// The version found.
        found: u64,
        /// The newest version that is read.
        newest: u32,
    },
    /// A document or link longer than any scenario.
    #[error("the document is longer than {max} bytes")]
    TooLong {
        /// Its length, as far as it was read.
        length: usize,
        /// The limit.
        max: usize,
    },
    /// A document that does not fit into a link; a file holds it.
    #[error("the document does not fit into a link of {max} characters; a file holds it")]
    NoLink {
        /// The limit.
        max: usize,
    },
    /// A scene that cannot be read or written.
    #[error("scenes[{index}].{error}")]
    Scene {
        /// Its place, from 0.
        index: usize,
        /// What is wrong with its document.
        error: Box<ScenarioError>,
    },
    /// A link that is cut off or damaged.
    #[error("the link is damaged or cut off")]
    DamagedLink,
    /// The setup of a document has no results.
    #[error("{setup}.{error}")]
    Study {
        /// Where the setup is in its document.
        setup: &'static str,
        /// What is wrong with it.
        error: StudyError,
    },
    /// The model-free law cannot work with such settings.
    #[error("{field}: {error}")]
    Law {
        /// Where in the document.
        field: String,
        /// What is wrong.
        error: EstimatorError,
    },
    /// A level loop whose parts do not fit together.
    #[error("{field}: {error}")]
    Level {
        /// Where in the document.
        field: String,
        /// What is wrong.
        error: LevelError,
    },
    /// An element of a plant that relay tuning does not work with.
    #[error("{field}: {fault}; its coefficients are read by rising powers of s: [1, 10] is 1 + 10 s")]
    Element {
        /// Where in the document.
        field: String,
        /// What is wrong.
        fault: ElementError,
    },
}

/// The number at a path of a document that is not within its limits.
pub(super) fn out_of_range(path: &str, value: f64, Limits { min, max }: Limits) -> ScenarioError {
    ScenarioError::OutOfRange { field: path.to_owned(), value, min, max }
}

/// A document of the wrong shape.
pub(super) fn malformed(path: String, reason: String) -> ScenarioError {
    let path = if path.is_empty() { "document".to_owned() } else { path };
    ScenarioError::Malformed { path, reason }
}

/// Longest quotation of a document in an error (characters).
const LONGEST_QUOTATION: usize = 40;

/// A name or text of a document as errors quote it: its beginning, if it is long.
pub(super) fn quoted(text: &str) -> String {
    match text.char_indices().nth(LONGEST_QUOTATION) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}
