//! Why a file is no record, a record cannot be run or fitted, or a table of steps not be used.

use quadtank_record::RecordError;

use super::fit_found::name;
use super::record_view::signal_name;
use crate::lab::Lab;
use crate::texts::tr;

/// Bytes of a megabyte, as files are counted.
const MEGABYTE: f64 = 1024.0 * 1024.0;

/// Why a file is no record, or cannot be run.
pub fn why(lab: Lab, error: &RecordError) -> String {
    let style = lab.number_style();
    let megabytes = |bytes: usize| style.fixed(bytes as f64 / MEGABYTE, 0);
    match error {
        RecordError::TooLarge { bytes, max } => {
            tr!(lab, record.too_large, size = megabytes(*bytes), max = megabytes(*max))
        }
        RecordError::NotText => tr!(lab, record.not_text),
        RecordError::Empty => tr!(lab, record.empty),
        RecordError::OneColumn => tr!(lab, record.one_column),
        RecordError::Ragged { line, expected, found } => {
            tr!(lab, record.ragged, line = line, expected = expected, found = found)
        }
        RecordError::NotANumber { line, column, cell } => {
            tr!(lab, record.not_a_number, line = line, column = column, cell = cell)
        }
        RecordError::TwoDecimalSigns { line, column, cell } => {
            tr!(lab, record.two_signs, line = line, column = column, cell = cell)
        }
        RecordError::NoTime => tr!(lab, record.no_time),
        RecordError::NoSignal => tr!(lab, record.no_signal),
        RecordError::SameSignal { columns: [one, other], signal } => {
            tr!(lab, record.same, one = one, other = other, signal = signal_name(lab, *signal))
        }
        RecordError::TimeMissing { line } => tr!(lab, record.time_missing, line = line),
        RecordError::TimeRunsBack { line, before, after } => {
            let [before, after] = [before, after].map(|&time| style.significant(time, 6));
            tr!(lab, record.time_back, line = line, before = before, after = after)
        }
        RecordError::TooManyMoves { moves, max } => tr!(lab, record.too_many, moves = moves, max = max),
        RecordError::NothingToFit => tr!(lab, record.nothing_to_fit),
        RecordError::TooFewValues { values, parameters } => {
            tr!(lab, record.too_few, values = values, parameters = parameters)
        }
        RecordError::WrongBounds { parameter, .. } => tr!(lab, record.wrong_bounds, name = name(lab, *parameter)),
        RecordError::SequenceColumns { .. } => tr!(lab, experiment.table_lines),
        RecordError::NotAllowed { line, column, value, min, max } => {
            let [value, min, max] = [value, min, max].map(|&number| style.significant(number, 4));
            tr!(lab, record.not_allowed, line = line, column = column, value = value, min = min, max = max)
        }
        RecordError::CannotRun => tr!(lab, record.cannot_run),
    }
}
