//! Searches for the least cost in a box: gradient, genetic and simplex. Each asks for one point at a time, so that it can be run in
//! slices of any length, shown while it runs, and ended at any time.

mod genetic;
mod gradient;
mod simplex;

pub use genetic::{Genetic, GeneticSettings};
pub use gradient::Gradient;
pub use simplex::NelderMead;

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// How a coordinate of a box is divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum AxisScale {
    /// Evenly.
    Linear,
    /// Evenly in the logarithm; both limits are positive.
    Logarithmic,
}

/// One coordinate of a box.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Axis {
    /// Lower limit.
    pub low: f64,
    /// Upper limit.
    pub high: f64,
    /// How it is divided.
    pub scale: AxisScale,
}

/// A box that cannot be searched.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("an axis from {low} to {high} cannot be searched")]
pub struct AxisError {
    /// Its lower limit.
    pub low: f64,
    /// Its upper limit.
    pub high: f64,
}

impl Axis {
    /// Refuses an axis without length, and a logarithmic one that does not begin above 0.
    ///
    /// # Errors
    /// [`AxisError`] with the limits.
    pub fn check(&self) -> Result<(), AxisError> {
        let fits = self.low < self.high && self.low.is_finite() && self.high.is_finite();
        if fits && (self.scale == AxisScale::Linear || self.low > 0.0) {
            Ok(())
        } else {
            Err(AxisError { low: self.low, high: self.high })
        }
    }

    /// The value at a share of the axis, 0 to 1, which is exact at both ends.
    pub fn at(&self, share: f64) -> f64 {
        if share <= 0.0 {
            return self.low;
        }
        if share >= 1.0 {
            return self.high;
        }
        match self.scale {
            AxisScale::Linear => self.low + share * (self.high - self.low),
            AxisScale::Logarithmic => self.low * (share * (self.high / self.low).ln()).exp(),
        }
    }

    /// The share of the axis at which a value is, within 0 to 1.
    pub fn share(&self, value: f64) -> f64 {
        let share = match self.scale {
            AxisScale::Linear => (value - self.low) / (self.high - self.low),
            AxisScale::Logarithmic => (value.max(self.low) / self.low).ln() / (self.high / self.low).ln(),
        };
        share.clamp(0.0, 1.0)
    }
}

/// A point with its cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evaluated<const N: usize> {
    /// The point.
    pub point: [f64; N],
    /// Its cost.
    pub cost: f64,
}

/// A search that asks for the cost of one point after the other.
pub trait Search<const N: usize> {
    /// The next point to be evaluated, the same until [`tell`](Self::tell); `None` when the search has ended.
    fn ask(&mut self) -> Option<[f64; N]>;

    /// Takes the cost of the point that [`ask`](Self::ask) returned last. NaN counts as an infinite cost.
    fn tell(&mut self, cost: f64);

    /// The best point so far.
    fn best(&self) -> Option<Evaluated<N>>;

    /// Points at which the search stood, for a picture: one for each step, generation or simplex.
    fn path(&self) -> &[Evaluated<N>];
}

/// Lets a search evaluate up to `budget` points; says whether it goes on.
///
/// ```
/// use quadtank::tuning::search::{Axis, AxisScale, NelderMead, Search, advance};
///
/// let axis = Axis { low: -2.0, high: 2.0, scale: AxisScale::Linear };
/// let mut search = NelderMead::new([axis; 2], [-1.5, 1.0])?;
/// while advance(&mut search, 20, |[x, y]| (x - 1.0).powi(2) + 10.0 * (y - x * x).powi(2)) {}
/// let best = search.best().expect("it has evaluated points");
/// assert!((best.point[0] - 1.0).abs() < 1e-3 && (best.point[1] - 1.0).abs() < 1e-3);
/// # Ok::<(), quadtank::tuning::search::AxisError>(())
/// ```
pub fn advance<const N: usize>(
    search: &mut impl Search<N>,
    budget: usize,
    mut cost: impl FnMut([f64; N]) -> f64,
) -> bool {
    for _ in 0..budget {
        let Some(point) = search.ask() else { return false };
        search.tell(cost(point));
    }
    search.ask().is_some()
}

/// A box in shares of its axes, in which the searches work, with the best point so far and the path.
#[derive(Clone, Debug)]
struct Record<const N: usize> {
    axes: [Axis; N],
    best: Option<Evaluated<N>>,
    path: Vec<Evaluated<N>>,
    evaluations: usize,
}

impl<const N: usize> Record<N> {
    fn new(axes: [Axis; N]) -> Result<Self, AxisError> {
        axes.iter().try_for_each(Axis::check)?;
        Ok(Self { axes, best: None, path: Vec::new(), evaluations: 0 })
    }

    fn point(&self, shares: &[f64; N]) -> [f64; N] {
        std::array::from_fn(|i| self.axes[i].at(shares[i]))
    }

    fn shares(&self, point: &[f64; N]) -> [f64; N] {
        std::array::from_fn(|i| self.axes[i].share(point[i]))
    }

    /// Takes note of a cost; what is not a number comes back as infinity.
    fn note(&mut self, shares: &[f64; N], cost: f64) -> f64 {
        let cost = if cost.is_nan() { f64::INFINITY } else { cost };
        self.evaluations += 1;
        if self.best.is_none_or(|best| cost < best.cost) {
            self.best = Some(Evaluated { point: self.point(shares), cost });
        }
        cost
    }

    fn pass(&mut self, shares: &[f64; N], cost: f64) {
        let point = self.point(shares);
        self.path.push(Evaluated { point, cost });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Andreis (2017, Eq. 45).
    fn waves([x]: [f64; 1]) -> f64 {
        1.0 + x.cos() * (6.0 * x).cos()
    }

    const AXIS: Axis = Axis { low: 0.0, high: 3.0, scale: AxisScale::Linear };

    fn run<const N: usize>(search: &mut impl Search<N>, cost: impl Fn([f64; N]) -> f64) -> Evaluated<N> {
        while advance(search, 7, &cost) {}
        search.best().unwrap()
    }

    #[test]
    fn axes_are_exact_at_their_ends_and_invert() {
        let axis = Axis { low: 0.2, high: 100.0, scale: AxisScale::Logarithmic };
        assert_eq!((axis.at(0.0), axis.at(1.0), axis.share(0.1), axis.share(200.0)), (0.2, 100.0, 0.0, 1.0));
        assert!((axis.share(axis.at(0.3)) - 0.3).abs() < 1e-15);
        assert!(Axis { low: 0.0, ..axis }.check().is_err() && Axis { low: 100.0, ..axis }.check().is_err());
        assert!(Axis { high: f64::NAN, ..axis }.check().is_err());
        assert!(NelderMead::new([Axis { low: 1.0, high: 1.0, ..axis }], [1.0]).is_err());
    }

    #[test]
    fn a_gradient_ends_in_the_valley_where_it_starts_and_a_population_in_the_deepest() {
        let local = run(&mut Gradient::new([AXIS], [2.6]).unwrap(), waves);
        let global = run(&mut Gradient::new([AXIS], [1.0]).unwrap(), waves);
        let genetic = run(
            &mut Genetic::new([AXIS], GeneticSettings { generations: 60, ..GeneticSettings::default() }).unwrap(),
            waves,
        );
        let simplex = run(&mut NelderMead::new([AXIS], [0.7]).unwrap(), waves);
        for (found, x, f) in
            [(local, 2.1371, 0.4810), (global, 0.5082, 0.1301), (genetic, 0.5082, 0.1301), (simplex, 0.5082, 0.1301)]
        {
            assert!((found.point[0] - x).abs() < 1e-3 && (found.cost - f).abs() < 0.5e-4, "{found:?}");
        }
    }

    #[test]
    fn a_minimum_on_the_border_is_found_there() {
        let axes = [
            Axis { low: 0.2, high: 100.0, scale: AxisScale::Logarithmic },
            Axis { low: 0.6, high: 6000.0, scale: AxisScale::Logarithmic },
        ];
        let slope = |[x, y]: [f64; 2]| x.ln() - 0.3 * y.ln() + 0.1 * (x.ln() * y.ln()).sin();
        let genetic = run(&mut Genetic::new(axes, GeneticSettings::default()).unwrap(), slope);
        for found in [
            run(&mut Gradient::new(axes, [49.9, 2999.7]).unwrap(), slope),
            run(&mut NelderMead::new(axes, [2.0, 300.0]).unwrap(), slope),
        ] {
            assert!(found.cost <= genetic.cost + 0.3, "{found:?} {genetic:?}");
        }
        assert!((genetic.point[0] - 0.2).abs() < 0.02, "{genetic:?}");
    }

    #[test]
    fn slices_of_any_length_give_the_same_search() {
        let axes = [AXIS; 2];
        let cost = |[x, y]: [f64; 2]| waves([x]) + (y - 1.2).powi(2);
        let whole = |search: &mut dyn FnMut(usize) -> bool, slice: usize| while search(slice) {};
        for slice in [1, 13, 10_000] {
            let mut a = Genetic::new(axes, GeneticSettings::default()).unwrap();
            let mut b = a.clone();
            whole(&mut |n| advance(&mut a, n, cost), slice);
            whole(&mut |n| advance(&mut b, n, cost), 100);
            assert_eq!(a.best(), b.best());
            let mut a = NelderMead::new(axes, [2.0, 2.0]).unwrap();
            let mut b = a.clone();
            whole(&mut |n| advance(&mut a, n, cost), slice);
            whole(&mut |n| advance(&mut b, n, cost), 100);
            assert_eq!((a.best(), a.path()), (b.best(), b.path()));
        }
    }

    #[test]
    fn costs_that_are_no_numbers_are_avoided() {
        let cost = |[x]: [f64; 1]| if x > 1.0 { f64::NAN } else { (x - 0.4).powi(2) };
        for found in [
            run(&mut NelderMead::new([AXIS], [0.9]).unwrap(), cost),
            run(&mut Gradient::new([AXIS], [0.9]).unwrap(), cost),
            run(&mut Genetic::new([AXIS], GeneticSettings::default()).unwrap(), cost),
        ] {
            assert!((found.point[0] - 0.4).abs() < 1e-3, "{found:?}");
        }
        // Nothing but nothing: every search ends.
        let none = |_: [f64; 1]| f64::NAN;
        assert_eq!(run(&mut NelderMead::new([AXIS], [0.9]).unwrap(), none).cost, f64::INFINITY);
        assert_eq!(run(&mut Gradient::new([AXIS], [0.9]).unwrap(), none).cost, f64::INFINITY);
    }
}
