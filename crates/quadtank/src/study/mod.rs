//! What a bench computes: from a setup, which its document holds, to results. One module per bench.

mod error;
pub mod model_free;
pub mod quadruple_tank;
pub mod relay_tuning;

pub use error::{StudyError, StudyFault};

use crate::sim::Trajectory;

/// A run that went to its end.
fn whole(run: Trajectory) -> Result<Trajectory, StudyError> {
    match run.halted_at_s {
        None => Ok(run),
        Some(time_s) => Err(StudyError { field: "experiment.duration_s", fault: StudyFault::TooMuchWork { time_s } }),
    }
}
