use nalgebra::{DMatrix, DVector};

use super::error::expect_shape;
use super::{Complex, LinearError, StateSpace, eigenvalues};
use crate::numeric::{matrix_exponential, nearest_power_of_two};

/// A sampled linear model `x[k+1] = A x[k] + B u[k]`, `y[k] = C x[k] + D u[k]`.
#[derive(Clone, Debug, PartialEq)]
pub struct DiscreteStateSpace {
    /// State transition over one sample, n × n.
    pub a: DMatrix<f64>,
    /// Input matrix, n × m.
    pub b: DMatrix<f64>,
    /// Output matrix, p × n.
    pub c: DMatrix<f64>,
    /// Feedthrough, p × m.
    pub d: DMatrix<f64>,
    /// Sampling time (s).
    pub sampling_time_s: f64,
}

impl StateSpace {
    /// The model as a sampled controller meets it: exact at the samples while each input is held for one sampling time
    /// (zero-order hold).
    ///
    /// Both matrices come from one exponential, `exp([A, B; 0, 0] Ts) = [Φ, Γ; 0, I]` (Van Loan 1978).
    ///
    /// # Errors
    /// [`LinearError::OutOfRange`] when the sampling time is not positive and finite, or so long that an unstable
    /// model overflows within it.
    pub fn sampled(&self, sampling_time_s: f64) -> Result<DiscreteStateSpace, LinearError> {
        self.check()?;
        let failure = LinearError::OutOfRange { field: "sampling_time_s", value: sampling_time_s };
        if !(sampling_time_s > 0.0 && sampling_time_s.is_finite()) {
            return Err(failure);
        }
        let (n, m) = (self.order(), self.inputs());
        // Γ is linear in B: with B no larger than A, the squarings of the exponential are those that A alone needs.
        let (size_a, size_b) = (self.a.amax(), self.b.amax());
        let unit = if size_a > 0.0 && size_b > 0.0 { nearest_power_of_two(size_b / size_a) } else { 1.0 };
        let unit = if unit.is_normal() { unit } else { 1.0 };
        let mut augmented = DMatrix::zeros(n + m, n + m);
        augmented.view_mut((0, 0), (n, n)).copy_from(&(&self.a * sampling_time_s));
        augmented.view_mut((0, n), (n, m)).copy_from(&(&self.b * (sampling_time_s / unit)));
        let transition = matrix_exponential(&augmented).ok_or(failure)?;
        let b = transition.view((0, n), (n, m)) * unit;
        if !b.iter().all(|x| x.is_finite()) {
            return Err(failure);
        }
        let a = transition.view((0, 0), (n, n)).into_owned();
        Ok(DiscreteStateSpace { a, b, c: self.c.clone(), d: self.d.clone(), sampling_time_s })
    }
}

impl DiscreteStateSpace {
    /// Output `y[k] = C x[k] + D u[k]`.
    ///
    /// # Errors
    /// [`LinearError::Dimension`] when state or input has the wrong length.
    pub fn output(&self, state: &DVector<f64>, input: &DVector<f64>) -> Result<DVector<f64>, LinearError> {
        self.check(state, input)?;
        Ok(&self.c * state + &self.d * input)
    }

    /// Poles: the eigenvalues of A (z-plane), by rising real part.
    ///
    /// # Errors
    /// [`LinearError::Dimension`], or [`LinearError::NoConvergence`] when an entry is not finite.
    pub fn poles(&self) -> Result<Vec<Complex>, LinearError> {
        eigenvalues(&self.a)
    }

    fn check(&self, state: &DVector<f64>, input: &DVector<f64>) -> Result<(), LinearError> {
        let (n, m, p) = (state.len(), input.len(), self.c.nrows());
        expect_shape("A", &self.a, n, n)?;
        expect_shape("B", &self.b, n, m)?;
        expect_shape("C", &self.c, p, n)?;
        expect_shape("D", &self.d, p, m)
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use nalgebra::{dmatrix, dvector};

    use super::*;

    #[test]
    fn a_lag_and_an_integrator() {
        let lag = StateSpace::strictly_proper(dmatrix![-0.5], dmatrix![3.0], dmatrix![1.0]).unwrap();
        let sampled = lag.sampled(2.0).unwrap();
        let decay = (-1.0_f64).exp();
        assert_relative_eq!(sampled.a[0], decay, max_relative = 1e-15);
        assert_relative_eq!(sampled.b[0], 6.0 * (1.0 - decay), max_relative = 1e-15);
        let integrator = StateSpace::strictly_proper(dmatrix![0.0], dmatrix![3.0], dmatrix![1.0]).unwrap();
        assert_eq!(integrator.sampled(0.5).unwrap().b, dmatrix![1.5]);
    }

    #[test]
    fn steps_follow_the_step_response() {
        let lag = StateSpace::new(dmatrix![-0.5], dmatrix![1.0], dmatrix![1.0], dmatrix![0.25]).unwrap();
        let sampled = lag.sampled(0.1).unwrap();
        let input = dvector![2.0];
        let mut state = dvector![0.0];
        for _ in 0..30 {
            state = &sampled.a * state + &sampled.b * &input;
        }
        let expected = 4.0 * (1.0 - (-1.5_f64).exp()) + 0.5;
        assert_relative_eq!(sampled.output(&state, &input).unwrap()[0], expected, max_relative = 1e-14);
    }

    #[test]
    fn a_hidden_unit_of_the_input_costs_no_accuracy() {
        let a = dmatrix![-0.012, 0.011; 0.0, -0.011];
        let plain = StateSpace::strictly_proper(a.clone(), dmatrix![0.0; 1.0], dmatrix![1.0, 0.0]).unwrap();
        let large = StateSpace::strictly_proper(a, dmatrix![0.0; 1e12], dmatrix![1.0, 0.0]).unwrap();
        let (plain, large) = (plain.sampled(1.0).unwrap(), large.sampled(1.0).unwrap());
        assert_relative_eq!(large.b / 1e12, plain.b, max_relative = 1e-14);
    }

    #[test]
    fn impossible_samplings_are_refused() {
        let unstable = StateSpace::strictly_proper(dmatrix![1.0], dmatrix![1.0], dmatrix![1.0]).unwrap();
        for value in [0.0, -1.0, f64::INFINITY, 1e4] {
            let error = LinearError::OutOfRange { field: "sampling_time_s", value };
            assert_eq!(unstable.sampled(value), Err(error));
        }
        assert!(matches!(unstable.sampled(f64::NAN), Err(LinearError::OutOfRange { .. })));
    }

    #[test]
    fn vectors_of_the_wrong_length_are_refused() {
        let model = StateSpace::strictly_proper(dmatrix![-1.0], dmatrix![1.0], dmatrix![1.0]).unwrap();
        let sampled = model.sampled(1.0).unwrap();
        let error = sampled.output(&dvector![1.0, 2.0], &dvector![1.0]);
        assert!(matches!(error, Err(LinearError::Dimension { matrix: "A", .. })));
        assert!(matches!(sampled.output(&dvector![1.0], &dvector![]), Err(LinearError::Dimension { matrix: "B", .. })));
    }
}
