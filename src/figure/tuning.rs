//! Charts of relay tuning: the critical curve, characteristic loci, and the course of two loops.

use std::borrow::Cow;
use std::f64::consts::TAU;

use super::{Axis, Chart, Course, Entry, Field, Layer, Marker, Pen, Role, Sample, Series, Shape};

/// Steps of the shading along each axis, and its depth.
const STEPS: usize = 60;
const SHADE: f64 = -0.6;
/// Corners of the unit circle.
const CIRCLE: usize = 180;
/// The loci are shown out to this distance at least and at most.
const LEAST_REACH: f64 = 1.5;
const MOST_REACH: f64 = 3.0;

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
    /// Estimates of relay tests by first harmonics.
    pub estimates: &'a [(f64, f64)],
    /// The chosen point.
    pub chosen: Option<(f64, f64)>,
    /// Names of the axes.
    pub axes: [&'a str; 2],
    /// Legend: curve, estimates.
    pub texts: [&'a str; 2],
}

/// The critical curve (Campestrini 2006, Fig. 25): stable gains are on the side of the origin; rays from there have one
/// importance r2, the dashed one r2 = 1.
pub fn critical_curve<'a>(spec: &CurveChart<'a>) -> Chart<'a> {
    let [x, y] = spec.curve;
    let top = |values: &[f64]| values.iter().copied().filter(|v| v.is_finite()).fold(0.0, f64::max).max(1e-9) * 1.05;
    let mut chart =
        Chart::new(Axis::rounded(spec.axes[0], (0.0, top(x)), 5), Axis::rounded(spec.axes[1], (0.0, top(y)), 5));
    chart.layers.push(Layer::Field(stable_region(x, y, chart.x.range, chart.y.range)));
    let reach = chart.x.range.1.min(chart.y.range.1);
    chart.layers.push(line("", Role::Muted, Pen::Dashed, vec![0.0, reach], vec![0.0, reach]));
    chart.layers.push(line(spec.texts[0], Role::RightHalfPlane, Pen::Solid, x, y));
    chart.layers.extend(spec.corners.iter().map(|&at| mark(at, Shape::Cross, Role::RightHalfPlane)));
    chart.layers.extend(spec.estimates.iter().map(|&at| mark(at, Shape::Diamond, Role::ClosedLoop)));
    chart.layers.extend(spec.chosen.map(|at| mark(at, Shape::Handle, Role::Neutral)));
    let entry = |sample, role, text: &str| Entry { sample, role, text: text.to_owned() };
    chart.legend.push(entry(Sample::Line(Pen::Solid), Role::RightHalfPlane, spec.texts[0]));
    if !spec.estimates.is_empty() {
        chart.legend.push(entry(Sample::Mark(Shape::Diamond), Role::ClosedLoop, spec.texts[1]));
    }
    chart
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

/// What the chart of the loci shows.
#[derive(Clone, Debug)]
pub struct LociChart<'a> {
    /// Real and imaginary parts of both loci of the design.
    pub loci: [[&'a [f64]; 2]; 2],
    /// The same at the critical gains, before the design.
    pub before: [[&'a [f64]; 2]; 2],
    /// The target λ.
    pub target: (f64, f64),
    /// Names of the axes.
    pub axes: [&'a str; 2],
    /// Legend: locus 1, locus 2, before.
    pub texts: [&'a str; 3],
}

/// Both characteristic loci around −1, with the unit circle (Campestrini 2006, Figs. 35 to 57).
pub fn characteristic_loci<'a>(spec: &LociChart<'a>) -> Chart<'a> {
    let reach = spec.loci.as_flattened().iter().flat_map(|column| column.iter()).filter(|v| v.is_finite());
    let reach = reach.map(|v| v.abs()).fold(LEAST_REACH, f64::max).min(MOST_REACH);
    let axis = |name| Axis::rounded(name, (-reach, reach), 6);
    let mut chart = Chart::new(axis(spec.axes[0]), axis(spec.axes[1]));
    chart.square = true;
    chart.layers.push(Layer::Level { y: 0.0, role: Role::Muted, pen: Pen::Hair });
    chart.layers.push(Layer::Upright { x: 0.0, role: Role::Muted, pen: Pen::Hair });
    let angles = (0..=CIRCLE).map(|k| TAU * k as f64 / CIRCLE as f64);
    let (x, y): (Vec<f64>, Vec<f64>) = angles.map(|angle| (angle.cos(), angle.sin())).unzip();
    chart.layers.push(line("", Role::Muted, Pen::Hair, x, y));
    for [x, y] in spec.before {
        chart.layers.push(line("", Role::Muted, Pen::Faded, x, y));
    }
    for (index, [x, y]) in spec.loci.into_iter().enumerate() {
        chart.layers.push(line(spec.texts[index], Role::of_loop(index), Pen::Solid, x, y));
    }
    chart.layers.push(mark((-1.0, 0.0), Shape::Cross, Role::RightHalfPlane));
    chart.layers.push(mark(spec.target, Shape::Handle, Role::Neutral));
    let entry = |pen, role, text: &str| Entry { sample: Sample::Line(pen), role, text: text.to_owned() };
    chart.legend.push(entry(Pen::Solid, Role::Loop1, spec.texts[0]));
    chart.legend.push(entry(Pen::Solid, Role::Loop2, spec.texts[1]));
    chart.legend.push(entry(Pen::Faded, Role::Muted, spec.texts[2]));
    chart
}

/// What the charts of a run of two loops show.
#[derive(Clone, Debug)]
pub struct LoopsChart<'a> {
    /// Times of the rows.
    pub time: &'a [f64],
    /// Outputs.
    pub outputs: [&'a [f64]; 2],
    /// Inputs, which hold from a row to the next.
    pub inputs: [&'a [f64]; 2],
    /// References, drawn dashed; `None` for a relay test.
    pub references: Option<[f64; 2]>,
    /// Name of the time axis, of the outputs and of the inputs.
    pub axes: [&'a str; 3],
    /// Names of both loops.
    pub texts: [&'a str; 2],
}

/// Outputs above, inputs below.
pub fn two_loops<'a>(spec: &LoopsChart<'a>) -> [Chart<'a>; 2] {
    let end = spec.time.last().copied().unwrap_or(1.0);
    let chart = |columns: [&'a [f64]; 2], also: &[f64], name: &str, course: Course, weight: f64| {
        let values = || columns.iter().flat_map(|column| column.iter()).chain(also).copied().filter(|v| v.is_finite());
        let (low, high) = (values().fold(0.0, f64::min), values().fold(0.0, f64::max));
        let mut chart = Chart::new(Axis::new(spec.axes[0], (0.0, end)), Axis::rounded(name, (low, high), 8));
        chart.weight = weight;
        for (index, column) in columns.into_iter().enumerate() {
            let role = Role::of_loop(index);
            let (x, y) = (spec.time.into(), column.into());
            let series = Series { name: spec.texts[index].into(), role, pen: Pen::Solid, course, x, y, y_scale: 1.0 };
            chart.layers.push(Layer::Line(series));
        }
        chart
    };
    let references = spec.references.unwrap_or_default();
    let mut outputs = chart(spec.outputs, &references, spec.axes[1], Course::Straight, 2.0);
    for (index, y) in spec.references.into_iter().flatten().enumerate() {
        outputs.layers.push(Layer::Level { y, role: Role::of_loop(index), pen: Pen::Dashed });
    }
    // The chart below shows the same axis.
    outputs.x = Axis { numbered: false, ..Axis::new("", (0.0, end)) };
    outputs.legend = (0..2)
        .map(|i| Entry { sample: Sample::Line(Pen::Solid), role: Role::of_loop(i), text: spec.texts[i].to_owned() })
        .collect();
    let inputs = chart(spec.inputs, &[], spec.axes[2], Course::Held, 1.0);
    [outputs, inputs]
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
            target: (-0.3, -0.3),
            axes: ["re", "im"],
            texts: ["1", "2", "0"],
        };
        let chart = characteristic_loci(&spec);
        assert!(chart.square && chart.x.range == chart.y.range && chart.x.range.1 <= MOST_REACH + 1e-9);
        assert_eq!(chart.legend.len(), 3);
    }

    #[test]
    fn inputs_hold_and_references_are_levels() {
        let (t, y, u) = ([0.0, 1.0, 2.0], [0.0, 0.5, 0.9], [1.0, -1.0, 1.0]);
        let spec = LoopsChart {
            time: &t,
            outputs: [&y, &y],
            inputs: [&u, &u],
            references: Some([1.0, 0.0]),
            axes: ["t", "y", "u"],
            texts: ["1", "2"],
        };
        let [outputs, inputs] = two_loops(&spec);
        assert!(inputs.series().all(|series| series.course == Course::Held));
        assert!(outputs.y.range.1 >= 1.0 && inputs.y.range == (-1.0, 1.0));
        assert_eq!(outputs.layers.iter().filter(|layer| matches!(layer, Layer::Level { .. })).count(), 2);
    }
}
