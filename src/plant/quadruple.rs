use serde::{Deserialize, Serialize};

use super::Tank;

/// A pump with its voltage limits; its flow is `gain × voltage` (Cocota 2009, eq. 2.25).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Pump {
    /// Flow per volt `k` (m³/(s V)).
    pub gain: f64,
    /// Lowest voltage (V).
    pub voltage_min: f64,
    /// Highest voltage (V).
    pub voltage_max: f64,
}

/// The level sensors of the two lower tanks: `y = gain × level`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Sensor {
    /// Sensor gain `k_c` (V/m).
    pub gain: f64,
    /// Level above which the signal saturates (m).
    pub range: f64,
    /// Smallest signal difference that the sensor tells apart (V); 0 for an ideal one.
    pub resolution: f64,
}

/// The quadruple-tank process of Johansson (2000), with the trapezoidal tank, the losses and the power module of
/// Cocota (2009, eqs. 3.1–3.4).
///
/// Tanks 1 and 2 are below, 3 drains into 1, 4 into 2. Pump 1 feeds tank 1 with the fraction γ1 and tank 4 with the
/// rest; pump 2 feeds tank 2 with the fraction γ2 and tank 3 with the rest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct QuadrupleTank {
    /// Tanks 1 to 4.
    pub tanks: [Tank; 4],
    /// Pumps 1 and 2.
    pub pumps: [Pump; 2],
    /// Valve fractions γ1, γ2, each in [0, 1].
    pub valves: [f64; 2],
    /// Gain of the power module between controller output and pump voltage (Cocota 2009: `k_mod`); 1 where there is none.
    pub power_gain: f64,
    /// The level sensors.
    pub sensor: Sensor,
    /// Acceleration of gravity (m/s²).
    pub gravity: f64,
}

/// Loads that act on the plant beside its inputs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Disturbance {
    /// Flow added to that of each pump, ahead of its valve (m³/s); may be negative.
    pub pump_flow: [f64; 2],
    /// Area of an additional hole in the bottom of each tank whose water leaves the plant (m²).
    pub leak_area: [f64; 4],
}
