use serde::Serialize;

use crate::control::closed_loop;
use crate::linear::Stability;
use crate::sim::{LoopMetrics, NoResponse, Trajectory, loop_metrics, simulate, simulate_linear};

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
    /// The nonlinear plant.
    pub nonlinear: Trajectory,
    /// The linear model with the same controller and limits, as absolute levels.
    pub linear: Trajectory,
}

/// Runs the experiment of a setup on the nonlinear plant and on its linear model. Where the sampled linear loop is
/// unstable, the metrics carry no figures of a step response: where limits hold it, an oscillation has none. Nor do they where a tank
/// would have to be higher than its walls at the start: such a run does not begin at rest.
///
/// # Errors
/// [`StudyError`] at `operating_point` when levels are given and no input holds them, at `experiment.duration_s` when the run takes
/// too much work.
pub fn run(setup: &Setup) -> Result<Run, StudyError> {
    let prepared = Prepared::of(setup)?;
    let closed = closed_loop(&prepared.jacobian, &setup.controller, prepared.plant.power_gain);
    Run::of(&prepared, setup, closed.is_ok_and(|closed| closed.stability == Stability::Unstable))
}

impl Run {
    /// The run of a setup that is prepared; `is_unstable` says whether its sampled linear loop is.
    ///
    /// # Errors
    /// As [`run`], but for the operating point.
    pub fn of(prepared: &Prepared, setup: &Setup, is_unstable: bool) -> Result<Self, StudyError> {
        let Prepared { plant, operating_point: start, jacobian } = prepared;
        let Setup { controller, experiment, .. } = setup;
        let nonlinear = whole(simulate(plant, start, controller, experiment))?;
        let linear = simulate_linear(plant, start, jacobian, controller, experiment);
        let overflows = (0..4).any(|tank| start.levels[tank] > plant.tanks[tank].height);
        let reason = match (overflows, is_unstable) {
            (true, _) => Some(NoResponse::StartOverflows),
            (false, true) => Some(NoResponse::UnstableLoop),
            (false, false) => None,
        };
        let metrics = |run: &Trajectory| {
            let metrics = loop_metrics(run, plant, controller, experiment);
            reason.map_or(metrics, |reason| metrics.map(|metrics| metrics.without_response(reason)))
        };
        Ok(Self { metrics: metrics(&nonlinear), linear_metrics: metrics(&linear), nonlinear, linear })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::Pairing;
    use crate::literature::PresetId;
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
    }
}
