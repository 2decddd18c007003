//! The experiment that a record is a record of.

use quadtank::plant::OperatingPoint;
use quadtank::sim::{Measurement, SetPointStep};
use quadtank::study::quadruple_tank::Setup;
use quadtank_scenario::limits;

use crate::{Record, RecordError};

/// A reference that moves by no more than this (m) stands still.
const STILL: f64 = 1e-9;

/// Two spacings that differ by no more than this share are the same.
const SAME_SPACING: f64 = 1e-9;

/// The setup in the experiment of a record: it begins at the first levels of the record, at rest where one was not recorded, and lasts as
/// long. Pumps whose voltages were recorded follow them; where none was, the references follow the recorded ones.
/// Tanks whose inflow from outside was recorded receive it. What the experiment of the setup did to the rig is not done; the measurement has no noise.
///
/// With both pumps recorded no controller acts, and the sampling time becomes the spacing of the record, so that every move of a pump
/// is met.
///
/// # Errors
/// [`RecordError::TooManyMoves`] where pumps, inflows or references move more often than an experiment holds.
pub fn replay(record: &Record, setup: &Setup) -> Result<Setup, RecordError> {
    let mut replayed = setup.clone();
    let rest = setup.operating_point().ok();
    let moves = record.pump_moves(limits::MAX_PUMP_STEPS)?;
    let inflows = record.inflow_moves(limits::MAX_PUMP_STEPS)?;
    if record.pump_voltage.iter().all(|column| !column.is_empty()) {
        replayed.controller.sampling_time_s = limits::sampling_time_s(record.duration_s()).clamp(spacing(record));
    }
    let duration = limits::duration_s(replayed.controller.sampling_time_s);
    let experiment = &mut replayed.experiment;
    experiment.duration_s = duration.clamp(record.duration_s());
    experiment.load_steps.clear();
    experiment.set_point_steps = match rest {
        Some(rest) if moves.is_empty() => reference_steps(record, &rest)?,
        _ => Vec::new(),
    };
    experiment.pump_voltage_steps = moves;
    experiment.inflow_steps = inflows;
    experiment.measurement = Measurement { noise_std: 0.0, ..experiment.measurement };
    experiment.initial_levels = first_levels(record, setup);
    Ok(replayed)
}

/// The first levels of the record within the walls (m), or those of the setup at rest; `None` where there is neither, and where none was
/// recorded.
pub(crate) fn first_levels(record: &Record, setup: &Setup) -> Option<[f64; 4]> {
    if record.levels.iter().all(Vec::is_empty) {
        return None;
    }
    let rest = setup.operating_point().ok();
    let mut levels = [0.0; 4];
    for (tank, level) in levels.iter_mut().enumerate() {
        let recorded = record.levels[tank].iter().copied().find(|value| !value.is_nan());
        let height = setup.plant.rig().tanks[tank].height;
        *level = recorded.or(rest.map(|rest| rest.levels[tank]))?.clamp(0.0, height);
    }
    Some(levels)
}

/// Time between most rows (s): the median, but the mean where all rows are equally far apart, whose rounding does not add up over
/// thousands of samples.
fn spacing(record: &Record) -> f64 {
    let mut between: Vec<f64> = record.time_s.windows(2).map(|pair| pair[1] - pair[0]).collect();
    between.sort_by(f64::total_cmp);
    let Some(&median) = between.get(between.len() / 2) else { return 1.0 };
    let mean = record.duration_s() / between.len() as f64;
    if (mean - median).abs() <= SAME_SPACING * median { mean } else { median }
}

/// The moves of the recorded references away from those at rest.
fn reference_steps(record: &Record, rest: &OperatingPoint) -> Result<Vec<SetPointStep>, RecordError> {
    let mut steps = Vec::new();
    for (level, column) in record.references.iter().enumerate() {
        let mut last = rest.levels[level];
        for (&time_s, &reference) in record.time_s.iter().zip(column).filter(|(_, reference)| !reference.is_nan()) {
            if (reference - last).abs() > STILL {
                steps.push(SetPointStep { level, time_s, size: reference - last });
                last = reference;
            }
        }
    }
    if steps.len() > limits::MAX_SET_POINT_STEPS {
        return Err(RecordError::TooManyMoves { moves: steps.len(), max: limits::MAX_SET_POINT_STEPS });
    }
    Ok(steps)
}

#[cfg(test)]
mod tests {
    use quadtank::literature::PresetId;
    use quadtank::sim::{Load, LoadStep};
    use quadtank::study::quadruple_tank::{run, setup_of};
    use quadtank_scenario::{Scenario, document_from_json, run_to_csv, to_json};

    use super::*;
    use crate::{Mapping, Table, agreement};

    /// A record is what the laboratory writes of a run.
    fn recorded(setup: &Setup) -> Record {
        let table = Table::read(run_to_csv(&run(setup).unwrap()).as_bytes()).unwrap();
        Record::of(&table, &Mapping::guess(&table), 50.0).unwrap()
    }

    #[test]
    fn a_run_that_is_written_and_read_is_done_again() {
        let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
        setup.experiment.duration_s = 1500.0;
        let record = recorded(&setup);
        let replayed = replay(&record, &setup).unwrap();
        assert_eq!(replayed.experiment.duration_s, 1500.0);
        assert!(replayed.experiment.is_by_hand(0) && replayed.experiment.is_by_hand(1));
        let found = agreement(&record, &run(&replayed).unwrap().nonlinear);
        for of_level in found.levels.iter().take(2) {
            // What is left are moves of less than 0.1 mV: some 6 cm of level for each volt.
            assert!(of_level.unwrap().rmse < 1e-5, "{of_level:?}");
        }
        assert!(found.pump_voltage[0].unwrap().rmse <= 1e-4);
        // It is a document that can be kept.
        let json = to_json(&Scenario::from(replayed)).unwrap();
        assert!(document_from_json(&json).is_ok());
    }

    #[test]
    fn references_are_followed_where_no_pump_was_recorded() {
        let setup = setup_of(PresetId::JohanssonMinimumPhase);
        let record = Record { pump_voltage: Default::default(), ..recorded(&setup) };
        let replayed = replay(&record, &setup).unwrap();
        assert!(replayed.experiment.pump_voltage_steps.is_empty());
        let sizes: Vec<f64> = replayed.experiment.set_point_steps.iter().map(|step| step.size).collect();
        let expected: Vec<f64> = setup.experiment.set_point_steps.iter().map(|step| step.size).collect();
        assert_eq!(sizes.len(), expected.len());
        assert!(sizes.iter().zip(expected).all(|(size, expected)| (size - expected).abs() < 1e-12), "{sizes:?}");
        let found = agreement(&record, &run(&replayed).unwrap().nonlinear);
        assert!(found.levels[0].unwrap().rmse < 1e-6, "{found:?}");
    }

    #[test]
    fn more_moves_than_an_experiment_holds_are_counted() {
        let setup = setup_of(PresetId::JohanssonMinimumPhase);
        let record = Record {
            time_s: (0..50_000).map(f64::from).collect(),
            pump_voltage: [(0..50_000).map(|k| f64::from(k % 2)).collect(), vec![]],
            ..Record::default()
        };
        let error = RecordError::TooManyMoves { moves: 50_000, max: limits::MAX_PUMP_STEPS };
        assert_eq!(replay(&record, &setup), Err(error));
        let record = Record {
            time_s: (0..200).map(f64::from).collect(),
            references: [(0..200).map(|k| 0.12 + 0.001 * f64::from(k % 2)).collect(), vec![]],
            ..Record::default()
        };
        let error = RecordError::TooManyMoves { moves: 200, max: limits::MAX_SET_POINT_STEPS };
        assert_eq!(replay(&record, &setup), Err(error));
    }

    #[test]
    fn both_pumps_may_move_at_every_sample_of_the_longest_run() {
        let setup = setup_of(PresetId::JohanssonMinimumPhase);
        let voltage = |frequency: f64| (0..20_000).map(|k| 3.0 + (frequency * f64::from(k)).sin()).collect();
        let mut record = Record {
            time_s: (0..20_000).map(|k| 0.01 * f64::from(k)).collect(),
            pump_voltage: [voltage(0.7), voltage(0.9)],
            ..Record::default()
        };
        let replayed = replay(&record, &setup).unwrap();
        assert!(replayed.experiment.pump_voltage_steps.len() > 39_900);
        assert!((replayed.controller.sampling_time_s - 0.01).abs() < 1e-9);
        assert_eq!(replayed.experiment.duration_s, 199.99);
        let run = run(&replayed).unwrap().nonlinear;
        assert_eq!(run.time_s.len(), 20_000);
        assert!(agreement(&record, &run).pump_voltage[0].unwrap().rmse < 1e-4);
        let json = to_json(&Scenario::from(replayed)).unwrap();
        assert!(document_from_json(&json).is_ok());
        // Rows nearer together than samples may be do not make the run any shorter.
        record.time_s = (0..20_000).map(|k| 0.01 * f64::from(k / 2) + 1e-4 * f64::from(k % 2)).collect();
        assert!(replay(&record, &setup).unwrap().experiment.duration_s > 99.9);
    }

    #[test]
    fn levels_that_were_not_recorded_begin_at_rest() {
        let setup = setup_of(PresetId::JohanssonMinimumPhase);
        let rest = setup.operating_point().unwrap().levels;
        let record = Record {
            time_s: vec![0.0, 50.0],
            levels: [vec![0.05, 0.06], vec![9.0, 9.0], vec![], vec![]],
            ..Record::default()
        };
        // A level above its wall is one at its wall.
        assert_eq!(replay(&record, &setup).unwrap().experiment.initial_levels, Some([0.05, 0.2, rest[2], rest[3]]));
    }

    #[test]
    fn a_measured_inflow_is_received_again() {
        let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
        (setup.experiment.duration_s, setup.experiment.set_point_steps) = (400.0, Vec::new());
        let calm = recorded(&setup);
        // 4 cm³/s into tank 3 from 60 s to 200 s: what a load does that comes and goes.
        let load = |time_s, flow| LoadStep { time_s, load: Load::TankFlow { tank: 2, flow } };
        setup.experiment.load_steps = vec![load(60.0, 4e-6), load(200.0, -4e-6)];
        let disturbed = recorded(&setup);
        let mut record = disturbed.clone();
        record.inflow[2] =
            record.time_s.iter().map(|&time| if (60.0..200.0).contains(&time) { 4e-6 } else { 0.0 }).collect();
        let replayed = replay(&record, &setup).unwrap();
        let steps: Vec<_> = replayed.experiment.inflow_steps.iter().map(|step| (step.time_s, step.flow)).collect();
        assert_eq!(steps, [(0.0, 0.0), (60.0, 4e-6), (200.0, 0.0)]);
        let rmse =
            |record: &Record, setup: &Setup| agreement(record, &run(setup).unwrap().nonlinear).levels[0].unwrap().rmse;
        // The controllers of the run moved the pumps, by some 0.1 mV less exactly than they did.
        assert!(rmse(&record, &replayed) < 1e-5);
        assert!(rmse(&record, &replay(&disturbed, &setup).unwrap()) > 1e-3, "without the column");
        assert!(rmse(&calm, &replayed) > 1e-3);
    }
}
