use quadtank::study::relay_tuning::{RelayTuningStudy, TuningSetup};
use serde::{Deserialize, Serialize};

use crate::{BenchDocument, Document, Label, ScenarioError, params, validate};

/// A relay-tuning session.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct TuningScenario {
    /// Version of the document: 2. It is checked before anything else is read.
    pub version: u32,
    /// What the experiment is called, and a note on it.
    #[serde(default, skip_serializing_if = "Label::is_empty")]
    pub label: Label,
    /// The session.
    pub tuning: TuningSetup,
    /// Sessions whose responses stay in sight, oldest first.
    #[serde(default)]
    pub pinned: Vec<TuningSetup>,
}

impl TuningScenario {
    /// Most pinned sessions.
    pub const MAX_PINNED: usize = 8;
}

impl BenchDocument for TuningScenario {
    type Setup = TuningSetup;
    type Study = RelayTuningStudy;
    const BENCH: &'static str = "relay-tuning";
    const VERSION: u32 = 2;
    const ROOT: &'static str = "tuning";
    const DICTIONARY: &'static [u8] = include_bytes!("../dictionary-2.jsonl");

    fn setup(&self) -> &TuningSetup {
        &self.tuning
    }

    fn setup_mut(&mut self) -> &mut TuningSetup {
        &mut self.tuning
    }

    fn pinned(&self) -> &[TuningSetup] {
        &self.pinned
    }

    fn pinned_mut(&mut self) -> Option<&mut Vec<TuningSetup>> {
        Some(&mut self.pinned)
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
        super::validate::setup(&self.tuning, "tuning")?;
        validate::each(&self.pinned, "pinned", super::validate::setup)
    }
}

impl From<TuningScenario> for Document {
    fn from(document: TuningScenario) -> Self {
        Self::Tuning(document)
    }
}

impl TryFrom<Document> for TuningScenario {
    type Error = Document;

    fn try_from(document: Document) -> Result<Self, Document> {
        match document {
            Document::Tuning(document) => Ok(document),
            other => Err(other),
        }
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
        Self { version: Self::VERSION, label: Label::default(), tuning, pinned: Vec::new() }
    }
}
