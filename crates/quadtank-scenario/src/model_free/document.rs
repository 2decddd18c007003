use quadtank::study::model_free::ModelFreeSetup;
use serde::{Deserialize, Serialize};

use crate::{ScenarioError, params, validate};

/// A run under the model-free law.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ModelFreeScenario {
    /// Version of the document: 3. It is checked before anything else is read.
    pub version: u32,
    /// The run.
    pub model_free: ModelFreeSetup,
    /// Time at which the cursor stands (s); `None` at the end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cursor_s: Option<f64>,
}

impl ModelFreeScenario {
    /// The version of these documents.
    pub const VERSION: u32 = 3;

    /// Checks every number, the lengths of all lists, and what has to hold between numbers.
    ///
    /// # Errors
    /// [`ScenarioError::OutOfRange`], [`ScenarioError::Law`] or [`ScenarioError::TooMany`] for the first field that is
    /// not allowed.
    pub fn validate(&self) -> Result<(), ScenarioError> {
        params::check(self)?;
        validate::version(self.version, Self::VERSION)?;
        super::validate::setup(&self.model_free, "model_free")
    }
}

impl Default for ModelFreeScenario {
    fn default() -> Self {
        Self::from(ModelFreeSetup::default())
    }
}

impl From<ModelFreeSetup> for ModelFreeScenario {
    fn from(model_free: ModelFreeSetup) -> Self {
        Self { version: Self::VERSION, model_free, cursor_s: None }
    }
}
