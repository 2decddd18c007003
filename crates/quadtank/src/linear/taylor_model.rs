//! Enclosures of functions of frequency over a cell: Taylor models of order one (Makino and Berz 2003, in the form for complex values).

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Complex, TransferFunction};
use crate::numeric::modulus;

/// A cell of frequencies (rad per unit of time of the plant).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cell {
    pub low: f64,
    pub high: f64,
}

impl Cell {
    pub fn middle(self) -> f64 {
        f64::midpoint(self.low, self.high)
    }

    pub fn half_width(self) -> f64 {
        0.5 * (self.high - self.low)
    }

    pub fn halves(self) -> [Self; 2] {
        let middle = self.middle();
        [Self { high: middle, ..self }, Self { low: middle, ..self }]
    }
}

/// Numbers that a characteristic function is computed with: values of it, or enclosures over a cell.
pub(crate) trait Arithmetic:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// A constant.
    fn real(value: f64) -> Self;
}

impl Arithmetic for Complex {
    fn real(value: f64) -> Self {
        Self::from(value)
    }
}

impl Arithmetic for TaylorModel {
    fn real(value: f64) -> Self {
        Self::constant(Complex::from(value))
    }
}

/// A complex function over a cell: within `remainder` of `value + slope x`, where x goes from −1 to 1 across the cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TaylorModel {
    pub value: Complex,
    pub slope: Complex,
    pub remainder: f64,
}

impl TaylorModel {
    pub const ZERO: Self = Self::constant(Complex::ZERO);
    pub const ONE: Self = Self::constant(Complex::ONE);

    const fn constant(value: Complex) -> Self {
        Self { value, slope: Complex::ZERO, remainder: 0.0 }
    }

    /// The frequency, relative to the middle of the cell.
    pub fn relative_frequency(cell: Cell) -> Self {
        Self { slope: Complex::from(cell.half_width() / cell.middle()), ..Self::ONE }
    }

    /// Largest distance from the value in the middle.
    pub fn radius(&self) -> f64 {
        modulus(self.slope) + self.remainder
    }

    /// Largest absolute value.
    pub fn size(&self) -> f64 {
        modulus(self.value) + self.radius()
    }

    /// A disc around zero that holds the function, whatever its argument does.
    pub fn disc(&self) -> Self {
        Self { remainder: self.size(), ..Self::ZERO }
    }

    /// `e^(−jωθ)`.
    pub fn dead_time(dead_time: f64, cell: Cell) -> Self {
        let angle = dead_time * cell.half_width();
        let value = Complex::cis(-dead_time * cell.middle());
        Self { value, slope: value * Complex::new(0.0, -angle), remainder: 0.5 * angle * angle }
    }

    /// The rational part `b(jω)/a(jω)` of a transfer function. The remainder is infinite where a may have a zero in the
    /// cell.
    pub fn rational(function: &TransferFunction, cell: Cell) -> Self {
        polynomial(function.numerator(), cell) / polynomial(function.denominator(), cell)
    }
}

/// A polynomial in jω with real coefficients by rising powers; the remainder bounds its second derivative over the
/// cell.
fn polynomial(coefficients: &[f64], cell: Cell) -> TaylorModel {
    let (s, half) = (Complex::new(0.0, cell.middle()), cell.half_width());
    let (mut value, mut derivative) = (Complex::ZERO, Complex::ZERO);
    // The polynomial of the absolute coefficients at the upper end, its derivative and half its second derivative.
    let mut bound = [0.0; 3];
    for &c in coefficients.iter().rev() {
        derivative = derivative * s + value;
        value = value * s + c;
        bound = [bound[0] * cell.high + c.abs(), bound[1] * cell.high + bound[0], bound[2] * cell.high + bound[1]];
    }
    TaylorModel { value, slope: derivative * Complex::new(0.0, half), remainder: bound[2] * half * half }
}

impl Add for TaylorModel {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            slope: self.slope + other.slope,
            remainder: self.remainder + other.remainder,
        }
    }
}

impl Sub for TaylorModel {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for TaylorModel {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, slope: -self.slope, remainder: self.remainder }
    }
}

impl Mul for TaylorModel {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            slope: self.value * other.slope + self.slope * other.value,
            remainder: modulus(self.slope) * modulus(other.slope)
                + self.size() * other.remainder
                + other.size() * self.remainder,
        }
    }
}

impl Mul<f64> for TaylorModel {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self { value: self.value * factor, slope: self.slope * factor, remainder: self.remainder * factor.abs() }
    }
}

impl Div for TaylorModel {
    type Output = Self;

    /// The remainder is infinite where the divisor may have a zero in the cell.
    fn div(self, divisor: Self) -> Self {
        let value = self.value / divisor.value;
        let slope = (self.slope - value * divisor.slope) / divisor.value;
        let least = modulus(divisor.value) - divisor.radius();
        // What is left of the dividend without (value + slope x) times the divisor, over the divisor.
        let remainder = self.remainder + modulus(value) * divisor.remainder + modulus(slope) * divisor.radius();
        Self { value, slope, remainder: if least > 0.0 { remainder / least } else { f64::INFINITY } }
    }
}

/// Rounding of a sum, relative to the size of its terms.
const ROUNDING: f64 = 1e-15;

/// Dead time of the largest of several terms with dead times over a cell; `None` where the enclosure of their sum
/// contains zero.
///
/// The sum is taken in a frame that rotates with that term, so that dead times common to all terms need not be
/// followed.
pub(super) fn dominant_dead_time<const N: usize>(terms: [(TaylorModel, f64); N], cell: Cell) -> Option<f64> {
    let sizes = terms.map(|(term, _)| modulus(term.value));
    let largest = (0..N).max_by(|&i, &j| sizes[i].total_cmp(&sizes[j]))?;
    let frame = terms[largest].1;
    let mut sum = TaylorModel { remainder: ROUNDING * sizes.iter().sum::<f64>(), ..TaylorModel::ZERO };
    for (term, dead_time) in terms {
        let own = dead_time - frame;
        // A term that turns by more than a radian each way may have any argument.
        let is_fast = (own * cell.half_width()).abs() > 1.0;
        sum = sum + if is_fast { term.disc() } else { term * TaylorModel::dead_time(own, cell) };
    }
    (sum.radius() < modulus(sum.value)).then_some(frame)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether a model holds a function at 200 places of its cell, and how much of its radius is used.
    fn holds(model: &TaylorModel, cell: Cell, function: impl Fn(f64) -> Complex) -> f64 {
        let mut used = 0.0_f64;
        for k in 0..=200 {
            let x = f64::from(k) / 100.0 - 1.0;
            let exact = function(cell.middle() + x * cell.half_width());
            let off = (exact - model.value - model.slope * x).norm();
            assert!(off <= model.remainder + 1e-14 * model.size(), "{off} is more than {}", model.remainder);
            used = used.max((exact - model.value).norm() / model.radius());
        }
        used
    }

    #[test]
    fn a_model_holds_its_function() {
        let resonance = TransferFunction::new(vec![1.0, -0.3], vec![1.0, 0.1, 1.0], 0.0).unwrap();
        let lags = TransferFunction::lags(2.0, &[1.0, 3.0, 0.2], 1.7).unwrap();
        for (low, high) in [(0.99, 1.0), (0.2, 0.25), (3.0, 3.5), (1e-3, 1.5e-3)] {
            let cell = Cell { low, high };
            let at = |g: &TransferFunction, w: f64| g.at(Complex::new(0.0, w));
            let [one, other] = [&resonance, &lags].map(|g| TaylorModel::rational(g, cell));
            let delayed = other * TaylorModel::dead_time(1.7, cell);
            assert!(holds(&one, cell, |w| at(&resonance, w)) > 0.5);
            assert!(holds(&delayed, cell, |w| at(&lags, w)) > 0.5);
            holds(&(one * TaylorModel::relative_frequency(cell)), cell, |w| at(&resonance, w) * (w / cell.middle()));
            holds(&(one * delayed - one), cell, |w| at(&resonance, w) * (at(&lags, w) - 1.0));
            holds(&delayed.disc(), cell, |w| at(&lags, w));
        }
    }

    #[test]
    fn a_cell_with_a_pole_has_no_bound() {
        let integrator = TransferFunction::new(vec![1.0], vec![0.0, 1.0], 0.0).unwrap();
        assert_eq!(TaylorModel::rational(&integrator, Cell { low: 0.0, high: 1.0 }).remainder, f64::INFINITY);
        let oscillator = TransferFunction::new(vec![1.0], vec![1.0, 0.0, 1.0], 0.0).unwrap();
        assert_eq!(TaylorModel::rational(&oscillator, Cell { low: 0.9, high: 1.2 }).remainder, f64::INFINITY);
    }
}
