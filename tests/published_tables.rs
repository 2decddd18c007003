//! The numbers of the sources, reproduced to the digits they are printed with. One test per table or statement.
//!
//! Levels, time constants and models at a *printed* point use the printed levels, rounded as they are; those at rest use
//! the exact equilibrium of the printed inputs.
#![cfg(not(target_arch = "wasm32"))]

use std::array::from_fn;

use nalgebra::{Vector2, Vector4};
use quadtank::plant::{Disturbance, Jacobian, OperatingPoint, Outlet, Preset, PresetId, Printed, QuadrupleTank};

const CM: f64 = 1e-2;
const MM: f64 = 1e-3;

/// Half a unit in the last printed digit.
#[track_caller]
fn assert_printed(found: f64, printed: f64, last_digit: f64) {
    assert!((found - printed).abs() <= 0.5 * last_digit * (1.0 + 1e-9), "{found} is not printed as {printed}");
}

#[track_caller]
fn assert_all_printed<const N: usize>(found: [f64; N], printed: [f64; N], last_digit: f64) {
    for (found, printed) in found.into_iter().zip(printed) {
        assert_printed(found, printed, last_digit);
    }
}

fn printed(preset: &Preset) -> Printed {
    preset.printed.unwrap()
}

/// The point that the source prints, which is not exactly at rest.
fn printed_point(preset: &Preset) -> OperatingPoint {
    OperatingPoint { levels: printed(preset).levels, pump_voltage: preset.pump_voltage }
}

fn time_constants(preset: &Preset) -> [f64; 4] {
    preset.plant.time_constants_s(&printed_point(preset)).map(Option::unwrap)
}

fn levels_at_rest(preset: &Preset) -> [f64; 4] {
    preset.plant.equilibrium(preset.pump_voltage).unwrap().levels
}

// Johansson (2000)

#[test]
fn johansson_minimum_phase_time_constants() {
    let preset = PresetId::JohanssonMinimumPhase.preset();
    assert_all_printed(time_constants(&preset), [62.70, 90.34, 23.89, 29.99], 0.01);
    // The paper cuts digits off rather than rounding: 62, 90, 23, 30.
    for (found, printed) in time_constants(&preset).into_iter().zip(printed(&preset).time_constants_s) {
        assert!((found - printed).abs() < 1.0);
    }
}

#[test]
fn johansson_non_minimum_phase_time_constants() {
    let preset = PresetId::JohanssonNonMinimumPhase.preset();
    assert_all_printed(time_constants(&preset), printed(&preset).time_constants_s, 1.0);
    assert_all_printed(time_constants(&preset), [63.21, 91.40, 39.01, 56.11], 0.01);
}

#[test]
fn johansson_levels_are_not_at_rest() {
    let minimum = PresetId::JohanssonMinimumPhase.preset();
    assert_all_printed(levels_at_rest(&minimum).map(|h| h / CM), [12.263, 12.783, 1.634, 1.409], 0.001);
    let non_minimum = PresetId::JohanssonNonMinimumPhase.preset();
    assert_all_printed(levels_at_rest(&non_minimum).map(|h| h / CM), [12.442, 13.167, 4.730, 4.986], 0.001);

    let largest_difference = [minimum, non_minimum]
        .iter()
        .flat_map(|preset| levels_at_rest(preset).into_iter().zip(printed(preset).levels))
        .map(|(exact, printed)| (exact - printed).abs() / CM)
        .fold(0.0, f64::max);
    assert_printed(largest_difference, 0.17, 0.01);
}

// Cocota (2009), chapter 3

#[test]
fn cocota_table_3_1_general_parameters() {
    let plant = PresetId::CocotaMinimumPhase.preset().plant;
    let [tank_1, tank_2, tank_3, tank_4] = plant.tanks;
    for tank in [tank_1, tank_3, tank_4] {
        assert_printed(tank.section.area(0.2) / (MM * MM), 11664.0, 1.0);
    }
    assert_printed(tank_2.section.area_at_empty / (MM * MM), 78.0 * 76.0, 1.0);
    for (tank, area_mm2) in plant.tanks.iter().zip([37.4, 37.4, 16.6, 16.6]) {
        assert_printed(tank.outlet.area / (MM * MM), area_mm2, 0.1);
    }
    // The sensor spans 0–300 mm with 0–10 V, the controller 0–10 V for 0–12 V at the pump.
    assert_printed(plant.sensor.measure(300.0 * MM), 10.0, 1e-12);
    assert_all_printed(plant.controller_limits().map(|(_, max)| max), [10.0, 10.0], 1e-12);
}

/// Outlets plugged, both pumps on for 104 s: what stands in the tanks tells valves and pump gains.
#[test]
fn cocota_table_3_3_filling_experiment() {
    let plant = PresetId::CocotaMinimumPhase.preset().plant;
    let volume: [f64; 4] = from_fn(|j| plant.tanks[j].section.volume([302.0, 304.0, 96.0, 99.0][j] * MM));
    let gamma_1 = volume[0] / (volume[0] + volume[3]);
    let gamma_2 = volume[1] / (volume[1] + volume[2]);
    assert_all_printed([gamma_1, gamma_2], [0.7531, 0.7506], 0.0001);

    let volts = [8.39, 8.58].map(|c| plant.power_gain * c);
    let k1 = (volume[0] + volume[3]) / (104.0 * volts[0]) / MM.powi(3);
    let k2 = (volume[1] + volume[2]) / (104.0 * volts[1]) / MM.powi(3);
    assert_all_printed([k1, k2], [4467.0, 4192.0], 1.0);
    // The table rounds to two and three digits.
    assert_all_printed([gamma_1, gamma_2], plant.valves, 0.01);
    assert_all_printed([k1, k2], plant.pumps.map(|pump| pump.gain / MM.powi(3)), 10.0);
}

/// 20 min with open outlets: the levels at rest tell the loss coefficients, with the outlet areas as Table 3.1 rounds
/// them.
#[test]
fn cocota_table_3_4_steady_state_experiment() {
    let preset = PresetId::CocotaMinimumPhase.preset();
    let plant = preset.plant;
    let inflow = plant.valve_flows(&preset.pump_voltage, &Disturbance::default());
    let through = [inflow[0] + inflow[2], inflow[1] + inflow[3], inflow[2], inflow[3]];
    let loss_coefficient: [f64; 4] = from_fn(|j| {
        let mut tank = plant.tanks[j];
        tank.outlet = Outlet { area: [37.4, 37.4, 16.6, 16.6][j] * MM * MM, loss_coefficient: 1.0 };
        through[j] / tank.outflow(printed(&preset).levels[j], plant.gravity)
    });
    assert_all_printed(loss_coefficient, [0.6799, 0.6748, 0.7306, 0.7311], 0.0001);
    let table = plant.tanks.map(|tank| tank.outlet.loss_coefficient);
    assert_all_printed([loss_coefficient[1]], [table[1]], 0.001);
    for j in [0, 2, 3] {
        assert_printed(loss_coefficient[j], table[j], 0.01);
    }
}

/// The printed levels are at rest up to what the sensor resolves: the exact ones.
#[test]
fn cocota_tables_3_5_and_3_9_levels_at_rest() {
    let minimum = levels_at_rest(&PresetId::CocotaMinimumPhase.preset());
    assert_all_printed(minimum.map(|h| h / MM), [156.729, 152.473, 40.371, 43.934], 0.001);
    assert_all_printed(minimum.map(|h| h / MM), [156.7, 152.5, 40.4, 43.9], 0.1);
    let non_minimum = levels_at_rest(&PresetId::CocotaNonMinimumPhase.preset());
    assert_all_printed(non_minimum.map(|h| h / MM), [156.229, 157.855, 234.822, 284.427], 0.001);
}

#[test]
fn cocota_table_3_10_time_constants_minimum_phase() {
    let preset = PresetId::CocotaMinimumPhase.preset();
    assert_all_printed(time_constants(&preset), printed(&preset).time_constants_s, 1.0);
    assert_all_printed(time_constants(&preset), [82.083, 77.646, 87.353, 91.059], 0.001);
}

#[test]
fn cocota_table_3_11_time_constants_non_minimum_phase() {
    let preset = PresetId::CocotaNonMinimumPhase.preset();
    assert_all_printed(time_constants(&preset), printed(&preset).time_constants_s, 1.0);
    assert_all_printed(time_constants(&preset), [81.926, 79.589, 219.241, 255.402], 0.001);
}

#[test]
fn cocota_figure_3_8_open_loop_minimum_phase() {
    let run = OpenLoop::of(PresetId::CocotaMinimumPhase);
    let [before, end] = run.levels_mm(1000.0, 1750.0);
    assert_all_printed(before.nonlinear, [181.38, 160.42], 0.01);
    assert_all_printed(before.linear, [180.48, 160.33], 0.01);
    assert_all_printed(end.nonlinear, [189.62, 184.48], 0.01);
    assert_all_printed(end.linear, [188.06, 182.97], 0.01);
}

#[test]
fn cocota_figure_3_9_open_loop_non_minimum_phase() {
    let run = OpenLoop::of(PresetId::CocotaNonMinimumPhase);
    let [before, end] = run.levels_mm(2250.0, 4250.0);
    assert_all_printed(before.nonlinear, [170.25, 176.64], 0.01);
    assert_all_printed(before.linear, [169.95, 176.12], 0.01);
    assert_all_printed(end.nonlinear, [189.03, 191.00], 0.01);
    assert_all_printed(end.linear, [187.47, 189.43], 0.01);
}

/// Pump 1 rises by 10 % at 250 s, pump 2 by 10 % at a later time.
struct OpenLoop {
    plant: QuadrupleTank,
    rest: OperatingPoint,
    model: Jacobian,
}

/// Levels of tanks 1 and 2 (mm).
struct LowerLevels {
    nonlinear: [f64; 2],
    linear: [f64; 2],
}

impl OpenLoop {
    fn of(id: PresetId) -> Self {
        let Preset { plant, pump_voltage, .. } = id.preset();
        let rest = plant.equilibrium(pump_voltage).unwrap();
        Self { plant, rest, model: plant.linearise(&rest) }
    }

    /// Just before the second step and at the end.
    fn levels_mm(&self, second_step: f64, end: f64) -> [LowerLevels; 2] {
        let rest = Vector4::from(self.rest.levels);
        let [v1, v2] = self.rest.pump_voltage;
        let stages = [(250.0, 1.0, 1.0), (second_step, 1.1, 1.0), (end, 1.1, 1.1)];
        let (mut time, mut nonlinear, mut linear) = (0.0, rest, Vector4::zeros());
        let mut reports = Vec::new();
        for (until, factor_1, factor_2) in stages {
            let voltage = [factor_1 * v1, factor_2 * v2];
            let u = Vector2::new(voltage[0] - v1, voltage[1] - v2);
            let plant =
                |h: Vector4<f64>| Vector4::from(self.plant.derivative(&h.into(), &voltage, &Disturbance::default()));
            nonlinear = runge_kutta(nonlinear, until - time, plant);
            linear = runge_kutta(linear, until - time, |x| self.model.a * x + self.model.b * u);
            time = until;
            let lower = |h: Vector4<f64>| [h[0] / MM, h[1] / MM];
            reports.push(LowerLevels { nonlinear: lower(nonlinear), linear: lower(rest + linear) });
        }
        let [_, before, end] = <[LowerLevels; 3]>::try_from(reports).ok().unwrap();
        [before, end]
    }
}

/// Classical Runge–Kutta with steps of about 1 s, far below every time constant here.
fn runge_kutta(mut x: Vector4<f64>, duration: f64, f: impl Fn(Vector4<f64>) -> Vector4<f64>) -> Vector4<f64> {
    let steps = duration.ceil();
    let dt = duration / steps;
    for _ in 0..steps as usize {
        let k1 = f(x);
        let k2 = f(x + k1 * (dt / 2.0));
        let k3 = f(x + k2 * (dt / 2.0));
        let k4 = f(x + k3 * dt);
        x += (k1 + k2 * 2.0 + k3 * 2.0 + k4) * (dt / 6.0);
    }
    x
}

// Junqueira, Neves and Angelico: recomputed values, as the paper prints none

#[test]
fn junqueira_steady_states_for_equal_levels() {
    for id in [PresetId::JunqueiraA, PresetId::JunqueiraB] {
        let plant = id.preset().plant;
        for (level_cm, volts) in [(5.0, [4.31934, 4.29355]), (10.0, [6.10846, 6.07200]), (15.0, [7.48131, 7.43665])] {
            let point = plant.inputs_for_levels([level_cm * CM; 2]).unwrap();
            assert_all_printed(point.pump_voltage, volts, 0.00001);
        }
    }
}

#[test]
fn junqueira_upper_levels_at_ten_centimetres() {
    // Our outlet areas are rounded to seven digits, which moves the last digit of the first two.
    for (gamma, level_cm, last_digit) in [(0.6, 5.2167, 1e-4), (0.4, 11.7375, 1e-4), (0.5, 8.15, 1e-2)] {
        let preset = PresetId::JunqueiraA.preset();
        let levels = preset.plant.with_valves([gamma; 2]).free_equilibrium(preset.pump_voltage).levels;
        assert_all_printed([levels[2] / CM, levels[3] / CM], [level_cm; 2], last_digit);
    }
}

#[test]
fn junqueira_linearisation_at_ten_centimetres() {
    for (id, upper) in [(PresetId::JunqueiraA, 36.26), (PresetId::JunqueiraB, 54.38)] {
        let preset = id.preset();
        let rest = preset.plant.free_equilibrium(preset.pump_voltage);
        let found = preset.plant.time_constants_s(&rest).map(Option::unwrap);
        assert_all_printed(found, [31.63, 31.63, upper, upper], 0.01);
    }
}
