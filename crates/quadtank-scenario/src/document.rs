use quadtank::literature::PresetId;
use quadtank::study::Study;
use quadtank::study::quadruple_tank::{QuadrupleTankStudy, Setup, setup_of};
use serde::{Deserialize, Serialize};

use super::label::check_length;
use super::{Document, Label, ScenarioError, params, validate};

/// The document of a bench: a setup, setups pinned to compare with, and what the screen shows of them.
pub trait BenchDocument:
    Clone + Default + PartialEq + Serialize + Into<Document> + TryFrom<Document, Error = Document> + 'static
{
    /// What results follow from.
    type Setup: Clone + PartialEq;
    /// What computes them.
    type Study: Study<Setup = Self::Setup>;
    /// The name of the bench, which also stands in the address of the page.
    const BENCH: &'static str;
    /// The version that this program writes, which is the bench's own, and the format of its links.
    const VERSION: u32;
    /// The field of the document that holds its setup.
    const ROOT: &'static str;
    /// Typical documents, one on a line, that links are packed against. They must never change, or old links break.
    const DICTIONARY: &'static [u8];

    /// The setup that is worked on.
    fn setup(&self) -> &Self::Setup;

    /// The same, to change it.
    fn setup_mut(&mut self) -> &mut Self::Setup;

    /// Setups pinned to compare with.
    fn pinned(&self) -> &[Self::Setup];

    /// The same, to change them; `None` for a document that keeps none.
    fn pinned_mut(&mut self) -> Option<&mut Vec<Self::Setup>>;

    /// What the experiment is called, and a note on it.
    fn label(&self) -> &Label;

    /// The same, to change it.
    fn label_mut(&mut self) -> &mut Label;

    /// Checks every number against its [row](super::params), the lengths of all lists, and what has to hold between numbers.
    ///
    /// # Errors
    /// [`ScenarioError`] for the first field that is not allowed.
    fn validate(&self) -> Result<(), ScenarioError>;
}

/// What the screen shows beside the run itself. Nothing here changes a number.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct View {
    /// Time at which the cursor of the responses stands (s); `None` at rest.
    pub cursor_s: Option<f64>,
    /// Shown part of the time axis (s); `None` for all of it.
    pub zoom_s: Option<[f64; 2]>,
    /// Whether the linear responses are hidden.
    #[serde(default)]
    pub hide_linear: bool,
}

/// A run of the quadruple-tank laboratory, and what is shown of it.
///
/// In JSON every key is in snake case, also the name of a choice that holds fields, and every name of a rig in kebab
/// case; units are SI.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// Version of the document: 1. It is checked before anything else is read.
    pub version: u32,
    /// What the experiment is called, and a note on it.
    #[serde(default, skip_serializing_if = "Label::is_empty")]
    pub label: Label,
    /// What a rig of one's own is called, of at most 80 characters. It is for people: nothing is computed from it.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub rig_name: String,
    /// The run that is worked on.
    pub setup: Setup,
    /// Runs pinned to compare with, at most 8.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pinned: Vec<Setup>,
    /// What the screen shows.
    #[serde(default)]
    pub view: View,
}

impl Scenario {
    /// How many pinned runs a scenario holds.
    pub const MAX_PINNED: usize = 8;

    /// The part of the run that the time axis shows (s), if it is not all of it: what was zoomed into, as far as the run goes.
    ///
    /// ```
    /// let mut scenario = quadtank_scenario::Scenario::default();
    /// scenario.setup.experiment.duration_s = 500.0;
    /// scenario.view.zoom_s = Some([400.0, 600.0]);
    /// assert_eq!(scenario.shown_time_s(), Some((400.0, 500.0)));
    /// scenario.view.zoom_s = Some([600.0, 700.0]);
    /// assert_eq!(scenario.shown_time_s(), None);
    /// ```
    pub fn shown_time_s(&self) -> Option<(f64, f64)> {
        let end_s = self.setup.experiment.duration_s;
        let [from, to] = self.view.zoom_s?;
        (from < end_s).then(|| (from, to.min(end_s)))
    }
}

impl BenchDocument for Scenario {
    type Setup = Setup;
    type Study = QuadrupleTankStudy;
    const BENCH: &'static str = "quadruple-tank";
    const VERSION: u32 = 1;
    const ROOT: &'static str = "setup";
    const DICTIONARY: &'static [u8] = include_bytes!("dictionary-1.jsonl");

    fn setup(&self) -> &Setup {
        &self.setup
    }

    fn setup_mut(&mut self) -> &mut Setup {
        &mut self.setup
    }

    fn pinned(&self) -> &[Setup] {
        &self.pinned
    }

    fn pinned_mut(&mut self) -> Option<&mut Vec<Setup>> {
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
        check_length("rig_name", &self.rig_name, Label::MAX_NAME)?;
        params::check(self)?;
        validate::version(self.version, Self::VERSION)?;
        validate::setup(&self.setup, "setup")?;
        validate::each(&self.pinned, "pinned", validate::setup)?;
        validate::view(&self.view, "view")
    }
}

impl From<Scenario> for Document {
    fn from(document: Scenario) -> Self {
        Self::Quadruple(document)
    }
}

impl TryFrom<Document> for Scenario {
    type Error = Document;

    fn try_from(document: Document) -> Result<Self, Document> {
        match document {
            Document::Quadruple(document) => Ok(document),
            other => Err(other),
        }
    }
}

/// The first published rig, nothing pinned.
impl Default for Scenario {
    fn default() -> Self {
        Self::from(setup_of(PresetId::JohanssonMinimumPhase))
    }
}

/// A setup alone, nothing pinned.
impl From<Setup> for Scenario {
    fn from(setup: Setup) -> Self {
        Self {
            version: Self::VERSION,
            label: Label::default(),
            rig_name: String::new(),
            setup,
            pinned: Vec::new(),
            view: View::default(),
        }
    }
}
