use nalgebra::Matrix2;

use super::{Complex, LinearError};

/// A rational transfer function with a dead time, `g(s) = b(s)/a(s) e^(−θ s)`. The unit of time is that of the plant.
#[derive(Clone, Debug, PartialEq)]
pub struct TransferFunction {
    /// Coefficients of b by rising powers of s.
    numerator: Vec<f64>,
    /// Coefficients of a by rising powers of s.
    denominator: Vec<f64>,
    dead_time: f64,
}

impl TransferFunction {
    /// From the coefficients of b and a by rising powers of s, and the dead time θ.
    ///
    /// # Errors
    /// [`LinearError::OutOfRange`] when a coefficient is not finite, the denominator is zero, or the dead time is
    /// negative or not finite.
    pub fn new(numerator: Vec<f64>, denominator: Vec<f64>, dead_time: f64) -> Result<Self, LinearError> {
        let odd = |coefficients: &[f64]| coefficients.iter().copied().find(|c| !c.is_finite());
        if let Some(value) = odd(&numerator) {
            return Err(LinearError::OutOfRange { field: "numerator", value });
        }
        if let Some(value) = odd(&denominator).or(denominator.iter().all(|&c| c == 0.0).then_some(0.0)) {
            return Err(LinearError::OutOfRange { field: "denominator", value });
        }
        if !(dead_time >= 0.0 && dead_time.is_finite()) {
            return Err(LinearError::OutOfRange { field: "dead_time", value: dead_time });
        }
        Ok(Self { numerator, denominator, dead_time })
    }

    /// `gain e^(−θ s)/((T1 s + 1)(T2 s + 1)…)`.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn lags(gain: f64, time_constants: &[f64], dead_time: f64) -> Result<Self, LinearError> {
        let denominator = time_constants.iter().fold(vec![1.0], |product, &t| {
            let mut next = product.clone();
            next.push(0.0);
            for (power, &c) in product.iter().enumerate() {
                next[power + 1] += t * c;
            }
            next
        });
        Self::new(vec![gain], denominator, dead_time)
    }

    /// Value at a point of the s-plane; not finite at a pole.
    pub fn at(&self, s: Complex) -> Complex {
        let horner = |c: &[f64]| c.iter().rev().fold(Complex::ZERO, |sum, &c| sum * s + c);
        horner(&self.numerator) / horner(&self.denominator) * (s * -self.dead_time).exp()
    }

    /// g(0); not finite for an integrating plant.
    pub fn dc_gain(&self) -> f64 {
        self.at(Complex::ZERO).re
    }
}

/// A plant with two inputs and two outputs, row by output.
#[derive(Clone, Debug, PartialEq)]
pub struct TransferMatrix(pub [[TransferFunction; 2]; 2]);

impl TransferMatrix {
    /// Value at a point of the s-plane.
    pub fn at(&self, s: Complex) -> Matrix2<Complex> {
        Matrix2::from_fn(|row, column| self.0[row][column].at(s))
    }

    /// G(0).
    pub fn dc_gain(&self) -> Matrix2<f64> {
        Matrix2::from_fn(|row, column| self.0[row][column].dc_gain())
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn lags_multiply_and_a_dead_time_turns() {
        let g = TransferFunction::lags(2.0, &[1.0, 3.0], 0.5).unwrap();
        let w = 0.7;
        let s = Complex::new(0.0, w);
        let expected = Complex::new(2.0, 0.0) / ((s + 1.0) * (s * 3.0 + 1.0)) * Complex::cis(-0.5 * w);
        assert_relative_eq!((g.at(s) - expected).norm(), 0.0, epsilon = 1e-15);
        assert_eq!(g.dc_gain(), 2.0);
    }

    #[test]
    fn what_is_no_transfer_function_is_refused_with_its_value() {
        let refused = |n: Vec<f64>, d: Vec<f64>, t: f64| TransferFunction::new(n, d, t).unwrap_err();
        assert_eq!(refused(vec![1.0], vec![0.0], 0.0), LinearError::OutOfRange { field: "denominator", value: 0.0 });
        assert_eq!(refused(vec![1.0], vec![1.0], -2.0), LinearError::OutOfRange { field: "dead_time", value: -2.0 });
        let infinite = LinearError::OutOfRange { field: "numerator", value: f64::INFINITY };
        assert_eq!(refused(vec![f64::INFINITY], vec![1.0], 0.0), infinite);
    }
}
