//! Transfer functions near s = 0 as power series: what an integrating plant is at rest, where its value is not finite.

use std::ops::{Add, Mul, Sub};

use nalgebra::Matrix2;

use super::{TransferFunction, TransferMatrix};

/// Terms that are kept. A determinant of elements of the highest order that is simulated begins at s⁻¹⁶ at the lowest, and only terms
/// up to s⁰ matter.
const TERMS: usize = 17;
/// A coefficient of a sum below this share of its terms is rounding.
const ROUNDING: f64 = 1e-11;

/// `Σ c_k s^(lowest + k)`, exact up to its last term; `lowest` is of no meaning where all coefficients are zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Series {
    lowest: i32,
    coefficients: [f64; TERMS],
}

impl Series {
    pub(crate) const ZERO: Self = Self { lowest: 0, coefficients: [0.0; TERMS] };

    pub(crate) fn constant(value: f64) -> Self {
        let mut series = Self::ZERO;
        series.coefficients[0] = value;
        series
    }

    /// A transfer function, its dead time included.
    pub(crate) fn of(function: &TransferFunction) -> Self {
        let (Some(b), Some(a)) = (Self::polynomial(function.numerator()), Self::polynomial(function.denominator()))
        else {
            return Self::ZERO;
        };
        let mut quotient = Self { lowest: b.lowest - a.lowest, ..Self::ZERO };
        for k in 0..TERMS {
            let known: f64 = (1..=k).map(|i| a.coefficients[i] * quotient.coefficients[k - i]).sum();
            quotient.coefficients[k] = (b.coefficients[k] - known) / a.coefficients[0];
        }
        let mut delay = Self::constant(1.0);
        for k in 1..TERMS {
            delay.coefficients[k] = delay.coefficients[k - 1] * -function.dead_time() / k as f64;
        }
        quotient * delay
    }

    /// A polynomial from its lowest power on; `None` for zero.
    fn polynomial(coefficients: &[f64]) -> Option<Self> {
        let first = coefficients.iter().position(|&c| c != 0.0)?;
        let mut series = Self { lowest: i32::try_from(first).unwrap_or(i32::MAX), ..Self::ZERO };
        for (kept, c) in series.coefficients.iter_mut().zip(&coefficients[first..]) {
            *kept = *c;
        }
        Some(series)
    }

    fn is_zero(&self) -> bool {
        self.coefficients.iter().all(|&c| c == 0.0)
    }

    /// Coefficient and power of the first term that is not zero.
    pub(crate) fn leading(&self) -> Option<(f64, i32)> {
        let k = self.coefficients.iter().position(|&c| c != 0.0)?;
        Some((self.coefficients[k], self.lowest + i32::try_from(k).unwrap_or(i32::MAX)))
    }

    /// Coefficient of a power.
    pub(crate) fn coefficient(&self, power: i32) -> f64 {
        let index = usize::try_from(power - self.lowest).ok();
        index.and_then(|index| self.coefficients.get(index)).copied().unwrap_or(0.0)
    }

    /// Order of the pole at the origin; 0 where there is none.
    pub(crate) fn pole_order(&self) -> u32 {
        self.leading().map_or(0, |(_, power)| u32::try_from(-power).unwrap_or(0))
    }
}

impl Add for Series {
    type Output = Self;

    /// The sum, without what rounding leaves where terms cancel.
    fn add(self, other: Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return if self.is_zero() { other } else { self };
        }
        let lowest = self.lowest.min(other.lowest);
        let mut sum = Self { lowest, ..Self::ZERO };
        for (power, c) in (lowest..).zip(&mut sum.coefficients) {
            let (x, y) = (self.coefficient(power), other.coefficient(power));
            *c = if (x + y).abs() <= ROUNDING * (x.abs() + y.abs()) { 0.0 } else { x + y };
        }
        sum
    }
}

impl Sub for Series {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + other * -1.0
    }
}

impl Mul for Series {
    type Output = Self;

    #[expect(clippy::suspicious_arithmetic_impl, reason = "powers add up in a product")]
    fn mul(self, other: Self) -> Self {
        let at = |k: usize| (0..=k).map(|i| self.coefficients[i] * other.coefficients[k - i]).sum();
        Self { lowest: self.lowest + other.lowest, coefficients: std::array::from_fn(at) }
    }
}

impl Mul<f64> for Series {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self { coefficients: self.coefficients.map(|c| c * factor), ..self }
    }
}

/// The elements of a matrix.
pub(crate) fn elements(matrix: &TransferMatrix) -> Matrix2<Series> {
    Matrix2::from_fn(|row, column| Series::of(&matrix.0[row][column]))
}

pub(crate) fn determinant(matrix: &Matrix2<Series>) -> Series {
    matrix[(0, 0)] * matrix[(1, 1)] - matrix[(0, 1)] * matrix[(1, 0)]
}

/// `det(I + G K)` of series.
pub(crate) fn return_difference(g: &Matrix2<Series>, k: &Matrix2<Series>) -> Series {
    let trace = (0..2)
        .flat_map(|row| (0..2).map(move |column| (row, column)))
        .fold(Series::ZERO, |sum, (row, column)| sum + g[(row, column)] * k[(column, row)]);
    Series::constant(1.0) + trace + determinant(g) * determinant(k)
}
