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
    /// A pole of the plant that is not in the left half-plane: every method here needs a stable plant.
    #[error("the plant has a pole with the real part {real_part}; the methods need a stable plant")]
    UnstablePlant {
        /// Real part of the pole.
        real_part: f64,
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
