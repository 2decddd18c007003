//! Sensitivity of a sampled loop with two inputs and outputs: its singular values at a frequency, and its peak.

use nalgebra::Matrix2;

use super::{Complex, LoopPeak};
use crate::numeric::golden_section;

/// Singular values of the sensitivity `S = (I + L)⁻¹` and of the complementary sensitivity `T = L (I + L)⁻¹ = I − S` of a closed
/// loop at one frequency, each the largest and the smallest: between them lies the amplification of every direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensitivityGains {
    /// Of S: the gain from a disturbance at the outputs to the outputs.
    pub sensitivity: [f64; 2],
    /// Of T: the gain from references, and from the noise of the sensors, to the outputs.
    pub complementary: [f64; 2],
}

impl SensitivityGains {
    /// From the return ratio L at the frequency, cut open at the outputs. Infinite where the loop has a pole there.
    pub fn of(return_ratio: &Matrix2<Complex>) -> Self {
        let difference = Matrix2::identity() + return_ratio;
        let determinant = size_of_determinant(&difference);
        let [a, b, c, d] = elements(&difference);
        // The adjugate is det(I + L) S, so that no inverse is needed.
        let [largest_l, smallest_l] = both_singular_values(&(return_ratio * Matrix2::new(d, -b, -c, a)));
        Self {
            sensitivity: [largest_singular_value_of_inverse(&difference), largest_singular_value(&difference).recip()],
            complementary: [largest_l / determinant, smallest_l / determinant],
        }
    }
}

/// Frequencies of the grid, from below the slowest pole of the loop up to Nyquist.
const GRID: u32 = 80;

/// How far the grid reaches below the slowest pole.
const BELOW_SLOWEST: f64 = 0.1;

/// Peak Ms of the largest singular value of `S = (I + L)⁻¹` over all frequencies up to Nyquist, for a stable loop with the poles
/// `poles_s` (1/s), where a narrow peak may hide between two points of the grid, and its frequency (rad/s). `return_ratio` is L(z).
pub(super) fn sensitivity_peak(
    return_ratio: impl Fn(Complex) -> Matrix2<Complex>,
    poles_s: &[Complex],
    sampling_time_s: f64,
) -> LoopPeak {
    let sensitivity = |w: f64| {
        let z = Complex::cis(w * sampling_time_s);
        largest_singular_value_of_inverse(&(Matrix2::identity() + return_ratio(z)))
    };
    let nyquist = std::f64::consts::PI / sampling_time_s;
    let resonances = poles_s.iter().map(|s| s.norm().min(nyquist));
    let slowest = BELOW_SLOWEST * resonances.clone().fold(nyquist, f64::min);
    let ratio = (nyquist / slowest).powf(1.0 / f64::from(GRID));
    let grid = (0..=GRID).map(|k| nyquist * ratio.powf(-f64::from(k)));
    let sampled = grid.chain(resonances).map(|w| (sensitivity(w), w));
    let highest = sampled.fold((0.0, nyquist), |best, new| if new.0 > best.0 { new } else { best });
    refine(sensitivity, highest, ratio, nyquist)
}

/// Phase (rad) by which the longest delay turns from one frequency of the grid to the next, as long as the loop matters.
const TURN: f64 = 0.1;
/// Size of L from which on down a turn of its phase moves S by no more than that share.
const SMALL: f64 = 0.02;
/// Most frequencies of a grid.
const MAX_POINTS: u32 = 20_000;

/// The same for a stable loop whose inputs are delayed by up to `delay_s` (s); `slowest` is a rate (1/s) below which nothing happens.
pub(super) fn delayed_sensitivity_peak(
    return_ratio: impl Fn(Complex) -> Matrix2<Complex>,
    sampling_time_s: f64,
    slowest: f64,
    delay_s: f64,
) -> LoopPeak {
    let at = |w: f64| return_ratio(Complex::cis(w * sampling_time_s));
    let sensitivity = |w: f64| largest_singular_value_of_inverse(&(Matrix2::identity() + at(w)));
    let nyquist = std::f64::consts::PI / sampling_time_s;
    let mut w = BELOW_SLOWEST * slowest.min(delay_s.recip()).min(nyquist);
    let ratio = (nyquist / w).powf(1.0 / f64::from(GRID));
    let (mut best, mut spacing) = ((sensitivity(nyquist), nyquist), ratio);
    for _ in 0..MAX_POINTS {
        if w >= nyquist {
            break;
        }
        let matters = at(w).norm() > SMALL;
        let step = if matters { ratio.min(1.0 + TURN / (delay_s * w)) } else { ratio };
        let value = sensitivity(w);
        if value > best.0 {
            (best, spacing) = ((value, w), step);
        }
        w *= step;
    }
    refine(sensitivity, best, spacing, nyquist)
}

/// Golden-section search on a logarithmic axis, one point of the grid to either side of the best frequency.
fn refine(sensitivity: impl Fn(f64) -> f64, (value, best): (f64, f64), ratio: f64, nyquist: f64) -> LoopPeak {
    let (low, high) = ((best / ratio).ln(), (best * ratio).min(nyquist).ln());
    let frequency = golden_section(|x| -sensitivity(x.exp()), low, high).exp();
    let refined = sensitivity(frequency);
    if refined > value { LoopPeak { value: refined, frequency } } else { LoopPeak { value, frequency: best } }
}

/// `1/σ_min` of a 2 × 2 matrix, from `σ₁ σ₂ = |det M|`.
pub(super) fn largest_singular_value_of_inverse(m: &Matrix2<Complex>) -> f64 {
    largest_singular_value(m) / size_of_determinant(m)
}

/// Largest singular value of a 2 × 2 matrix, from `σ₁² + σ₂² = ‖M‖²` and `σ₁ σ₂ = |det M|`.
pub(super) fn largest_singular_value(m: &Matrix2<Complex>) -> f64 {
    let sum = m.iter().map(Complex::norm_sqr).sum::<f64>();
    let product = size_of_determinant(m);
    let difference = ((sum - 2.0 * product) * (sum + 2.0 * product)).max(0.0).sqrt();
    f64::midpoint(sum, difference).sqrt()
}

/// Both singular values, the largest first.
fn both_singular_values(m: &Matrix2<Complex>) -> [f64; 2] {
    let largest = largest_singular_value(m);
    let smallest = if largest > 0.0 { size_of_determinant(m) / largest } else { 0.0 };
    [largest, smallest]
}

/// Elements by rows.
pub(super) fn elements<T: Copy>(matrix: &Matrix2<T>) -> [T; 4] {
    let [[a, c], [b, d]] = matrix.data.0;
    [a, b, c, d]
}

fn size_of_determinant(m: &Matrix2<Complex>) -> f64 {
    (m[(0, 0)] * m[(1, 1)] - m[(0, 1)] * m[(1, 0)]).norm()
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use nalgebra::DMatrix;

    use super::*;
    use crate::linear::singular_values;

    #[test]
    fn the_largest_singular_values_of_a_matrix_and_of_its_inverse() {
        let c = Complex::new;
        for m in [
            Matrix2::new(c(1.0, 0.5), c(-0.3, 0.2), c(0.1, 2.0), c(0.7, -0.4)),
            Matrix2::new(c(2.0, 0.0), c(0.0, 0.0), c(0.0, 0.0), c(0.0, 2.0)),
            Matrix2::new(c(1.0, 0.0), c(1.0, 1.0), c(1.0, -1.0), c(2.01, 0.0)),
        ] {
            let values = singular_values(&DMatrix::from_iterator(2, 2, m.iter().copied())).unwrap();
            assert_relative_eq!(largest_singular_value_of_inverse(&m), 1.0 / values[1], max_relative = 1e-12);
            assert_relative_eq!(largest_singular_value(&m), values[0], max_relative = 1e-12);
        }
    }

    #[test]
    fn the_gains_of_a_loop_are_those_of_its_matrices() {
        let c = Complex::new;
        for ratio in [
            Matrix2::new(c(1.0, 0.5), c(-0.3, 0.2), c(0.1, 2.0), c(0.7, -0.4)),
            // One loop does not act.
            Matrix2::new(c(3.0, -20.0), Complex::ZERO, c(1.0, -1.0), Complex::ZERO),
        ] {
            let gains = SensitivityGains::of(&ratio);
            let s = (Matrix2::identity() + ratio).try_inverse().unwrap();
            for (matrix, found) in [(s, gains.sensitivity), (Matrix2::identity() - s, gains.complementary)] {
                let values = singular_values(&DMatrix::from_iterator(2, 2, matrix.iter().copied())).unwrap();
                assert_relative_eq!(found[0], values[0], max_relative = 1e-12);
                assert_relative_eq!(found[1], values[1], max_relative = 1e-10, epsilon = 1e-14);
            }
        }
    }
}
