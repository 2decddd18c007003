use crate::FormulaFault;
use quadtank::study::relay_tuning::Element;

/// Highest degree of a polynomial, so that powers of powers have an end.
const MAX_DEGREE: usize = 32;
/// Largest magnitude of an exponent.
pub const MAX_EXPONENT: i32 = 16;

type Calculated = Result<Quotient, FormulaFault>;

/// A quotient of polynomials with a dead time, `b(s)/a(s) e^(−θ s)`; what a formula is worth.
#[derive(Clone, Debug, PartialEq)]
pub struct Quotient {
    /// Coefficients of b by rising powers of s; `[0]` for zero.
    numerator: Vec<f64>,
    /// Coefficients of a by rising powers of s; `[1]` for a polynomial.
    denominator: Vec<f64>,
    dead_time: f64,
}

impl Quotient {
    pub fn number(value: f64) -> Self {
        Self { numerator: vec![value], denominator: vec![1.0], dead_time: 0.0 }
    }

    /// The variable s.
    pub fn s() -> Self {
        Self { numerator: vec![0.0, 1.0], denominator: vec![1.0], dead_time: 0.0 }
    }

    /// From coefficients by rising powers of s.
    pub fn new(numerator: Vec<f64>, denominator: Vec<f64>, dead_time: f64) -> Calculated {
        let (mut numerator, mut denominator) = (trimmed(numerator), trimmed(denominator));
        for polynomial in [&numerator, &denominator] {
            if polynomial.iter().any(|c| !c.is_finite()) {
                return Err(FormulaFault::NotFinite);
            }
            let degree = polynomial.len() - 1;
            if degree > MAX_DEGREE {
                return Err(FormulaFault::DegreeTooHigh { degree, max: MAX_DEGREE });
            }
        }
        // A number below the line belongs to the numerator, so that sums of polynomials stay polynomials.
        if let [number] = denominator[..] {
            if number == 0.0 {
                return Err(FormulaFault::DivisionByZero);
            }
            for coefficient in &mut numerator {
                *coefficient /= number;
            }
            denominator = vec![1.0];
        }
        if dead_time < 0.0 {
            return Err(FormulaFault::Future { dead_time });
        }
        Ok(Self { numerator, denominator, dead_time })
    }

    /// The number that it is, if it is one.
    pub fn as_number(&self) -> Option<f64> {
        match (&self.numerator[..], &self.denominator[..]) {
            ([value], [_]) if self.dead_time == 0.0 => Some(*value),
            _ => None,
        }
    }

    fn is_zero(&self) -> bool {
        self.numerator == [0.0]
    }

    pub fn plus(&self, other: &Self) -> Calculated {
        match (self.is_zero(), other.is_zero()) {
            (true, _) => return Ok(other.clone()),
            (_, true) => return Ok(self.clone()),
            _ => {}
        }
        if self.dead_time != other.dead_time {
            return Err(FormulaFault::DifferentDeadTimes { first: self.dead_time, second: other.dead_time });
        }
        // A common denominator stays one.
        if self.denominator == other.denominator {
            return Self::new(sum(&self.numerator, &other.numerator), self.denominator.clone(), self.dead_time);
        }
        let crossed = sum(&product(&self.numerator, &other.denominator), &product(&other.numerator, &self.denominator));
        Self::new(crossed, product(&self.denominator, &other.denominator), self.dead_time)
    }

    pub fn negative(mut self) -> Self {
        for coefficient in &mut self.numerator {
            *coefficient = -*coefficient;
        }
        self
    }

    pub fn times(&self, other: &Self) -> Calculated {
        let numerator = product(&self.numerator, &other.numerator);
        let denominator = product(&self.denominator, &other.denominator);
        Self::new(numerator, denominator, self.dead_time + other.dead_time)
    }

    pub fn over(&self, other: &Self) -> Calculated {
        if other.is_zero() {
            return Err(FormulaFault::DivisionByZero);
        }
        let numerator = product(&self.numerator, &other.denominator);
        let denominator = product(&self.denominator, &other.numerator);
        Self::new(numerator, denominator, self.dead_time - other.dead_time)
    }

    /// A whole power.
    pub fn power(&self, exponent: f64) -> Calculated {
        let whole = (-MAX_EXPONENT..=MAX_EXPONENT).find(|&whole| f64::from(whole) == exponent);
        let whole = whole.ok_or(FormulaFault::Exponent { max: MAX_EXPONENT })?;
        let one = Self::number(1.0);
        let mut power = one.clone();
        for _ in 0..whole.unsigned_abs() {
            power = power.times(self)?;
        }
        if whole < 0 { one.over(&power) } else { Ok(power) }
    }

    /// `e` to the power of it, which is a dead time.
    pub fn exponential(&self) -> Calculated {
        match (&self.numerator[..], &self.denominator[..]) {
            _ if self.dead_time != 0.0 => Err(FormulaFault::NoDeadTime),
            ([0.0], _) => Ok(Self::number(1.0)),
            ([0.0, slope], [1.0]) => Self::new(vec![1.0], vec![1.0], -slope),
            _ => Err(FormulaFault::NoDeadTime),
        }
    }

    pub fn delayed(&self, dead_time: f64) -> Calculated {
        Self::new(self.numerator.clone(), self.denominator.clone(), self.dead_time + dead_time)
    }

    pub fn into_element(self) -> Element {
        Element { numerator: self.numerator, denominator: self.denominator, dead_time: self.dead_time }
    }
}

/// Without zeros in front of the highest power; one coefficient stays.
fn trimmed(mut polynomial: Vec<f64>) -> Vec<f64> {
    let length = polynomial.iter().rposition(|&c| c != 0.0).map_or(1, |degree| degree + 1);
    polynomial.resize(length, 0.0);
    polynomial
}

fn sum(p: &[f64], q: &[f64]) -> Vec<f64> {
    let coefficient = |of: &[f64], power: usize| of.get(power).copied().unwrap_or(0.0);
    (0..p.len().max(q.len())).map(|power| coefficient(p, power) + coefficient(q, power)).collect()
}

fn product(p: &[f64], q: &[f64]) -> Vec<f64> {
    let mut result = vec![0.0; p.len() + q.len() - 1];
    for (i, a) in p.iter().enumerate() {
        for (j, b) in q.iter().enumerate() {
            result[i + j] += a * b;
        }
    }
    result
}
