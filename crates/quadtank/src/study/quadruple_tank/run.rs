use serde::Serialize;

use crate::control::closed_loop;
use crate::linear::Stability;
use crate::sim::{
    Experiment, LoopMetrics, MAX_JUDGED_WORK, NoResponse, ReferenceStepResponse, Trajectory, loop_metrics_judging,
    simulate, simulate_linear, step_answers,
};

use super::{Prepared, Setup};
use crate::study::{StudyError, whole};

/// What happens in the experiment of a setup: the nonlinear plant, its linear model, and how the loops did.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Run {
    /// Metrics of loops 1 and 2 of the nonlinear run.
    pub metrics: [LoopMetrics; 2],
    /// Metrics of loops 1 and 2 of the linear run.
    pub linear_metrics: [LoopMetrics; 2],
    /// How both loops of the nonlinear run answered each step of their references, by time. The first of a loop is that of its metrics.
    pub steps: Vec<ReferenceStepResponse>,
    /// The same of the linear run.
    pub linear_steps: Vec<ReferenceStepResponse>,
    /// Whether the figures of the step are those of the same experiment without noise, since this one has some.
    pub judged_without_noise: bool,
    /// The nonlinear plant.
    pub nonlinear: Trajectory,
    /// The linear model with the same controller and limits, as absolute levels.
    pub linear: Trajectory,
}

/// Runs the experiment of a setup on the nonlinear plant and on its linear model. Where the sampled linear loop is
/// unstable, the metrics carry no figures of a step response: where limits hold it, an oscillation has none. Nor do they where it is
/// on the border of stability, or where a tank would have to be higher than its walls at the start: such a run does not begin at
/// rest. With noise the figures of the step are those of the same experiment without it.
///
/// # Errors
/// [`StudyError`] at `operating_point` when levels are given and no input holds them, at `experiment.duration_s` when the run takes
/// too much work.
pub fn run(setup: &Setup) -> Result<Run, StudyError> {
    let prepared = Prepared::of(setup)?;
    let closed = closed_loop(&prepared.jacobian, &setup.controller, prepared.plant.power_gain);
    Run::of(&prepared, setup, closed.ok().map(|closed| closed.stability))
}

/// The run of the nonlinear plant alone, which is what a fit does some hundred times.
///
/// # Errors
/// As [`run`].
pub fn nonlinear_run(setup: &Setup) -> Result<Trajectory, StudyError> {
    let (plant, start) = (setup.plant(), setup.operating_point()?);
    whole(simulate(&plant, &start, &setup.controller, &setup.experiment))
}

impl Run {
    /// The run of a setup that is prepared; `stability` is that of its sampled linear loop, if it is known, with both loops closed.
    ///
    /// # Errors
    /// As [`run`], but for the operating point.
    pub fn of(prepared: &Prepared, setup: &Setup, stability: Option<Stability>) -> Result<Self, StudyError> {
        let Prepared { plant, operating_point: start, jacobian } = prepared;
        let Setup { controller, experiment, .. } = setup;
        let stability = if experiment.pump_voltage_steps.is_empty() {
            stability
        } else {
            closed_loop(jacobian, &setup.acting_controller(), plant.power_gain).ok().map(|closed| closed.stability)
        };
        let runs = |experiment: &Experiment| {
            let nonlinear = whole(simulate(plant, start, controller, experiment))?;
            Ok::<_, StudyError>((nonlinear, simulate_linear(plant, start, jacobian, controller, experiment)))
        };
        let (nonlinear, linear) = runs(experiment)?;
        let overflows = (0..4).any(|tank| start.levels[tank] > plant.tanks[tank].height);
        let reason = match (overflows, stability) {
            (true, _) => Some(NoResponse::StartOverflows),
            (false, Some(Stability::Unstable)) => Some(NoResponse::UnstableLoop),
            (false, Some(Stability::Marginal)) => Some(NoResponse::MarginalLoop),
            (false, Some(Stability::Stable) | None) => None,
        };
        let is_noisy = experiment.is_noisy();
        let is_too_long = is_noisy && nonlinear.work > MAX_JUDGED_WORK;
        let reason = reason.or(is_too_long.then_some(NoResponse::TooLongToJudge));
        // Without figures of a step there is nothing to judge.
        let twin = (is_noisy && reason.is_none()).then(|| runs(&experiment.without_noise())).transpose()?;
        let (judged, judged_linear) =
            twin.as_ref().map_or((&nonlinear, &linear), |(nonlinear, linear)| (nonlinear, linear));
        let answers = |judged: &Trajectory| {
            let mut answers = step_answers(judged, experiment, controller.sampling_time_s);
            for answer in &mut answers {
                *answer = reason.map_or(*answer, |reason| answer.without_response(reason));
            }
            answers
        };
        let (steps, linear_steps) = (answers(judged), answers(judged_linear));
        let metrics = |answers: &[ReferenceStepResponse], run: &Trajectory| {
            loop_metrics_judging(answers, run, plant, controller, experiment)
        };
        Ok(Self {
            metrics: metrics(&steps, &nonlinear),
            linear_metrics: metrics(&linear_steps, &linear),
            steps,
            linear_steps,
            judged_without_noise: is_noisy && !is_too_long,
            nonlinear,
            linear,
        })
    }

    /// Largest distance of a level (index 0 to 3) from that of the linear model (m).
    pub fn largest_model_error(&self, level: usize) -> Option<f64> {
        let levels = self.nonlinear.levels[level].iter().zip(&self.linear.levels[level]);
        levels.map(|(nonlinear, linear)| (nonlinear - linear).abs()).reduce(f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::Pairing;
    use crate::literature::PresetId;
    use crate::sim::{PumpVoltageStep, Settling};
    use crate::study::quadruple_tank::setup_of;

    #[test]
    fn an_unstable_loop_has_sums_but_no_step_response() {
        let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
        let stable = run(&setup).unwrap();
        assert!(stable.metrics.iter().all(|m| m.overshoot.is_some() && m.rise_time_s.is_some()));
        setup.controller.pairing = Pairing::Swapped;
        let unstable = run(&setup).unwrap();
        for m in unstable.metrics.into_iter().chain(unstable.linear_metrics) {
            assert_eq!((m.rise_time_s, m.settling_2_percent, m.settling_5_percent), (None, None, None));
            assert_eq!((m.overshoot, m.undershoot, m.no_response), (None, None, Some(NoResponse::UnstableLoop)));
            assert!(m.iae > 0.0 && m.step_time_s.is_some());
        }
    }

    #[test]
    fn a_noisy_run_of_much_work_is_not_run_twice() {
        let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
        setup.experiment.measurement.noise_std = 1e-4;
        let is_refused = |m: &LoopMetrics| m.no_response == Some(NoResponse::TooLongToJudge);
        assert!(!run(&setup).unwrap().metrics.iter().any(is_refused));
        setup.experiment.duration_s = 120_000.0;
        let long = run(&setup).unwrap();
        assert!(long.nonlinear.work > MAX_JUDGED_WORK, "{}", long.nonlinear.work);
        assert!(!long.judged_without_noise);
        for m in long.metrics {
            assert!(is_refused(&m) && m.overshoot.is_none() && m.iae > 0.0, "{m:?}");
        }
        setup.experiment.measurement.noise_std = 0.0;
        assert!(!run(&setup).unwrap().metrics.iter().any(is_refused));
    }

    #[test]
    fn a_run_that_begins_above_a_wall_has_no_step_response() {
        let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
        setup.valves = [0.3, 0.7];
        for m in run(&setup).unwrap().metrics {
            assert_eq!((m.rise_time_s, m.settling_2_percent, m.overshoot), (None, None, None));
            assert_eq!(m.no_response, Some(NoResponse::StartOverflows));
            assert!(m.iae > 0.0 && m.step_time_s.is_some());
        }
    }

    #[test]
    fn a_response_is_looked_at_until_the_next_step_or_load() {
        let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
        setup.experiment.set_point_steps[1].time_s = 120.0;
        let [first, second] = run(&setup).unwrap().metrics;
        assert_eq!((first.step_time_s, first.window_s), (Some(100.0), Some(20.0)));
        assert_eq!((second.step_time_s, second.window_s), (Some(120.0), Some(2880.0)));
        // Level 2 still answers the first step.
        assert!(matches!(second.no_response, Some(NoResponse::NotAtRest { .. })) && first.no_response.is_none());
    }

    #[test]
    fn every_step_is_judged_by_the_rules_of_the_first() {
        let run = run(&setup_of(PresetId::Seville)).unwrap();
        let told: Vec<_> = run.steps.iter().map(|step| (step.level, step.time_s, step.figures.window_s)).collect();
        let window = Some(3000.0);
        let expected = [(0, 3000.0), (1, 3000.0), (0, 6000.0), (1, 6000.0), (0, 9000.0)];
        assert_eq!(told, expected.map(|(level, time_s)| (level, time_s, window)));
        for (level, metrics) in run.metrics.iter().enumerate() {
            let first = run.steps.iter().find(|step| step.level == level).unwrap();
            assert_eq!((metrics.step_time_s, metrics.first_step()), (Some(first.time_s), first.figures));
        }
        for step in run.steps.iter().chain(&run.linear_steps) {
            assert_eq!(step.figures.no_response, None, "{step:?}");
            assert!(
                matches!(step.figures.settling_2_percent, Some(Settling::After { time_s }) if time_s < 3000.0),
                "{step:?}"
            );
        }
    }

    #[test]
    fn a_reason_against_the_first_step_is_one_against_all() {
        let mut setup = setup_of(PresetId::Seville);
        setup.controller.pairing = Pairing::Diagonal;
        for step in run(&setup).unwrap().steps {
            assert_eq!((step.figures.no_response, step.figures.overshoot), (Some(NoResponse::UnstableLoop), None));
        }
    }

    #[test]
    fn the_steps_of_published_rigs_find_their_levels_at_rest() {
        for id in PresetId::ALL {
            let [first, second] = run(&setup_of(id)).unwrap().metrics.map(|metrics| metrics.no_response);
            assert_eq!(first, None, "{id:?}");
            // Johansson's plant with the zero in the right half-plane is slower than the time between our steps.
            let is_slow = id == PresetId::JohanssonNonMinimumPhase;
            assert_eq!(matches!(second, Some(NoResponse::NotAtRest { .. })), is_slow, "{id:?}");
            assert_eq!(second.is_some(), is_slow, "{id:?}");
        }
    }

    #[test]
    fn a_noisy_run_is_judged_by_its_twin_without_noise() {
        let mut setup = setup_of(PresetId::CocotaMinimumPhase);
        let noiseless = run(&setup).unwrap();
        setup.experiment.measurement.noise_std = 2e-3;
        let noisy = run(&setup).unwrap();
        assert!(noisy.judged_without_noise && !noiseless.judged_without_noise);
        let runs = [noisy.metrics, noisy.linear_metrics].into_iter().zip([noiseless.metrics, noiseless.linear_metrics]);
        for (noisy, noiseless) in runs.flat_map(|(noisy, noiseless)| noisy.into_iter().zip(noiseless)) {
            assert_eq!(
                (noisy.settling_2_percent, noisy.overshoot),
                (noiseless.settling_2_percent, noiseless.overshoot)
            );
            assert_eq!((noisy.window_iae, noisy.other_peak), (noiseless.window_iae, noiseless.other_peak));
            assert!(noisy.total_variation > 10.0 * noiseless.total_variation && noisy.iae > noiseless.iae);
        }
    }

    #[test]
    fn a_pump_that_is_moved_by_hand_opens_its_loop() {
        let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
        setup.controller.pairing = Pairing::Swapped;
        // Loop 2 drives pump 1 of the swapped pairing, which makes the two loops unstable together.
        setup.experiment.pump_voltage_steps = vec![PumpVoltageStep { pump: 0, time_s: 1500.0, voltage: 4.0 }];
        let run = run(&setup).unwrap();
        let voltage = |time_s: f64| {
            let row = run.nonlinear.row_at(time_s).unwrap();
            [run.nonlinear.pump_voltage[0][row], run.linear.pump_voltage[0][row]]
        };
        assert_eq!((voltage(1499.0), voltage(1500.0)), ([3.0; 2], [4.0; 2]));
        let [first, second] = run.metrics;
        // Level 1 is that of pump 2, which still follows it; the window ends where the hand moves the other pump.
        assert_eq!((first.no_response, first.window_s.map(|s| s + 100.0)), (None, first.step_time_s.map(|_| 1500.0)));
        assert!(second.total_variation > 0.0);
    }

    #[test]
    fn a_singular_plant_has_no_settling_time() {
        let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
        setup.valves = [0.625, 0.375];
        let singular = run(&setup).unwrap();
        for m in singular.metrics.into_iter().chain(singular.linear_metrics) {
            assert_eq!((m.no_response, m.settling_2_percent), (Some(NoResponse::MarginalLoop), None));
        }
    }
}
