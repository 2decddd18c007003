use super::chart::{Anchor, Label, Layer, Role};

/// Distance of a word from its curve (CSS px).
const BESIDE: f64 = 12.0;

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
            opposite: both[1 - index].map(|(_, other)| other * ends.scale),
        }))
    };
    [label(0), label(1)].into_iter().flatten()
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
    fn words_in_the_margin_stay_apart_and_inside() {
        assert_eq!(apart(&[50.0, 20.0], (0.0, 100.0)), [50.0, 20.0]);
        assert_eq!(apart(&[50.0, 48.0, 49.0], (0.0, 100.0)), [70.0, 48.0, 59.0]);
        assert_eq!(apart(&[99.0, 100.0, 100.0], (0.0, 100.0)), [78.0, 89.0, 100.0]);
    }
}
