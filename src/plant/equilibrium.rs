use serde::Serialize;

/// Where the plant rests: the levels that given pump voltages hold, or the voltages that hold given lower levels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct OperatingPoint {
    /// Levels h1…h4 (m).
    pub levels: [f64; 4],
    /// Pump voltages (V).
    pub pump_voltage: [f64; 2],
}
