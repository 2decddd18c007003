//! How well each loop did.

use serde::Serialize;

use crate::control::DecentralisedPi;
use crate::numeric::larger;
use crate::plant::QuadrupleTank;

use super::experiment::Experiment;
use super::response::{NoResponse, Settling};
use super::step_answer::{ReferenceStepResponse, StepFigures, step_answers};
use super::trajectory::Trajectory;

/// How one loop answered its first set-point step, within one window for all figures of it, and what the whole run cost.
///
/// Figures of the step are those up to `other_peak`; `iae` to `saturated_s` are costs of the whole run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LoopMetrics {
    /// Time of the step that the response figures refer to (s); `None` when this reference never moves.
    pub step_time_s: Option<f64>,
    /// How long the response to that step is looked at (s): until anything else is done to the plant, or to the end.
    pub window_s: Option<f64>,
    /// Why the figures of the step are not those of an answer to it alone; `None` where they are. A level that was not at rest has
    /// figures that count from the step itself, and any other reason leaves none.
    pub no_response: Option<NoResponse>,
    /// From 10 % to 90 % of the step (s); `None` also when 90 % is never reached.
    pub rise_time_s: Option<f64>,
    /// Into the 2 % band of the step.
    pub settling_2_percent: Option<Settling>,
    /// Into the 5 % band of the step.
    pub settling_5_percent: Option<Settling>,
    /// Furthest beyond the new reference, as a fraction of the step; 0 for none.
    pub overshoot: Option<f64>,
    /// Furthest in the wrong direction, as a fraction of the step; 0 for none.
    pub undershoot: Option<f64>,
    /// Σ |r − h| Δt within the window (m s).
    pub window_iae: Option<f64>,
    /// Furthest that the *other* level moves, within the window of this step, from where it was when this reference
    /// stepped (m); 0 without a step.
    pub other_peak: f64,
    /// Σ |r − h| Δt over the whole run (m s), Δt from row to row; with a row per sample Σ |r − h| Ts.
    pub iae: f64,
    /// Σ (r − h)² Δt over the whole run (m² s).
    pub ise: f64,
    /// Σ (t − `t_step`) |r − h| Δt from the step to the end of the run, or from the start where there is none (m s²).
    pub itae: f64,
    /// Σ |Δu| of the controller output of this loop over the whole run (V).
    pub total_variation: f64,
    /// How long the output of this loop was at a limit in the whole run (s).
    pub saturated_s: f64,
}

/// The metrics of loops 1 and 2 for a run of `experiment`, nonlinear or linear.
///
/// The response figures refer to the first step of the reference of that loop. Their window ends where anything else is
/// done to the plant, be it a step of either reference or a load, because from there on the response is to that as well;
/// else at the end of the run. Steps or loads that cancel are none. The figures are about true levels, not measured ones.
/// Times are interpolated between rows. `controller` is that of the run.
pub fn loop_metrics(
    trajectory: &Trajectory,
    plant: &QuadrupleTank,
    controller: &DecentralisedPi,
    experiment: &Experiment,
) -> [LoopMetrics; 2] {
    let answers = step_answers(trajectory, experiment, controller.sampling_time_s);
    loop_metrics_judging(&answers, trajectory, plant, controller, experiment)
}

/// The same with the figures of the step from the [`step_answers`] of another run of the experiment: its twin without noise, since
/// the extremes of noise are no overshoot and its excursions no want of settling. The costs are those of `trajectory`.
pub fn loop_metrics_judging(
    answers: &[ReferenceStepResponse],
    trajectory: &Trajectory,
    plant: &QuadrupleTank,
    controller: &DecentralisedPi,
    experiment: &Experiment,
) -> [LoopMetrics; 2] {
    let limits = controller.pairing.by_loop(plant.controller_limits());
    std::array::from_fn(|index| {
        let mut metrics = figures_of_step(answers, experiment, index);
        metrics.add_up(trajectory, index, limits[index]);
        metrics
    })
}

/// The figures of the first step that the run comes to, without costs.
fn figures_of_step(answers: &[ReferenceStepResponse], experiment: &Experiment, index: usize) -> LoopMetrics {
    let first = answers.iter().find(|answer| answer.level == index && answer.figures.window_s.is_some());
    let without_step = || match experiment.step_after_end_s(index) {
        Some(time_s) => NoResponse::StepAfterEnd { time_s },
        None => NoResponse::NoStep,
    };
    let figures = first.map_or_else(|| StepFigures::none(without_step()), |answer| answer.figures);
    LoopMetrics {
        step_time_s: first.map(|answer| answer.time_s),
        window_s: figures.window_s,
        no_response: figures.no_response,
        rise_time_s: figures.rise_time_s,
        settling_2_percent: figures.settling_2_percent,
        settling_5_percent: figures.settling_5_percent,
        overshoot: figures.overshoot,
        undershoot: figures.undershoot,
        window_iae: figures.window_iae,
        other_peak: figures.other_peak,
        iae: 0.0,
        ise: 0.0,
        itae: 0.0,
        total_variation: 0.0,
        saturated_s: 0.0,
    }
}

impl LoopMetrics {
    /// The figures of the first step alone.
    pub const fn first_step(&self) -> StepFigures {
        StepFigures {
            window_s: self.window_s,
            no_response: self.no_response,
            rise_time_s: self.rise_time_s,
            settling_2_percent: self.settling_2_percent,
            settling_5_percent: self.settling_5_percent,
            overshoot: self.overshoot,
            undershoot: self.undershoot,
            window_iae: self.window_iae,
            other_peak: self.other_peak,
        }
    }

    /// The sums over the run.
    fn add_up(&mut self, trajectory: &Trajectory, index: usize, (min, max): (f64, f64)) {
        let start = self.step_time_s.unwrap_or(0.0);
        let output = &trajectory.controller_output[index];
        let error = trajectory.references[index].iter().zip(&trajectory.levels[index]).map(|(r, h)| (r - h).abs());
        for ((time, output), error) in trajectory.time_s.windows(2).zip(output.windows(2)).zip(error) {
            let elapsed = time[1] - time[0];
            self.iae += error * elapsed;
            self.ise += error * error * elapsed;
            self.itae += larger(time[0] - start, 0.0) * error * elapsed;
            self.total_variation += (output[1] - output[0]).abs();
            if output[0] <= min || output[0] >= max {
                self.saturated_s += elapsed;
            }
        }
    }
}

#[cfg(test)]
mod tests;
