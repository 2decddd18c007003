use quadtank::study::StudyError;
use quadtank::study::model_free::{ModelFreeSetup, run_model_free};
use quadtank_figure::{ModelFreeCourse, ModelFreeTexts, Size, Style, model_free_course, to_svg};

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
