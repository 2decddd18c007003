//! The largest values over all frequencies of what measures the robustness of a loop: a complete search, as that of the margins.

use std::collections::VecDeque;

use nalgebra::Matrix2;

use super::Complex;
use super::return_ratio::{RatioOver, ReturnRatio};
use super::sensitivity::{elements, largest_singular_value, largest_singular_value_of_inverse};
use super::taylor_model::{Cell, TaylorModel};
use crate::numeric::golden_section;

/// The largest value of a function of frequency, and where it has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopPeak {
    /// The value.
    pub value: f64,
    /// Its frequency (rad per unit of time of the plant); infinite where it is only approached, and a frequency at which the loop has
    /// settled where it is the value at rest.
    pub frequency: f64,
}

/// Biggest closed-loop log modulus (dB) of a stable loop: `Lc = 20 log₁₀ |W/(1 + W)|` with `W = −1 + det(I + G K)`, largest over all
/// frequencies.
///
/// W takes the place of the return ratio of a single loop, so that Lc is the resonance peak of a loop with one input and one output.
/// The BLT method detunes a set of controllers until it is 2 dB for each loop, 4 dB for two (Luyben 1986, "Simple method for tuning
/// SISO controllers in multivariable systems", Ind. Eng. Chem. Process Des. Dev. 25, 654–660). `None` for a loop that is open, whose
/// modulus is zero, and where the search is beyond its bound on work.
///
/// # Examples
/// ```
/// use quadtank::control::{IsaPid, PidMatrix};
/// use quadtank::linear::{ReturnRatio, biggest_log_modulus};
/// use quadtank::literature::campestrini::PublishedPlant;
///
/// // The column of Wood and Berry with the controllers of the BLT method: the 4 dB that the method asks for.
/// let pi = |gain, integral_time| IsaPid { gain, integral_time, derivative_time: 0.0 }.into();
/// let controllers = PidMatrix::decentralised([pi(0.375, 8.29), pi(-0.075, 23.6)]);
/// let plant = PublishedPlant::WoodBerry.transfer_matrix()?;
/// let ratio = ReturnRatio::new(&plant, controllers.transfer_matrix()?, controllers.integrators());
/// let peak = biggest_log_modulus(&ratio).expect("a closed loop");
/// assert!((peak.value - 3.98).abs() < 0.005);
/// # Ok::<(), quadtank::linear::LinearError>(())
/// ```
pub fn biggest_log_modulus(ratio: &ReturnRatio) -> Option<LoopPeak> {
    let peak = peak(ratio, &LOG_MODULUS)?;
    (peak.value > 0.0).then(|| LoopPeak { value: 20.0 * peak.value.log10(), ..peak })
}

/// Largest singular value of the sensitivity `S = (I + G K)⁻¹` of a stable loop over all frequencies, Ms; 1 at least, which every loop
/// comes to in the end. `None` where the search is beyond its bound on work.
///
/// Errors at the outputs are made larger by at most this factor, in the worst direction at the worst frequency (Skogestad and
/// Postlethwaite 2005, §3.3).
pub fn largest_sensitivity(ratio: &ReturnRatio) -> Option<LoopPeak> {
    peak(ratio, &SENSITIVITY)
}

/// Share of a peak below which no higher one is sought.
const PRECISION: f64 = 1e-4;
/// Share by which a value has to be higher: singular values that are nearly equal lose half their digits.
const ROUNDING: f64 = 1e-8;
/// Most cells that are looked at.
const MAX_CELLS: u32 = 20_000;
/// Narrowest cell that is halved, relative to its frequency.
const NARROWEST: f64 = 1e-12;
/// Relative deviation of the elements from powers of s at the lowest frequency.
const SETTLED: f64 = 1e-7;

/// A function of the loop, with what bounds it.
struct Measure {
    /// Its value for a return ratio.
    at: fn(&Matrix2<Complex>) -> f64,
    /// A bound for a return ratio whose elements are at most so far from those of another, L(∞); infinite where they say nothing. Smaller
    /// distances have a smaller bound.
    within: fn(&Matrix2<f64>, &Matrix2<f64>) -> f64,
    /// A bound over a cell.
    over: fn(&RatioOver) -> f64,
}

const LOG_MODULUS: Measure = Measure {
    at: |ratio| (Complex::ONE - (Matrix2::identity() + ratio).determinant().inv()).norm(),
    within: |distance, at_infinity| {
        let difference = Matrix2::identity() + at_infinity;
        let [a, b, c, d] = elements(&(inverse_sizes(&difference) * distance));
        let (change, least) = (a + d + a * d + b * c, difference.determinant().abs());
        let at_end = (1.0 - difference.determinant().recip()).abs();
        if change < 1.0 { at_end + change / (1.0 - change) / least } else { f64::INFINITY }
    },
    over: |ratio| {
        let modulus = TaylorModel::ONE - TaylorModel::ONE / return_difference(ratio);
        modulus.size()
    },
};

const SENSITIVITY: Measure = Measure {
    at: |ratio| largest_singular_value_of_inverse(&(Matrix2::identity() + ratio)),
    within: |distance, at_infinity| {
        let difference = Matrix2::identity() + at_infinity;
        let size = (inverse_sizes(&difference) * distance).norm();
        let at_end = (SENSITIVITY.at)(&at_infinity.map(Complex::from));
        if size < 1.0 { at_end / (1.0 - size) } else { f64::INFINITY }
    },
    over: |ratio| {
        let [[a, b], [c, d]] = ratio.elements;
        let difference = return_difference(ratio);
        let adjugate = [[TaylorModel::ONE + d, -b], [-c, TaylorModel::ONE + a]];
        let s = adjugate.map(|row| row.map(|element| element / difference));
        // A norm is convex: along a straight line it is largest at an end.
        let end = |side: f64| {
            largest_singular_value(&Matrix2::from_fn(|row, column| {
                let element = s[row][column];
                element.value + element.slope * side
            }))
        };
        let remainder =
            s.as_flattened().iter().map(|element| element.remainder * element.remainder).sum::<f64>().sqrt();
        end(-1.0).max(end(1.0)) + remainder
    },
};

/// Absolute values of the elements of the inverse.
fn inverse_sizes(matrix: &Matrix2<f64>) -> Matrix2<f64> {
    matrix.try_inverse().map_or_else(|| Matrix2::repeat(f64::INFINITY), |inverse| inverse.map(f64::abs))
}

/// det(I + L) = 1 + tr L + det L over a cell.
fn return_difference(ratio: &RatioOver) -> TaylorModel {
    let [[a, _], [_, d]] = ratio.elements;
    TaylorModel::ONE + a + d + ratio.determinant
}

/// Cells of frequency are halved, widest first, until bounds over them say that none holds a value that is higher than the highest
/// found, to one part in ten thousand. The search ends where the loop is too small for any.
fn peak(ratio: &ReturnRatio, measure: &Measure) -> Option<LoopPeak> {
    let mut search = Search::new(ratio, measure);
    search.run().map(|()| search.polished())
}

/// What has been found so far.
struct Search<'a> {
    ratio: &'a ReturnRatio<'a>,
    measure: &'a Measure,
    cells: u32,
    value: f64,
    /// The cell in which the value was found.
    highest: Option<Cell>,
}

impl<'a> Search<'a> {
    /// From the value that the loop has in the end.
    fn new(ratio: &'a ReturnRatio, measure: &'a Measure) -> Self {
        let value = (measure.at)(&ratio.at_infinity().map(Complex::from));
        Self { ratio, measure, cells: 0, value, highest: None }
    }

    fn run(&mut self) -> Option<()> {
        let &mut Self { ratio, measure, .. } = self;
        let at_infinity = ratio.at_infinity();
        let low = ratio.low_end(SETTLED);
        self.meet((measure.at)(&ratio.at(low)), Cell { low, high: low });
        let mut end = ratio.high_end(2.0 * low, |distance| (measure.within)(distance, at_infinity).is_finite())?;
        self.examine(Cell { low, high: end })?;
        while ratio.high_end(end, |distance| (measure.within)(distance, at_infinity) <= self.reach())? != end {
            self.examine(Cell { low: end, high: 2.0 * end })?;
            end *= 2.0;
        }
        Some(())
    }

    fn meet(&mut self, value: f64, cell: Cell) {
        if value > self.value * (1.0 + ROUNDING) {
            (self.value, self.highest) = (value, Some(cell));
        }
    }

    /// The value up to which no cell matters.
    fn reach(&self) -> f64 {
        self.value * (1.0 + PRECISION)
    }

    /// Halves a cell until nothing is open; `None` beyond the bound on work, as for a loop on the border of stability.
    fn examine(&mut self, cell: Cell) -> Option<()> {
        let mut cells = VecDeque::from([cell]);
        while let Some(cell) = cells.pop_front() {
            self.cells += 1;
            if self.cells > MAX_CELLS {
                return None;
            }
            let over = self.ratio.over(cell);
            let middle = Matrix2::from_fn(|row, column| over.elements[row][column].value);
            self.meet((self.measure.at)(&middle), cell);
            let is_settled = (self.measure.within)(&over.largest, &Matrix2::zeros()) <= self.reach()
                || (self.measure.over)(&over) <= self.reach()
                || cell.half_width() <= NARROWEST * cell.low;
            if !is_settled {
                cells.extend(cell.halves());
            }
        }
        Some(())
    }

    /// The value where it was found, polished.
    fn polished(&self) -> LoopPeak {
        let Self { value, highest: Some(cell), .. } = *self else {
            return LoopPeak { value: self.value, frequency: f64::INFINITY };
        };
        let at = |w: f64| (self.measure.at)(&self.ratio.at(w));
        let polished = golden_section(|w| -at(w), cell.low, cell.high);
        if at(polished) >= value {
            LoopPeak { value: at(polished), frequency: polished }
        } else {
            LoopPeak { value, frequency: cell.middle() }
        }
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::control::PidMatrix;
    use crate::linear::encirclements::examples::{cubic, diagonal, ratio};
    use crate::linear::{TransferFunction, TransferMatrix};
    use crate::literature::campestrini::PublishedPlant;
    use crate::literature::wood_berry::PublishedControllers;

    /// Both peaks on a dense grid.
    fn by_brute_force(plant: &TransferMatrix, integrators: u32) -> [f64; 2] {
        let ratio = ratio(plant, integrators);
        let over_grid = |at: fn(&Matrix2<Complex>) -> f64| {
            (0..=80_000).map(|k| at(&ratio.at(1e-4 * 1e8_f64.powf(f64::from(k) / 80_000.0)))).fold(0.0, f64::max)
        };
        [over_grid(LOG_MODULUS.at), over_grid(SENSITIVITY.at)]
    }

    fn element(numerator: &[f64], denominator: &[f64], dead_time: f64) -> TransferFunction {
        TransferFunction::new(numerator.to_vec(), denominator.to_vec(), dead_time).unwrap()
    }

    #[test]
    fn peaks_are_those_of_a_dense_grid() {
        // PI loops around lags with dead time and cross paths, one of them with a narrow resonance.
        let pi = |gain: f64, lag: f64, dead_time: f64| element(&[gain, 3.0 * gain], &[0.0, 3.0, 3.0 * lag], dead_time);
        let none = element(&[0.0], &[1.0], 0.0);
        let narrow = element(&[0.02], &[1.0, 0.03, 1.0], 0.4);
        let plants = [
            (TransferMatrix([[pi(0.6, 2.0, 1.0), pi(-0.3, 4.0, 2.0)], [pi(0.2, 1.0, 3.0), pi(0.5, 3.0, 0.5)]]), 2),
            (TransferMatrix([[pi(0.4, 2.0, 1.0), narrow], [none.clone(), pi(0.3, 1.0, 0.2)]]), 2),
            (cubic(5.0), 0),
        ];
        for (plant, integrators) in plants {
            let [modulus, sensitivity] = by_brute_force(&plant, integrators);
            let ratio = ratio(&plant, integrators);
            let found = [biggest_log_modulus(&ratio), largest_sensitivity(&ratio)].map(Option::unwrap);
            // The grid has 10,000 points in a decade; the search leaves at most one part in ten thousand.
            assert_relative_eq!(10.0_f64.powf(found[0].value / 20.0), modulus, max_relative = 1e-4);
            assert_relative_eq!(found[1].value, sensitivity, max_relative = 1e-4);
            assert_relative_eq!((SENSITIVITY.at)(&ratio.at(found[1].frequency)), found[1].value, max_relative = 1e-12);
        }
    }

    #[test]
    fn one_loop_has_the_peaks_of_its_own() {
        // 1/(s (s + 1)): |T|² = 1/(x² − x + 1) and |S|² = (x² + x)/(x² − x + 1) with x = ω², by their derivatives largest at x = 1/2
        // and where 2 x² − 2 x = 1.
        let plant = diagonal(element(&[1.0], &[0.0, 1.0, 1.0], 0.0), element(&[0.0], &[1.0], 0.0));
        let ratio = ratio(&plant, 1);
        let modulus = biggest_log_modulus(&ratio).unwrap();
        assert_relative_eq!(modulus.value, 20.0 * (2.0 / 3.0_f64.sqrt()).log10(), max_relative = 1e-9);
        assert_relative_eq!(modulus.frequency, 0.5_f64.sqrt(), max_relative = 1e-6);
        let sensitivity = largest_sensitivity(&ratio).unwrap();
        let square = 0.5 * (1.0 + 3.0_f64.sqrt());
        let exact = (square * (square + 1.0) / (square * square - square + 1.0)).sqrt();
        assert_relative_eq!(sensitivity.value, exact, max_relative = 1e-9);
        assert_relative_eq!(sensitivity.frequency, square.sqrt(), max_relative = 1e-6);
    }

    #[test]
    fn published_loops_take_few_cells() {
        let plant = PublishedPlant::WoodBerry.transfer_matrix().unwrap();
        for published in PublishedControllers::ALL {
            let controllers = PidMatrix::decentralised(published.gains());
            let ratio = ReturnRatio::new(&plant, controllers.transfer_matrix().unwrap(), controllers.integrators());
            for measure in [&LOG_MODULUS, &SENSITIVITY] {
                let mut search = Search::new(&ratio, measure);
                search.run().unwrap();
                println!("{published:?}: {} cells", search.cells);
                assert!(search.cells < MAX_CELLS / 10, "{published:?}: {} cells", search.cells);
            }
        }
    }

    #[test]
    fn loops_without_a_peak_have_the_value_of_their_ends() {
        // k/(s + 1): S = (s + 1)/(s + 1 + k) rises to 1, T falls from k/(1 + k).
        let lag = element(&[0.5], &[1.0, 1.0], 0.0);
        let plant = diagonal(lag, element(&[0.0], &[1.0], 0.0));
        let ratio_of_lag = ratio(&plant, 0);
        let sensitivity = largest_sensitivity(&ratio_of_lag).unwrap();
        assert_eq!((sensitivity.value, sensitivity.frequency), (1.0, f64::INFINITY));
        assert_relative_eq!(
            biggest_log_modulus(&ratio_of_lag).unwrap().value,
            20.0 * (1.0_f64 / 3.0).log10(),
            max_relative = 1e-6
        );
        let open = diagonal(element(&[0.0], &[1.0], 0.0), element(&[0.0], &[1.0], 0.0));
        assert_eq!(biggest_log_modulus(&ratio(&open, 0)), None);
        assert_eq!(largest_sensitivity(&ratio(&open, 0)).unwrap().value, 1.0);
    }

    #[test]
    fn the_border_of_stability_and_loops_that_never_get_small_end_within_the_bound_on_work() {
        // A pole on the axis: the peak is infinite, or what rounding leaves of it.
        assert!(largest_sensitivity(&ratio(&cubic(8.0), 0)).is_none_or(|peak| peak.value > 1e8));
        let endless = element(&[2.0], &[1.0], 1.0);
        assert_eq!(largest_sensitivity(&ratio(&diagonal(endless.clone(), endless), 0)), None);
    }
}
