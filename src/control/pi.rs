use serde::{Deserialize, Serialize};

/// What keeps the integral from winding up while the output is limited.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum AntiWindup {
    /// Nothing: the integral runs on.
    Off,
    /// Back-calculation with the tracking time `Tt = tracking_ratio Ti` (Cocota 2009, ch. 4: Tt = Ti/2).
    BackCalculation {
        /// `Tt / Ti`.
        tracking_ratio: f64,
    },
}

/// Who moves the output of a loop.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum LoopMode {
    /// The controller.
    Automatic,
    /// A person, until the given time; then the controller takes over without a bump.
    Manual {
        /// Controller output while in manual mode (V).
        output: f64,
        /// Time at which the controller takes over (s).
        until_s: f64,
    },
}

/// Settings of one PI loop, `u = K (b r − y + (1/Ti) ∫ (r − y) dt)` in volts of measured signal and controller output.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PiSettings {
    /// Gain K (V/V); negative where the loop needs it.
    pub gain: f64,
    /// Integral time Ti (s).
    pub integral_time_s: f64,
    /// Set-point weight b in the proportional part.
    pub set_point_weight: f64,
    /// Anti-windup.
    pub anti_windup: AntiWindup,
    /// Automatic or manual.
    pub mode: LoopMode,
}

/// A running PI loop: settings, limits and state. See [`Pi::step`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pi {
    settings: PiSettings,
}
