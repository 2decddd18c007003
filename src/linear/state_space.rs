use nalgebra::DMatrix;

/// A continuous-time linear model `dx/dt = A x + B u`, `y = C x + D u`.
#[derive(Clone, Debug, PartialEq)]
pub struct StateSpace {
    /// System matrix, n × n (1/s).
    pub a: DMatrix<f64>,
    /// Input matrix, n × m.
    pub b: DMatrix<f64>,
    /// Output matrix, p × n.
    pub c: DMatrix<f64>,
    /// Feedthrough, p × m.
    pub d: DMatrix<f64>,
}
