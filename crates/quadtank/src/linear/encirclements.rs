//! Stability of a loop with two inputs and outputs by the generalised Nyquist criterion, dead times included.

use std::f64::consts::PI;

use nalgebra::Matrix2;

use super::Complex;
use super::return_ratio::ReturnRatio;
use super::sensitivity::elements;
use super::taylor_model::{Cell, dominant_dead_time};

/// Stability of a loop of stable parts, by the number of encirclements of −1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LoopStability {
    /// No pole in the right half-plane.
    Stable,
    /// That many poles in the right half-plane.
    Unstable {
        /// Number of them.
        poles: u32,
    },
    /// A locus passes through −1, to rounding: an oscillation that stays.
    Marginal {
        /// Its frequency (rad per unit of time of the plant); 0 for a pole at the origin.
        frequency: f64,
    },
    /// The encirclements are too many to count within the bound on work.
    NotComputed {
        /// Frequency up to which the loop has to be followed (rad per unit of time of the plant); infinite where it
        /// never becomes small.
        frequency: f64,
    },
    /// The loop closes through the direct feedthrough of a biproper element, and an eigenvalue of L(∞) is −1 or beyond: the equation
    /// for its signals has no solution, or one that any lag, however short, turns into a motion away from it.
    AlgebraicLoop {
        /// Real part of that eigenvalue.
        eigenvalue: f64,
    },
}

/// Most cells of frequency that the count looks at. Of 1,000 random loops half take 210, and one 940.
const MAX_CELLS: u32 = 5_000;
/// Width of a cell, relative to its frequency, at which a determinant whose enclosure contains zero counts as zero.
const NARROWEST: f64 = 1e-15;
/// Relative deviation of the elements from powers of s at the lowest frequency.
const SETTLED: f64 = 1e-12;
/// Largest angle to the real axis (tangent) of the residue at the origin.
const RESIDUE_SLANT: f64 = 0.05;

impl LoopStability {
    /// The verdict on a loop whose parts are stable, but for integrators.
    ///
    /// Loci that together encircle −1 are the same as det(I + L) = (1 + λ1)(1 + λ2) that encircles 0. Followed from 0 to ∞
    /// its argument grows by Δ, and passing the pole of order n at the origin on its right side costs n π, so
    /// `Z = n/2 − Δ/π` poles of the closed loop are in the right half-plane (Campestrini 2006, Theorem 1, with P = 0). With direct
    /// feedthrough it ends at det(I + L(∞)), which is positive where the loop is well-posed.
    ///
    /// Cells of frequency are halved until each has an enclosure of det(I + L) that excludes zero, which makes the count
    /// exact; the number of cells is bounded.
    pub fn of(ratio: &ReturnRatio) -> Self {
        Self::counted(ratio).0
    }

    /// The verdict and the number of cells that it took.
    fn counted(ratio: &ReturnRatio) -> (Self, u32) {
        let eigenvalue = least_real_part(ratio.at_infinity());
        if eigenvalue <= -1.0 {
            return (Self::AlgebraicLoop { eigenvalue }, 0);
        }
        if ratio.hides_an_integrator() {
            return (Self::Marginal { frequency: 0.0 }, 0);
        }
        // det(I + L) = det(I + L(∞)) det(I + E) with E = (I + L(∞))⁻¹ (L − L(∞)).
        let inverse = (Matrix2::identity() + ratio.at_infinity()).try_inverse().unwrap_or_default().map(f64::abs);
        let low = ratio.low_end(SETTLED);
        let Some(high) = ratio.high_end(low, |largest| is_small(&(inverse * largest))) else {
            return (Self::NotComputed { frequency: f64::INFINITY }, 0);
        };
        // Below all else det(I + L) is R/(jω)^n with a real R.
        let integrators = ratio.integrators();
        let residue = return_difference(ratio, low) * Complex::new(0.0, low).powu(integrators);
        let is_real = residue.im.abs() <= RESIDUE_SLANT * residue.re.abs();
        if !is_real {
            return (Self::Marginal { frequency: 0.0 }, 0);
        }
        let mut turned = if residue.re > 0.0 { residue.arg() } else { (-residue).arg() };
        let mut cells = vec![Cell { low, high }];
        let at_end = return_difference(ratio, high);
        // The highest cell comes first: each ends with the value that the one before has begun with.
        let mut at_high = at_end;
        let mut count = 0;
        while let Some(cell) = cells.pop() {
            count += 1;
            if count > MAX_CELLS {
                return (Self::NotComputed { frequency: high }, count);
            }
            match turn_over(ratio, cell, at_high) {
                Some((angle, at_low)) => {
                    turned += angle;
                    at_high = at_low;
                }
                None if cell.half_width() <= NARROWEST * cell.low => {
                    return (Self::Marginal { frequency: cell.middle() }, count);
                }
                None => cells.extend(cell.halves()),
            }
        }
        // From the high end on det(I + L) stays within |det(I + L(∞))| of it.
        turned -= at_end.arg();
        let poles = (f64::from(integrators) / 2.0 - turned / PI).round();
        (if poles <= 0.0 { Self::Stable } else { Self::Unstable { poles: whole(poles) } }, count)
    }
}

/// Least real part of the eigenvalues of a real matrix.
pub(crate) fn least_real_part(matrix: &Matrix2<f64>) -> f64 {
    let half_difference = 0.5 * (matrix[(0, 0)] - matrix[(1, 1)]);
    let square = half_difference * half_difference + matrix[(0, 1)] * matrix[(1, 0)];
    0.5 * matrix.trace() - square.max(0.0).sqrt()
}

/// Whether no loop with such absolute values of the elements of L has a det(I + L) that is 1 or more away from 1.
fn is_small(largest: &Matrix2<f64>) -> bool {
    let [a, b, c, d] = elements(largest);
    a + d + a * d + b * c < 1.0
}

/// det(I + L).
fn return_difference(ratio: &ReturnRatio, frequency: f64) -> Complex {
    (Matrix2::identity() + ratio.at(frequency)).determinant()
}

/// Change of the argument of det(I + L) over a cell (rad) up to its value at the high end, and its value at the low
/// end; `None` where the enclosure contains zero.
///
/// Computed in a frame that rotates with the dead time of the largest term: where that term exceeds the sum of all
/// others, the rotations by dead times need not be followed one by one.
fn turn_over(ratio: &ReturnRatio, cell: Cell, at_high: Complex) -> Option<(f64, Complex)> {
    let frame = dominant_dead_time(ratio.return_difference(cell), cell)?;
    let at_low = return_difference(ratio, cell.low);
    let [before, after] = [(at_low, cell.low), (at_high, cell.high)].map(|(value, w)| value * Complex::cis(frame * w));
    Some(((after / before).arg() - frame * (cell.high - cell.low), at_low))
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a positive number of poles")]
fn whole(poles: f64) -> u32 {
    poles as u32
}

/// Loops that the tests of margins and of encirclements share.
#[cfg(test)]
pub(super) mod examples {
    use crate::linear::{ReturnRatio, TransferFunction, TransferMatrix};

    pub fn diagonal(a: TransferFunction, b: TransferFunction) -> TransferMatrix {
        let none = TransferFunction::lags(0.0, &[], 0.0).unwrap();
        TransferMatrix([[a, none.clone()], [none, b]])
    }

    /// `k/(s + 1)^3` in loop 1 and a harmless loop 2; unstable beyond k = 8.
    pub fn cubic(k: f64) -> TransferMatrix {
        let lags = |gain: f64, count: usize| TransferFunction::lags(gain, &[1.0; 3][..count], 0.0).unwrap();
        diagonal(lags(k, 3), lags(0.5, 1))
    }

    /// With controllers that do nothing.
    pub fn ratio(plant: &TransferMatrix, integrators: u32) -> ReturnRatio<'_> {
        let one = TransferFunction::lags(1.0, &[], 0.0).unwrap();
        ReturnRatio::new(plant, diagonal(one.clone(), one), integrators)
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::examples::{cubic, diagonal, ratio};
    use super::*;
    use crate::linear::{TransferFunction, TransferMatrix};

    fn stability(plant: &TransferMatrix, integrators: u32) -> LoopStability {
        LoopStability::of(&ratio(plant, integrators))
    }

    #[test]
    fn a_triple_lag_is_stable_up_to_eight() {
        assert_eq!(stability(&cubic(7.9), 0), LoopStability::Stable);
        assert_eq!(stability(&cubic(8.1), 0), LoopStability::Unstable { poles: 2 });
        let LoopStability::Marginal { frequency } = stability(&cubic(8.0), 0) else {
            panic!("a locus on −1 is marginal")
        };
        assert_relative_eq!(frequency, 3.0_f64.sqrt(), max_relative = 1e-9);
        // Negative gain: the real pole at k < −1.
        assert_eq!(stability(&cubic(-1.1), 0), LoopStability::Unstable { poles: 1 });
        assert_eq!(stability(&cubic(-1.0), 0), LoopStability::Marginal { frequency: 0.0 });
    }

    #[test]
    fn a_narrow_resonance_is_not_passed_over() {
        // 0.02 e^(−s)/(s² + 0.002 s + 1): the locus reaches far beyond −1 within a thousandth of its frequency.
        let resonance = TransferFunction::new(vec![0.02], vec![1.0, 2e-3, 1.0], 1.0).unwrap();
        let plant = diagonal(resonance, TransferFunction::lags(0.02, &[1.0], 1.0).unwrap());
        assert_eq!(stability(&plant, 0), LoopStability::Unstable { poles: 2 });
    }

    /// `k e^(−θ s)/s` in both loops.
    fn delayed(k: f64, dead_time: f64) -> TransferMatrix {
        let g = TransferFunction::new(vec![k], vec![0.0, 1.0], dead_time).unwrap();
        diagonal(g.clone(), g)
    }

    #[test]
    fn integrators_and_dead_time_are_counted() {
        // k e^(−s)/s is stable up to π/2; in both loops it counts twice.
        assert_eq!(stability(&delayed(1.5, 1.0), 2), LoopStability::Stable);
        assert_eq!(stability(&delayed(1.65, 1.0), 2), LoopStability::Unstable { poles: 4 });
        // Far beyond: pairs of poles cross at (4 n + 1) π/2.
        assert_eq!(stability(&delayed(8.0, 1.0), 2), LoopStability::Unstable { poles: 8 });
        // The wrong sign: one real pole in each loop.
        assert_eq!(stability(&delayed(-0.1, 1.0), 2), LoopStability::Unstable { poles: 2 });
    }

    /// Poles in the right half-plane of a loop `k e^(−s)/s`: a pair crosses at each k = (4 n + 1) π/2.
    fn poles_of_delayed(k: f64) -> u32 {
        2 * whole((k / (2.0 * PI) - 0.25).floor() + 1.0)
    }

    #[test]
    fn one_loop_of_any_gain_is_counted_within_the_bound_on_work() {
        // Far beyond its limit the turns of the dead time need not be followed one by one. From 10⁸ on a pole may be on the
        // axis to rounding.
        for exponent in 1..=7 {
            let gain = 10.0_f64.powi(exponent);
            let one = TransferFunction::new(vec![gain], vec![0.0, 1.0], 1.0).unwrap();
            let plant = diagonal(one, TransferFunction::lags(0.5, &[1.0], 0.0).unwrap());
            let (verdict, cells) = LoopStability::counted(&ratio(&plant, 1));
            assert_eq!(verdict, LoopStability::Unstable { poles: poles_of_delayed(gain) }, "{gain}");
            assert!(cells < 2_000, "{gain}: {cells} cells");
        }
    }

    #[test]
    fn two_loops_alike_are_counted_or_refused_within_the_bound_on_work() {
        // No term of det(I + L) exceeds the others over an octave around the gain, where every turn has to be followed.
        for exponent in 1..=12 {
            let gain = 10.0_f64.powi(exponent);
            let (verdict, cells) = LoopStability::counted(&ratio(&delayed(gain, 1.0), 2));
            if exponent <= 2 {
                assert_eq!(verdict, LoopStability::Unstable { poles: 2 * poles_of_delayed(gain) }, "{gain}");
            }
            if exponent >= 4 {
                assert!(matches!(verdict, LoopStability::NotComputed { .. }), "{gain}: {verdict:?}");
            }
            assert!(cells <= MAX_CELLS + 1, "{gain}: {cells} cells");
        }
        // A loop that never becomes small.
        let endless = TransferFunction::lags(2.0, &[], 1.0).unwrap();
        let verdict = stability(&diagonal(endless.clone(), endless), 0);
        assert_eq!(verdict, LoopStability::NotComputed { frequency: f64::INFINITY });
    }
}
