use approx::assert_relative_eq;

use super::*;
use crate::control::{AntiWindup, LoopMode, Pairing, PiSettings};
use crate::literature::PresetId;
use crate::sim::{Event, EventKind, Load, LoadStep, SetPointStep};

const STEP: f64 = 0.01;

fn law() -> DecentralisedPi {
    let settings = PiSettings {
        gain: 1.0,
        integral_time_s: 10.0,
        set_point_weight: 1.0,
        anti_windup: AntiWindup::Off,
        mode: LoopMode::Automatic,
    };
    DecentralisedPi { pairing: Pairing::Diagonal, loops: [settings; 2], sampling_time_s: 1.0 }
}

fn experiment(steps: &[(usize, f64)], load_steps: Vec<LoadStep>) -> Experiment {
    Experiment {
        set_point_steps: steps.iter().map(|&(level, time_s)| SetPointStep { level, time_s, size: STEP }).collect(),
        load_steps,
        ..Experiment::at_rest(100.0)
    }
}

/// A run whose level 1 answers its step at `step_time` (s) by `progress` of the time since; level 2 stands still.
fn run(steps: &[(usize, f64)], progress: impl Fn(f64) -> f64) -> Trajectory {
    let mut trajectory = Trajectory::with_rows(101);
    let reference =
        |level: usize, t: f64| 0.1 + steps.iter().filter(|s| s.0 == level && s.1 <= t).map(|_| STEP).sum::<f64>();
    let begin = steps.iter().find(|s| s.0 == 0).map_or(f64::INFINITY, |s| s.1);
    for (row, k) in (0..=100).enumerate() {
        let t = f64::from(k);
        let level = if t > begin { 0.1 + STEP * progress(t - begin) } else { 0.1 };
        let output = if (20..30).contains(&k) { 10.0 } else { 5.0 };
        let references = [reference(0, t), reference(1, t)];
        trajectory.set(row, t, [level, 0.1, 0.0, 0.0], references, [output, 5.0], [output, 5.0]);
    }
    trajectory
}

fn first(trajectory: &Trajectory, experiment: &Experiment) -> LoopMetrics {
    let mut plant = PresetId::JohanssonMinimumPhase.preset().plant;
    plant.power_gain = 1.0;
    plant.pumps = plant.pumps.map(|pump| crate::plant::Pump { voltage_min: 0.0, voltage_max: 10.0, ..pump });
    let [first, second] = loop_metrics(trajectory, &plant, &law(), experiment);
    assert_eq!(second.saturated_s, 0.0);
    first
}

#[test]
fn a_first_order_lag_has_its_textbook_figures() {
    let steps = [(0, 10.0)];
    let metrics = first(&run(&steps, |t| 1.0 - (-t / 8.0).exp()), &experiment(&steps, vec![]));
    assert_eq!(metrics.step_time_s, Some(10.0));
    // Exponentials interpolated by chords of 1/8 of the time constant.
    assert_relative_eq!(metrics.rise_time_s.unwrap(), 8.0 * 9.0_f64.ln(), max_relative = 2e-3);
    for (settling, band) in [(metrics.settling_2_percent, 0.02_f64), (metrics.settling_5_percent, 0.05)] {
        let Some(Settling::After { time_s }) = settling else { panic!("{settling:?}") };
        assert_relative_eq!(time_s, -8.0 * band.ln(), max_relative = 1e-3);
    }
    assert_eq!((metrics.overshoot, metrics.undershoot), (Some(0.0), Some(0.0)));
    assert_eq!(metrics.other_peak, 0.0);
    // Left rectangles of a falling exponential: a geometric series.
    let q = (-1.0_f64 / 8.0).exp();
    assert_relative_eq!(metrics.iae, STEP / (1.0 - q), max_relative = 1e-4);
    assert_relative_eq!(metrics.ise, STEP * STEP / (1.0 - q * q), max_relative = 1e-4);
    assert_relative_eq!(metrics.itae, STEP * q / (1.0 - q).powi(2), max_relative = 1e-3);
    assert_eq!((metrics.total_variation, metrics.saturated_s), (10.0, 10.0));
}

#[test]
fn overshoot_and_the_wrong_way_count_in_fractions_of_the_step() {
    let steps = [(0, 10.0)];
    let peaks = |t: f64| {
        if t < 5.0 {
            -0.2
        } else if t < 20.0 {
            1.3
        } else {
            1.0
        }
    };
    let metrics = first(&run(&steps, peaks), &experiment(&steps, vec![]));
    assert_relative_eq!(metrics.overshoot.unwrap(), 0.3, max_relative = 1e-9);
    assert_relative_eq!(metrics.undershoot.unwrap(), 0.2, max_relative = 1e-9);
}

#[test]
fn a_response_that_stays_outside_never_settles() {
    let steps = [(0, 10.0)];
    let metrics = first(&run(&steps, |_| 0.8), &experiment(&steps, vec![]));
    assert_eq!(metrics.settling_2_percent, Some(Settling::Never));
    assert_eq!(metrics.rise_time_s, None);
}

#[test]
fn the_window_ends_where_anything_else_is_done() {
    let late = |t: f64| if t < 40.0 { 1.0 } else { 3.0 };
    let settled = Some(Settling::After { time_s: 0.98 });
    let figures = |steps: &[(usize, f64)], loads| {
        let metrics = first(&run(steps, late), &experiment(steps, loads));
        (metrics.settling_2_percent, metrics.overshoot)
    };
    let near = |settling: Option<Settling>| match (settling, settled) {
        (Some(Settling::After { time_s: a }), Some(Settling::After { time_s: b })) => (a - b).abs() < 1e-9,
        _ => false,
    };
    let load = LoadStep { time_s: 30.5, load: Load::PumpFlow { pump: 0, flow: 1e-6 } };
    for (steps, loads) in [(&[(0, 10.0), (1, 40.0)][..], vec![]), (&[(0, 10.0)], vec![load])] {
        let (settling, overshoot) = figures(steps, loads);
        assert!(near(settling), "{settling:?}");
        assert!(overshoot.unwrap() < 1e-9);
    }
    assert_eq!(figures(&[(0, 10.0)], vec![]).0, Some(Settling::Never));
}

#[test]
fn a_step_at_the_start_counts_and_none_is_none() {
    let steps = [(0, 0.0)];
    let metrics = first(&run(&steps, |t| 1.0 - (-t / 8.0).exp()), &experiment(&steps, vec![]));
    assert_eq!(metrics.step_time_s, Some(0.0));
    assert!(metrics.rise_time_s.is_some());
    let metrics = first(&run(&[], |_| 0.0), &experiment(&[], vec![]));
    assert_eq!((metrics.step_time_s, metrics.settling_2_percent, metrics.overshoot), (None, None, None));
}

#[test]
fn a_level_that_is_not_at_rest_is_called_so() {
    let steps = [(1, 10.0), (0, 40.0)];
    let figures = |away: f64, row: usize| {
        let mut run = run(&steps, |t| 1.0 - (-t / 8.0).exp());
        run.levels[0][row] = 0.1 + away * STEP;
        first(&run, &experiment(&steps, vec![]))
    };
    let at_rest = figures(0.0, 40);
    assert!(at_rest.no_response.is_none() && at_rest.window_iae.is_some());
    // In the last tenth of the 30 s since the other step, further from the old reference than what counts as settled.
    for row in [37, 40] {
        let moving = figures(0.03, row);
        let Some(NoResponse::NotAtRest { distance }) = moving.no_response else { panic!("{moving:?}") };
        assert_relative_eq!(distance, 0.03 * STEP, max_relative = 1e-9);
        assert_eq!(moving.window_s, Some(60.0));
    }
    for (away, row) in [(0.03, 36), (0.019, 37), (-0.019, 40)] {
        assert_eq!(figures(away, row).no_response, None);
    }
}

#[test]
fn a_level_at_the_rim_does_not_settle_there() {
    // The wall is at 0.108 m, so that the level comes to rest there, without any overshoot, at 80 % of its step.
    let steps = [(0, 10.0)];
    let mut run = run(&steps, |t| (1.3 * (1.0 - (-t / 8.0).exp())).min(0.8));
    assert_eq!(first(&run, &experiment(&steps, vec![])).no_response, None);
    let overflow = |tank: usize| Event { time_s: 18.0, kind: EventKind::Overflow { tank } };
    run.events = vec![overflow(1)];
    assert_eq!(first(&run, &experiment(&steps, vec![])).no_response, None);
    run.events = vec![overflow(0)];
    let full = first(&run, &experiment(&steps, vec![]));
    assert_eq!((full.no_response, full.settling_2_percent, full.overshoot), (Some(NoResponse::TankFull), None, None));
    // A later step downwards has an answer of its own.
    let both =
        [SetPointStep { level: 0, time_s: 10.0, size: STEP }, SetPointStep { level: 0, time_s: 60.0, size: -STEP }];
    for (row, level) in run.levels[0].iter_mut().enumerate().skip(61) {
        *level = 0.1 + 0.7 * STEP * (-(row as f64 - 60.0) / 4.0).exp();
    }
    for reference in &mut run.references[0][60..] {
        *reference = 0.1;
    }
    let experiment = Experiment { set_point_steps: both.to_vec(), ..Experiment::at_rest(100.0) };
    let reasons: Vec<_> =
        step_answers(&run, &experiment, 1.0).iter().map(|answer| answer.figures.no_response).collect();
    assert_eq!(reasons, [Some(NoResponse::TankFull); 2], "the second begins at the rim");
}

#[test]
fn a_level_under_way_counts_from_the_step_itself() {
    // Beyond 10 % when the reference steps, and 8 s from 90 % of it.
    let steps = [(0, 10.0)];
    let mut run = run(&steps, |t| 0.2 + 0.7 * t / 8.0);
    run.levels[0][10] = 0.1 + 0.2 * STEP;
    let metrics = first(&run, &experiment(&steps, vec![]));
    assert_relative_eq!(metrics.rise_time_s.unwrap(), 8.0, max_relative = 1e-12);
    // Beyond 90 % there is nothing left to rise.
    run.levels[0][10] = 0.1 + STEP;
    assert_eq!(first(&run, &experiment(&steps, vec![])).rise_time_s, Some(0.0));
}

#[test]
fn a_level_that_a_load_moves_is_not_at_rest() {
    let steps = [(0, 40.0)];
    let mut run = run(&steps, |t| 1.0 - (-t / 8.0).exp());
    run.levels[0][38] = 0.1 + 0.5 * STEP;
    let figures = |time_s: f64| {
        let load = LoadStep { time_s, load: Load::PumpFlow { pump: 0, flow: 1e-6 } };
        first(&run, &experiment(&steps, vec![load])).no_response
    };
    // 3.5 s and 1 s before the step.
    assert!(matches!(figures(5.0), Some(NoResponse::NotAtRest { .. })));
    assert_eq!(figures(30.0), None);
}

#[test]
fn a_step_after_the_end_is_called_so() {
    for (time, is_late) in [(99.0, false), (99.5, true), (100.0, true), (250.0, true)] {
        let metrics = first(&run(&[], |_| 0.0), &sized(&[(0, time, STEP)]));
        assert_eq!(metrics.no_response.is_some(), is_late, "{time}");
        assert_eq!(metrics.step_time_s.is_none(), is_late, "{time}");
    }
    let late = first(&run(&[], |_| 0.0), &sized(&[(0, 300.0, STEP), (0, 250.0, STEP)]));
    assert_eq!(late.no_response, Some(NoResponse::StepAfterEnd { time_s: 250.0 }));
}

#[test]
fn the_window_bounds_its_sum_and_the_run_the_others() {
    let steps = [(0, 10.0)];
    let load = LoadStep { time_s: 30.25, load: Load::PumpFlow { pump: 0, flow: 1e-6 } };
    let metrics = first(&run(&steps, |_| 0.5), &experiment(&steps, vec![load]));
    // A whole step at first, half of one from the first second on.
    assert_relative_eq!(metrics.window_iae.unwrap(), STEP * (1.0 + 0.5 * 19.25), max_relative = 1e-9);
    assert_relative_eq!(metrics.iae, STEP * (1.0 + 0.5 * 89.0), max_relative = 1e-9);
}

#[test]
fn figures_of_the_step_are_those_of_the_run_that_is_judged() {
    let steps = [(0, 10.0)];
    let (calm, noisy) = (run(&steps, |t| 1.0 - (-t / 8.0).exp()), run(&steps, |_| 3.0));
    let experiment = experiment(&steps, vec![]);
    let plant = PresetId::JohanssonMinimumPhase.preset().plant;
    let judge = |judged, run| {
        let answers = step_answers(judged, &experiment, law().sampling_time_s);
        loop_metrics_judging(&answers, run, &plant, &law(), &experiment)[0]
    };
    let (twin, alone, both) = (judge(&calm, &calm), judge(&noisy, &noisy), judge(&calm, &noisy));
    assert_eq!((both.overshoot, both.settling_2_percent), (Some(0.0), twin.settling_2_percent));
    assert_eq!((both.window_iae, both.iae), (twin.window_iae, alone.iae));
}

fn sized(steps: &[(usize, f64, f64)]) -> Experiment {
    let set_point_steps = steps.iter().map(|&(level, time_s, size)| SetPointStep { level, time_s, size }).collect();
    Experiment { set_point_steps, ..experiment(&[], vec![]) }
}

#[test]
fn a_window_ends_at_the_exact_time_of_the_load() {
    let load = |time_s: f64, flow: f64| LoadStep { time_s, load: Load::PumpFlow { pump: 1, flow } };
    let steps = [(0, 10.0)];
    let window = |loads: Vec<LoadStep>| first(&run(&steps, |_| 1.0), &experiment(&steps, loads)).window_s;
    assert_eq!(window(vec![load(30.25, 1e-6)]), Some(20.25));
    // What begins with the step, before it or after the run ends no window; nor do loads that cancel.
    assert_eq!(window(vec![load(10.0, 1e-6), load(1e-300, 1e-6), load(200.0, 1e-6)]), Some(90.0));
    assert_eq!(window(vec![load(30.25, 1e-6), load(30.25, -1e-6), load(40.5, 0.0)]), Some(90.0));
}

#[test]
fn steps_that_cancel_are_none_and_others_add_up() {
    let response = |t: f64| 1.0 - (-t / 8.0).exp();
    let plain = first(&run(&[(0, 10.0)], response), &sized(&[(0, 10.0, STEP)]));
    // Two halves, the second at a time that is rounded up to the same sample; a pair that cancels before and after.
    let in_parts = sized(&[
        (0, 2.0, 0.3),
        (0, 2.0, -0.1),
        (0, 2.0, -0.2),
        (0, 10.0, STEP / 2.0),
        (0, 9.5, STEP / 2.0),
        (1, 20.0, 0.1),
        (1, 20.0, -0.1),
    ]);
    assert_eq!(first(&run(&[(0, 10.0)], response), &in_parts), plain);
    let none = first(&run(&[], |_| 0.0), &sized(&[(0, 10.0, STEP), (0, 10.0, -STEP)]));
    assert_eq!((none.step_time_s, none.no_response), (None, Some(NoResponse::NoStep)));
}

#[test]
fn a_step_within_the_rounding_of_a_level_has_no_figures() {
    for size in [5e-324, 1e-300, -1e-17, 1e-9] {
        let metrics = first(&run(&[], |_| 0.0), &sized(&[(0, 10.0, size)]));
        assert_eq!(metrics.no_response, Some(NoResponse::StepTooSmall { size }));
        assert_eq!((metrics.step_time_s, metrics.window_s), (Some(10.0), Some(90.0)));
        assert_eq!((metrics.rise_time_s, metrics.settling_2_percent, metrics.overshoot), (None, None, None));
    }
}

#[test]
fn a_step_at_next_to_no_time_is_one_at_the_start() {
    let steps = [(0, 0.0)];
    let late = first(&run(&steps, |t| t / 50.0), &sized(&[(0, 1e-300, STEP)]));
    assert_eq!((late.step_time_s, late.no_response), (Some(0.0), None));
    assert_relative_eq!(late.rise_time_s.unwrap(), 40.0, max_relative = 1e-12);
}

#[test]
fn sums_weigh_each_row_with_the_time_to_the_next() {
    let mut run = Trajectory::with_rows(4);
    // Errors 0.5, −0.25 and 2 for 3 s, 0.5 s and 4 s; the reference steps at 3 s.
    let rows = [(0.0, 0.5, 2.0), (3.0, 1.25, 0.0), (3.5, -1.0, 12.0), (7.5, 0.0, 7.0)];
    for (row, (time, level, output)) in rows.into_iter().enumerate() {
        let reference = 1.0;
        run.set(row, time, [level, 0.0, 0.0, 0.0], [reference, 0.0], [output, 5.0], [output, 5.0]);
    }
    let metrics = first(&run, &sized(&[(0, 3.0, 0.5)]));
    assert_eq!(metrics.iae, 0.5 * 3.0 + 0.25 * 0.5 + 2.0 * 4.0);
    assert_eq!(metrics.ise, 0.25 * 3.0 + 0.0625 * 0.5 + 4.0 * 4.0);
    // From the step on: 0 s, 0 s and 0.5 s after it.
    assert_eq!(metrics.itae, 0.5 * 2.0 * 4.0);
    assert_eq!(metrics.total_variation, 2.0 + 12.0 + 5.0);
    // At 0 V for 0.5 s, beyond 10 V for 4 s.
    assert_eq!(metrics.saturated_s, 4.5);
    // Without a step time counts from the start.
    assert_eq!(first(&run, &sized(&[])).itae, 3.0 * 0.25 * 0.5 + 3.5 * 2.0 * 4.0);
}
