//! Model-free control beyond the published cases: moving valves, loads, other windows, other power modules.

use approx::assert_relative_eq;
use quadtank::control::{
    EstimatorSettings, ModelFree, ModelFreeSettings, Pairing, Window, continuous_model_free_poles, model_free_poles,
    smallest_model_gain,
};
use quadtank::literature::PresetId;
use quadtank::literature::junqueira::{PublishedExperiment, PublishedValves};
use quadtank::plant::{Disturbance, ValveSchedule};
use quadtank::sim::{Load, LoadStep, SetPointStep, simulate_model_free};
use quadtank::study::model_free::{ModelFreeSetup, StartSpec, run_model_free};

fn published(valves: PublishedValves, experiment: PublishedExperiment) -> ModelFreeSetup {
    ModelFreeSetup::published(valves, experiment)
}

fn step(level: usize, time_s: f64, size: f64) -> SetPointStep {
    SetPointStep { level, time_s, size }
}

/// Worst difference (m) of the first 100 s from an integration of our own, by the midpoint rule in steps of 5 ms, under the
/// same voltages. The run is so long that it has a row a second, which leaves the steps to the integration itself.
fn error_with(valves: [ValveSchedule; 2]) -> f64 {
    let mut setup = published(PublishedValves::A, PublishedExperiment::S2);
    setup.experiment.duration_s = 2000.0;
    // Without steps no tank meets its walls, of which the midpoint rule knows nothing.
    setup.experiment.set_point_steps.clear();
    setup.controller.estimator = None;
    setup.valves = valves;
    let (plant, start) = (setup.plant_at(0.0), published(PublishedValves::A, PublishedExperiment::S2).start().unwrap());
    let run = simulate_model_free(&plant, &valves, &start, &setup.controller, &setup.experiment).unwrap();
    assert_eq!(run.rows_per_sample, 1);
    let run = run.trajectory;
    let (mut levels, mut worst) = (start.levels, 0.0_f64);
    for row in 0..100 {
        let voltage = [run.pump_voltage[0][row], run.pump_voltage[1][row]];
        let slope = |time: f64, levels: [f64; 4]| {
            let plant = plant.with_valves(valves.map(|valve| valve.at(time)));
            plant.derivative(&levels, &voltage, &Disturbance::default())
        };
        for k in 0..200 {
            let now = run.time_s[row] + f64::from(k) * 0.005;
            let first = slope(now, levels);
            let middle = slope(now + 0.0025, std::array::from_fn(|i| levels[i] + 0.0025 * first[i]));
            levels = std::array::from_fn(|i| levels[i] + 0.005 * middle[i]);
        }
        worst = (0..4).map(|i| (levels[i] - run.levels[i][row + 1]).abs()).fold(worst, f64::max);
    }
    worst
}

#[test]
fn valves_move_within_the_integration() {
    let quick = ValveSchedule::Sine { mean: 0.5, amplitude: 0.1, frequency: 3.0, phase: 1.0 };
    let jump = ValveSchedule::Step { from: 0.6, to: 0.4, at_s: 30.3 };
    let ramp = ValveSchedule::Ramp { from: 0.6, to: 0.5, begin_s: 20.4, end_s: 25.7 };
    for valves in [PublishedValves::C.schedules(), [quick; 2], [jump; 2], [ramp, jump]] {
        let error = error_with(valves);
        // 1e-6 of a step of 5 cm.
        assert!(error < 5e-8, "{valves:?}: {error} m");
    }
}

#[test]
fn phi_is_what_the_model_leaves_out_a_load_too() {
    let mut setup = published(PublishedValves::A, PublishedExperiment::S2);
    setup.experiment.set_point_steps.clear();
    setup.experiment.load_steps = vec![LoadStep { time_s: 50.0, load: Load::Leak { tank: 0, area: 5e-6 } }];
    let run = run_model_free(&setup).unwrap().run;
    let trajectory = &run.trajectory;
    for sample in [45, 51, 80, 200] {
        let row = sample * run.rows_per_sample;
        for i in 0..2 {
            let elapsed = trajectory.time_s[row + 1] - trajectory.time_s[row];
            let slope = (trajectory.levels[i][row + 1] - trajectory.levels[i][row]) / elapsed;
            let phi = slope - 1e-3 * trajectory.controller_output[i][row];
            assert_relative_eq!(run.true_values[i][sample], phi, max_relative = 1e-2);
        }
    }
    // The leak is in it.
    assert!(run.true_values[0][51] < run.true_values[0][49] - 1e-3);
}

#[test]
fn the_smallest_gain_with_a_sliding_window_is_where_swings_grow() {
    let estimator = ModelFree::PUBLISHED.estimator.unwrap();
    let sliding = EstimatorSettings { window: Window::Sliding, ..estimator };
    let law = ModelFree { estimator: Some(sliding), ..ModelFree::PUBLISHED };
    let mut setup = published(PublishedValves::A, PublishedExperiment::S2);
    let jacobian = setup.plant_at(0.0).linearise(&setup.start().unwrap());
    let smallest = smallest_model_gain(&jacobian, &law, 1.0).unwrap().unwrap();
    setup.experiment.duration_s = 600.0;
    setup.experiment.set_point_steps = vec![step(1, 20.0, 1e-6)];
    let mut growth = |gain: f64| {
        let loops = law.loops.map(|settings| ModelFreeSettings { model_gain: gain, ..settings });
        setup.controller = ModelFree { loops, ..law };
        let run = run_model_free(&setup).unwrap().run;
        let output: Vec<f64> =
            run.trajectory.controller_output[1].iter().copied().step_by(run.rows_per_sample).collect();
        let swing = |from: usize| output[from..from + 40].windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum::<f64>();
        swing(540) / swing(100)
    };
    assert!(growth(1.01 * smallest) < 1.0 && growth(0.99 * smallest) > 1.0, "{smallest}");
    // The memory of the window is no dynamics: every pole of it is slower than what rounding makes of nothing.
    let poles = model_free_poles(&jacobian, &law, 1.0).unwrap().poles_s;
    assert!(poles.len() < 40 && poles.iter().all(|pole| pole.re > -3.0), "{poles:?}");
}

#[test]
fn a_power_module_only_changes_the_unit_of_the_output() {
    let setup = published(PublishedValves::B, PublishedExperiment::S2);
    let (plant, rest) = (setup.plant_at(0.0), setup.start().unwrap());
    let jacobian = plant.linearise(&rest);
    let estimator = ModelFree::PUBLISHED.estimator.unwrap();
    for window in [Window::Block, Window::Sliding] {
        let law = ModelFree { estimator: Some(EstimatorSettings { window, ..estimator }), ..ModelFree::PUBLISHED };
        // A volt of the law does twice as much, so its model has twice the gain.
        let loops = law.loops.map(|settings| ModelFreeSettings { model_gain: 2.0 * settings.model_gain, ..settings });
        let doubled = ModelFree { loops, ..law };
        let (one, two) = (model_free_poles(&jacobian, &law, 1.0).unwrap(), model_free_poles(&jacobian, &doubled, 2.0));
        for (one, two) in one.poles_s.iter().zip(two.unwrap().poles_s).take(4) {
            assert_relative_eq!(one.re, two.re, max_relative = 1e-6);
        }
        let one = continuous_model_free_poles(&jacobian, &law, 1.0).unwrap();
        for (one, two) in one.iter().zip(continuous_model_free_poles(&jacobian, &doubled, 2.0).unwrap()) {
            assert_relative_eq!(one.re, two.re, max_relative = 1e-9);
        }
    }
}

#[test]
fn a_loss_is_foretold_after_the_last_step_and_only_where_it_comes() {
    let mut setup = published(PublishedValves::B, PublishedExperiment::S3);
    setup.experiment.set_point_steps = vec![step(0, 20.0, 0.002), step(0, 100.0, 0.002), step(0, 5000.0, 0.01)];
    let foretold = run_model_free(&setup).unwrap().predicted.unwrap();
    assert!(foretold.from_s >= 110.0 && foretold.ends.is_some(), "{foretold:?}");
    // The other pairing with gentle gains is stable: it does not hold the levels at any price, and nothing is lost.
    let gentle = ModelFreeSettings { proportional: 0.05, integral: 0.0005, ..setup.controller.loops[0] };
    setup.controller = ModelFree { pairing: Pairing::Swapped, loops: [gentle; 2], estimator: None, ..setup.controller };
    setup.experiment.set_point_steps = vec![step(0, 20.0, 0.01)];
    setup.experiment.duration_s = 10_000.0;
    let held = run_model_free(&setup).unwrap();
    assert!(held.predicted.is_none() && held.figures.iter().all(|figures| figures.lost_at_s.is_none()));
}

#[test]
fn a_level_that_never_steps_has_no_overshoot() {
    for level in [0.05, 0.10, 0.11, 0.13, 0.15, 0.2] {
        let mut setup = published(PublishedValves::A, PublishedExperiment::S3);
        setup.start = StartSpec::Rest([level, level]);
        let [first, second] = run_model_free(&setup).unwrap().figures;
        assert!(first.overshoot.is_some() && second.overshoot.is_none(), "{level}: {second:?}");
    }
}

#[test]
fn a_law_that_begins_with_noise_estimates_from_what_it_measured() {
    let plant = PresetId::JunqueiraA.preset().plant;
    let (limits, output) = (plant.controller_limits(), [6.0, 6.0]);
    // Without feedback the measurement reaches the output by the estimator alone.
    let idle = ModelFreeSettings { proportional: 0.0, integral: 0.0, ..ModelFree::PUBLISHED.loops[0] };
    let open = ModelFree { loops: [idle; 2], ..ModelFree::PUBLISHED };
    let estimate = |first: f64| {
        let mut law = open.start(limits, output, [0.1, 0.1]).unwrap();
        for sample in 0..=10 {
            law.step([0.1, 0.1], [if sample == 0 { first } else { 0.1 }, 0.1]);
        }
        law.estimates()[0]
    };
    // The first sample weighs −6 T Ts/T³ = −0.06 1/s (Junqueira, Neves and Angelico, eq. 15).
    assert_relative_eq!(estimate(0.101) - estimate(0.1), -0.06 * 0.001, max_relative = 1e-9);
}
