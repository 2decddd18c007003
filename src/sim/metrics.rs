//! How well each loop did.

use serde::Serialize;

use crate::control::DecentralisedPi;
use crate::plant::QuadrupleTank;

use super::experiment::Experiment;
use super::response::Response;
use super::trajectory::Trajectory;

/// When a response stays within its band.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Settling {
    /// It settled this long after the step (s).
    After {
        /// Seconds after the step.
        time_s: f64,
    },
    /// It is still outside the band at the end of its window (see [`loop_metrics`]).
    Never,
}

/// How one loop answered its first set-point step, within the window that [`loop_metrics`] describes; sums over the
/// whole run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LoopMetrics {
    /// Time of the step that the response figures refer to (s); `None` when this reference never moves.
    pub step_time_s: Option<f64>,
    /// From 10 % to 90 % of the step (s); `None` when it is never reached.
    pub rise_time_s: Option<f64>,
    /// Into the 2 % band of the step.
    pub settling_2_percent: Option<Settling>,
    /// Into the 5 % band of the step.
    pub settling_5_percent: Option<Settling>,
    /// Furthest beyond the new reference, as a fraction of the step; 0 for none.
    pub overshoot: Option<f64>,
    /// Furthest in the wrong direction, as a fraction of the step; 0 for none.
    pub undershoot: Option<f64>,
    /// Σ |r − h| Δt (m s), Δt from row to row; with a row per sample Σ |r − h| Ts.
    pub iae: f64,
    /// Σ (r − h)² Δt (m² s).
    pub ise: f64,
    /// Σ (t − t_step) |r − h| Δt from the step on, or from the start where there is none (m s²).
    pub itae: f64,
    /// Furthest that the *other* level moves from its own reference within the window of this step (m); 0 without a step.
    pub other_peak: f64,
    /// Σ |Δu| of the controller output of this loop (V).
    pub total_variation: f64,
    /// How long the output of this loop was at a limit (s).
    pub saturated_s: f64,
}

/// The metrics of loops 1 and 2 for a run of `experiment`, nonlinear or linear.
///
/// The response figures refer to the first step of the reference of that loop. Their window ends where anything else is
/// done to the plant, be it a step of either reference or a load, because from there on the response is to that as well;
/// else at the end of the run. They are about true levels, not measured ones. Times are interpolated between rows.
pub fn loop_metrics(
    trajectory: &Trajectory,
    plant: &QuadrupleTank,
    controller: &DecentralisedPi,
    experiment: &Experiment,
) -> [LoopMetrics; 2] {
    let limits = controller.pairing.by_loop(plant.controller_limits());
    std::array::from_fn(|index| metrics_of(trajectory, experiment, index, limits[index]))
}

fn metrics_of(trajectory: &Trajectory, experiment: &Experiment, index: usize, limits: (f64, f64)) -> LoopMetrics {
    let response = Response::first(trajectory, experiment, index);
    let response = response.as_ref();
    let step_time_s = response.map(Response::step_time);
    let mut metrics = LoopMetrics {
        step_time_s,
        rise_time_s: response.and_then(Response::rise_time),
        settling_2_percent: response.map(|response| response.settling(0.02)),
        settling_5_percent: response.map(|response| response.settling(0.05)),
        overshoot: response.map(Response::overshoot),
        undershoot: response.map(Response::undershoot),
        other_peak: response.map_or(0.0, Response::other_peak),
        iae: 0.0,
        ise: 0.0,
        itae: 0.0,
        total_variation: 0.0,
        saturated_s: 0.0,
    };
    metrics.add_up(trajectory, index, limits);
    metrics
}

impl LoopMetrics {
    /// The sums over the run.
    fn add_up(&mut self, trajectory: &Trajectory, index: usize, (min, max): (f64, f64)) {
        let start = self.step_time_s.unwrap_or(0.0);
        let output = &trajectory.controller_output[index];
        let error = trajectory.references[index].iter().zip(&trajectory.levels[index]).map(|(r, h)| (r - h).abs());
        for ((time, output), error) in trajectory.time_s.windows(2).zip(output.windows(2)).zip(error) {
            let elapsed = time[1] - time[0];
            self.iae += error * elapsed;
            self.ise += error * error * elapsed;
            self.itae += (time[0] - start).max(0.0) * error * elapsed;
            self.total_variation += (output[1] - output[0]).abs();
            if output[0] <= min || output[0] >= max {
                self.saturated_s += elapsed;
            }
        }
    }
}
