//! What a linear model says: poles, transmission zeros with their directions, frequency response, exact sampling; and
//! transfer functions with dead time.

mod delayed;
mod discrete;
mod eigen;
mod encirclements;
mod error;
mod exponential;
mod frequency;
mod lag_chain;
mod loci;
mod margins;
mod null_vectors;
pub mod quadruple;
mod reduction;
mod return_ratio;
mod scaling;
mod singular_values;
mod state_space;
mod taylor_model;
mod transfer;
mod turn;
mod zeros;

pub use delayed::{DelayedPlant, Path};
pub use discrete::DiscreteStateSpace;
pub use eigen::eigenvalues;
pub use encirclements::LoopStability;
pub use error::LinearError;
pub use lag_chain::MAX_ORDER;
pub use loci::{Closure, Crossing, Loci, locus_values};
pub use margins::Margins;
pub use return_ratio::ReturnRatio;
pub use singular_values::singular_values;
pub use state_space::StateSpace;
pub use transfer::{TransferFunction, TransferMatrix};
pub use turn::{exponential, square_root, turn};
pub use zeros::{TransmissionZero, place_nearest_at_origin, transmission_zeros};

/// Complex number of the linear room: poles, zeros (1/s) and gains.
pub type Complex = nalgebra::Complex<f64>;
