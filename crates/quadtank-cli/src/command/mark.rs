//! Marks an answer to a task of a lesson.

use std::path::Path;

use quadtank_lesson::{
    Answer, Lesson, NumberTask, Of, Record, Task, TaskKind, Tongue, Values, check, feedback_text, goals, points_of,
    state_before, with_settings,
};
use quadtank_scenario::{DOCUMENT_LIMIT, Document, Quantities, document_from_bytes, read_json};
use serde_json::{Value, json};

use super::check::{CheckFault, CheckOptions, lesson_of};
use super::files::{bytes_of, print_json};
use super::{Failure, document, told};

/// Marks the answer on standard input.
pub fn run(options: &CheckOptions) -> Result<(), Failure> {
    let [file] = options.files.as_slice() else { return Err(CheckFault::SeveralFiles.into()) };
    let lesson = lesson_of(file)?;
    let (step, task) = task_of(&lesson, options)?;
    let input = Path::new("-");
    let bytes = bytes_of(input, DOCUMENT_LIMIT)?;
    let (answer, state) = match &task.kind {
        TaskKind::Achieve(_) => (Answer::Bench, Some(told(input, document_from_bytes(&bytes))?)),
        kind => {
            let answer: Answer = told(input, read_json(&bytes, DOCUMENT_LIMIT))?;
            if let Some(expected) = expected_instead(kind, &answer) {
                return Err(CheckFault::Answer { task: task.id.clone(), expected }.into());
            }
            (answer, number_state(&lesson, step, task, options)?)
        }
    };
    of_bench(&lesson, state.as_ref())?;
    let tongue = lesson.tongue(Tongue::of_tag(&options.lang).unwrap_or(Tongue::En));
    print_json(&marked(task, answer, state.as_ref(), tongue))
}

/// The task that is meant, and its step, from 0.
fn task_of<'a>(lesson: &'a Lesson, options: &CheckOptions) -> Result<(usize, &'a Task), CheckFault> {
    let Some(step) = options.step else {
        let id = options.task.as_ref().ok_or(CheckFault::NoTask)?;
        let known = || lesson.tasks().map(|(_, task)| task.id.clone()).collect();
        return lesson.task(id).ok_or_else(|| CheckFault::UnknownTask { task: id.clone(), known: known() });
    };
    let index = step as usize - 1;
    let count = lesson.steps.len();
    let tasks = &lesson.steps.get(index).ok_or(CheckFault::NoStep { step, count })?.tasks;
    let known = || tasks.iter().map(|task| task.id.clone()).collect();
    let task = match (&options.task, tasks.as_slice()) {
        (Some(id), tasks) => tasks.iter().find(|task| task.id == *id).ok_or_else(|| CheckFault::NotInStep {
            step,
            task: id.clone(),
            known: known(),
        })?,
        (None, [only]) => only,
        (None, _) => return Err(CheckFault::WhichTask { step, known: known() }),
    };
    Ok((index, task))
}

/// What answers to a task look like, for one of another kind.
fn expected_instead(kind: &TaskKind, answer: &Answer) -> Option<&'static str> {
    match (kind, answer) {
        (TaskKind::Predict(_) | TaskKind::Choose(_), Answer::Choice(_))
        | (TaskKind::Number(_), Answer::Number(_))
        | (TaskKind::Order(_), Answer::Order(_))
        | (TaskKind::Explain(_), Answer::Text(_)) => None,
        (TaskKind::Predict(_) | TaskKind::Choose(_), _) => Some(r#"an option, from 0: {"choice": 0}"#),
        (TaskKind::Number(_), _) => Some(r#"a number in the unit of the task: {"number": 0.5}"#),
        (TaskKind::Order(_), _) => Some(r#"the items, from 0, as the student put them: {"order": [1, 0, 2]}"#),
        (TaskKind::Explain(_), _) => Some(r#"a text: {"text": "…"}"#),
        (TaskKind::Achieve(_), _) => Some("a document of the bench"),
    }
}

/// The state that a number is about; none for other tasks. The document of the options stands for what the student left;
/// without it the steps before are done as the lesson solves them.
fn number_state(
    lesson: &Lesson,
    step: usize,
    task: &Task,
    options: &CheckOptions,
) -> Result<Option<Document>, Failure> {
    let TaskKind::Number(NumberTask { of, set, .. }) = &task.kind else { return Ok(None) };
    let tasks = &lesson.steps[step].tasks;
    let left = options.document.as_ref().filter(|_| *of == Of::Present || lesson.steps[step].start.is_none());
    let state = match (left, of) {
        (Some(file), _) => return told(file, with_settings(&document(file)?, set)).map(Some),
        (None, Of::Start) => state_before(lesson, step, 0, options.seed),
        (None, Of::Present) => {
            let index = tasks.iter().position(|other| other.id == task.id).unwrap_or_default();
            state_before(lesson, step, index, options.seed)
        }
    };
    let state = state.and_then(|state| Ok(with_settings(&state, set)?));
    state.map(Some).map_err(|error| CheckFault::State { task: task.id.clone(), error }.into())
}

fn of_bench(lesson: &Lesson, state: Option<&Document>) -> Result<(), CheckFault> {
    match state.map(Document::bench).filter(|found| *found != lesson.bench) {
        Some(found) => Err(CheckFault::OtherBench { found, expected: lesson.bench.clone() }),
        None => Ok(()),
    }
}

/// What has no quantities: a task that is about no state.
struct NoState;

impl Values for NoState {
    fn value(&self, _: &str) -> Option<(f64, &'static str)> {
        None
    }
}

/// What is said about an answer.
fn marked(task: &Task, answer: Answer, state: Option<&Document>, tongue: Tongue) -> Value {
    let values = state.map(Quantities::of);
    let verdict = match &values {
        Some(values) => check(task, &answer, values),
        None => check(task, &answer, &NoState),
    };
    let mut record = Record::default();
    record.take(task, answer, verdict);
    let text = verdict.feedback.and_then(|feedback| feedback_text(task, feedback));
    let mut said = json!({
        "task": task.id,
        "is_right": verdict.is_right,
        "feedback": verdict.feedback,
        "text": text.map(|text| text.shown(tongue)),
        "points": points_of(task, &record),
        "of": task.points,
    });
    if let (TaskKind::Achieve(goal), Some(values)) = (&task.kind, &values) {
        said["goals"] = json!(goals(goal, values));
    }
    said
}
