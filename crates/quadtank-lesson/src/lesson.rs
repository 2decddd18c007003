use quadtank_scenario::{ScenarioError, read_json};
use serde::{Deserialize, Serialize};

use super::{Task, Text, Tongue};

/// Longest lesson that is read (bytes): several times the longest of the laboratory.
pub const LESSON_LIMIT: usize = 256 * 1024;

/// Most steps of a lesson, and most items of any list in it.
const MOST_STEPS: usize = 12;

/// A lesson: what is told, what is asked, and in which state of a bench.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Lesson {
    /// Version of the format: 1.
    pub lesson: u32,
    /// Name in links and reports: lower-case letters, digits, hyphens.
    pub id: String,
    /// The bench beside it: `quadruple-tank`, `relay-tuning`, `model-free` or `level-loop`.
    pub bench: String,
    /// About how long it takes (min).
    pub minutes: u32,
    /// The languages in which every text is written.
    pub languages: Vec<Tongue>,
    /// What the list of lessons calls it.
    pub title: Text,
    /// One sentence on what is discovered.
    pub summary: Text,
    /// Ids of lessons that should come before.
    #[serde(default)]
    pub prerequisites: Vec<String>,
    /// What a student can do afterwards.
    #[serde(default)]
    pub outcomes: Vec<Text>,
    /// What students often believe before; for the teacher.
    #[serde(default)]
    pub misconceptions: Vec<Text>,
    /// Where the facts are from: author, year, equation.
    #[serde(default)]
    pub source: String,
    /// The steps, 1 to 12.
    pub steps: Vec<Step>,
}

/// A step of a lesson: a state of the bench, a text, tasks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Step {
    /// Its title.
    pub title: Text,
    /// State of the bench when the step begins; without it the bench stays as the student left it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<Start>,
    /// Numbers that differ from student to student.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub vary: Vec<Variation>,
    /// The cards that are shown, the one that matters most first.
    pub panels: Vec<String>,
    /// Those of them that are hidden until the tasks are answered.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub reveal: Vec<String>,
    /// Groups of controls that cannot be changed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lock: Vec<String>,
    /// What is told, with markup (see [`parse_markdown`](super::parse_markdown)).
    pub text: Text,
    /// What is asked.
    #[serde(default)]
    pub tasks: Vec<Task>,
    /// What is told when all tasks are answered.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub after: Option<Text>,
}

/// A state of a bench: a published one or that of a link, with settings.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Start {
    /// Name of a published rig or case.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub preset: Option<String>,
    /// A link to a state, or what follows its `#`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub link: Option<String>,
    /// Settings, such as `setup.valves[0]=0.4`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub set: Vec<String>,
}

/// A number that differs from student to student.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Variation {
    /// Where it is in the document of the bench.
    pub path: String,
    /// The values, one of which each student gets (unit of the field).
    pub among: Vec<f64>,
}

impl Lesson {
    /// All tasks, each with the index of its step.
    pub fn tasks(&self) -> impl Iterator<Item = (usize, &Task)> {
        self.steps.iter().enumerate().flat_map(|(index, step)| step.tasks.iter().map(move |task| (index, task)))
    }

    /// The task with an id, and the index of its step.
    pub fn task(&self, id: &str) -> Option<(usize, &Task)> {
        self.tasks().find(|(_, task)| task.id == id)
    }

    /// The sum of the points of all tasks.
    pub fn points(&self) -> u32 {
        self.tasks().map(|(_, task)| task.points).sum()
    }

    /// The language in which it is shown to a reader of another.
    pub fn tongue(&self, wanted: Tongue) -> Tongue {
        if self.languages.contains(&wanted) { wanted } else { self.languages.first().copied().unwrap_or(wanted) }
    }
}

/// Reads a lesson from JSON.
///
/// # Errors
/// [`ScenarioError::TooLong`] beyond [`LESSON_LIMIT`]; [`ScenarioError::UnknownVersion`]; [`ScenarioError::Malformed`], which
/// names the field; [`ScenarioError::TooMany`] steps or tasks. [`audit`](super::audit) finds what else may be wrong with it.
pub fn read_lesson(bytes: &[u8]) -> Result<Lesson, ScenarioError> {
    let lesson: Lesson = read_json(bytes, LESSON_LIMIT)?;
    if lesson.lesson != 1 {
        return Err(ScenarioError::UnknownVersion { found: u64::from(lesson.lesson), newest: 1 });
    }
    let refused =
        |path: &str, reason: &str| Err(ScenarioError::Malformed { path: path.to_owned(), reason: reason.to_owned() });
    let is_id = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    if lesson.id.is_empty() || lesson.id.len() > 60 || !lesson.id.chars().all(is_id) {
        return refused("id", "1 to 60 lower-case letters, digits and hyphens are allowed");
    }
    if lesson.steps.is_empty() {
        return refused("steps", "a lesson has at least one step");
    }
    if lesson.languages.is_empty() {
        return refused("languages", "a lesson has at least one language");
    }
    let counted = |field: String, count: usize| match count {
        0..=MOST_STEPS => Ok(()),
        _ => Err(ScenarioError::TooMany { field, count, max: MOST_STEPS }),
    };
    counted("steps".to_owned(), lesson.steps.len())?;
    for (index, step) in lesson.steps.iter().enumerate() {
        counted(format!("steps[{index}].tasks"), step.tasks.len())?;
    }
    Ok(lesson)
}
