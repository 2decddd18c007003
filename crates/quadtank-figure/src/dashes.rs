//! A line in dashes.

use super::trace::Px;

/// Largest number of dashes of a line. A line with more of them is drawn with longer dashes: an oscillation that fills the plot would
/// have tens of thousands, which take a tenth of a second to paint.
const MAX_DASHES: f64 = 500.0;

fn length_of(pair: &[Px]) -> f64 {
    let &[from, to] = pair else { return 0.0 };
    let (across, down) = (to.0 - from.0, to.1 - from.1);
    (across * across + down * down).sqrt()
}

/// The dashes of a polyline: `on` px drawn, `off` px left out, and so on round its corners; both longer in a very long line.
pub(super) fn dashes(run: &[Px], on: f64, off: f64) -> Vec<Vec<Px>> {
    let whole: f64 = run.windows(2).map(length_of).sum();
    let stretch = (whole / (MAX_DASHES * (on + off))).max(1.0);
    let (on, off) = (stretch * on, stretch * off);
    let mut dashes = Vec::new();
    let mut dash: Vec<Px> = run.first().copied().into_iter().collect();
    let (mut drawing, mut left) = (true, on);
    for pair in run.windows(2) {
        let &[mut from, to] = pair else { continue };
        let mut length = length_of(pair);
        while length > left {
            let share = left / length;
            from = (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1));
            length -= left;
            if drawing {
                dash.push(from);
                dashes.push(std::mem::take(&mut dash));
            } else {
                dash.push(from);
            }
            drawing = !drawing;
            left = if drawing { on } else { off };
        }
        left -= length;
        if drawing {
            dash.push(to);
        }
    }
    if drawing && dash.len() > 1 {
        dashes.push(dash);
    }
    dashes
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn dashes_keep_their_rhythm_round_a_corner() {
        let dashes = dashes(&[(0.0, 0.0), (7.0, 0.0), (7.0, 10.0)], 4.0, 2.0);
        assert_eq!(dashes[0], [(0.0, 0.0), (4.0, 0.0)]);
        assert_eq!(dashes[1], [(6.0, 0.0), (7.0, 0.0), (7.0, 3.0)]);
        assert_eq!(dashes[2], [(7.0, 5.0), (7.0, 9.0)]);
        assert_eq!(dashes.len(), 3);
    }

    #[test]
    fn a_line_that_swings_all_over_the_plot_has_no_more_dashes_than_can_be_seen() {
        let swings: Vec<Px> = (0..5000).map(|k| (0.1 * f64::from(k), if k % 2 == 0 { 0.0 } else { 80.0 })).collect();
        let dashes = dashes(&swings, 1.8, 2.7);
        assert!((450..=501).contains(&dashes.len()), "{}", dashes.len());
        let (first, last) = (dashes[0][0], dashes[dashes.len() - 1][0]);
        assert!(first.0 < 1.0 && last.0 > 490.0, "they go all along: {first:?} {last:?}");
    }
}
