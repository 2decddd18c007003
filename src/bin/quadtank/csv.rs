use std::fmt::Write as _;

use quadtank::scenario::Run;

/// The trajectories of a run, one row per sample, with the unit of each column in its name.
pub fn table(run: &Run) -> String {
    let columns = columns(run);
    let names: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).collect();
    let mut text = names.join(",") + "\n";
    for row in 0..run.nonlinear.time_s.len() {
        for (index, (_, values)) in columns.iter().enumerate() {
            let separator = if index == 0 { "" } else { "," };
            // Writing to a String cannot fail.
            let _ = match values.get(row) {
                Some(value) => write!(text, "{separator}{value}"),
                None => write!(text, "{separator}"),
            };
        }
        text.push('\n');
    }
    text
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
