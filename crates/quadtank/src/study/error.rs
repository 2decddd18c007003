use thiserror::Error;

use crate::control::EstimatorError;
use crate::linear::LinearError;
use crate::plant::PlantError;

/// Why a setup has no results.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("{field}: {fault}")]
pub struct StudyError {
    /// Where in the setup, as its document writes it: `experiment.duration_s`.
    pub field: &'static str,
    /// What is wrong.
    pub fault: StudyErrorKind,
}

/// What is wrong with a setup.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum StudyErrorKind {
    /// The plant has no such operating point.
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// The linear model does not answer.
    #[error(transparent)]
    Linear(#[from] LinearError),
    /// The model-free law cannot work with such settings.
    #[error(transparent)]
    Law(#[from] EstimatorError),
    /// A run whose integration takes more work than any experiment is given.
    #[error(
        "not computed beyond {time_s} s, because tanks that are almost dry or at their walls ask for too many steps"
    )]
    TooMuchWork {
        /// How far the run came (s).
        time_s: f64,
    },
}

impl StudyError {
    /// Attaches the field of the setup at which an error of a lower-level module arises.
    pub(super) fn at<E: Into<StudyErrorKind>>(field: &'static str) -> impl Fn(E) -> Self {
        move |error| Self { field, fault: error.into() }
    }
}

/// The linear model is one of the plant.
impl From<LinearError> for StudyError {
    fn from(error: LinearError) -> Self {
        Self::at("plant")(error)
    }
}
