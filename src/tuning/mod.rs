//! How gains are found: ultimate points, the critical curve of a plant with two loops, and the rules that start there.
//!
//! The unit of time is that of the plant; periods are in that unit, frequencies in rad per that unit.

mod critical;
mod plants;
mod rules;

pub use critical::{CriticalPoint, CriticalSearch, importance_direction};
pub use plants::PublishedPlant;
pub use rules::{PidGains, TuningRule, UltimatePoint};
