use std::collections::BTreeMap;

use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use serde::{Deserialize, Serialize};

use super::{Answer, Lesson, Task, Verdict, fingerprint};

/// Longest text that a learning management system keeps for a lesson (SCORM 1.2, `cmi.suspend_data`; characters).
pub const SUSPEND_LIMIT: usize = 4096;

/// After so many wrong answers the solution is shown.
const MOST_WRONG: u32 = 3;

/// What a student has done with a task.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// The last answer.
    pub answer: Option<Answer>,
    /// How many answers were wrong.
    #[serde(default)]
    pub wrong: u32,
    /// How many hints were asked for.
    #[serde(default)]
    pub hints: u32,
    /// Whether it is answered rightly, or at all where it is not marked.
    #[serde(default)]
    pub solved: bool,
    /// Whether the solution was shown.
    #[serde(default)]
    pub shown: bool,
}

impl Record {
    /// Whether there is nothing left to do.
    pub fn is_done(&self) -> bool {
        self.solved || self.shown
    }

    /// Takes an answer up. One that comes after the task is done changes nothing.
    pub fn take(&mut self, task: &Task, answer: Answer, verdict: Verdict) {
        if self.is_done() {
            return;
        }
        self.answer = Some(answer);
        self.solved = verdict.is_right;
        if !verdict.is_right && task.kind.counts_attempts() {
            self.wrong += 1;
            self.shown = self.wrong >= MOST_WRONG;
        }
    }
}

/// The points of a task: a wrong answer and a hint cost one each.
pub fn points_of(task: &Task, record: &Record) -> u32 {
    if record.solved { task.points.saturating_sub(record.wrong + record.hints) } else { 0 }
}

/// What a student has done in a lesson.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    /// Id of the lesson.
    pub lesson: String,
    /// The [`fingerprint`] of the lesson.
    pub fingerprint: String,
    /// What the numbers of this student follow from.
    pub seed: u32,
    /// The step that is open, from 0.
    #[serde(default)]
    pub step: usize,
    /// Time spent (s).
    #[serde(default)]
    pub seconds: f64,
    /// What was done, by ids of tasks.
    #[serde(default)]
    pub records: BTreeMap<String, Record>,
}

impl Progress {
    /// Nothing done yet.
    pub fn new(lesson: &Lesson, seed: u32) -> Self {
        let (lesson, fingerprint) = (lesson.id.clone(), fingerprint(lesson));
        Self { lesson, fingerprint, seed, step: 0, seconds: 0.0, records: BTreeMap::new() }
    }

    /// Whether it is of exactly this lesson.
    pub fn is_of(&self, lesson: &Lesson) -> bool {
        self.lesson == lesson.id && self.fingerprint == fingerprint(lesson) && self.step < lesson.steps.len()
    }

    /// What was done with a task.
    pub fn record(&self, task: &str) -> Record {
        self.records.get(task).cloned().unwrap_or_default()
    }

    /// Points so far.
    pub fn points(&self, lesson: &Lesson) -> u32 {
        lesson.tasks().map(|(_, task)| points_of(task, &self.record(&task.id))).sum()
    }

    /// Points so far, of 100.
    pub fn score(&self, lesson: &Lesson) -> u32 {
        let (points, of) = (self.points(lesson), lesson.points());
        (100 * points + of / 2).checked_div(of).unwrap_or(100)
    }

    /// Whether all tasks of a step are done.
    pub fn is_step_done(&self, lesson: &Lesson, step: usize) -> bool {
        lesson.steps.get(step).is_some_and(|step| step.tasks.iter().all(|task| self.record(&task.id).is_done()))
    }

    /// Whether all tasks are done.
    pub fn is_complete(&self, lesson: &Lesson) -> bool {
        (0..lesson.steps.len()).all(|step| self.is_step_done(lesson, step))
    }

    /// All of it as a text of at most [`SUSPEND_LIMIT`] characters, for a learning management system. Free texts are cut, evenly,
    /// where they do not fit; the report has them whole.
    pub fn to_suspend_data(&self) -> String {
        let mut cut = self.clone();
        let mut longest = SUSPEND_LIMIT;
        loop {
            let text = serde_json::to_string(&cut).map(|json| URL_SAFE_NO_PAD.encode(json)).unwrap_or_default();
            if text.len() <= SUSPEND_LIMIT || longest == 0 {
                return text;
            }
            longest /= 2;
            for record in cut.records.values_mut() {
                if let Some(Answer::Text(text)) = &mut record.answer {
                    *text = text.chars().take(longest).collect();
                }
            }
        }
    }

    /// Reads what [`to_suspend_data`](Self::to_suspend_data) wrote for this lesson; `None` for anything else.
    pub fn from_suspend_data(text: &str, lesson: &Lesson) -> Option<Self> {
        let json = URL_SAFE_NO_PAD.decode(text.trim()).ok()?;
        serde_json::from_slice::<Self>(&json).ok().filter(|progress| progress.is_of(lesson))
    }
}
