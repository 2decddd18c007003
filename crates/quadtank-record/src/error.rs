use thiserror::Error;

use crate::{Parameter, Signal};

/// Why a text is not a record, or a record cannot be used.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum RecordError {
    /// More than any record of a laboratory.
    #[error("the file has {bytes} bytes, at most {max} are read")]
    TooLarge {
        /// Its size.
        bytes: usize,
        /// The largest size.
        max: usize,
    },
    /// Bytes that are no text.
    #[error("the file is not text in UTF-8 or Latin-1")]
    NotText,
    /// Nothing, or names of columns alone.
    #[error("the file has no row of numbers")]
    Empty,
    /// No separator leads to more than one column.
    #[error(
        "the file has one column only; columns are separated by comma, semicolon, tab or blank, and time is one of them"
    )]
    OneColumn,
    /// A row with more or fewer cells than the first one.
    #[error("line {line} has {found} cells, the first row has {expected}")]
    Ragged {
        /// Line of the file, from 1.
        line: usize,
        /// Cells of the first row.
        expected: usize,
        /// Cells of this one.
        found: usize,
    },
    /// A cell that is text where numbers are.
    #[error("line {line}, column {column}: `{cell}` is not a number")]
    NotANumber {
        /// Line of the file, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What is there.
        cell: String,
    },
    /// A cell with more than one decimal sign, or with signs of thousands.
    #[error(
        "line {line}, column {column}: `{cell}` has more than one decimal sign; write thousands without a sign between them"
    )]
    TwoDecimalSigns {
        /// Line of the file, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What is there.
        cell: String,
    },
    /// No column is the time.
    #[error("no column is the time")]
    NoTime,
    /// No column is a signal of the rig.
    #[error("no column is a level, a reference, a pump voltage or an inflow")]
    NoSignal,
    /// Two columns are said to be the same signal.
    #[error("columns {columns:?} are both {signal:?}")]
    SameSignal {
        /// The columns, from 1.
        columns: [usize; 2],
        /// What both are.
        signal: Signal,
    },
    /// A row without a time.
    #[error("line {line} has no time")]
    TimeMissing {
        /// Line of the file, from 1.
        line: usize,
    },
    /// A time that is before that of the row above it.
    #[error("line {line}: the time {after} s comes after {before} s; the time has to rise")]
    TimeRunsBack {
        /// Line of the file, from 1.
        line: usize,
        /// Time of the row above (s).
        before: f64,
        /// Its own time (s).
        after: f64,
    },
    /// A pump that moves more often than an experiment can hold.
    #[error("pumps, inflows or references move {moves} times in the record; an experiment holds {max} moves")]
    TooManyMoves {
        /// How often they move.
        moves: usize,
        /// How often they may.
        max: usize,
    },
    /// No parameter is free, or no level was recorded.
    #[error("nothing to fit: choose parameters, and record levels")]
    NothingToFit,
    /// Fewer values than parameters.
    #[error("{values} recorded values do not tell {parameters} parameters")]
    TooFewValues {
        /// Values that can be compared.
        values: usize,
        /// Free parameters.
        parameters: usize,
    },
    /// A pump sequence whose number of columns is not two or three.
    #[error("a line has {found} cells; it is a time and one or two voltages")]
    SequenceColumns {
        /// Cells of a line.
        found: usize,
    },
    /// A time or a voltage outside of its limits.
    #[error("line {line}, column {column}: {value} is outside {min} to {max}")]
    NotAllowed {
        /// Line of the text, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// The number.
        value: f64,
        /// Smallest allowed value.
        min: f64,
        /// Largest allowed value.
        max: f64,
    },
    /// Bounds of a search that are no interval, or lie outside of the limits of the parameter.
    #[error("{}: its bounds are two values between {min} and {max} in {}, the smaller one first", parameter.name(), parameter.unit())]
    WrongBounds {
        /// The parameter.
        parameter: Parameter,
        /// The smallest value that is allowed.
        min: f64,
        /// The largest one.
        max: f64,
    },
    /// The experiment of the record cannot be run on the rig.
    #[error("the experiment of the record cannot be run on this rig")]
    CannotRun,
}
