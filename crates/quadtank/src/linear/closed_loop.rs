//! A sampled linear loop that is closed: its poles and its distance from instability.

use nalgebra::{DMatrix, Matrix2};

use super::delayed_loop::{self, DelayedLoop};
use super::sensitivity::{delayed_sensitivity_peak, sensitivity_peak};
use super::{Complex, LinearError, LoopPeak, Stability, UNIT_CIRCLE_TOLERANCE, eigenvalues, s_from_z};

/// The poles of a sampled linear closed loop.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosedLoop {
    /// Whether a hose delays an input. Such a loop has a pole more for each sample of the delay; its poles are not computed, and both
    /// lists of them are empty.
    pub has_dead_time: bool,
    /// Poles of the sampled loop (z-plane), by falling modulus.
    pub poles_z: Vec<Complex>,
    /// The same mapped to the s-plane, `s = ln(z)/Ts` (1/s); a pole at z = 0 has no image and is left
    /// out, one at z = 1 to rounding is at 0.
    pub poles_s: Vec<Complex>,
    /// The verdict.
    pub stability: Stability,
    /// Peak Ms of the largest singular value of the sensitivity at the outputs, over all frequencies up to Nyquist, with its
    /// frequency (rad/s); `None` when the loop is not stable. 1.2 to 2 is usual for a loop that keeps its distance from instability.
    pub sensitivity_peak: Option<LoopPeak>,
}

impl ClosedLoop {
    /// Poles, verdict and sensitivity peak of the loop with the state matrix `state_matrix`, n × n over one sample of
    /// `sampling_time_s` (s).
    ///
    /// `return_ratio` is L(z) of the same loop, 2 × 2, cut open at its outputs: `S = (I + L)⁻¹`. It is asked on the unit circle, some
    /// hundred times and only for a stable loop.
    ///
    /// # Errors
    /// [`LinearError::Dimension`] when the state matrix is not square, [`LinearError::NoConvergence`] when an entry of it is not
    /// finite.
    pub fn new(
        state_matrix: &DMatrix<f64>,
        sampling_time_s: f64,
        return_ratio: impl Fn(Complex) -> Matrix2<Complex>,
    ) -> Result<Self, LinearError> {
        let mut poles_z = eigenvalues(state_matrix)?;
        poles_z.sort_by(|x, y| y.norm().total_cmp(&x.norm()).then(y.im.total_cmp(&x.im)));
        let stability = Stability::of_poles(&poles_z);
        // A pole at z = 1 is moved by rounding, which would be reported as growth or decay.
        let is_one = |z: Complex| (z - Complex::ONE).norm() < UNIT_CIRCLE_TOLERANCE;
        let image = |&z: &Complex| if is_one(z) { Some(Complex::ZERO) } else { s_from_z(z, sampling_time_s) };
        let poles_s: Vec<Complex> = poles_z.iter().filter_map(image).collect();
        let sensitivity_peak =
            (stability == Stability::Stable).then(|| sensitivity_peak(return_ratio, &poles_s, sampling_time_s));
        Ok(Self { has_dead_time: false, poles_z, poles_s, stability, sensitivity_peak })
    }

    /// Verdict and sensitivity peak of a loop whose inputs are delayed, without its poles. `slowest` is a rate (1/s) below which nothing
    /// happens, `delay_s` the longest delay (s), `return_ratio` L(z) with its delays.
    ///
    /// # Errors
    /// [`LinearError::OutOfRange`] where the delay turns the loop too often to be followed around the unit circle.
    pub(crate) fn with_dead_time(
        of: &impl DelayedLoop,
        return_ratio: impl Fn(Complex) -> Matrix2<Complex>,
        (sampling_time_s, slowest, delay_s): (f64, f64, f64),
    ) -> Result<Self, LinearError> {
        let stability =
            delayed_loop::stability(of).ok_or(LinearError::OutOfRange { field: "delay_s", value: delay_s })?;
        let sensitivity_peak = (stability == Stability::Stable)
            .then(|| delayed_sensitivity_peak(return_ratio, sampling_time_s, slowest, delay_s));
        Ok(Self { has_dead_time: true, poles_z: Vec::new(), poles_s: Vec::new(), stability, sensitivity_peak })
    }

    /// The dominant pole: that with the largest real part (1/s); `None` without poles.
    pub fn rightmost_pole(&self) -> Option<Complex> {
        self.poles_s.iter().copied().max_by(|x, y| x.re.total_cmp(&y.re))
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use nalgebra::dmatrix;

    use super::*;

    /// Two integrators under feedback, `L = diag(k₁, k₂)/(z − 1)`, sampled every 2 s.
    fn integrators(gains: [f64; 2]) -> ClosedLoop {
        let [first, second] = gains;
        let matrix = dmatrix![1.0 - first, 0.0; 0.0, 1.0 - second];
        let ratio = |z: Complex| Matrix2::new(first.into(), Complex::ZERO, Complex::ZERO, second.into()) / (z - 1.0);
        ClosedLoop::new(&matrix, 2.0, ratio).unwrap()
    }

    #[test]
    fn two_integrators_have_the_sensitivity_of_their_formula() {
        // S = (z − 1)/(z − 1 + k) is largest at z = −1: 2/(2 − k).
        let closed = integrators([0.5, 0.2]);
        assert_eq!(closed.poles_z, [Complex::from(0.8), Complex::from(0.5)]);
        assert_eq!(closed.rightmost_pole(), Some(Complex::from(0.8_f64.ln() / 2.0)));
        assert_eq!(closed.stability, Stability::Stable);
        let peak = closed.sensitivity_peak.unwrap();
        assert_relative_eq!(peak.value, 2.0 / 1.5, max_relative = 1e-12);
        assert_relative_eq!(peak.frequency, std::f64::consts::FRAC_PI_2, max_relative = 1e-12);
    }

    #[test]
    fn poles_at_one_and_at_zero_are_told_exactly() {
        let closed = integrators([1e-12, 1.0]);
        assert_eq!(closed.stability, Stability::Marginal);
        assert_eq!(closed.poles_s, [Complex::ZERO]);
        assert_eq!(closed.sensitivity_peak, None);
    }

    #[test]
    fn matrices_without_eigenvalues_are_refused() {
        let refused = |matrix: DMatrix<f64>| ClosedLoop::new(&matrix, 1.0, |_| Matrix2::zeros()).unwrap_err();
        assert!(matches!(refused(dmatrix![1.0, 2.0]), LinearError::Dimension { .. }));
        assert!(matches!(refused(dmatrix![f64::NAN]), LinearError::NoConvergence { .. }));
    }
}
