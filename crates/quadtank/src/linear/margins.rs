//! How far a loop is from instability: a complete search of its characteristic loci.

use std::cell::Cell as Counter;
use std::collections::VecDeque;
use std::f64::consts::{PI, TAU};

use nalgebra::Matrix2;

use super::Complex;
use super::loci::{locus_values, nearest_order};
use super::return_ratio::ReturnRatio;
use super::sensitivity::elements;
use super::taylor_model::Cell;
use crate::numeric::{golden_section, modulus, root};

/// How far a loop is from instability when all of it is scaled or turned. Meant for stable loops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margins {
    /// Shortest distance of a locus from −1. For a loop with one input and output its reciprocal is Ms.
    pub distance: f64,
    /// Frequency of that (rad per unit of time of the plant); infinite where the distance is that which the loci have
    /// in the end, 1 without direct feedthrough.
    pub distance_frequency: f64,
    /// Smallest factor above 1 on all gains at which a locus reaches −1; `None` where there is none up to 10⁶.
    pub gain_up: Option<f64>,
    /// Largest factor below 1 at which one does; `None` where there is none down to 10⁻⁶.
    pub gain_down: Option<f64>,
    /// Smallest phase lag in all loops at which a locus reaches −1 (rad).
    pub phase: Option<f64>,
}

/// Largest gain margin that is sought.
const LARGEST_FACTOR: f64 = 1e6;
/// Share of a margin below which no better one is sought.
const PRECISION: f64 = 1e-4;
/// Most evaluations of the loop, over cells and at points. Of 1,000 random loops half take 2,500, and one 10,800.
const MAX_EVALUATIONS: u32 = 20_000;
/// Narrowest cell that is halved, relative to its frequency.
const NARROWEST: f64 = 1e-10;
/// Largest distance from a line, relative to the value, of a locus that is on it.
const ON_LINE: f64 = 1e-6;
/// Relative deviation of the elements from powers of s at the lowest frequency.
const SETTLED: f64 = 1e-7;
/// Largest deviation of L from L(∞), relative to it, at the end of the search with direct feedthrough.
const ARRIVED: f64 = 1e-5;
/// Bound on the loci beyond the first part of the search.
const HALF: f64 = 0.5;

impl Margins {
    /// Searches all frequencies; `None` beyond the bound on work, as with many turns of a dead time at high gain.
    ///
    /// Cells of frequency are halved, widest first, until the enclosures of both loci say that they hold nothing nearer to −1
    /// than what was found, to one part in ten thousand. The search ends where the loop is too small for any.
    pub fn of(ratio: &ReturnRatio) -> Option<Self> {
        Search::new(ratio).run()
    }
}

/// Whether a distance exceeds a radius; false of what is not a number.
fn is_beyond(distance: f64, radius: f64) -> bool {
    distance > radius
}

/// Bound on the eigenvalues of a matrix by the absolute values of its elements.
fn spectral_bound(largest: &Matrix2<f64>) -> f64 {
    let [a, b, c, d] = elements(largest);
    0.5 * (a + d) + (0.25 * (a - d) * (a - d) + b * c).sqrt()
}

/// A cell with the loci at its ends.
struct Piece {
    cell: Cell,
    ends: [[Complex; 2]; 2],
}

/// What has been found so far.
struct Search<'a> {
    ratio: &'a ReturnRatio<'a>,
    evaluations: Counter<u32>,
    distance: f64,
    /// The cell in which the distance was found.
    nearest: Option<Cell>,
    gain_up: f64,
    gain_down: f64,
    phase: f64,
}

impl<'a> Search<'a> {
    fn new(ratio: &'a ReturnRatio<'a>) -> Self {
        Self {
            ratio,
            evaluations: Counter::new(0),
            distance: 1.0,
            nearest: None,
            gain_up: LARGEST_FACTOR,
            gain_down: LARGEST_FACTOR.recip(),
            phase: TAU,
        }
    }

    fn run(&mut self) -> Option<Margins> {
        let low = self.ratio.low_end(SETTLED);
        if *self.ratio.at_infinity() != Matrix2::zeros() {
            return self.run_to_infinity(low);
        }
        let mut end = self.ratio.high_end(2.0 * low, |largest| spectral_bound(largest) <= HALF)?;
        self.limit_at_rest(low);
        self.examine(Cell { low, high: end })?;
        loop {
            let reach = self.reach();
            if self.ratio.high_end(end, |largest| spectral_bound(largest) <= reach)? == end {
                return Some(self.margins());
            }
            self.examine(Cell { low: end, high: 2.0 * end })?;
            end *= 2.0;
        }
    }

    /// With direct feedthrough the loci end at those of L(∞).
    fn run_to_infinity(&mut self, low: f64) -> Option<Margins> {
        let at_infinity = self.ratio.at_infinity();
        let end = self.ratio.high_end(2.0 * low, |largest| largest.norm() <= ARRIVED * at_infinity.norm())?;
        self.limit_at_rest(low);
        let ends = locus_values(&at_infinity.map(Complex::from));
        self.distance = ends.iter().map(|value| modulus(value + 1.0)).fold(f64::INFINITY, f64::min);
        for value in ends.into_iter().filter(|value| value.im == 0.0 && value.re != 0.0) {
            self.meet_real_axis(value);
        }
        self.examine(Cell { low, high: end })?;
        Some(self.margins())
    }

    fn count(&self) {
        self.evaluations.set(self.evaluations.get() + 1);
    }

    fn loci(&self, frequency: f64) -> [Complex; 2] {
        self.count();
        locus_values(&self.ratio.at(frequency))
    }

    /// A locus that starts on the real axis reaches −1 there.
    fn limit_at_rest(&mut self, low: f64) {
        for value in self.loci(low) {
            if value.im.abs() <= ON_LINE * value.re.abs() {
                self.meet_real_axis(value);
            }
        }
    }

    /// Halves a cell until nothing is open; `None` beyond the bound on work.
    fn examine(&mut self, cell: Cell) -> Option<()> {
        let mut pieces = VecDeque::from([Piece { cell, ends: [self.loci(cell.low), self.loci(cell.high)] }]);
        while let Some(Piece { cell, ends: [at_low, at_high] }) = pieces.pop_front() {
            self.count();
            if self.evaluations.get() > MAX_EVALUATIONS {
                return None;
            }
            let invariants = self.ratio.invariants(cell);
            let values = locus_values(&invariants.ratio);
            for value in values {
                self.meet_distance(modulus(value + 1.0), cell);
            }
            if spectral_bound(&invariants.largest) < self.reach() {
                continue;
            }
            let radii = invariants.radii(values);
            let is_within = |distance: f64, i: usize| !is_beyond(distance, radii[i]);
            let crosses = (0..2).any(|i| {
                is_within(self.to_phases(values[i]), i)
                    || is_within(self.to_gains(values[i]), i) && !invariants.is_off_negative_axis(values[i], cell)
            });
            if crosses {
                self.meet_crossings(cell, at_low, at_high);
            }
            let is_nearer = (0..2).any(|i| is_within(self.to_disc(values[i]), i));
            if (crosses || is_nearer) && cell.half_width() > NARROWEST * cell.low {
                let [left, right] = cell.halves();
                pieces.push_back(Piece { cell: left, ends: [at_low, values] });
                pieces.push_back(Piece { cell: right, ends: [values, at_high] });
            }
        }
        Some(())
    }

    /// Distance of a point from the disc around −1 that a nearer locus would enter.
    fn to_disc(&self, x: Complex) -> f64 {
        modulus(x + 1.0) - self.distance * (1.0 - PRECISION)
    }

    /// Distance of a point from the parts of the real axis that a locus with a smaller gain margin would cross.
    fn to_gains(&self, x: Complex) -> f64 {
        let far = (-1.0 / (self.gain_down * (1.0 + PRECISION))).min(-1.0);
        let near = (-1.0 / (self.gain_up * (1.0 - PRECISION))).max(-1.0);
        modulus(x - x.re.clamp(far, near))
    }

    /// Distance of a point from the arc of the unit circle that a locus with a smaller phase margin would cross.
    fn to_phases(&self, x: Complex) -> f64 {
        let largest = self.phase * (1.0 - PRECISION);
        if phase_lag(x) <= largest {
            return (modulus(x) - 1.0).abs();
        }
        modulus(x + 1.0).min(modulus(x + Complex::cis(largest)))
    }

    fn meet_distance(&mut self, distance: f64, cell: Cell) {
        if distance < self.distance {
            (self.distance, self.nearest) = (distance, Some(cell));
        }
    }

    /// Where a locus crosses the negative real axis or the unit circle between the ends of a cell.
    fn meet_crossings(&mut self, cell: Cell, at_low: [Complex; 2], at_high: [Complex; 2]) {
        let at_high = nearest_order(at_high, at_low);
        for (before, after) in at_low.into_iter().zip(at_high) {
            let ends = [before, after];
            if let Some(value) = self.crossing(cell, ends, |x| x.im, |x| self.to_gains(x)) {
                self.meet_real_axis(value);
            }
            if let Some(value) = self.crossing(cell, ends, |x| x.norm() - 1.0, |x| self.to_phases(x)) {
                self.phase = self.phase.min(phase_lag(value));
            }
        }
    }

    fn meet_real_axis(&mut self, value: Complex) {
        let factor = -1.0 / value.re;
        if factor >= 1.0 {
            self.gain_up = self.gain_up.min(factor);
        } else if factor > 0.0 {
            self.gain_down = self.gain_down.max(factor);
        }
    }

    /// The value of a locus where `side` of it changes its sign in a cell, if it is the same locus at both ends and the chord
    /// crosses near what matters.
    fn crossing(
        &self,
        cell: Cell,
        [before, after]: [Complex; 2],
        side: impl Fn(Complex) -> f64,
        distance: impl Fn(Complex) -> f64,
    ) -> Option<Complex> {
        let chord = after - before;
        let share = side(before) / (side(before) - side(after));
        if side(before) * side(after) > 0.0 || is_beyond(distance(before + chord * share), modulus(chord)) {
            return None;
        }
        let value = |w: f64| {
            let guess = before + chord * ((w - cell.low) / (cell.high - cell.low));
            let [a, b] = self.loci(w);
            if modulus(a - guess) <= modulus(b - guess) { a } else { b }
        };
        let frequency = root(|w| side(value(w)), (cell.low, side(before)), (cell.high, side(after)));
        Some(value(frequency)).filter(|&found| side(found).abs() <= ON_LINE * modulus(found))
    }

    /// The smallest absolute value of a locus that may still matter.
    fn reach(&self) -> f64 {
        (1.0 - self.distance * (1.0 - PRECISION)).min(1.0 / (self.gain_up * (1.0 - PRECISION)))
    }

    /// The distance is polished where it was found.
    fn margins(&self) -> Margins {
        let nearest = |w: f64| self.loci(w).map(|x| modulus(x + 1.0)).into_iter().fold(f64::INFINITY, f64::min);
        let (mut distance, mut distance_frequency) = (self.distance, f64::INFINITY);
        if let Some(cell) = self.nearest {
            distance_frequency = cell.middle();
            let polished = golden_section(nearest, cell.low, cell.high);
            if nearest(polished) <= distance {
                (distance, distance_frequency) = (nearest(polished), polished);
            }
        }
        let is_found = |factor: f64| factor < LARGEST_FACTOR && factor.recip() < LARGEST_FACTOR;
        Margins {
            distance,
            distance_frequency,
            gain_up: Some(self.gain_up).filter(|&factor| is_found(factor)),
            gain_down: Some(self.gain_down).filter(|&factor| is_found(factor)),
            phase: Some(self.phase).filter(|&lag| lag < TAU),
        }
    }
}

/// The lag that takes a point of the unit circle to −1 (rad), from 0 to 2π.
fn phase_lag(x: Complex) -> f64 {
    let lag = x.arg() + PI;
    if lag < TAU { lag } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::linear::encirclements::examples::{cubic, diagonal, ratio};
    use crate::linear::{TransferFunction, TransferMatrix};

    fn margins(plant: &TransferMatrix) -> Margins {
        Margins::of(&ratio(plant, 0)).unwrap()
    }

    #[test]
    fn margins_of_a_triple_lag() {
        let found = margins(&cubic(2.0));
        assert_relative_eq!(found.gain_up.unwrap(), 4.0, max_relative = 1e-10);
        assert_eq!(found.gain_down, None);
        // |2/(jω + 1)^3| = 1 at ω² = 2^(2/3) − 1; loop 2 never reaches 1.
        let w = (2.0_f64.powf(2.0 / 3.0) - 1.0).sqrt();
        assert_relative_eq!(found.phase.unwrap(), PI - 3.0 * w.atan(), max_relative = 1e-10);
        let nearest = |w: f64| (Complex::new(1.0, w).inv().powu(3) * 2.0 + 1.0).norm();
        assert_relative_eq!(found.distance, nearest(found.distance_frequency), max_relative = 1e-12);
        assert!(found.distance <= nearest(found.distance_frequency * 1.001));
        assert!(found.distance <= nearest(found.distance_frequency * 0.999));
    }

    #[test]
    fn equal_loops_have_the_margins_of_one() {
        // Both loci are one curve: a double eigenvalue at every frequency.
        let lags = TransferFunction::lags(2.0, &[1.0; 3], 0.0).unwrap();
        let (both, one) = (margins(&diagonal(lags.clone(), lags)), margins(&cubic(2.0)));
        assert_relative_eq!(both.distance, one.distance, max_relative = 1e-7);
        assert_relative_eq!(both.gain_up.unwrap(), 4.0, max_relative = 1e-6);
        assert_relative_eq!(both.phase.unwrap(), one.phase.unwrap(), max_relative = 1e-6);
    }

    #[test]
    fn a_locus_that_starts_left_of_the_origin_has_its_margin_at_rest() {
        // −0.4/(s + 1): a real pole reaches the origin at 2.5 times the gain.
        let found = margins(&diagonal(
            TransferFunction::lags(-0.4, &[1.0], 0.0).unwrap(),
            TransferFunction::lags(0.5, &[1.0], 0.0).unwrap(),
        ));
        assert_relative_eq!(found.gain_up.unwrap(), 2.5, max_relative = 1e-9);
        assert_relative_eq!(found.distance, 0.6, max_relative = 1e-9);
    }

    #[test]
    fn two_integrators_with_little_damping_have_margins() {
        // a (T s + 1)/(T s²) on the axis to all but a T of its argument: a PI controller of small gain around a large tank.
        let (a, time) = (7.3e-5, 20.0);
        let element = TransferFunction::new(vec![a, a * time], vec![0.0, 0.0, time], 0.0).unwrap();
        let plant = diagonal(element.clone(), element.scaled(0.0));
        let ratio = ratio(&plant, 2);
        let mut search = Search::new(&ratio);
        let found = search.run().unwrap();
        assert!(search.evaluations.get() < MAX_EVALUATIONS / 4, "{}", search.evaluations.get());
        assert_eq!((found.gain_up, found.gain_down), (None, None));
        // |L| = 1 where ω⁴ = (a/T)² (1 + (T ω)²), and the argument is that of 1 + j T ω, less π.
        let squared = 0.5 * (a * a + (a.powi(4) + 4.0 * (a / time).powi(2)).sqrt());
        assert_relative_eq!(found.phase.unwrap(), (time * squared.sqrt()).atan(), max_relative = 1e-8);
    }

    #[test]
    fn a_loop_that_never_gets_small_has_no_margins() {
        // A gain of 2 with a dead time turns for ever; 10⁹/(s + 1) turns until 10⁹ rad. Many cells hold crossings, each of which
        // takes evaluations too: those of the last cell may be beyond the bound.
        let gain = |size: f64, lags: &[f64]| TransferFunction::lags(size, lags, 1.0).unwrap();
        for element in [gain(2.0, &[]), gain(1e9, &[1.0])] {
            let plant = diagonal(element.clone(), element);
            let ratio = ratio(&plant, 0);
            let mut search = Search::new(&ratio);
            assert_eq!(search.run(), None);
            assert!(search.evaluations.get() < MAX_EVALUATIONS + 500, "{}", search.evaluations.get());
        }
    }
}
