use quadtank::study::model_free::{ModelFreeSetup, ModelFreeStudy};
use serde::{Deserialize, Serialize};

use crate::{BenchDocument, Document, Label, ScenarioError, params, validate};

/// A run under the model-free law.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ModelFreeScenario {
    /// Version of the document: 3. It is checked before anything else is read.
    pub version: u32,
    /// What the experiment is called, and a note on it.
    #[serde(default, skip_serializing_if = "Label::is_empty")]
    pub label: Label,
    /// The run.
    pub model_free: ModelFreeSetup,
    /// Time at which the cursor stands (s); `None` at the end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cursor_s: Option<f64>,
}

impl BenchDocument for ModelFreeScenario {
    type Setup = ModelFreeSetup;
    type Study = ModelFreeStudy;
    const BENCH: &'static str = "model-free";
    const VERSION: u32 = 3;
    const ROOT: &'static str = "model_free";
    const DICTIONARY: &'static [u8] = include_bytes!("../dictionary-3.jsonl");

    fn setup(&self) -> &ModelFreeSetup {
        &self.model_free
    }

    fn setup_mut(&mut self) -> &mut ModelFreeSetup {
        &mut self.model_free
    }

    fn pinned(&self) -> &[ModelFreeSetup] {
        &[]
    }

    fn pinned_mut(&mut self) -> Option<&mut Vec<ModelFreeSetup>> {
        None
    }

    fn label(&self) -> &Label {
        &self.label
    }

    fn label_mut(&mut self) -> &mut Label {
        &mut self.label
    }

    fn validate(&self) -> Result<(), ScenarioError> {
        self.label.check()?;
        params::check(self)?;
        validate::version(self.version, Self::VERSION)?;
        super::validate::setup(&self.model_free, "model_free")
    }
}

impl From<ModelFreeScenario> for Document {
    fn from(document: ModelFreeScenario) -> Self {
        Self::ModelFree(document)
    }
}

impl TryFrom<Document> for ModelFreeScenario {
    type Error = Document;

    fn try_from(document: Document) -> Result<Self, Document> {
        match document {
            Document::ModelFree(document) => Ok(document),
            other => Err(other),
        }
    }
}

impl Default for ModelFreeScenario {
    fn default() -> Self {
        Self::from(ModelFreeSetup::default())
    }
}

impl From<ModelFreeSetup> for ModelFreeScenario {
    fn from(model_free: ModelFreeSetup) -> Self {
        Self { version: Self::VERSION, label: Label::default(), model_free, cursor_s: None }
    }
}
