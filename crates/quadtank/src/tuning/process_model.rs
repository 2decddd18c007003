use serde::{Deserialize, Serialize};

use super::TuningError;
use super::error::positive;

/// A process as a reaction curve shows it. Times are in s, gains in signal per signal.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ProcessModel {
    /// `K e^(−θ s)/(τ s + 1)`.
    SelfRegulating {
        /// Gain K.
        gain: f64,
        /// Time constant τ (s).
        time_constant_s: f64,
        /// Dead time θ (s).
        dead_time_s: f64,
    },
    /// `K' e^(−θ s)/s`.
    Integrating {
        /// Slope K' per unit of input (1/s).
        slope: f64,
        /// Dead time θ (s).
        dead_time_s: f64,
    },
}

impl ProcessModel {
    /// A chain of lags (s) and a dead time (s) as a first-order model by the half rule (Skogestad 2003): the largest lag stays, half
    /// of the second goes to it, the other half and all others to the dead time.
    pub fn by_half_rule(gain: f64, lags_s: &[f64], dead_time_s: f64) -> Self {
        let mut lags = lags_s.to_vec();
        lags.sort_by(|a, b| b.total_cmp(a));
        let lag = |k: usize| lags.get(k).copied().unwrap_or(0.0);
        let rest: f64 = lags.iter().skip(2).sum();
        Self::SelfRegulating {
            gain,
            time_constant_s: lag(0) + 0.5 * lag(1),
            dead_time_s: dead_time_s + 0.5 * lag(1) + rest,
        }
    }

    /// An integrator behind lags (s) and a dead time (s) by the same rule: the half of the largest lag that would go to the time
    /// constant of the process is nothing beside it.
    pub fn integrating_by_half_rule(slope: f64, lags_s: &[f64], dead_time_s: f64) -> Self {
        let largest = lags_s.iter().copied().fold(0.0, f64::max);
        Self::Integrating { slope, dead_time_s: dead_time_s + lags_s.iter().sum::<f64>() - 0.5 * largest }
    }

    /// Dead time θ (s).
    pub fn dead_time_s(&self) -> f64 {
        match *self {
            Self::SelfRegulating { dead_time_s, .. } | Self::Integrating { dead_time_s, .. } => dead_time_s,
        }
    }

    /// Gain K; `None` for an integrator.
    pub fn gain(&self) -> Option<f64> {
        match *self {
            Self::SelfRegulating { gain, .. } => Some(gain),
            Self::Integrating { .. } => None,
        }
    }

    /// Time constant τ (s); `None` for an integrator.
    pub fn time_constant_s(&self) -> Option<f64> {
        match *self {
            Self::SelfRegulating { time_constant_s, .. } => Some(time_constant_s),
            Self::Integrating { .. } => None,
        }
    }

    /// Slope of the answer to a unit step (1/s): K/τ, or K'.
    pub fn slope(&self) -> f64 {
        match *self {
            Self::SelfRegulating { gain, time_constant_s, .. } => gain / time_constant_s,
            Self::Integrating { slope, .. } => slope,
        }
    }

    /// Answer of the model, `time_s` after a step of its input.
    pub fn step_response(&self, step: f64, time_s: f64) -> f64 {
        let since = (time_s - self.dead_time_s()).max(0.0);
        match *self {
            Self::SelfRegulating { gain, time_constant_s, .. } => -gain * step * (-since / time_constant_s).exp_m1(),
            Self::Integrating { slope, .. } => slope * step * since,
        }
    }

    /// Refuses a model without meaning; gains may be negative.
    pub(super) fn check(&self) -> Result<(), TuningError> {
        let nonzero = |field, value: f64| {
            if value != 0.0 && value.is_finite() { Ok(()) } else { Err(TuningError::OutOfRange { field, value }) }
        };
        match *self {
            Self::SelfRegulating { gain, time_constant_s, .. } => {
                nonzero("gain", gain)?;
                positive("time_constant_s", time_constant_s)?;
            }
            Self::Integrating { slope, .. } => nonzero("slope", slope)?,
        }
        let dead_time = self.dead_time_s();
        if dead_time >= 0.0 && dead_time.is_finite() {
            Ok(())
        } else {
            Err(TuningError::OutOfRange { field: "dead_time_s", value: dead_time })
        }
    }
}
