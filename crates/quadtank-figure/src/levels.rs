use super::axis::Axis;
use super::chart::{Anchor, Chart, Course, Label, Layer, Pen, Role, Series};
use super::responses::{RunColumns, extent, join};

/// Room above and below the curves, as a share of their range: enough for the words at them.
const ROOM: f64 = 0.08;
/// Distance of a word from its curve (CSS px).
const BESIDE: f64 = 12.0;

/// Levels as they happen: the curves of a run up to a time, with their names at them.
#[derive(Clone, Debug)]
pub struct Levels<'a> {
    /// The run.
    pub run: RunColumns<'a>,
    /// References 1 and 2 at the times of the run (m).
    pub references: [&'a [f64]; 2],
    /// The curves are drawn up to this time (s); all of them if `None`.
    pub until_s: Option<f64>,
    /// When a level has settled (s), and the word for that.
    pub settled: [Option<(f64, String)>; 2],
    /// Levels are shown in metres times this: 100 for centimetres.
    pub level_scale: f64,
    /// The least range of levels (m).
    pub least_range: f64,
    /// What the level axis shows at least, in the shown unit: while something is dragged its scale should not run away.
    pub held_levels: Option<(f64, f64)>,
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
    let mut axis = Axis::rounded(spec.level, ((low - room) * spec.level_scale, (high + room) * spec.level_scale), 6);
    axis.range = spec.held_levels.map_or(axis.range, |held| join(held, axis.range));
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
        chart.layers.extend(settled(spec, index));
        chart.layers.extend(name_at(spec, index, time));
    }
    chart
}

/// The name of a level, at the end of its curve: above that of the higher level, below that of the lower one.
fn name_at<'a>(spec: &Levels<'a>, index: usize, (_, end): (f64, f64)) -> Option<Layer<'a>> {
    let [level, other] = [index, 1 - index].map(|k| spec.run.levels[k].last().copied().filter(|h| h.is_finite()));
    let is_higher = level? > other? || (level == other && index == 0);
    Some(Layer::Label(Label {
        at: (end, level? * spec.level_scale),
        offset: (-6.0, if is_higher { -BESIDE } else { BESIDE }),
        anchor: Anchor::Right,
        text: spec.names[index].to_owned(),
        role: Role::of_loop(index),
        bold: true,
    }))
}

/// An upright line where a level has settled, once that is drawn, with its word at the foot.
fn settled<'a>(spec: &Levels<'a>, index: usize) -> Vec<Layer<'a>> {
    let Some((time_s, text)) = &spec.settled[index] else { return Vec::new() };
    if spec.until_s.is_some_and(|until| until < *time_s) {
        return Vec::new();
    }
    let role = Role::of_loop(index);
    let foot = [spec.run.levels[0], spec.run.levels[1], spec.references[0], spec.references[1]];
    let low = foot.into_iter().filter_map(extent).map(|(low, _)| low).reduce(f64::min).unwrap_or_default();
    vec![
        Layer::Upright { x: *time_s, role, pen: Pen::Hair },
        Layer::Label(Label {
            at: (*time_s, low * spec.level_scale),
            offset: (6.0, if index == 0 { 0.0 } else { -2.0 * BESIDE }),
            anchor: Anchor::Left,
            text: text.clone(),
            role,
            bold: false,
        }),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    const TIME: [f64; 5] = [0.0, 1.0, 2.0, 3.0, 4.0];
    const LEVELS: [[f64; 5]; 2] = [[0.10, 0.11, 0.12, 0.12, 0.12], [0.13, 0.13, 0.13, 0.13, 0.13]];

    fn spec(until_s: Option<f64>) -> Levels<'static> {
        Levels {
            run: RunColumns { time_s: &TIME, levels: [&LEVELS[0], &LEVELS[1]], voltages: [&TIME, &TIME] },
            references: [&LEVELS[0], &LEVELS[1]],
            until_s,
            settled: [Some((2.5, "settled".to_owned())), None],
            level_scale: 100.0,
            least_range: 0.01,
            held_levels: None,
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
        let (whole, part) = (levels(&spec(None)), levels(&spec(Some(2.0))));
        assert_eq!(solid_lengths(&whole), [5, 5]);
        assert_eq!(solid_lengths(&part), [3, 3]);
        assert_eq!((whole.x.range, whole.y.range), (part.x.range, part.y.range));
    }

    #[test]
    fn a_level_is_said_to_have_settled_once_it_has() {
        assert!(has_settled(&levels(&spec(None))) && has_settled(&levels(&spec(Some(3.0)))));
        assert!(!has_settled(&levels(&spec(Some(2.0)))));
    }

    #[test]
    fn names_stand_at_their_curves_the_higher_one_above() {
        let chart = levels(&spec(None));
        let labels = chart.layers.iter().filter_map(|layer| match layer {
            Layer::Label(label) if label.bold => Some((label.at.1, label.offset.1 < 0.0)),
            _ => None,
        });
        assert_eq!(labels.collect::<Vec<_>>(), [(12.0, false), (13.0, true)]);
    }
}
