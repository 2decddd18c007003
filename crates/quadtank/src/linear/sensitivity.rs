//! Peak of the sensitivity of a sampled loop with two inputs and outputs.

use nalgebra::Matrix2;

use super::Complex;

/// Frequencies of the grid, from below the slowest pole of the loop up to Nyquist.
const GRID: u32 = 80;

/// How far the grid reaches below the slowest pole.
const BELOW_SLOWEST: f64 = 0.1;

/// Cuts of the interval around the highest point of the grid by the golden section; each leaves 62 % of it.
const REFINEMENTS: u32 = 16;

/// Peak Ms of the largest singular value of `S = (I + L)⁻¹` over all frequencies up to Nyquist, for a stable loop with the poles
/// `poles_s` (1/s), where a narrow peak may hide between two points of the grid. `return_ratio` is L(z).
pub(super) fn sensitivity_peak(
    return_ratio: impl Fn(Complex) -> Matrix2<Complex>,
    poles_s: &[Complex],
    sampling_time_s: f64,
) -> f64 {
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

/// Golden-section search on a logarithmic axis, one point of the grid to either side of the best frequency.
fn refine(sensitivity: impl Fn(f64) -> f64, (mut peak, best): (f64, f64), ratio: f64, nyquist: f64) -> f64 {
    let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
    let (mut low, mut high) = ((best / ratio).ln(), (best * ratio).min(nyquist).ln());
    for _ in 0..REFINEMENTS {
        let (left, right) = (high - golden * (high - low), low + golden * (high - low));
        let (at_left, at_right) = (sensitivity(left.exp()), sensitivity(right.exp()));
        peak = peak.max(at_left.max(at_right));
        if at_left > at_right { high = right } else { low = left }
    }
    peak
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
}
