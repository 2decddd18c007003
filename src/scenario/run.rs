use serde::Serialize;

use crate::sim::{LoopMetrics, Trajectory, loop_metrics, simulate, simulate_linear};

use super::{ScenarioError, Setup};

/// What happens in the experiment of a setup: the nonlinear plant, its linear model, and how the loops did.
#[derive(Clone, Debug, PartialEq, Serialize)]
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

/// Runs the experiment of a setup on the nonlinear plant and on its linear model.
///
/// # Errors
/// [`ScenarioError::Plant`] when levels are given and no input holds them.
pub fn run(setup: &Setup) -> Result<Run, ScenarioError> {
    let plant = setup.plant();
    let start = setup.operating_point()?;
    let Setup { controller, experiment, .. } = setup;
    let nonlinear = simulate(&plant, &start, controller, experiment);
    let linear = simulate_linear(&plant, &start, &plant.linearise(&start), controller, experiment);
    Ok(Run {
        metrics: loop_metrics(&nonlinear, &plant, controller, experiment),
        linear_metrics: loop_metrics(&linear, &plant, controller, experiment),
        nonlinear,
        linear,
    })
}
