//! Andreis (2017), Tables 5.1 to 5.6 and 5.17 to 5.20, the step test, and vectors of a second program.

use quadtank::literature::andreis::{
    self, PublishedDisturbance, PublishedMethod, PublishedModel, PublishedObjective, STEP_TEST_INFLOW, VARIANCES,
};
use quadtank::sim::level::{
    InflowDisturbance, LevelController, LevelExperiment, LevelLog, LevelSimulation, ParkMillerNormal, SampleStatistics,
    SignalStep,
};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use PublishedDisturbance::{Random, SineH, SineL};
use PublishedMethod::Current;
use PublishedModel::Uncertain;
use PublishedObjective::{Averaging, Tight};

use crate::within;

fn run(disturbance: PublishedDisturbance, model: PublishedModel, gain: f64, integral_time_s: f64) -> LevelLog {
    let plant = if model == Uncertain { andreis::uncertain_plant() } else { andreis::plant() };
    let simulation = LevelSimulation::new(&plant, &disturbance.experiment()).unwrap();
    simulation.run(&LevelController::pi(gain, integral_time_s)).unwrap()
}

/// Variances of level and outflow.
fn variances(log: &LevelLog) -> [f64; 2] {
    log.statistics(0..log.len()).unwrap().map(|of| of.variance)
}

/// A unit of the fifth digit, the last one that is printed.
fn unit(value: f64) -> f64 {
    10.0_f64.powf(value.abs().log10().floor() - 4.0)
}

/// Every variance of a table, in units of the last digit: so far from the print, and so far from what a second program computes.
fn assert_table(table: u32, from_print: f64, from_second: f64, computed: &[f64]) {
    let rows: Vec<_> = VARIANCES.iter().filter(|row| row.table() == table).collect();
    assert_eq!(rows.len(), computed.len());
    for (row, expected) in rows.into_iter().zip(computed) {
        let [level, outflow] = variances(&run(row.disturbance, row.model, row.tuning.gain, row.tuning.integral_time_s));
        let found = if row.objective == Tight { level } else { outflow };
        within(
            found,
            row.variance,
            from_print * unit(row.variance),
            &format!("Table 5.{table} {:?} {:?}", row.method, row.model),
        );
        within(
            found,
            *expected,
            from_second * unit(*expected),
            &format!("second program {:?} {:?}", row.method, row.model),
        );
    }
}

#[test]
fn table_5_1() {
    let computed = [3.5016e-4, 4.5521e-6, 6.8126e-6, 4.5519e-6, 6.6322e-6, 1.6513e-4, 2.4914e-4, 5.0396e-6, 7.0410e-6];
    assert_table(1, 26.0, 1.2, &computed);
}

#[test]
fn table_5_2() {
    let computed = [1.7135e-5, 2.5996e-7, 2.2009e-7, 2.5979e-7, 2.2452e-7, 2.6268e-7, 2.2238e-7];
    assert_table(2, 0.5, 0.5, &computed);
}

#[test]
fn table_5_3() {
    let computed = [4.5139e-5, 4.2486e-5, 3.5170e-5, 4.2536e-5, 3.5164e-5, 5.6912e-5, 4.4934e-5, 3.2345e-4, 2.4452e-4];
    assert_table(3, 2.0, 0.6, &computed);
}

#[test]
fn table_5_4() {
    let computed = [3.7682e-7, 8.0130e-9, 6.8282e-9, 8.0299e-9, 6.8591e-9, 8.1127e-9, 6.9130e-9];
    assert_table(4, 1.3, 0.6, &computed);
}

/// The switching instant of the disturbance is not printed. The second program lets a step see the next sample at its end; this one
/// does not, and is nearer to the print in most rows.
#[test]
fn table_5_5() {
    let computed = [9.2992e-6, 9.0900e-6, 7.5411e-6, 9.0825e-6, 7.5352e-6, 1.1587e-5, 9.6051e-6, 6.3431e-5, 4.1576e-5];
    assert_table(5, 160.0, 65.0, &computed);
}

#[test]
fn table_5_6() {
    let computed = [1.5770e-7, 1.9621e-9, 1.6761e-9, 1.9623e-9, 1.6752e-9, 1.9879e-9, 1.6996e-9];
    assert_table(6, 105.0, 5.0, &computed);
}

/// Variances of the other variable under the tunings of a table, as the wrong index has them.
fn assert_wrong_index(objective: PublishedObjective, printed: [[f64; 3]; 3], computed: [[f64; 3]; 3]) {
    for (disturbance, (printed, computed)) in
        PublishedDisturbance::ALL.into_iter().zip(printed.into_iter().zip(computed))
    {
        let methods = [Current, PublishedMethod::Gradient, PublishedMethod::Genetic];
        for ((method, printed), computed) in methods.into_iter().zip(printed).zip(computed) {
            let row =
                andreis::PublishedVariance::find(disturbance, objective, method, PublishedModel::Nominal).unwrap();
            let [level, outflow] =
                variances(&run(disturbance, PublishedModel::Nominal, row.tuning.gain, row.tuning.integral_time_s));
            let found = if objective == Tight { outflow } else { level };
            let what = format!("{disturbance:?} {method:?}");
            let [from_print, from_second] = if disturbance == Random { [60.0, 60.0] } else { [1.3, 0.6] };
            within(found, printed, from_print * unit(printed), &what);
            within(found, computed, from_second * unit(computed), &what);
        }
    }
}

#[test]
fn table_5_17() {
    assert_wrong_index(
        Tight,
        [[1.7135e-5, 1.3360e-5, 1.3358e-5], [3.7681e-7, 1.2737e-7, 1.2798e-7], [1.5772e-7, 4.1563e-8, 4.1517e-8]],
        [[1.7135e-5, 1.3360e-5, 1.3358e-5], [3.7682e-7, 1.2737e-7, 1.2799e-7], [1.5770e-7, 4.1576e-8, 4.1530e-8]],
    );
}

#[test]
fn table_5_18() {
    assert_wrong_index(
        Averaging,
        [[3.5016e-4, 1.6463e-3, 1.6450e-3], [4.5139e-5, 6.5681e-5, 6.5811e-5], [9.3061e-6, 1.4464e-5, 1.4466e-5]],
        [[3.5016e-4, 1.6463e-3, 1.6450e-3], [4.5139e-5, 6.5681e-5, 6.5811e-5], [9.2992e-6, 1.4401e-5, 1.4402e-5]],
    );
}

/// Both tables print the same runs, from 50 to 150 s: minimum, maximum, range, variance, mean and deviation.
#[test]
fn tables_5_19_and_5_20() {
    let features =
        |of: SampleStatistics| [of.minimum, of.maximum, of.range(), of.variance, of.mean, of.standard_deviation()];
    let window = |gain| {
        let log = run(SineL, PublishedModel::Nominal, gain, 2999.7);
        log.statistics(log.rows(50.0, 150.0)).unwrap().map(features)
    };
    let [tight, averaging] = [window(93.7), window(0.2)];
    let printed = [
        (tight[0], [0.9935, 1.0072, 0.0137, 1.3512e-5, 1.0, 0.0037], [1e-4, 1e-4, 1e-4, 2e-9, 1e-4, 1e-4]),
        (averaging[0], [0.9493, 1.1184, 0.1691, 0.0026, 1.0370, 0.0511], [1e-4; 6]),
        (tight[1], [0.0081, 0.0270, 0.0188, 4.0022e-5, 0.0170, 0.0063], [1e-4, 1e-4, 1e-4, 2e-9, 1e-4, 1e-4]),
        (averaging[1], [0.0164, 0.0185, 0.0021, 3.6628e-7, 0.0175, 6.0521e-4], [1e-4, 1e-4, 1e-4, 1e-11, 1e-4, 1e-8]),
    ];
    for (found, printed, units) in printed {
        for k in 0..6 {
            // Half a unit of the last digit; a whole one for the variances of the tight tuning.
            let unit = if units[k] == 2e-9 { units[k] } else { 0.5 * units[k] };
            within(found[k], printed[k], unit, &format!("feature {k}"));
        }
    }
}

/// Levels of the second program in the step test of §4.2.7.1: to 55.83 % of output at an inflow of 0.006 m³/s.
#[test]
fn step_test() {
    let experiment = LevelExperiment {
        inflow: STEP_TEST_INFLOW,
        duration_s: 5000.0,
        log_step_s: 1.0,
        disturbance: InflowDisturbance::NONE,
        ..SineL.experiment()
    };
    let simulation = LevelSimulation::new(&andreis::plant(), &experiment).unwrap();
    let output = andreis::plant().output.signal;
    let steps =
        vec![SignalStep { time_s: 0.0, size: (output.low + 0.5583 * output.span()) - simulation.rest().output }];
    let log = simulation.run(&LevelController::Manual { steps }).unwrap();
    let vector = [
        (0, 1.0),
        (10, 1.0099),
        (50, 1.0723),
        (100, 1.144_44),
        (300, 1.371_23),
        (588, 1.580_75),
        (1000, 1.746_63),
        (2000, 1.885_94),
        (3000, 1.914_55),
        (3907, 1.920_28),
        (5000, 1.921_79),
    ];
    for (row, level) in vector {
        within(log.level[row], level, 1e-4, &format!("level after {row} s"));
    }
    // "96 %" of the transmitter 3907 s after the step; and 55.83 % of the output.
    within(100.0 * log.level[3907] / 2.0, 96.0, 0.5, "final level (%)");
    within(100.0 * output.share(log.output[100]), 55.83, 0.5e-2, "output (%)");
}

/// Level, outflow and output of the second program, to their printed digits; 1e-3 of it for the loop on the border of stability.
#[test]
fn vectors_of_runs() {
    type Row = (usize, [f64; 3]);
    let check = |disturbance, gain, integral_time, rows: &[Row], share: f64| {
        let log = run(disturbance, PublishedModel::Nominal, gain, integral_time);
        for &(row, [level, outflow, output]) in rows {
            let what = format!("{disturbance:?} {gain} at {row} s");
            within(log.level[row], level, 1e-6_f64.max(share * level), &what);
            within(log.outflow[row], outflow, 1e-7_f64.max(share * outflow), &what);
            within(log.output[row], output, 1e-4_f64.max(share * output), &what);
        }
    };
    let current = [
        (60, [1.034_484, 0.021_370_2, 4.7516]),
        (75, [0.997_588, 0.022_083_5, 7.3234]),
        (100, [0.994_807, 0.010_016_5, 8.0500]),
        (125, [0.995_890, 0.021_656_5, 7.4792]),
        (150, [0.994_809, 0.010_053_1, 8.0516]),
        (160, [1.012_475, 0.018_949_6, 6.2924]),
        (200, [0.999_956, 0.017_049_4, 7.3620]),
        (300, [1.000_080, 0.017_000_0, 7.3542]),
    ];
    check(SineL, 10.0, 2500.0, &current, 0.0);
    let tight = [
        (60, [1.004_515, 0.026_492_1, 4.0]),
        (75, [0.999_513, 0.016_688_7, 7.9292]),
        (100, [1.000_497, 0.017_028_6, 6.8530]),
        (150, [0.999_780, 0.016_602_1, 7.4895]),
        (300, [0.999_938, 0.016_823_7, 7.4569]),
    ];
    check(SineL, 93.7, 2999.7, &tight, 1e-3);
    let averaging = [
        (60, [1.045_154, 0.017_465_9, 7.2876]),
        (75, [1.117_448, 0.018_482_7, 7.1645]),
        (100, [0.966_630, 0.016_661_9, 7.4059]),
        (150, [0.949_295, 0.016_430_1, 7.4331]),
        (200, [0.973_666, 0.016_648_6, 7.3954]),
        (300, [0.993_077, 0.016_907_4, 7.3649]),
    ];
    check(SineL, 0.2, 2999.7, &averaging, 0.0);
    let skogestad = [
        (60, [1.025_839, 0.024_061_7, 4.0]),
        (75, [0.976_179, 0.019_441_2, 9.0556]),
        (100, [1.020_822, 0.012_423_4, 6.0833]),
        (150, [1.021_708, 0.012_165_5, 6.0765]),
        (300, [1.000_008, 0.017_001_2, 7.3536]),
    ];
    check(SineL, 17.4, 23.5, &skogestad, 0.0);
    let quick = [
        (60, [0.990_915, 0.017_875_1, 7.6461]),
        (75, [1.013_015, 0.017_119_9, 6.8808]),
        (100, [0.985_757, 0.016_865_5, 7.8734]),
        (150, [0.985_659, 0.016_866_5, 7.8773]),
        (200, [0.999_912, 0.017_003_4, 7.3575]),
    ];
    check(SineH, 5.0, 2999.7, &quick, 0.0);
}

/// The random sequence, to its six printed decimals.
#[test]
fn random_sequence() {
    let sequence: Vec<f64> = ParkMillerNormal::new(0).take(150).collect();
    let first =
        [1.164_954, 0.626_839, 0.075_080, 0.351_607, -0.696_513, 1.696_142, 0.059_060, 1.797_072, 0.264_069, 0.871_673];
    let later = [-1.098_195, 1.122_648, 0.581_667, -0.271_354, 0.414_191];
    for (found, expected) in sequence.iter().zip(first).chain(sequence[50..].iter().zip(later)) {
        within(*found, expected, 0.5e-6, "deviate");
    }
    within(sequence[149], 0.964_939, 0.5e-6, "x149");
    let gated = SampleStatistics::of(&sequence[50..]).unwrap();
    within(gated.mean, 0.043_736, 0.5e-6, "mean");
    within(gated.variance, 1.141_492, 0.5e-6, "variance");
}
