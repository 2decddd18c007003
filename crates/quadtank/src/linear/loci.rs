//! Characteristic loci of a loop with two inputs and two outputs, and how they close.
//!
//! A loop is given by its return ratio `L(jω) = G(jω) K(jω)` at real frequencies (rad per unit of time of the plant).

use nalgebra::Matrix2;
use serde::Serialize;

use super::Complex;
use crate::numeric::{root, square_root};

/// Values λ1, λ2 of both loci: the eigenvalues of the return ratio (Campestrini 2006, eqs. 68, 69 and 100).
pub fn locus_values(ratio: &Matrix2<Complex>) -> [Complex; 2] {
    let mean = (ratio[(0, 0)] + ratio[(1, 1)]) * 0.5;
    let half_difference = (ratio[(0, 0)] - ratio[(1, 1)]) * 0.5;
    let root = square_root(half_difference * half_difference + ratio[(0, 1)] * ratio[(1, 0)]);
    // The smaller one is a difference of nearly equal numbers where the sizes are far apart; it follows from the determinant.
    let determinant = ratio[(0, 0)] * ratio[(1, 1)] - ratio[(0, 1)] * ratio[(1, 0)];
    let [one, other] = [mean + root, mean - root];
    if one.norm_sqr() >= other.norm_sqr() {
        [one, if one == Complex::ZERO { one } else { determinant / one }]
    } else {
        [determinant / other, other]
    }
}

/// How the loci close over all frequencies, from −∞ to ∞ (Campestrini 2006, Figs. 11 to 13).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum LociClosure {
    /// Each locus is a closed curve of its own.
    Separate,
    /// One continues into the other: the two close only together.
    Joint,
}

impl LociClosure {
    /// From what the return ratio is at ω = 0, or, with integral action, what it is times s there: a real matrix with real
    /// eigenvalues closes each locus, a pair of complex ones joins them.
    pub fn of(at_zero: &Matrix2<f64>) -> Self {
        let half_difference = (at_zero[(0, 0)] - at_zero[(1, 1)]) * 0.5;
        if half_difference * half_difference + at_zero[(0, 1)] * at_zero[(1, 0)] < 0.0 {
            Self::Joint
        } else {
            Self::Separate
        }
    }
}

/// Both loci over a range of frequencies, each followed without a jump.
#[derive(Clone, Debug, PartialEq)]
pub struct Loci {
    /// Frequencies, rising.
    pub frequency: Vec<f64>,
    /// Values of each locus at these.
    pub branches: [Vec<Complex>; 2],
}

/// A point where a locus crosses the real axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Index of the branch.
    pub branch: usize,
    /// Frequency.
    pub frequency: f64,
    /// Value of the locus.
    pub value: Complex,
}

impl Loci {
    /// Follows the loci of a loop over `points` frequencies with equal ratios.
    pub fn along(ratio: impl Fn(f64) -> Matrix2<Complex>, low: f64, high: f64, points: usize) -> Self {
        let cells = points.max(2) - 1;
        let growth = (high / low).ln() / cells as f64;
        let frequency: Vec<f64> = (0..=cells).map(|k| low * (growth * k as f64).exp()).collect();
        let mut branches = [Vec::with_capacity(frequency.len()), Vec::with_capacity(frequency.len())];
        for &w in &frequency {
            let values = locus_values(&ratio(w));
            let [a, b] = match (expected(&branches[0]), expected(&branches[1])) {
                (Some(a), Some(b)) => nearest_order(values, [a, b]),
                _ => values,
            };
            branches[0].push(a);
            branches[1].push(b);
        }
        Self { frequency, branches }
    }

    /// Where the loci cross the real axis, refined between the frequencies with the loop itself, which must be the one that was
    /// followed.
    pub fn real_crossings(&self, ratio: impl Fn(f64) -> Matrix2<Complex>) -> Vec<Crossing> {
        let cells = |branch: usize| (1..self.frequency.len()).map(move |k| (branch, k));
        let crossing = |(branch, k): (usize, usize)| {
            let values = [self.branches[branch][k - 1], self.branches[branch][k]];
            let cell = [self.frequency[k - 1], self.frequency[k]];
            (values[0].im * values[1].im < 0.0).then(|| {
                let (frequency, value) = crossing(&ratio, values, cell);
                Crossing { branch, frequency, value }
            })
        };
        cells(0).chain(cells(1)).filter_map(crossing).collect()
    }
}

/// Where a branch goes next if it goes on as it did.
fn expected(branch: &[Complex]) -> Option<Complex> {
    match branch {
        [.., before, last] => Some(last * 2.0 - before),
        [last] => Some(*last),
        [] => None,
    }
}

/// Two values in the order in which they are nearer to two others.
pub(super) fn nearest_order([a, b]: [Complex; 2], [first, second]: [Complex; 2]) -> [Complex; 2] {
    let straight = (a - first).norm() + (b - second).norm();
    let crossed = (b - first).norm() + (a - second).norm();
    if crossed < straight { [b, a] } else { [a, b] }
}

/// Frequency and value of a branch where it crosses the real axis in a cell, in which it is nearly straight.
fn crossing(
    ratio: impl Fn(f64) -> Matrix2<Complex>,
    [left, right]: [Complex; 2],
    [low, high]: [f64; 2],
) -> (f64, Complex) {
    let value = |frequency: f64| {
        let [a, b] = locus_values(&ratio(frequency));
        let guess = left + (right - left) * ((frequency - low) / (high - low));
        if (a - guess).norm() <= (b - guess).norm() { a } else { b }
    };
    let frequency = root(|w| value(w).im, (low, left.im), (high, right.im));
    (frequency, value(frequency))
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::*;

    #[test]
    fn the_smaller_value_keeps_its_digits() {
        let large = Complex::new(-1.5e11, 3e4);
        for small in [Complex::ZERO, Complex::new(2e-7, -1e-7)] {
            for diagonal in [[large, small], [small, large]] {
                let mut found = locus_values(&Matrix2::from_diagonal(&Vector2::from(diagonal)));
                found.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
                assert!((found[0] - small).norm() <= 1e-15 * small.norm() && (found[1] - large).norm() < 1e-4);
            }
        }
    }

    #[test]
    fn branches_that_cross_are_followed() {
        // Two lags whose loci meet nowhere but whose sizes change order.
        let ratio = |w: f64| {
            Matrix2::from_diagonal(&Vector2::new(Complex::new(1.0, w).inv() * 3.0, Complex::new(1.0, 0.1 * w).inv()))
        };
        let loci = Loci::along(ratio, 0.01, 1e3, 200);
        let first = loci.branches[0].first().unwrap().norm();
        let (large, small) = if first > 2.0 { (0, 1) } else { (1, 0) };
        for (k, &w) in loci.frequency.iter().enumerate() {
            assert!((loci.branches[large][k] - ratio(w)[(0, 0)]).norm() < 1e-12);
            assert!((loci.branches[small][k] - ratio(w)[(1, 1)]).norm() < 1e-12);
        }
    }

    #[test]
    fn complex_eigenvalues_at_zero_join_the_loci() {
        assert_eq!(LociClosure::of(&Matrix2::new(0.5, -1.0, 1.0, 2.4)), LociClosure::Joint);
        assert_eq!(LociClosure::of(&Matrix2::new(4.0, -0.19, 8.0, 0.456)), LociClosure::Separate);
    }
}
