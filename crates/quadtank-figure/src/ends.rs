use super::chart::{Anchor, Label, Layer, Role};

/// Distance of a word from its curve (CSS px).
const BESIDE: f64 = 12.0;
/// Ends of curves that are this share of all that is shown apart have room for a word between them.
const APART_SHARE: f64 = 0.3;

/// The curves of loops 1 and 2, which have their names at their ends: without colour they would look alike.
#[derive(Clone, Copy, Debug)]
pub struct Ends<'a> {
    /// Time.
    pub x: &'a [f64],
    /// Both curves.
    pub y: [&'a [f64]; 2],
    /// The curves are shown times this.
    pub scale: f64,
    /// Their names.
    pub names: [&'a str; 2],
    /// What is shown of the time; all of it if `None`.
    pub window: Option<(f64, f64)>,
}

/// The names: that of the higher curve above it, that of the lower one below.
pub fn names<'a>(ends: &Ends) -> impl Iterator<Item = Layer<'a>> {
    let shown = ends.window.map_or(ends.x.len(), |(_, to)| ends.x.partition_point(|&x| x <= to));
    let last = |index: usize| {
        let row = shown.checked_sub(1)?;
        ends.y[index].get(row).copied().filter(|y| y.is_finite()).map(|y| (ends.x[row], y))
    };
    let both = [last(0), last(1)];
    let are_apart = match both {
        [Some((_, one)), Some((_, other))] => (one - other).abs() >= APART_SHARE * span(ends.y.map(|y| &y[..shown])),
        _ => true,
    };
    let label = |index: usize| {
        let (x, y) = both[index].filter(|_| !ends.names[index].is_empty())?;
        let is_higher = both[1 - index].is_none_or(|(_, other)| y > other || (y == other && index == 0));
        Some(Layer::Label(Label {
            at: (x, y * ends.scale),
            offset: (-6.0, if is_higher { -BESIDE } else { BESIDE }),
            anchor: Anchor::Right,
            text: ends.names[index].to_owned(),
            role: Role::of_loop(index),
            bold: true,
            on_ground: false,
            may_turn: are_apart,
        }))
    };
    [label(0), label(1)].into_iter().flatten()
}

/// From the lowest to the highest point of both curves.
fn span(curves: [&[f64]; 2]) -> f64 {
    let points = || curves.into_iter().flatten().copied();
    points().fold(f64::NEG_INFINITY, f64::max) - points().fold(f64::INFINITY, f64::min)
}

/// Least distance of words above each other in the margin (CSS px).
const APART: f64 = 11.0;

/// Heights for words in the margin at these heights (CSS px): as near as they can be, apart from each other and between `top` and
/// `bottom` where they fit.
pub fn apart(heights: &[f64], (top, bottom): (f64, f64)) -> Vec<f64> {
    let mut order: Vec<usize> = (0..heights.len()).collect();
    order.sort_by(|&a, &b| heights[a].total_cmp(&heights[b]));
    let mut placed = heights.to_vec();
    let mut least = f64::NEG_INFINITY;
    for &index in &order {
        placed[index] = placed[index].max(least).max(top);
        least = placed[index] + APART;
    }
    let mut most = bottom;
    for &index in order.iter().rev() {
        placed[index] = placed[index].min(most);
        most = placed[index] - APART;
    }
    placed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_may_turn_where_the_ends_leave_room_between_them() {
        let (x, rising, falling) = ([0.0, 1.0, 2.0], [0.0, 1.0, 2.0], [1.0, 0.5, 0.0]);
        let turns = |one: &[f64], other: &[f64], until: f64| {
            let ends = Ends { x: &x, y: [one, other], scale: 1.0, names: ["1", "2"], window: Some((0.0, until)) };
            let layers: Vec<Layer> = names(&ends).collect();
            let is_turning = |layer: &Layer| matches!(layer, Layer::Label(label) if label.may_turn);
            assert_eq!(layers.len(), 2);
            layers.iter().all(is_turning)
        };
        assert!(turns(&rising, &falling, 2.0));
        assert!(!turns(&rising, &[0.0, 1.0, 1.9], 2.0));
        // Of what is shown the ends are close.
        assert!(!turns(&rising, &[1.0, 0.9, 0.0], 1.0));
    }

    #[test]
    fn words_in_the_margin_stay_apart_and_inside() {
        assert_eq!(apart(&[50.0, 20.0], (0.0, 100.0)), [50.0, 20.0]);
        assert_eq!(apart(&[50.0, 48.0, 49.0], (0.0, 100.0)), [70.0, 48.0, 59.0]);
        assert_eq!(apart(&[99.0, 100.0, 100.0], (0.0, 100.0)), [78.0, 89.0, 100.0]);
    }
}
