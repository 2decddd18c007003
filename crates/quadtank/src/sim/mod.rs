//! Plant + controller + experiment → trajectories, events and metrics; and the zero dynamics of the nonlinear plant. [`level`] has
//! runs of one level loop.

mod binary_sequence;
mod course;
mod experiment;
mod explicit;
mod gaussian;
mod held_tank;
mod hoses;
mod hydraulics;
mod implicit;
mod integrate;
pub mod level;
mod linear;
mod metrics;
mod model_free;
mod noise;
mod nonlinear;
mod response;
mod step_answer;
mod step_metrics;
mod tracking;
mod trajectory;
mod two_loops;
mod walls;
mod zero_dynamics;

pub use binary_sequence::{BinarySequence, binary_moves};
pub use course::{MAX_JUDGED_WORK, MAX_ROWS, MAX_RUN_WORK};
pub use experiment::{Experiment, InflowStep, Load, LoadStep, Measurement, PumpVoltageStep, SetPointStep};
pub use held_tank::HeldTank;
pub use linear::simulate_linear;
pub use metrics::{LoopMetrics, loop_metrics, loop_metrics_judging};
pub use model_free::{ModelFreeRun, simulate_model_free, simulate_with_valves};
pub use nonlinear::simulate;
pub use response::{NoResponse, Settling};
pub use step_answer::{ReferenceStepResponse, StepFigures, step_answers};
pub use step_metrics::StepMetrics;
pub use tracking::{TrackingMetrics, tracking_metrics};
pub use trajectory::{Event, EventKind, Trajectory};
pub use two_loops::{Halt, HeldPlant, LoopTrace, MAX_WORK, TwoLoops, run_two_loops, run_two_loops_within};
pub use zero_dynamics::{ZeroDynamics, ZeroDynamicsEnd};
