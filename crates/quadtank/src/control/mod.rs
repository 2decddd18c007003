//! What acts: the sampled PI controller with anti-windup and two of them as a decentralised controller; PID controllers in
//! their three forms and as a matrix; relays; the model-free law with its algebraic estimator.

mod decentralised;
mod estimator;
mod model_free;
mod pi;
mod pid;
mod relay;

pub use decentralised::{DecentralisedPi, Pairing, RunningPi};
pub use estimator::{Estimator, EstimatorError, EstimatorSettings, FedWith, MAX_WINDOW_SAMPLES, Quadrature, Window};
pub use model_free::{ModelFree, ModelFreeSettings, ModelFreeWindup, RunningModelFree};
pub use pi::{AntiWindup, LoopMode, Pi, PiSettings};
pub use pid::{IsaPid, ParallelPid, PidMatrix, RunningPidMatrix, SeriesPid};
pub use relay::Relay;
