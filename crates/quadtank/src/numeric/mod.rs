//! Methods of numerical mathematics that the libraries lack, or that are more exact or safer here than there.

mod comparison;
mod complex;
mod eigenvalues;
mod matrix_exponential;
mod powers;
mod runge_kutta;
mod search;
mod shares;
mod singular_values;

pub(crate) use comparison::{is_zero, larger, smaller};
pub(crate) use complex::modulus;
pub use complex::{Complex, square_root};
pub use eigenvalues::eigenvalues;
pub use matrix_exponential::matrix_exponential;
pub use powers::nearest_power_of_two;
pub use runge_kutta::runge_kutta_step;
pub use search::{golden_section, root};
pub use shares::{complements, excess_over_one};
pub use singular_values::singular_values;
