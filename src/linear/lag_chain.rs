//! The motion of one transfer function without its dead time, exact for an input that is held.

use super::{LinearError, TransferFunction};
use crate::scalar::power;

/// Highest order of an element that is simulated.
pub const MAX_ORDER: usize = 8;
/// Terms of the Taylor series at most: with a step of norm 1 the last one is below the rounding of the first.
const TERMS: usize = 24;
/// A term this small beside the sum changes nothing.
const NEGLIGIBLE: f64 = 1e-18;

/// State space of a strictly proper transfer function in controllable form, in a unit of time that makes its coefficients
/// alike: `dx_i/dτ = x_{i+1}`, `dx_n/dτ = u − Σ α_k x_k`, `y = Σ β_k x_k`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    order: usize,
    alpha: [f64; MAX_ORDER],
    beta: [f64; MAX_ORDER],
    /// The unit of time, in units of the plant.
    unit: f64,
    /// Longest step of one Taylor series, in `unit`.
    step: f64,
}

/// State of a [`Motion`].
pub(super) type State = [f64; MAX_ORDER];

impl Motion {
    /// # Errors
    /// [`LinearError::OutOfRange`] with the relative degree when the element is not strictly proper, with the order when it
    /// is beyond [`MAX_ORDER`].
    pub(super) fn new(element: &TransferFunction) -> Result<Self, LinearError> {
        let (numerator, denominator) = (trimmed(element.numerator()), trimmed(element.denominator()));
        // A product of tiny coefficients may have vanished.
        let Some(order) = denominator.len().checked_sub(1) else {
            return Err(LinearError::OutOfRange { field: "denominator", value: 0.0 });
        };
        if !numerator.is_empty() && numerator.len() > order {
            let value = order as f64 - (numerator.len() as f64 - 1.0);
            return Err(LinearError::OutOfRange { field: "relative_degree", value });
        }
        if order > MAX_ORDER {
            return Err(LinearError::OutOfRange { field: "order", value: order as f64 });
        }
        // The mean of the time constants that are not infinite, on a logarithmic scale.
        let leading = denominator[order];
        let unit = denominator
            .iter()
            .position(|&a| a != 0.0)
            .filter(|&lowest| lowest < order)
            .map_or(1.0, |lowest| power((leading / denominator[lowest]).abs(), 1.0 / (order - lowest) as f64));
        let (mut alpha, mut beta) = ([0.0; MAX_ORDER], [0.0; MAX_ORDER]);
        for k in 0..order {
            let scale = unit.powi(i32::try_from(order - k).unwrap_or(0)) / leading;
            alpha[k] = denominator[k] * scale;
            beta[k] = numerator.get(k).copied().unwrap_or(0.0) * scale;
        }
        let norm = alpha.iter().map(|a| a.abs()).sum::<f64>().max(1.0);
        Ok(Self { order, alpha, beta, unit, step: 1.0 / norm })
    }

    /// Mean time constant on a logarithmic scale.
    pub(super) fn unit(&self) -> f64 {
        self.unit
    }

    /// Output y of a state.
    pub(super) fn output(&self, state: &State) -> f64 {
        (0..self.order).map(|k| self.beta[k] * state[k]).sum()
    }

    /// The state after `duration` with the input held.
    pub(super) fn after(&self, state: &State, input: f64, duration: f64) -> State {
        let mut left = duration / self.unit;
        let mut state = *state;
        while left > 0.0 {
            let step = if left > self.step { self.step } else { left };
            self.series(&mut state, input, step);
            left -= step;
        }
        state
    }

    /// One Taylor series `x + τ x' + τ²/2 x'' + …`.
    fn series(&self, state: &mut State, input: f64, step: f64) {
        let n = self.order;
        let mut term = *state;
        let mut drive = input;
        for k in 1..=TERMS {
            let last = drive - (0..n).map(|i| self.alpha[i] * term[i]).sum::<f64>();
            // Only the first derivative sees the input itself.
            drive = 0.0;
            let factor = step / k as f64;
            let mut small = true;
            for i in 0..n {
                let derivative = if i + 1 < n { term[i + 1] } else { last };
                term[i] = derivative * factor;
                state[i] += term[i];
                small &= term[i].abs() <= NEGLIGIBLE * state[i].abs();
            }
            if small {
                break;
            }
        }
    }
}

/// Without the zeros of the highest powers.
fn trimmed(coefficients: &[f64]) -> &[f64] {
    let used = coefficients.iter().rposition(|&c| c != 0.0).map_or(0, |last| last + 1);
    &coefficients[..used]
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    fn response(numerator: &[f64], denominator: &[f64], input: f64, duration: f64) -> f64 {
        let element = TransferFunction::new(numerator.to_vec(), denominator.to_vec(), 0.0).unwrap();
        let motion = Motion::new(&element).unwrap();
        motion.output(&motion.after(&[0.0; MAX_ORDER], input, duration))
    }

    #[test]
    fn step_responses_of_a_lag_an_integrator_and_equal_lags() {
        for t in [1e-3_f64, 0.3, 5.0, 60.0] {
            let expected = 6.0 * (1.0 - (-t / 4.0).exp());
            assert_relative_eq!(response(&[2.0], &[1.0, 4.0], 3.0, t), expected, max_relative = 1e-13);
            assert_relative_eq!(response(&[2.0], &[0.0, 4.0], 3.0, t), 1.5 * t, max_relative = 1e-13);
            // 1/(T s + 1)^3 and s/(T s + 1)^2, T = 0.5.
            let tau = t / 0.5;
            let cubic = 1.0 - (-tau).exp() * (1.0 + tau + tau * tau / 2.0);
            assert_relative_eq!(response(&[1.0], &[1.0, 1.5, 0.75, 0.125], 1.0, t), cubic, epsilon = 1e-14);
            let washout = t / 0.25 * (-tau).exp();
            assert_relative_eq!(response(&[0.0, 1.0], &[1.0, 1.0, 0.25], 1.0, t), washout, epsilon = 1e-14);
        }
    }

    #[test]
    fn an_oscillator_keeps_its_swing() {
        // 1/(s² + 1): y = 1 − cos t, for 50 periods.
        let t = 314.0_f64;
        assert_relative_eq!(response(&[1.0], &[1.0, 0.0, 1.0], 1.0, t), 1.0 - t.cos(), epsilon = 1e-12);
    }

    #[test]
    fn what_is_not_strictly_proper_has_no_motion() {
        let element = TransferFunction::new(vec![1.0, 2.0], vec![1.0, 3.0, 0.0], 0.0).unwrap();
        let refused = LinearError::OutOfRange { field: "relative_degree", value: 0.0 };
        assert_eq!(Motion::new(&element).err(), Some(refused));
    }
}
