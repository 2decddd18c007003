use quadtank::study::relay_tuning::TuningSetup;
use serde::{Deserialize, Serialize};

use crate::{ScenarioError, params, validate};

/// A relay-tuning session.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct TuningScenario {
    /// Version of the document: 2. It is checked before anything else is read.
    pub version: u32,
    /// The session.
    pub tuning: TuningSetup,
    /// Sessions whose responses stay in sight, oldest first.
    #[serde(default)]
    pub pinned: Vec<TuningSetup>,
}

impl TuningScenario {
    /// The version of these documents.
    pub const VERSION: u32 = 2;
    /// Most pinned sessions.
    pub const MAX_PINNED: usize = 3;

    /// Checks every number, the lengths of all lists, and what has to hold between numbers.
    ///
    /// # Errors
    /// [`ScenarioError::OutOfRange`] or [`ScenarioError::TooMany`] for the first field that is not allowed.
    pub fn validate(&self) -> Result<(), ScenarioError> {
        params::check(self)?;
        validate::version(self.version, Self::VERSION)?;
        super::validate::setup(&self.tuning, "tuning")?;
        validate::each(&self.pinned, "pinned", super::validate::setup)
    }
}

impl Default for TuningScenario {
    fn default() -> Self {
        Self::from(TuningSetup::default())
    }
}

/// A session alone, nothing pinned.
impl From<TuningSetup> for TuningScenario {
    fn from(tuning: TuningSetup) -> Self {
        Self { version: Self::VERSION, tuning, pinned: Vec::new() }
    }
}
