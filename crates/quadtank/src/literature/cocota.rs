//! Cocota (2009): a rig with a trapezoidal tank, its two settings and its PI loops.

use std::f64::consts::PI;

use super::units::{MM, MM2, MM3};
use super::{DisplayUnit, PiExperiment, Preset, PresetId, Printed, ReferenceMoves};
use crate::control::Pairing;
use crate::plant::{CrossSection, Outlet, Pump, QuadrupleTank, Sensor, Tank};

/// Cocota (2009), minimum-phase setting P−; printed numbers: Table 3.10, eq. 3.25, §3.7, eq. 4.11.
pub(super) fn minimum_phase() -> Preset {
    let printed = Printed {
        levels: [156.7, 152.5, 40.4, 43.9].map(|h| h * MM),
        level_decimals: 1,
        time_constants_s: Some([82.0, 78.0, 87.0, 91.0]),
        zeros: Some([-1.5e-2, -7.5e-3]),
        rga_11: Some(1.125),
        dc_gain: Some([[0.79, 0.25], [0.26, 0.73]]),
    };
    let pi = PiExperiment {
        pairing: Pairing::Diagonal,
        gains: [1.0, 1.0],
        integral_times_s: [32.0, 32.0],
        sampling_time_s: 1.0,
        references: ReferenceMoves::Apart([250.0, 1000.0]),
        duration_s: 1750.0,
    };
    rig(
        PresetId::CocotaMinimumPhase,
        "Tables 3.1, 3.3–3.5",
        [4470.0, 4190.0],
        0.75,
        [0.68, 0.675, 0.73, 0.73],
        printed,
        pi,
    )
}

/// Cocota (2009), non-minimum-phase setting P+; printed numbers: Table 3.11, eq. 3.26, §3.8, eq. 4.12.
pub(super) fn non_minimum_phase() -> Preset {
    let printed = Printed {
        levels: [156.1, 157.5, 234.0, 282.3].map(|h| h * MM),
        level_decimals: 1,
        time_constants_s: Some([82.0, 80.0, 219.0, 255.0]),
        zeros: Some([-9.9e-3, 1.4e-3]),
        rga_11: Some(-1.32),
        dc_gain: Some([[0.45, 0.57], [0.61, 0.43]]),
    };
    // Eqs. 4.21 and 4.22. The rig needs almost an hour to settle here (Fig. 4.8).
    let pi = PiExperiment {
        pairing: Pairing::Swapped,
        gains: [1.39, 1.75],
        integral_times_s: [380.0, 365.0],
        sampling_time_s: 1.0,
        references: ReferenceMoves::Apart([250.0, 3750.0]),
        duration_s: 7000.0,
    };
    rig(
        PresetId::CocotaNonMinimumPhase,
        "Tables 3.1, 3.7–3.9",
        [4510.0, 4250.0],
        0.43,
        [0.68, 0.68, 0.70, 0.66],
        printed,
        pi,
    )
}

fn rig(
    id: PresetId,
    table: &'static str,
    pump_gain_mm3: [f64; 2],
    gamma: f64,
    loss_coefficient: [f64; 4],
    printed: Printed,
    pi: PiExperiment,
) -> Preset {
    /// Gain of the power module `k_mod`.
    const POWER_GAIN: f64 = 1.2;
    /// Controller outputs c1, c2 at the operating point (V).
    const CONTROLLER_OUTPUT: [f64; 2] = [8.39, 8.58];
    /// Radii of the outlets (mm).
    const OUTLET_RADIUS_MM: [f64; 4] = [3.45, 3.45, 2.30, 2.30];

    let square = CrossSection::prismatic(108.0 * MM * (108.0 * MM));
    let trapezoidal = CrossSection::trapezoidal(78.0 * MM, 76.0 * MM, 23.5_f64.to_radians());
    let sections = [square, trapezoidal, square, square];
    Preset {
        id,
        source: "Cocota 2009",
        table,
        display_unit: DisplayUnit::Mm,
        plant: QuadrupleTank {
            tanks: std::array::from_fn(|j| Tank {
                section: sections[j],
                outlet: Outlet { area: PI * OUTLET_RADIUS_MM[j].powi(2) * MM2, loss_coefficient: loss_coefficient[j] },
                height: 395.0 * MM,
            }),
            pumps: pump_gain_mm3.map(|k| Pump::proportional(k * MM3, 0.0, 12.0)),
            valves: [gamma; 2],
            valve_slopes: [0.0; 2],
            power_gain: POWER_GAIN,
            sensor: Sensor { gain: 1.0 / (30.0 * MM), range: 300.0 * MM, resolution: 10.0 / 2_f64.powi(11) },
            gravity: 9787.9 * MM,
            inflow: [0.0; 4],
        },
        pump_voltage: CONTROLLER_OUTPUT.map(|c| POWER_GAIN * c),
        pi,
        printed: Some(printed),
    }
}
