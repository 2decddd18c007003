//! Junqueira, Neves and Angelico: the numbers that a second program found for the published cases.

use quadtank::control::{
    EstimatorSettings, FedWith, ModelFree, ModelFreeAntiWindup, ModelFreeSettings, Pairing, Window,
    continuous_model_free_poles, model_free_poles, smallest_model_gain, smallest_model_gain_of_integrator,
};
use quadtank::interaction::{niederlinski, relative_gain_array};
use quadtank::linear::{Stability, StateSpace, transmission_zeros};
use quadtank::literature::PresetId;
use quadtank::plant::{OperatingPoint, QuadrupleTank, ValveSchedule};
use quadtank::sim::{
    EventKind, Experiment, ModelFreeRun, SetPointStep, TrackingMetrics, ZeroDynamics, ZeroDynamicsEnd,
    simulate_model_free, tracking_metrics,
};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

const CM: f64 = 0.01;

fn case(name: char) -> [ValveSchedule; 2] {
    let sine = |frequency| ValveSchedule::Sine { mean: 0.5, amplitude: 0.1, frequency, phase: 0.0 };
    match name {
        'a' => [ValveSchedule::Constant { gamma: 0.6 }; 2],
        'b' => [ValveSchedule::Constant { gamma: 0.4 }; 2],
        _ => [sine(0.2), sine(0.5)],
    }
}

fn plant() -> QuadrupleTank {
    PresetId::JunqueiraA.preset().plant
}

fn experiment(duration_s: f64, steps: &[(usize, f64, f64)]) -> Experiment {
    Experiment {
        set_point_steps: steps
            .iter()
            .map(|&(level, time_s, cm)| SetPointStep { level, time_s, size: cm * CM })
            .collect(),
        ..Experiment::at_rest(duration_s)
    }
}

const EMPTY: OperatingPoint = OperatingPoint { levels: [0.0; 4], pump_voltage: [0.0; 2] };

fn s1(valves: &[ValveSchedule; 2], law: &ModelFree) -> (ModelFreeRun, [TrackingMetrics; 2]) {
    let experiment = experiment(300.0, &[(0, 0.0, 10.0), (1, 0.0, 10.0)]);
    let run = simulate_model_free(&plant(), valves, &EMPTY, law, &experiment).unwrap();
    let figures = tracking_metrics(&run.trajectory, run.rows_per_sample, &plant(), Pairing::Diagonal);
    (run, figures)
}

/// Figures of a run with their printed digits: IAE (cm s), ISE (cm² s), overshoot (%), settling (s), total variation (V).
type Row = [f64; 5];

fn assert_row(name: char, figures: &TrackingMetrics, [iae, ise, overshoot, settling, variation]: Row) {
    within(figures.iae / CM, iae, 0.05, name);
    within(figures.ise / (CM * CM), ise, 0.05, name);
    within(figures.overshoot.unwrap() * 100.0, overshoot, 0.05, name);
    assert_eq!(figures.settling_s, Some(settling), "{name}");
    let digit = if variation > 100.0 { 0.5 } else { 0.05 };
    within(figures.total_variation, variation, digit, name);
}

/// Half a unit of the last printed digit, and rounding.
fn within(found: f64, printed: f64, half_digit: f64, name: char) {
    assert!((found - printed).abs() <= half_digit * 1.000_001, "{name}: {found} instead of {printed}");
}

fn law_without_estimator() -> ModelFree {
    ModelFree { estimator: None, ..ModelFree::PUBLISHED }
}

fn with_windup(anti_windup: ModelFreeAntiWindup) -> ModelFree {
    let loops = ModelFree::PUBLISHED.loops.map(|settings| ModelFreeSettings { anti_windup, ..settings });
    ModelFree { loops, ..ModelFree::PUBLISHED }
}

fn at_rest(name: char) -> (QuadrupleTank, OperatingPoint) {
    let plant = plant().with_valves(case(name).map(|valve| valve.at(0.0)));
    (plant, plant.inputs_for_levels([10.0 * CM, 10.0 * CM]).unwrap())
}

/// From rest at 10 cm, with steps (loop, time, cm).
fn from_rest(name: char, law: &ModelFree, duration_s: f64, steps: &[(usize, f64, f64)]) -> ModelFreeRun {
    let (plant, rest) = at_rest(name);
    simulate_model_free(&plant, &case(name), &rest, law, &experiment(duration_s, steps)).unwrap()
}

fn figures(run: &ModelFreeRun) -> [TrackingMetrics; 2] {
    tracking_metrics(&run.trajectory, run.rows_per_sample, &plant(), Pairing::Diagonal)
}

/// Both set-points from 10 to 15 cm.
const BOTH: [(usize, f64, f64); 2] = [(0, 20.0, 5.0), (1, 20.0, 5.0)];

#[test]
fn s1_from_empty_tanks() {
    // Recomputed by a second program; the share of time at a limit is the mean of both loops.
    let golden: [(char, [Row; 2], f64); 3] = [
        ('a', [[190.3, 732.4, 22.8, 122.0, 16.8], [189.2, 727.6, 22.4, 121.0, 15.6]], 8.3),
        ('b', [[269.1, 1088.8, 30.1, 147.0, 17.0], [268.0, 1083.7, 29.9, 146.0, 17.0]], 13.0),
        ('c', [[207.2, 779.8, 24.3, 139.0, 110.0], [224.6, 855.8, 26.0, 144.0, 117.0]], 10.5),
    ];
    for (name, rows, saturated) in golden {
        let (_, found) = s1(&case(name), &ModelFree::PUBLISHED);
        for (figures, row) in found.iter().zip(rows) {
            assert_row(name, figures, row);
        }
        within((found[0].saturated_s + found[1].saturated_s) / 602.0 * 100.0, saturated, 0.05, name);
    }
}

#[test]
fn s1_without_the_estimator() {
    for (name, iae, overshoot, settling) in
        [('a', 178.2, 19.8, 116.0), ('b', 257.1, 27.0, 142.0), ('c', 192.7, 20.2, 135.0)]
    {
        let (_, [first, _]) = s1(&case(name), &law_without_estimator());
        within(first.iae / CM, iae, 0.05, name);
        within(first.overshoot.unwrap() * 100.0, overshoot, 0.05, name);
        assert_eq!(first.settling_s, Some(settling), "{name}");
    }
}

#[test]
fn s2_of_case_a_as_a_vector() {
    let run = from_rest('a', &ModelFree::PUBLISHED, 320.0, &BOTH);
    let golden = [
        (20.0, [9.9976, 9.9976, 5.2151, 5.2151], [12.0, 12.0]),
        (30.0, [13.4231, 13.4590, 7.6936, 7.6634], [12.0, 12.0]),
        (40.0, [15.8960, 15.8868, 9.2203, 9.2196], [8.0088, 7.8918]),
        (50.0, [15.7316, 15.7215, 8.8197, 8.8216], [6.3342, 6.2690]),
        (100.0, [15.1970, 15.1938, 7.9787, 7.9807], [7.4399, 7.3951]),
        (320.0, [15.0008, 15.0008, 7.8249, 7.8253], [7.4813, 7.4365]),
    ];
    let trajectory = &run.trajectory;
    for (time, levels, voltages) in golden {
        let row = trajectory.row_at(time).unwrap();
        let found = trajectory.levels.iter().map(|column| column[row] / CM);
        let found = found.chain(trajectory.pump_voltage.iter().map(|column| column[row]));
        for (found, printed) in found.zip(levels.into_iter().chain(voltages)) {
            within(found, printed, 0.5e-4, 'a');
        }
    }
}

#[test]
fn s2_of_case_b_is_slower_and_the_windup_is_its_overshoot() {
    // IAE (cm s), overshoot (%), settling (s): as published, and with conditional integration.
    let golden = [('a', [77.9, 19.0, 108.0], [39.7, 0.7, 15.0]), ('b', [111.6, 27.0, 130.0], [57.5, 2.0, 22.0])];
    for (name, bare, conditional) in golden {
        let laws = [ModelFree::PUBLISHED, with_windup(ModelFreeAntiWindup::Conditional)];
        for (law, [iae, overshoot, settling]) in laws.iter().zip([bare, conditional]) {
            let [first, _] = figures(&from_rest(name, law, 320.0, &BOTH));
            within(first.iae / CM, iae, 0.05, name);
            within(first.overshoot.unwrap() * 100.0, overshoot, if overshoot < 1.0 { 0.05 } else { 0.5 }, name);
            assert_eq!(first.settling_s, Some(settling), "{name}");
        }
    }
}

#[test]
fn phi_at_a_time_is_that_of_the_sample_in_force() {
    let run = from_rest('a', &ModelFree::PUBLISHED, 300.0, &[(0, 100.0, 1.0)]);
    assert!(run.rows_per_sample > 1);
    let [estimates, values] = run.phi_at(5.5).unwrap();
    for loop_index in 0..2 {
        // In the first window all is at rest: φ = dh/dt − α̂ u is −α̂ u, and that is where φ̂ begins.
        let output = run.trajectory.controller_output[loop_index][0];
        let expected = -ModelFree::PUBLISHED.loops[loop_index].model_gain * output;
        assert!((values[loop_index] / expected - 1.0).abs() < 1e-9);
        assert!((estimates[loop_index] / expected - 1.0).abs() < 1e-9);
        for time_s in [120.0, 120.9] {
            let [estimates, values] = run.phi_at(time_s).unwrap();
            assert_eq!(estimates[loop_index], run.estimates[loop_index][120]);
            assert_eq!(values[loop_index], run.true_values[loop_index][120]);
        }
    }
    assert_ne!(run.phi_at(120.0), run.phi_at(121.0));
    assert_eq!(run.phi_at(1e9), run.phi_at(300.0));
}

#[test]
fn other_windows_and_inputs_do_what_the_reading_says() {
    let estimator = ModelFree::PUBLISHED.estimator.unwrap();
    let with = |estimator| ModelFree { estimator: Some(estimator), ..ModelFree::PUBLISHED };
    // A sliding window: the same IAE with less movement, counted from the step on.
    let sliding = with(EstimatorSettings { window: Window::Sliding, ..estimator });
    for (law, variation) in [(&sliding, 7.3), (&ModelFree::PUBLISHED, 11.4)] {
        let run = from_rest('a', law, 320.0, &BOTH);
        within(figures(&run)[0].iae / CM, 77.87, 0.05, 'a');
        let output = run.trajectory.controller_output[0].iter().step_by(run.rows_per_sample).skip(20);
        let output: Vec<f64> = output.copied().collect();
        within(output.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum(), variation, 0.05, 'a');
    }
    // The voltage that was asked for instead of the one that was had: strong windup.
    let commanded = with(EstimatorSettings { fed_with: FedWith::Commanded, ..estimator });
    for (name, iae) in [('a', 127.0), ('b', 385.0)] {
        let [first, _] = figures(&from_rest(name, &commanded, 320.0, &BOTH));
        within(first.iae / CM, iae, 0.5, name);
        assert!(first.overshoot.unwrap() > 0.8, "{first:?}");
    }
}

#[test]
fn table_of_steady_states() {
    let golden =
        [(5.0, [4.31934, 4.29355]), (10.0, [6.10846, 6.07200]), (15.0, [7.48131, 7.43665]), (20.0, [8.63867, 8.58710])];
    for gamma in [0.6, 0.4] {
        let plant = plant().with_valves([gamma; 2]);
        for (level, voltages) in golden {
            let op = plant.inputs_for_levels([level * CM; 2]).unwrap();
            for (found, printed) in op.pump_voltage.into_iter().zip(voltages) {
                within(found, printed, 0.5e-5, '-');
            }
        }
    }
    for (gamma, upper) in [(0.6, 5.21668), (0.4, 11.73752)] {
        let op = plant().with_valves([gamma; 2]).inputs_for_levels([10.0 * CM; 2]).unwrap();
        // The areas of the preset have seven digits, which is one unit of the last one here.
        within(op.levels[2] / CM, upper, 1.5e-5, '-');
        within(op.levels[3] / CM, upper, 1.5e-5, '-');
    }
}

#[test]
fn table_of_the_linear_model() {
    // T1, T3, G(0), zeros, λ11, Niederlinski, b11 and b22.
    type Linear = (char, [f64; 2], [[f64; 2]; 2], [f64; 2], f64, f64, [f64; 2]);
    let golden: [Linear; 2] = [
        ('a', [31.63, 36.26], [[1.964, 1.318], [1.310, 1.976]], [-0.04597, -0.00919], 1.800, 0.556, [0.0621, 0.0625]),
        ('b', [31.63, 54.38], [[1.310, 1.976], [1.964, 1.318]], [-0.04597, 0.00919], -0.800, -1.250, [0.0414, 0.0417]),
    ];
    for (name, time_constants, gain, zeros, rga, index, slopes) in golden {
        let (plant, rest) = at_rest(name);
        let found = plant.time_constants_s(&rest);
        within(found[0].unwrap(), time_constants[0], 0.005, name);
        within(found[2].unwrap(), time_constants[1], 0.005, name);
        let jacobian = plant.linearise(&rest);
        let (a, b, c) = jacobian.reduced();
        let model = StateSpace::strictly_proper(a, b, c / plant.sensor.gain).unwrap();
        let dc_gain = model.dc_gain().unwrap();
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            within(dc_gain[(i, j)] / CM, gain[i][j], 0.5e-3, name);
        }
        let mut found: Vec<f64> = transmission_zeros(&model).unwrap().iter().map(|zero| zero.value.re).collect();
        found.sort_by(f64::total_cmp);
        within(found[0], zeros[0], 0.5e-5, name);
        within(found[1], zeros[1], 0.5e-5, name);
        within(relative_gain_array(&dc_gain).unwrap()[(0, 0)], rga, 0.5e-3, name);
        within(niederlinski(&dc_gain)[0].unwrap(), index, 0.5e-3, name);
        for (i, slope) in slopes.into_iter().enumerate() {
            within(jacobian.b[(i, i)] / CM, slope, 0.5e-4, name);
        }
    }
}

#[test]
fn the_zero_attracts_a_pole_with_and_without_the_estimator() {
    let slowest = |name| {
        let (plant, rest) = at_rest(name);
        let jacobian = plant.linearise(&rest);
        let continuous = continuous_model_free_poles(&jacobian, &ModelFree::PUBLISHED, 1.0).unwrap()[0];
        let sampled =
            [ModelFree::PUBLISHED, law_without_estimator()].map(|law| model_free_poles(&jacobian, &law, 1.0).unwrap());
        (continuous.re, sampled)
    };
    let (continuous, sampled) = slowest('a');
    within(continuous, -0.0090, 0.5e-4, 'a');
    assert!(sampled.iter().all(|found| found.stability == Stability::Stable));
    let (continuous, sampled) = slowest('b');
    within(continuous, 0.00885, 0.5e-5, 'b');
    // With the estimator it is even closer to the zero at +0.00919.
    assert!(sampled.iter().all(|found| found.stability == Stability::Unstable));
    assert!(sampled[0].poles_s[0].re > sampled[1].poles_s[0].re && sampled[0].poles_s[0].re < 0.00919);
}

#[test]
fn the_smallest_model_gain_of_case_a() {
    let (plant, rest) = at_rest('a');
    let jacobian = plant.linearise(&rest);
    let closed_form = |i: usize| smallest_model_gain_of_integrator(jacobian.b[(i, i)], 2.0, 0.05, 1.0) / CM;
    // b11 Kp Ts/2, the larger part, is the printed limit; with Ki and of the other loop it is 2 % more.
    within(jacobian.b[(0, 0)] / CM, 0.062, 0.5e-3, 'a');
    let by_poles = smallest_model_gain(&jacobian, &ModelFree::PUBLISHED, 1.0).unwrap().unwrap() / CM;
    assert!((by_poles - closed_form(1)).abs() < 1e-4 * by_poles, "{by_poles} {}", closed_form(1));
    // A small step: the voltage swings from sample to sample, with a growing amplitude below the limit alone.
    let swing = |gain: f64| {
        let loops = ModelFree::PUBLISHED.loops.map(|settings| ModelFreeSettings { model_gain: gain * CM, ..settings });
        let law = ModelFree { loops, ..ModelFree::PUBLISHED };
        let run = from_rest('a', &law, 400.0, &[(1, 20.0, 0.001)]);
        let column: Vec<f64> = run.trajectory.pump_voltage[1].iter().copied().step_by(run.rows_per_sample).collect();
        (column[399] - column[398]).abs() / (column[41] - column[40]).abs()
    };
    assert!(swing(1.005 * by_poles) < 1.0 && swing(0.995 * by_poles) > 1.0);
    // In case b the loop is unstable as published, and a larger α̂ only makes that slower.
    let (plant, rest) = at_rest('b');
    assert_eq!(smallest_model_gain(&plant.linearise(&rest), &ModelFree::PUBLISHED, 1.0), Ok(None));
}

#[test]
fn case_b_loses_an_unequal_step_as_its_zero_dynamics_say() {
    // 1 cm on loop 1: a second program loses it at 193 s; with the band of 5 % of the reference it is the sample after.
    let run = from_rest('b', &ModelFree::PUBLISHED, 2000.0, &[(0, 20.0, 1.0)]);
    let [first, second] = figures(&run);
    assert_eq!((first.lost_at_s, second.lost_at_s), (Some(194.0), None));
    // A minute after the step both levels look settled, and the upper tanks tell when a pump will be at its limit.
    let row = run.trajectory.row_at(60.0).unwrap();
    let level = |tank: usize, row: usize| run.trajectory.levels[tank][row];
    assert!((level(0, row) - 0.11).abs() < 0.001 && (level(1, row) - 0.10).abs() < 0.001);
    let (plant, _) = at_rest('b');
    let predicted = ZeroDynamics::new(&plant, [0.11, 0.10]).ends([level(2, row), level(3, row)], 2000.0);
    let Some(ZeroDynamicsEnd::Pump { pump: 0, after_s }) = predicted else { panic!("{predicted:?}") };
    let limited = (row..run.trajectory.time_s.len()).find(|&k| run.trajectory.pump_voltage[0][k] >= 12.0).unwrap();
    let limited = run.trajectory.time_s[limited];
    assert!((60.0 + after_s - limited).abs() < 0.05 * limited, "{after_s} {limited}");
    // And what is the end of it: pump 1 at its limit, level 1 far below, level 2 as if nothing were.
    let end = run.trajectory.time_s.len() - 1;
    assert_eq!(run.trajectory.pump_voltage[0][end], 12.0);
    assert!(level(0, end) < 0.08 && (level(1, end) - 0.10).abs() < 1e-3);
    // A larger step is lost sooner; case a holds both.
    let larger = figures(&from_rest('b', &ModelFree::PUBLISHED, 2000.0, &[(0, 20.0, 2.0)]));
    assert!((20.0 + 60.0..20.0 + 120.0).contains(&larger[0].lost_at_s.unwrap()));
    let held = figures(&from_rest('a', &ModelFree::PUBLISHED, 2000.0, &[(0, 20.0, 2.0)]));
    assert!(held[0].settling_s.is_some() && held.iter().all(|figures| figures.lost_at_s.is_none()));
}

#[test]
fn case_b_drifts_apart_behind_equal_steps_too() {
    // Over 300 s both levels look perfect; the upper tanks part with the e-folding time of the zero, and one runs over.
    let run = from_rest('b', &ModelFree::PUBLISHED, 2000.0, &BOTH);
    let apart = |time: f64| {
        let row = run.trajectory.row_at(time).unwrap();
        (run.trajectory.levels[2][row] - run.trajectory.levels[3][row]).abs()
    };
    let folding = 300.0 / (apart(900.0) / apart(600.0)).ln();
    let (plant, _) = at_rest('b');
    let row = run.trajectory.row_at(320.0).unwrap();
    let upper = [2, 3].map(|tank| run.trajectory.levels[tank][row]);
    let predicted = ZeroDynamics::new(&plant, [0.15, 0.15]).ends(upper, 2000.0);
    let Some(ZeroDynamicsEnd::Overflow { tank: 2, after_s }) = predicted else { panic!("{predicted:?}") };
    let overflow = run.trajectory.events.iter().find(|event| event.kind == EventKind::Overflow { tank: 2 }).unwrap();
    assert!((320.0 + after_s - overflow.time_s).abs() < 5.0, "{after_s} {overflow:?}");
    // At 15 cm the zero is at 0.00750: T3 = T4 = 66.6 s.
    let rest = plant.inputs_for_levels([0.15, 0.15]).unwrap();
    let (a, b, c) = plant.linearise(&rest).reduced();
    let zeros = transmission_zeros(&StateSpace::strictly_proper(a, b, c).unwrap()).unwrap();
    let zero = zeros.iter().map(|zero| zero.value.re).fold(f64::NEG_INFINITY, f64::max);
    assert!((folding * zero - 1.0).abs() < 0.03, "{folding} {zero}");
}

#[test]
fn case_c_tracks_with_a_ripple() {
    // Equal set-points, from rest at 10 cm, where the mean valves are singular and the flows of both pumps the same.
    let singular = plant().with_valves([0.5; 2]);
    assert!(singular.inputs_for_levels([0.1, 0.1]).is_err(), "γ1 + γ2 = 1");
    let rest = singular.rest_at([0.1, 0.1]).unwrap();
    within(rest.levels[2] / CM, 8.148, 3.5e-3, 'c');
    let experiment = experiment(320.0, &BOTH);
    let run = simulate_model_free(&plant(), &case('c'), &rest, &ModelFree::PUBLISHED, &experiment).unwrap();
    for i in 0..2 {
        let late = run.trajectory.row_at(200.0).unwrap()..;
        let ripple = run.trajectory.levels[i][late].iter().map(|h| (h - 0.15).abs()).fold(0.0, f64::max) / CM;
        assert!((0.1..0.15).contains(&ripple), "{ripple} cm");
    }
}
