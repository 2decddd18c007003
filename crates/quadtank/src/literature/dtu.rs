//! The modified four-tank system of a course at DTU: water from outside runs into the upper tanks (Azam and Jørgensen 2015).

use super::units::{CM, CM2, CM3};
use super::{DisplayUnit, PiExperiment, Preset, PresetId, Printed, ReferenceMoves};
use crate::control::Pairing;
use crate::plant::{CrossSection, Outlet, Pump, QuadrupleTank, Sensor, Tank};

/// The rig of the course. Its inputs are flows in cm³/s: one volt stands for 1 cm³/s at the pumps, and for 1 cm at the sensors.
///
/// The course prints masses of water of density 1 g/cm³; the levels are these masses over the area. Height of the tanks (1 m) is
/// ours. There are no PI loops: these are those of [SIMC](crate::tuning::ModelRule::Simc) (Skogestad 2003, `τc = T/2`) for the diagonal pairing, rounded.
pub(super) fn preset() -> Preset {
    const AREA_CM2: f64 = 380.1327;
    const MASSES_G: [f64; 4] = [17_612.012_4, 29_640.669_5, 4_644.219_5, 9_378.493_1];
    const HEIGHT: f64 = 100.0 * CM;

    let tank = Tank {
        section: CrossSection::prismatic(AREA_CM2 * CM2),
        outlet: Outlet { area: 1.2272 * CM2, loss_coefficient: 1.0 },
        height: HEIGHT,
    };
    Preset {
        id: PresetId::Dtu,
        source: "DTU",
        table: "course on the modified four-tank system",
        display_unit: DisplayUnit::Cm,
        plant: QuadrupleTank {
            tanks: [tank; 4],
            pumps: [Pump::proportional(CM3, 0.0, 500.0); 2],
            valves: [0.6, 0.7],
            valve_slopes: [0.0; 2],
            power_gain: 1.0,
            sensor: Sensor { gain: 1.0 / CM, range: HEIGHT, resolution: 0.0 },
            gravity: 981.0 * CM,
            inflow: [0.0, 0.0, 100.0 * CM3, 150.0 * CM3],
        },
        pump_voltage: [300.0, 300.0],
        pi: PiExperiment {
            pairing: Pairing::Diagonal,
            gains: [13.0, 8.7],
            integral_times_s: [95.0, 124.0],
            sampling_time_s: 1.0,
            references: ReferenceMoves::Apart([100.0, 800.0]),
            duration_s: 1500.0,
        },
        // A ten-thousandth of a gram is a quarter of a millionth of a centimetre.
        printed: Some(Printed::levels(MASSES_G.map(|mass| mass / AREA_CM2 * CM), 6)),
    }
}
