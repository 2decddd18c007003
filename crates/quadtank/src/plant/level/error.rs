use serde::Serialize;
use thiserror::Error;

/// What can be wrong with a level loop or with the rest that is asked of it. Every variant carries the offending value, in SI.
#[derive(Clone, Copy, Debug, PartialEq, Error, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "error", rename_all = "kebab-case")]
pub enum LevelError {
    /// A parameter that is not a usable number.
    #[error("{field} is {value}, outside {min} to {max}")]
    OutOfRange {
        /// Name of the parameter.
        field: &'static str,
        /// Its value.
        value: f64,
        /// Smallest allowed value.
        min: f64,
        /// Largest allowed value.
        max: f64,
    },
    /// A level below the bottom or above the brim.
    #[error("a level of {value} m is outside the tank, 0 to {height} m")]
    LevelOutsideTank {
        /// The level (m).
        value: f64,
        /// Height of the walls (m).
        height: f64,
    },
    /// An inflow below zero.
    #[error("the inflow of {value} m³/s is negative")]
    NegativeFlow {
        /// The inflow (m³/s).
        value: f64,
    },
    /// A balance that the valve cannot hold at this level, however far it is opened or closed.
    #[error("the valve would need an opening of {needed}, outside {min} to {max}")]
    ValveOutOfReach {
        /// Required opening, as a share of the flow of the open valve; not finite where no opening gives any flow.
        #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
        needed: f64,
        /// Opening of the closed valve.
        min: f64,
        /// Opening of the open valve.
        max: f64,
    },
    /// A balance for which the controller output would leave its range.
    #[error("the controller output would have to be {needed}, outside {min} to {max}")]
    OutputOutOfReach {
        /// Required controller output, in the unit of its signal range (mA or psi).
        needed: f64,
        /// Lower end of its range.
        min: f64,
        /// Upper end of its range.
        max: f64,
    },
    /// An actuator curve with fewer than two points, with pressures that do not rise, or with a travel that turns back.
    #[error("the actuator curve is not monotonic at point {}", index + 1)]
    ActuatorCurve {
        /// Index of the first point that does not fit, from 0.
        index: usize,
    },
}

/// Refuses a number outside `[min, max]`, or none.
pub(super) fn within(field: &'static str, value: f64, min: f64, max: f64) -> Result<(), LevelError> {
    if value >= min && value <= max { Ok(()) } else { Err(LevelError::OutOfRange { field, value, min, max }) }
}
