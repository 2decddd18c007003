use super::super::range::{extent, join};
use super::super::{Axis, Chart, Layer, Names, Pen, Role, Shape};
use super::{NamedPoint, between, curve, mark, marks, with_room, words};

/// Room around the curve and its points: a share of the decades that they cover, and at least so many decades.
const ROOM: (f64, f64) = (0.1, 0.15);
/// How far points stretch an axis beyond the curve; one of a loop that runs away is an arrow at the edge instead.
const REACH: f64 = 100.0;

/// What the trade-off shows: variances, so that all of it is positive.
#[derive(Clone, Debug)]
pub struct TradeOffChart<'a> {
    /// Variances of the outflow ((m³/s)²) and of the level (m²) along the gains.
    pub curve: (&'a [f64], &'a [f64]),
    /// Tunings in the same units, outflow first.
    pub points: Vec<NamedPoint<'a>>,
    /// The present tuning.
    pub present: Option<(f64, f64)>,
    /// Names with units of the axes: variance of the outflow, of the level.
    pub axes: [&'a str; 2],
}

/// Variance of the level over that of the outflow, both logarithmic: tight control is at one end of the curve, averaging control at the
/// other.
pub fn trade_off<'a>(spec: &TradeOffChart<'a>) -> Chart<'a> {
    let (x, y) = spec.curve;
    let points = || spec.points.iter().map(|point| point.at).chain(spec.present);
    let mut chart = Chart::new(
        Axis::logarithmic(spec.axes[0], range(x, points().map(|point| point.0))),
        Axis::logarithmic(spec.axes[1], range(y, points().map(|point| point.1))),
    );
    chart.layers.push(curve(spec.axes[1], Role::Neutral, Pen::Solid, x, y));
    let corners: Vec<(f64, f64)> = x.iter().copied().zip(y.iter().copied()).collect();
    let around = between(&corners).chain(spec.present).collect();
    // Under the marks: the ground of a word may cover a curve, but no point.
    chart.layers.push(Layer::Names(Names { names: words(&spec.points).collect(), around, on_ground: true }));
    chart.layers.extend(marks(&spec.points));
    chart.layers.extend(spec.present.map(|at| mark(at, Shape::Handle, Role::Neutral)));
    chart
}

/// The range of the curve, stretched by points within reach, with room.
fn range(column: &[f64], points: impl Iterator<Item = f64>) -> (f64, f64) {
    let positive =
        |values: &mut dyn Iterator<Item = f64>| extent(&values.filter(|&value| value > 0.0).collect::<Vec<f64>>());
    let curve = positive(&mut column.iter().copied());
    let reach = curve.map_or((0.0, f64::INFINITY), |(low, high)| (low / REACH, high * REACH));
    let points = positive(&mut points.filter(|&value| reach.0 <= value && value <= reach.1));
    let (low, high) = curve.into_iter().chain(points).reduce(join).unwrap_or((1.0, 10.0));
    with_room((low, high), ROOM.0, ROOM.1)
}

#[cfg(test)]
mod tests {
    use super::super::super::{Scale, table};
    use super::*;

    fn point(at: (f64, f64)) -> NamedPoint<'static> {
        NamedPoint { name: "SIMC", at, role: Role::Loop1, shape: Shape::Diamond }
    }

    #[test]
    fn both_axes_are_logarithmic_and_hold_the_curve_with_points_within_reach() {
        let (x, y) = ([1e-10, 1e-9, 1e-8], [1e-2, 1e-3, 1e-4]);
        let spec = |points| TradeOffChart { curve: (&x, &y), points, present: Some((2e-9, 5e-4)), axes: ["q", "h"] };
        let alone = trade_off(&spec(Vec::new()));
        assert_eq!((alone.x.scale, alone.y.scale), (Scale::Logarithmic, Scale::Logarithmic));
        assert!(alone.x.range.0 < 1e-10 && alone.x.range.1 > 1e-8 && alone.x.range.1 < 1e-7);
        let near = trade_off(&spec(vec![point((5e-8, 5e-4))]));
        assert!(near.x.range.1 > 5e-8 && near.y.range == alone.y.range);
        let far = trade_off(&spec(vec![point((1.0, 1e-3)), point((0.0, f64::NAN)), point((f64::INFINITY, -1.0))]));
        assert_eq!(far.x.range, alone.x.range);
        assert_eq!(table(&[alone], 10).columns, ["q", "h"]);
    }

    #[test]
    fn points_alone_make_axes() {
        let chart = trade_off(&TradeOffChart {
            curve: (&[], &[]),
            points: vec![point((1e-9, 1e-3))],
            present: None,
            axes: ["q", "h"],
        });
        assert!(chart.x.range.0 < 1e-9 && chart.x.range.1 > 1e-9 && chart.y.range.0 > 1e-4);
    }
}
