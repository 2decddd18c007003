//! Exact sampling of the four-tank linear model under inputs that are held.

use nalgebra::{Matrix4, Vector4};

/// Terms of the power series; with the norm scaled below 1/2 the next one is below rounding.
const TERMS: u32 = 14;

/// Zero-order hold of four tanks: `x(t + Ts) = Φ x(t) + Ψ f` for `dx/dt = A x + f` with `f` constant, where `Φ = exp(A Ts)` and
/// `Ψ = ∫ exp(A τ) dτ` from 0 to Ts.
///
/// [`StateSpace::sampled`](super::StateSpace::sampled) is for any model; this one allocates nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ZeroOrderHold {
    /// State transition Φ.
    pub(crate) transition: Matrix4<f64>,
    /// What a held rate of change does, Ψ (s).
    pub(crate) response: Matrix4<f64>,
}

impl ZeroOrderHold {
    /// The hold of `a` (1/s), triangular as water only falls, for `duration` (s), by the power series of Ψ on a short stretch of
    /// time that is doubled until it is `duration` long.
    #[expect(clippy::cast_possible_truncation, reason = "a logarithm of a float is small, and the cast saturates")]
    pub(crate) fn new(a: &Matrix4<f64>, duration: f64) -> Self {
        let norm = a.abs().row_sum().max() * duration;
        let doublings = ((2.0 * norm).max(1.0).ln() / std::f64::consts::LN_2).ceil() as i32;
        let doublings = doublings.min(f64::MAX_EXP - 1);
        let short = duration * 2.0_f64.powi(-doublings);
        let step = a * short;
        let mut series = Matrix4::identity();
        for k in (2..=TERMS + 1).rev() {
            series = Matrix4::identity() + step * series / f64::from(k);
        }
        let mut response = series * short;
        let mut transition = Matrix4::identity() + a * response;
        for _ in 0..doublings {
            response += transition * response;
            // Water only falls, so A is triangular and each mode stands alone on the diagonal. There 1 + a Ψ keeps the digits of a
            // slow mode, which squaring loses; elsewhere it would amplify errors, and squaring adds positive terms only.
            transition *= transition;
            transition.set_diagonal(&(Vector4::repeat(1.0) + a.diagonal().component_mul(&response.diagonal())));
        }
        Self { transition, response }
    }

    /// `Φ x + push`.
    pub(crate) fn pass(&self, x: &Vector4<f64>, push: &Vector4<f64>) -> Vector4<f64> {
        self.transition * x + push
    }

    /// `Ψ f`.
    pub(crate) fn push(&self, f: &Vector4<f64>) -> Vector4<f64> {
        self.response * f
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use nalgebra::matrix;

    use super::*;

    #[test]
    fn a_cascade_of_two_equal_tanks_has_its_textbook_response() {
        let t = 20.0;
        let a = matrix![
            -1.0 / t, 0.0, 1.0 / t, 0.0;
            0.0, -2.0, 0.0, 0.0;
            0.0, 0.0, -1.0 / t, 0.0;
            0.0, 0.0, 0.0, 0.0];
        let hold = ZeroOrderHold::new(&a, 30.0);
        let decay = (-1.5_f64).exp();
        assert_relative_eq!(hold.transition[(0, 0)], decay, max_relative = 1e-13);
        assert_relative_eq!(hold.transition[(0, 2)], 1.5 * decay, max_relative = 1e-13);
        assert_relative_eq!(hold.transition[(1, 1)], (-60.0_f64).exp(), epsilon = 1e-15);
        assert_relative_eq!(hold.transition[(3, 3)], 1.0, max_relative = 1e-15);
        assert_relative_eq!(hold.response[(0, 0)], t * (1.0 - decay), max_relative = 1e-13);
        assert_relative_eq!(hold.response[(0, 2)], t * (1.0 - 2.5 * decay), max_relative = 1e-13);
        assert_relative_eq!(hold.response[(3, 3)], 30.0, max_relative = 1e-13);
    }

    #[test]
    fn a_tank_far_quicker_than_the_one_above_it_follows_its_inflow() {
        // Time constants of 1e-103 and 1e-100 s, or of 1e-6 and 1e-3 s, under a sample of 1 s.
        for (lower, upper) in [(1e103, 1e100), (1e6, 1e3), (1e9, 1e8)] {
            let mut a = Matrix4::from_diagonal(&-nalgebra::vector![lower, 1.0, upper, 0.0]);
            a[(0, 2)] = 0.25 * lower;
            let hold = ZeroOrderHold::new(&a, 1.0);
            assert_relative_eq!(hold.response[(0, 2)], 0.25 / upper, max_relative = 1e-12);
            assert_relative_eq!(hold.transition[(0, 2)], 0.0, epsilon = 1e-15);
            assert_relative_eq!(hold.transition[(1, 1)], (-1.0_f64).exp(), max_relative = 1e-12);
        }
    }

    #[test]
    fn a_tank_that_is_a_million_times_faster_stays_finite() {
        let a = Matrix4::from_diagonal(&nalgebra::vector![-1e-2, -1e6, -1e-2, -1e12]);
        let hold = ZeroOrderHold::new(&a, 1.0);
        assert_relative_eq!(hold.transition[(0, 0)], (-1e-2_f64).exp(), max_relative = 1e-12);
        assert_relative_eq!(hold.transition[(3, 3)], 0.0, epsilon = 1e-9);
    }
}
