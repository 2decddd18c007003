//! The figures that a script has to find.

use quadtank::sim::Trajectory;
use quadtank::study::StudyError;
use quadtank::study::quadruple_tank::{Analysis, Setup, analyse, run};

use crate::data::{Section, Value, item};

/// How many times of the run a script compares.
const CHECKS: usize = 10;

/// Figures of theory, and levels of the run without noise at some times and at its end.
///
/// # Errors
/// [`StudyError`] where the setup has no operating point, no linear model, or a run that takes too much work.
pub fn section(setup: &Setup) -> Result<Section, StudyError> {
    let mut setup = setup.clone();
    setup.experiment = setup.experiment.without_noise();
    let analysis = analyse(&setup)?;
    let run = run(&setup)?.nonlinear;
    let rows = checked_rows(&run, setup.controller.sampling_time_s);
    let numbers = |of: &dyn Fn(usize) -> f64| Value::Numbers(rows.iter().map(|&row| of(row)).collect());
    let levels = rows.iter().map(|&row| run.levels.iter().map(|level| level[row]).collect()).collect();
    let rest = analysis.operating_point;
    Ok(Section {
        title: "What Quadtank finds.",
        items: vec![
            item("expected_level", Value::Numbers(rest.levels.to_vec()), "levels at rest (m), walls ignored"),
            item("expected_voltage", Value::Numbers(rest.pump_voltage.to_vec()), "pump voltages at rest (V)"),
            item("expected_poles", Value::Numbers(poles(&analysis)), "poles (1/s)"),
            item("degenerate", Value::Flag(analysis.linear.zeros.is_err()), "whether det G(s) is 0 for every s"),
            item("expected_zeros", Value::Numbers(zeros(&analysis)), "transmission zeros (1/s)"),
            item("expected_gain", gain(&analysis), "steady-state gain G(0) (V/V)"),
            item("expected_lambda", lambda(&analysis), "relative gain of level 1 with pump 1"),
            item(
                "expected_moduli",
                Value::Numbers(moduli(&analysis)),
                "moduli of the poles of the sampled closed loop",
            ),
            item("end_time", Value::Number(run.time_s.last().copied().unwrap_or_default()), "end of the run (s)"),
            item("check_time", numbers(&|row| run.time_s[row]), "times at which levels are compared (s)"),
            item("expected_run", Value::Matrix { rows: levels, columns: 4 }, "levels 1 to 4 at these times (m)"),
        ],
    })
}

/// Rows of a run at samples, evenly spread, and its last row.
fn checked_rows(run: &Trajectory, sampling_time_s: f64) -> Vec<usize> {
    let last = run.time_s.len().saturating_sub(1);
    let at_sample = |row: usize| {
        let samples = run.time_s[row] / sampling_time_s;
        (samples - samples.round()).abs() < 1e-6
    };
    let near = |check: usize| (0..=check * last / CHECKS).rev().find(|&row| at_sample(row));
    let mut rows: Vec<usize> = (1..CHECKS).filter_map(near).chain([last]).collect();
    rows.dedup();
    rows
}

fn poles(analysis: &Analysis) -> Vec<f64> {
    rising(analysis.linear.poles.iter().map(|pole| pole.re))
}

/// The zeros of this plant are real; rounding may leave a pair that is equal with parts that are not, far below the tolerance.
fn zeros(analysis: &Analysis) -> Vec<f64> {
    rising(analysis.linear.zeros.iter().flatten().map(|zero| zero.value.re))
}

fn gain(analysis: &Analysis) -> Value {
    Value::Matrix { rows: analysis.linear.dc_gain.iter().map(|row| row.to_vec()).collect(), columns: 2 }
}

fn lambda(analysis: &Analysis) -> Value {
    analysis.linear.rga_11.as_ref().map_or(Value::Missing, |&lambda| Value::Number(lambda))
}

fn moduli(analysis: &Analysis) -> Vec<f64> {
    rising(analysis.closed_loop.poles_z.iter().map(|pole| pole.norm()))
}

fn rising(numbers: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut numbers: Vec<f64> = numbers.collect();
    numbers.sort_by(f64::total_cmp);
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;
    use quadtank::literature::PresetId;
    use quadtank::study::quadruple_tank::setup_of;

    #[test]
    fn compared_rows_are_samples_and_the_end() {
        let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
        let rows = |setup: &Setup| {
            let trajectory = run(setup).unwrap().nonlinear;
            let rows = checked_rows(&trajectory, setup.controller.sampling_time_s);
            rows.iter().map(|&row| trajectory.time_s[row]).collect::<Vec<f64>>()
        };
        assert_eq!(rows(&setup), [300.0, 600.0, 900.0, 1200.0, 1500.0, 1800.0, 2100.0, 2400.0, 2700.0, 3000.0]);
        // Rows lie between samples, and the end is none.
        (setup.controller.sampling_time_s, setup.experiment.duration_s) = (40.0, 230.0);
        let times = rows(&setup);
        let (end, samples) = times.split_last().unwrap();
        assert!((*end - 230.0).abs() < 0.5 && samples == [0.0, 40.0, 80.0, 120.0, 160.0, 200.0], "{times:?}");
        setup.experiment.duration_s = 0.0;
        assert_eq!(rows(&setup), [0.0]);
    }
}
