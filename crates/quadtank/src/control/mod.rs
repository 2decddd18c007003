//! What acts: the sampled PI controller with anti-windup and two of them as a decentralised controller; PID controllers in
//! their three forms and as a matrix; relays; the model-free law with its algebraic estimator. And the linear closed loops of
//! the plant with the two sampled laws: their poles, stability and sensitivity.

mod decentralised;
mod estimator;
mod level_loop;
mod model_free;
mod model_free_loop;
mod pi;
mod pi_dials;
mod pi_loop;
mod pid;
mod relay;

pub use decentralised::{DecentralisedPi, Pairing, RunningPi};
pub use estimator::{Estimator, EstimatorError, EstimatorSettings, FedWith, MAX_WINDOW_SAMPLES, Quadrature, Window};
pub use level_loop::{level_loop, level_transfer_function};
pub use model_free::{ModelFree, ModelFreeAntiWindup, ModelFreeSettings, RunningModelFree};
pub use model_free_loop::{
    ModelFreePoles, continuous_model_free_poles, model_free_poles, smallest_model_gain,
    smallest_model_gain_of_integrator,
};
pub use pi::{AntiWindup, LoopMode, Pi, PiSettings};
pub use pi_dials::{IntegralDial, PiDials, PiForm, ProportionalDial};
pub use pi_loop::{PiLoop, closed_loop};
pub use pid::{IsaPid, ParallelPid, PidMatrix, RunningPidMatrix, SeriesPid};
pub use relay::Relay;
