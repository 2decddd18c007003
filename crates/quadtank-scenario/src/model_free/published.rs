use crate::PlantSpec;
use quadtank::control::ModelFree;
use quadtank::plant::{PresetId, ValveSchedule};
use quadtank::sim::{Experiment, Measurement, SetPointStep};

use super::{ModelFreeSetup, StartSpec};

/// The valves of the published cases (Junqueira, Neves and Angelico).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PublishedValves {
    /// γ = 0.6: minimum phase.
    A,
    /// γ = 0.4: a zero in the right half-plane.
    B,
    /// γ1 = 0.5 + 0.1 sin 0.2 t, γ2 = 0.5 + 0.1 sin 0.5 t: the zero moves through the origin and back.
    C,
}

/// Experiments for these cases. The paper prints neither set-points nor initial levels: these are ours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PublishedExperiment {
    /// Empty tanks, both set-points at 10 cm, 300 s.
    S1,
    /// From rest at 10 cm both set-points step to 15 cm at 20 s; until 320 s.
    S2,
    /// From rest at 10 cm set-point 1 alone steps to 12 cm at 20 s; until 320 s.
    S3,
}

impl PublishedValves {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::A, Self::B, Self::C];

    /// How the valves move.
    pub const fn schedules(self) -> [ValveSchedule; 2] {
        const fn sine(frequency: f64) -> ValveSchedule {
            ValveSchedule::Sine { mean: 0.5, amplitude: 0.1, frequency, phase: 0.0 }
        }
        match self {
            Self::A => [ValveSchedule::Constant { gamma: 0.6 }; 2],
            Self::B => [ValveSchedule::Constant { gamma: 0.4 }; 2],
            Self::C => [sine(0.2), sine(0.5)],
        }
    }
}

impl PublishedExperiment {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::S1, Self::S2, Self::S3];

    /// Where it begins and what is done.
    fn parts(self) -> (StartSpec, Experiment) {
        const REST: StartSpec = StartSpec::Rest([0.1, 0.1]);
        let step = |level, time_s, size| SetPointStep { level, time_s, size };
        let (start, duration_s, set_point_steps) = match self {
            Self::S1 => (StartSpec::Empty, 300.0, vec![step(0, 0.0, 0.1), step(1, 0.0, 0.1)]),
            Self::S2 => (REST, 320.0, vec![step(0, 20.0, 0.05), step(1, 20.0, 0.05)]),
            Self::S3 => (REST, 320.0, vec![step(0, 20.0, 0.02)]),
        };
        let measurement = Measurement { noise_std: 0.0, seed: 1, quantised: false };
        (start, Experiment { duration_s, set_point_steps, load_steps: Vec::new(), measurement })
    }
}

/// A published case under the published law.
pub fn published_model_free(valves: PublishedValves, experiment: PublishedExperiment) -> ModelFreeSetup {
    let (start, experiment) = experiment.parts();
    ModelFreeSetup {
        plant: PlantSpec::Preset(PresetId::JunqueiraA),
        valves: valves.schedules(),
        start,
        controller: ModelFree::PUBLISHED,
        compare: None,
        experiment,
    }
}
