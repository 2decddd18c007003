//! Where the entries of a legend stand: in rows above the plot, as many as the width takes.

use super::Entry;
use super::measure::{CHARACTER, LINE};

/// Width of a sample and the gap behind it (CSS px).
pub(super) const SAMPLE: f64 = 22.0;
/// Gap between two entries.
const GAP: f64 = 14.0;
/// What of the width of a figure the axis beside the plot may take.
const AXIS: f64 = 64.0;

/// Height of a legend in a figure of this width (CSS px).
pub(super) fn height(legend: &[Entry], width: f64) -> f64 {
    places(legend, width).last().map_or(0.0, |&(_, row)| (row + 1.0) * LINE + 4.0)
}

/// For each entry its left end (CSS px from the plot) and the number of its row.
pub(super) fn places(legend: &[Entry], width: f64) -> Vec<(f64, f64)> {
    let mut row = 0.0;
    let mut end = 0.0;
    let place = |entry: &Entry| {
        let length = SAMPLE + entry.text.chars().count() as f64 * CHARACTER;
        if end > 0.0 && end + length > width - AXIS {
            row += 1.0;
            end = 0.0;
        }
        let left = end;
        end += length + GAP;
        (left, row)
    };
    legend.iter().map(place).collect()
}
