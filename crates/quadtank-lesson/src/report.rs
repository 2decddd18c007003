use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::fingerprint::checksum;
use super::{Answer, Lesson, Progress, points_of};

/// With what a code begins: its format.
const MARK: &str = "QL1-";

/// Longest name in a code (characters).
const LONGEST_NAME: usize = 80;

/// What a student hands in.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Id of the lesson.
    pub lesson: String,
    /// Fingerprint of the lesson.
    pub fingerprint: String,
    /// The name that the student typed.
    pub name: String,
    /// What the numbers of this student follow from.
    pub seed: u32,
    /// Time spent (s).
    pub seconds: u32,
    /// Points reached, of 100.
    pub score: u32,
    /// What was done with each task.
    pub tasks: Vec<TaskReport>,
}

/// What a student did with a task.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TaskReport {
    /// Id of the task.
    pub id: String,
    /// Points reached.
    pub points: u32,
    /// Points that there are.
    pub of: u32,
    /// Wrong answers.
    pub wrong: u32,
    /// Hints asked for.
    pub hints: u32,
    /// Whether it was solved.
    pub solved: bool,
    /// The last answer; a code has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub answer: Option<Answer>,
}

/// Why a code cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ReportError {
    /// It does not begin as codes do.
    #[error("this is no code of a report: it does not begin with {MARK}")]
    NoCode,
    /// Characters are missing or changed.
    #[error("the code is damaged: characters are missing or changed")]
    Damaged,
}

impl Report {
    /// The report on what was done.
    pub fn of(lesson: &Lesson, progress: &Progress, name: &str) -> Self {
        let tasks = lesson.tasks().map(|(_, task)| {
            let record = progress.record(&task.id);
            TaskReport {
                id: task.id.clone(),
                points: points_of(task, &record),
                of: task.points,
                wrong: record.wrong,
                hints: record.hints,
                solved: record.solved,
                answer: record.answer,
            }
        });
        Self {
            lesson: lesson.id.clone(),
            fingerprint: progress.fingerprint.clone(),
            name: name.trim().chars().take(LONGEST_NAME).collect(),
            seed: progress.seed,
            seconds: whole(progress.seconds),
            score: progress.score(lesson),
            tasks: tasks.collect(),
        }
    }

    /// A short code without the answers. It has a checksum against typing errors and proves nothing: who wants to cheat can.
    pub fn to_code(&self) -> String {
        let tasks: Vec<String> = self.tasks.iter().map(TaskReport::to_code).collect();
        let fields = [
            self.lesson.clone(),
            self.fingerprint.clone(),
            self.seed.to_string(),
            self.seconds.to_string(),
            self.score.to_string(),
            tasks.join(","),
            self.name.replace(['\t', '\n'], " "),
        ];
        let text = fields.join("\t");
        let payload = format!("{text}\t{:08x}", checksum(text.as_bytes()));
        format!("{MARK}{}", URL_SAFE_NO_PAD.encode(payload))
    }

    /// Reads a code. Spaces and line breaks, as mail programs add them, do not matter.
    ///
    /// # Errors
    /// [`ReportError`].
    pub fn from_code(code: &str) -> Result<Self, ReportError> {
        let code: String = code.chars().filter(|c| !c.is_whitespace()).collect();
        let payload = code.strip_prefix(MARK).ok_or(ReportError::NoCode)?;
        let bytes = URL_SAFE_NO_PAD.decode(payload).map_err(|_| ReportError::Damaged)?;
        let payload = String::from_utf8(bytes).map_err(|_| ReportError::Damaged)?;
        Self::from_payload(&payload).ok_or(ReportError::Damaged)
    }

    fn from_payload(payload: &str) -> Option<Self> {
        let (text, sum) = payload.rsplit_once('\t')?;
        if sum != format!("{:08x}", checksum(text.as_bytes())) {
            return None;
        }
        let mut fields = text.splitn(7, '\t');
        let mut next = || fields.next();
        Some(Self {
            lesson: next()?.to_owned(),
            fingerprint: next()?.to_owned(),
            seed: next()?.parse().ok()?,
            seconds: next()?.parse().ok()?,
            score: next()?.parse().ok()?,
            tasks: next()?
                .split(',')
                .filter(|task| !task.is_empty())
                .map(TaskReport::from_code)
                .collect::<Option<_>>()?,
            name: next()?.to_owned(),
        })
    }
}

/// A time in whole seconds.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a cast saturates, and makes 0 of NaN")]
fn whole(seconds: f64) -> u32 {
    seconds.round() as u32
}

impl TaskReport {
    fn to_code(&self) -> String {
        let Self { id, points, of, wrong, hints, solved, .. } = self;
        format!("{id}:{points}:{of}:{wrong}:{hints}:{}", u8::from(*solved))
    }

    fn from_code(code: &str) -> Option<Self> {
        let mut fields = code.split(':');
        let id = fields.next()?.to_owned();
        let numbers: Vec<u32> = fields.map(str::parse).collect::<Result<_, _>>().ok()?;
        let [points, of, wrong, hints, solved] = numbers[..] else { return None };
        Some(Self { id, points, of, wrong, hints, solved: solved == 1, answer: None })
    }
}
