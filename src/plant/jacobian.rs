use nalgebra::{Matrix2x4, Matrix4, Matrix4x2};

/// The linear model `dx/dt = A x + B u`, `y = C x` of the plant around an operating point, in deviations: `x` levels
/// (m), `u` pump voltages (V), `y` measured signals (V).
///
/// A tank that is dry at the operating point has an infinite √-slope: it follows its inflow at once and holds no
/// water. Such a tank is listed in `dry`, its row and column in A, its row in B and its column in C are zero, and
/// [`Jacobian::reduced`] leaves it out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jacobian {
    /// System matrix (1/s), 4 × 4.
    pub a: Matrix4<f64>,
    /// Input matrix (m/(s V)), 4 × 2.
    pub b: Matrix4x2<f64>,
    /// Output matrix (V/m), 2 × 4.
    pub c: Matrix2x4<f64>,
    /// Which tanks are dry, so that no linear model of them exists.
    pub dry: [bool; 4],
}
