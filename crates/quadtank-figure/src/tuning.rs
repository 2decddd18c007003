//! Charts of relay tuning: the critical curve, characteristic loci, and the course of two loops.

use std::borrow::Cow;
use std::f64::consts::TAU;
use std::ops::Range;

use super::{
    Anchor, Axis, Chart, Course, Entry, Field, Label, Layer, Marker, Name, Names, Pen, Role, Sample, Series, Shape,
};

/// Steps of the shading along each axis, and its depth.
const STEPS: usize = 60;
const SHADE: f64 = -0.6;
/// Corners of the unit circle.
const CIRCLE: usize = 180;
/// What is shown of the plane of the loci: with integral action they come from infinity, and all that counts is around −1.
const ACROSS: (f64, f64) = (-1.6, 1.2);
const UP: (f64, f64) = (-1.5, 1.3);

fn line<'a>(
    name: &'a str,
    role: Role,
    pen: Pen,
    x: impl Into<Cow<'a, [f64]>>,
    y: impl Into<Cow<'a, [f64]>>,
) -> Layer<'a> {
    let course = Course::Straight;
    Layer::Line(Series { name: name.into(), role, pen, course, x: x.into(), y: y.into(), y_scale: 1.0 })
}

fn mark(at: (f64, f64), shape: Shape, role: Role) -> Layer<'static> {
    Layer::Marker(Marker { at, shape, role, points_beyond: true })
}

/// What the chart of the critical curve shows, in normalised gains k1 g11(0), k2 g22(0).
#[derive(Clone, Debug)]
pub struct CurveChart<'a> {
    /// The boundary of the stable gains: x and y.
    pub curve: [&'a [f64]; 2],
    /// Corners of it.
    pub corners: &'a [(f64, f64)],
    /// Estimates of relay tests by first harmonics, and by peaks.
    pub estimates: [&'a [(f64, f64)]; 2],
    /// Importances r2 whose rays are drawn, with their names.
    pub rays: &'a [(f64, String)],
    /// The chosen point.
    pub chosen: Option<(f64, f64)>,
    /// Names of the axes.
    pub axes: [&'a str; 2],
    /// Legend: curve, estimates by first harmonics, by peaks, corner.
    pub texts: [&'a str; 4],
}

/// The critical curve (Campestrini 2006, Fig. 25): stable gains are on the side of the origin; rays from there have one
/// importance r2.
pub fn critical_curve<'a>(spec: &CurveChart<'a>) -> Chart<'a> {
    let [x, y] = spec.curve;
    let top = |values: &[f64]| values.iter().copied().filter(|v| v.is_finite()).fold(0.0, f64::max).max(1e-9) * 1.05;
    let mut chart =
        Chart::new(Axis::rounded(spec.axes[0], (0.0, top(x)), 5), Axis::rounded(spec.axes[1], (0.0, top(y)), 5));
    chart.layers.push(Layer::Field(stable_region(x, y, chart.x.range, chart.y.range)));
    for (importance, name) in spec.rays {
        chart.layers.extend(ray(*importance, name, (chart.x.range.1, chart.y.range.1)));
    }
    chart.layers.push(line(spec.texts[0], Role::RightHalfPlane, Pen::Solid, x, y));
    let [harmonic, peak] = spec.estimates;
    let marks = [
        (spec.corners, Shape::Cross, Role::RightHalfPlane, spec.texts[3]),
        (harmonic, Shape::Diamond, Role::ClosedLoop, spec.texts[1]),
        (peak, Shape::Ring, Role::ClosedLoop, spec.texts[2]),
    ];
    let entry = |sample, role, text: &str| Entry { sample, role, text: text.to_owned() };
    chart.legend.push(entry(Sample::Line(Pen::Solid), Role::RightHalfPlane, spec.texts[0]));
    for (points, shape, role, text) in marks {
        chart.layers.extend(points.iter().map(|&at| mark(at, shape, role)));
        if !points.is_empty() {
            chart.legend.push(entry(Sample::Mark(shape), role, text));
        }
    }
    chart.layers.extend(spec.chosen.map(|at| mark(at, Shape::Handle, Role::Neutral)));
    chart
}

/// A dashed ray from the origin to the edge of the plot, with its name at the end.
fn ray(importance: f64, name: &str, (right, top): (f64, f64)) -> [Layer<'static>; 2] {
    let leaves_above = importance * right > top;
    let end = if leaves_above { (top / importance, top) } else { (right, importance * right) };
    let (offset, anchor) = if leaves_above { ((4.0, 10.0), Anchor::Left) } else { ((-4.0, -8.0), Anchor::Right) };
    let text = name.to_owned();
    [
        line("", Role::Muted, Pen::Dashed, vec![0.0, end.0], vec![0.0, end.1]),
        Layer::Label(Label {
            at: end,
            offset,
            anchor,
            text,
            role: Role::Muted,
            bold: false,
            on_ground: false,
            opposite: None,
        }),
    ]
}

/// The gains within the curve, which is given from the x axis to the y axis. A direction without a limit is stable as far as
/// the chart goes.
fn stable_region(x: &[f64], y: &[f64], across: (f64, f64), up: (f64, f64)) -> Field {
    let node = |(low, high): (f64, f64), step: usize| low + (high - low) * step as f64 / STEPS as f64;
    let corners: Vec<(f64, f64)> = x.iter().copied().zip(y.iter().copied()).collect();
    let cross = |a: (f64, f64), b: (f64, f64)| a.0 * b.1 - a.1 * b.0;
    // Steps of the shading from a point to the curve, positive inside.
    let depth = |at: (f64, f64)| {
        let Some(pair) = corners.windows(2).find(|pair| cross(pair[0], at) >= 0.0 && cross(at, pair[1]) >= 0.0) else {
            return f64::INFINITY;
        };
        let edge = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
        let length = (edge.0 / (across.1 - across.0)).hypot(edge.1 / (up.1 - up.0));
        let area = cross(edge, (at.0 - pair[0].0, at.1 - pair[0].1)) / ((across.1 - across.0) * (up.1 - up.0));
        STEPS as f64 * area / length
    };
    // Half shade on the curve itself, so that what is interpolated between nodes ends there.
    let shade =
        |row: usize, column: usize| SHADE * (0.5 + depth((node(across, column), node(up, row)))).clamp(0.0, 1.0);
    let shades = (0..=STEPS).flat_map(|row| (0..=STEPS).map(move |column| (row, column)));
    let shades = shades.map(|(row, column)| shade(row, column)).collect();
    Field { x: across, y: up, columns: STEPS + 1, shades }
}

/// Where a rule moves the critical point, and its name.
pub type RulePoint = ((f64, f64), &'static str);

/// What the chart of the loci shows.
#[derive(Clone, Debug)]
pub struct LociChart<'a> {
    /// Real and imaginary parts of both loci of the design.
    pub loci: [[&'a [f64]; 2]; 2],
    /// The same at the critical gains, before the design.
    pub before: [[&'a [f64]; 2]; 2],
    /// The target λ; `None` for controllers that are not placed.
    pub target: Option<(f64, f64)>,
    /// Where rules move the critical point.
    pub rules: &'a [RulePoint],
    /// Names of the axes.
    pub axes: [&'a str; 2],
    /// Legend: locus 1, locus 2, before.
    pub texts: [&'a str; 3],
}

/// Both characteristic loci around −1, with the unit circle (Campestrini 2006, Figs. 35 to 57).
pub fn characteristic_loci<'a>(spec: &LociChart<'a>) -> Chart<'a> {
    let mut chart = Chart::new(Axis::new(spec.axes[0], ACROSS), Axis::new(spec.axes[1], UP));
    chart.square = true;
    chart.layers.push(Layer::Level { y: 0.0, role: Role::Muted, pen: Pen::Hair });
    chart.layers.push(Layer::Upright { x: 0.0, role: Role::Muted, pen: Pen::Hair });
    let angles = (0..=CIRCLE).map(|k| TAU * k as f64 / CIRCLE as f64);
    let (y, x): (Vec<f64>, Vec<f64>) = angles.map(f64::sin_cos).unzip();
    chart.layers.push(line("", Role::Muted, Pen::Hair, x, y));
    for [x, y] in spec.before {
        chart.layers.push(line("", Role::Muted, Pen::Faded, x, y));
    }
    for (index, [x, y]) in spec.loci.into_iter().enumerate() {
        chart.layers.push(line(spec.texts[index], Role::of_loop(index), Pen::Solid, x, y));
    }
    chart.layers.push(mark((-1.0, 0.0), Shape::Cross, Role::RightHalfPlane));
    let name = |&(at, name): &RulePoint| Name { at, text: name.to_owned(), role: Role::Neutral, bold: false };
    let names = spec.rules.iter().map(name).collect();
    // Under the marks: the ground of a word may cover a curve, but no point.
    chart.layers.push(Layer::Names(Names { names, around: spec.target.into_iter().collect(), on_ground: true }));
    chart.layers.extend(spec.rules.iter().map(|&(at, _)| mark(at, Shape::Point, Role::Neutral)));
    chart.layers.extend(spec.target.map(|target| mark(target, Shape::Handle, Role::Neutral)));
    let entry = |pen, role, text: &str| Entry { sample: Sample::Line(pen), role, text: text.to_owned() };
    chart.legend.push(entry(Pen::Solid, Role::Loop1, spec.texts[0]));
    chart.legend.push(entry(Pen::Solid, Role::Loop2, spec.texts[1]));
    chart.legend.push(entry(Pen::Faded, Role::Muted, spec.texts[2]));
    chart
}

/// A record of two loops and how it is drawn.
#[derive(Clone, Debug)]
pub struct LoopsRecord<'a> {
    /// What it is, for the legend and the table; nothing for the one that counts.
    pub name: &'a str,
    /// Times of the rows.
    pub time: &'a [f64],
    /// Outputs.
    pub outputs: [&'a [f64]; 2],
    /// Inputs, which hold from a row to the next.
    pub inputs: [&'a [f64]; 2],
    /// When each relay switched, marked if there is room.
    pub switches: [&'a [(f64, bool)]; 2],
    /// Its lines.
    pub pen: Pen,
}

/// What the charts of runs of two loops show.
#[derive(Clone, Debug)]
pub struct LoopsChart<'a> {
    /// The records, from the back to the front; the last one is the one that counts.
    pub records: &'a [LoopsRecord<'a>],
    /// The stretch of time that is shown.
    pub window: (f64, f64),
    /// Records are drawn up to this time; all of them if `None`. Axes are those of the whole stretch, so that they stand still.
    pub until: Option<f64>,
    /// References, drawn dashed; `None` for a relay test.
    pub references: Option<[f64; 2]>,
    /// Name of the time axis, of the outputs and of the inputs.
    pub axes: [&'a str; 3],
    /// Names of both loops.
    pub texts: [&'a str; 2],
}

/// Most marks of switches in sight: more would hide the curve, so a long record has to be zoomed into.
const MAX_MARKS: usize = 80;

/// Outputs above, inputs below.
pub fn two_loops<'a>(spec: &LoopsChart<'a>) -> [Chart<'a>; 2] {
    let references = spec.references.unwrap_or_default();
    let outputs_of: Columns = |record| (["y₁", "y₂"], record.outputs);
    let pens = [Pen::Solid, Pen::Dotted];
    let mut outputs = loops_chart(spec, spec.axes[1], outputs_of, &references, &pens, Course::Straight);
    for (index, y) in spec.references.into_iter().flatten().enumerate() {
        outputs.layers.push(Layer::Level { y, role: Role::of_loop(index), pen: Pen::Dashed });
    }
    if let Some(record) = spec.records.last() {
        let (from, to) = spec.window;
        outputs.layers.extend(switch_marks(record, (from, spec.until.map_or(to, |until| until.min(to)))));
    }
    // The chart below shows the same axis.
    outputs.x = Axis { numbered: false, ..Axis::new("", spec.window) };
    outputs.weight = 2.0;
    outputs.legend = (0..2)
        .map(|i| Entry { sample: Sample::Line(Pen::Solid), role: Role::of_loop(i), text: spec.texts[i].to_owned() })
        .collect();
    let others = spec.records.iter().filter(|record| !record.name.is_empty());
    outputs.legend.extend(others.map(|record| Entry {
        sample: Sample::Line(record.pen),
        role: Role::Muted,
        text: record.name.to_owned(),
    }));
    // A kick of another controller would leave nothing to see of this one.
    let inputs_of: Columns = |record| (["u₁", "u₂"], record.inputs);
    let inputs = loops_chart(spec, spec.axes[2], inputs_of, &[], &[Pen::Solid], Course::Held);
    [outputs, inputs]
}

/// Two columns of a record with their symbols.
type Columns = for<'a> fn(&LoopsRecord<'a>) -> ([&'static str; 2], [&'a [f64]; 2]);

/// How far the outputs of a response stretch their axis, in steps: one that runs away leaves the chart instead.
const REACH: f64 = 5.0;

/// The rows of a record in the window, as far as the outputs of a response stay within reach.
fn in_sight(record: &LoopsRecord, spec: &LoopsChart) -> Range<usize> {
    let first = record.time.partition_point(|&time| time < spec.window.0);
    let end = record.time.partition_point(|&time| time <= spec.window.1).max(first);
    let step = spec.references.iter().flatten().map(|y| y.abs()).fold(0.0, f64::max);
    let away = |row: &usize| record.outputs.iter().any(|y| y.get(*row).is_none_or(|y| y.abs() > REACH * step));
    let end = if step > 0.0 { (first..end).find(away).unwrap_or(end) } else { end };
    first..end
}

/// How many rows of a record are drawn.
fn drawn_rows(spec: &LoopsChart, record: &LoopsRecord) -> usize {
    spec.until.map_or(record.time.len(), |until| record.time.partition_point(|&time| time <= until))
}

/// A chart of two columns of every record, from the lowest to the highest value in sight of those that have these `pens`.
fn loops_chart<'a>(
    spec: &LoopsChart<'a>,
    label: &str,
    columns: Columns,
    also: &[f64],
    pens: &[Pen],
    course: Course,
) -> Chart<'a> {
    let (mut low, mut high) = also.iter().fold((0.0, 0.0), |(low, high): (f64, f64), &y| (low.min(y), high.max(y)));
    for record in spec.records.iter().filter(|record| pens.contains(&record.pen)) {
        let rows = in_sight(record, spec);
        for column in columns(record).1 {
            for &y in column.get(rows.clone()).unwrap_or_default().iter().filter(|y| y.is_finite()) {
                (low, high) = (low.min(y), high.max(y));
            }
        }
    }
    let mut chart = Chart::new(Axis::new(spec.axes[0], spec.window), Axis::rounded(label, (low, high), 8));
    for record in spec.records {
        let (symbols, columns) = columns(record);
        for (index, column) in columns.into_iter().enumerate() {
            let rows = drawn_rows(spec, record).min(column.len());
            let (x, y) = (record.time[..rows].into(), column[..rows].into());
            let name = if record.name.is_empty() {
                symbols[index].into()
            } else {
                format!("{} ({})", symbols[index], record.name).into()
            };
            let role = Role::of_loop(index);
            chart.layers.push(Layer::Line(Series { name, role, pen: record.pen, course, x, y, y_scale: 1.0 }));
        }
    }
    chart
}

/// A mark on each output where its relay switches: a ring for loop 1, a diamond for loop 2, so that they differ without colour.
fn switch_marks(record: &LoopsRecord, window: (f64, f64)) -> Vec<Layer<'static>> {
    let in_sight = |switches: &[(f64, bool)]| {
        let times = switches.iter().map(|&(time, _)| time);
        times.filter(|time| (window.0..=window.1).contains(time)).collect::<Vec<f64>>()
    };
    let times = record.switches.map(in_sight);
    if times[0].len() + times[1].len() > MAX_MARKS {
        return Vec::new();
    }
    let mark = |index: usize, time: f64| {
        let shape = if index == 0 { Shape::Point } else { Shape::Diamond };
        let row = record.time.partition_point(|&t| t < time);
        let at = (time, *record.outputs[index].get(row)?);
        Some(Layer::Marker(Marker { at, shape, role: Role::of_loop(index), points_beyond: false }))
    };
    let marks =
        times.iter().enumerate().flat_map(|(index, times)| times.iter().filter_map(move |&time| mark(index, time)));
    marks.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gains_within_the_curve_are_shaded() {
        // A quarter of a square with its corner at (2, 2), and nothing beyond 45° in the second.
        let field = stable_region(&[2.0, 2.0, 0.0], &[0.0, 2.0, 2.0], (0.0, 3.0), (0.0, 3.0));
        let at = |column: usize, row: usize| field.shades[row * field.columns + column] < 0.0;
        // 20 steps are one unit.
        assert!(at(0, 0) && at(39, 5) && at(5, 39) && at(39, 39));
        assert!(!at(41, 5) && !at(5, 41) && !at(41, 41));
    }

    #[test]
    fn the_loci_stay_around_minus_one() {
        let far = [&[-1e9, 0.5][..], &[f64::NAN, 0.2][..]];
        let spec = LociChart {
            loci: [far, far],
            before: [far, far],
            target: Some((-0.3, -0.3)),
            rules: &[((-0.4, 0.08), "ZN")],
            axes: ["re", "im"],
            texts: ["1", "2", "0"],
        };
        let chart = characteristic_loci(&spec);
        assert!(chart.square && (chart.x.range, chart.y.range) == (ACROSS, UP));
        // As wide as high, so the unit circle is one.
        assert!((ACROSS.1 - ACROSS.0 - (UP.1 - UP.0)).abs() < 1e-12);
        assert_eq!(chart.legend.len(), 3);
    }

    fn record<'a>(t: &'a [f64], y: &'a [f64], u: &'a [f64], switches: &'a [(f64, bool)]) -> LoopsRecord<'a> {
        LoopsRecord { name: "", time: t, outputs: [y, y], inputs: [u, u], switches: [switches, &[]], pen: Pen::Solid }
    }

    fn loops<'a>(records: &'a [LoopsRecord<'a>], window: (f64, f64)) -> [Chart<'a>; 2] {
        let (axes, texts) = (["t", "y", "u"], ["1", "2"]);
        two_loops(&LoopsChart { records, window, until: None, references: Some([1.0, 0.0]), axes, texts })
    }

    #[test]
    fn inputs_hold_references_are_levels_and_switches_are_marked() {
        let records = [record(&[0.0, 1.0, 2.0], &[0.0, 0.5, 0.9], &[1.0, -1.0, 1.0], &[(1.0, false)])];
        let [outputs, inputs] = loops(&records, (0.0, 2.0));
        assert!(inputs.series().all(|series| series.course == Course::Held));
        assert!(outputs.y.range.1 >= 1.0 && inputs.y.range == (-1.0, 1.0));
        assert_eq!(outputs.layers.iter().filter(|layer| matches!(layer, Layer::Level { .. })).count(), 2);
        let marks: Vec<_> = outputs.layers.iter().filter(|layer| matches!(layer, Layer::Marker(_))).collect();
        assert!(matches!(marks[..], [Layer::Marker(Marker { at: (1.0, 0.5), .. })]));
    }

    #[test]
    fn a_record_is_drawn_up_to_a_time_on_the_axes_of_all_of_it() {
        let records = [record(&[0.0, 1.0, 2.0], &[0.0, 0.5, 3.0], &[1.0, -1.0, 1.0], &[(0.5, true), (1.5, false)])];
        let (axes, texts) = (["t", "y", "u"], ["1", "2"]);
        let spec = |until| LoopsChart { records: &records, window: (0.0, 2.0), until, references: None, axes, texts };
        let [[whole, _], [part, inputs], [nothing, _]] =
            [None, Some(1.0), Some(-1.0)].map(|until| two_loops(&spec(until)));
        let rows = |chart: &Chart| chart.series().map(|series| series.x.len()).collect::<Vec<_>>();
        let marks = |chart: &Chart| chart.layers.iter().filter(|layer| matches!(layer, Layer::Marker(_))).count();
        assert_eq!(
            (rows(&whole), rows(&part), rows(&inputs), rows(&nothing)),
            (vec![3, 3], vec![2, 2], vec![2, 2], vec![0, 0])
        );
        assert_eq!((whole.y.range, marks(&whole)), (part.y.range, 2));
        assert_eq!((nothing.y.range, marks(&part), marks(&nothing)), (part.y.range, 1, 0));
    }

    #[test]
    fn what_stays_behind_does_not_set_the_axis_and_a_window_does() {
        let (t, tall, low) = ([0.0, 1.0, 2.0], [0.0, 50.0, 9.0], [0.0, 3.0, 1.0]);
        let mut records = [record(&t, &tall, &low, &[]), record(&t, &low, &low, &[])];
        (records[0].pen, records[0].name) = (Pen::Faded, "pinned");
        let [outputs, inputs] = loops(&records, (0.0, 2.0));
        assert!(outputs.y.range.1 < 10.0);
        let names = |chart: &Chart| chart.series().map(|series| series.name.to_string()).collect::<Vec<_>>();
        assert_eq!(names(&outputs), ["y₁ (pinned)", "y₂ (pinned)", "y₁", "y₂"]);
        assert_eq!(names(&inputs), ["u₁ (pinned)", "u₂ (pinned)", "u₁", "u₂"]);
        assert_eq!(outputs.legend.last().map(|entry| entry.text.as_str()), Some("pinned"));
        assert!(loops(&records, (1.5, 2.0))[0].y.range.1 < 3.0);
    }

    #[test]
    fn a_response_that_runs_away_leaves_the_chart() {
        let (t, wild) = ([0.0, 1.0, 2.0, 3.0], [0.0, 1.0, -2.0, -1e12]);
        let records = [record(&t, &wild, &[0.5, 1.0, 2.0, 1e12], &[])];
        let [outputs, inputs] = loops(&records, (0.0, 1.0));
        assert_eq!((outputs.y.range, inputs.y.range), ((0.0, 1.0), (0.0, 1.0)));
        let [outputs, inputs] = loops(&records, (0.0, 3.0));
        assert_eq!((outputs.y.range, inputs.y.range), ((-2.0, 1.0), (0.0, 2.0)), "till it is out of reach");
    }

    #[test]
    fn the_outputs_of_a_comparison_are_in_sight() {
        let (t, tall, low) = ([0.0, 1.0, 2.0], [0.0, 3.0, 2.0], [0.0, 0.5, 1.0]);
        let records = [LoopsRecord { pen: Pen::Dotted, ..record(&t, &tall, &tall, &[]) }, record(&t, &low, &low, &[])];
        let [outputs, inputs] = loops(&records, (0.0, 2.0));
        assert!(outputs.y.range.1 >= 3.0 && inputs.y.range.1 < 3.0);
    }

    #[test]
    fn a_ray_ends_at_the_edge() {
        let [Layer::Line(flat), _] = ray(0.5, "r", (4.0, 3.0)) else { panic!("a line") };
        let [Layer::Line(steep), _] = ray(3.0, "r", (4.0, 3.0)) else { panic!("a line") };
        assert_eq!((flat.x[1], flat.y[1]), (4.0, 2.0));
        assert_eq!((steep.x[1], steep.y[1]), (1.0, 3.0));
    }
}
