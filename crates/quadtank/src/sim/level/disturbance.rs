use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::ParkMillerNormal;
use crate::sim::gaussian::GaussianSource;

/// What is added to the inflow of a level loop (m³/s).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum InflowSignal {
    /// Nothing.
    None,
    /// A constant.
    Step {
        /// Size (m³/s).
        size: f64,
    },
    /// `amplitude sin(2π t/period)` with the time of the run, whenever it acts.
    Sine {
        /// Amplitude (m³/s).
        amplitude: f64,
        /// Period (s).
        period_s: f64,
    },
    /// Normal deviates of the block "Random Number" of Simulink, each held for a sample; the sequence runs from t = 0, whenever it
    /// acts.
    SimulinkNormal {
        /// Standard deviation (m³/s).
        std: f64,
        /// How long a value is held (s).
        sample_time_s: f64,
        /// Seed of the block.
        seed: u32,
    },
    /// The same with the generator of this laboratory.
    Normal {
        /// Standard deviation (m³/s).
        std: f64,
        /// How long a value is held (s).
        sample_time_s: f64,
        /// Seed.
        seed: u32,
    },
}

/// A signal on the inflow, with the time in which it acts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct InflowDisturbance {
    /// The signal.
    pub signal: InflowSignal,
    /// When it begins to act (s).
    pub from_s: f64,
    /// When it ends (s).
    pub until_s: f64,
}

/// Steps of integration in a period of a sine, at least.
const STEPS_PER_PERIOD: f64 = 16.0;

impl InflowDisturbance {
    /// No disturbance.
    pub const NONE: Self = Self { signal: InflowSignal::None, from_s: 0.0, until_s: 0.0 };

    /// The longest step (s) that shows the signal, with the name of the time that bounds it: a share of the period of a sine, and
    /// the time for which a value is held. `None` for a signal that does not change.
    pub(super) fn longest_step(&self) -> Option<(&'static str, f64)> {
        let [(_, size), (name, time_s)] = self.numbers();
        match self.signal {
            InflowSignal::None | InflowSignal::Step { .. } => None,
            _ if size == 0.0 => None,
            InflowSignal::Sine { .. } => Some((name, time_s / STEPS_PER_PERIOD)),
            InflowSignal::SimulinkNormal { .. } | InflowSignal::Normal { .. } => Some((name, time_s)),
        }
    }

    /// Deviations of the inflow over steps of equal length (s): at the beginning, in the middle and at the end of each. A jump counts
    /// for a step if it comes before its middle, so both of its ends are on one side.
    pub(super) fn over_steps(&self, step_s: f64, steps: usize) -> Vec<[f64; 3]> {
        let held = self.held_values(step_s * steps as f64);
        let mut rows = Vec::with_capacity(steps);
        for k in 0..steps {
            let begin = k as f64 * step_s;
            let middle = begin + 0.5 * step_s;
            let acts = middle >= self.from_s && middle < self.until_s;
            rows.push(if acts { self.over_step(begin, step_s, &held) } else { [0.0; 3] });
        }
        rows
    }

    fn over_step(&self, begin: f64, step_s: f64, held: &[f64]) -> [f64; 3] {
        match self.signal {
            InflowSignal::None => [0.0; 3],
            InflowSignal::Step { size } => [size; 3],
            InflowSignal::Sine { amplitude, period_s } => {
                [0.0, 0.5, 1.0].map(|share| amplitude * (TAU * (begin + share * step_s) / period_s).sin())
            }
            InflowSignal::SimulinkNormal { std, sample_time_s, .. }
            | InflowSignal::Normal { std, sample_time_s, .. } => {
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "bounded by the length of the run"
                )]
                let sample = ((begin + 0.5 * step_s) / sample_time_s) as usize;
                [std * held.get(sample).copied().unwrap_or(0.0); 3]
            }
        }
    }

    /// The deviates that a run of a duration (s) holds, from t = 0 on.
    fn held_values(&self, duration_s: f64) -> Vec<f64> {
        let count = |sample_time_s: f64| {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the cast saturates")]
            let count = (duration_s / sample_time_s).ceil() as usize;
            count + 1
        };
        match self.signal {
            InflowSignal::SimulinkNormal { sample_time_s, seed, .. } => {
                ParkMillerNormal::new(seed).take(count(sample_time_s)).collect()
            }
            InflowSignal::Normal { sample_time_s, seed, .. } => {
                let mut source = GaussianSource::new(seed);
                (0..count(sample_time_s)).map(|_| source.next()).collect()
            }
            InflowSignal::None | InflowSignal::Step { .. } | InflowSignal::Sine { .. } => Vec::new(),
        }
    }

    /// The numbers of the signal with their names: a size, and a time that has to be positive.
    pub(super) fn numbers(&self) -> [(&'static str, f64); 2] {
        match self.signal {
            InflowSignal::None => [("size", 0.0), ("period_s", 1.0)],
            InflowSignal::Step { size } => [("size", size), ("period_s", 1.0)],
            InflowSignal::Sine { amplitude, period_s } => [("amplitude", amplitude), ("period_s", period_s)],
            InflowSignal::SimulinkNormal { std, sample_time_s, .. }
            | InflowSignal::Normal { std, sample_time_s, .. } => [("std", std), ("sample_time_s", sample_time_s)],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gate_cuts_what_is_outside_and_keeps_the_time_of_the_run() {
        let signal = InflowSignal::Sine { amplitude: 2.0, period_s: 8.0 };
        let rows = InflowDisturbance { signal, from_s: 1.0, until_s: 3.0 }.over_steps(0.5, 8);
        assert_eq!((rows[1], rows[6]), ([0.0; 3], [0.0; 3]));
        assert!((rows[2][0] - 2.0 * (TAU / 8.0).sin()).abs() < 1e-15);
        assert!((rows[5][2] - 2.0 * (TAU * 3.0 / 8.0).sin()).abs() < 1e-15);
    }

    #[test]
    fn held_values_change_at_samples_and_the_sequence_runs_from_the_start() {
        let of = |from_s| {
            let signal = InflowSignal::SimulinkNormal { std: 3.0, sample_time_s: 1.0, seed: 0 };
            InflowDisturbance { signal, from_s, until_s: 10.0 }.over_steps(0.25, 40)
        };
        let (whole, late) = (of(0.0), of(5.0));
        let deviates: Vec<f64> = ParkMillerNormal::new(0).take(10).collect();
        for k in 0..40 {
            assert_eq!(whole[k], [3.0 * deviates[k / 4]; 3]);
            assert_eq!(late[k], if k < 20 { [0.0; 3] } else { whole[k] });
        }
    }

    #[test]
    fn the_generator_of_the_laboratory_depends_on_its_seed_alone() {
        let of = |seed| {
            let signal = InflowSignal::Normal { std: 1.0, sample_time_s: 2.0, seed };
            InflowDisturbance { signal, from_s: 0.0, until_s: 1e9 }.over_steps(1.0, 6)
        };
        assert_eq!(of(7), of(7));
        assert_ne!(of(7)[0], of(8)[0]);
        assert_eq!(of(7)[0], of(7)[1]);
        assert_ne!(of(7)[1], of(7)[2]);
    }
}
