use crate::sim::{LoopMetrics, Trajectory};

/// What happens in the experiment of a setup: the nonlinear plant, its linear model, and how the loops did.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// The nonlinear plant.
    pub nonlinear: Trajectory,
    /// The linear model with the same controller and limits, as absolute levels.
    pub linear: Trajectory,
    /// Metrics of loops 1 and 2 of the nonlinear run.
    pub metrics: [LoopMetrics; 2],
    /// Metrics of loops 1 and 2 of the linear run.
    pub linear_metrics: [LoopMetrics; 2],
}
