use serde::Serialize;
use thiserror::Error;

use super::{LevelLog, SampleStatistics};
use crate::sim::experiment::MIN_STEP;

/// Figures of a run over all of its log.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LevelFigures {
    /// Statistics of the level (m).
    pub level: SampleStatistics,
    /// Statistics of the outflow (m³/s).
    pub outflow: SampleStatistics,
    /// Integral of the absolute error, as the transmitter sees it (m s), by trapezia as the other two.
    pub iae: f64,
    /// Integral of the square of the error (m² s).
    pub ise: f64,
    /// Integral of time times the absolute error (m s²).
    pub itae: f64,
    /// Sum of the moves of the output from row to row, in its unit.
    pub output_moves: f64,
    /// Sum of the squares of these moves.
    pub squared_moves: f64,
}

impl LevelFigures {
    /// Of a log and the gain of the transmitter (signal per metre); `None` of fewer than two rows.
    pub fn of(log: &LevelLog, transmitter_gain: f64) -> Option<Self> {
        let [level, outflow] = log.statistics(0..log.len())?;
        let error = |row: usize| (log.reference[row] - log.transmitted[row]) / transmitter_gain;
        let (mut iae, mut ise, mut itae, mut moves, mut squares) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for row in 1..log.len() {
            let (from, to) = (log.time_s[row - 1], log.time_s[row]);
            let (before, after) = (error(row - 1), error(row));
            let half = 0.5 * (to - from);
            iae += half * (before.abs() + after.abs());
            ise += half * (before * before + after * after);
            itae += half * (from * before.abs() + to * after.abs());
            let by = log.output[row] - log.output[row - 1];
            moves += by.abs();
            squares += by * by;
        }
        Some(Self { level, outflow, iae, ise, itae, output_moves: moves, squared_moves: squares })
    }
}

/// Why a loop does not answer a step of its set-point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "error", rename_all = "kebab-case")]
pub enum NoStepAnswer {
    /// The output is set by hand, so the set-point acts on nothing.
    #[error("an output by hand does not follow the set-point")]
    ByHand,
    /// The linear loop is unstable: what only limits hold has no final level.
    #[error("the linear loop is unstable")]
    UnstableLoop,
    /// The linear loop is on the border of stability: an oscillation does not decay.
    #[error("the linear loop is on the border of stability")]
    MarginalLoop,
    /// At the end the level is where it was, within 1 nm.
    #[error("the level does not move")]
    DoesNotMove,
}

/// Response of a level to one step of its set-point at the start of a run.
///
/// Overshoot and times are measured against the level at the end, so a level that has not come to rest there has none.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LevelStepResponse {
    /// By how much the level moves until the end (m).
    pub change: f64,
    /// Share of the step that is missing at the end.
    pub offset: f64,
    /// By how much the largest deviation exceeds the final one, as a share of that; 0 if it does not, `None` without rest.
    pub overshoot: Option<f64>,
    /// When the largest deviation is reached (s); `None` without rest.
    pub peak_time_s: Option<f64>,
    /// From 10 to 90 % of the final deviation (s); `None` without rest.
    pub rise_time_s: Option<f64>,
    /// From when on the level stays within 2 % of its final deviation (s); `None` without rest.
    pub settling_time_s: Option<f64>,
}

/// Share of the final deviation within which a level has settled.
const BAND: f64 = 0.02;
/// How long a level has to have been there at the end, as a share of the run.
const AT_REST_FOR: f64 = 0.1;

impl LevelStepResponse {
    /// The answer to a step (m) at the start, measured against the level at the end; `None` for a level that does not move by more
    /// than 1 nm, a step that does not, and of fewer than two rows.
    pub fn of(log: &LevelLog, step: f64) -> Option<Self> {
        let (first, last) = (*log.level.first()?, *log.level.last()?);
        let change = last - first;
        if change.abs() <= MIN_STEP || step.abs() <= MIN_STEP {
            return None;
        }
        let share = |row: usize| (log.level[row] - first) / change;
        let peak = (0..log.len()).max_by(|&a, &b| share(a).total_cmp(&share(b)))?;
        let crossing = |target: f64| -> Option<f64> {
            let row = (1..log.len()).find(|&row| share(row) >= target)?;
            let (before, after) = (share(row - 1), share(row));
            let (from, to) = (log.time_s[row - 1], log.time_s[row]);
            Some(from + (to - from) * (target - before) / (after - before))
        };
        let outside = (0..log.len()).rposition(|row| (share(row) - 1.0).abs() > BAND);
        let settling_s = outside.map_or(0.0, |row| log.time_s[(row + 1).min(log.len() - 1)]);
        let rests = settling_s <= (1.0 - AT_REST_FOR) * log.time_s[log.len() - 1];
        let at_rest = |figure: f64| rests.then_some(figure);
        Some(Self {
            change,
            offset: 1.0 - change / step,
            overshoot: at_rest((share(peak) - 1.0).max(0.0)),
            peak_time_s: at_rest(log.time_s[peak]),
            rise_time_s: at_rest(crossing(0.9)? - crossing(0.1)?),
            settling_time_s: at_rest(settling_s),
        })
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    fn log(level: &[f64], output: &[f64]) -> LevelLog {
        let rows = level.len();
        LevelLog {
            time_s: (0..rows).map(|row| row as f64).collect(),
            reference: vec![2.0; rows],
            level: level.to_vec(),
            transmitted: level.to_vec(),
            output: output.to_vec(),
            outflow: vec![0.5; rows],
            ..LevelLog::default()
        }
    }

    #[test]
    fn figures_of_a_short_log() {
        let found = LevelFigures::of(&log(&[0.0, 2.5, 1.5, 2.0], &[1.0, 3.0, 2.5, 2.5]), 1.0).unwrap();
        assert_relative_eq!(found.iae, 1.25 + 0.5 + 0.25, max_relative = 1e-14);
        assert_relative_eq!(found.ise, 2.125 + 0.25 + 0.125, max_relative = 1e-14);
        assert_relative_eq!(found.itae, 0.25 + 0.75 + 0.5, max_relative = 1e-14);
        assert_eq!((found.output_moves, found.squared_moves, found.outflow.variance), (2.5, 4.25, 0.0));
        assert_eq!(LevelFigures::of(&LevelLog::default(), 1.0), None);
    }

    #[test]
    fn the_answer_to_a_step_counts_from_the_level_at_the_end() {
        let answer = LevelStepResponse::of(&log(&[0.0, 1.0, 2.2, 1.6, 2.0, 2.0], &[0.0; 6]), 2.5).unwrap();
        assert_relative_eq!(answer.overshoot.unwrap(), 0.1, max_relative = 1e-14);
        assert_relative_eq!(answer.offset, 0.2, max_relative = 1e-14);
        assert_relative_eq!(answer.rise_time_s.unwrap(), (1.0 + 0.8 / 1.2) - 0.2, max_relative = 1e-14);
        assert_eq!((answer.peak_time_s, answer.settling_time_s), (Some(2.0), Some(4.0)));
    }

    #[test]
    fn rounding_of_a_level_is_no_answer() {
        for end in [1.0, 1.0 + f64::EPSILON, 1.0 - 4.0 * f64::EPSILON] {
            assert_eq!(LevelStepResponse::of(&log(&[1.0, 1.5, end], &[0.0; 3]), 1.0), None);
        }
    }

    #[test]
    fn a_level_that_moves_at_the_end_has_an_offset_and_no_times() {
        let swinging: Vec<f64> = (0..40).map(|row| if row % 2 == 0 { 0.0 } else { 2.0 }).collect();
        let answer = LevelStepResponse::of(&log(&swinging, &[0.0; 40]), 2.5).unwrap();
        assert_relative_eq!(answer.offset, 0.2, max_relative = 1e-14);
        let figures = [answer.overshoot, answer.peak_time_s, answer.rise_time_s, answer.settling_time_s];
        assert_eq!(figures, [None; 4]);
    }
}
