use crate::sim::level::LevelRunError;
use crate::tuning::search::{Axis, AxisError};
use crate::tuning::{Evaluation, LevelProblem};

use super::LevelLoopSetup;

/// Size of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ContourSettings {
    /// Gains and integral times, 2 to 200 of each.
    pub size: [usize; 2],
}

/// The cost over gain and integral time, computed cell by cell, so that a page can do it in slices and end it.
///
/// The first cells are a coarse grid over all of the map, the later ones fill it, so that it can be shown while it is computed.
#[derive(Clone, Debug)]
pub struct ContourMap {
    problem: LevelProblem,
    axes: [Axis; 2],
    size: [usize; 2],
    order: Vec<usize>,
    /// Worth of each cell, by gain first, as far as it is known.
    cells: Vec<Option<Evaluation>>,
    done: usize,
}

/// Stride of the coarse grid.
const STRIDE: usize = 4;

impl ContourMap {
    /// Prepares the map of the cost of a setup over the box of its search.
    ///
    /// # Errors
    /// [`LevelRunError`] for a loop without a run; a box that cannot be searched is one of `gain` or `integral_time_s`.
    pub fn new(setup: &LevelLoopSetup, settings: ContourSettings) -> Result<Self, LevelRunError> {
        let problem = LevelProblem::new(&setup.plant(), &setup.experiment, setup.cost(), setup.anti_windup())?;
        let axes = setup.search.axes();
        for (axis, field) in axes.iter().zip(["gain", "integral_time_s"]) {
            axis.check().map_err(|AxisError { low, .. }| LevelRunError::OutOfRange { field, value: low })?;
        }
        let size = settings.size.map(|count| count.clamp(2, 200));
        let count = size[0] * size[1];
        let is_coarse =
            |cell: &usize| (cell % size[0]).is_multiple_of(STRIDE) && (cell / size[0]).is_multiple_of(STRIDE);
        let (mut order, rest): (Vec<usize>, Vec<usize>) = (0..count).partition(is_coarse);
        order.extend(rest);
        Ok(Self { problem, axes, size, order, cells: vec![None; count], done: 0 })
    }

    /// Computes up to so many cells; says whether some are left.
    pub fn advance(&mut self, budget: usize) -> bool {
        for _ in 0..budget {
            let Some(&cell) = self.order.get(self.done) else { return false };
            self.cells[cell] = Some(self.problem.evaluate(self.settings_of(cell)));
            self.done += 1;
        }
        self.done < self.order.len()
    }

    /// Share of the cells that are done.
    pub fn progress(&self) -> f64 {
        self.done as f64 / self.order.len() as f64
    }

    /// Number of gains and of integral times.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Gain and integral time (s) of a cell; its index counts gains first.
    pub fn settings_of(&self, cell: usize) -> [f64; 2] {
        let at = [cell % self.size[0], cell / self.size[0]];
        [0, 1].map(|axis| self.axes[axis].at(at[axis] as f64 / (self.size[axis] - 1) as f64))
    }

    /// Worth of each cell, gains first; `None` where it is not computed yet.
    pub fn cells(&self) -> &[Option<Evaluation>] {
        &self.cells
    }

    /// The best cell so far, with its cost.
    pub fn best(&self) -> Option<(usize, f64)> {
        let costs = self.cells.iter().enumerate().filter_map(|(cell, evaluation)| match evaluation {
            Some(Evaluation::Cost(cost)) if cost.is_finite() => Some((cell, *cost)),
            _ => None,
        });
        costs.min_by(|a, b| a.1.total_cmp(&b.1))
    }
}
