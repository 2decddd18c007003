//! The return ratio of a loop with two inputs and outputs, with what bounds it over whole ranges of frequency.

use nalgebra::Matrix2;

use super::taylor_model::{Cell, TaylorModel};
use super::transfer::degree;
use super::{Complex, TransferFunction, TransferMatrix, series};
use crate::numeric::modulus;

/// The return ratio `L(s) = G(s) K(s)` of a plant and its controllers, both with two inputs and two outputs.
#[derive(Clone, Debug)]
pub struct ReturnRatio<'a> {
    plant: &'a TransferMatrix,
    controllers: TransferMatrix,
    integrators: u32,
    /// Factor and order of the pole of det(I + L) at the origin, for a loop with integrators.
    at_origin: Option<(f64, u32)>,
    at_infinity: Matrix2<f64>,
}

/// Smallest relative deviation of det(I + L) of a loop with integrators from its asymptote at the origin that the lowest frequency is
/// chosen for; rounding hides smaller ones.
const MIN_DEVIATION: f64 = 1e-9;
/// Decades that the lowest frequency is lowered by at most to get there.
const DECADES: usize = 60;

/// Frequency at which the search for the high end of the band gives up.
const BEYOND_ALL: f64 = 1e100;

impl<'a> ReturnRatio<'a> {
    /// From a plant and controllers without dead time. `integrators` is the order of the pole of det(I + L) at the origin.
    /// Poles of the plant at the origin are among these.
    pub fn new(plant: &'a TransferMatrix, controllers: TransferMatrix, integrators: u32) -> Self {
        let at_origin = (integrators > 0).then(|| {
            let difference = series::return_difference(&series::elements(plant), &series::elements(&controllers));
            let (factor, _) = difference.leading().unwrap_or_default();
            (factor, difference.pole_order())
        });
        let at_infinity = at_infinity(plant, &controllers).unwrap_or_else(Matrix2::zeros);
        Self { plant, controllers, integrators, at_origin, at_infinity }
    }

    /// L(∞), the direct feedthrough of the loop; zero also where L has no limit, as behind a dead time.
    pub fn at_infinity(&self) -> &Matrix2<f64> {
        &self.at_infinity
    }

    /// Whether a pole of plant or controllers at the origin stays there in the closed loop, whatever its gains are: a part that
    /// integrates without being controlled, or before a zero of the plant at the origin, or without a way to the outputs at rest.
    pub fn hides_an_integrator(&self) -> bool {
        self.at_origin.is_some_and(|(_, order)| order < self.integrators)
    }

    /// `L(s)` at a point of the real axis.
    pub(crate) fn at_real(&self, s: f64) -> Matrix2<f64> {
        let s = Complex::from(s);
        (self.plant.at(s) * self.controllers.at(s)).map(|value| value.re)
    }

    /// Order of the pole of det(I + L) at the origin.
    pub fn integrators(&self) -> u32 {
        self.integrators
    }

    /// L(jω).
    pub fn at(&self, frequency: f64) -> Matrix2<Complex> {
        let s = Complex::new(0.0, frequency);
        self.plant.at(s) * self.controllers.at(s)
    }

    /// A frequency below which every element of G and K is one power of s, to a relative deviation; with integrators det(I + L) too.
    pub(super) fn low_end(&self, deviation: f64) -> f64 {
        let mut low = f64::INFINITY;
        for g in self.plant.0.as_flattened().iter().chain(self.controllers.0.as_flattened()) {
            if g.dead_time() > 0.0 {
                low = low.min(deviation / g.dead_time());
            }
            low = low.min(settles(g.numerator(), deviation)).min(settles(g.denominator(), deviation));
        }
        // A loop of gains alone is the same at all frequencies.
        let low = if low.is_finite() { low } else { 1.0 };
        let Some((factor, order)) = self.at_origin else { return low };
        let deviation = deviation.max(MIN_DEVIATION);
        let is_pole = |w: &f64| {
            let difference = (Matrix2::identity() + self.at(*w)).determinant();
            (difference * Complex::new(0.0, *w).powu(order) / factor - 1.0).norm() <= deviation
        };
        let lowered = std::iter::successors(Some(low), |w| Some(0.1 * w)).take(DECADES);
        lowered.clone().find(is_pole).or(lowered.last()).unwrap_or(low)
    }

    /// A frequency from which on the absolute values of the elements of L − L(∞) stay so small that `is_small` holds of them; `None`
    /// where there is none. `is_small` must hold of all smaller values too.
    pub(super) fn high_end(&self, from: f64, is_small: impl Fn(&Matrix2<f64>) -> bool) -> Option<f64> {
        let doubled = std::iter::successors(Some(from), |w| Some(2.0 * w));
        doubled.take_while(|&w| w < BEYOND_ALL).find(|&w| is_small(&self.largest_beyond(w)))
    }

    /// Largest absolute values of the elements of L − L(∞) from a frequency on; infinite where no bound is known.
    fn largest_beyond(&self, frequency: f64) -> Matrix2<f64> {
        let tails =
            |matrix: &TransferMatrix| matrix.0.each_ref().map(|row| row.each_ref().map(|g| Tail::of(g, frequency)));
        let sum = |[g, k]: [[[Tail; 2]; 2]; 2]| {
            Matrix2::from_fn(|row, column| {
                (0..2).map(|i| g[row][i].times(k[i][column]).largest_beyond(frequency)).sum()
            })
        };
        if self.at_infinity == Matrix2::zeros() {
            return sum([tails(self.plant), tails(&self.controllers)]);
        }
        // With G = D + R and K = K(∞) + Q the difference is R K + D Q.
        let rest = |of: &TransferMatrix, is_rest: bool| {
            TransferMatrix(of.0.each_ref().map(|row| {
                row.each_ref().map(|g| if is_rest && g.dead_time() == 0.0 { g.strictly_proper() } else { g.clone() })
            }))
        };
        let through = self.plant.instant_gain().map(f64::abs);
        let of_controllers = tails(&rest(&self.controllers, true));
        let of_rest = Matrix2::from_fn(|row, column| of_controllers[row][column].largest_beyond(frequency));
        sum([tails(&rest(self.plant, true)), tails(&self.controllers)]) + through * of_rest
    }

    /// The elements and the determinant of L over a cell.
    pub(super) fn over(&self, cell: Cell) -> RatioOver {
        let (mut g, k) = (over(self.plant, cell), over(&self.controllers, cell));
        let largest = Matrix2::from_fn(|row, column| {
            g[row][0].size() * k[0][column].size() + g[row][1].size() * k[1][column].size()
        });
        for (model, element) in g.as_flattened_mut().iter_mut().zip(self.plant.0.as_flattened()) {
            *model = *model * TaylorModel::dead_time(element.dead_time(), cell);
        }
        let l = |row: usize, column: usize| g[row][0] * k[0][column] + g[row][1] * k[1][column];
        let elements = [[l(0, 0), l(0, 1)], [l(1, 0), l(1, 1)]];
        RatioOver { largest, elements, determinant: determinant(&g) * determinant(&k) }
    }

    /// The trace and the determinant of L over a cell.
    pub(super) fn invariants(&self, cell: Cell) -> Invariants {
        let RatioOver { largest, elements: [[a, b], [c, d]], determinant } = self.over(cell);
        let half_difference = (a - d) * 0.5;
        Invariants {
            largest,
            ratio: Matrix2::new(a.value, b.value, c.value, d.value),
            trace: a + d,
            determinant,
            discriminant: half_difference * half_difference + b * c,
        }
    }

    /// The terms of det(I + L) = 1 + tr L + det L over a cell, each without its dead time and with it.
    pub(super) fn return_difference(&self, cell: Cell) -> [(TaylorModel, f64); 7] {
        let (g, k) = (over(self.plant, cell), over(&self.controllers, cell));
        let dead_time = |row: usize, column: usize| self.plant.0[row][column].dead_time();
        let in_trace = |row: usize, column: usize| (g[row][column] * k[column][row], dead_time(row, column));
        let both = determinant(&k);
        [
            (TaylorModel::ONE, 0.0),
            in_trace(0, 0),
            in_trace(0, 1),
            in_trace(1, 0),
            in_trace(1, 1),
            (g[0][0] * g[1][1] * both, dead_time(0, 0) + dead_time(1, 1)),
            (-(g[0][1] * g[1][0] * both), dead_time(0, 1) + dead_time(1, 0)),
        ]
    }
}

/// L over a cell.
pub(super) struct RatioOver {
    /// Largest absolute values of the elements of L, whatever the dead times do.
    pub largest: Matrix2<f64>,
    /// Its elements, row by output.
    pub elements: [[TaylorModel; 2]; 2],
    /// det L, from the determinants of plant and controllers.
    pub determinant: TaylorModel,
}

/// Highest power of ω that a locus is multiplied with.
const HIGHEST_POWER: u32 = 8;

/// What the eigenvalues of L follow from, over a cell.
pub(super) struct Invariants {
    /// Largest absolute values of the elements of L, whatever the dead times do.
    pub largest: Matrix2<f64>,
    /// L in the middle of the cell.
    pub ratio: Matrix2<Complex>,
    /// λ1 + λ2.
    pub trace: TaylorModel,
    /// λ1 λ2.
    pub determinant: TaylorModel,
    /// (λ1 − λ2)²/4.
    pub discriminant: TaylorModel,
}

impl Invariants {
    /// How far from each of its values in the middle, λ1 and λ2, a locus gets in the cell: the smaller one of two bounds.
    pub fn radii(&self, values: [Complex; 2]) -> [f64; 2] {
        let by_discriminant = self.radius_by_discriminant();
        values.map(|value| self.radius_along(value).min(by_discriminant))
    }

    /// Whether the locus through one of the values keeps off the negative real axis in the cell.
    ///
    /// It does if its product with a power of ω does, which changes no argument. With the power that the locus falls with, the
    /// product is nearly constant: a loop with two integrators leaves the axis so slowly that its own bound, which grows with
    /// its value, would need thousands of cells.
    pub fn is_off_negative_axis(&self, value: Complex, cell: Cell) -> bool {
        let fall = -(self.slope_along(value) / value).re * cell.middle() / cell.half_width();
        let powers = (0..HIGHEST_POWER).take_while(|&power| f64::from(power) + 0.5 < fall);
        let factor = powers.fold(TaylorModel::ONE, |product, _| product * TaylorModel::relative_frequency(cell));
        let scaled = Self {
            largest: self.largest,
            ratio: self.ratio,
            trace: self.trace * factor,
            determinant: self.determinant * (factor * factor),
            discriminant: self.discriminant * (factor * factor),
        };
        // The factor is 1 in the middle of the cell.
        let [radius, _] = scaled.radii([value; 2]);
        let distance = if value.re < 0.0 { value.im.abs() } else { modulus(value) };
        distance > radius
    }

    /// Slope of a locus across the cell, by the derivative of `x² − T x + D = 0`.
    fn slope_along(&self, value: Complex) -> Complex {
        (self.trace.slope * value - self.determinant.slope) / (value * 2.0 - self.trace.value)
    }

    /// `λ = m ± √q` with the mean m and the discriminant q within r of its value: a root moves by at most √r, and by r/√|q|.
    /// Good where both loci are nearly the same.
    fn radius_by_discriminant(&self) -> f64 {
        let r = self.discriminant.radius();
        0.5 * self.trace.radius() + r.sqrt().min(r / modulus(self.discriminant.value).sqrt())
    }

    /// By the tangent of the locus. Where the characteristic polynomial `x² − T x + D` is e at a point x of the tangent, the
    /// eigenvalues are at distances from x with the product |e|, and they are `|2 x − T| = g` apart to twice the smaller one:
    /// it is at most the ρ with `ρ (g − ρ) = |e|`. Infinite where no such ρ exists in all the cell.
    fn radius_along(&self, value: Complex) -> f64 {
        let (trace, determinant) = (self.trace, self.determinant);
        let slope = self.slope_along(value);
        let tangent = TaylorModel { value, slope, remainder: 0.0 };
        let residual = (tangent * tangent - trace * tangent + determinant).size();
        let gap = tangent * 2.0 - trace;
        let least_gap = modulus(gap.value) - gap.radius();
        let square = least_gap * least_gap - 4.0 * residual;
        if least_gap > 0.0 && square >= 0.0 {
            modulus(slope) + 2.0 * residual / (least_gap + square.sqrt())
        } else {
            f64::INFINITY
        }
    }
}

/// L(∞) of a loop whose direct feedthrough has no dead time and whose controllers are proper.
fn at_infinity(plant: &TransferMatrix, controllers: &TransferMatrix) -> Option<Matrix2<f64>> {
    let (through, instant) = (plant.feedthrough(), plant.instant_gain());
    let at_infinity = instant * controllers.feedthrough();
    (through == instant && at_infinity.iter().all(|value| value.is_finite())).then_some(at_infinity)
}

fn over(matrix: &TransferMatrix, cell: Cell) -> [[TaylorModel; 2]; 2] {
    matrix.0.each_ref().map(|row| row.each_ref().map(|g| TaylorModel::rational(g, cell)))
}

fn determinant([[a, b], [c, d]]: &[[TaylorModel; 2]; 2]) -> TaylorModel {
    *a * *d - *b * *c
}

/// The frequency below which a polynomial is its lowest power, to a relative deviation; infinite for a single power.
fn settles(coefficients: &[f64], deviation: f64) -> f64 {
    let mut powers = coefficients.iter().enumerate().filter(|&(_, &c)| c != 0.0);
    let Some((lowest, first)) = powers.next() else { return f64::INFINITY };
    powers.map(|(k, c)| (deviation * (first / c).abs()).powf(1.0 / (k - lowest) as f64)).fold(f64::INFINITY, f64::min)
}

/// A bound `factor ω^exponent` on the absolute value of a function from a frequency on.
#[derive(Clone, Copy)]
struct Tail {
    factor: f64,
    exponent: i32,
}

impl Tail {
    fn of(function: &TransferFunction, frequency: f64) -> Self {
        let (Some(b), Some(a)) = (leading(function.numerator()), leading(function.denominator())) else {
            return Self { factor: 0.0, exponent: 0 };
        };
        // The lower powers, each relative to the leading one.
        let lower = |coefficients: &[f64]| {
            coefficients[..coefficients.len() - 1].iter().fold(0.0, |sum, c| (sum + c.abs()) / frequency)
        };
        let least = a[a.len() - 1].abs() - lower(a);
        let factor = (b[b.len() - 1].abs() + lower(b)) / least;
        let degree = |coefficients: &[f64]| i32::try_from(coefficients.len()).unwrap_or(i32::MAX);
        Self { factor: if least > 0.0 { factor } else { f64::INFINITY }, exponent: degree(b) - degree(a) }
    }

    fn times(self, other: Self) -> Self {
        let factor = if self.factor == 0.0 || other.factor == 0.0 { 0.0 } else { self.factor * other.factor };
        Self { factor, exponent: self.exponent + other.exponent }
    }

    fn largest_beyond(self, frequency: f64) -> f64 {
        match self {
            Self { factor: 0.0, .. } => 0.0,
            Self { exponent: 1.., .. } => f64::INFINITY,
            Self { factor, exponent } => factor * frequency.powi(exponent),
        }
    }
}

/// The coefficients up to the leading one.
fn leading(coefficients: &[f64]) -> Option<&[f64]> {
    degree(coefficients).map(|last| &coefficients[..=last])
}
