//! What couples the loops: the relative gain array, the Niederlinski index, and the pairing they suggest.

mod decoupling;
mod interpolation;
mod pairing;
mod rga;

pub use decoupling::{Decoupling, decoupled_paths, static_decoupler};
pub use interpolation::interpolation_integral;
pub use pairing::{PairingReason, PairingVerdict, niederlinski, recommend_pairing};
pub use rga::{relative_gain_array, relative_gain_array_at};
