//! The answers of one level to the steps of its reference, cut out of a run.

use serde::Serialize;

use crate::numeric::{larger, smaller};

use super::course::TIME_SLACK;
use super::experiment::{Experiment, MIN_STEP, net};
use super::trajectory::{EventKind, Trajectory};

/// When a response stays within its band.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Settling {
    /// It settled this long after the step (s).
    After {
        /// Seconds after the step.
        time_s: f64,
    },
    /// It is still outside the band at the end of its window.
    Never,
}

/// How far a level may be from its old reference when the new one comes (a share of the step): what counts as settled.
pub(super) const AT_REST: f64 = 0.02;
/// How long it has to have been there, as a share of the time since anything was done to the plant.
pub(super) const AT_REST_FOR: f64 = 0.1;

/// Why a loop has no figures of a step response.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum NoResponse {
    /// The reference never moves.
    NoStep,
    /// The step is at most 1 nm, which no sensor resolves; shares of a still smaller one would be rounding errors of the level.
    StepTooSmall {
        /// Size of the step (m).
        size: f64,
    },
    /// Every step of the reference is at the end of the experiment or after it.
    StepAfterEnd {
        /// When the first of them would be (s).
        time_s: f64,
    },
    /// The level was not at rest at its old reference when the new one came, so that what follows is not the answer to the step
    /// alone.
    NotAtRest {
        /// How far from it (m), at the most, in the last tenth of the time since anything was done to the plant.
        distance: f64,
    },
    /// The tank overflows within the window. The wall cuts the level off there, so settling and overshoot are unknown.
    TankFull,
    /// The linear loop is unstable: an oscillation that only limits hold has no step response.
    UnstableLoop,
    /// The linear loop has a pole on the border of stability, as every loop around a singular plant has: a deviation does not decay.
    MarginalLoop,
    /// A tank overflows at the operating point, so the run does not begin at rest.
    StartOverflows,
    /// The run has noise and takes so much work that its twin without noise, of which the figures would be, is not run.
    TooLongToJudge,
}

/// A change of a reference.
#[derive(Clone, Copy, Debug, PartialEq)]
struct ReferenceStep {
    /// The row at which it acts.
    row: usize,
    /// By how much (m).
    size: f64,
}

/// A step response and what the other level did meanwhile. All slices have the rows of the window, from the step on.
pub(super) struct Response<'a> {
    time: &'a [f64],
    level: &'a [f64],
    other_level: &'a [f64],
    /// The reference of the level, which moves in the last row at the earliest.
    reference: &'a [f64],
    /// The level in the last tenth of the time since anything was done to the plant, up to the step.
    approach: &'a [f64],
    /// Size of the step (m).
    step: f64,
    /// The reference before and after it (m).
    before: f64,
    after: f64,
    /// When the window ends (s).
    end_s: f64,
    /// The top of the wall (m) where the tank overflows somewhere in the run, else infinite.
    rim: f64,
}

impl<'a> Response<'a> {
    /// The responses of level `index` to the steps of its reference, by time, in a run with the given sampling time (s).
    pub(super) fn all(
        trajectory: &'a Trajectory,
        experiment: &Experiment,
        sampling_time_s: f64,
        index: usize,
    ) -> Vec<Self> {
        let steps = [0, 1].map(|level| reference_steps(trajectory, experiment, sampling_time_s, level));
        let of = |step: &ReferenceStep| Self::of(trajectory, experiment, sampling_time_s, index, *step, &steps);
        steps[index].iter().map(of).collect()
    }

    /// The response to `step`, one of the steps of both references.
    fn of(
        trajectory: &'a Trajectory,
        experiment: &Experiment,
        sampling_time_s: f64,
        index: usize,
        step: ReferenceStep,
        steps: &[Vec<ReferenceStep>; 2],
    ) -> Self {
        let ReferenceStep { row: first, size } = step;
        let slack = TIME_SLACK * sampling_time_s;
        let begin_s = trajectory.time_s[first];
        let later_steps = steps.iter().flatten().filter(|later| later.row > first);
        let earlier_steps = steps.iter().flatten().filter(|earlier| earlier.row < first);
        let moved_s = earlier_steps
            .map(|earlier| trajectory.time_s[earlier.row])
            .chain(experiment.last_change_s(begin_s - slack))
            .fold(0.0, f64::max);
        let rest_s = begin_s - AT_REST_FOR * (begin_s - moved_s);
        let rest = trajectory.time_s.partition_point(|&time| time < rest_s - slack).min(first);
        let end_s = later_steps
            .map(|later| trajectory.time_s[later.row])
            .chain(experiment.next_change_s(begin_s + slack))
            .chain(trajectory.time_s.last().copied())
            .fold(f64::INFINITY, f64::min);
        // The last row is at the end itself, where the level does not show yet what begins there.
        let end = trajectory.time_s.partition_point(|&time| time <= end_s + slack).max(first + 1);
        let reference = &trajectory.references[index];
        let after = reference[first];
        Self {
            time: &trajectory.time_s[first..end],
            level: &trajectory.levels[index][first..end],
            other_level: &trajectory.levels[1 - index][first..end],
            reference: &reference[first..end],
            approach: &trajectory.levels[index][rest..=first],
            step: size,
            before: if first == 0 { after - size } else { reference[first - 1] },
            after,
            end_s,
            rim: rim_of(trajectory, index),
        }
    }

    /// Why the step has no figures, where it has none.
    pub(super) fn refusal(&self) -> Option<NoResponse> {
        if self.step.abs() <= MIN_STEP {
            return Some(NoResponse::StepTooSmall { size: self.step });
        }
        if self.level.iter().any(|&level| level >= self.rim) {
            return Some(NoResponse::TankFull);
        }
        let distance =
            self.approach.iter().map(|level| (level - self.before).abs()).fold(0.0, |most, next| larger(next, most));
        (distance > AT_REST * self.step.abs()).then_some(NoResponse::NotAtRest { distance })
    }

    /// Σ |r − h| Δt from the step to the end of the window (m s).
    pub(super) fn iae(&self) -> f64 {
        let of_row = |row: usize| {
            let next = self.time.get(row + 1).map_or(self.end_s, |&next| smaller(next, self.end_s));
            larger(next - self.time[row], 0.0) * (self.reference[row] - self.level[row]).abs()
        };
        (0..self.time.len()).map(of_row).sum()
    }

    /// The reference before the step (m).
    pub(super) fn before(&self) -> f64 {
        self.before
    }

    /// The reference after the step (m).
    pub(super) fn after(&self) -> f64 {
        self.after
    }

    /// When the reference stepped (s).
    pub(super) fn step_time(&self) -> f64 {
        self.time[0]
    }

    /// From the step to the end of the window (s).
    pub(super) fn duration(&self) -> f64 {
        self.end_s - self.step_time()
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

    /// When the progress first reaches `value` (s after the step): 0 for a level that is there when the reference steps.
    fn reached(&self, value: f64) -> Option<f64> {
        let row = (0..self.level.len()).find(|&row| self.progress(row) >= value)?;
        Some(if row == 0 { 0.0 } else { self.crossing(row - 1, value) })
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
        (0..self.level.len()).map(|row| self.progress(row) - 1.0).fold(0.0, |most, next| larger(next, most))
    }

    /// Furthest in the wrong direction, as a fraction of the step.
    pub(super) fn undershoot(&self) -> f64 {
        (0..self.level.len()).map(|row| -self.progress(row)).fold(0.0, |most, next| larger(next, most))
    }

    /// Furthest that the other level moves from where it was (m).
    pub(super) fn other_peak(&self) -> f64 {
        self.other_level.iter().map(|h| (h - self.other_level[0]).abs()).fold(0.0, |most, next| larger(next, most))
    }
}

/// The level of a tank while it overflows (m), which is its highest; infinite where it never does.
fn rim_of(trajectory: &Trajectory, tank: usize) -> f64 {
    let overflows = trajectory.events.iter().any(|event| event.kind == EventKind::Overflow { tank });
    let highest = || trajectory.levels[tank].iter().fold(f64::NEG_INFINITY, |most, &level| larger(level, most));
    if overflows { highest() } else { f64::INFINITY }
}

/// Changes of the reference of a level in a run with the given sampling time (s), in order of time. Steps that act at the same
/// sample are one, and those that cancel are none.
fn reference_steps(
    trajectory: &Trajectory,
    experiment: &Experiment,
    sampling_time_s: f64,
    level: usize,
) -> Vec<ReferenceStep> {
    let row_of = |time_s: f64| row_of(trajectory, sampling_time_s, time_s);
    let steps = experiment.set_point_steps.iter().filter(|step| step.level == level);
    let mut steps: Vec<ReferenceStep> =
        steps.map(|step| ReferenceStep { row: row_of(step.time_s), size: step.size }).collect();
    steps.retain(|step| shows(trajectory, step.row));
    steps.sort_by_key(|step| step.row);
    let at_once = steps.chunk_by(|one, next| one.row == next.row);
    at_once
        .map(|steps| ReferenceStep { row: steps[0].row, size: net(steps.iter().map(|step| step.size)) })
        .filter(|step| step.size != 0.0)
        .collect()
}

/// Steps of the reference of a level that a run does not show, in order of time: when they would come (s), and by how much (m). Those
/// at the same time are one, and those that cancel are none.
pub(super) fn late_steps(
    trajectory: &Trajectory,
    experiment: &Experiment,
    sampling_time_s: f64,
    level: usize,
) -> Vec<(f64, f64)> {
    let steps = experiment.set_point_steps.iter().filter(|step| step.level == level);
    let mut steps: Vec<(f64, f64)> = steps
        .map(|step| (step.time_s, step.size))
        .filter(|&(time_s, _)| !shows(trajectory, row_of(trajectory, sampling_time_s, time_s)))
        .collect();
    steps.sort_by(|one, next| one.0.total_cmp(&next.0));
    let at_once = steps.chunk_by(|one, next| one.0 == next.0);
    at_once.map(|steps| (steps[0].0, net(steps.iter().map(|step| step.1)))).filter(|&(_, size)| size != 0.0).collect()
}

/// The row at which a step of a reference acts: that of the first sample at or after its time (s).
fn row_of(trajectory: &Trajectory, sampling_time_s: f64, time_s: f64) -> usize {
    let sample = (time_s / sampling_time_s - TIME_SLACK).ceil();
    trajectory.time_s.partition_point(|&time| time < (sample - TIME_SLACK) * sampling_time_s)
}

/// Whether a run shows what acts at a row: what acts at the last one shows nowhere.
fn shows(trajectory: &Trajectory, row: usize) -> bool {
    row + 1 < trajectory.time_s.len()
}
