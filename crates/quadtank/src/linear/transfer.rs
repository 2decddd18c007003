use nalgebra::{DMatrix, Matrix2};

use super::{Complex, LinearError, StateSpace, eigenvalues};

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
        let denominator = time_constants.iter().fold(vec![1.0], |so_far, &t| product(&so_far, &[1.0, t]));
        Self::new(vec![gain], denominator, dead_time)
    }

    /// Coefficients of b by rising powers of s.
    pub fn numerator(&self) -> &[f64] {
        &self.numerator
    }

    /// Coefficients of a by rising powers of s.
    pub fn denominator(&self) -> &[f64] {
        &self.denominator
    }

    /// Dead time θ.
    pub fn dead_time(&self) -> f64 {
        self.dead_time
    }

    /// Degree of a(s).
    fn order(&self) -> usize {
        degree(&self.denominator).unwrap_or(0)
    }

    /// `self · other`: one after the other.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        Self {
            numerator: product(&self.numerator, &other.numerator),
            denominator: product(&self.denominator, &other.denominator),
            dead_time: self.dead_time + other.dead_time,
        }
    }

    /// `factor · self`.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self { numerator: self.numerator.iter().map(|c| c * factor).collect(), ..self.clone() }
    }

    /// `self / other`.
    ///
    /// # Errors
    /// [`LinearError::OutOfRange`] when `other` is zero, or when its dead time is the longer one: the quotient would have
    /// to know the future.
    pub fn over(&self, other: &Self) -> Result<Self, LinearError> {
        let denominator = product(&self.denominator, &other.numerator);
        Self::new(product(&self.numerator, &other.denominator), denominator, self.dead_time - other.dead_time)
    }

    /// Poles of a(s), by rising real part.
    ///
    /// # Errors
    /// [`LinearError::NoConvergence`] as [`eigenvalues`].
    pub fn poles(&self) -> Result<Vec<Complex>, LinearError> {
        eigenvalues(&self.companion())
    }

    /// Controllable form, with as many states as the denominator has degrees.
    ///
    /// # Errors
    /// [`LinearError::OutOfRange`] with a dead time, which no finite number of states has, or with the relative degree
    /// when the element is not proper.
    pub fn state_space(&self) -> Result<StateSpace, LinearError> {
        if self.dead_time != 0.0 {
            return Err(LinearError::OutOfRange { field: "dead_time", value: self.dead_time });
        }
        let n = self.order();
        let m = degree(&self.numerator).unwrap_or(0);
        if m > n {
            return Err(LinearError::OutOfRange { field: "relative_degree", value: n as f64 - m as f64 });
        }
        let leading = self.denominator[n];
        let beta = |k: usize| self.numerator.get(k).copied().unwrap_or(0.0) / leading;
        let through = beta(n);
        let b = DMatrix::from_fn(n, 1, |row, _| if row + 1 == n { 1.0 } else { 0.0 });
        let c = DMatrix::from_fn(1, n, |_, k| beta(k) - through * self.denominator[k] / leading);
        StateSpace::new(self.companion(), b, c, DMatrix::from_element(1, 1, through))
    }

    /// The companion matrix of a(s).
    fn companion(&self) -> DMatrix<f64> {
        let n = self.order();
        let leading = self.denominator[n];
        DMatrix::from_fn(n, n, |row, column| {
            let chain = if column == row + 1 { 1.0 } else { 0.0 };
            if row + 1 == n { -self.denominator[column] / leading } else { chain }
        })
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

/// Degree of a polynomial by rising powers; `None` for zero.
pub(crate) fn degree(coefficients: &[f64]) -> Option<usize> {
    coefficients.iter().rposition(|&c| c != 0.0)
}

/// Lowest power of a polynomial by rising powers; `None` for zero.
pub(crate) fn lowest_power(coefficients: &[f64]) -> Option<usize> {
    coefficients.iter().position(|&c| c != 0.0)
}

/// Coefficients of the product of two polynomials.
pub(super) fn product(p: &[f64], q: &[f64]) -> Vec<f64> {
    let mut result = vec![0.0; (p.len() + q.len()).saturating_sub(1)];
    for (i, a) in p.iter().enumerate() {
        for (j, b) in q.iter().enumerate() {
            result[i + j] += a * b;
        }
    }
    result
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

    /// The same plant with its inputs exchanged, for the off-diagonal pairing.
    #[must_use]
    pub fn swapped(&self) -> Self {
        Self(self.0.clone().map(|[first, second]| [second, first]))
    }

    /// With one more element after every path, such as a dead time or the lag of a pump or a sensor.
    #[must_use]
    pub fn followed_by(&self, element: &TransferFunction) -> Self {
        Self(self.0.clone().map(|row| row.map(|path| path.times(element))))
    }

    /// State space, one controllable form for each element; poles that elements share stand there for each of them.
    ///
    /// # Errors
    /// As [`TransferFunction::state_space`].
    pub fn state_space(&self) -> Result<StateSpace, LinearError> {
        let [[g11, g12], [g21, g22]] = &self.0;
        let models = [g11.state_space()?, g12.state_space()?, g21.state_space()?, g22.state_space()?];
        let n = models.iter().map(StateSpace::order).sum();
        let (mut a, mut b) = (DMatrix::zeros(n, n), DMatrix::zeros(n, 2));
        let (mut c, mut d) = (DMatrix::zeros(2, n), DMatrix::zeros(2, 2));
        let mut first = 0;
        for (index, model) in models.iter().enumerate() {
            let (row, column, order) = (index / 2, index % 2, model.order());
            a.view_mut((first, first), (order, order)).copy_from(&model.a);
            b.view_mut((first, column), (order, 1)).copy_from(&model.b);
            c.view_mut((row, first), (1, order)).copy_from(&model.c);
            d[(row, column)] = model.d[0];
            first += order;
        }
        StateSpace::new(a, b, c, d)
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
    fn products_and_quotients_are_those_of_the_values() {
        let f = TransferFunction::lags(2.0, &[1.0, 3.0], 2.5).unwrap();
        let g = TransferFunction::new(vec![1.0, -4.0], vec![1.0, 0.5, 2.0], 1.0).unwrap();
        let s = Complex::new(0.1, 0.7);
        assert_relative_eq!((f.times(&g).at(s) - f.at(s) * g.at(s)).norm(), 0.0, epsilon = 1e-15);
        assert_relative_eq!((f.over(&g).unwrap().at(s) - f.at(s) / g.at(s)).norm(), 0.0, epsilon = 1e-14);
        assert_eq!(g.over(&f), Err(LinearError::OutOfRange { field: "dead_time", value: -1.5 }));
        let poles = f.poles().unwrap();
        assert_relative_eq!(poles[0].re, -1.0, max_relative = 1e-14);
        assert_relative_eq!(poles[1].re, -1.0 / 3.0, max_relative = 1e-14);
    }

    #[test]
    fn the_state_space_has_the_response_of_the_elements() {
        let g = |n: &[f64], d: &[f64]| TransferFunction::new(n.to_vec(), d.to_vec(), 0.0).unwrap();
        let plant = TransferMatrix([
            [g(&[2.0], &[1.0, 3.0]), g(&[1.0, -1.0], &[1.0, 2.0, 0.5])],
            [g(&[1.0, 0.0, 2.0], &[1.0, 0.3, 4.0, 0.0]), g(&[0.7], &[1.0])],
        ]);
        let model = plant.state_space().unwrap();
        assert_eq!(model.order(), 5);
        for w in [0.0, 0.2, 1.0, 6.0] {
            let s = Complex::new(0.0, w);
            let expected = plant.at(s);
            let direct = model.frequency_response(w).unwrap();
            assert!((0..4).all(|i| (direct[(i / 2, i % 2)] - expected[(i / 2, i % 2)]).norm() < 1e-13));
        }
        assert_eq!(plant.swapped().at(Complex::ZERO)[(0, 0)], Complex::from(1.0));
    }

    #[test]
    fn a_dead_time_has_no_state_space() {
        let delay = TransferFunction::new(vec![1.0], vec![1.0], 0.5).unwrap();
        let plant = TransferMatrix([[delay.clone(), delay.clone()], [delay.clone(), delay.clone()]]);
        assert_eq!(plant.state_space(), Err(LinearError::OutOfRange { field: "dead_time", value: 0.5 }));
        let twice = plant.followed_by(&delay);
        assert_eq!(twice.0[0][1].dead_time(), 1.0);
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
