//! What is really there: tanks, outlets, pumps, valves and sensors, and the nonlinear equations they obey.
//!
//! Start with [`QuadrupleTank`]; [`OperatingPoint`] is where it rests, [`Jacobian`] how it moves around that point. [`level`] has one
//! tank with the instruments of a level loop.

mod equilibrium;
mod error;
mod feasible;
mod jacobian;
pub mod level;
mod pump;
mod quadruple;
mod schedule;
mod tank;
mod valve;

pub use equilibrium::{OperatingPoint, SINGULAR_MARGIN};
pub use error::PlantError;
pub use jacobian::Jacobian;
pub use pump::Pump;
pub use quadruple::{Disturbance, QuadrupleTank, Sensor};
pub use schedule::ValveSchedule;
pub use tank::{CrossSection, Outlet, Tank};
pub use valve::{FlowFractions, Valve};
