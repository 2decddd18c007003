use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::ProcessModel;
use crate::sim::level::is_rounding;

/// The record of a step test: one signal over time, and the step of the input that it answers to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepRecord<'a> {
    /// Time (s), rising.
    pub time_s: &'a [f64],
    /// The signal; of the length of `time_s`.
    pub signal: &'a [f64],
    /// When the input steps (s).
    pub step_time_s: f64,
    /// By how much.
    pub step: f64,
}

/// How a reaction curve is read.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ReactionMethod {
    /// The dead time is read by eye, the time constant is when 63.2 % are reached (Andreis 2017, §4.2.7.1).
    OnePoint {
        /// The dead time (s).
        dead_time_s: f64,
    },
    /// `τ = 1.5 (t63 − t28)`, `θ = t63 − τ` from the times of 28.3 and 63.2 % (Smith 1972).
    TwoPoint,
    /// The slope of a ramp, for a tank that integrates: by how much the slope changes, and where the new line leaves the old one.
    Ramp,
}

/// A model with the points it was read from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReactionFit {
    /// The model.
    pub model: ProcessModel,
    /// The signal before the step, and at the end.
    pub ends: [f64; 2],
    /// When 28.3 and 63.2 % were reached (s after the step); `None` for a ramp.
    pub times_s: Option<[f64; 2]>,
}

/// Why a record has no model.
#[derive(Clone, Copy, Debug, PartialEq, Error, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "error", rename_all = "kebab-case")]
pub enum ReactionError {
    /// Too few rows after the step.
    #[error("{rows} rows after the step are too few")]
    EmptyRecord {
        /// How many.
        rows: usize,
    },
    /// The input does not step.
    #[error("a step of {size} is none")]
    NoStep {
        /// Its size.
        size: f64,
    },
    /// The signal does not answer.
    #[error("the signal moves by {change}, which is nothing")]
    NoResponse {
        /// By how much it moves.
        #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
        change: f64,
    },
    /// The signal bends: it is no ramp, but a curve that settles.
    #[error("the signal bends: its slope at the end is {share} of that of its second half")]
    NoRamp {
        /// Slope of the last quarter over that of the last half.
        share: f64,
    },
    /// The tank is full or empty during the test, so the curve is not that of the process.
    #[error("the tank is full or empty during the test")]
    AtWall,
    /// The signal still moves at the end.
    #[error("in the last tenth of the test the signal still moves by {share} of its change")]
    NotSettled {
        /// Share of the whole change in the last tenth of the time since the step.
        share: f64,
    },
}

/// Share of the change by which a settled signal may move in the last tenth of the test.
pub(super) const SETTLED: f64 = 0.02;
/// Levels of the two points.
const POINTS: [f64; 2] = [0.283, 0.632];
/// Least slope of the last quarter of a ramp, as a share of that of its last half.
const STRAIGHT: f64 = 0.8;
/// Rows that a fit needs after the step.
const MIN_ROWS: usize = 10;

impl StepRecord<'_> {
    /// Reads a model.
    ///
    /// # Errors
    /// [`ReactionError`] for a record that does not show one.
    pub fn fit(&self, method: ReactionMethod) -> Result<ReactionFit, ReactionError> {
        // The last row that the step does not show in yet.
        let first = self.time_s.partition_point(|&time| time <= self.step_time_s).saturating_sub(1);
        let rows = self.time_s.len().min(self.signal.len()).saturating_sub(first);
        if rows < MIN_ROWS {
            return Err(ReactionError::EmptyRecord { rows });
        }
        if self.step == 0.0 || !self.step.is_finite() {
            return Err(ReactionError::NoStep { size: self.step });
        }
        let before = self.signal[first];
        let end = self.signal[first + rows - 1];
        let change = end - before;
        if is_rounding(change, before) || !change.is_finite() {
            return Err(ReactionError::NoResponse { change });
        }
        if method == ReactionMethod::Ramp {
            return self.ramp(first, rows);
        }
        let share = (end - self.signal[first + rows - 1 - rows / 10]) / change;
        if share.abs() > SETTLED {
            return Err(ReactionError::NotSettled { share });
        }
        let times = POINTS.map(|point| self.reached(first, before + point * change, change) - self.step_time_s);
        let time_constant_s = if let ReactionMethod::OnePoint { dead_time_s } = method {
            times[1] - dead_time_s
        } else {
            (1.5 * (times[1] - times[0])).min(times[1])
        };
        let dead_time_s = times[1] - time_constant_s;
        let model = ProcessModel::SelfRegulating { gain: change / self.step, time_constant_s, dead_time_s };
        Ok(ReactionFit { model, ends: [before, end], times_s: Some(times) })
    }

    /// When the signal first reaches a value (s), between rows by a line.
    fn reached(&self, first: usize, value: f64, direction: f64) -> f64 {
        let is_beyond = |row: usize| (self.signal[row] - value) * direction >= 0.0;
        let row = (first..self.signal.len()).find(|&row| is_beyond(row)).unwrap_or(self.signal.len() - 1);
        if row == first {
            return self.time_s[row];
        }
        let (y, z) = (self.signal[row - 1], self.signal[row]);
        let share = if z == y { 1.0 } else { (value - y) / (z - y) };
        self.time_s[row - 1] + share * (self.time_s[row] - self.time_s[row - 1])
    }

    /// The line through the last half of the record, against the one before the step.
    ///
    /// # Errors
    /// [`ReactionError::NoRamp`] for a record that bends there.
    fn ramp(&self, first: usize, rows: usize) -> Result<ReactionFit, ReactionError> {
        let last = first + rows - 1;
        let middle = first + rows / 2;
        let line = |from: usize, to: usize| {
            let span = self.time_s[to] - self.time_s[from];
            if span > 0.0 { (self.signal[to] - self.signal[from]) / span } else { 0.0 }
        };
        let (old, new) = (line(0, first), line(middle, last));
        let share = line(first + 3 * rows / 4, last) / new;
        if share < STRAIGHT || share.is_nan() {
            return Err(ReactionError::NoRamp { share: if share.is_nan() { 0.0 } else { share } });
        }
        let change = new - old;
        // Where the new line meets the old one, counted from the step.
        let start = self.signal[first];
        let at_middle = self.time_s[middle] - self.step_time_s;
        let above = self.signal[middle] - (start + old * at_middle);
        let dead_time_s = if change == 0.0 { 0.0 } else { (at_middle - above / change).max(0.0) };
        let model = ProcessModel::Integrating { slope: change / self.step, dead_time_s };
        Ok(ReactionFit { model, ends: [start, self.signal[last]], times_s: None })
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    fn record(model: &ProcessModel, step: f64, end_s: f64) -> (Vec<f64>, Vec<f64>) {
        let time: Vec<f64> = (0..=4000).map(|k| f64::from(k) * end_s / 4000.0).collect();
        let signal = time.iter().map(|&t| 4.0 + model.step_response(step, t - 50.0)).collect();
        (time, signal)
    }

    fn fit(model: &ProcessModel, step: f64, end_s: f64, method: ReactionMethod) -> Result<ReactionFit, ReactionError> {
        let (time_s, signal) = record(model, step, end_s);
        StepRecord { time_s: &time_s, signal: &signal, step_time_s: 50.0, step }.fit(method)
    }

    #[test]
    fn a_first_order_process_is_found_again() {
        let model = ProcessModel::SelfRegulating { gain: -2.5, time_constant_s: 80.0, dead_time_s: 12.0 };
        for method in [ReactionMethod::TwoPoint, ReactionMethod::OnePoint { dead_time_s: 12.0 }] {
            let ProcessModel::SelfRegulating { gain, time_constant_s, dead_time_s } =
                fit(&model, 1.5, 1500.0, method).unwrap().model
            else {
                panic!("it settles")
            };
            assert_relative_eq!(gain, -2.5, max_relative = 1e-4);
            // 28.3 and 63.2 % are rounded; 1.5 (t63 − t28) is 1.0005 τ.
            assert_relative_eq!(time_constant_s, 80.0, max_relative = 2e-3);
            assert_relative_eq!(dead_time_s, 12.0, max_relative = 1e-2);
        }
    }

    #[test]
    fn a_ramp_is_found_again() {
        let model = ProcessModel::Integrating { slope: 0.02, dead_time_s: 12.0 };
        let ProcessModel::Integrating { slope, dead_time_s } =
            fit(&model, -1.5, 900.0, ReactionMethod::Ramp).unwrap().model
        else {
            panic!("it is a ramp")
        };
        assert_relative_eq!(slope, 0.02, max_relative = 1e-9);
        assert_relative_eq!(dead_time_s, 12.0, max_relative = 1e-6);
        // Read as one that settles it is refused with what is missing.
        let refused = fit(&model, -1.5, 900.0, ReactionMethod::TwoPoint);
        assert!(matches!(refused, Err(ReactionError::NotSettled { share }) if share > 0.09), "{refused:?}");
    }

    #[test]
    fn records_that_show_nothing_are_refused() {
        let model = ProcessModel::SelfRegulating { gain: 2.5, time_constant_s: 80.0, dead_time_s: 0.0 };
        let method = ReactionMethod::TwoPoint;
        assert!(matches!(fit(&model, 1.0, 250.0, method), Err(ReactionError::NotSettled { .. })));
        assert_eq!(fit(&model, 0.0, 1500.0, method), Err(ReactionError::NoStep { size: 0.0 }));
        assert_eq!(fit(&model, 1.0, 50.0, method), Err(ReactionError::EmptyRecord { rows: 1 }));
        let flat = [1.0; 40];
        let time: Vec<f64> = (0..40).map(f64::from).collect();
        let still = StepRecord { time_s: &time, signal: &flat, step_time_s: 0.0, step: 1.0 };
        assert_eq!(still.fit(method), Err(ReactionError::NoResponse { change: 0.0 }));
        // A signal that drifts by rounding does not answer either.
        let drifting: Vec<f64> = (0..40).map(|k| 12.0 + 2e-15 * f64::from(k)).collect();
        let drift = StepRecord { signal: &drifting, ..still };
        assert!(matches!(drift.fit(method), Err(ReactionError::NoResponse { .. })));
        let empty = StepRecord { time_s: &[], signal: &[], step_time_s: 0.0, step: 1.0 };
        assert_eq!(empty.fit(method), Err(ReactionError::EmptyRecord { rows: 0 }));
    }
}
