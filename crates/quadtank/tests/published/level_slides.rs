//! The lecture slides on a level tank: parameters, loop gain, closed forms and vectors.

use quadtank::literature::level_slides::{self, DERIVATIVE_FILTER_S, HEATED_START, HOUR, INFLOW, MINUTE};
use quadtank::plant::level::HeatedTank;
use quadtank::sim::level::{
    InflowDisturbance, LevelController, LevelExperiment, LevelFigures, LevelSimulation, LevelStepResponse,
    SetPointScale, SignalStep, heated_run,
};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use crate::within;

/// §1.2: area, time constant, valve, sensor and loop gain, in minutes as printed.
#[test]
fn data_of_the_control_example() {
    let plant = level_slides::plant();
    within(plant.tank.area, 0.785, 0.5e-3, "area");
    let model = plant.tank.linearise(1.0);
    within(model.time_constant().unwrap() / MINUTE, 5.0, 0.005, "τ (min)");
    within(plant.flows(0.0, 1.0)[0] * MINUTE, 0.1545, 1e-9, "flow of the open valve (m³/min)");
    within(plant.transmitter.signal_of(3.0), 15.0, 1e-9, "signal at 3 m (psi)");
    let gains = plant.gains(&plant.rest(0.5, 0.0).unwrap());
    within(gains.process_gain().unwrap(), 0.328_06, 0.5e-5, "Kv Kp Km");
    // The open valve alone holds at most 0.984 m: a set-point of 1 m cannot be reached without q1.
    within(plant.level_at_output(15.0, 0.0).unwrap(), 0.984, 0.5e-3, "highest level (m)");
    assert!(plant.rest(1.0, 0.0).is_err());
}

/// §1.4: the linear loop with each of the four settings, a step of the set-point, 60 min. For a step of 1 m a second program has the
/// final level, overshoot, time of the peak, settling and rise (min), IAE, ISE (m min) and ITAE (m min²). Here the step is 0.1 mm
/// around a rest in the middle of all ranges, where the loop is linear, and the figures are divided by it.
#[test]
fn four_settings() {
    const STEP: f64 = 1e-4;
    // The transfer function in print has τ = 5 min; the area of 1 m of diameter gives 5.003.
    let mut plant = level_slides::plant();
    plant.tank.area = 5.0 / 6.37;
    let level = 0.5 * plant.level_at_output(15.0, 0.0).unwrap();
    let experiment = LevelExperiment {
        level,
        inflow: 0.0,
        duration_s: 60.0 * MINUTE,
        log_step_s: 0.01 * MINUTE,
        disturbance: InflowDisturbance::NONE,
        set_point_steps: vec![SignalStep { time_s: 0.0, size: STEP }],
        set_point_scale: SetPointScale::Level,
    };
    let simulation = LevelSimulation::new(&plant, &experiment).unwrap();
    let rows = [
        [0.3962, 0.0, f64::NAN, 11.81, 6.63, 37.43, 23.56, 1090.5],
        [1.0, 0.667, 2.39, 22.71, 0.88, 3.863, 1.546, 23.1],
        [1.0, 0.085, 13.37, 21.27, 6.50, 4.530, 2.430, 22.6],
        [1.0, 0.092, 15.95, 24.67, 8.64, 4.868, 2.057, 32.8],
    ];
    // Half a unit of the last digit, and one row of the log for times. The last setting is still 1.6e-4 away after 60 min.
    let units = [2e-4, 0.5e-3, 0.01, 0.015, 0.005, 0.5e-2, 0.5e-2, 0.05];
    for (pid, row) in level_slides::settings().into_iter().zip(rows) {
        let log = simulation.run(&LevelController::pid(pid, DERIVATIVE_FILTER_S)).unwrap();
        let answer = LevelStepResponse::of(&log, STEP).unwrap();
        let figures = LevelFigures::of(&log, plant.transmitter.gain()).unwrap();
        let found = [
            answer.change / STEP,
            answer.overshoot.unwrap(),
            answer.peak_time_s.unwrap() / MINUTE,
            answer.settling_time_s.unwrap() / MINUTE,
            answer.rise_time_s.unwrap() / MINUTE,
            figures.iae / STEP / MINUTE,
            figures.ise / (STEP * STEP) / MINUTE,
            figures.itae / STEP / (MINUTE * MINUTE),
        ];
        for k in (0..8).filter(|&k| !row[k].is_nan()) {
            let has_three_decimals = row[k] < 10.0 && (k == 5 || k == 6);
            let unit = if has_three_decimals { 0.1 * units[k] } else { units[k] };
            within(found[k], row[k], unit, &format!("figure {k} of {pid:?}"));
        }
        if pid.integral == 0.0 {
            within(answer.offset, 1.0 - 0.6561 / 1.6561, 0.5e-4, "offset of P alone");
        }
    }
}

/// §2: the analytic solution at the printed times, R = 1 h/m², A = 2 m², 10 m³/h into an empty tank.
#[test]
fn draining_tank() {
    let model = level_slides::draining_tank().linearise(0.0);
    within(model.time_constant().unwrap() / HOUR, 2.0, 1e-12, "τ (h)");
    for (hours, level) in [(1.0, 3.934_69), (2.0, 6.321_21), (4.0, 8.646_65), (10.0, 9.932_62)] {
        within(model.step_response(INFLOW, hours * HOUR), level, 0.5e-5, "level");
    }
    within(model.resistance.unwrap() * INFLOW, 10.0, 1e-12, "steady level");
}

/// §4: level and temperature of the heated tank, rows of 0.01 h.
#[test]
fn heated_tank() {
    let run = heated_run(&level_slides::heated_tank(), HEATED_START, INFLOW, 10.0 * HOUR, 0.01 * HOUR).unwrap();
    // 0:0.01:10 has 1001 points, not the 1000 of the slides.
    assert_eq!(run.time_s.len(), 1001);
    let rows = [
        (0, 2.5, 540.0),
        (10, 2.865_78, 538.3043),
        (25, 3.381_27, 536.5523),
        (50, 4.158_99, 534.7514),
        (100, 5.451_02, 532.9259),
        (200, 7.240_90, 531.5092),
        (300, 8.326_52, 530.9628),
        (500, 9.384_36, 530.5651),
        (1000, 9.949_47, 530.3972),
    ];
    for (row, level, temperature) in rows {
        within(run.level[row], level, 0.5e-5, "level");
        within(run.temperature[row], temperature, 0.5e-4, "temperature");
    }
    let tank = level_slides::heated_tank();
    within(tank.rest_temperature(INFLOW), 530.385, 0.5e-3, "temperature at rest");
    // With U per second, as printed, it would be almost that of the heater.
    let printed = HeatedTank { heat_transfer: 150e3, ..tank };
    within(printed.rest_temperature(INFLOW), 539.93, 0.5e-2, "temperature at rest with the printed unit");
}
