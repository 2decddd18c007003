use crate::tuning::UltimatePoint;

/// The relay test on a solvents column that Campestrini (2006, §6.4) prints: data only, there is no model of it.
///
/// Temperatures at the top and the bottom of the first tower; time in minutes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UsolRecord {
    /// Amplitude d of the relay on loop TIC-521 (%).
    pub amplitude_percent: f64,
    /// Amplitude a of the temperature (°C).
    pub response_celsius: f64,
    /// Period Tc (min).
    pub period_min: f64,
    /// Printed Kc (%/°C).
    pub printed_gain: f64,
    /// Printed kp, ti and td (eqs. 126 to 128), "by Tyreus and Luyben".
    pub printed_pid: [f64; 3],
    /// Period of relays on both loops (s); controllers were not tuned from it.
    pub both_period_s: f64,
}

/// The printed record.
pub const USOL: UsolRecord = UsolRecord {
    amplitude_percent: 40.0,
    response_celsius: 1.0,
    period_min: 2.25,
    printed_gain: 50.9,
    printed_pid: [16.0, 5.0, 4.0],
    both_period_s: 200.0,
};

impl UsolRecord {
    /// The ultimate point by `Kc = 4 d/(π a)` (eq. 48).
    pub fn ultimate_point(&self) -> UltimatePoint {
        let gain = 4.0 * self.amplitude_percent / (std::f64::consts::PI * self.response_celsius);
        UltimatePoint { gain, period: self.period_min }
    }
}
