//! Andreis (2017), Tables 5.9, 5.10, 5.12 and 5.13 and the indices of 5.17 and 5.18.

use quadtank::assess::{BothIndices, IndexVerdict, VarianceIndex};
use quadtank::literature::andreis::{
    self, CURRENT_TUNING, INDICES, PublishedDisturbance, PublishedIndex, PublishedMethod, PublishedModel,
    PublishedObjective, PublishedVariance, VARIANCES, WRONG_INDICES,
};
use quadtank::sim::level::{LevelController, LevelSimulation, SampleStatistics};
use quadtank::tuning::PiTuning;
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use PublishedDisturbance::Random;
use PublishedMethod::{Current, Genetic, Gradient, Skogestad};
use PublishedModel::{Nominal, Uncertain};
use PublishedObjective::{Averaging, Tight};

use crate::within;

fn statistics(disturbance: PublishedDisturbance, model: PublishedModel, tuning: PiTuning) -> [SampleStatistics; 2] {
    let plant = if model == Uncertain { andreis::uncertain_plant() } else { andreis::plant() };
    let simulation = LevelSimulation::new(&plant, &disturbance.experiment()).unwrap();
    let log = simulation.run(&LevelController::pi(tuning.gain, tuning.integral_time_s)).unwrap();
    log.statistics(0..log.len()).unwrap()
}

fn tuning(
    disturbance: PublishedDisturbance,
    objective: PublishedObjective,
    method: PublishedMethod,
    model: PublishedModel,
) -> PiTuning {
    PublishedVariance::find(disturbance, objective, method, model).unwrap().tuning
}

/// Optimised over current variance: of the level for tight, of the outflow for averaging control. The current loop is the plant.
fn index(row: &PublishedIndex, model: PublishedModel) -> VarianceIndex {
    let reference = statistics(row.disturbance, model, tuning(row.disturbance, row.objective, row.method, model));
    let actual = statistics(row.disturbance, Nominal, CURRENT_TUNING);
    let both = BothIndices::of(&reference, &actual).unwrap();
    if row.objective == Tight { both.level } else { both.outflow }
}

/// Half a unit of the last digit. The random rows, whose instant of switching is not printed, are 4 units off at the most in tight and
/// one in averaging control.
fn assert_table(table: u32) {
    for row in INDICES.iter().filter(|row| row.table == table) {
        let found = PublishedIndex::MODELS.map(|model| index(row, model).quality());
        let unit = match (row.disturbance, row.objective) {
            (Random, Tight) => 4.2e-4,
            (Random, Averaging) => 1e-4,
            _ => 0.5e-4,
        };
        for (found, printed) in found.into_iter().zip(row.printed) {
            within(found, printed, unit, &format!("Table 5.{table} {:?}", row.disturbance));
        }
        // Differences are printed of unrounded or of rounded indices.
        within((found[0] - found[1]).abs(), row.printed[2], 1.5e-4, "difference");
    }
}

#[test]
fn table_5_9() {
    assert_table(9);
}

#[test]
fn table_5_10() {
    assert_table(10);
}

/// The indices; the variances in print are those of the level, which Table 5.12 has in the wrong place.
#[test]
fn table_5_12() {
    assert_table(12);
    let printed = [[1.6463e-3, 1.3915e-3], [6.5681e-5, 5.5484e-5], [1.4464e-5, 1.2259e-5]];
    for (disturbance, printed) in PublishedDisturbance::ALL.into_iter().zip(printed) {
        for (model, printed) in PublishedIndex::MODELS.into_iter().zip(printed) {
            let [level, _] = statistics(disturbance, model, tuning(disturbance, Averaging, Gradient, model));
            let share = if disturbance == Random { 5e-3 } else { 3.5e-5 };
            within(level.variance, printed, share * printed, "variance of the level");
        }
    }
}

/// The indices; two columns in print are those of the gradient.
#[test]
fn table_5_13() {
    assert_table(13);
}

/// Eqs. 52 and 54, the second of which is printed with the wrong name.
#[test]
fn worked_examples() {
    within(VarianceIndex::new(4.2536e-5, 4.5139e-5).unwrap().quality(), 0.9423, 0.5e-4, "Eq. 52");
    within(VarianceIndex::new(8.0299e-9, 3.7681e-7).unwrap().quality(), 0.0213, 0.5e-4, "Eq. 54");
}

/// Indices of the other variable: below 1 they hide that a tight tuning is good, above 1 they give themselves away.
#[test]
fn wrong_indices_of_tables_5_17_and_5_18() {
    for row in WRONG_INDICES {
        let actual = statistics(row.disturbance, Nominal, CURRENT_TUNING);
        for (method, printed) in [Gradient, Genetic].into_iter().zip(row.indices) {
            let reference =
                statistics(row.disturbance, Nominal, tuning(row.disturbance, row.objective, method, Nominal));
            let both = BothIndices::of(&reference, &actual).unwrap();
            let wrong = if row.objective == Tight { both.outflow } else { both.level };
            let unit = if row.disturbance == Random { 7e-3 } else { 1e-4 };
            within(wrong.quality(), printed, unit, &format!("{:?} {:?}", row.objective, row.disturbance));
            assert!(!both.agree());
            if row.objective == Averaging {
                assert_eq!((wrong.verdict(), both.outflow.verdict()), (IndexVerdict::WrongIndex, IndexVerdict::Retune));
            }
        }
    }
}

/// §5.1 and §5.2: the ranges of the variances of the plant as it is, and the one case in which SIMC is better than it with errors.
#[test]
fn ranges_of_the_current_plant() {
    let current = |objective| {
        VARIANCES.iter().filter(move |row| row.method == Current && row.objective == objective).map(|row| row.variance)
    };
    assert_eq!(current(Tight).fold(0.0, f64::max), 3.5016e-4);
    assert_eq!(current(Averaging).fold(0.0, f64::max), 1.7135e-5);
    let simc = PublishedVariance::find(PublishedDisturbance::SineH, Tight, Skogestad, Uncertain).unwrap();
    let now = statistics(PublishedDisturbance::SineH, Nominal, CURRENT_TUNING)[0].variance;
    assert!(statistics(PublishedDisturbance::SineH, Uncertain, simc.tuning)[0].variance < now);
}
