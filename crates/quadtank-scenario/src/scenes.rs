//! Scenes: experiments in the order in which a lecture shows them.

use serde::Serialize;

use super::codec::{Document, check_length, document_from_tree, tree_of, written};
use super::error::malformed;
use super::text::text_of;
use super::tree::Tree;
use super::{Label, ScenarioError, document_from_link};

/// The field of a file that holds scenes, and says that it does.
const FIELD: &str = "scenes";
/// What stands between the links of scenes; no link has it.
const SEPARATOR: &str = ",";

/// Experiments of any bench in the order in which a lecture shows them. The title of a scene is the name of its experiment.
///
/// As a file it is `{"scenes": [document, …]}`, as a link the links of its documents with commas between them.
///
/// ```
/// use quadtank_scenario::{Document, Scenario, Scenes};
///
/// let scenes = Scenes { documents: vec![Document::Quadruple(Scenario::default()); 2] };
/// assert_eq!(Scenes::from_link(&scenes.to_link()?)?, scenes);
/// # Ok::<(), quadtank_scenario::ScenarioError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Scenes {
    /// The experiments, the first one first.
    #[serde(rename = "scenes")]
    pub documents: Vec<Document>,
}

/// What a file of the laboratory holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Opened {
    /// One experiment.
    Document(Box<Document>),
    /// Experiments in the order of a lecture.
    Scenes(Scenes),
}

impl Scenes {
    /// Most scenes of a lecture.
    pub const MAX: usize = 40;

    /// Reads the text that [`Self::to_link`] writes.
    ///
    /// # Errors
    /// [`ScenarioError::Scene`] for the first scene that is no link of a document, [`ScenarioError::TooMany`].
    pub fn from_link(link: &str) -> Result<Self, ScenarioError> {
        let links: Vec<&str> = link.split(SEPARATOR).collect();
        Self::of(&links, |link| document_from_link(link))
    }

    /// Writes text for the fragment of a URL, in which only commas are added to those of [`to_link`](super::to_link).
    ///
    /// # Errors
    /// [`ScenarioError::Scene`] for the first document that has no link, [`ScenarioError::TooMany`].
    pub fn to_link(&self) -> Result<String, ScenarioError> {
        check_count(self.documents.len())?;
        let link = |(index, document): (usize, &Document)| document.to_link().map_err(of_scene(index));
        Ok(self.documents.iter().enumerate().map(link).collect::<Result<Vec<_>, _>>()?.join(SEPARATOR))
    }

    /// Writes the file.
    ///
    /// # Errors
    /// What could not be read again is not written: [`ScenarioError::Scene`] for the first such document,
    /// [`ScenarioError::TooMany`] scenes, [`ScenarioError::TooLong`].
    pub fn to_json(&self) -> Result<String, ScenarioError> {
        check_count(self.documents.len())?;
        for (index, document) in self.documents.iter().enumerate() {
            document.validate().map_err(of_scene(index))?;
        }
        written(self)
    }

    fn from_tree(tree: &Tree, scenes: &Tree) -> Result<Self, ScenarioError> {
        if let Tree::Map(entries) = tree
            && let Some((name, _)) = entries.iter().find(|(name, value)| name != FIELD || value != scenes)
        {
            return Err(malformed(name.clone(), format!("a file of scenes has the field `{FIELD}` alone")));
        }
        match scenes {
            Tree::List(trees) => Self::of(trees, document_from_tree),
            _ => Err(malformed(FIELD.to_owned(), "no list of documents".to_owned())),
        }
    }

    fn of<T>(parts: &[T], read: impl Fn(&T) -> Result<Document, ScenarioError>) -> Result<Self, ScenarioError> {
        check_count(parts.len())?;
        let read = |(index, part)| read(part).map_err(of_scene(index));
        Ok(Self { documents: parts.iter().enumerate().map(read).collect::<Result<_, _>>()? })
    }
}

fn check_count(count: usize) -> Result<(), ScenarioError> {
    let error = ScenarioError::TooMany { field: FIELD.to_owned(), count, max: Scenes::MAX };
    if count > Scenes::MAX { Err(error) } else { Ok(()) }
}

/// What is wrong with a scene, from what is wrong with its document.
fn of_scene(index: usize) -> impl Fn(ScenarioError) -> ScenarioError {
    move |error| ScenarioError::Scene { index, error: Box::new(error) }
}

/// Reads a file of either kind: a document, or scenes.
///
/// # Errors
/// As [`document_from_bytes`](super::document_from_bytes), within a scene as [`ScenarioError::Scene`].
pub fn opened_from_bytes(bytes: &[u8]) -> Result<Opened, ScenarioError> {
    check_length(bytes.len())?;
    let tree = tree_of(&text_of(bytes)?)?;
    match tree.get(FIELD) {
        Some(scenes) => Scenes::from_tree(&tree, scenes).map(Opened::Scenes),
        None => Ok(Opened::Document(Box::new(document_from_tree(&tree)?))),
    }
}

impl Document {
    /// What the experiment is called, and a note on it.
    pub fn label(&self) -> &Label {
        match self {
            Self::Quadruple(scenario) => &scenario.label,
            Self::Tuning(scenario) => &scenario.label,
            Self::ModelFree(scenario) => &scenario.label,
            Self::LevelLoop(scenario) => &scenario.label,
        }
    }

    /// The same, to change it.
    pub fn label_mut(&mut self) -> &mut Label {
        match self {
            Self::Quadruple(scenario) => &mut scenario.label,
            Self::Tuning(scenario) => &mut scenario.label,
            Self::ModelFree(scenario) => &mut scenario.label,
            Self::LevelLoop(scenario) => &mut scenario.label,
        }
    }
}

#[cfg(test)]
mod tests {
    use quadtank::sim::PumpVoltageStep;

    use super::*;
    use crate::level_loop::LevelLoopScenario;
    use crate::tuning::TuningScenario;
    use crate::{DOCUMENT_LIMIT, Scenario, document_from_bytes};

    fn lecture() -> Scenes {
        let mut first = Document::Quadruple(Scenario::default());
        first.label_mut().name = "γ₁ + γ₂ > 1, \"easy\"".to_owned();
        let others = [Document::Tuning(TuningScenario::default()), Document::LevelLoop(LevelLoopScenario::default())];
        Scenes { documents: [first].into_iter().chain(others).collect() }
    }

    #[test]
    fn scenes_come_back_from_files_and_links_in_their_order() {
        let scenes = lecture();
        let text = scenes.to_json().unwrap();
        assert_eq!(opened_from_bytes(text.as_bytes()), Ok(Opened::Scenes(scenes.clone())));
        let link = scenes.to_link().unwrap();
        assert_eq!(Scenes::from_link(&link), Ok(scenes));
        assert!(link.chars().all(|c| c.is_ascii_alphanumeric() || ".-_,".contains(c)), "{link}");
    }

    #[test]
    fn a_file_with_one_document_is_that_document() {
        let document = lecture().documents.remove(0);
        let text = document.to_json().unwrap();
        assert_eq!(opened_from_bytes(text.as_bytes()), Ok(Opened::Document(Box::new(document))));
    }

    #[test]
    fn a_scene_that_cannot_be_read_is_named_with_its_place() {
        let text = lecture().to_json().unwrap();
        let wrong = text.replacen("\"gain\": ", "\"gian\": ", 1);
        let error = opened_from_bytes(wrong.as_bytes()).unwrap_err();
        assert!(error.to_string().starts_with("scenes[0].setup."), "{error}");
        let later = text.replacen("\"version\": 4", "\"version\": 5", 1);
        assert_eq!(
            opened_from_bytes(later.as_bytes()).unwrap_err().to_string(),
            "scenes[2].version: 5 is unknown, this program reads 1 to 4"
        );
        let link = lecture().to_link().unwrap();
        assert_eq!(
            Scenes::from_link(&format!("{link},q1.!")).unwrap_err(),
            ScenarioError::Scene { index: 3, error: Box::new(ScenarioError::DamagedLink) }
        );
    }

    #[test]
    fn what_is_no_list_of_scenes_is_refused() {
        let text = |bytes: &str| opened_from_bytes(bytes.as_bytes()).unwrap_err().to_string();
        assert_eq!(text("{\"scenes\": 3}"), "scenes: no list of documents");
        assert_eq!(text("{\"scenes\": [], \"title\": 1}"), "title: a file of scenes has the field `scenes` alone");
        let many = format!("{{\"scenes\": [{}0]}}", "0,".repeat(Scenes::MAX));
        assert_eq!(text(&many), "scenes: 41 entries, at most 40");
        assert_eq!(text("{\"scenes\": [0]}"), "scenes[0].document: missing field `version`");
        // Where one document is expected, many are refused.
        assert!(document_from_bytes(lecture().to_json().unwrap().as_bytes()).is_err());
    }

    #[test]
    fn what_could_not_be_read_again_is_not_written() {
        let many = Scenes { documents: vec![Document::Quadruple(Scenario::default()); Scenes::MAX + 1] };
        let error = ScenarioError::TooMany { field: "scenes".to_owned(), count: Scenes::MAX + 1, max: Scenes::MAX };
        assert_eq!(many.to_json(), Err(error.clone()));
        assert_eq!(many.to_link(), Err(error));

        let mut scenario = Scenario::default();
        let step = |k: u32| PumpVoltageStep { pump: 0, time_s: f64::from(k), voltage: 3.0 };
        scenario.setup.experiment.pump_voltage_steps = (0..4000).map(step).collect();
        let long = Document::Quadruple(scenario);
        assert!(opened_from_bytes(long.to_json().unwrap().as_bytes()).is_ok());
        let scenes = Scenes { documents: vec![long; Scenes::MAX] };
        assert!(matches!(scenes.to_json(), Err(ScenarioError::TooLong { max: DOCUMENT_LIMIT, .. })));
    }
}
