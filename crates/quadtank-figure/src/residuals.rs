use super::axis::Axis;
use super::chart::{Chart, Course, Layer, Pen, Role, Series};
use super::range::{extent, join};

/// What a simulation leaves of a record: measured minus simulated levels.
#[derive(Clone, Debug)]
pub struct Residuals<'a> {
    /// Times of the record (s).
    pub time_s: &'a [f64],
    /// Residuals of levels 1 and 2 (m), not a number in holes; empty where a level was not recorded.
    pub levels: [&'a [f64]; 2],
    /// Levels are shown in metres times this: 100 for centimetres.
    pub level_scale: f64,
    /// Name and unit of the time axis.
    pub time: &'a str,
    /// Name and unit of the axis of residuals.
    pub residual: &'a str,
    /// Names of levels 1 and 2.
    pub names: [&'a str; 2],
}

/// The chart of residuals over time. Of a good model they scatter around zero; what moves with levels or pumps is left in the model.
pub fn residuals<'a>(spec: &Residuals<'a>) -> Chart<'a> {
    let (low, high) = spec.levels.into_iter().filter_map(extent).reduce(join).unwrap_or((0.0, 0.0));
    let range = (low.min(0.0) * spec.level_scale, high.max(0.0) * spec.level_scale);
    let time = Axis::new(spec.time, extent(spec.time_s).unwrap_or((0.0, 1.0)));
    let mut chart = Chart::new(time, Axis::rounded(spec.residual, range, 4));
    chart.layers.push(Layer::Level { y: 0.0, role: Role::Muted, pen: Pen::Solid });
    for (index, column) in spec.levels.into_iter().enumerate().filter(|(_, column)| !column.is_empty()) {
        chart.layers.push(Layer::Line(Series {
            name: spec.names[index].into(),
            role: Role::of_loop(index),
            pen: Pen::Solid,
            course: Course::Straight,
            x: spec.time_s.into(),
            y: column.into(),
            y_scale: spec.level_scale,
        }));
    }
    chart
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zero_is_in_sight_and_what_was_not_recorded_is_not_drawn() {
        let chart = residuals(&Residuals {
            time_s: &[0.0, 1.0, 2.0],
            levels: [&[0.01, f64::NAN, 0.03], &[]],
            level_scale: 100.0,
            time: "t (s)",
            residual: "e (cm)",
            names: ["1", "2"],
        });
        assert_eq!((chart.x.range, chart.y.range), ((0.0, 2.0), (0.0, 3.0)));
        assert_eq!(chart.series().map(|series| series.role).collect::<Vec<_>>(), [Role::Loop1]);
        let empty = residuals(&Residuals {
            time_s: &[],
            levels: [&[], &[]],
            level_scale: 1.0,
            time: "",
            residual: "",
            names: ["", ""],
        });
        assert!(empty.y.range.0 < empty.y.range.1 && empty.series().next().is_none());
    }
}
