use nalgebra::DVector;

use super::Complex;

/// A finite transmission zero `z` of a square model and the directions that belong to it: `G(z) u = 0`, `yᵀ G(z) = 0`.
#[derive(Clone, Debug, PartialEq)]
pub struct TransmissionZero {
    /// Its place in the s-plane (1/s).
    pub value: Complex,
    /// Input direction `u`, unit length, largest entry real and positive.
    pub input_direction: DVector<Complex>,
    /// Output direction `y` (η in the sources), unit length, largest entry real and positive.
    pub output_direction: DVector<Complex>,
}
