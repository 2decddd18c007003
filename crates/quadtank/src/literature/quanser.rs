//! The coupled tanks of Quanser, with the numbers that `MPCtools` and jMPC use.

use super::units::{CM, CM2, CM3};
use super::{DisplayUnit, PiExperiment, Preset, PresetId, Printed, ReferenceMoves};
use crate::control::Pairing;
use crate::plant::{CrossSection, Outlet, Pump, QuadrupleTank, Sensor, Tank};

/// The rig of `MPCtools` and jMPC.
///
/// Their pumps take −12 to 12 V. Pumps of this laboratory do not run backwards, so the limits are 0 and 12 V. Height of the tanks and
/// sensors are ours: 30 cm, 1 V/cm. There are no PI loops: these are those of [SIMC](crate::tuning::ModelRule::Simc) (Skogestad 2003, half rule,
/// `τc = τ1`) for the swapped pairing, rounded.
pub(super) fn preset() -> Preset {
    const HEIGHT: f64 = 30.0 * CM;

    let tank = Tank {
        section: CrossSection::prismatic(15.5179 * CM2),
        outlet: Outlet { area: 0.1781 * CM2, loss_coefficient: 1.0 },
        height: HEIGHT,
    };
    Preset {
        id: PresetId::Quanser,
        source: "MPCtools, jMPC",
        table: "quadruple tank of Quanser",
        display_unit: DisplayUnit::Cm,
        plant: QuadrupleTank {
            tanks: [tank; 4],
            pumps: [4.35, 4.39].map(|k| Pump::proportional(k * CM3, 0.0, 12.0)),
            valves: [0.36; 2],
            valve_slopes: [0.0; 2],
            power_gain: 1.0,
            sensor: Sensor { gain: 1.0 / CM, range: HEIGHT, resolution: 0.0 },
            gravity: 981.0 * CM,
            inflow: [0.0; 4],
        },
        pump_voltage: [7.0, 7.0],
        pi: PiExperiment {
            pairing: Pairing::Swapped,
            gains: [0.29, 0.30],
            integral_times_s: [20.0; 2],
            sampling_time_s: 1.0,
            references: ReferenceMoves::Apart([100.0, 500.0]),
            duration_s: 900.0,
        },
        printed: Some(Printed::levels([15.0751, 15.0036, 6.2151, 6.1003].map(|h| h * CM), 4)),
    }
}
