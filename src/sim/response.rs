//! The answer of one level to the first step of its reference, cut out of a run.

use serde::Serialize;

use crate::scalar::larger;

use super::experiment::Experiment;
use super::trajectory::Trajectory;

/// When a response stays within its band.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Settling {
    /// It settled this long after the step (s).
    After {
        /// Seconds after the step.
        time_s: f64,
    },
    /// It is still outside the band at the end of its window (see [`loop_metrics`]).
    Never,
}

/// A step response and what the other level did meanwhile. All slices have the rows of the window, from the step on.
pub(super) struct Response<'a> {
    time: &'a [f64],
    level: &'a [f64],
    other_level: &'a [f64],
    before: f64,
    after: f64,
}

impl<'a> Response<'a> {
    /// The response of level `index`; `None` when its reference never moves.
    pub(super) fn first(trajectory: &'a Trajectory, experiment: &Experiment, index: usize) -> Option<Self> {
        let reference = &trajectory.references[index];
        let at_start: f64 =
            experiment.set_point_steps.iter().filter(|s| s.level == index && s.time_s <= 0.0).map(|s| s.size).sum();
        let initial = reference.first()? - at_start;
        let (first, before) = if at_start == 0.0 { (moved_after(reference, 0)?, initial) } else { (0, initial) };
        let end = window_end(trajectory, experiment, first);
        let other = 1 - index;
        Some(Self {
            time: trajectory.time_s.get(first..end)?,
            level: trajectory.levels[index].get(first..end)?,
            other_level: trajectory.levels[other].get(first..end)?,
            before,
            after: reference[first],
        })
    }

    /// When the reference stepped (s).
    pub(super) fn step_time(&self) -> f64 {
        self.time[0]
    }

    /// From the step to the end of the window (s).
    pub(super) fn duration(&self) -> f64 {
        self.time[self.time.len() - 1] - self.step_time()
    }

    /// Where the level is: 0 at the old reference, 1 at the new one.
    fn progress(&self, row: usize) -> f64 {
        (self.level[row] - self.before) / (self.after - self.before)
    }

    /// Time at which the progress is `value` between a row and the next (s after the step).
    fn crossing(&self, row: usize, value: f64) -> f64 {
        let (from, to) = (self.progress(row), self.progress(row + 1));
        let fraction = ((value - from) / (to - from)).clamp(0.0, 1.0);
        self.time[row] + fraction * (self.time[row + 1] - self.time[row]) - self.step_time()
    }

    /// When the progress first reaches `value` (s after the step).
    fn reached(&self, value: f64) -> Option<f64> {
        let row = (1..self.level.len()).find(|&row| self.progress(row) >= value)?;
        Some(self.crossing(row - 1, value))
    }

    /// From 10 % to 90 % (s).
    pub(super) fn rise_time(&self) -> Option<f64> {
        Some(self.reached(0.9)? - self.reached(0.1)?)
    }

    /// Last entry into the band `1 ± band`.
    pub(super) fn settling(&self, band: f64) -> Settling {
        let rows = self.level.len();
        match (0..rows).rev().find(|&row| (self.progress(row) - 1.0).abs() > band) {
            None => Settling::After { time_s: 0.0 },
            Some(row) if row + 1 == rows => Settling::Never,
            Some(row) => {
                let edge = if self.progress(row) > 1.0 { 1.0 + band } else { 1.0 - band };
                Settling::After { time_s: self.crossing(row, edge) }
            }
        }
    }

    /// Furthest beyond the new reference, as a fraction of the step.
    pub(super) fn overshoot(&self) -> f64 {
        (0..self.level.len()).map(|row| self.progress(row) - 1.0).fold(0.0, larger)
    }

    /// Furthest in the wrong direction, as a fraction of the step.
    pub(super) fn undershoot(&self) -> f64 {
        (0..self.level.len()).map(|row| -self.progress(row)).fold(0.0, larger)
    }

    /// Furthest that the other level moves from where it was (m).
    pub(super) fn other_peak(&self) -> f64 {
        self.other_level.iter().map(|h| (h - self.other_level[0]).abs()).fold(0.0, larger)
    }
}

/// First row after `row` at which a reference moved.
fn moved_after(reference: &[f64], row: usize) -> Option<usize> {
    (row + 1..reference.len()).find(|&k| reference[k] != reference[k - 1])
}

/// One past the last row that still belongs to the step at `first`: the row at which something else begins, where the
/// level does not know of it yet.
fn window_end(trajectory: &Trajectory, experiment: &Experiment, first: usize) -> usize {
    let time = &trajectory.time_s;
    let next_reference = trajectory.references.iter().filter_map(|reference| moved_after(reference, first)).min();
    let next_load =
        experiment.load_steps.iter().map(|load| load.time_s).filter(|&t| t > time[first]).fold(f64::INFINITY, f64::min);
    let last_before_load = time.partition_point(|&t| t <= next_load);
    next_reference.map_or(time.len(), |row| row + 1).min(last_before_load)
}
