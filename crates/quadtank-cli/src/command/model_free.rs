//! The model-free law without a screen: what theory says of a run and what happens in it, as a report, CSV or a picture.

use quadtank::study::StudyError;
use quadtank::study::model_free::{ModelFreeSetup, analyse_model_free, run_model_free};
use quadtank_figure::{ModelFreeCourse, ModelFreeTexts, Size, Style, model_free_course, to_svg};
use quadtank_scenario::model_free::run_to_csv;
use quadtank_scenario::report::model_free::{ModelFreeAnalysisReport, ModelFreeReport};

/// What theory says at the references that the run ends with.
pub fn analysis(setup: &ModelFreeSetup) -> ModelFreeAnalysisReport {
    ModelFreeAnalysisReport::of(setup, &analyse_model_free(setup))
}

/// What happens in the run.
pub fn report(setup: &ModelFreeSetup) -> Result<ModelFreeReport, StudyError> {
    Ok(ModelFreeReport::from(&run_model_free(setup)?))
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
