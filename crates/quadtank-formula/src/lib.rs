//! Transfer functions as people write them.
//!
//! [`element_from_formula`] reads one element, such as `12.8 exp(-s)/(16.7 s + 1)`, and [`formula_of`] writes it.
//! [`elements_from_script`] reads the four elements of a plant from the lines of MATLAB or python-control that define it. Errors say
//! what is wrong and [where](FormulaError::position).

mod delay;
mod error;
mod expression;
mod quotient;
mod script;
mod token;
mod value;
mod write;

pub use error::{FormulaError, FormulaFault, Position};
pub use script::{element_from_formula, elements_from_script};
pub use write::formula_of;

/// Longest text that is read (bytes).
pub const MAX_BYTES: usize = 20_000;
