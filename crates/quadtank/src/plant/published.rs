//! The published parameters, each as its source prints it: lengths in cm or mm, converted to SI here.

use std::f64::consts::PI;

use super::{CrossSection, DisplayUnit, Outlet, Preset, PresetId, Printed, Pump, QuadrupleTank, Remark, Sensor, Tank};

const CM: f64 = 1e-2;
const CM2: f64 = 1e-4;
const CM3: f64 = 1e-6;
const MM: f64 = 1e-3;
const MM2: f64 = 1e-6;
const MM3: f64 = 1e-9;

/// Johansson (2000), minimum-phase setting P−.
pub(super) fn johansson_minimum_phase() -> Preset {
    let printed = Printed {
        levels: [12.4, 12.7, 1.8, 1.4].map(|h| h * CM),
        time_constants_s: [62.0, 90.0, 23.0, 30.0],
        zeros: [-0.060, -0.018],
        rga_11: 1.40,
        dc_gain: None,
    };
    johansson(PresetId::JohanssonMinimumPhase, "P−", [3.33, 3.35], [0.70, 0.60], [3.00, 3.00], printed)
}

/// Johansson (2000), non-minimum-phase setting P+.
#[expect(clippy::approx_constant, reason = "k1 = 3.14 cm³/(V s) has nothing to do with π")]
pub(super) fn johansson_non_minimum_phase() -> Preset {
    let printed = Printed {
        levels: [12.6, 13.0, 4.8, 4.9].map(|h| h * CM),
        time_constants_s: [63.0, 91.0, 39.0, 56.0],
        zeros: [-0.057, 0.013],
        rga_11: -0.64,
        dc_gain: None,
    };
    johansson(PresetId::JohanssonNonMinimumPhase, "P+", [3.14, 3.29], [0.43, 0.34], [3.15, 3.15], printed)
}

fn johansson(
    id: PresetId,
    table: &'static str,
    pump_gain_cm3: [f64; 2],
    valves: [f64; 2],
    pump_voltage: [f64; 2],
    printed: Printed,
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
            pumps: pump_gain_cm3.map(|k| Pump { gain: k * CM3, voltage_min: 0.0, voltage_max: 10.0 }),
            valves,
            power_gain: 1.0,
            sensor: Sensor { gain: 0.50 / CM, range: height, resolution: 0.0 },
            gravity: 981.0 * CM,
        },
        pump_voltage,
        remarks: &[Remark::PrintedLevelsNotAtRest],
        printed: Some(printed),
    }
}

/// Cocota (2009), minimum-phase setting P−; printed numbers: Table 3.10, eq. 3.25, §3.7, eq. 4.11.
pub(super) fn cocota_minimum_phase() -> Preset {
    let printed = Printed {
        levels: [156.7, 152.5, 40.4, 43.9].map(|h| h * MM),
        time_constants_s: [82.0, 78.0, 87.0, 91.0],
        zeros: [-1.5e-2, -7.5e-3],
        rga_11: 1.125,
        dc_gain: Some([[0.79, 0.25], [0.26, 0.73]]),
    };
    cocota(
        PresetId::CocotaMinimumPhase,
        "Tables 3.1, 3.3–3.5",
        [4470.0, 4190.0],
        0.75,
        [0.68, 0.675, 0.73, 0.73],
        printed,
    )
}

/// Cocota (2009), non-minimum-phase setting P+; printed numbers: Table 3.11, eq. 3.26, §3.8, eq. 4.12.
pub(super) fn cocota_non_minimum_phase() -> Preset {
    let printed = Printed {
        levels: [156.1, 157.5, 234.0, 282.3].map(|h| h * MM),
        time_constants_s: [82.0, 80.0, 219.0, 255.0],
        zeros: [-9.9e-3, 1.4e-3],
        rga_11: -1.32,
        dc_gain: Some([[0.45, 0.57], [0.61, 0.43]]),
    };
    cocota(
        PresetId::CocotaNonMinimumPhase,
        "Tables 3.1, 3.7–3.9",
        [4510.0, 4250.0],
        0.43,
        [0.68, 0.68, 0.70, 0.66],
        printed,
    )
}

fn cocota(
    id: PresetId,
    table: &'static str,
    pump_gain_mm3: [f64; 2],
    gamma: f64,
    loss_coefficient: [f64; 4],
    printed: Printed,
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
            pumps: pump_gain_mm3.map(|k| Pump { gain: k * MM3, voltage_min: 0.0, voltage_max: 12.0 }),
            valves: [gamma; 2],
            power_gain: POWER_GAIN,
            sensor: Sensor { gain: 1.0 / (30.0 * MM), range: 300.0 * MM, resolution: 10.0 / 2_f64.powi(11) },
            gravity: 9787.9 * MM,
        },
        pump_voltage: CONTROLLER_OUTPUT.map(|c| POWER_GAIN * c),
        remarks: &[Remark::TrapezoidalTank, Remark::PrintedLevelsNotAtRest],
        printed: Some(printed),
    }
}

/// Junqueira, Neves and Angelico, Table 1, with both valves at γ (case a: 0.6, case b: 0.4).
///
/// The areas are π D²/4 of the printed diameters (6.4 and 6 cm, outlets 0.43 and 0.32 cm) to seven digits. Height of
/// the tanks, sensor and operating point are not published: 30 cm, 1 V/cm and 10 cm in both lower tanks are assumed.
pub(super) fn junqueira(id: PresetId, gamma: f64) -> Preset {
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
        pumps: [3.33, 3.35].map(|k| Pump { gain: k * CM3, voltage_min: 0.0, voltage_max: 12.0 }),
        valves: [gamma; 2],
        power_gain: 1.0,
        sensor: Sensor { gain: 1.0 / CM, range: HEIGHT, resolution: 0.0 },
        gravity: 981.0 * CM,
    };
    Preset {
        id,
        source: "Junqueira, Neves and Angelico",
        table: "Table 1",
        display_unit: DisplayUnit::Cm,
        plant,
        pump_voltage: plant.balancing_voltages(REST_LEVELS),
        remarks: &[Remark::AssumedHeight, Remark::ChosenOperatingPoint],
        printed: None,
    }
}
