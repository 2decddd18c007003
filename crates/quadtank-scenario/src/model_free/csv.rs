use std::fmt::Write as _;

use quadtank::plant::OperatingPoint;
use quadtank::study::LinearPlant;
use quadtank::study::model_free::{ModelFreeAnswer, ModelFreeSetup};

/// Poles and zeros of a plant (1/s).
pub fn roots_to_csv(plant: &LinearPlant) -> String {
    let mut text = "kind,real_per_s,imaginary_per_s\n".to_owned();
    // Writing to a String cannot fail.
    for pole in &plant.poles {
        let _ = writeln!(text, "pole,{},{}", pole.re, pole.im);
    }
    for zero in plant.zeros.iter().flatten() {
        let _ = writeln!(text, "zero,{},{}", zero.value.re, zero.value.im);
    }
    text
}

/// The run as CSV, one row per sample; the names of the columns contain the units. `phi_estimate` (m/s) is the estimate that the law
/// used at the sample, `phi` (m/s) the true value from that sample to the next. `rightmost_zero_per_s` is that of the linear plant at
/// the levels, voltages and valves of the sample, empty where it has no zero.
pub fn run_to_csv(answer: &ModelFreeAnswer, setup: &ModelFreeSetup) -> String {
    let mut text = "time_s,level_1_m,level_2_m,level_3_m,level_4_m,reference_1_m,reference_2_m,pump_voltage_1_v,\
             pump_voltage_2_v,gamma_1,gamma_2,phi_estimate_1_m_per_s,phi_estimate_2_m_per_s,phi_1_m_per_s,phi_2_m_per_s,\
             rightmost_zero_per_s\n"
            .to_owned();
    let (run, trajectory) = (&answer.run, &answer.run.trajectory);
    for (sample, row) in (0..trajectory.time_s.len()).step_by(run.rows_per_sample).enumerate() {
        let time = trajectory.time_s[row];
        let columns = trajectory.levels.iter().chain(&trajectory.references).chain(&trajectory.pump_voltage);
        let phi = run.estimates.iter().chain(&run.true_values).map(|column| column[sample]);
        let values = columns.map(|column| column[row]).chain(setup.valves.map(|valve| valve.at(time))).chain(phi);
        // Writing to a String cannot fail.
        let _ = write!(text, "{time}");
        for value in values {
            let _ = write!(text, ",{value}");
        }
        // Of the linear model as levels, voltages and valves are at that moment.
        let of = |column: &Vec<f64>| column[row];
        let point = OperatingPoint {
            levels: trajectory.levels.each_ref().map(of),
            pump_voltage: trajectory.pump_voltage.each_ref().map(of),
        };
        let linear = LinearPlant::of(&setup.plant_at(time).linearise(&point)).ok();
        let _ = match linear.as_ref().and_then(LinearPlant::rightmost_zero) {
            Some(zero) => writeln!(text, ",{}", zero.value.re),
            None => writeln!(text, ","),
        };
    }
    text
}
