use crate::control::LoopMode;
use crate::linear::{Stability, TransmissionZero};
use crate::literature::PresetId;
use crate::sim::{Experiment, SetPointStep, Settling};

use super::{OperatingPointSpec, Run, Setup, analyse, run, setup_of};

/// When the first experiment steps (s).
const FIRST_STEP_AT_S: f64 = 20.0;
/// Size of the step of level 1 in the first experiment (m): large enough to be seen, small enough that no pump reaches
/// its limit.
const FIRST_STEP: f64 = 0.02;
/// The shortest time that [`fitted_duration_s`] shows (s), which it doubles, and the longest.
const FITTED_S: (f64, f64) = (400.0, 6400.0);
/// Largest sensitivity peak Ms of a detuned loop; 2 is the usual bound (Skogestad and Postlethwaite 2005, "Maximum peak
/// criteria").
const DETUNED_PEAK: f64 = 1.6;
/// How [`detuned`] changes gains and integral times from one try to the next, and how often.
const DETUNING_STEP: (f64, f64) = (0.8, 1.12);
const MAX_TRIES: usize = 40;

/// The experiment that a first visit begins with: Johansson's rig at P−, with one step of level 1 that can be seen.
pub fn first_experiment() -> Setup {
    let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
    setup.experiment.duration_s = FITTED_S.0;
    setup.experiment.set_point_steps = vec![SetPointStep { level: 0, time_s: FIRST_STEP_AT_S, size: FIRST_STEP }];
    setup
}

/// How long a run has to be (s) so that each level that steps is seen to settle, with at least as much time after it: 400 s or a
/// doubling of it. The present duration where nothing settles within 6400 s, or nothing steps.
pub fn fitted_duration_s(setup: &Setup) -> f64 {
    let last_step_s = setup.experiment.set_point_steps.iter().map(|step| step.time_s).fold(0.0, f64::max);
    let mut tried = setup.clone();
    tried.experiment.duration_s = FITTED_S.0;
    while tried.experiment.duration_s <= FITTED_S.1 {
        let duration_s = tried.experiment.duration_s;
        if let Ok(run) = run(&tried) {
            let settled = run.metrics.iter().filter_map(|m| Some((m.step_time_s?, m.settling_2_percent?)));
            let ends = settled.map(|(step_s, settling)| match settling {
                Settling::After { time_s } => step_s + 2.0 * time_s,
                Settling::Never => f64::INFINITY,
            });
            let end = ends.reduce(f64::max).unwrap_or(f64::INFINITY);
            if last_step_s < duration_s && end <= duration_s {
                return duration_s;
            }
        }
        tried.experiment.duration_s *= 2.0;
    }
    setup.experiment.duration_s
}

/// Until when a chart has to show a run (s), so that each level that stepped is seen at rest for as long as it took to settle, after the last
/// step and after the last load. The end of the run where a level does not settle, where none steps, or where pumps or inflows follow
/// a sequence.
pub fn shown_until_s(experiment: &Experiment, run: &Run) -> f64 {
    let end_s = experiment.duration_s;
    let answers = run.steps.iter().filter(|step| step.time_s < end_s);
    let rests = answers.map(|step| match step.figures.settling_2_percent {
        Some(Settling::After { time_s }) => (step.time_s, 2.0 * time_s),
        Some(Settling::Never) | None => (step.time_s, f64::INFINITY),
    });
    let has_sequence = !(experiment.pump_voltage_steps.is_empty() && experiment.inflow_steps.is_empty());
    let Some((last_step_s, longest_s)) = rests.reduce(|one, other| (one.0.max(other.0), one.1.max(other.1))) else {
        return end_s;
    };
    let loads = experiment.load_steps.iter().map(|load| load.time_s);
    let last_s = loads.filter(|time_s| *time_s < end_s).fold(last_step_s, f64::max);
    if has_sequence { end_s } else { (last_s + longest_s).min(end_s) }
}

/// The same setup with detuned controllers: the gains of both loops reduced and their integral times increased by
/// common factors, no further than needed for a stable loop with a sensitivity peak of at most 1.6. `None` where no
/// such gains are found, as with integral action on a pairing whose Niederlinski index is negative.
pub fn detuned(setup: &Setup) -> Option<Setup> {
    let mut tried = setup.clone();
    for each in &mut tried.controller.loops {
        (each.gain, each.mode) = (each.gain.abs(), LoopMode::Automatic);
    }
    for _ in 0..MAX_TRIES {
        let closed_loop = analyse(&tried).ok()?.closed_loop;
        if closed_loop.stability == Stability::Stable
            && closed_loop.sensitivity_peak.is_some_and(|peak| peak.value <= DETUNED_PEAK)
        {
            return Some(tried);
        }
        for each in &mut tried.controller.loops {
            each.gain *= DETUNING_STEP.0;
            each.integral_time_s *= DETUNING_STEP.1;
        }
    }
    None
}

/// Where a rig rests whose valves are turned while its lower levels (m) are held, as long as pumps and walls allow that; else what
/// the pumps do at `voltages` (V). Near γ1 + γ2 = 1 no pumps hold two levels of one's choice. A state of one's own stays.
pub fn held_operating_point(setup: &Setup, levels: [f64; 2], voltages: [f64; 2]) -> OperatingPointSpec {
    if matches!(setup.operating_point, OperatingPointSpec::State(_)) {
        return setup.operating_point;
    }
    let held = Setup { operating_point: OperatingPointSpec::Levels(levels), ..setup.clone() };
    let is_allowed = held.operating_point().is_ok_and(|point| held.plant().violations(&point).is_empty());
    if is_allowed { held.operating_point } else { OperatingPointSpec::PumpVoltage(voltages) }
}

/// A way to move both levels at once, seen from a zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Along the output direction of the zero, which no controller can hurry.
    Hard,
    /// At right angles to it, where the zero does not act.
    Easy,
}

/// The steps of both levels (m) of length `size` (m) along a direction of a zero; the larger of them upwards.
pub fn direction_steps(zero: &TransmissionZero, direction: Direction, size: f64) -> [f64; 2] {
    let [y1, y2] = [zero.output_direction[0].re, zero.output_direction[1].re];
    let [a, b] = match direction {
        Direction::Hard => [y1, y2],
        Direction::Easy => [-y2, y1],
    };
    let larger = if a.abs() >= b.abs() { a } else { b };
    [a, b].map(|part| size * part * larger.signum() / a.hypot(b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::Pairing;
    use crate::sim::{Load, LoadStep, LoopMetrics};

    fn settling(setup: &Setup) -> Option<Settling> {
        run(setup).unwrap().metrics[0].settling_2_percent
    }

    #[test]
    fn the_first_experiment_settles_well_before_its_end_and_stays_within_the_rig() {
        let setup = first_experiment();
        let run = run(&setup).unwrap();
        assert!(run.nonlinear.events.is_empty(), "{:?}", run.nonlinear.events);
        assert!(matches!(settling(&setup), Some(Settling::After { time_s }) if time_s < 60.0));
        assert_eq!(fitted_duration_s(&setup), setup.experiment.duration_s);
    }

    #[test]
    fn a_duration_fits_a_slow_loop_and_stays_where_nothing_settles() {
        let mut setup = first_experiment();
        (setup.valves, setup.controller.pairing) = ([0.4, 0.3], Pairing::Swapped);
        assert_eq!(fitted_duration_s(&setup), 400.0, "the gains of P− are unstable here");
        let mut slow = detuned(&setup).unwrap();
        slow.experiment.duration_s = fitted_duration_s(&slow);
        let Some(Settling::After { time_s }) = settling(&slow) else { panic!("{:?}", settling(&slow)) };
        assert!(2.0 * time_s + 20.0 <= slow.experiment.duration_s);
        assert!(slow.experiment.duration_s / 2.0 < 2.0 * time_s + 20.0, "half as long would do");
    }

    #[test]
    fn a_chart_ends_when_the_last_step_and_the_last_load_have_been_seen_to_settle() {
        let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
        let shown = |setup: &Setup| shown_until_s(&setup.experiment, &run(setup).unwrap());
        let last_step_s = setup.experiment.set_point_steps.iter().map(|step| step.time_s).fold(0.0, f64::max);
        let Some(Settling::After { time_s }) = run(&setup).unwrap().metrics[1].settling_2_percent else { panic!() };
        let until_s = shown(&setup);
        assert!((last_step_s + 2.0 * time_s..setup.experiment.duration_s).contains(&until_s), "{until_s}");
        setup.experiment.load_steps = vec![LoadStep { time_s: 2000.0, load: Load::Leak { tank: 0, area: 1e-6 } }];
        assert!((shown(&setup) - until_s - (2000.0 - last_step_s)).abs() < 1e-9);
        setup.experiment.set_point_steps.clear();
        assert_eq!(shown(&setup), setup.experiment.duration_s);
    }

    #[test]
    fn detuned_loops_are_stable_with_a_small_peak_and_none_are_found_for_a_wrong_pairing() {
        for valves in [[0.7, 0.6], [0.4, 0.3], [0.3, 0.3], [0.43, 0.34], [0.2, 0.2]] {
            let mut setup = first_experiment();
            setup.valves = valves;
            let right = if valves[0] + valves[1] > 1.0 { Pairing::Diagonal } else { Pairing::Swapped };
            setup.controller.pairing = right;
            let closed_loop = analyse(&detuned(&setup).unwrap()).unwrap().closed_loop;
            assert_eq!(closed_loop.stability, Stability::Stable, "{valves:?}");
            assert!(closed_loop.sensitivity_peak.unwrap().value <= DETUNED_PEAK, "{valves:?}");
            setup.controller.pairing = if right == Pairing::Diagonal { Pairing::Swapped } else { Pairing::Diagonal };
            assert_eq!(detuned(&setup), None, "{valves:?}");
        }
    }

    #[test]
    fn levels_are_held_as_long_as_pumps_can() {
        let mut setup = first_experiment();
        let (levels, voltages) = ([0.1226, 0.1278], [3.0, 3.1]);
        for (valves, is_held) in [([0.7, 0.6], true), ([0.3, 0.3], true), ([0.52, 0.5], false), ([0.6, 0.4], false)] {
            setup.valves = valves;
            // One turn after the other, as a hand does.
            setup.operating_point = held_operating_point(&setup, levels, voltages);
            let expected =
                if is_held { OperatingPointSpec::Levels(levels) } else { OperatingPointSpec::PumpVoltage(voltages) };
            assert_eq!(setup.operating_point, expected, "{valves:?}");
            assert!(setup.operating_point().is_ok(), "{valves:?}");
        }
    }

    #[test]
    fn a_loop_with_a_small_peak_stays_as_it_is() {
        let setup = first_experiment();
        assert_eq!(detuned(&setup), Some(setup));
    }

    #[test]
    fn steps_along_the_hard_direction_go_the_wrong_way_and_those_across_it_do_not() {
        let mut setup = first_experiment();
        (setup.valves, setup.controller.pairing) = ([0.43, 0.34], Pairing::Swapped);
        setup = detuned(&setup).unwrap();
        setup.experiment.duration_s = 3000.0;
        let zero = analyse(&setup).unwrap().linear.rightmost_zero().unwrap().clone();
        let worst = |direction| {
            let sizes = direction_steps(&zero, direction, 0.01);
            assert!((sizes[0].hypot(sizes[1]) - 0.01).abs() < 1e-12);
            let mut setup = setup.clone();
            let step = |level: usize| SetPointStep { level, time_s: 20.0, size: sizes[level] };
            setup.experiment.set_point_steps = vec![step(0), step(1)];
            let run = run(&setup).unwrap();
            let iae: f64 = run.metrics.iter().map(|m: &LoopMetrics| m.iae).sum();
            iae
        };
        // Johansson (2000): the interpolation constraint makes the area of the hard direction large.
        assert!(worst(Direction::Hard) > 2.0 * worst(Direction::Easy));
    }
}
