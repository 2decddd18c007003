use quadtank::sim::Trajectory;
use serde::Serialize;

use crate::Record;

/// How well a run agrees with a recorded signal, over the times that both have.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Agreement {
    /// Recorded values that were compared.
    pub values: usize,
    /// Root of the mean squared difference (m or V).
    pub rmse: f64,
    /// Largest difference (m or V).
    pub largest: f64,
    /// Fit `100 (1 − ‖y − ŷ‖/‖y − mean y‖)` (%) of Ljung (1999, §16.4), 100 for a run that is the record; negative for one that is
    /// worse than the mean. `None` for a record that never moves.
    pub fit_percent: Option<f64>,
}

/// How well a run agrees with a record; `None` for what was not recorded.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RecordAgreement {
    /// Levels of tanks 1 to 4.
    pub levels: [Option<Agreement>; 4],
    /// Voltages of pumps 1 and 2.
    pub pump_voltage: [Option<Agreement>; 2],
}

/// Compares a run with a record at the recorded times. Levels of the run are interpolated between its rows; its voltages hold.
pub fn agreement(record: &Record, run: &Trajectory) -> RecordAgreement {
    let of = |recorded: &[f64], simulated: &dyn Fn(f64) -> Option<f64>| {
        compared(record.time_s.iter().zip(recorded).filter_map(|(&time, &y)| Some((y, simulated(time)?))))
    };
    let level = |tank: usize| of(&record.levels[tank], &|time| interpolated(run, &run.levels[tank], time));
    let voltage = |pump: usize| of(&record.pump_voltage[pump], &|time| held(run, &run.pump_voltage[pump], time));
    RecordAgreement { levels: [0, 1, 2, 3].map(level), pump_voltage: [0, 1].map(voltage) }
}

/// Measured minus simulated levels of tanks 1 and 2 (m) at the recorded times: not a number in holes and outside the run, empty for a
/// level that was not recorded.
pub fn residuals(record: &Record, run: &Trajectory) -> [Vec<f64>; 2] {
    [0, 1].map(|tank| {
        let at = |(&time, &recorded): (&f64, &f64)| {
            recorded - interpolated(run, &run.levels[tank], time).unwrap_or(f64::NAN)
        };
        record.time_s.iter().zip(&record.levels[tank]).map(at).collect()
    })
}

/// A column of a run at a time (s), between its rows; `None` where the run is not.
pub(crate) fn interpolated(run: &Trajectory, column: &[f64], time: f64) -> Option<f64> {
    let after = row_after(run, time)?;
    let (y0, t0) = (column[after - 1], run.time_s[after - 1]);
    Some(match (column.get(after), run.time_s.get(after)) {
        (Some(&y1), Some(&t1)) => y0 + (y1 - y0) * (time - t0) / (t1 - t0),
        _ => y0,
    })
}

/// A column of a run at a time (s), as of the row before it.
fn held(run: &Trajectory, column: &[f64], time: f64) -> Option<f64> {
    Some(column[row_after(run, time)? - 1])
}

/// The first row after a time within the run (s).
fn row_after(run: &Trajectory, time: f64) -> Option<usize> {
    let (first, last) = (*run.time_s.first()?, *run.time_s.last()?);
    (first <= time && time <= last).then(|| run.time_s.partition_point(|&t| t <= time))
}

/// Recorded and simulated values against each other; holes are left out.
fn compared(pairs: impl Iterator<Item = (f64, f64)>) -> Option<Agreement> {
    let pairs: Vec<(f64, f64)> = pairs.filter(|(recorded, _)| !recorded.is_nan()).collect();
    if pairs.is_empty() {
        return None;
    }
    let count = pairs.len() as f64;
    let mean = pairs.iter().map(|(recorded, _)| recorded).sum::<f64>() / count;
    let error: f64 = pairs.iter().map(|(recorded, simulated)| (recorded - simulated).powi(2)).sum();
    let spread: f64 = pairs.iter().map(|(recorded, _)| (recorded - mean).powi(2)).sum();
    let largest = pairs.iter().map(|(recorded, simulated)| (recorded - simulated).abs()).fold(0.0, f64::max);
    // What rounding leaves of the mean of a constant is no movement.
    let moves = spread > count * (8.0 * f64::EPSILON * mean).powi(2);
    Some(Agreement {
        values: pairs.len(),
        rmse: (error / count).sqrt(),
        largest,
        fit_percent: moves.then(|| 100.0 * (1.0 - (error / spread).sqrt())),
    })
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    fn ramp() -> Trajectory {
        let times: Vec<f64> = (0..=10).map(f64::from).collect();
        let constant = |value: f64| vec![value; times.len()];
        Trajectory {
            levels: [times.iter().map(|t| 0.1 + 0.01 * t).collect(), constant(0.2), constant(0.0), constant(0.0)],
            pump_voltage: [times.iter().map(|&t| if t < 5.0 { 3.0 } else { 4.0 }).collect(), constant(3.0)],
            time_s: times,
            ..Trajectory::default()
        }
    }

    #[test]
    fn a_record_of_the_run_itself_agrees_to_rounding() {
        let times: Vec<f64> = (0..40).map(|k| 0.25 * f64::from(k)).collect();
        let record = Record {
            levels: [times.iter().map(|t| 0.1 + 0.01 * t).collect(), vec![0.2; 40], vec![], vec![]],
            pump_voltage: [times.iter().map(|&t| if t < 5.0 { 3.0 } else { 4.0 }).collect(), vec![]],
            time_s: times,
            ..Record::default()
        };
        let found = agreement(&record, &ramp());
        let first = found.levels[0].unwrap();
        assert!(first.rmse < 1e-15 && first.largest < 1e-15 && first.values == 40);
        assert_relative_eq!(first.fit_percent.unwrap(), 100.0, max_relative = 1e-9);
        assert_eq!(found.levels[1].unwrap().fit_percent, None);
        assert_eq!(found.levels[2], None);
        assert_eq!(found.pump_voltage[0].unwrap().rmse, 0.0);
    }

    #[test]
    fn figures_of_a_known_difference() {
        let record = Record {
            time_s: vec![0.0, 1.0, 2.0, 3.0, 99.0],
            levels: [vec![0.11, 0.12, f64::NAN, 0.12, 5.0], vec![], vec![], vec![]],
            ..Record::default()
        };
        let found = agreement(&record, &ramp()).levels[0].unwrap();
        // Differences 1, 1 and −1 cm; recorded 11, 12, 12 cm around 35/3: squares 4/9 + 1/9 + 1/9 = 2/3.
        assert_eq!(found.values, 3);
        assert_relative_eq!(found.rmse, 0.01, max_relative = 1e-12);
        assert_relative_eq!(found.largest, 0.01, max_relative = 1e-12);
        assert_relative_eq!(
            found.fit_percent.unwrap(),
            100.0 * (1.0 - (3.0_f64 / (2.0 / 3.0)).sqrt()),
            max_relative = 1e-9
        );
        let [first, second] = residuals(&record, &ramp());
        for (found, expected) in first.iter().zip([0.01, 0.01, f64::NAN, -0.01, f64::NAN]) {
            assert!((found - expected).abs() < 1e-12 || (found.is_nan() && expected.is_nan()), "{first:?}");
        }
        assert!(first.len() == 5 && second.is_empty());
    }
}
