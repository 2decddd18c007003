//! The motion of one transfer function without its dead time, exact for an input that is held.

use super::transfer::degree;
use super::{LinearError, TransferFunction};

/// Highest order of an element that is simulated.
pub const MAX_ORDER: usize = 8;
/// Terms of the Taylor series at most: with a step of norm 1 the last one is below the rounding of the first.
const TERMS: usize = 24;
/// A term this small beside the sum changes nothing.
const NEGLIGIBLE: f64 = 1e-18;

/// Doublings of the longest step of one Taylor series that are kept: as many as a count of steps has binary digits.
const DOUBLINGS: usize = u64::BITS as usize;

/// State space of a proper transfer function in controllable form, in a unit of time that makes its coefficients alike:
/// `dx_i/dτ = x_{i+1}`, `dx_n/dτ = u − Σ α_k x_k`, `y = Σ β_k x_k + δ u`.
///
/// A quick pole beside a slow one makes the steps of the Taylor series short. Any duration is therefore a sum of doublings of
/// the longest step, each passed at once, and a remainder: the work grows with the logarithm of the duration.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    order: usize,
    alpha: State,
    beta: State,
    /// Direct feedthrough δ.
    through: f64,
    /// The unit of time, in units of the plant.
    unit: f64,
    /// Longest step of one Taylor series, in `unit`.
    step: f64,
    /// Leap k lasts `2^k step`.
    leaps: Vec<Leap>,
}

/// State of a [`Motion`].
pub(super) type State = [f64; MAX_ORDER];

/// The change over a fixed duration with the input held, `x(t + h) − x(t) = E x(t) + γ u`, `E = exp(A h) − I`: without the
/// identity a slow pole keeps its digits beside a quick one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leap {
    order: usize,
    state: [State; MAX_ORDER],
    input: State,
}

impl Leap {
    /// The state after the leap.
    pub(super) fn after(&self, state: &State, input: f64) -> State {
        let mut after = *state;
        for (i, entry) in after.iter_mut().enumerate().take(self.order) {
            *entry += self.input[i] * input + self.row_times(i, state);
        }
        after
    }

    fn row_times(&self, row: usize, state: &State) -> f64 {
        (0..self.order).map(|k| self.state[row][k] * state[k]).sum()
    }

    /// This leap and then another: `E + E₂ + E₂ E` and `γ + γ₂ + E₂ γ`.
    fn then(&self, other: &Self) -> Self {
        let mut both = *self;
        for i in 0..self.order {
            for k in 0..self.order {
                let product: f64 = (0..self.order).map(|m| other.state[i][m] * self.state[m][k]).sum();
                both.state[i][k] += other.state[i][k] + product;
            }
            both.input[i] += other.input[i] + other.row_times(i, &self.input);
        }
        both
    }

    /// Multiplications of [`after`](Self::after).
    pub(super) fn multiplications(&self) -> f64 {
        (self.order * (self.order + 1)) as f64
    }
}

impl Motion {
    /// The state space of a proper element, without its dead time.
    ///
    /// # Errors
    /// [`LinearError::OutOfRange`] with the relative degree when the element is not proper, with the order when it is beyond
    /// [`MAX_ORDER`].
    pub(super) fn new(element: &TransferFunction) -> Result<Self, LinearError> {
        let (numerator, denominator) = (trimmed(element.numerator()), trimmed(element.denominator()));
        // A product of tiny coefficients may have vanished.
        let Some(order) = denominator.len().checked_sub(1) else {
            return Err(LinearError::OutOfRange { field: "denominator", value: 0.0 });
        };
        if numerator.len() > order + 1 {
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
            .map_or(1.0_f64, |lowest| (leading / denominator[lowest]).abs().powf(1.0 / (order - lowest) as f64));
        let through = element.feedthrough();
        let (mut alpha, mut beta) = ([0.0; MAX_ORDER], [0.0; MAX_ORDER]);
        for k in 0..order {
            let scale = unit.powi(i32::try_from(order - k).unwrap_or(0)) / leading;
            alpha[k] = denominator[k] * scale;
            beta[k] = (numerator.get(k).copied().unwrap_or(0.0) - through * denominator[k]) * scale;
        }
        let norm = alpha.iter().map(|a| a.abs()).sum::<f64>().max(1.0);
        let mut motion =
            Self { order, alpha, beta, through, unit, step: 1.0 / norm, leaps: Vec::with_capacity(DOUBLINGS) };
        let mut leap = motion.short_leap(motion.step);
        for _ in 0..DOUBLINGS {
            motion.leaps.push(leap);
            leap = leap.then(&leap);
        }
        Ok(motion)
    }

    /// The leap of one Taylor series.
    fn short_leap(&self, step: f64) -> Leap {
        let input = self.series(&[0.0; MAX_ORDER], 1.0, step);
        let mut leap = Leap { order: self.order, state: [[0.0; MAX_ORDER]; MAX_ORDER], input };
        for k in 0..self.order {
            let mut unit = [0.0; MAX_ORDER];
            unit[k] = 1.0;
            for (row, change) in leap.state.iter_mut().zip(self.series(&unit, 0.0, step)) {
                row[k] = change;
            }
        }
        leap
    }

    /// The leaps that make a duration, and what remains of it, in `unit`.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole count; the cast saturates")]
    fn parts(&self, duration: f64) -> (impl Iterator<Item = &Leap>, f64) {
        let duration = duration / self.unit;
        let steps = (duration / self.step).floor();
        let digits = steps as u64;
        let leaps = self.leaps.iter().enumerate().filter(move |(k, _)| digits >> k & 1 == 1).map(|(_, leap)| leap);
        let needed = (u64::BITS - digits.leading_zeros()) as usize;
        (leaps.take(needed), duration - steps * self.step)
    }

    /// The leap of any duration (in units of time of the plant).
    pub(super) fn leap(&self, duration: f64) -> Leap {
        let (leaps, rest) = self.parts(duration);
        leaps.fold(self.short_leap(rest), |so_far, leap| so_far.then(leap))
    }

    /// Mean time constant on a logarithmic scale.
    pub(super) fn unit(&self) -> f64 {
        self.unit
    }

    /// Multiplications of [`after`](Self::after), for a duration (in units of time of the plant) with any digits.
    pub(super) fn multiplications(&self, duration: f64) -> f64 {
        let steps = (duration / (self.unit * self.step)).max(1.0);
        let order = self.order as f64;
        steps.log2() * order * (order + 1.0) + 2.0 * TERMS as f64 * order
    }

    /// Output y of a state under an input.
    pub(super) fn output(&self, state: &State, input: f64) -> f64 {
        (0..self.order).map(|k| self.beta[k] * state[k]).sum::<f64>() + self.through * input
    }

    /// Direct feedthrough.
    pub(super) fn through(&self) -> f64 {
        self.through
    }

    /// The state after `duration` with the input held.
    pub(super) fn after(&self, state: &State, input: f64, duration: f64) -> State {
        let (leaps, rest) = self.parts(duration);
        let state = leaps.fold(*state, |state, leap| leap.after(&state, input));
        let change = self.series(&state, input, rest);
        std::array::from_fn(|i| state[i] + change[i])
    }

    /// The change over one Taylor series, `τ x' + τ²/2 x'' + …`.
    fn series(&self, state: &State, input: f64, step: f64) -> State {
        let n = self.order;
        let mut change = [0.0; MAX_ORDER];
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
                change[i] += term[i];
                small &= term[i].abs() <= NEGLIGIBLE * change[i].abs();
            }
            if small {
                break;
            }
        }
        change
    }
}

/// Without the zeros of the highest powers.
fn trimmed(coefficients: &[f64]) -> &[f64] {
    &coefficients[..degree(coefficients).map_or(0, |last| last + 1)]
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    fn response(numerator: &[f64], denominator: &[f64], input: f64, duration: f64) -> f64 {
        let element = TransferFunction::new(numerator.to_vec(), denominator.to_vec(), 0.0).unwrap();
        let motion = Motion::new(&element).unwrap();
        motion.output(&motion.after(&[0.0; MAX_ORDER], input, duration), input)
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

    /// Poles from 1e-7 to 393.6: the longest step of a series is 1e-9 of the last time. Expected values by residues with 80
    /// digits.
    #[test]
    fn quick_poles_beside_slow_ones_keep_their_digits_at_any_time() {
        let numerator = [8e-08, 2.755_200_081_387_930_5, 2.803_000_357_314_136, 0.717_504];
        let denominator = [
            1e-07,
            1.000_000_200_254_077_3,
            2.002_540_906_040_343_4,
            1.335_081_582_802_300_6,
            0.377_379_232_162_836_03,
            0.046_950_249_138_726_2,
            0.002_116_875_536_988_842,
            5.081_545_064_377_683e-6,
        ];
        for (t, expected) in [
            (1e-3, 5.427_869_579_365_961e-9),
            (0.01, 0.000_030_316_837_231_089_375),
            (0.5, 0.962_714_312_380_907),
            (3.0, 2.639_287_978_191_263),
            (60.0, 2.755_188_461_458_723_8),
            (6000.0, 2.754_027_424_374_769_3),
            (1e7, 1.519_277_954_241_066),
        ] {
            assert_relative_eq!(response(&numerator, &denominator, 1.0, t), expected, max_relative = 1e-13);
        }
    }

    #[test]
    fn a_biproper_element_jumps_with_its_input_and_an_improper_one_has_no_motion() {
        // (s + 1)/(s + 5) = 1 − 4/(s + 5).
        for t in [0.0_f64, 0.3, 5.0] {
            let expected = 3.0 * (0.2 + 0.8 * (-5.0 * t).exp());
            assert_relative_eq!(response(&[1.0, 1.0], &[5.0, 1.0], 3.0, t), expected, max_relative = 1e-13);
        }
        assert_eq!(response(&[3.0], &[2.0], 4.0, 1.0), 6.0);
        let element = TransferFunction::new(vec![1.0, 2.0, 1.0], vec![1.0, 3.0, 0.0], 0.0).unwrap();
        let refused = LinearError::OutOfRange { field: "relative_degree", value: -1.0 };
        assert_eq!(Motion::new(&element).err(), Some(refused));
    }
}
