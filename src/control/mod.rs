//! What acts: the sampled PI controller with anti-windup, and two of them as a decentralised controller.

mod decentralised;
mod pi;

pub use decentralised::{DecentralisedPi, Pairing, RunningPi};
pub use pi::{AntiWindup, LoopMode, Pi, PiSettings};
