//! Feedback on answers, and hints while a student tries.

use leptos::prelude::*;
use quadtank_lesson::{Answer, Feedback, Record, Task, TaskKind};

use super::classroom::Classroom;

/// Feedback that is shown below a task.
#[derive(Clone, Debug, PartialEq)]
pub struct Remark {
    /// Id of the task.
    pub task: String,
    /// The feedback; `None` where only the verdict is shown.
    pub feedback: Option<Feedback>,
    /// Whether the answer was right; nothing for a remark on something that is no answer.
    pub verdict: Option<bool>,
}

impl Remark {
    /// Feedback of a task that is done already.
    pub fn before(task: &Task, record: &Record) -> Option<Self> {
        let feedback = match (&task.kind, record.answer.as_ref().filter(|_| record.is_done())?) {
            (TaskKind::Choose(_), Answer::Choice(index)) => Some(Feedback::Option(*index)),
            (TaskKind::Explain(_), _) => Some(Feedback::Model),
            _ => None,
        };
        Some(Self { task: task.id.clone(), feedback, verdict: Some(record.solved) })
    }
}

/// An answer that a student has given.
#[derive(Clone, Debug, PartialEq)]
pub struct Given {
    /// Id of the task.
    pub task: String,
    /// Whether it was right.
    pub is_right: bool,
}

impl Classroom {
    /// Shows a remark, which replaces the one on the same task.
    pub fn say(self, remark: Remark) {
        self.said.update(|said| {
            said.retain(|other| other.task != remark.task);
            said.push(remark);
        });
    }

    /// Shows a hint on a task without marking it, or removes it.
    pub fn say_in_passing(self, id: &str, feedback: Option<Feedback>) {
        let of_task = |remark: &&Remark| remark.task == id;
        let is_said = self.said.with_untracked(|said| said.iter().find(of_task).and_then(|remark| remark.feedback));
        if is_said == feedback {
            return;
        }
        match feedback {
            Some(_) => self.say(Remark { task: id.to_owned(), feedback, verdict: None }),
            None => self.said.update(|said| said.retain(|remark| remark.task != id)),
        }
    }
}
