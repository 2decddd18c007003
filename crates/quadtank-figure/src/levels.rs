use super::axis::Axis;
use super::chart::{Chart, Course, Layer, Pen, Role, Series};
use super::ends::{Ends, names};
use super::flag::{Flag, flags};
use super::range::{extent, join};
use super::responses::RunColumns;

/// Room above and below the curves, as a share of their range: enough for the words at them.
const ROOM: f64 = 0.08;

/// Levels as they happen: the curves of a run up to a time, with their names at them.
#[derive(Clone, Debug)]
pub struct Levels<'a> {
    /// The run.
    pub run: RunColumns<'a>,
    /// References 1 and 2 at the times of the run (m).
    pub references: [&'a [f64]; 2],
    /// The curves are drawn up to this time (s); all of them if `None`.
    pub until_s: Option<f64>,
    /// What happened when; shown once it is drawn.
    pub flags: &'a [Flag],
    /// Levels are shown in metres times this: 100 for centimetres.
    pub level_scale: f64,
    /// The least range of levels (m).
    pub least_range: f64,
    /// Name and unit of the time axis.
    pub time: &'a str,
    /// Name and unit of the level axis.
    pub level: &'a str,
    /// Names of levels 1 and 2.
    pub names: [&'a str; 2],
    /// Names of references 1 and 2, for the table.
    pub reference_names: [&'a str; 2],
}

/// The chart of levels as they happen. Its axes are those of the whole run, so that they stand still while it is drawn.
pub fn levels<'a>(spec: &Levels<'a>) -> Chart<'a> {
    let time = extent(spec.run.time_s).unwrap_or((0.0, 1.0));
    let columns = spec.run.levels.into_iter().chain(spec.references);
    let (low, high) = columns.filter_map(extent).reduce(join).unwrap_or((0.0, 1.0));
    let lacking = (spec.least_range - (high - low)).max(0.0) / 2.0;
    let room = lacking + ROOM * (high - low);
    let axis = Axis::rounded(spec.level, ((low - room) * spec.level_scale, (high + room) * spec.level_scale), 6);
    let mut chart = Chart::new(Axis::new(spec.time, time), axis);
    let shown = spec.until_s.map_or(usize::MAX, |until| spec.run.time_s.partition_point(|&t| t <= until).max(1));
    for index in 0..2 {
        let line = |column: &'a [f64], rows: usize, name: &'a str, pen, course| {
            let rows = rows.min(column.len());
            let (x, y) = (&spec.run.time_s[..rows.min(spec.run.time_s.len())], &column[..rows]);
            let (x, y, name) = (x.into(), y.into(), name.into());
            Layer::Line(Series { name, role: Role::of_loop(index), pen, course, x, y, y_scale: spec.level_scale })
        };
        let reference = (spec.references[index], spec.reference_names[index]);
        chart.layers.push(line(reference.0, usize::MAX, reference.1, Pen::Dashed, Course::Held));
        chart.layers.push(line(spec.run.levels[index], shown, spec.names[index], Pen::Solid, Course::Straight));
    }
    let RunColumns { time_s, levels, .. } = spec.run;
    chart.layers.extend(names(&Ends {
        x: time_s,
        y: levels,
        scale: spec.level_scale,
        names: spec.names,
        window: None,
    }));
    let until = spec.until_s.map_or(time.1, |until| until.min(time.1));
    chart.layers.extend(flags(spec.flags, low * spec.level_scale, (time.0, until)));
    chart
}

#[cfg(test)]
mod tests {
    use super::*;

    const TIME: [f64; 5] = [0.0, 1.0, 2.0, 3.0, 4.0];
    const LEVELS: [[f64; 5]; 2] = [[0.10, 0.11, 0.12, 0.12, 0.12], [0.13, 0.13, 0.13, 0.13, 0.13]];

    fn spec(flags: &[Flag], until_s: Option<f64>) -> Levels<'_> {
        Levels {
            run: RunColumns { time_s: &TIME, levels: [&LEVELS[0], &LEVELS[1]], voltages: [&TIME, &TIME] },
            references: [&LEVELS[0], &LEVELS[1]],
            until_s,
            flags,
            level_scale: 100.0,
            least_range: 0.01,
            time: "t (s)",
            level: "h (cm)",
            names: ["level 1", "level 2"],
            reference_names: ["", ""],
        }
    }

    fn solid_lengths(chart: &Chart) -> Vec<usize> {
        let lines = chart.layers.iter().filter_map(|layer| match layer {
            Layer::Line(series) if series.pen == Pen::Solid => Some(series.x.len()),
            _ => None,
        });
        lines.collect()
    }

    fn has_settled(chart: &Chart) -> bool {
        chart.layers.iter().any(|layer| matches!(layer, Layer::Upright { .. }))
    }

    #[test]
    fn curves_end_at_the_time_and_axes_do_not_move() {
        let (whole, part) = (levels(&spec(&[], None)), levels(&spec(&[], Some(2.0))));
        assert_eq!(solid_lengths(&whole), [5, 5]);
        assert_eq!(solid_lengths(&part), [3, 3]);
        assert_eq!((whole.x.range, whole.y.range), (part.x.range, part.y.range));
    }

    #[test]
    fn a_level_is_said_to_have_settled_once_it_has() {
        let flags = [Flag { time_s: 2.5, text: "settled".to_owned(), role: Role::Loop1 }];
        assert!(has_settled(&levels(&spec(&flags, None))) && has_settled(&levels(&spec(&flags, Some(3.0)))));
        assert!(!has_settled(&levels(&spec(&flags, Some(2.0)))));
    }

    #[test]
    fn names_stand_at_their_curves_the_higher_one_above() {
        let chart = levels(&spec(&[], None));
        let labels = chart.layers.iter().filter_map(|layer| match layer {
            Layer::Label(label) if label.bold => Some((label.at.1, label.offset.1 < 0.0)),
            _ => None,
        });
        assert_eq!(labels.collect::<Vec<_>>(), [(12.0, false), (13.0, true)]);
    }
}
