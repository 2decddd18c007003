use serde::{Deserialize, Serialize};

/// Gain and integral time of a PI controller.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PiTuning {
    /// Gain Kp, signal per signal.
    pub gain: f64,
    /// Integral time Ti (s).
    pub integral_time_s: f64,
}
