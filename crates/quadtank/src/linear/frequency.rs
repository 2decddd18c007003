//! What the model does to sinusoids.

use nalgebra::DMatrix;

use super::{Complex, LinearError, StateSpace, singular_values};

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
    /// As [`StateSpace::gain_at`]; [`LinearError::NoConvergence`] when a value is not finite.
    pub fn singular_values(&self, w: f64) -> Result<Vec<f64>, LinearError> {
        singular_values(&self.frequency_response(w)?)
    }
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
}
