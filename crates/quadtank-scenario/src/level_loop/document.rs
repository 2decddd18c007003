use quadtank::study::level_loop::{LevelLoopSetup, LevelLoopStudy};
use serde::{Deserialize, Serialize};

use crate::{BenchDocument, Document, Label, Scenario, ScenarioError, params, validate};

/// A level loop: plant, step test, objective, tuning, experiment and search.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct LevelLoopScenario {
    /// Version of the document: 4. It is checked before anything else is read.
    pub version: u32,
    /// What the experiment is called, and a note on it.
    #[serde(default, skip_serializing_if = "Label::is_empty")]
    pub label: Label,
    /// The loop that is worked on.
    pub level_loop: LevelLoopSetup,
    /// Loops pinned to compare with, at most 8. Their tunings are run in the experiment of the loop that is worked on.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pinned_loops: Vec<LevelLoopSetup>,
    /// Time at which the cursor stands (s); absent at the end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cursor_s: Option<f64>,
}

impl LevelLoopScenario {
    /// Most pinned loops.
    pub const MAX_PINNED: usize = Scenario::MAX_PINNED;
}

impl BenchDocument for LevelLoopScenario {
    type Setup = LevelLoopSetup;
    type Study = LevelLoopStudy;
    const BENCH: &'static str = "level-loop";
    const VERSION: u32 = 4;
    const ROOT: &'static str = "level_loop";
    const DICTIONARY: &'static [u8] = include_bytes!("../dictionary-4.jsonl");

    fn setup(&self) -> &LevelLoopSetup {
        &self.level_loop
    }

    fn setup_mut(&mut self) -> &mut LevelLoopSetup {
        &mut self.level_loop
    }

    fn pinned(&self) -> &[LevelLoopSetup] {
        &self.pinned_loops
    }

    fn pinned_mut(&mut self) -> Option<&mut Vec<LevelLoopSetup>> {
        Some(&mut self.pinned_loops)
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
        super::validate::setup(&self.level_loop, "level_loop")?;
        validate::each(&self.pinned_loops, "pinned_loops", super::validate::setup)
    }
}

impl From<LevelLoopScenario> for Document {
    fn from(document: LevelLoopScenario) -> Self {
        Self::LevelLoop(document)
    }
}

impl TryFrom<Document> for LevelLoopScenario {
    type Error = Document;

    fn try_from(document: Document) -> Result<Self, Document> {
        match document {
            Document::LevelLoop(document) => Ok(document),
            other => Err(other),
        }
    }
}

impl Default for LevelLoopScenario {
    fn default() -> Self {
        Self::from(LevelLoopSetup::default())
    }
}

impl From<LevelLoopSetup> for LevelLoopScenario {
    fn from(level_loop: LevelLoopSetup) -> Self {
        Self { version: Self::VERSION, label: Label::default(), level_loop, pinned_loops: Vec::new(), cursor_s: None }
    }
}
