//! Johansson (2000), "The quadruple-tank process": two settings of one rig, with two PI loops.

use super::units::{CM, CM2, CM3};
use super::{DisplayUnit, PiExperiment, Preset, PresetId, Printed, ReferenceMoves};
use crate::control::Pairing;
use crate::plant::{CrossSection, Outlet, Pump, QuadrupleTank, Sensor, Tank};

/// Johansson (2000), minimum-phase setting P−.
pub(super) fn minimum_phase() -> Preset {
    let printed = Printed {
        levels: [12.4, 12.7, 1.8, 1.4].map(|h| h * CM),
        level_decimals: 1,
        time_constants_s: Some([62.0, 90.0, 23.0, 30.0]),
        zeros: Some([-0.060, -0.018]),
        rga_11: Some(1.40),
        dc_gain: None,
    };
    let pi = pi([3.0, 2.7], [30.0, 40.0]);
    rig(PresetId::JohanssonMinimumPhase, "P−", [3.33, 3.35], [0.70, 0.60], [3.00, 3.00], printed, pi)
}

/// Johansson (2000), non-minimum-phase setting P+.
#[expect(clippy::approx_constant, reason = "k1 = 3.14 cm³/(V s) has nothing to do with π")]
pub(super) fn non_minimum_phase() -> Preset {
    let printed = Printed {
        levels: [12.6, 13.0, 4.8, 4.9].map(|h| h * CM),
        level_decimals: 1,
        time_constants_s: Some([63.0, 91.0, 39.0, 56.0]),
        zeros: Some([-0.057, 0.013]),
        rga_11: Some(-0.64),
        dc_gain: None,
    };
    let pi = pi([1.5, -0.12], [110.0, 220.0]);
    rig(PresetId::JohanssonNonMinimumPhase, "P+", [3.14, 3.29], [0.43, 0.34], [3.15, 3.15], printed, pi)
}

fn rig(
    id: PresetId,
    table: &'static str,
    pump_gain_cm3: [f64; 2],
    valves: [f64; 2],
    pump_voltage: [f64; 2],
    printed: Printed,
    pi: PiExperiment,
) -> Preset {
    let height = 20.0 * CM;
    let tank = |section_cm2, outlet_cm2| Tank {
        section: CrossSection::prismatic(section_cm2 * CM2),
        outlet: Outlet { area: outlet_cm2 * CM2, loss_coefficient: 1.0 },
        height,
    };
    let (odd, even) = (tank(28.0, 0.071), tank(32.0, 0.057));
    Preset {
        id,
        source: "Johansson 2000",
        table,
        display_unit: DisplayUnit::Cm,
        plant: QuadrupleTank {
            tanks: [odd, even, odd, even],
            pumps: pump_gain_cm3.map(|k| Pump::proportional(k * CM3, 0.0, 10.0)),
            valves,
            valve_slopes: [0.0; 2],
            power_gain: 1.0,
            sensor: Sensor { gain: 0.50 / CM, range: height, resolution: 0.0 },
            gravity: 981.0 * CM,
            inflow: [0.0; 4],
        },
        pump_voltage,
        pi,
        printed: Some(printed),
    }
}

/// The printed PI loops, diagonal in both settings. The times of the experiment are ours.
fn pi(gains: [f64; 2], integral_times_s: [f64; 2]) -> PiExperiment {
    PiExperiment {
        pairing: Pairing::Diagonal,
        gains,
        integral_times_s,
        sampling_time_s: 1.0,
        references: ReferenceMoves::Apart([100.0, 1500.0]),
        duration_s: 3000.0,
    }
}
