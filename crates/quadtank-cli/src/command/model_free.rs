//! The model-free law without a screen: what theory says of a run and what happens in it, as JSON, CSV or a picture.

use quadtank::linear::Complex;
use quadtank::literature::junqueira::{PublishedExperiment, PublishedValves};
use quadtank::sim::{TrackingFigures, ZeroDynamicsEnd};
use quadtank::study::StudyError;
use quadtank::study::model_free::{ModelFreeSetup, Moment, analyse_model_free, run_model_free};
use quadtank_figure::{ModelFreeCourse, ModelFreeTexts, Size, Style, model_free_course, to_svg};
use quadtank_scenario::model_free::run_to_csv;
use serde_json::{Value, json};

/// Steps along each side of the outline of the levels that can be held.
const OUTLINE_STEPS: u32 = 8;

/// The published cases by name: `junqueira-a-s1` and so on.
pub fn published() -> impl Iterator<Item = (String, PublishedValves, PublishedExperiment)> {
    PublishedValves::ALL.into_iter().flat_map(|valves| {
        PublishedExperiment::ALL.into_iter().map(move |experiment| {
            let name = format!("junqueira-{valves:?}-{experiment:?}").to_lowercase();
            (name, valves, experiment)
        })
    })
}

fn complex(value: &Complex) -> Value {
    json!({ "re": value.re, "im": value.im })
}

fn moment(of: &Moment) -> Value {
    json!({
        "valves": of.valves,
        "zeros": of.zeros.as_ref().map_or_else(|error| json!(error), |zeros| zeros.iter().map(complex).collect()),
        "rga_11": of.rga_11,
        "niederlinski_diagonal": of.niederlinski[0],
        "niederlinski_swapped": of.niederlinski[1],
    })
}

/// What theory says at the references that the run ends with, with the valves where they come to rest.
pub fn analysis(setup: &ModelFreeSetup) -> Value {
    let found = analyse_model_free(setup);
    json!({
        "rest": found.rest.as_ref().map_or_else(|error| json!(error), |rest| json!(rest)),
        "at_rest": found.moment.as_ref().map(moment),
        "closed_loop": found.poles.map(|poles| match poles {
            Ok(poles) => json!({
                "stability": poles.stability,
                "poles": poles.poles_s.iter().map(complex).collect::<Vec<_>>(),
            }),
            Err(error) => json!(error),
        }),
        "continuous_poles_without_estimator": found.continuous_poles.map(|poles| match poles {
            Ok(poles) => json!(poles.iter().map(complex).collect::<Vec<_>>()),
            Err(error) => json!(error),
        }),
        "smallest_model_gain": found.smallest_model_gain,
        "smallest_model_gain_of_integrators": found.smallest_of_integrators,
        "levels_in_range_of_the_pumps": setup.plant_at(setup.valves_rest_from_s()).feasible_outline(OUTLINE_STEPS),
    })
}

fn ends(end: ZeroDynamicsEnd) -> Value {
    match end {
        ZeroDynamicsEnd::Pump { pump, after_s } => json!({ "pump_at_its_limit": pump + 1, "after_s": after_s }),
        ZeroDynamicsEnd::Overflow { tank, after_s } => json!({ "tank_runs_over": tank + 1, "after_s": after_s }),
    }
}

/// Figures of both loops, events, and what the zero dynamics foretell.
pub fn report(setup: &ModelFreeSetup) -> Result<Value, StudyError> {
    let found = run_model_free(setup)?;
    let figures = |of: &[TrackingFigures; 2]| json!(of);
    Ok(json!({
        "figures": figures(&found.figures),
        "comparison": found.comparison.as_ref().map(|(_, of)| figures(of)),
        "predicted": found.predicted.map(|predicted| json!({
            "from_s": predicted.from_s,
            "ends": predicted.ends.map(ends),
        })),
        "events": found.run.trajectory.events,
    }))
}

/// The run, one row per sample.
pub fn csv(setup: &ModelFreeSetup) -> Result<String, StudyError> {
    Ok(run_to_csv(&run_model_free(setup)?, setup))
}

/// Draws the run as an SVG document.
pub fn svg(setup: &ModelFreeSetup, style: &Style) -> Result<String, StudyError> {
    let found = run_model_free(setup)?;
    let trajectory = &found.run.trajectory;
    let sample_time_s: Vec<f64> = trajectory.time_s.iter().copied().step_by(found.run.rows_per_sample).collect();
    let charts = model_free_course(&ModelFreeCourse {
        time_s: &trajectory.time_s,
        levels: trajectory.levels.each_ref().map(Vec::as_slice),
        references: trajectory.references.each_ref().map(Vec::as_slice),
        voltages: trajectory.pump_voltage.each_ref().map(Vec::as_slice),
        comparison: found
            .comparison
            .as_ref()
            .map(|(run, _)| (run.time_s.as_slice(), [run.levels[0].as_slice(), run.levels[1].as_slice()])),
        sample_time_s: &sample_time_s,
        estimates: found.run.estimates.each_ref().map(Vec::as_slice),
        true_values: found.run.true_values.each_ref().map(Vec::as_slice),
        window_s: (0.0, setup.experiment.duration_s),
        texts: ModelFreeTexts {
            axes: ["time (s)", "level (cm)", "upper level (cm)", "voltage (V)", "φ (cm/s)"],
            reference: "reference",
            comparison: "PI",
            estimate: "estimate φ̂",
            true_value: "true φ",
        },
    });
    let size = Size { width: 840.0, height: 760.0 };
    let description = "Levels of all tanks, pump voltages, and the estimates of both loops over time.";
    Ok(to_svg(&charts, size, style, "Model-free control", description))
}
