//! Runs of one level loop: disturbances, controllers, logs and their figures; and the heated tank.
//!
//! A [`LevelSimulation`] is prepared once for a plant and an experiment and then run with any number of controllers.

mod disturbance;
mod experiment;
mod figures;
mod heated;
mod kernel;
mod log;
mod park_miller;
mod run;
mod statistics;

pub use disturbance::{InflowDisturbance, InflowSignal};
pub use experiment::{LevelController, LevelExperiment, LevelRunError, SetPointScale, SignalStep};
pub use figures::{LevelFigures, LevelStepResponse, NoStepAnswer};
pub use heated::{HeatedRun, heated_run};
pub use log::LevelLog;
pub use park_miller::ParkMillerNormal;
pub use run::{LevelSimulation, MAX_LEVEL_STEPS};
pub use statistics::{SampleStatistics, is_rounding};
