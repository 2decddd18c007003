//! One tank with the whole instrument chain of a level loop: transmitter, controller output, I/P converter, actuator, valve.
//!
//! Start with [`LevelPlant`]; [`LevelSignals`] holds the value of every signal, [`LevelGains`] the linear model around it.
//! Levels and flows are in SI. Signals are in the unit of their range (mA, psi), pressures of the actuator in that of its curve.

mod actuator;
mod chain;
mod error;
mod gains;
mod heated;
mod signal;
mod tank;
mod valve;

pub use actuator::{Actuator, ActuatorCurve};
pub use chain::{LevelPlant, LevelSignals};
pub use error::LevelError;
pub use gains::LevelGains;
pub use heated::HeatedTank;
pub use signal::{Converter, OutputStage, SignalRange, SignalUnit, Transmitter};
pub use tank::{LevelTank, Outflow, OutflowLaw, TankModel};
pub use valve::{Characteristic, ControlValve, ValvePlace};
