use quadtank_scenario::{ScenarioError, read_json};
use serde::{Deserialize, Serialize};

use super::{Task, Text, Tongue, bench_ids, bench_names};

/// Longest lesson that is read (bytes): several times the longest of the laboratory.
pub const LESSON_LIMIT: usize = 256 * 1024;

/// The version of the format.
const VERSION: u32 = 1;

/// Most steps of a lesson, and most entries of any list in it but that of settings.
const MOST: usize = 12;

/// Most tasks of a lesson: what is kept of them has to fit into [`SUSPEND_LIMIT`](super::SUSPEND_LIMIT).
pub(super) const MAX_TASKS: usize = 30;

/// Longest id of a task.
pub(super) const LONGEST_TASK_ID: usize = 40;

/// Most points of a task.
const MAX_POINTS: u32 = 100;

/// What all versions have.
#[derive(Deserialize)]
struct Version {
    lesson: u32,
}

/// A lesson: what is told, what is asked, and in which state of a bench.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Lesson {
    /// Version of the format: 1.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 1)))]
    pub lesson: u32,
    /// Name in links and reports: lower-case letters, digits, hyphens.
    #[cfg_attr(feature = "schema", schemars(regex(pattern = "^[a-z0-9-]{1,60}$")))]
    pub id: String,
    /// The bench beside it: `quadruple-tank`, `relay-tuning`, `model-free` or `level-loop`.
    pub bench: String,
    /// About how long it takes (min).
    pub minutes: u32,
    /// The languages in which every text is written.
    #[cfg_attr(feature = "schema", schemars(length(min = 1)))]
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
    #[cfg_attr(feature = "schema", schemars(length(min = 1, max = 12)))]
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
    /// What is told, with the markup that `docs/lessons.md` describes.
    pub text: Text,
    /// What is asked.
    #[serde(default)]
    #[cfg_attr(feature = "schema", schemars(length(max = 12)))]
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
/// names the field; [`ScenarioError::TooMany`] entries of a list. [`audit`](super::audit) finds what else may be wrong with it.
pub fn read_lesson(bytes: &[u8]) -> Result<Lesson, ScenarioError> {
    let lesson: Lesson = read_json(bytes, LESSON_LIMIT).map_err(|error| of_version(bytes).unwrap_or(error))?;
    if lesson.lesson != VERSION {
        return Err(unknown(lesson.lesson));
    }
    is_id("id", &lesson.id, 60)?;
    if bench_names(&lesson.bench).is_none() {
        let known = bench_ids().join(", ");
        return refused("bench", &format!("`{}` is no bench; there are {known}", quoted(&lesson.bench)));
    }
    if lesson.steps.is_empty() {
        return refused("steps", "a lesson has at least one step");
    }
    if lesson.languages.is_empty() {
        return refused("languages", "a lesson has at least one language");
    }
    for (field, count, max) in lesson.counts() {
        if count > max {
            return Err(ScenarioError::TooMany { field, count, max });
        }
    }
    for (step, task) in lesson.tasks() {
        is_id(&format!("steps[{step}].tasks[{}].id", task.id), &task.id, LONGEST_TASK_ID)?;
        if task.points > MAX_POINTS {
            return refused(&format!("steps[{step}].tasks[{}].points", task.id), "0 to 100 are allowed");
        }
    }
    Ok(lesson)
}

/// What is wrong with the version of a file that cannot be read: a later one may have fields that are unknown here.
fn of_version(bytes: &[u8]) -> Option<ScenarioError> {
    let Version { lesson } = serde_json::from_slice(bytes).ok().filter(|_| bytes.len() <= LESSON_LIMIT)?;
    (lesson != VERSION).then(|| unknown(lesson))
}

fn unknown(version: u32) -> ScenarioError {
    ScenarioError::UnknownVersion { found: u64::from(version), newest: VERSION }
}

fn refused<T>(path: &str, reason: &str) -> Result<T, ScenarioError> {
    Err(ScenarioError::Malformed { path: path.to_owned(), reason: reason.to_owned() })
}

/// The beginning of a name that may be long.
fn quoted(name: &str) -> String {
    name.chars().take(40).collect()
}

/// Ids stand in links, reports and codes.
fn is_id(path: &str, id: &str, longest: usize) -> Result<(), ScenarioError> {
    let is_allowed = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    if id.is_empty() || id.len() > longest || !id.chars().all(is_allowed) {
        return refused(path, &format!("1 to {longest} lower-case letters, digits and hyphens are allowed"));
    }
    Ok(())
}

impl Lesson {
    /// The lists with their lengths and the longest that are read.
    fn counts(&self) -> Vec<(String, usize, usize)> {
        let mut counts = vec![
            ("steps".to_owned(), self.steps.len()),
            ("prerequisites".to_owned(), self.prerequisites.len()),
            ("outcomes".to_owned(), self.outcomes.len()),
            ("misconceptions".to_owned(), self.misconceptions.len()),
        ];
        for (index, step) in self.steps.iter().enumerate() {
            counts.push((format!("steps[{index}].vary"), step.vary.len()));
            counts.extend(step.vary.iter().map(|varied| (format!("steps[{index}].vary.among"), varied.among.len())));
            counts.push((format!("steps[{index}].tasks"), step.tasks.len()));
        }
        for (index, task) in self.tasks() {
            let place = format!("steps[{index}].tasks[{}]", task.id);
            counts.push((format!("{place}.hints"), task.hints.len()));
            counts.extend(task.kind.counts().map(|(field, count)| (format!("{place}.kind.{field}"), count)));
        }
        let lists = counts.into_iter().map(|(field, count)| (field, count, MOST));
        lists.chain([("steps, all tasks".to_owned(), self.tasks().count(), MAX_TASKS)]).collect()
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::*;
    use crate::sample::{SMALL, changed, lesson};

    /// What is said about the file with changes.
    fn error(changes: &[(&str, Value)]) -> String {
        read_lesson(changed(changes).as_bytes()).unwrap_err().to_string()
    }

    #[test]
    fn a_lesson_is_read_with_all_it_has() {
        let lesson = lesson();
        assert_eq!((lesson.id.as_str(), lesson.steps.len(), lesson.points()), ("small-lesson", 2, 10));
        assert_eq!(lesson.tasks().map(|(step, _)| step).collect::<Vec<_>>(), [0, 0, 1, 1, 1, 1, 1]);
        assert_eq!(lesson.task("order").map(|(step, task)| (step, task.points)), Some((1, 1)));
        assert!(lesson.task("none").is_none());
        assert_eq!((lesson.tongue(Tongue::Es), lesson.tongue(Tongue::PtBr)), (Tongue::Es, Tongue::En));
    }

    #[test]
    fn what_is_written_is_read_again() {
        let written = serde_json::to_string(&lesson()).unwrap();
        assert_eq!(read_lesson(written.as_bytes()), Ok(lesson()));
    }

    #[test]
    fn a_lesson_in_utf_16_is_read() {
        let bytes: Vec<u8> = SMALL.encode_utf16().flat_map(u16::to_le_bytes).collect();
        assert_eq!(read_lesson(&[b"\xff\xfe".as_slice(), &bytes].concat()), Ok(lesson()));
    }

    #[test]
    fn a_field_that_is_unknown_missing_or_of_another_kind_is_named_with_its_place() {
        for (change, place) in [
            (("/steps/0/tasks/1/kind/number/tolerence", json!(1)), "steps[0].tasks[1].kind.number.tolerence: "),
            (
                ("/steps/1/tasks/2/kind/choose/options/0/text/de", json!("x")),
                "steps[1].tasks[2].kind.choose.options[0].text.de: ",
            ),
            (("/steps/0/tasks/0/points", json!("two")), "steps[0].tasks[0].points: "),
            (("/steps/0/tasks/0/points", json!(-1)), "steps[0].tasks[0].points: "),
            (("/steps/0/tasks/0/kind", json!({ "guess": {} })), "steps[0].tasks[0].kind: "),
            (("/steps/0/tasks/1/kind/number/tolerance", json!({})), "steps[0].tasks[1].kind.number.tolerance: "),
            (("/languages/1", json!("de")), "languages[1]: "),
            (("/steps/1", json!({ "title": {}, "text": {} })), "steps[1]"),
        ] {
            let error = error(std::slice::from_ref(&change));
            assert!(error.starts_with(place), "{error}");
        }
    }

    #[test]
    fn a_file_that_is_no_json_is_refused_with_line_and_column() {
        let error = read_lesson(SMALL.replacen("\"id\":", "\"id\"", 1).as_bytes()).unwrap_err().to_string();
        assert!(error.contains("line 3"), "{error}");
        assert!(read_lesson(b"").is_err() && read_lesson(b"[]").is_err() && read_lesson(&[0xff, 0xc0]).is_err());
    }

    #[test]
    fn a_later_version_is_named_even_with_fields_that_are_unknown_here() {
        for changes in [vec![("/lesson", json!(2))], vec![("/lesson", json!(2)), ("/steps/0/animation", json!("x"))]] {
            assert_eq!(
                read_lesson(changed(&changes).as_bytes()),
                Err(ScenarioError::UnknownVersion { found: 2, newest: 1 })
            );
        }
        assert!(error(&[("/lesson", json!(0))]).contains("version: 0"));
        assert!(error(&[("/lesson", json!("1"))]).starts_with("lesson: "));
    }

    #[test]
    fn a_file_that_is_too_long_is_refused() {
        let text = format!("{SMALL}{}", " ".repeat(LESSON_LIMIT));
        assert!(matches!(read_lesson(text.as_bytes()), Err(ScenarioError::TooLong { max: LESSON_LIMIT, .. })));
    }

    #[test]
    fn hostile_nesting_is_refused() {
        for open in ["[", "{\"lesson\":1,\"steps\":[", "{\"lesson\":", "{\"a\":"] {
            assert!(read_lesson(open.repeat(20_000).as_bytes()).is_err());
        }
        let nested = format!("{}1{}", "[".repeat(60_000), "]".repeat(60_000));
        assert!(
            read_lesson(SMALL.replacen("\"minutes\": 5", &format!("\"minutes\": {nested}"), 1).as_bytes()).is_err()
        );
    }

    #[test]
    fn the_bench_is_one_that_there_is() {
        let benches = "there are quadruple-tank, relay-tuning, model-free, level-loop";
        assert_eq!(error(&[("/bench", json!("tanks"))]), format!("bench: `tanks` is no bench; {benches}"));
        assert!(error(&[("/bench", json!("x".repeat(5000)))]).len() < 200);
    }

    #[test]
    fn ids_are_short_names() {
        for id in ["", "Upper", "a b", "a/b", "ä", "a:b", &"x".repeat(61)] {
            assert!(error(&[("/id", json!(id))]).starts_with("id: 1 to 60 "), "{id}");
        }
        for id in ["", "a:b", "a,b", "a\tb", &"x".repeat(41)] {
            let error = error(&[("/steps/0/tasks/0/id", json!(id))]);
            assert!(error.contains(".id: 1 to 40 "), "{error}");
        }
    }

    #[test]
    fn lists_have_at_most_twelve_entries_and_a_lesson_thirty_tasks() {
        let step = |tasks: Vec<Value>| json!({ "title": {}, "panels": [], "text": {}, "tasks": tasks });
        let task = |number: usize| json!({ "id": format!("t{number}"), "question": {}, "kind": { "explain": { "model": {} } } });
        let steps = |count: usize, tasks: usize| {
            let steps: Vec<_> =
                (0..count).map(|step_| step((0..tasks).map(|number| task(100 * step_ + number)).collect())).collect();
            ("/steps", json!(steps))
        };
        assert!(read_lesson(changed(&[steps(12, 2)]).as_bytes()).is_ok());
        assert_eq!(error(&[steps(13, 0)]), "steps: 13 entries, at most 12");
        assert_eq!(error(&[steps(1, 13)]), "steps[0].tasks: 13 entries, at most 12");
        assert_eq!(error(&[steps(11, 3)]), "steps, all tasks: 33 entries, at most 30");
        assert_eq!(error(&[("/outcomes", json!(vec![json!({}); 13]))]), "outcomes: 13 entries, at most 12");
        let items = ("/steps/1/tasks/3/kind/order/items", json!(vec![json!({}); 40]));
        assert_eq!(error(&[items]), "steps[1].tasks[order].kind.order.items: 40 entries, at most 12");
        let hints = ("/steps/0/tasks/1/hints", json!(vec![json!({}); 13]));
        assert_eq!(error(&[hints]), "steps[0].tasks[zero].hints: 13 entries, at most 12");
    }

    #[test]
    fn a_lesson_needs_a_step_a_language_and_points_that_can_be_added() {
        assert!(error(&[("/steps", json!([]))]).starts_with("steps: "));
        assert!(error(&[("/languages", json!([]))]).starts_with("languages: "));
        assert_eq!(
            error(&[("/steps/0/tasks/1/points", json!(101))]),
            "steps[0].tasks[zero].points: 0 to 100 are allowed"
        );
    }
}
