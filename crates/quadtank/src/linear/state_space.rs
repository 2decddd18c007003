use nalgebra::DMatrix;

use super::error::expect_shape;
use super::{Complex, LinearError, eigenvalues};

/// A continuous-time linear model `dx/dt = A x + B u`, `y = C x + D u`.
///
/// The fields are open, so every method checks sizes and entries again before it computes.
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

impl StateSpace {
    /// A model from its four matrices; `n = 0` is a static gain.
    ///
    /// # Errors
    /// [`LinearError::Dimension`] when the sizes do not fit, [`LinearError::NoConvergence`] when an entry is not finite.
    pub fn new(a: DMatrix<f64>, b: DMatrix<f64>, c: DMatrix<f64>, d: DMatrix<f64>) -> Result<Self, LinearError> {
        let model = Self { a, b, c, d };
        model.check()?;
        Ok(model)
    }

    /// A model without feedthrough, D = 0.
    ///
    /// # Errors
    /// As [`StateSpace::new`].
    pub fn strictly_proper(a: DMatrix<f64>, b: DMatrix<f64>, c: DMatrix<f64>) -> Result<Self, LinearError> {
        let d = DMatrix::zeros(c.nrows(), b.ncols());
        Self::new(a, b, c, d)
    }

    /// Number of states n.
    pub fn order(&self) -> usize {
        self.a.nrows()
    }

    /// Number of inputs m.
    pub fn inputs(&self) -> usize {
        self.b.ncols()
    }

    /// Number of outputs p.
    pub fn outputs(&self) -> usize {
        self.c.nrows()
    }

    /// Poles: the eigenvalues of A (1/s), by rising real part.
    ///
    /// # Errors
    /// [`LinearError::Dimension`], or [`LinearError::NoConvergence`] when an entry is not finite.
    pub fn poles(&self) -> Result<Vec<Complex>, LinearError> {
        self.check()?;
        eigenvalues(&self.a)
    }

    /// Steady-state gain `G(0) = D − C A⁻¹ B`, p × m.
    ///
    /// # Errors
    /// [`LinearError::SingularGain`] with a reciprocal condition of 0 when there is a pole at the origin.
    pub fn dc_gain(&self) -> Result<DMatrix<f64>, LinearError> {
        self.check()?;
        if self.order() == 0 {
            return Ok(self.d.clone());
        }
        let no_gain = LinearError::SingularGain { reciprocal_condition: 0.0 };
        // A slow state beside a fast one is no singularity: compare pivots only after every row is brought to size 1.
        let mut a = self.a.clone();
        let mut b = self.b.clone();
        for (mut row, mut input) in a.row_iter_mut().zip(b.row_iter_mut()) {
            let size = row.amax();
            if size == 0.0 {
                return Err(no_gain);
            }
            row.unscale_mut(size);
            input.unscale_mut(size);
        }
        let lu = a.full_piv_lu();
        let smallest_pivot = lu.u().diagonal().amin();
        if smallest_pivot <= self.order() as f64 * f64::EPSILON {
            return Err(no_gain);
        }
        let gain = lu.solve(&b).map(|x| &self.d - &self.c * x).ok_or(no_gain)?;
        if gain.iter().all(|g| g.is_finite()) { Ok(gain) } else { Err(no_gain) }
    }

    /// The model with its arrows reversed, `(Aᵀ, Cᵀ, Bᵀ, Dᵀ)`: the same poles and zeros, inputs and outputs exchanged.
    #[must_use]
    pub fn dual(&self) -> Self {
        Self { a: self.a.transpose(), b: self.c.transpose(), c: self.b.transpose(), d: self.d.transpose() }
    }

    /// Checks sizes and that every entry is finite.
    pub(super) fn check(&self) -> Result<(), LinearError> {
        let (n, m, p) = (self.order(), self.inputs(), self.outputs());
        expect_shape("A", &self.a, n, n)?;
        expect_shape("B", &self.b, n, m)?;
        expect_shape("C", &self.c, p, n)?;
        expect_shape("D", &self.d, p, m)?;
        let finite = [&self.a, &self.b, &self.c, &self.d].iter().all(|x| x.iter().all(|v| v.is_finite()));
        if finite { Ok(()) } else { Err(LinearError::NoConvergence { size: n }) }
    }

    /// Checks that there are as many inputs as outputs.
    pub(super) fn check_square(&self) -> Result<(), LinearError> {
        let (inputs, outputs) = (self.inputs(), self.outputs());
        if inputs == outputs { Ok(()) } else { Err(LinearError::NotSquare { inputs, outputs }) }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::dmatrix;

    use super::*;

    #[test]
    fn sizes_that_do_not_fit_are_named() {
        let wrong = StateSpace::strictly_proper(dmatrix![1.0, 0.0; 0.0, 1.0], dmatrix![1.0], dmatrix![1.0, 1.0]);
        let expected =
            LinearError::Dimension { matrix: "B", rows: 1, columns: 1, expected_rows: 2, expected_columns: 1 };
        assert_eq!(wrong, Err(expected));
        let not_square = StateSpace::strictly_proper(dmatrix![1.0, 0.0], dmatrix![1.0], dmatrix![1.0]);
        assert!(matches!(not_square, Err(LinearError::Dimension { matrix: "A", .. })));
    }

    #[test]
    fn a_matrix_spoilt_later_is_an_error_not_a_panic() {
        let mut model = StateSpace::strictly_proper(dmatrix![-1.0], dmatrix![1.0], dmatrix![1.0]).unwrap();
        model.b = dmatrix![1.0; 2.0];
        assert!(matches!(model.dc_gain(), Err(LinearError::Dimension { matrix: "B", .. })));
        model.b = dmatrix![f64::NAN];
        assert_eq!(model.poles(), Err(LinearError::NoConvergence { size: 1 }));
    }

    #[test]
    fn steady_state_gain_of_a_lag_and_of_an_integrator() {
        let lag = StateSpace::new(dmatrix![-0.5], dmatrix![3.0], dmatrix![2.0], dmatrix![1.0]).unwrap();
        assert_eq!(lag.dc_gain(), Ok(dmatrix![13.0]));
        let integrator = StateSpace::strictly_proper(
            dmatrix![1.0, 2.0, 3.0; 4.0, 5.0, 6.0; 7.0, 8.0, 9.0] * 0.1,
            dmatrix![1.0; 0.0; 0.0],
            dmatrix![1.0, 0.0, 0.0],
        );
        assert_eq!(integrator.unwrap().dc_gain(), Err(LinearError::SingularGain { reciprocal_condition: 0.0 }));
    }

    #[test]
    fn slow_beside_fast_is_not_singular() {
        let model =
            StateSpace::strictly_proper(dmatrix![-1e-12, 0.0; 0.0, -1e12], dmatrix![1.0; 1.0], dmatrix![1.0, 1.0]);
        approx::assert_relative_eq!(model.unwrap().dc_gain().unwrap()[0], 1e12, max_relative = 1e-15);
    }

    #[test]
    fn a_static_gain_has_no_poles() {
        let gain =
            StateSpace::new(DMatrix::zeros(0, 0), DMatrix::zeros(0, 2), DMatrix::zeros(1, 0), dmatrix![4.0, 5.0])
                .unwrap();
        assert_eq!(gain.poles(), Ok(vec![]));
        assert_eq!(gain.dc_gain(), Ok(dmatrix![4.0, 5.0]));
    }
}
