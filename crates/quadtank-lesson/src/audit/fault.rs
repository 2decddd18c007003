//! What can be wrong with a lesson.

use std::fmt;

use thiserror::Error;

use crate::{Tongue, UnitError};

/// Something wrong, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// Where in the lesson, tasks by their ids: `steps[2].tasks[zero].kind.number.mistakes[0]`.
    pub place: String,
    /// The student for whom it is wrong, where numbers differ from student to student.
    pub seed: Option<u32>,
    /// What is wrong.
    pub kind: FaultKind,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.kind)?;
        self.seed.map_or(Ok(()), |seed| write!(f, " (for the student with seed {seed})"))
    }
}

/// What can be wrong.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum FaultKind {
    /// A text is not there in a language of the lesson.
    #[error("no text in {}", .0.tag())]
    NoText(Tongue),
    /// A name leads nowhere.
    #[error("unknown {what} `{name}`{}", instead(known))]
    Unknown {
        /// What it should be.
        what: Named,
        /// The name.
        name: String,
        /// The names that there are, where they are few.
        known: Vec<&'static str>,
    },
    /// A name or language is there twice.
    #[error("`{0}` is there twice")]
    Twice(String),
    /// Something that looks like markup and is none.
    #[error("`{text}` is no markup: {meant}")]
    Markup {
        /// Its beginning.
        text: String,
        /// What it would be if it were.
        meant: &'static str,
    },
    /// Markup where only words are read.
    #[error("`{0}` stands inside bold words or the words of a link, where no other markup is read")]
    Nested(String),
    /// A card is to be hidden that is not shown.
    #[error("`{0}` is revealed, but is not among the panels of the step")]
    NotShown(String),
    /// A number varies in a step that begins with what the student left.
    #[error("only a step with a `start` can vary a number")]
    NothingToVary,
    /// A list that needs more entries.
    #[error("{found} entries, at least {least} are needed")]
    TooFew {
        /// How many it has.
        found: usize,
        /// How many it needs.
        least: usize,
    },
    /// A marked task without points, or points that are no marks.
    #[error("`choose`, `number`, `order` and `achieve` have points; `predict` and `explain` have 0")]
    Points,
    /// A choice without a right option, or with right ones only.
    #[error("there must be right and wrong options")]
    Options,
    /// A number that is none or two.
    #[error("a number has either a `quantity` or a `value`")]
    QuantityOrValue,
    /// Every answer is wrong.
    #[error("the tolerance must be more than 0")]
    Tolerance,
    /// A condition that always holds.
    #[error("a condition needs `at_least`, `at_most` or both")]
    NoBound,
    /// A condition that never holds.
    #[error("`at_least` is more than `at_most`")]
    Bounds,
    /// A unit does not fit.
    #[error(transparent)]
    Unit(#[from] UnitError),
    /// A state cannot be made.
    #[error("{0}")]
    State(String),
    /// There is no number to find.
    #[error("the quantity has no value in this state")]
    NoValue,
    /// The goal is reached before anything is done.
    #[error("the goal is reached before anything is done")]
    AlreadyReached,
    /// The solution does not reach the goal; the conditions that fail.
    #[error("the solution does not reach the goal: {0}")]
    NotReached(String),
    /// A listed mistake or attempt does not get its feedback.
    #[error("does not get its feedback: {0}")]
    NoFeedback(Instead),
}

/// Something with a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Named {
    /// A bench.
    Bench,
    /// A card of the bench.
    Card,
    /// A group of controls of the bench.
    Controls,
    /// A lesson.
    Lesson,
    /// A word of the glossary.
    Word,
    /// A formula.
    Formula,
    /// A quantity of the bench.
    Quantity,
}

impl fmt::Display for Named {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Bench => "bench",
            Self::Card => "card",
            Self::Controls => "group of controls",
            Self::Lesson => "lesson",
            Self::Word => "word of the glossary",
            Self::Formula => "formula",
            Self::Quantity => "quantity",
        })
    }
}

/// What a listed mistake or attempt gets in place of its feedback.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum Instead {
    /// There is no such number in this state.
    #[error("there is no such number in this state")]
    NoNumber,
    /// It is right.
    #[error("it is right")]
    Right,
    /// An earlier one of the list is recognised.
    #[error("entry {0} of the list, counted from 0, is recognised before")]
    Earlier(usize),
    /// It is not recognised; the values of its conditions.
    #[error("it is not recognised: {0}")]
    NotRecognised(String),
}

fn instead(known: &[&str]) -> String {
    if known.is_empty() { String::new() } else { format!("; there are {}", known.join(", ")) }
}
