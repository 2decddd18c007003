use super::{Axis, AxisError, Evaluated, Record, Search};

/// Steepest descent in a box with a search along each direction (Andreis 2017, §2.6.1), in shares of the axes. Slopes are central
/// differences; a direction that leaves the box is projected on its border.
#[derive(Clone, Debug)]
pub struct Gradient<const N: usize> {
    record: Record<N>,
    here: ([f64; N], f64),
    slopes: [f64; N],
    /// Length of the last step.
    length: f64,
    stage: Stage,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Stage {
    Start,
    /// The cost ahead and, once that is known, behind along one axis.
    Slope {
        axis: usize,
        ahead: Option<f64>,
    },
    /// A step of a length along the direction; `best` is the best so far with its length.
    Line {
        length: f64,
        best: Option<(f64, f64)>,
    },
    Done,
}

/// Distance of the differences, in shares of an axis.
const DIFFERENCE: f64 = 1e-4;
/// Length of the first step.
const FIRST: f64 = 0.02;
/// Length of a step that is none.
const SMALL: f64 = 1e-7;
/// Relative improvement by a step that is none.
const FLAT: f64 = 1e-7;
/// Most evaluations.
const MOST: usize = 2_000;

impl<const N: usize> Gradient<N> {
    /// A search from a start.
    ///
    /// # Errors
    /// [`AxisError`] for a box that cannot be searched.
    pub fn new(axes: [Axis; N], start: [f64; N]) -> Result<Self, AxisError> {
        let record = Record::new(axes)?;
        let here = (record.shares(&start), f64::INFINITY);
        Ok(Self { record, here, slopes: [0.0; N], length: FIRST, stage: Stage::Start })
    }

    fn beside(&self, axis: usize, by: f64) -> [f64; N] {
        let mut point = self.here.0;
        point[axis] = (point[axis] + by).clamp(0.0, 1.0);
        point
    }

    /// The point at a length along the steepest descent.
    fn along(&self, length: f64) -> [f64; N] {
        let direction = self.direction();
        std::array::from_fn(|i| (self.here.0[i] + length * direction[i]).clamp(0.0, 1.0))
    }

    /// The steepest descent of unit length, without what leaves the box; zero where there is none.
    fn direction(&self) -> [f64; N] {
        let descent: [f64; N] = std::array::from_fn(|i| {
            let down = -self.slopes[i];
            let leaves = (self.here.0[i] <= 0.0 && down < 0.0) || (self.here.0[i] >= 1.0 && down > 0.0);
            if leaves || !down.is_finite() { 0.0 } else { down }
        });
        let size = descent.iter().map(|x| x * x).sum::<f64>().sqrt();
        if size > 0.0 { descent.map(|x| x / size) } else { [0.0; N] }
    }

    fn shares(&self) -> Option<[f64; N]> {
        Some(match self.stage {
            Stage::Start => self.here.0,
            Stage::Slope { axis, ahead: None } => self.beside(axis, DIFFERENCE),
            Stage::Slope { axis, ahead: Some(_) } => self.beside(axis, -DIFFERENCE),
            Stage::Line { length, .. } => self.along(length),
            Stage::Done => return None,
        })
    }

    /// Takes a step and looks for the next direction.
    fn step_to(&mut self, point: [f64; N], cost: f64) {
        let gained = self.here.1 - cost;
        self.here = (point, cost);
        self.record.pass(&point, cost);
        let spent = self.record.evaluations >= MOST || !cost.is_finite() || gained <= FLAT * cost.abs();
        self.stage = if spent { Stage::Done } else { Stage::Slope { axis: 0, ahead: None } };
    }

    fn line(&mut self, length: f64, best: Option<(f64, f64)>, cost: f64) {
        let improves = cost < best.map_or(self.here.1, |best| best.1);
        let reach = self.direction().iter().map(|x| x.abs()).fold(0.0, f64::max);
        self.stage = match (improves, best) {
            // Longer, until it no longer helps or the box ends.
            (true, _) if best.is_none_or(|best| best.0 < length) && length * reach < 1.0 => {
                Stage::Line { length: 2.0 * length, best: Some((length, cost)) }
            }
            (true, _) => return self.take(length, cost),
            (false, Some((best_length, best_cost))) if best_length < length => {
                // Between the best and the one that is too long.
                let middle = 0.75 * length;
                if middle > 1.05 * best_length && length > 1.6 * best_length {
                    Stage::Line { length: middle, best }
                } else {
                    return self.take(best_length, best_cost);
                }
            }
            (false, Some((best_length, best_cost))) => return self.take(best_length, best_cost),
            (false, None) if length < SMALL || self.record.evaluations >= MOST => Stage::Done,
            (false, None) => Stage::Line { length: 0.25 * length, best: None },
        };
    }

    fn take(&mut self, length: f64, cost: f64) {
        self.length = length;
        self.step_to(self.along(length), cost);
    }
}

impl<const N: usize> Search<N> for Gradient<N> {
    fn ask(&mut self) -> Option<[f64; N]> {
        self.shares().map(|shares| self.record.point(&shares))
    }

    fn tell(&mut self, cost: f64) {
        let Some(shares) = self.shares() else { return };
        let cost = self.record.note(&shares, cost);
        match self.stage {
            Stage::Start => self.step_to(shares, cost),
            Stage::Slope { axis, ahead: None } => self.stage = Stage::Slope { axis, ahead: Some(cost) },
            Stage::Slope { axis, ahead: Some(ahead) } => {
                let span = self.beside(axis, DIFFERENCE)[axis] - shares[axis];
                self.slopes[axis] = (ahead - cost) / span;
                self.stage = if axis + 1 < N {
                    Stage::Slope { axis: axis + 1, ahead: None }
                } else if self.direction() == [0.0; N] {
                    Stage::Done
                } else {
                    Stage::Line { length: self.length.max(1e-4), best: None }
                };
            }
            Stage::Line { length, best } => self.line(length, best, cost),
            Stage::Done => {}
        }
    }

    fn best(&self) -> Option<Evaluated<N>> {
        self.record.best
    }

    fn path(&self) -> &[Evaluated<N>] {
        &self.record.path
    }
}
