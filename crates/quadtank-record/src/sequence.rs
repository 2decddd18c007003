//! Input sequences of both pumps as text, one line per time.

use std::fmt::Write as _;

use quadtank::sim::PumpVoltageStep;
use quadtank_scenario::{Limits, limits};

use crate::{RecordError, Table};

/// What stands for a pump that follows its controller.
const NO_VOLTAGE: &str = "-";

/// Reads steps of the pumps, a line for each time: time (s), voltage of pump 1, and of pump 2 (V) where there is a third column. A pump
/// whose cell is empty or `-` stays as it is. Separators and decimal signs are those of a [`Table`].
///
/// # Errors
/// As [`Table::read`] and for the first line at fault; [`RecordError::SequenceColumns`], [`RecordError::NotAllowed`],
/// [`RecordError::TooManyMoves`].
///
/// # Examples
/// ```
/// let steps = quadtank_record::pump_sequence("0; 3,0; 3,0\n60; 3,5; 3,0\n")?;
/// assert_eq!((steps.len(), steps[2].time_s, steps[2].voltage), (3, 60.0, 3.5));
/// # Ok::<(), quadtank_record::RecordError>(())
/// ```
pub fn pump_sequence(text: &str) -> Result<Vec<PumpVoltageStep>, RecordError> {
    let table = Table::read(text.as_bytes())?;
    let [time, voltages @ ..] = table.columns.as_slice() else { return Err(RecordError::Empty) };
    if !(1..=2).contains(&voltages.len()) {
        return Err(RecordError::SequenceColumns { found: table.columns.len() });
    }
    let mut steps = Vec::new();
    for (pump, column) in voltages.iter().enumerate() {
        let mut last = None;
        for (row, (&time_s, &voltage)) in time.values.iter().zip(&column.values).enumerate() {
            let line = table.lines[row];
            if time_s.is_nan() {
                return Err(RecordError::TimeMissing { line });
            }
            check(time_s, limits::TIME_S, line, 1)?;
            if voltage.is_nan() || last == Some(voltage) {
                continue;
            }
            check(voltage, limits::PUMP_VOLTAGE, line, pump + 2)?;
            last = Some(voltage);
            steps.push(PumpVoltageStep { pump, time_s, voltage });
        }
    }
    steps.sort_by(|one, other| one.time_s.total_cmp(&other.time_s));
    if steps.len() > limits::MAX_PUMP_STEPS {
        return Err(RecordError::TooManyMoves { moves: steps.len(), max: limits::MAX_PUMP_STEPS });
    }
    Ok(steps)
}

fn check(value: f64, limits: Limits, line: usize, column: usize) -> Result<(), RecordError> {
    let Limits { min, max } = limits;
    if limits.contains(value) { Ok(()) } else { Err(RecordError::NotAllowed { line, column, value, min, max }) }
}

/// Steps of the pumps as [`pump_sequence`] reads them.
pub fn pump_sequence_text(steps: &[PumpVoltageStep]) -> String {
    let mut sorted = steps.to_vec();
    sorted.sort_by(|one, other| one.time_s.total_cmp(&other.time_s));
    let mut voltages = [None; 2];
    let mut text = String::new();
    for at_once in sorted.chunk_by(|one, other| one.time_s == other.time_s) {
        for step in at_once.iter().filter(|step| step.pump < 2) {
            voltages[step.pump] = Some(step.voltage);
        }
        let [one, two] = voltages.map(|voltage| voltage.map_or_else(|| NO_VOLTAGE.to_owned(), |v| v.to_string()));
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{}; {one}; {two}", at_once[0].time_s);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steps(text: &str) -> Vec<(usize, f64, f64)> {
        pump_sequence(text).unwrap().iter().map(|step| (step.pump, step.time_s, step.voltage)).collect()
    }

    #[test]
    fn lines_are_steps_of_both_pumps() {
        let expected = [(0, 0.0, 3.0), (1, 0.0, 2.5), (0, 60.5, 3.5), (1, 100.0, 3.0)];
        for text in [
            "0, 3, 2.5\n60.5, 3.5, 2.5\n100, 3.5, 3",
            "0; 3; 2,5\n60,5; 3,5; 2,5\n100; 3,5; 3\n",
            "t\tu1\tu2\n0\t3\t2,5\n60,5\t3,5\t-\n100\t-\t3\n",
            "0 3 2,5\n60,5 3,5 2,5\n100 3,5 3,0",
        ] {
            assert_eq!(steps(text), expected, "{text:?}");
        }
        assert_eq!(steps("0; 3\n10; 4"), [(0, 0.0, 3.0), (0, 10.0, 4.0)]);
        assert_eq!(steps("0; -; 3\n10; -; 4"), [(1, 0.0, 3.0), (1, 10.0, 4.0)]);
    }

    #[test]
    fn what_is_written_is_read_again() {
        for text in ["0; 3; 2.5\n60.5; 3.5; 2.5\n100; 3.5; 3\n", "0; -; 3\n10; -; 4\n", "0; 3; -\n5; 3; 2\n"] {
            assert_eq!(pump_sequence_text(&pump_sequence(text).unwrap()), text);
        }
        assert_eq!(pump_sequence_text(&[]), "");
    }

    #[test]
    fn faults_are_named_with_their_line() {
        let fault = |text: &str| pump_sequence(text).unwrap_err();
        assert_eq!(fault(""), RecordError::Empty);
        assert_eq!(fault("0;1;2;3\n"), RecordError::SequenceColumns { found: 4 });
        assert_eq!(fault("0;1;2\n5; x;2\n"), RecordError::NotANumber { line: 2, column: 2, cell: "x".to_owned() });
        assert_eq!(fault("0;1;2\n;1;2\n"), RecordError::TimeMissing { line: 2 });
        let error = RecordError::NotAllowed { line: 2, column: 3, value: -1.0, min: 0.0, max: 1000.0 };
        assert_eq!(fault("0;1;2\n5;1;-1\n"), error);
        assert!(matches!(fault("-5;1;2\n"), RecordError::NotAllowed { line: 1, column: 1, .. }));
    }
}
