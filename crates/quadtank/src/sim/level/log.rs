use std::ops::Range;

use super::SampleStatistics;
use crate::plant::level::{LevelPlant, LevelSignals};

/// The log of a run: one row every `log_step_s`, from t = 0 to the end.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LevelLog {
    /// Time (s).
    pub time_s: Vec<f64>,
    /// Signal that the set-point stands for.
    pub reference: Vec<f64>,
    /// Disturbed inflow (m³/s), at a jump that after it.
    pub inflow: Vec<f64>,
    /// Level (m).
    pub level: Vec<f64>,
    /// Signal of the transmitter, behind its lag, before it is clipped.
    pub transmitted: Vec<f64>,
    /// Controller output.
    pub output: Vec<f64>,
    /// Pressure that acts in the actuator.
    pub actuator_pressure: Vec<f64>,
    /// Travel of the valve, 0 to 1.
    pub travel: Vec<f64>,
    /// Flow through the control valve (m³/s).
    pub valve_flow: Vec<f64>,
    /// Outflow (m³/s).
    pub outflow: Vec<f64>,
    /// How long the tank was full to the brim (s), in steps of integration.
    pub full_s: f64,
    /// How long it was empty (s), likewise.
    pub empty_s: f64,
    /// Steps of integration that the run took: its work.
    pub steps: usize,
}

impl LevelLog {
    /// Number of rows.
    pub fn len(&self) -> usize {
        self.time_s.len()
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.time_s.is_empty()
    }

    pub(super) fn clear(&mut self) {
        for column in [
            &mut self.time_s,
            &mut self.reference,
            &mut self.inflow,
            &mut self.level,
            &mut self.transmitted,
            &mut self.output,
            &mut self.actuator_pressure,
            &mut self.travel,
            &mut self.valve_flow,
            &mut self.outflow,
        ] {
            column.clear();
        }
        (self.full_s, self.empty_s, self.steps) = (0.0, 0.0, 0);
    }

    /// Rows from one time to another (s), both included.
    pub fn rows(&self, from_s: f64, until_s: f64) -> Range<usize> {
        let slack = 1e-9 * self.time_s.last().copied().unwrap_or(0.0);
        let begin = self.time_s.partition_point(|&time| time < from_s - slack);
        let end = self.time_s.partition_point(|&time| time <= until_s + slack);
        begin..end.max(begin)
    }

    /// Statistics of level and outflow over rows; `None` of fewer than two.
    pub fn statistics(&self, rows: Range<usize>) -> Option<[SampleStatistics; 2]> {
        let of = |column: &[f64]| SampleStatistics::of(column.get(rows.clone())?);
        Some([of(&self.level)?, of(&self.outflow)?])
    }

    /// All signals of a row.
    pub fn signals(&self, plant: &LevelPlant, row: usize) -> Option<LevelSignals> {
        let at = |column: &[f64]| column.get(row).copied();
        Some(plant.signals(
            at(&self.level)?,
            at(&self.transmitted)?,
            at(&self.output)?,
            at(&self.actuator_pressure)?,
            at(&self.inflow)?,
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_a_window_include_both_ends() {
        let log = LevelLog { time_s: (0..301).map(f64::from).collect(), ..LevelLog::default() };
        assert_eq!((log.rows(50.0, 150.0), log.rows(0.0, 1e9)), (50..151, 0..301));
        assert_eq!(log.rows(400.0, 500.0).len(), 0);
        assert_eq!(log.rows(9.0, 3.0).len(), 0);
        assert_eq!(LevelLog::default().rows(0.0, 1.0).len(), 0);
    }
}
