use std::f64::consts::{LN_10, TAU};

use nalgebra::Matrix2;

use super::experiment::poles_off_the_origin;
use crate::linear::{
    Complex, LinearError, Series, TransferFunction, TransferMatrix, determinant_of_series, elements_as_series,
};
use crate::numeric::{golden_section, modulus, root, square_root};

/// Cells of the frequency grid for each decade, and most cells of all: a wide range has fewer for each decade.
const PER_DECADE: f64 = 400.0;
const MAX_CELLS: f64 = 4000.0;
/// Cells beside a resonance, relative to its half width and, further away, to the distance from it.
const SHARE_OF_WIDTH: f64 = 0.25;
/// Effort of a dip, where that of a cell which is solved is 1.
const EFFORT_OF_DIP: u32 = 4;

/// Gains of two proportional loops at which the closed loop oscillates, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CriticalPoint {
    /// Gains kc1, kc2 of the loops.
    pub gains: [f64; 2],
    /// By how much the direction was multiplied to get there.
    pub factor: f64,
    /// Frequency of the oscillation (rad per unit of time).
    pub frequency: f64,
}

impl CriticalPoint {
    /// Period Tc of the oscillation (unit of time of the plant).
    pub fn period(&self) -> f64 {
        TAU / self.frequency
    }
}

/// What bounds the stable gains in a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GainLimit {
    /// A pair of poles on the imaginary axis: an ultimate point.
    Oscillation(CriticalPoint),
    /// A real pole at the origin: beyond it the loop drifts away without an oscillation, and there is no ultimate period.
    RealPole {
        /// Gains k1, k2 there.
        gains: [f64; 2],
        /// By how much the direction was multiplied to get there.
        factor: f64,
    },
    /// A loop through the direct feedthrough of the plant: with these gains an eigenvalue of L(∞) is −1, see
    /// [`LoopStability::AlgebraicLoop`](crate::linear::LoopStability::AlgebraicLoop).
    AlgebraicLoop {
        /// Gains k1, k2 there.
        gains: [f64; 2],
        /// By how much the direction was multiplied to get there.
        factor: f64,
    },
    /// Nothing: every gain is stable.
    None,
}

/// Frequencies (rad per unit of time) between which the ultimate points of a plant lie: two decades beyond its slowest and
/// its quickest part, dead times included.
///
/// # Errors
/// As [`TransferFunction::poles`].
pub fn frequency_range(plant: &TransferMatrix) -> Result<(f64, f64), LinearError> {
    // A plant of gains and integrators alone has no time of its own.
    let (slowest, quickest) = rate_range(plant.0.as_flattened())?.unwrap_or((1.0, 1.0));
    Ok((slowest * 0.01, quickest * 100.0))
}

/// Slowest and quickest rate (per unit of time) of elements: magnitudes of poles off the origin and reciprocals of dead
/// times. `None` for gains and integrators alone.
///
/// # Errors
/// As [`TransferFunction::poles`].
pub(super) fn rate_range<'a>(
    elements: impl IntoIterator<Item = &'a TransferFunction>,
) -> Result<Option<(f64, f64)>, LinearError> {
    let (mut slowest, mut quickest) = (f64::INFINITY, 0.0_f64);
    for element in elements {
        let rates = poles_off_the_origin(element)?.into_iter().map(Complex::norm);
        let delay = (element.dead_time() > 0.0).then(|| element.dead_time().recip());
        for rate in rates.chain(delay).filter(|&rate| rate > 0.0) {
            slowest = slowest.min(rate);
            quickest = quickest.max(rate);
        }
    }
    Ok((quickest > 0.0).then_some((slowest, quickest)))
}

/// Direction `(k1, k2)` in which loop 2 has the importance r2 relative to loop 1,
/// `r2 = kc2 g22(0)/(kc1 g11(0))` (Campestrini 2006, eq. 94).
pub fn importance_direction(dc_gain: &Matrix2<f64>, importance: f64) -> [f64; 2] {
    [1.0 / dc_gain[(0, 0)], importance / dc_gain[(1, 1)]]
}

/// Importance r2 of loop 2 in a pair of gains (Campestrini 2006, eq. 94), the reverse of [`importance_direction`].
pub fn importance(dc_gain: &Matrix2<f64>, gains: [f64; 2]) -> f64 {
    gains[1] * dc_gain[(1, 1)] / (gains[0] * dc_gain[(0, 0)])
}

/// The search for critical points of a plant with two loops, over a range of frequencies.
///
/// With `K = a diag(c1, c2)` a characteristic locus of GK passes through −1 where
/// `1 + a T + a² D = 0`, T = tr(G diag c), D = det(G diag c) (Campestrini 2006, §4.2). For a real the imaginary part gives
/// `a = −Im T/Im D`, and with it the real part
/// `(Im D)² − Re T Im T Im D + Re D (Im T)² = 0`: one real equation in ω, whose changes of sign are followed on a grid
/// on which the plant is evaluated once for all directions.
#[derive(Clone, Debug)]
pub struct CriticalSearch {
    plant: TransferMatrix,
    at_rest: AtRest,
    /// What the plant does at once when an input jumps.
    instant: Matrix2<f64>,
    grid: Vec<Sample>,
}

/// The plant near s = 0: g11, g22 and det G.
#[derive(Clone, Debug)]
struct AtRest {
    diagonal: [Series; 2],
    determinant: Series,
}

impl AtRest {
    fn of(plant: &TransferMatrix) -> Self {
        let g = elements_as_series(plant);
        Self { diagonal: [g[(0, 0)], g[(1, 1)]], determinant: determinant_of_series(&g) }
    }

    /// Coefficients of `1 + a T + a² D` at the lowest power of s that occurs in it: that of s⁰ for a plant without integrators.
    fn coefficients(&self, [c1, c2]: [f64; 2]) -> [f64; 3] {
        let trace = self.diagonal[0] * c1 + self.diagonal[1] * c2;
        let determinant = self.determinant * (c1 * c2);
        let lowest = |series: &Series| series.leading().map_or(0, |(_, power)| power);
        let power = lowest(&trace).min(lowest(&determinant)).min(0);
        [if power == 0 { 1.0 } else { 0.0 }, trace.coefficient(power), determinant.coefficient(power)]
    }
}

/// The smallest positive a with `u + a t + a² d = 0`, for u ≥ 0.
fn smallest_factor([u, t, d]: [f64; 3]) -> Option<f64> {
    // In x = 1/a: u x² + t x + d = 0, whose largest root is the nearest factor.
    if u == 0.0 {
        let x = -d / t;
        return (x > 0.0 && x.is_finite()).then(|| x.recip());
    }
    let discriminant = t * t - 4.0 * d;
    let largest = f64::midpoint(-t, discriminant.sqrt());
    (discriminant >= 0.0 && largest > 0.0).then(|| largest.recip())
}

/// Largest angle to the real axis (rad) at which a locus counts as on it.
const SLANT: f64 = 1e-6;

/// Resonances of a smaller damping ratio are searched as if they had this one.
const MIN_DAMPING: f64 = 1e-9;

/// What the search needs of G(jω).
#[derive(Clone, Copy, Debug)]
struct Sample {
    frequency: f64,
    g11: Complex,
    g22: Complex,
    determinant: Complex,
}

impl Sample {
    fn of(plant: &TransferMatrix, frequency: f64) -> Self {
        let g = plant.at(Complex::new(0.0, frequency));
        let determinant = g[(0, 0)] * g[(1, 1)] - g[(0, 1)] * g[(1, 0)];
        Self { frequency, g11: g[(0, 0)], g22: g[(1, 1)], determinant }
    }

    fn trace_and_determinant(&self, [c1, c2]: [f64; 2]) -> (Complex, Complex) {
        (self.g11 * c1 + self.g22 * c2, self.determinant * (c1 * c2))
    }

    /// The real equation; with one loop open that of a single loop, Im T = 0.
    fn equation(&self, direction: [f64; 2]) -> f64 {
        let (t, d) = self.trace_and_determinant(direction);
        if direction.contains(&0.0) {
            return t.im / modulus(t);
        }
        // Relative to its terms: the gain of the plant falls over many decades.
        let size = d.norm_sqr() + t.norm_sqr() * modulus(d);
        (d.im * d.im - t.re * t.im * d.im + d.re * t.im * t.im) / size
    }

    /// No factor at a solution near here is much smaller: `1 + a T + a² D = 0` needs `a |T| + a² |D| ≥ 1`. With a tenth of slack
    /// for the cell.
    fn least_factor(&self, direction: [f64; 2]) -> f64 {
        let (t, d) = self.trace_and_determinant(direction);
        let (t, d) = (modulus(t), modulus(d));
        // The positive root, without cancellation.
        0.9 * 2.0 / (t + (t * t + 4.0 * d).sqrt())
    }

    /// The factor a at a solution: −1/λ for the locus λ of G diag c that is on the negative real axis. `−Im T/Im D` would lose
    /// its digits where D is nearly real. Negative where that locus is positive.
    fn factor(&self, direction: [f64; 2]) -> f64 {
        let (real, slant) = self.straightest_locus(direction);
        // T and D may also be real at once with complex loci: then the equation vanishes without a crossing.
        if slant > SLANT { f64::NAN } else { -real.norm().recip().copysign(real.re) }
    }

    /// The locus of G diag c that is nearer to the real axis, and the sine of its angle to that.
    fn straightest_locus(&self, direction: [f64; 2]) -> (Complex, f64) {
        let (t, d) = self.trace_and_determinant(direction);
        let root = square_root(t * t - d * 4.0);
        let [one, two] = [t + root, t - root].map(|double| double * 0.5);
        // With one loop open one locus is zero.
        let slant = |locus: Complex| {
            let size = modulus(locus);
            if size <= f64::EPSILON * modulus(t) { f64::INFINITY } else { (locus.im / size).abs() }
        };
        if slant(one) <= slant(two) { (one, slant(one)) } else { (two, slant(two)) }
    }

    /// Whether a locus is within 30° of the negative real axis.
    fn is_left(&self, direction: [f64; 2]) -> bool {
        let (locus, slant) = self.straightest_locus(direction);
        locus.re < 0.0 && slant <= 0.5
    }
}

/// Whether the second of three values of the same sign is the nearest to zero. Two loops alike, with a dead time, have pairs of
/// crossings closer than any grid: there may be one between.
fn is_dip(before: f64, at: f64, after: f64) -> bool {
    before.signum() == at.signum() && at.signum() == after.signum() && at.abs() < before.abs() && at.abs() < after.abs()
}

/// Where a critical point may be.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    /// Index of the grid point at the upper end of the cell, or of the dip.
    cell: usize,
    /// The sign of the equation at a dip.
    dip: Option<f64>,
    /// Whether a locus is on the left at one end of the cell.
    is_left: bool,
    /// See [`Sample::least_factor`].
    least_factor: f64,
}

/// The frequencies of the grid: equal ratios, finer beside the resonances that are too narrow for these.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a number of cells")]
fn frequencies(plant: &TransferMatrix, lowest: f64, highest: f64) -> Vec<f64> {
    let range = (highest / lowest).ln();
    let cells = (range / LN_10 * PER_DECADE).ceil().clamp(1.0, MAX_CELLS) as usize;
    let ratio = range / cells as f64;
    let mut frequencies: Vec<f64> = (0..=cells).map(|k| lowest * (ratio * k as f64).exp()).collect();
    for pole in plant.0.as_flattened().iter().filter_map(|element| poles_off_the_origin(element).ok()).flatten() {
        let (resonance, damping) = (pole.norm(), (pole.re.abs() / pole.norm()).max(MIN_DAMPING));
        if pole.im > 0.0 {
            let mut away = 0.0;
            while SHARE_OF_WIDTH * damping.max(away) < ratio {
                frequencies.extend([-away, away].map(|away: f64| resonance * away.exp()));
                away += SHARE_OF_WIDTH * damping.max(away);
            }
        }
    }
    frequencies.retain(|w| (lowest..=highest).contains(w));
    frequencies.sort_by(f64::total_cmp);
    frequencies.dedup();
    frequencies
}

impl CriticalSearch {
    /// A search from the lowest to the highest frequency (rad per unit of time), both positive.
    pub fn new(plant: &TransferMatrix, lowest: f64, highest: f64) -> Self {
        let grid = frequencies(plant, lowest, highest).into_iter().map(|w| Sample::of(plant, w)).collect();
        Self { plant: plant.clone(), at_rest: AtRest::of(plant), instant: plant.instant_gain(), grid }
    }

    /// All critical points in a direction `(c1, c2)`, nearest first. Only the nearest bounds the stable gains; two at the
    /// same factor are a corner of the curve, where both loci pass through −1.
    pub fn crossings(&self, direction: [f64; 2]) -> Vec<CriticalPoint> {
        let mut points: Vec<_> =
            self.candidates(direction).iter().flat_map(|candidate| self.points_in(candidate, direction)).collect();
        points.sort_by(|x, y| x.factor.total_cmp(&y.factor));
        points
    }

    /// The nearest critical point in a direction; `None` where there is none.
    pub fn nearest(&self, direction: [f64; 2]) -> Option<CriticalPoint> {
        self.nearest_within(direction, u32::MAX)
    }

    /// The nearest of the critical points that are found in as many cells, the likely ones first. A dead time makes hundreds of
    /// crossings where the plant is flat, whose factors differ little.
    pub(super) fn nearest_within(&self, direction: [f64; 2], most_effort: u32) -> Option<CriticalPoint> {
        let mut candidates = self.candidates(direction);
        candidates.sort_by(|x, y| y.is_left.cmp(&x.is_left).then(x.least_factor.total_cmp(&y.least_factor)));
        let mut nearest: Option<CriticalPoint> = None;
        let mut effort = 0;
        for candidate in &candidates {
            if nearest.is_some_and(|best| best.factor < candidate.least_factor) {
                continue;
            }
            if effort >= most_effort {
                break;
            }
            effort += if candidate.dip.is_some() { EFFORT_OF_DIP } else { 1 };
            for point in self.points_in(candidate, direction) {
                nearest = Some(nearest.filter(|best| best.factor <= point.factor).unwrap_or(point));
            }
        }
        nearest
    }

    /// The cells in which the equation changes its sign, and the dips that may, by rising frequency.
    fn candidates(&self, direction: [f64; 2]) -> Vec<Candidate> {
        let value = |k: usize| self.grid.get(k).map_or(f64::NAN, |sample| sample.equation(direction));
        let mut candidates = Vec::new();
        let (mut before, mut at) = (value(0), value(1));
        for k in 1..self.grid.len() {
            let after = value(k + 1);
            let changes = before != 0.0 && before.signum() != at.signum();
            if changes || is_dip(before, at, after) {
                let dip = (!changes).then_some(at.signum());
                candidates.push(Candidate {
                    cell: k,
                    dip,
                    is_left: self.grid[k - 1].is_left(direction) || self.grid[k].is_left(direction),
                    least_factor: self.grid[k].least_factor(direction),
                });
            }
            (before, at) = (at, after);
        }
        candidates
    }

    /// The critical points in the cell of a candidate, or in both cells beside its dip.
    fn points_in(&self, candidate: &Candidate, direction: [f64; 2]) -> Vec<CriticalPoint> {
        let (low, high) = (self.grid[candidate.cell - 1], self.grid[candidate.cell]);
        let solutions = match candidate.dip {
            None => vec![self.solve(low, high, direction)],
            Some(side) => self.dip(candidate.cell, side, direction).map_or_else(Vec::new, |between| {
                let beyond = self.grid[candidate.cell + 1];
                vec![self.solve(low, between, direction), self.solve(between, beyond, direction)]
            }),
        };
        let points = solutions.into_iter().map(|solution| {
            let factor = solution.factor(direction);
            CriticalPoint { gains: direction.map(|c| factor * c), factor, frequency: solution.frequency }
        });
        points.filter(|point| point.factor > 0.0 && point.factor.is_finite()).collect()
    }

    /// What bounds the stable gains in a direction: an oscillation or a real pole, whichever is nearer.
    pub fn limit(&self, direction: [f64; 2]) -> GainLimit {
        self.limit_within(direction, u32::MAX)
    }

    /// The same by [`nearest_within`](Self::nearest_within).
    pub(super) fn limit_within(&self, direction: [f64; 2], most_effort: u32) -> GainLimit {
        let point = self.nearest_within(direction, most_effort);
        let is_nearest = |factor: &f64| point.is_none_or(|point| *factor < point.factor);
        let real = smallest_factor(self.at_rest.coefficients(direction)).filter(is_nearest);
        let algebraic = smallest_factor(self.at_infinity(direction)).filter(is_nearest);
        let gains = |factor: f64| direction.map(|c| factor * c);
        match (real, algebraic, point) {
            (Some(factor), other, _) if other.is_none_or(|other| factor <= other) => {
                GainLimit::RealPole { gains: gains(factor), factor }
            }
            (_, Some(factor), _) => GainLimit::AlgebraicLoop { gains: gains(factor), factor },
            (_, None, Some(point)) => GainLimit::Oscillation(point),
            (_, None, None) => GainLimit::None,
        }
    }

    /// Coefficients of `det(I + a G(∞) diag c) = 1 + a T + a² D`.
    fn at_infinity(&self, [c1, c2]: [f64; 2]) -> [f64; 3] {
        [1.0, self.instant[(0, 0)] * c1 + self.instant[(1, 1)] * c2, self.instant.determinant() * c1 * c2]
    }

    /// Where the equation has the other sign than at the grid points around k, all of which have the same.
    fn dip(&self, k: usize, side: f64, direction: [f64; 2]) -> Option<Sample> {
        let towards_zero = |w: f64| side * Sample::of(&self.plant, w).equation(direction);
        let lowest = golden_section(towards_zero, self.grid[k - 1].frequency, self.grid[k + 1].frequency);
        let sample = Sample::of(&self.plant, lowest);
        (side * sample.equation(direction) < 0.0).then_some(sample)
    }

    fn solve(&self, low: Sample, high: Sample, direction: [f64; 2]) -> Sample {
        let equation = |w: f64| Sample::of(&self.plant, w).equation(direction);
        let ends = [low, high].map(|sample| (sample.frequency, sample.equation(direction)));
        Sample::of(&self.plant, root(equation, ends[0], ends[1]))
    }
}
#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::linear::TransferFunction;

    /// The same element in both loops, without interaction.
    fn diagonal(element: &TransferFunction) -> TransferMatrix {
        let none = element.scaled(0.0);
        TransferMatrix([[element.clone(), none.clone()], [none, element.clone()]])
    }

    fn search(plant: &TransferMatrix) -> CriticalSearch {
        let (low, high) = frequency_range(plant).unwrap();
        CriticalSearch::new(plant, low, high)
    }

    #[test]
    fn a_resonance_is_found_however_narrow() {
        // k/((s² + 2 ζ s + 1)(s + 1)): by Routh's criterion k = 4 ζ + 4 ζ² at ω² = 1 + 2 ζ.
        for damping in [0.5, 0.05, 1e-3, 1e-5, 1e-7] {
            let resonance = TransferFunction::new(vec![1.0], vec![1.0, 2.0 * damping, 1.0], 0.0).unwrap();
            let plant = diagonal(&resonance.times(&TransferFunction::lags(1.0, &[1.0], 0.0).unwrap()));
            let search = search(&plant);
            let point = search.nearest([1.0, 0.0]).unwrap();
            assert_relative_eq!(point.gains[0], 4.0 * damping * (1.0 + damping), max_relative = 1e-6);
            assert_relative_eq!(point.frequency, (1.0 + 2.0 * damping).sqrt(), max_relative = 1e-9);
            assert!(search.grid.len() < 3_000, "{}", search.grid.len());
        }
    }

    #[test]
    fn the_grid_is_bounded_whatever_the_plant() {
        // Time constants over 24 decades and narrow resonances.
        let lags = TransferFunction::lags(1.0, &[1e12, 1e-12], 1.0).unwrap();
        let resonance = |w: f64| TransferFunction::new(vec![1.0], vec![1.0, 1e-9 / w, 1.0 / (w * w)], 0.0).unwrap();
        let plant = diagonal(&lags.times(&resonance(1.0)).times(&resonance(30.0)));
        let points = search(&plant).grid.len();
        assert!(points < 12_000, "{points}");
    }
}
