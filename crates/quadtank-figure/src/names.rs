//! Where words stand beside their points: on the side where they cover the least.

use plotters::style::text_anchor::HPos;

use super::measure::{BOLD, CHARACTER, LINE};
use super::trace::Px;
use super::{Frame, Name, Names, Rect};

/// Height of a word (CSS px).
const HEIGHT: f64 = LINE - 2.0;
/// Half of the square around a point that words keep off (CSS px).
const MARK: f64 = 6.0;
/// The same for the arrow of a point beyond the edge.
const ARROW: f64 = 10.0;
/// Gap between these and the word (CSS px).
const GAP: f64 = 3.0;
/// The sides of a point, best first.
const SIDES: [Px; 8] =
    [(1.0, 0.0), (-1.0, 0.0), (0.0, -1.0), (0.0, 1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, -1.0), (-1.0, 1.0)];
/// Rows above and below a point where a word stands that has no place beside it, with a line to it.
const ROWS: usize = 6;
/// What a square pixel of a word on another word and on a point weighs.
const ON_WORD: f64 = 8.0;
const ON_POINT: f64 = 4.0;
/// What a place weighs for each that is better in itself, and what one with a line does.
const PREFERENCE: f64 = 4.0;
const FAR: f64 = 60.0;

/// A word with its place.
pub(super) struct Placed {
    /// Which of the names.
    pub index: usize,
    /// Its box (CSS px).
    pub place: Rect,
    /// Which part of it is next to the point: there it begins or ends exactly.
    pub h_pos: HPos,
    /// From the point to the word, if that is far away.
    pub leader: Option<[Px; 2]>,
}

/// Places for all names whose points can be shown, in their order.
pub(super) fn placed(names: &Names, frame: &Frame) -> Vec<Placed> {
    let plot = frame.plot;
    // A point beyond the edge has an arrow there, which is larger than a mark.
    let spot = |at: (f64, f64)| {
        let (x, y) = frame.to_px(at);
        let is_shown = !x.is_nan() && !y.is_nan();
        let radius = if plot.contains((x, y)) { MARK } else { ARROW };
        is_shown.then(|| ((x.clamp(plot.left, plot.right()), y.clamp(plot.top, plot.bottom())), radius))
    };
    let points = names.names.iter().map(|name| name.at).chain(names.around.iter().copied());
    let marks: Vec<Rect> = points.filter_map(spot).map(mark).collect();
    let mut taken: Vec<Placed> = Vec::new();
    for (index, name) in names.names.iter().enumerate() {
        let Some((point, radius)) = spot(name.at).filter(|_| !name.text.is_empty()) else { continue };
        let weight = |place: &Rect| {
            let on_words = taken.iter().map(|other| common(place, &other.place)).sum::<f64>();
            let on_points = marks.iter().map(|mark| common(place, mark)).sum::<f64>();
            ON_WORD * on_words + ON_POINT * on_points
        };
        let places = places(point, radius + GAP, length(name)).enumerate().map(|(rank, (place, h_pos, is_far))| {
            let place = moved_into(&plot, place);
            let far = if is_far { FAR } else { 0.0 };
            (weight(&place) + PREFERENCE * rank as f64 + far, h_pos, is_far, place)
        });
        if let Some((_, h_pos, is_far, place)) = places.min_by(|a, b| a.0.total_cmp(&b.0)) {
            let leader = is_far.then(|| [point, nearest(&place, point)]);
            taken.push(Placed { index, place, h_pos, leader });
        }
    }
    taken
}

fn mark(((x, y), radius): (Px, f64)) -> Rect {
    Rect { left: x - radius, top: y - radius, width: 2.0 * radius, height: 2.0 * radius }
}

/// Width of a word, on the wide side.
fn length(name: &Name) -> f64 {
    let width = |letter: char| if name.bold || letter.is_uppercase() { BOLD } else { CHARACTER };
    name.text.chars().map(width).sum()
}

/// Boxes for a word, best first, each with the part that is next to the point, and whether it is so far out that a line has to lead
/// there.
fn places(point: Px, gap: f64, length: f64) -> impl Iterator<Item = (Rect, HPos, bool)> {
    // Diagonally the gap is that of both directions together.
    let gaps = move |(right, down): Px| if right != 0.0 && down != 0.0 { (0.8 * gap, 0.4 * gap) } else { (gap, gap) };
    let near = SIDES.into_iter().map(move |side| (beside(point, side, gaps(side), length), next_to(side), false));
    let rows = (2..=ROWS).flat_map(|row| [(1.0, -1.0), (1.0, 1.0), (-1.0, -1.0), (-1.0, 1.0)].map(|side| (row, side)));
    let far = rows.map(move |(row, side)| {
        let down = (row as f64 - 1.0) * HEIGHT + 0.4 * gap;
        (beside(point, side, (1.5 * gap, down), length), next_to(side), true)
    });
    near.chain(far)
}

fn next_to((right, _): Px) -> HPos {
    match right {
        right if right > 0.0 => HPos::Left,
        right if right < 0.0 => HPos::Right,
        _ => HPos::Center,
    }
}

/// The box of a word on one side of a point.
fn beside((x, y): Px, (right, down): Px, gap: Px, length: f64) -> Rect {
    let place = |at: f64, direction: f64, gap: f64, size: f64| at + direction * (gap + size / 2.0) - size / 2.0;
    Rect { left: place(x, right, gap.0, length), top: place(y, down, gap.1, HEIGHT), width: length, height: HEIGHT }
}

/// The same box, as far inside the plot as it fits.
fn moved_into(plot: &Rect, place: Rect) -> Rect {
    let edge = 2.0;
    let left = place.left.min(plot.right() - edge - place.width).max(plot.left + edge);
    let top = place.top.min(plot.bottom() - edge - place.height).max(plot.top + edge);
    Rect { left, top, ..place }
}

/// The point of a box that is nearest to a point.
fn nearest(place: &Rect, (x, y): Px) -> Px {
    (x.clamp(place.left, place.right()), y.clamp(place.top + 2.0, place.bottom() - 2.0))
}

/// The area that two boxes have in common.
fn common(a: &Rect, b: &Rect) -> f64 {
    let width = a.right().min(b.right()) - a.left.max(b.left);
    let height = a.bottom().min(b.bottom()) - a.top.max(b.top);
    width.max(0.0) * height.max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Axis, Chart, Name, Role, Size, layout};

    fn frame() -> Frame {
        let chart = Chart::new(Axis::new("", (0.0, 1.0)), Axis::new("", (0.0, 1.0)));
        layout(&[chart], Size { width: 400.0, height: 300.0 })[0]
    }

    fn names(points: &[(f64, f64)], around: &[(f64, f64)]) -> Names {
        let name = |&at| Name { at, text: "a published rule".to_owned(), role: Role::Neutral, bold: false };
        Names { names: points.iter().map(name).collect(), around: around.to_vec(), on_ground: false }
    }

    #[test]
    fn a_word_stands_to_the_right_where_there_is_room() {
        let frame = frame();
        let point = frame.to_px((0.3, 0.5));
        let place = placed(&names(&[(0.3, 0.5)], &[]), &frame)[0].place;
        assert!((place.left - point.0 - MARK - GAP).abs() < 1e-9 && (place.top + HEIGHT / 2.0 - point.1).abs() < 1e-9);
        let place = placed(&names(&[(0.98, 0.5)], &[]), &frame)[0].place;
        assert!((place.right() - frame.to_px((0.98, 0.5)).0 + MARK + GAP).abs() < 1e-9, "to the left at the edge");
        let place = placed(&names(&[(0.3, 0.5)], &[(0.4, 0.5), (0.2, 0.5)]), &frame)[0].place;
        assert!(place.bottom() < point.1, "above between two marks");
    }

    #[test]
    fn words_of_near_points_do_not_lie_on_each_other_nor_leave_the_plot() {
        let frame = frame();
        let points: Vec<_> = (0..9).map(|k| (0.9 + 0.004 * f64::from(k), 0.5 + 0.003 * f64::from(k % 4))).collect();
        let placed = placed(&names(&points, &[]), &frame);
        assert_eq!(placed.len(), 9);
        for (k, one) in placed.iter().enumerate() {
            assert!(common(&one.place, &frame.plot) >= one.place.width * one.place.height - 1e-6);
            assert!(placed[..k].iter().all(|other| common(&one.place, &other.place) == 0.0), "{k}");
        }
        assert!(placed[0].leader.is_none() && placed[8].leader.is_some());
    }

    #[test]
    fn a_point_that_is_none_has_no_word_and_one_beyond_has_it_at_the_edge() {
        let frame = frame();
        let placed = placed(&names(&[(f64::NAN, 0.5), (f64::INFINITY, 0.5)], &[]), &frame);
        assert_eq!(placed.iter().map(|placed| placed.index).collect::<Vec<_>>(), [1]);
        assert!(placed[0].place.right() <= frame.plot.right());
    }
}
