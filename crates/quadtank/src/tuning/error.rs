use serde::Serialize;
use thiserror::Error;

use crate::linear::LinearError;

/// What can be wrong with a tuning experiment. Every variant carries the offending value.
#[derive(Clone, Copy, Debug, PartialEq, Error, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "error", rename_all = "kebab-case")]
pub enum TuningError {
    /// A setting for which the experiment makes no sense.
    #[error("{field} = {value} is out of range")]
    OutOfRange {
        /// Name of the setting.
        field: &'static str,
        /// Its value.
        #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
        value: f64,
    },
    /// A pole in the right half-plane, or on the imaginary axis away from the origin. Integrating elements are allowed.
    #[error(
        "the plant has a pole with the real part {real_part}; the methods need a plant that is stable or integrating"
    )]
    UnstablePlant {
        /// Real part of the pole.
        real_part: f64,
    },
    /// A loop whose input does not move its own output at rest: no relay knows the sign of its feedback, and nothing can be normalised.
    #[error(
        "loop {number} has no gain of its own at rest, g{number}{number}(0) = 0{}",
        if *other_pairing { "; in the other pairing, with the inputs swapped, both loops have one" } else { "" }
    )]
    NoOwnGain {
        /// Number of the loop.
        number: usize,
        /// Whether both loops have a gain of their own when the inputs are swapped.
        other_pairing: bool,
    },
    /// What is wrong with the plant itself.
    #[error(transparent)]
    #[serde(untagged)]
    Linear(#[from] LinearError),
}

/// Refuses what is not positive and finite.
pub(super) fn positive(field: &'static str, value: f64) -> Result<(), TuningError> {
    if value > 0.0 && value.is_finite() { Ok(()) } else { Err(TuningError::OutOfRange { field, value }) }
}
