use serde::Serialize;
use thiserror::Error;

/// What can be wrong with a plant, an operating point or an input. Every variant carries the offending value, in SI.
#[derive(Clone, Copy, Debug, PartialEq, Error, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "error", rename_all = "kebab-case")]
pub enum PlantError {
    /// γ1 + γ2 = 1: the flows into the lower tanks are proportional, so no unique input holds two given levels
    /// (Cocota 2009, §3.2.1; Johansson 2000, §III).
    #[error("the plant is singular at steady state: gamma1 + gamma2 = {gamma_sum}")]
    SingularPlant {
        /// γ1 + γ2.
        gamma_sum: f64,
    },
    /// A tank would need a level outside its walls.
    #[error("tank {} needs a level of {value} m, outside 0 to {max} m", tank + 1)]
    LevelOutOfRange {
        /// Index of the tank, from 0.
        tank: usize,
        /// Level that the balance asks for (m).
        value: f64,
        /// Height of the tank (m).
        max: f64,
    },
    /// A pump would need a voltage outside its limits.
    #[error("pump {} needs {value} V, outside {min} to {max} V", pump + 1)]
    VoltageOutOfRange {
        /// Index of the pump, from 0.
        pump: usize,
        /// Voltage asked for (V).
        value: f64,
        /// Lower limit (V).
        min: f64,
        /// Upper limit (V).
        max: f64,
    },
    /// A parameter that is not a usable number.
    #[error("{field} is {value}, outside {min} to {max}")]
    OutOfRange {
        /// Name of the parameter as it stands in the scenario document.
        field: &'static str,
        /// Its value.
        value: f64,
        /// Smallest allowed value.
        min: f64,
        /// Largest allowed value.
        max: f64,
    },
}
