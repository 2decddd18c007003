//! What a program reads: comma-separated values, SI units in the column names, a point as decimal separator.

use quadtank::linear::Complex;
use quadtank::study::quadruple_tank::{Analysis, FrequencyCurves, Run, ValveMap};

use super::csv_table::table;

/// A row of a table of poles and zeros.
type Root = (&'static str, Complex);

/// The trajectories with the unit of each column in its name: a row for each sample, and rows between them where samples are far
/// apart.
pub fn run_to_csv(run: &Run) -> String {
    table(&columns(run))
}

fn columns(run: &Run) -> Vec<(String, &[f64])> {
    let (plant, model) = (&run.nonlinear, &run.linear);
    let mut columns = vec![("time_s".to_owned(), plant.time_s.as_slice())];
    columns.extend(numbered("level", "m", &plant.levels));
    columns.extend(numbered("reference", "m", &plant.references));
    columns.extend(numbered("controller_output", "v", &plant.controller_output));
    columns.extend(numbered("pump_voltage", "v", &plant.pump_voltage));
    columns.extend(numbered("linear_level", "m", &model.levels));
    columns.extend(numbered("linear_pump_voltage", "v", &model.pump_voltage));
    columns
}

fn numbered<'a>(name: &str, unit: &str, series: &'a [Vec<f64>]) -> impl Iterator<Item = (String, &'a [f64])> {
    series.iter().enumerate().map(move |(index, values)| (format!("{name}_{}_{unit}", index + 1), values.as_slice()))
}

/// Poles and zeros (1/s), one row each.
pub fn roots_to_csv(analysis: &Analysis) -> String {
    let poles = analysis.linear.poles.iter().map(|&s| ("pole", s));
    let zeros = analysis.linear.zeros.iter().flatten().map(|z| ("transmission_zero", z.value));
    let closed = analysis.closed_loop.poles_s.iter().map(|&s| ("closed_loop_pole", s));
    let row = |(kind, s): Root| format!("{kind},{},{}\n", s.re, s.im);
    "kind,real_per_s,imaginary_per_s\n".to_owned() + &poles.chain(zeros).chain(closed).map(row).collect::<String>()
}

/// The right-most zero (1/s) over the valve plane in `steps` steps of each valve; empty where there is none.
pub fn valve_map_to_csv(map: &ValveMap, steps: u32) -> String {
    let fraction = |step: u32| f64::from(step) / f64::from(steps.max(1));
    let row = |valves: [f64; 2]| {
        let zero = map.rightmost_zero(valves).map_or_else(String::new, |z| z.to_string());
        format!("{},{},{zero}\n", valves[0], valves[1])
    };
    let rows = (0..=steps).flat_map(|i| (0..=steps).map(move |j| [fraction(i), fraction(j)]));
    "gamma_1,gamma_2,rightmost_zero_per_s\n".to_owned() + &rows.map(row).collect::<String>()
}

/// Singular values over frequency, the largest and the smallest each; those of a loop that is not stable are left out.
pub fn frequency_to_csv(curves: &FrequencyCurves) -> String {
    let mut columns = vec![("frequency_rad_per_s".to_owned(), curves.frequencies.as_slice())];
    columns.extend(singular_values("g", &curves.plant));
    if let Some(closed) = &curves.closed {
        columns.extend(singular_values("s", &closed.sensitivity));
        columns.extend(singular_values("t", &closed.complementary));
    }
    table(&columns)
}

fn singular_values<'a>(of: &str, both: &'a [Vec<f64>; 2]) -> impl Iterator<Item = (String, &'a [f64])> {
    let names = [format!("largest_{of}"), format!("smallest_{of}")];
    names.into_iter().zip(both.iter().map(Vec::as_slice))
}

#[cfg(test)]
mod tests {
    use super::*;
    use quadtank::literature::PresetId;
    use quadtank::study::quadruple_tank::{analyse, run, setup_of};

    #[test]
    fn every_row_has_a_value_for_every_column() -> Result<(), Box<dyn std::error::Error>> {
        let setup = setup_of(PresetId::JohanssonNonMinimumPhase);
        let analysis = analyse(&setup)?;
        let curves = FrequencyCurves::of(&setup, &analysis)?;
        let texts = [
            run_to_csv(&run(&setup)?),
            roots_to_csv(&analysis),
            valve_map_to_csv(&ValveMap::of(&setup)?, 4),
            frequency_to_csv(&curves),
        ];
        for (text, rows) in texts.iter().zip([3002, 1 + 4 + 2 + 6, 1 + 25, 1 + curves.frequencies.len()]) {
            assert_eq!(text.lines().count(), rows);
            let columns = text.lines().next().map_or(0, |line| line.split(',').count());
            assert!(text.lines().all(|line| line.split(',').count() == columns));
        }
        Ok(())
    }

    #[test]
    fn the_zeros_of_the_table_are_those_of_the_analysis() -> Result<(), Box<dyn std::error::Error>> {
        let analysis = analyse(&setup_of(PresetId::JohanssonNonMinimumPhase))?;
        let text = roots_to_csv(&analysis);
        let zero = analysis.linear.rightmost_zero().map_or(f64::NAN, |z| z.value.re);
        assert!(text.contains(&format!("transmission_zero,{zero},0\n")), "{text}");
        Ok(())
    }
}
