use std::fmt::Write as _;

use quadtank::plant::level::LevelPlant;
use quadtank::sim::level::LevelLog;
use quadtank::study::level_loop::{
    ContourMap, LevelLoopAnswer, LevelLoopSetup, LevelSearch, StepTestAnswer, TradeOff, TradeOffPoint,
};
use quadtank::tuning::{Evaluation, VIOLATION};

use crate::csv_table::table;

/// The levels (m) that signals of the reference stand for.
fn reference_levels(log: &LevelLog, plant: &LevelPlant) -> Vec<f64> {
    log.reference.iter().map(|&signal| plant.transmitter.level_of(signal)).collect()
}

fn log_columns(log: &LevelLog) -> [(&'static str, &[f64]); 9] {
    [
        ("reference_signal", &log.reference),
        ("inflow_m3_per_s", &log.inflow),
        ("transmitted_signal", &log.transmitted),
        ("output_signal", &log.output),
        ("actuator_pressure", &log.actuator_pressure),
        ("travel", &log.travel),
        ("valve_flow_m3_per_s", &log.valve_flow),
        ("outflow_m3_per_s", &log.outflow),
        ("level_m", &log.level),
    ]
}

/// The run as CSV, one row for each row of its log; the names of the columns contain the units, `signal` and `pressure` standing for
/// those of the ranges of the plant.
pub fn run_to_csv(answer: &LevelLoopAnswer, setup: &LevelLoopSetup) -> String {
    let references = reference_levels(&answer.log, &setup.plant());
    let [reference, inflow, transmitted, output, pressure, travel, valve, outflow, level] = log_columns(&answer.log);
    let time = ("time_s", answer.log.time_s.as_slice());
    let set_point = ("set_point_m", references.as_slice());
    table(&[time, level, set_point, inflow, outflow, valve, reference, transmitted, output, pressure, travel])
}

/// The step test as CSV; `model_signal` is the answer of the model that was read from it, left out where there is none.
pub fn step_test_to_csv(answer: &StepTestAnswer) -> String {
    let [_, inflow, transmitted, output, pressure, travel, valve, outflow, level] = log_columns(&answer.log);
    let mut columns = vec![("time_s", answer.log.time_s.as_slice()), level, transmitted];
    columns.extend(answer.fitted.as_ref().map(|fitted| ("model_signal", fitted.as_slice())));
    columns.extend([output, inflow, outflow, valve, pressure, travel]);
    table(&columns)
}

/// The trade-off as CSV: variances (m², (m³/s)²) along the curve of gains, then those of the given tunings. A tuning without a run has
/// no row.
pub fn trade_off_to_csv(trade_off: &TradeOff) -> String {
    let mut text = "kind,gain,integral_time_s,level_variance_m2,outflow_variance_m6_per_s2\n".to_owned();
    let row = |kind: &str, point: &TradeOffPoint| {
        let TradeOffPoint { tuning, level, outflow } = point;
        format!("{kind},{},{},{level},{outflow}\n", tuning.gain, tuning.integral_time_s)
    };
    text.extend(trade_off.curve.iter().map(|point| row("curve", point)));
    text.extend(trade_off.points.iter().flatten().map(|point| row("point", point)));
    text
}

/// The map of a cost as CSV, gains first. In the place of a cost stands `violates` for settings that violate a constraint, `none` for
/// those without a run, and nothing for those that are not computed yet.
pub fn cost_map_to_csv(map: &ContourMap) -> String {
    let mut text = "gain,integral_time_s,cost\n".to_owned();
    for (cell, evaluation) in map.cells().iter().enumerate() {
        let [gain, integral_time_s] = map.settings_of(cell);
        let cost = match evaluation {
            Some(Evaluation::Cost(cost)) => cost.to_string(),
            Some(Evaluation::Violates(_)) => "violates".to_owned(),
            Some(Evaluation::NoRun(_)) => "none".to_owned(),
            None => String::new(),
        };
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{gain},{integral_time_s},{cost}");
    }
    text
}

/// Where a search stood, step by step, as CSV.
pub fn search_to_csv(search: &LevelSearch) -> String {
    let mut text = "gain,integral_time_s,cost\n".to_owned();
    for step in search.path() {
        let [gain, integral_time_s] = step.point;
        let cost = match step.cost {
            cost if cost < VIOLATION => cost.to_string(),
            cost if cost.is_finite() => "violates".to_owned(),
            // Settings without a run.
            _ => "none".to_owned(),
        };
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{gain},{integral_time_s},{cost}");
    }
    text
}

#[cfg(test)]
mod tests {
    use quadtank::study::level_loop::{
        ContourSettings, PiTuning, SearchMethod, run_level_loop, run_step_test, trade_off,
    };

    use super::*;

    #[test]
    fn every_row_has_a_value_for_every_column() {
        let setup = LevelLoopSetup::default();
        let mut map = ContourMap::new(&setup, ContourSettings { size: [5, 4] }).unwrap();
        while map.advance(6) {}
        let tuning = PiTuning { gain: 10.0, integral_time_s: 2500.0 };
        let mut search = LevelSearch::new(&setup, SearchMethod::NelderMead(tuning)).unwrap();
        search.advance(60);
        let texts = [
            run_to_csv(&run_level_loop(&setup).unwrap(), &setup),
            step_test_to_csv(&run_step_test(&setup.plant(), &setup.test).unwrap()),
            trade_off_to_csv(&trade_off(&setup, &[tuning, setup.reference])),
            cost_map_to_csv(&map),
            search_to_csv(&search),
        ];
        for (text, rows) in texts.iter().zip([302, 602, 20, 21, 1 + search.path().len()]) {
            assert_eq!(text.lines().count(), rows, "{text}");
            let columns = text.lines().next().map_or(0, |line| line.split(',').count());
            assert!(text.lines().all(|line| line.split(',').count() == columns));
        }
        assert!(texts[0].starts_with("time_s,level_m,set_point_m,inflow_m3_per_s,outflow_m3_per_s,"));
    }

    #[test]
    fn what_is_no_cost_is_told_by_a_word() {
        let mut setup = LevelLoopSetup::default();
        setup.search.largest_sensitivity = Some(1.2);
        let tight = PiTuning { gain: 90.0, integral_time_s: 100.0 };
        let mut search = LevelSearch::new(&setup, SearchMethod::Gradient(tight)).unwrap();
        search.advance(8);
        assert!(search_to_csv(&search).contains(",violates\n"), "{}", search_to_csv(&search));
        let mut map = ContourMap::new(&setup, ContourSettings { size: [4, 4] }).unwrap();
        map.advance(7);
        let text = cost_map_to_csv(&map);
        assert!(text.contains("violates\n") && text.lines().any(|line| line.ends_with(',')), "{text}");
    }
}
