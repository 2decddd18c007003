use serde::Serialize;
use thiserror::Error;

use crate::plant::level::LevelPlant;
use crate::sim::level::{
    InflowDisturbance, LevelController, LevelExperiment, LevelLog, LevelRunError, LevelSimulation, SetPointScale,
    SignalStep,
};
use crate::tuning::{
    ProcessModel, ReactionError, ReactionFit, Regulation, RegulationError, StepRecord, open_loop_regulation,
};

use super::{PlantAnswer, StepTestSpec};

/// Rows of the log of a test.
const ROWS: f64 = 600.0;

/// A step test with what it says.
#[derive(Clone, Debug, PartialEq)]
pub struct StepTestAnswer {
    /// The record.
    pub log: LevelLog,
    /// The model that was read from it.
    pub fit: Result<ReactionFit, ReactionError>,
    /// The answer of that model at each row, as a signal of the transmitter; `None` without one.
    pub fitted: Option<Vec<f64>>,
    /// What it says of the tank; `None` without a step back.
    pub regulation: Option<Result<Regulation, RegulationError>>,
}

/// How the model of a test compares with the plant where it works.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModelMatch {
    /// Slope K/τ of the model that was read from the test (1/s).
    pub tested: f64,
    /// The same around the rest of the experiment (1/s).
    pub here: f64,
}

impl ModelMatch {
    /// Ratio of slopes from which on a tuning for one plant is no tuning for the other: as much as a usual gain margin leaves.
    const MILD: f64 = 1.5;

    /// Of a test and a plant; `None` for a test without a model.
    pub fn of(test: &StepTestAnswer, plant: &PlantAnswer) -> Option<Self> {
        Some(Self { tested: test.fit.as_ref().ok()?.model.slope(), here: plant.model.slope() })
    }

    /// How much faster the plant answers where it works than where it was tested.
    pub fn ratio(&self) -> f64 {
        self.here / self.tested
    }

    /// Whether a tuning by the test suits the plant where it works.
    pub fn suits(&self) -> bool {
        (Self::MILD.recip()..=Self::MILD).contains(&self.ratio())
    }
}

/// Why a test has no record.
#[derive(Clone, Copy, Debug, PartialEq, Error, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "error", rename_all = "kebab-case")]
pub enum StepTestError {
    /// The output does not step within the test.
    #[error("{field} = {value} is not within the test")]
    OutsideTest {
        /// Which time.
        field: &'static str,
        /// Its value (s).
        value: f64,
    },
    /// The loop has no such run.
    #[error(transparent)]
    #[serde(untagged)]
    Run(#[from] LevelRunError),
}

/// Runs the test on a plant and reads it.
///
/// # Errors
/// [`StepTestError`] for a test that cannot be run.
pub fn run_step_test(plant: &LevelPlant, test: &StepTestSpec) -> Result<StepTestAnswer, StepTestError> {
    let end = test.return_time_s.unwrap_or(test.duration_s);
    if !(test.step_time_s >= 0.0 && test.step_time_s < end) {
        return Err(StepTestError::OutsideTest { field: "step_time_s", value: test.step_time_s });
    }
    if end > test.duration_s {
        return Err(StepTestError::OutsideTest { field: "return_time_s", value: end });
    }
    let experiment = LevelExperiment {
        level: test.level,
        inflow: test.inflow,
        duration_s: test.duration_s,
        log_step_s: test.duration_s / ROWS,
        disturbance: InflowDisturbance::NONE,
        set_point_steps: Vec::new(),
        set_point_scale: SetPointScale::Level,
    };
    let back = test.return_time_s.map(|time_s| SignalStep { time_s, size: -test.step });
    let steps = [SignalStep { time_s: test.step_time_s, size: test.step }].into_iter().chain(back).collect();
    let log = LevelSimulation::new(plant, &experiment)?.run(&LevelController::Manual { steps })?;
    let first = log.time_s.partition_point(|&time| time <= test.step_time_s).saturating_sub(1);
    let last = log.time_s.partition_point(|&time| time <= end);
    let record = StepRecord {
        time_s: &log.time_s[..last],
        signal: &log.transmitted[..last],
        step_time_s: test.step_time_s,
        step: test.step,
    };
    let at_wall = log.full_s > 0.0 || log.empty_s > 0.0;
    let fit = if at_wall { Err(ReactionError::AtWall) } else { record.fit(test.method) };
    let fitted = fit.as_ref().ok().map(|fit| answer_of(&fit.model, test, &log));
    let start = log.level.get(first).copied().unwrap_or(test.level);
    let regulation =
        test.return_time_s.map(|_| open_loop_regulation(start, &log.level[first..last], &log.level[last..]));
    Ok(StepTestAnswer { log, fit, fitted, regulation })
}

/// The answer of a model to the steps of a test.
fn answer_of(model: &ProcessModel, test: &StepTestSpec, log: &LevelLog) -> Vec<f64> {
    let start = log.transmitted[0];
    let since = |time: f64, step_time: f64, step: f64| {
        if time < step_time { 0.0 } else { model.step_response(step, time - step_time) }
    };
    let back = |time: f64| test.return_time_s.map_or(0.0, |at| since(time, at, -test.step));
    log.time_s.iter().map(|&time| start + since(time, test.step_time_s, test.step) + back(time)).collect()
}
