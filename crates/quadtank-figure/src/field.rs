//! A field as a stack of polygons, from the palest shade to the deepest.

use super::Field;

/// Steps from the background to the deepest shade.
const STEPS: u8 = 16;

/// A region of at least a certain shade.
pub(super) struct Patch {
    /// The shade to fill it with.
    pub shade: f64,
    /// Its outline in the units of the field.
    pub outline: Vec<(f64, f64)>,
}

/// The patches of a field, in the order in which to fill them.
pub(super) fn patches(field: &Field) -> Vec<Patch> {
    let mut patches = Vec::new();
    for step in 1..=STEPS {
        let threshold = (f64::from(step) - 0.5) / f64::from(STEPS);
        for sign in [-1.0, 1.0] {
            let outline = outline(field, sign, threshold);
            if outline.len() > 2 {
                patches.push(Patch { shade: sign * f64::from(step) / f64::from(STEPS), outline });
            }
        }
    }
    patches
}

/// The outline of `sign × shade ≥ threshold`: its left ends row by row, then its right ends back.
fn outline(field: &Field, sign: f64, threshold: f64) -> Vec<(f64, f64)> {
    let columns = field.columns.max(2);
    let rows: Vec<&[f64]> = field.shades.chunks_exact(columns).collect();
    let height = |row: f64| field.y.0 + (field.y.1 - field.y.0) * row / (rows.len().max(2) - 1) as f64;
    let abscissa = |column: f64| field.x.0 + (field.x.1 - field.x.0) * column / (columns - 1) as f64;
    let excess = |row: &[f64], column: usize| row.get(column).map_or(0.0, |shade| sign * shade - threshold);
    let (mut left, mut right) = (Vec::new(), Vec::new());
    for (number, row) in rows.iter().enumerate() {
        let Some(first) = (0..columns).find(|&column| excess(row, column) >= 0.0) else { continue };
        let Some(last) = (0..columns).rfind(|&column| excess(row, column) >= 0.0) else { continue };
        let from = first.checked_sub(1).map_or(0.0, |out| out as f64 + crossing(excess(row, out), excess(row, first)));
        let to = if last + 1 < columns {
            last as f64 + crossing(excess(row, last), excess(row, last + 1))
        } else {
            last as f64
        };
        let peak = if excess(row, first) > excess(row, last) { first } else { last };
        let tip = |other: Option<&&[f64]>, direction: f64| {
            let other = other.filter(|other| (0..columns).all(|column| excess(other, column) < 0.0))?;
            let share = crossing(excess(row, peak), excess(other, peak));
            Some((abscissa(peak as f64), height(number as f64 + direction * share)))
        };
        if left.is_empty() {
            left.extend(number.checked_sub(1).and_then(|below| tip(rows.get(below), -1.0)));
        }
        left.push((abscissa(from), height(number as f64)));
        right.push((abscissa(to), height(number as f64)));
        right.extend(tip(rows.get(number + 1), 1.0));
    }
    left.extend(right.into_iter().rev());
    left
}

/// Where, between 0 and 1, a straight line from `a` to `b` crosses zero.
fn crossing(a: f64, b: f64) -> f64 {
    if a == b { 0.0 } else { (a / (a - b)).clamp(0.0, 1.0) }
}
