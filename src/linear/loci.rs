//! Characteristic loci of a loop with two inputs and two outputs, how they close, and how far they stay from −1.
//!
//! A loop is given by its return ratio `L(jω) = G(jω) K(jω)` at real frequencies (rad per unit of time of the plant).

use std::f64::consts::{PI, TAU};

use nalgebra::Matrix2;

use super::{Complex, square_root};
use crate::scalar::{golden_section, root};

/// Values λ1, λ2 of both loci: the eigenvalues of the return ratio (Campestrini 2006, eqs. 68, 69 and 100).
pub fn locus_values(ratio: &Matrix2<Complex>) -> [Complex; 2] {
    let mean = (ratio[(0, 0)] + ratio[(1, 1)]) * 0.5;
    let half_difference = (ratio[(0, 0)] - ratio[(1, 1)]) * 0.5;
    let root = square_root(half_difference * half_difference + ratio[(0, 1)] * ratio[(1, 0)]);
    [mean + root, mean - root]
}

/// How the loci close over all frequencies, from −∞ to ∞ (Campestrini 2006, Figs. 11 to 13).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Closure {
    /// Each locus is a closed curve of its own.
    Separate,
    /// One continues into the other: the two close only together.
    Joint,
}

impl Closure {
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

/// How far a loop is from instability when all of it is scaled or turned. Meant for stable loops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margins {
    /// Shortest distance of a locus from −1.
    pub distance: f64,
    /// Frequency of that.
    pub distance_frequency: f64,
    /// Smallest factor above 1 on all gains at which a locus reaches −1; `None` where there is none.
    pub gain_up: Option<f64>,
    /// Largest factor below 1 at which one does.
    pub gain_down: Option<f64>,
    /// Smallest phase lag in all loops at which a locus reaches −1 (rad).
    pub phase: Option<f64>,
}

/// A point where a locus crosses a line.
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

    /// Margins, refined between the frequencies with the loop itself, which must be the one that was followed.
    pub fn margins(&self, ratio: impl Fn(f64) -> Matrix2<Complex>) -> Margins {
        let (distance, distance_frequency) = self.nearest_to_minus_one(&ratio);
        let mut margins = Margins { distance, distance_frequency, gain_up: None, gain_down: None, phase: None };
        for crossing in self.crossings(&ratio, |x| x.im).filter(|crossing| crossing.value.re < 0.0) {
            let factor = -1.0 / crossing.value.re;
            if factor > 1.0 {
                margins.gain_up = Some(margins.gain_up.map_or(factor, |best| best.min(factor)));
            } else {
                margins.gain_down = Some(margins.gain_down.map_or(factor, |best| best.max(factor)));
            }
        }
        for crossing in self.crossings(&ratio, |x| x.norm() - 1.0) {
            let lag = crossing.value.arg() + PI;
            let lag = if lag < TAU { lag } else { lag - TAU };
            margins.phase = Some(margins.phase.map_or(lag, |best| best.min(lag)));
        }
        margins
    }

    /// Where the loci cross the real axis, refined as [`margins`](Self::margins).
    pub fn real_crossings(&self, ratio: impl Fn(f64) -> Matrix2<Complex>) -> Vec<Crossing> {
        self.crossings(ratio, |x| x.im).collect()
    }

    /// Where `side` of a locus changes its sign.
    fn crossings(
        &self,
        ratio: impl Fn(f64) -> Matrix2<Complex>,
        side: impl Fn(Complex) -> f64,
    ) -> impl Iterator<Item = Crossing> {
        let cells = |branch: usize| (1..self.frequency.len()).map(move |k| (branch, k));
        cells(0).chain(cells(1)).filter_map(move |(branch, k)| {
            let values = [self.branches[branch][k - 1], self.branches[branch][k]];
            let changes = side(values[0]) * side(values[1]) < 0.0;
            let cell = [self.frequency[k - 1], self.frequency[k]];
            changes.then(|| {
                let (frequency, value) = crossing(&ratio, values, cell, &side);
                Crossing { branch, frequency, value }
            })
        })
    }

    fn nearest_to_minus_one(&self, ratio: impl Fn(f64) -> Matrix2<Complex>) -> (f64, f64) {
        let distance =
            |w: f64| locus_values(&ratio(w)).map(|x| (x + 1.0).norm()).into_iter().fold(f64::INFINITY, f64::min);
        let sampled: Vec<f64> = self.frequency.iter().map(|&w| distance(w)).collect();
        let best = (0..sampled.len()).min_by(|&i, &j| sampled[i].total_cmp(&sampled[j])).unwrap_or(0);
        let low = self.frequency[best.saturating_sub(1)];
        let high = self.frequency[(best + 1).min(self.frequency.len() - 1)];
        let w = golden_section(distance, low, high);
        let (found, at_sample) = (distance(w), sampled[best]);
        if found < at_sample { (found, w) } else { (at_sample, self.frequency[best]) }
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
fn nearest_order([a, b]: [Complex; 2], [first, second]: [Complex; 2]) -> [Complex; 2] {
    let straight = (a - first).norm() + (b - second).norm();
    let crossed = (b - first).norm() + (a - second).norm();
    if crossed < straight { [b, a] } else { [a, b] }
}

/// Frequency and value of a branch where `side` changes its sign in a cell, in which the branch is nearly straight.
fn crossing(
    ratio: impl Fn(f64) -> Matrix2<Complex>,
    [left, right]: [Complex; 2],
    [low, high]: [f64; 2],
    side: impl Fn(Complex) -> f64,
) -> (f64, Complex) {
    let value = |frequency: f64| {
        let [a, b] = locus_values(&ratio(frequency));
        let guess = left + (right - left) * ((frequency - low) / (high - low));
        if (a - guess).norm() <= (b - guess).norm() { a } else { b }
    };
    let frequency = root(|w| side(value(w)), (low, side(left)), (high, side(right)));
    (frequency, value(frequency))
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::linear::encirclements::examples::{cubic, diagonal};

    #[test]
    fn margins_of_a_triple_lag() {
        let ratio = cubic(2.0);
        let loci = Loci::along(&ratio, 0.01, 100.0, 300);
        let margins = loci.margins(&ratio);
        assert_relative_eq!(margins.gain_up.unwrap(), 4.0, max_relative = 1e-10);
        assert_eq!(margins.gain_down, None);
        // |2/(jω + 1)^3| = 1 at ω² = 2^(2/3) − 1; loop 2 never reaches 1.
        let w = (2.0_f64.powf(2.0 / 3.0) - 1.0).sqrt();
        assert_relative_eq!(margins.phase.unwrap(), PI - 3.0 * w.atan(), max_relative = 1e-10);
        let nearest = |w: f64| (Complex::new(1.0, w).inv().powu(3) * 2.0 + 1.0).norm();
        assert!(margins.distance <= nearest(margins.distance_frequency * 1.001));
        assert!(margins.distance <= nearest(margins.distance_frequency * 0.999));
    }

    #[test]
    fn branches_that_cross_are_followed() {
        // Two lags whose loci meet nowhere but whose sizes change order.
        let ratio = |w: f64| diagonal(Complex::new(1.0, w).inv() * 3.0, Complex::new(1.0, 0.1 * w).inv());
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
        assert_eq!(Closure::of(&Matrix2::new(0.5, -1.0, 1.0, 2.4)), Closure::Joint);
        assert_eq!(Closure::of(&Matrix2::new(4.0, -0.19, 8.0, 0.456)), Closure::Separate);
    }
}
