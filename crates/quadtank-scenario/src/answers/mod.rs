//! What is answered about a document: reports as JSON and tables as CSV, each a text. The command line and the JavaScript module
//! print the same ones.

mod level_loop;
mod model_free;
mod quadruple;
mod tuning;

use quadtank::sim::level::LevelRunError;
use quadtank::study::StudyError;
use quadtank::study::level_loop::{LevelLoopError, StepTestError};
use quadtank::tuning::TuningError;
use serde::Serialize;
use thiserror::Error;

pub use level_loop::{SearchKind, SearchRequest};
pub use tuning::relay_record;

use super::{BenchDocument, Document, ScenarioError};

/// Why a document has no answer. The message begins with the place in the document.
#[derive(Debug, Error)]
pub enum AnswerError {
    /// The document is not valid, or its setup has no results.
    #[error("{0}")]
    Scenario(#[from] ScenarioError),
    /// A relay-tuning session without results.
    #[error("tuning: {0}")]
    Tuning(#[from] TuningError),
    /// A level loop without a run.
    #[error("level_loop.{0}")]
    LevelLoop(#[from] LevelLoopError),
    /// A level loop that cannot be searched.
    #[error("level_loop: {0}")]
    LevelRun(#[from] LevelRunError),
    /// A step test without results.
    #[error("level_loop.test: {0}")]
    StepTest(#[from] StepTestError),
    /// There is nothing to tune.
    #[error("this command needs a relay-tuning session, version 2, or a level loop, version 4")]
    NoTuning,
    /// A report that is no JSON.
    #[error("{0}")]
    Json(#[from] serde_json::Error),
}

/// The answers of one kind of document.
trait Answers {
    fn analysis_json(&self) -> Result<String, AnswerError>;
    fn run_json(&self) -> Result<String, AnswerError>;
    fn run_csv(&self) -> Result<String, AnswerError>;
    fn tuning_json(&self, _: &SearchRequest) -> Result<String, AnswerError> {
        Err(AnswerError::NoTuning)
    }
    fn tuning_csv(&self, _: &SearchRequest) -> Result<String, AnswerError> {
        Err(AnswerError::NoTuning)
    }
    fn warnings(&self) -> Vec<String> {
        Vec::new()
    }
}

impl Document {
    fn answers(&self) -> &dyn Answers {
        match self {
            Self::Quadruple(scenario) => scenario,
            Self::Tuning(scenario) => scenario,
            Self::ModelFree(scenario) => scenario,
            Self::LevelLoop(scenario) => scenario,
        }
    }

    /// What theory says, as JSON (SI units).
    ///
    /// # Errors
    /// [`AnswerError`] where the setup has no operating point or no linear model.
    pub fn analysis_json(&self) -> Result<String, AnswerError> {
        self.answers().analysis_json()
    }

    /// What happens in the run, as JSON (SI units).
    ///
    /// # Errors
    /// [`AnswerError`] where the setup has no run.
    pub fn run_json(&self) -> Result<String, AnswerError> {
        self.answers().run_json()
    }

    /// The run as a table in CSV, with the unit of each column in its name.
    ///
    /// # Errors
    /// As [`run_json`](Self::run_json).
    pub fn run_csv(&self) -> Result<String, AnswerError> {
        self.answers().run_csv()
    }

    /// What relay test and design find, or a search for the settings of a level loop, as JSON.
    ///
    /// # Errors
    /// [`AnswerError::NoTuning`] for a document of another kind; other [`AnswerError`]s where there are no results.
    pub fn tuning_json(&self, request: &SearchRequest) -> Result<String, AnswerError> {
        self.answers().tuning_json(request)
    }

    /// The record of the relay test, or the path of the search, as CSV.
    ///
    /// # Errors
    /// As [`tuning_json`](Self::tuning_json).
    pub fn tuning_csv(&self, request: &SearchRequest) -> Result<String, AnswerError> {
        self.answers().tuning_csv(request)
    }

    /// What the document may not have been meant to say, each a sentence that begins with the place.
    pub fn warnings(&self) -> Vec<String> {
        self.answers().warnings()
    }
}

/// A result of the setup of a document, or the error with its place.
///
/// # Errors
/// [`AnswerError::Scenario`] with the place of the setup.
pub fn studied<D: BenchDocument, T>(result: Result<T, StudyError>) -> Result<T, AnswerError> {
    Ok(result.map_err(|error| ScenarioError::Study { setup: D::ROOT, error })?)
}

/// A report as JSON, indented, with a line break at its end.
///
/// # Errors
/// [`AnswerError::Json`], for a type that JSON cannot hold.
pub fn report_json<T: Serialize>(report: &T) -> Result<String, AnswerError> {
    Ok(serde_json::to_string_pretty(report)? + "\n")
}

/// A report of version 2 or 3, whose keys have always been in alphabetical order.
fn report_json_by_key<T: Serialize>(report: &T) -> Result<String, AnswerError> {
    report_json(&serde_json::to_value(report)?)
}
