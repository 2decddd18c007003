//! What a linear model says: poles, transmission zeros with their directions, frequency response, exact sampling; sampled closed
//! loops with their stability and sensitivity; and transfer functions with dead time.

mod closed_loop;
mod delayed;
mod discrete;
mod encirclements;
mod error;
mod frequency;
mod lag_chain;
mod loci;
mod margins;
mod matrix_zeros;
mod null_vectors;
mod peaks;
pub mod quadruple;
mod reduction;
mod return_ratio;
mod scaling;
mod sensitivity;
mod single_loop;
mod spectrum;
mod stability;
mod state_space;
mod taylor_model;
mod transfer;
mod zero_order_hold;
mod zeros;

pub use crate::numeric::Complex;
pub use closed_loop::ClosedLoop;
pub use delayed::{DelayedPlant, SignalPath};
pub use discrete::DiscreteStateSpace;
pub use encirclements::LoopStability;
pub use error::LinearError;
pub use lag_chain::MAX_ORDER;
pub use loci::{Closure, Crossing, Loci, locus_values};
pub use margins::Margins;
pub use matrix_zeros::MatrixPolesAndZeros;
pub use peaks::{LoopPeak, biggest_log_modulus, largest_sensitivity};
pub use return_ratio::ReturnRatio;
pub use sensitivity::LoopGains;
pub use single_loop::SingleLoop;
pub use spectrum::{eigenvalues, singular_values};
pub use stability::{Stability, UNIT_CIRCLE_TOLERANCE, s_from_z};
pub use state_space::StateSpace;
pub use transfer::{TransferFunction, TransferMatrix};
pub(crate) use zero_order_hold::ZeroOrderHold;
pub use zeros::{TransmissionZero, place_nearest_at_origin, transmission_zeros};
