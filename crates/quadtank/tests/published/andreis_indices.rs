//! Andreis (2017), Tables 5.9 to 5.15 and the indices of 5.17 and 5.18.

use quadtank::assess::{BothIndices, IndexVerdict, VarianceIndex};
use quadtank::literature::andreis::{
    self, CURRENT_TUNING, HUNDREDTHS, INDICES, PublishedDisturbance, PublishedIndex, PublishedMethod, PublishedModel,
    PublishedObjective, PublishedVariance, Tuning, VARIANCES, WRONG_INDICES,
};
use quadtank::sim::level::{LevelController, LevelSimulation, SampleStatistics};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use PublishedDisturbance::Random;
use PublishedMethod::{Current, Genetic, Gradient, Lambda, Skogestad};
use PublishedModel::{Nominal, Uncertain};
use PublishedObjective::{Averaging, Tight};

use crate::within;

fn statistics(disturbance: PublishedDisturbance, model: PublishedModel, tuning: Tuning) -> [SampleStatistics; 2] {
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
) -> Tuning {
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

#[test]
fn tables_5_11_and_5_14() {
    for (table, objective, hundredths) in HUNDREDTHS {
        for (disturbance, printed) in PublishedDisturbance::ALL.into_iter().zip(hundredths) {
            for row in INDICES.iter().filter(|row| (row.objective, row.disturbance) == (objective, disturbance)) {
                let quality = 100.0 * index(row, Nominal).quality();
                within(quality, f64::from(printed), 0.5, &format!("Table 5.{table} {disturbance:?}"));
            }
        }
    }
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

/// Mean change of the printed variances by the model error: 47 % more for Sine L and tight control, and less in all other cases.
#[test]
fn table_5_15() {
    let change = |disturbance, objective, methods: &[PublishedMethod]| {
        let ratio = |&method: &PublishedMethod| {
            let variance = |model| {
                let row = PublishedVariance::find(disturbance, objective, method, model).unwrap();
                let [level, outflow] = statistics(disturbance, model, row.tuning);
                if objective == Tight { level.variance } else { outflow.variance }
            };
            variance(Uncertain) / variance(Nominal)
        };
        100.0 * (methods.iter().map(ratio).sum::<f64>() / methods.len() as f64 - 1.0)
    };
    let tight = [Gradient, Genetic, Skogestad, Lambda];
    // SIMC and Lambda tuning are one row of the averaging tables, and count twice.
    let averaging = [Gradient, Genetic, Skogestad, Skogestad];
    let printed = [(47.0, -15.0), (-20.0, -15.0), (-21.0, -14.0)];
    for (disturbance, printed) in PublishedDisturbance::ALL.into_iter().zip(printed) {
        within(change(disturbance, Tight, &tight), printed.0, 0.6, &format!("tight {disturbance:?}"));
        within(change(disturbance, Averaging, &averaging), printed.1, 0.6, &format!("averaging {disturbance:?}"));
    }
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

/// Tables 5.7 and 5.8: 4 ticks for the best, one less for each that follows, 0 (a cross in print) for what is worse than the current
/// tuning. The row Sine H of tight control with the nominal model is printed as 3, 4, 2 and a cross: Table 5.3 says otherwise.
#[test]
fn tables_5_7_and_5_8() {
    let ranking = |disturbance, objective, methods: &[PublishedMethod], model| {
        let variance = |method, model| {
            let [level, outflow] = statistics(disturbance, model, tuning(disturbance, objective, method, model));
            if objective == Tight { level.variance } else { outflow.variance }
        };
        let current = variance(Current, Nominal);
        let variances: Vec<f64> = methods.iter().map(|&method| variance(method, model)).collect();
        let ticks = |of: f64| if of < current { 4 - variances.iter().filter(|&&other| other < of).count() } else { 0 };
        variances.iter().map(|&of| ticks(of)).collect::<Vec<_>>()
    };
    let tight = [Gradient, Genetic, Skogestad, Lambda];
    // SIMC and Lambda tuning are one row of the averaging tables.
    let averaging = [Gradient, Genetic, Skogestad];
    let printed_tight = [[[3, 4, 1, 2], [3, 4, 1, 2]], [[4, 3, 0, 0], [3, 4, 2, 0]], [[3, 4, 0, 0], [3, 4, 0, 0]]];
    let printed_averaging = [[[3, 4, 2], [4, 2, 3]], [[4, 3, 2], [4, 3, 2]], [[4, 3, 2], [3, 4, 2]]];
    for (k, disturbance) in PublishedDisturbance::ALL.into_iter().enumerate() {
        for (m, model) in PublishedIndex::MODELS.into_iter().enumerate() {
            assert_eq!(ranking(disturbance, Tight, &tight, model), printed_tight[k][m], "{disturbance:?} {model:?}");
            let found = ranking(disturbance, Averaging, &averaging, model);
            assert_eq!(found, printed_averaging[k][m], "averaging {disturbance:?} {model:?}");
        }
    }
}
