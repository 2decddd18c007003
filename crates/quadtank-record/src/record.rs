use quadtank::sim::{InflowStep, PumpVoltageStep};

use crate::{Mapping, RecordError, Signal, Table};

/// A pump that moves by less than this (V) stands still: it is far below what a converter resolves, 2.4 mV with 12 bits over 10 V, and it
/// spares a document the thousands of last moves of a loop that comes to rest.
const MIN_MOVE_V: f64 = 1e-4;
/// The same for a flow from outside (m³/s).
const MIN_MOVE_OF_FLOW: f64 = 1e-9;

/// A record of a rig in SI, from its first time on. Signals that were not recorded are empty; a hole is not a number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record {
    /// Time since the first row (s), rising.
    pub time_s: Vec<f64>,
    /// Levels of tanks 1 to 4 (m).
    pub levels: [Vec<f64>; 4],
    /// References of levels 1 and 2 (m).
    pub references: [Vec<f64>; 2],
    /// Voltages of pumps 1 and 2 (V).
    pub pump_voltage: [Vec<f64>; 2],
    /// Flow into tanks 1 to 4 from outside (m³/s).
    pub inflow: [Vec<f64>; 4],
    /// Rows that were left out since they have the time of the row before.
    pub repeated: usize,
    /// Cells of the signals that are holes.
    pub missing: usize,
}

impl Record {
    /// The record of a table. `sensor_gain` (V/m) turns levels in volts into metres.
    ///
    /// # Errors
    /// As [`Mapping::check`], and [`RecordError::TimeMissing`] or [`RecordError::TimeRunsBack`] for the first row at fault.
    pub fn of(table: &Table, mapping: &Mapping, sensor_gain: f64) -> Result<Self, RecordError> {
        mapping.check()?;
        let column = |signal: Signal| -> Vec<f64> {
            let Some(index) = mapping.column_of(signal) else { return Vec::new() };
            let factor = mapping.0[index].map_or(1.0, |meaning| meaning.unit.in_si(sensor_gain));
            table.columns[index].values.iter().map(|value| value * factor).collect()
        };
        let (rows, time_s) = rising(&column(Signal::Time), &table.lines)?;
        let kept = |signal: Signal| -> Vec<f64> {
            let all = column(signal);
            if all.is_empty() { all } else { rows.iter().map(|&row| all[row]).collect() }
        };
        let mut record = Self {
            levels: [0, 1, 2, 3].map(|tank| kept(Signal::Level(tank))),
            references: [0, 1].map(|level| kept(Signal::Reference(level))),
            pump_voltage: [0, 1].map(|pump| kept(Signal::PumpVoltage(pump))),
            inflow: [0, 1, 2, 3].map(|tank| kept(Signal::Inflow(tank))),
            repeated: table.len() - rows.len(),
            missing: 0,
            time_s,
        };
        record.missing = record.columns().flatten().filter(|value| value.is_nan()).count();
        Ok(record)
    }

    fn columns(&self) -> impl Iterator<Item = &Vec<f64>> {
        self.levels.iter().chain(&self.references).chain(&self.pump_voltage).chain(&self.inflow)
    }

    /// How long it is (s).
    pub fn duration_s(&self) -> f64 {
        self.time_s.last().copied().unwrap_or(0.0)
    }

    /// Levels of all tanks at its beginning (m); `None` where one was not recorded.
    pub fn first_levels(&self) -> Option<[f64; 4]> {
        let mut levels = [0.0; 4];
        for (level, column) in levels.iter_mut().zip(&self.levels) {
            *level = column.iter().copied().find(|value| !value.is_nan())?;
        }
        Some(levels)
    }

    /// The moves of the pumps whose voltages were recorded, as an experiment takes them: each recorded value holds until the next one
    /// that differs by a tenth of a millivolt.
    /// The first one is at the beginning.
    ///
    /// # Errors
    /// [`RecordError::TooManyMoves`] beyond `most` moves.
    pub fn pump_moves(&self, most: usize) -> Result<Vec<PumpVoltageStep>, RecordError> {
        let moves: Vec<PumpVoltageStep> = (0..2).flat_map(|pump| self.moves_of(pump)).collect();
        if moves.len() > most { Err(RecordError::TooManyMoves { moves: moves.len(), max: most }) } else { Ok(moves) }
    }

    fn moves_of(&self, pump: usize) -> impl Iterator<Item = PumpVoltageStep> {
        let moves = moves(&self.time_s, &self.pump_voltage[pump], MIN_MOVE_V);
        moves.map(move |(time_s, voltage)| PumpVoltageStep { pump, time_s, voltage })
    }

    /// The moves of the inflows that were recorded, each value until the next one that differs by 1 mm³/s.
    ///
    /// # Errors
    /// [`RecordError::TooManyMoves`] beyond `most` moves.
    pub fn inflow_moves(&self, most: usize) -> Result<Vec<InflowStep>, RecordError> {
        let of_tank = |tank: usize| {
            let moves = moves(&self.time_s, &self.inflow[tank], MIN_MOVE_OF_FLOW);
            moves.map(move |(time_s, flow)| InflowStep { tank, time_s, flow })
        };
        let moves: Vec<InflowStep> = (0..4).flat_map(of_tank).collect();
        if moves.len() > most { Err(RecordError::TooManyMoves { moves: moves.len(), max: most }) } else { Ok(moves) }
    }
}

/// When a recorded signal has moved by more than `least`, and to which value, from its first one on.
fn moves<'a>(time_s: &'a [f64], column: &'a [f64], least: f64) -> impl Iterator<Item = (f64, f64)> + 'a {
    let mut last = None::<f64>;
    time_s.iter().zip(column).filter_map(move |(&time_s, &value)| {
        let moves = !value.is_nan() && last.is_none_or(|last| (value - last).abs() > least);
        moves.then(|| {
            last = Some(value);
            (time_s, value)
        })
    })
}

/// The rows whose times rise, and their times from the first one on (s).
fn rising(time: &[f64], lines: &[usize]) -> Result<(Vec<usize>, Vec<f64>), RecordError> {
    let (mut rows, mut times) = (Vec::new(), Vec::<f64>::new());
    let start = time.first().copied().unwrap_or(0.0);
    for (row, (&time, &line)) in time.iter().zip(lines).enumerate() {
        if time.is_nan() {
            return Err(RecordError::TimeMissing { line });
        }
        let since = time - start;
        match times.last() {
            Some(&before) if since < before => {
                return Err(RecordError::TimeRunsBack { line, before: before + start, after: time });
            }
            Some(&before) if since == before => {}
            _ => {
                rows.push(row);
                times.push(since);
            }
        }
    }
    Ok((rows, times))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(text: &str) -> Result<Record, RecordError> {
        let table = Table::read(text.as_bytes())?;
        Record::of(&table, &Mapping::guess(&table), 50.0)
    }

    #[test]
    fn a_record_is_in_si_from_its_first_time_on() {
        let found = record("t (min),h1 (cm),h2 (V),u1\n10,12,6,3\n10.5,,6.5,3\n10.5,13,6.6,3\n11,14,7,4\n").unwrap();
        assert_eq!(found.time_s, [0.0, 30.0, 60.0]);
        assert_eq!((found.levels[0][0], found.levels[0][2]), (0.12, 0.14));
        assert!(found.levels[0][1].is_nan() && found.levels[2].is_empty());
        assert_eq!(found.levels[1], [0.12, 0.13, 0.14]);
        assert_eq!((found.repeated, found.missing, found.duration_s()), (1, 1, 60.0));
        assert_eq!(found.first_levels(), None);
        let moves = [(0.0, 3.0), (60.0, 4.0)].map(|(time_s, voltage)| PumpVoltageStep { pump: 0, time_s, voltage });
        assert_eq!(found.pump_moves(2).unwrap(), moves);
        assert_eq!(found.pump_moves(1), Err(RecordError::TooManyMoves { moves: 2, max: 1 }));
    }

    #[test]
    fn a_time_that_is_missing_or_runs_back_is_named() {
        assert_eq!(record("t,h1\n0,1\n,1\n"), Err(RecordError::TimeMissing { line: 3 }));
        let back = RecordError::TimeRunsBack { line: 4, before: 7.0, after: 6.0 };
        assert_eq!(record("t,h1\n5,1\n7,1\n6,1\n"), Err(back));
    }

    #[test]
    fn a_run_begins_at_the_first_values_of_all_levels() {
        let found = record("t,h1,h2,h3,h4\n0,2,1,,3\n1,2,1,8,3\n").unwrap();
        assert_eq!(found.first_levels(), Some([0.02, 0.01, 0.08, 0.03]));
    }
}
