//! Junqueira, Neves and Angelico: the model-free law on a quadruple tank with still and moving valves.

use super::units::{CM, CM2, CM3};
use super::{DisplayUnit, PiExperiment, Preset, PresetId, ReferenceMoves};
use crate::control::Pairing;
use crate::plant::{CrossSection, Outlet, Pump, QuadrupleTank, Sensor, Tank, ValveSchedule};
use crate::sim::{Experiment, Measurement, SetPointStep};

/// Junqueira, Neves and Angelico, Table 1, with both valves at γ (case a: 0.6, case b: 0.4).
///
/// The areas are π D²/4 of the printed diameters (6.4 and 6 cm, outlets 0.43 and 0.32 cm) to seven digits. Height of
/// the tanks, sensor and operating point are not published: 30 cm, 1 V/cm and 10 cm in both lower tanks are assumed.
///
/// The source publishes no PI loops, its controller is another one. These gains are ours, found by simulation for a well damped
/// answer, diagonal for case a and swapped for case b as the relative gains ask.
pub(super) fn case(id: PresetId, gamma: f64) -> Preset {
    const HEIGHT: f64 = 30.0 * CM;
    const REST_LEVELS: [f64; 2] = [10.0 * CM, 10.0 * CM];

    let tank = |section_cm2, outlet_cm2| Tank {
        section: CrossSection::prismatic(section_cm2 * CM2),
        outlet: Outlet { area: outlet_cm2 * CM2, loss_coefficient: 1.0 },
        height: HEIGHT,
    };
    let (lower, upper) = (tank(32.16991, 0.145_220_1), tank(28.27433, 0.080_424_8));
    let plant = QuadrupleTank {
        tanks: [lower, lower, upper, upper],
        pumps: [3.33, 3.35].map(|k| Pump::proportional(k * CM3, 0.0, 12.0)),
        valves: [gamma; 2],
        valve_slopes: [0.0; 2],
        power_gain: 1.0,
        sensor: Sensor { gain: 1.0 / CM, range: HEIGHT, resolution: 0.0 },
        gravity: 981.0 * CM,
        inflow: [0.0; 4],
    };
    Preset {
        id,
        source: "Junqueira, Neves and Angelico",
        table: "Table 1",
        display_unit: DisplayUnit::Cm,
        plant,
        pump_voltage: plant.balancing_voltages(REST_LEVELS),
        pi: if gamma < 0.5 {
            PiExperiment {
                pairing: Pairing::Swapped,
                gains: [0.3; 2],
                integral_times_s: [60.0; 2],
                sampling_time_s: 1.0,
                references: ReferenceMoves::Apart([100.0, 1100.0]),
                duration_s: 2100.0,
            }
        } else {
            PiExperiment {
                pairing: Pairing::Diagonal,
                gains: [3.0; 2],
                integral_times_s: [40.0; 2],
                sampling_time_s: 1.0,
                references: ReferenceMoves::Apart([100.0, 600.0]),
                duration_s: 1100.0,
            }
        },
        printed: None,
    }
}

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

    /// The levels of tanks 1 and 2 (m) at which it begins to rest, `None` for empty tanks; and what is done.
    pub fn parts(self) -> (Option<[f64; 2]>, Experiment) {
        const REST: Option<[f64; 2]> = Some([0.1, 0.1]);
        let step = |level, time_s, size| SetPointStep { level, time_s, size };
        let (start, duration_s, set_point_steps) = match self {
            Self::S1 => (None, 300.0, vec![step(0, 0.0, 0.1), step(1, 0.0, 0.1)]),
            Self::S2 => (REST, 320.0, vec![step(0, 20.0, 0.05), step(1, 20.0, 0.05)]),
            Self::S3 => (REST, 320.0, vec![step(0, 20.0, 0.02)]),
        };
        let measurement = Measurement { noise_std: 0.0, seed: 1, quantised: false };
        (start, Experiment { set_point_steps, measurement, ..Experiment::at_rest(duration_s) })
    }
}
