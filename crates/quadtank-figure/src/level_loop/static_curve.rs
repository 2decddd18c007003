use super::super::range::{extent, join};
use super::super::{Axis, Chart, Pen, Role, Shape};
use super::{curve, mark};

/// Room above and below the curve, as a share of its range.
const ROOM: f64 = 0.04;

/// What a static curve shows.
#[derive(Clone, Copy, Debug)]
pub struct StaticCurve<'a> {
    /// Abscissae.
    pub x: &'a [f64],
    /// Ordinates.
    pub y: &'a [f64],
    /// The operating point.
    pub at: Option<(f64, f64)>,
    /// Names with units of the axes.
    pub axes: [&'a str; 2],
}

/// A curve with its operating point, from which dotted lines lead to both axes.
pub fn static_curve<'a>(spec: &StaticCurve<'a>) -> Chart<'a> {
    let at = spec.at.filter(|(x, y)| x.is_finite() && y.is_finite());
    let range = |column: &[f64], at: Option<f64>| {
        let point = at.map(|value| (value, value));
        extent(column).into_iter().chain(point).reduce(join).unwrap_or((0.0, 1.0))
    };
    let (low, high) = range(spec.y, at.map(|at| at.1));
    let room = ROOM * (high - low);
    // What begins at nothing begins at the edge.
    let bottom = if low >= 0.0 { (low - room).max(0.0) } else { low - room };
    let mut chart = Chart::new(
        Axis::new(spec.axes[0], range(spec.x, at.map(|at| at.0))),
        Axis::rounded(spec.axes[1], (bottom, high + room), 5),
    );
    chart.layers.push(curve(spec.axes[1], Role::Loop1, Pen::Solid, spec.x, spec.y));
    if let Some((x, y)) = at {
        let (left, bottom) = (chart.x.span().0, chart.y.span().0);
        chart.layers.push(curve("", Role::Neutral, Pen::Dotted, vec![left, x], vec![y, y]));
        chart.layers.push(curve("", Role::Neutral, Pen::Dotted, vec![x, x], vec![y, bottom]));
        chart.layers.push(mark((x, y), Shape::Point, Role::Neutral));
    }
    chart
}

#[cfg(test)]
mod tests {
    use super::super::super::{Layer, table};
    use super::*;

    #[test]
    fn the_operating_point_is_in_sight_with_lines_to_both_axes() {
        let (x, y) = ([0.0, 50.0, 100.0], [0.0, 2.0, 8.0]);
        let spec = StaticCurve { x: &x, y: &y, at: Some((120.0, 9.5)), axes: ["opening", "flow"] };
        let chart = static_curve(&spec);
        assert!(chart.x.range.0 == 0.0 && chart.x.range.1 >= 120.0 && chart.y.range.1 >= 9.5);
        assert_eq!(chart.series().filter(|series| series.pen == Pen::Dotted).count(), 2);
        assert_eq!(table(&[chart], 5).columns, ["opening", "flow"]);
        let without = static_curve(&StaticCurve { at: Some((f64::NAN, 1.0)), ..spec });
        assert!(without.layers.iter().all(|layer| matches!(layer, Layer::Line(_))) && without.layers.len() == 1);
    }
}
