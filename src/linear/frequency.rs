//! What the model does to sinusoids.

use nalgebra::{DMatrix, SVD};

use super::{Complex, LinearError, StateSpace};

/// QR iterations allowed per singular value.
const ITERATIONS_PER_VALUE: usize = 100;

impl StateSpace {
    /// Transfer matrix `G(s) = C (s I − A)⁻¹ B + D`, p × m, at one point of the s-plane (1/s).
    ///
    /// # Errors
    /// [`LinearError::SingularGain`] with a reciprocal condition of 0 at a pole; [`LinearError::OutOfRange`] when `s`
    /// is not finite.
    pub fn gain_at(&self, s: Complex) -> Result<DMatrix<Complex>, LinearError> {
        self.check()?;
        if !s.is_finite() {
            let value = if s.re.is_finite() { s.im } else { s.re };
            return Err(LinearError::OutOfRange { field: "s", value });
        }
        let feedthrough = self.d.map(Complex::from);
        if self.order() == 0 {
            return Ok(feedthrough);
        }
        let mut resolvent = self.a.map(|a| Complex::from(-a));
        for i in 0..self.order() {
            resolvent[(i, i)] += s;
        }
        let gain =
            resolvent.lu().solve(&self.b.map(Complex::from)).map(|x| self.c.map(Complex::from) * x + feedthrough);
        gain.filter(|gain| gain.iter().all(|g| g.is_finite()))
            .ok_or(LinearError::SingularGain { reciprocal_condition: 0.0 })
    }

    /// Frequency response G(jω), p × m; `w` is ω (rad/s).
    ///
    /// # Errors
    /// As [`StateSpace::gain_at`].
    pub fn frequency_response(&self, w: f64) -> Result<DMatrix<Complex>, LinearError> {
        if w.is_finite() {
            self.gain_at(Complex::new(0.0, w))
        } else {
            Err(LinearError::OutOfRange { field: "w", value: w })
        }
    }

    /// Singular values of G(jω), largest first: the largest and smallest amplification over all input directions.
    ///
    /// # Errors
    /// As [`StateSpace::gain_at`]; [`LinearError::NoConvergence`] when the iteration does not end.
    pub fn singular_values(&self, w: f64) -> Result<Vec<f64>, LinearError> {
        singular_values(self.frequency_response(w)?)
    }
}

/// Singular values of a matrix, largest first.
///
/// # Errors
/// [`LinearError::NoConvergence`] when an entry or a value is not finite or the iteration does not end.
pub fn singular_values<T>(matrix: DMatrix<T>) -> Result<Vec<f64>, LinearError>
where
    T: nalgebra::ComplexField<RealField = f64>,
{
    let size = matrix.nrows().min(matrix.ncols());
    if size == 0 {
        return Ok(Vec::new());
    }
    let failure = LinearError::NoConvergence { size };
    let largest = matrix.iter().fold(0.0, |max: f64, x| max.max(x.clone().abs()));
    if !largest.is_finite() || !matrix.iter().all(nalgebra::ComplexField::is_finite) {
        return Err(failure);
    }
    if largest == 0.0 {
        return Ok(vec![0.0; size]);
    }
    let svd = SVD::try_new(matrix.unscale(largest), false, false, f64::EPSILON, ITERATIONS_PER_VALUE * size);
    let values: Vec<f64> = svd.ok_or(failure)?.singular_values.iter().map(|value| value * largest).collect();
    if values.iter().all(|value| value.is_finite()) { Ok(values) } else { Err(failure) }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use nalgebra::dmatrix;

    use super::*;

    #[test]
    fn a_lag_at_its_corner() {
        let lag = StateSpace::strictly_proper(dmatrix![-2.0], dmatrix![1.0], dmatrix![2.0]).unwrap();
        let gain = lag.frequency_response(2.0).unwrap()[0];
        assert!((gain - Complex::new(0.5, -0.5)).norm() < 1e-15);
        assert_relative_eq!(lag.singular_values(2.0).unwrap()[0], 0.5_f64.sqrt(), max_relative = 1e-15);
    }

    #[test]
    fn a_pole_on_the_axis_has_no_response() {
        let oscillator =
            StateSpace::strictly_proper(dmatrix![0.0, 1.0; -1.0, 0.0], dmatrix![0.0; 1.0], dmatrix![1.0, 0.0]).unwrap();
        let singular = LinearError::SingularGain { reciprocal_condition: 0.0 };
        assert_eq!(oscillator.frequency_response(1.0), Err(singular));
        assert!(oscillator.frequency_response(0.5).is_ok());
    }

    #[test]
    fn a_frequency_that_is_none() {
        let lag = StateSpace::strictly_proper(dmatrix![-2.0], dmatrix![1.0], dmatrix![2.0]).unwrap();
        for value in [f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(lag.frequency_response(value), Err(LinearError::OutOfRange { field: "w", value }));
        }
        assert!(matches!(lag.singular_values(f64::NAN), Err(LinearError::OutOfRange { field: "w", .. })));
    }

    #[test]
    fn singular_values_of_known_matrices() {
        let values = singular_values(dmatrix![3.0, 0.0; 4.0, 5.0]).unwrap();
        assert_relative_eq!(values[0], 45.0_f64.sqrt(), max_relative = 1e-15);
        assert_relative_eq!(values[1], 5.0_f64.sqrt(), max_relative = 1e-15);
        assert_eq!(singular_values(DMatrix::<f64>::zeros(2, 3)), Ok(vec![0.0, 0.0]));
        assert_eq!(singular_values(dmatrix![1.0, f64::NAN]), Err(LinearError::NoConvergence { size: 1 }));
    }
}
