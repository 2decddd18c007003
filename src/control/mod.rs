//! What acts: the sampled PI controller with anti-windup and two of them as a decentralised controller; PID controllers in
//! their three forms and as a matrix; relays.

mod decentralised;
mod pi;
mod pid;
mod relay;

pub use decentralised::{DecentralisedPi, Pairing, RunningPi};
pub use pi::{AntiWindup, LoopMode, Pi, PiSettings};
pub use pid::{IsaPid, ParallelPid, PidMatrix, RunningPidMatrix, SeriesPid};
pub use relay::Relay;
