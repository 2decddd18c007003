//! What a plant is at both ends of the frequency axis: at rest, where integrating elements are infinite, and at infinite frequency,
//! where biproper ones pass their input straight on.

use nalgebra::Matrix2;

use super::series;
use super::transfer::{degree, lowest_power};
use super::{TransferFunction, TransferMatrix};

impl TransferFunction {
    /// Order of the pole at the origin, of what numerator and denominator do not share there: how often the element integrates.
    pub fn integrators(&self) -> u32 {
        match (lowest_power(self.numerator()), lowest_power(self.denominator())) {
            (Some(zeros), Some(poles)) => u32::try_from(poles.saturating_sub(zeros)).unwrap_or(u32::MAX),
            _ => 0,
        }
    }

    /// `lim s^n g(s)` for s → 0, with n the number of [`integrators`](Self::integrators): the gain at rest g(0), or the rate at which
    /// the output rises under a constant input of 1.
    pub fn rest_gain(&self) -> f64 {
        match (lowest_power(self.numerator()), lowest_power(self.denominator())) {
            (Some(zeros), Some(poles)) if zeros <= poles => self.numerator()[zeros] / self.denominator()[poles],
            _ => 0.0,
        }
    }

    /// Direct feedthrough: the gain of the rational part at infinite frequency. 0 for a strictly proper element, infinite for an
    /// improper one.
    pub fn feedthrough(&self) -> f64 {
        match (degree(self.numerator()), degree(self.denominator())) {
            (Some(b), Some(a)) if b > a => f64::INFINITY.copysign(self.numerator()[b] / self.denominator()[a]),
            (Some(b), Some(a)) if b == a => self.numerator()[b] / self.denominator()[a],
            _ => 0.0,
        }
    }

    /// The element without its direct feedthrough, which must be finite.
    pub(super) fn strictly_proper(&self) -> Self {
        let through = self.feedthrough();
        if through == 0.0 {
            return self.clone();
        }
        let n = degree(self.denominator()).unwrap_or(0);
        let rest = |k: usize| self.numerator().get(k).copied().unwrap_or(0.0) - through * self.denominator()[k];
        let numerator = (0..n.max(1)).map(|k| if k < n { rest(k) } else { 0.0 }).collect();
        Self::new(numerator, self.denominator().to_vec(), self.dead_time()).unwrap_or_else(|_| self.scaled(0.0))
    }
}

impl TransferMatrix {
    /// Whether an element has a pole at the origin, so that G(0) is infinite.
    pub fn is_integrating(&self) -> bool {
        self.0.as_flattened().iter().any(|g| g.integrators() > 0)
    }

    /// Poles at the origin of a minimal realisation: as many as an element or det G has.
    pub fn integrators(&self) -> u32 {
        let of_elements = self.0.as_flattened().iter().map(TransferFunction::integrators).max().unwrap_or(0);
        if of_elements == 0 {
            return 0;
        }
        of_elements.max(series::determinant(&series::elements(self)).pole_order())
    }

    /// Gains at rest that have the signs, the relative gains and the Niederlinski index of the plant: G(0), or for an integrating plant
    /// the gains and rates `lim s^n g(s)`. There the pair of elements, `g11 g22` or `g12 g21`, whose product is infinitely smaller
    /// for s → 0 than that of the other pair is zero: in the limit it has no part in det G.
    pub fn rest_gain(&self) -> Matrix2<f64> {
        if !self.is_integrating() {
            return self.dc_gain();
        }
        let TransferMatrix([[a, b], [c, d]]) = self;
        let order = |one: &TransferFunction, other: &TransferFunction| {
            let leading = series::Series::of(&one.times(other)).leading();
            leading.map_or(i32::MAX, |(_, power)| power)
        };
        let (main, cross) = (order(a, d), order(b, c));
        Matrix2::from_fn(|row, column| {
            let (own, other) = if row == column { (main, cross) } else { (cross, main) };
            if own > other { 0.0 } else { self.0[row][column].rest_gain() }
        })
    }

    /// Whether an element passes its input straight on, be it after a dead time.
    pub fn has_feedthrough(&self) -> bool {
        self.0.as_flattened().iter().any(|g| g.feedthrough() != 0.0)
    }

    /// Direct feedthrough of all elements, of those with a dead time too.
    pub fn feedthrough(&self) -> Matrix2<f64> {
        Matrix2::from_fn(|row, column| self.0[row][column].feedthrough())
    }

    /// What every output does at once when an input jumps: the direct feedthrough of elements without dead time.
    pub fn instant_gain(&self) -> Matrix2<f64> {
        Matrix2::from_fn(|row, column| {
            let element = &self.0[row][column];
            if element.dead_time() == 0.0 { element.feedthrough() } else { 0.0 }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn element(numerator: &[f64], denominator: &[f64], dead_time: f64) -> TransferFunction {
        TransferFunction::new(numerator.to_vec(), denominator.to_vec(), dead_time).unwrap()
    }

    #[test]
    fn gains_and_rates_at_rest() {
        // 3 (s + 2)/(s (s + 4)) rises by 1.5 in a unit of time; s (s + 1)/(s (s + 4)) does not integrate.
        let rising = element(&[6.0, 3.0], &[0.0, 4.0, 1.0], 0.7);
        assert_eq!((rising.integrators(), rising.rest_gain(), rising.feedthrough()), (1, 1.5, 0.0));
        let cancelled = element(&[0.0, 1.0, 1.0], &[0.0, 4.0, 1.0], 0.0);
        assert_eq!((cancelled.integrators(), cancelled.rest_gain(), cancelled.feedthrough()), (0, 0.25, 1.0));
        assert_eq!(element(&[1.0, 0.0, 2.0], &[4.0, 1.0], 0.0).feedthrough(), f64::INFINITY);
        let zero = element(&[0.0], &[0.0, 1.0], 0.0);
        assert_eq!((zero.integrators(), zero.rest_gain(), zero.feedthrough()), (0, 0.0, 0.0));
    }

    #[test]
    fn the_part_that_is_left_of_a_biproper_element_is_strictly_proper() {
        // (s + 1)/(s + 5) = 1 − 4/(s + 5).
        let left = element(&[1.0, 1.0], &[5.0, 1.0], 0.0).strictly_proper();
        assert_eq!((left.numerator(), left.feedthrough()), (&[-4.0][..], 0.0));
        assert_eq!(element(&[3.0], &[2.0], 0.0).strictly_proper().numerator(), [0.0]);
    }

    #[test]
    fn poles_at_the_origin_are_those_of_a_minimal_realisation() {
        let [one, half, lag] =
            [element(&[1.0], &[0.0, 1.0], 2.0), element(&[0.5], &[0.0, 1.0], 0.3), element(&[4.0], &[1.0, 3.0], 1.0)];
        let count = |[a, b, c, d]: [&TransferFunction; 4]| {
            TransferMatrix([[a.clone(), b.clone()], [c.clone(), d.clone()]]).integrators()
        };
        assert_eq!(count([&one, &half, &half, &one]), 2);
        assert_eq!(count([&one, &lag, &lag, &one]), 2);
        // Equal rates: det G has one pole at the origin because of its dead times, and none without them.
        assert_eq!(count([&one, &one, &one, &one]), 1);
        let late = element(&[1.0], &[0.0, 1.0], 5.0);
        assert_eq!(count([&one, &one, &one, &late]), 1);
        assert_eq!(count([&lag, &one, &lag, &lag]), 1);
        assert_eq!(count([&lag, &lag, &lag, &lag]), 0);
    }

    #[test]
    fn a_pair_of_elements_that_vanishes_in_the_limit_is_zero() {
        let integrator = |rate: f64| element(&[rate], &[0.0, 1.0], 0.0);
        let lag = |gain: f64| element(&[gain], &[1.0, 3.0], 1.0);
        let all = TransferMatrix([[integrator(2.0), integrator(1.0)], [integrator(-1.0), integrator(3.0)]]);
        assert_eq!(all.rest_gain(), Matrix2::new(2.0, 1.0, -1.0, 3.0));
        let column = TransferMatrix([[integrator(2.0), lag(1.0)], [integrator(-1.0), lag(3.0)]]);
        assert_eq!(column.rest_gain(), Matrix2::new(2.0, 1.0, -1.0, 3.0));
        let diagonal = TransferMatrix([[integrator(2.0), lag(1.0)], [lag(-1.0), integrator(3.0)]]);
        assert_eq!(diagonal.rest_gain(), Matrix2::new(2.0, 0.0, 0.0, 3.0));
        let cross = TransferMatrix([[lag(2.0), integrator(1.0)], [integrator(-1.0), lag(3.0)]]);
        assert_eq!(cross.rest_gain(), Matrix2::new(0.0, 1.0, -1.0, 0.0));
    }
}
