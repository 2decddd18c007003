//! Lessons: what a student reads, is asked, and is marked for, as documents; all of it without a screen.
//!
//! A [`Lesson`] comes in by [`read_lesson`]. [`check`] marks an answer to a [`Task`], a [`Progress`] holds what a student has done
//! so far, and a [`Report`] is what is handed in. [`audit`] says what is wrong with a lesson that somebody wrote. The format is
//! described for its authors in `docs/lessons.md`.

mod audit;
mod bench;
mod built_in;
mod check;
mod fingerprint;
mod formula;
mod glossary;
mod lesson;
mod markdown;
mod progress;
mod report;
#[cfg(test)]
mod sample;
#[cfg(feature = "schema")]
mod schema;
mod scorm;
mod solution;
mod start;
mod task;
mod text;
mod units;

pub use audit::{Fault, FaultKind, Instead, Named, audit};
pub use bench::{BenchNames, bench_ids, bench_names};
pub use built_in::LESSON_IDS;
#[cfg(feature = "built-in")]
pub use built_in::{BUILT_IN, built_in};
pub use check::{Answer, Feedback, Goal, Values, Verdict, check, conditions_met, feedback_text, goals};
pub use fingerprint::fingerprint;
pub use formula::{Formula, NAMED_FORMULAS, named_formula, parse_formula};
pub use glossary::TERMS;
pub use lesson::{LESSON_LIMIT, Lesson, Start, Step, Variation, read_lesson};
pub use markdown::{Block, LiveValue, Place, Span, parse_markdown};
pub use progress::{Progress, Record, SUSPEND_LIMIT, points_of};
pub use report::{Report, ReportError, TaskReport};
#[cfg(feature = "schema")]
pub use schema::lesson_schema;
pub use scorm::{PackageError, PageError, scorm_package};
pub use solution::{Solution, solutions};
pub use start::{StartError, shuffled, start_of, state_before, with_settings};
pub use task::{
    Achieve, Attempt, Choice, Choose, Condition, Explain, Mistake, MistakeKind, NumberTask, Of, Order, Predict, Task,
    TaskKind, Tolerance,
};
pub use text::{Text, Tongue};
pub use units::{UnitError, in_unit};
