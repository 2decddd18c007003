use std::ops::Range;

use thiserror::Error;

/// What is wrong with a formula or script, and where.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{fault}")]
pub struct FormulaError {
    /// What is wrong.
    pub fault: FormulaFault,
    /// The part of the text that it is about (bytes).
    pub span: Range<usize>,
}

/// What is wrong with a formula or script.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum FormulaFault {
    /// A text that is longer than any plant.
    #[error("{length} bytes, at most {max}")]
    TooLong {
        /// Its length.
        length: usize,
        /// The limit.
        max: usize,
    },
    /// The text ends where something has to follow.
    #[error("the text ends where something has to follow")]
    UnexpectedEnd,
    /// Something that cannot stand there.
    #[error("`{found}` cannot stand here")]
    Unexpected {
        /// What stands there.
        found: String,
    },
    /// A name that nothing was assigned to.
    #[error("`{name}` is not known; the variable is s, functions are exp, tf and zpk")]
    UnknownName {
        /// The name.
        name: String,
    },
    /// An approximation of a dead time, which is exact here.
    #[error("`pade` approximates a dead time, and dead times are exact here: write exp(-θ s)")]
    PadeApproximation,
    /// A state-space model.
    #[error(
        "`ss` is a state-space model, and a plant consists of transfer functions here: write tf(…) or zpk(…), such as tf(G) prints them"
    )]
    StateSpaceModel,
    /// The imaginary unit, in a zero or pole that is not real.
    #[error(
        "`{name}` is an imaginary unit, and zeros and poles of zpk have to be real here: write a pair of complex ones as a polynomial in s"
    )]
    ImaginaryUnit {
        /// i or j.
        name: String,
    },
    /// A quotation that does not end in its line.
    #[error("the quotation does not end")]
    OpenQuotation,
    /// Brackets within brackets without end.
    #[error("more than {max} brackets in one another")]
    TooDeep {
        /// Most of them.
        max: usize,
    },
    /// A list or a text where a number or an element has to be.
    #[error("this has to be a number or an element, not a list or a text")]
    NoElement,
    /// An element where a list of coefficients has to be.
    #[error("this has to be a list of numbers, the coefficient of the highest power of s first")]
    NoCoefficients,
    /// An exponent that is no whole number of moderate size.
    #[error("an exponent has to be a whole number between -{max} and {max}")]
    Exponent {
        /// Its largest magnitude.
        max: i32,
    },
    /// A division by zero.
    #[error("division by zero")]
    DivisionByZero,
    /// An exponential that is no dead time.
    #[error("exp(…) is a dead time and has to be exp(-θ s) with a number θ")]
    NoDeadTime,
    /// A dead time that would know the future.
    #[error("a dead time of {dead_time} would know the future")]
    Future {
        /// The dead time.
        dead_time: f64,
    },
    /// A sum of terms with dead times of their own, which is no element with one dead time.
    #[error("a sum of terms with different dead times, {first} and {second}, is not supported")]
    DifferentDeadTimes {
        /// Dead time of the first term.
        first: f64,
        /// Dead time of the second term.
        second: f64,
    },
    /// A polynomial of too high a degree.
    #[error("a polynomial of degree {degree}, at most {max}")]
    DegreeTooHigh {
        /// Its degree.
        degree: usize,
        /// The limit.
        max: usize,
    },
    /// A number that is not finite.
    #[error("the number is too large")]
    NotFinite,
    /// An option of `tf` or `zpk` that is not known.
    #[error("`{name}` is not known; options of tf and zpk are InputDelay, OutputDelay and IODelay")]
    UnknownOption {
        /// Its name.
        name: String,
    },
    /// Lists, delays or places that are not of the shape of the plant.
    #[error("the shape has to be that of a plant with two inputs and two outputs")]
    Shape,
    /// A script that defines no plant with two inputs and two outputs.
    #[error("no plant with two inputs and two outputs is defined; it would be [g11, g12; g21, g22]")]
    NoPlant,
}

/// A place in a text, for people.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Position {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// How many characters of the line the place covers, at least 1.
    pub width: usize,
}

impl FormulaError {
    pub(crate) fn new(fault: FormulaFault, span: Range<usize>) -> Self {
        Self { fault, span }
    }

    /// Where in the text the error is.
    pub fn position(&self, text: &str) -> Position {
        let boundary =
            |index: usize| (0..=index.min(text.len())).rev().find(|&i| text.is_char_boundary(i)).unwrap_or(0);
        let (start, end) = (boundary(self.span.start), boundary(self.span.end));
        let before = &text[..start];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let covered = text[start..end.max(start)].lines().next().unwrap_or_default();
        Position {
            line: before.matches('\n').count() + 1,
            column: text[line_start..start].chars().count() + 1,
            width: covered.chars().count().max(1),
        }
    }

    /// The line of the text that the error is in, and below it a line that marks the place.
    pub fn excerpt(&self, text: &str) -> String {
        let Position { line, column, width } = self.position(text);
        let shown = text.lines().nth(line - 1).unwrap_or_default();
        format!("{shown}\n{}{}", " ".repeat(column - 1), "^".repeat(width))
    }
}
