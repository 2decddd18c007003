use serde::{Deserialize, Serialize};

use super::{NOMINAL_INFLOW, NOMINAL_LEVEL};
use crate::sim::level::{InflowDisturbance, InflowSignal, LevelExperiment, SetPointScale};

/// The disturbances of Andreis (2017, §5.1) on the inflow; each acts from 50 to 150 s of a run of 300 s.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum PublishedDisturbance {
    /// "Sine Wave L": 0.0085 m³/s, 50 s.
    SineL,
    /// "Sine Wave H": 0.0085 m³/s, 10 s.
    SineH,
    /// "Random": variance 9e-6 (m³/s)². Neither generator nor seed is printed; that the block of Simulink with seed 0 and samples of
    /// 1 s gives the printed variances was found by computing them.
    Random,
}

impl PublishedDisturbance {
    /// All of them, in the order of the source.
    pub const ALL: [Self; 3] = [Self::SineL, Self::SineH, Self::Random];

    /// The signal with its time.
    pub const fn disturbance(self) -> InflowDisturbance {
        let signal = match self {
            Self::SineL => InflowSignal::Sine { amplitude: 0.0085, period_s: 50.0 },
            Self::SineH => InflowSignal::Sine { amplitude: 0.0085, period_s: 10.0 },
            Self::Random => InflowSignal::SimulinkNormal { std: 0.003, sample_time_s: 1.0, seed: 0 },
        };
        InflowDisturbance { signal, from_s: 50.0, until_s: 150.0 }
    }

    /// The run of 300 s from rest at 1 m and 0.017 m³/s with a row every second. The rows and that they count with the divisor
    /// N − 1 are not printed either.
    pub fn experiment(self) -> LevelExperiment {
        LevelExperiment {
            level: NOMINAL_LEVEL,
            inflow: NOMINAL_INFLOW,
            duration_s: 300.0,
            log_step_s: 1.0,
            disturbance: self.disturbance(),
            set_point_steps: Vec::new(),
            set_point_scale: SetPointScale::Level,
        }
    }
}
