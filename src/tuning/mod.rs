//! How gains are found: ultimate points, the critical curve of a plant with two loops, and the rules that start there.
//!
//! The unit of time is that of the plant; periods are in that unit, frequencies in rad per that unit.

mod critical;
mod placement;
mod plants;
mod rules;

pub use critical::{CriticalPoint, CriticalSearch, importance_direction};
pub use placement::{ControllerPair, ParallelPid, integral_action_may_be_stable, place_both_loci, place_one_locus};
pub use plants::PublishedPlant;
pub use rules::{PidGains, TuningRule, UltimatePoint};
