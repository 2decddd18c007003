//! Value axes that stand still while something is dragged.

use super::range::join;
use super::{Axis, Chart};

/// Widens the value axes of `charts` so that each shows at least what `shown`, those of the frame before, showed. An axis with another label
/// or scale shows another quantity or unit and is left alone. Returns whether an axis is now wider than its curves need.
pub fn hold_value_axes(charts: &mut [Chart], shown: &[Axis]) -> bool {
    let mut is_wider = false;
    for (Chart { y, .. }, shown) in charts.iter_mut().zip(shown) {
        if (&y.label, y.scale) != (&shown.label, shown.scale) {
            continue;
        }
        let held = join(y.range, shown.range);
        is_wider |= held != y.range;
        y.range = held;
    }
    is_wider
}

#[cfg(test)]
mod tests {
    use super::*;

    fn charts(ranges: [(f64, f64); 2]) -> [Chart<'static>; 2] {
        ranges.map(|range| Chart::new(Axis::new("time (s)", (0.0, 1.0)), Axis::new("level (cm)", range)))
    }

    #[test]
    fn axes_grow_at_once_and_do_not_shrink() {
        let shown = charts([(0.0, 2.0), (5.0, 6.0)]).map(|chart| chart.y);
        let mut larger = charts([(-1.0, 3.0), (5.0, 6.0)]);
        assert!(!hold_value_axes(&mut larger, &shown));
        assert_eq!(larger, charts([(-1.0, 3.0), (5.0, 6.0)]));
        let mut smaller = charts([(0.5, 1.0), (5.5, 7.0)]);
        assert!(hold_value_axes(&mut smaller, &shown));
        assert_eq!(smaller, charts([(0.0, 2.0), (5.0, 7.0)]));
    }

    #[test]
    fn an_axis_of_something_else_is_not_held() {
        let [mut in_metres, mut logarithmic] = charts([(0.0, 2.0); 2]).map(|chart| chart.y);
        in_metres.label = "level (m)".to_owned();
        logarithmic.scale = super::super::Scale::Logarithmic;
        let mut smaller = charts([(0.5, 1.0); 2]);
        assert!(!hold_value_axes(&mut smaller, &[in_metres, logarithmic]));
        assert_eq!(smaller, charts([(0.5, 1.0); 2]));
        assert!(!hold_value_axes(&mut smaller, &[]), "a picture that is painted for the first time");
    }
}
