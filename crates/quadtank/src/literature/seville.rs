//! Alvarado et al. (2011): the four-tank benchmark of the HD-MPC project, a rig in Seville on which predictive controllers were compared.

use super::{DisplayUnit, PiExperiment, Preset, PresetId, Printed, ReferenceMoves};
use crate::control::Pairing;
use crate::plant::{CrossSection, Outlet, Pump, QuadrupleTank, Sensor, Tank};

/// The references of the benchmark (m) and when they come (s). Before the first of them it asks for 0.65 m in both tanks, which is
/// where the rig rests, to the digits it is printed with.
const SEQUENCE: &[(f64, [f64; 2])] = &[(3000.0, [0.30, 0.30]), (6000.0, [0.50, 0.75]), (9000.0, [0.90, 0.75])];

/// The benchmark. Its inputs are flows in m³/h: one volt stands for 1 m³/h at the pumps, and for 1 m at the sensors.
///
/// The benchmark also asks for levels of at least 0.2 m, which is a matter of the controller. It prints no PI loops: these are those
/// of [SIMC](crate::tuning::ModelRule::Simc) (Skogestad 2003, half rule, `τc = 1.2 τ1`) for the swapped pairing, rounded.
pub(super) fn preset() -> Preset {
    /// Seconds in an hour: m³/h to m³/s.
    const HOUR: f64 = 3600.0;
    const OUTLETS_M2: [f64; 4] = [1.31e-4, 1.51e-4, 9.27e-5, 8.82e-5];
    const HEIGHTS: [f64; 4] = [1.36, 1.36, 1.30, 1.30];

    Preset {
        id: PresetId::Seville,
        source: "Alvarado et al. 2011",
        table: "HD-MPC four-tank benchmark",
        display_unit: DisplayUnit::M,
        plant: QuadrupleTank {
            tanks: std::array::from_fn(|j| Tank {
                section: CrossSection::prismatic(0.06),
                outlet: Outlet { area: OUTLETS_M2[j], loss_coefficient: 1.0 },
                height: HEIGHTS[j],
            }),
            pumps: [3.26, 4.0].map(|most| Pump::proportional(1.0 / HOUR, 0.0, most)),
            valves: [0.3, 0.4],
            valve_slopes: [0.0; 2],
            power_gain: 1.0,
            sensor: Sensor { gain: 1.0, range: 1.36, resolution: 0.0 },
            gravity: 9.81,
            inflow: [0.0; 4],
        },
        pump_voltage: [1.63, 2.00],
        pi: PiExperiment {
            pairing: Pairing::Swapped,
            gains: [1.5; 2],
            integral_times_s: [320.0; 2],
            sampling_time_s: 5.0,
            references: ReferenceMoves::Sequence(SEQUENCE),
            duration_s: 12_000.0,
        },
        printed: Some(Printed::levels([0.65, 0.66, 0.65, 0.66], 2)),
    }
}
