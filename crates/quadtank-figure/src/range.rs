//! Ranges of value axes.

/// How far runs beside the main one may stretch the range, in ranges of the main one, to either side.
const STRETCH: f64 = 1.0;
/// Room above and below the curves, as a share of their range.
const ROOM: f64 = 0.06;

/// The range of the main columns, at least `least` wide, stretched by the columns beside them within `limits`.
pub(super) fn range<'a, const N: usize>(
    window: (f64, f64),
    time_s: &[f64],
    main: impl Iterator<Item = &'a [f64]>,
    beside: impl Iterator<Item = (&'a [f64], [&'a [f64]; N])>,
    limits: (f64, f64),
    least: f64,
) -> (f64, f64) {
    let main = main.filter_map(|column| extent(part(time_s, column, window))).reduce(join).unwrap_or(limits);
    let lacking = (least - (main.1 - main.0)).max(0.0) / 2.0;
    let main = (main.0 - lacking, main.1 + lacking);
    let stretch = STRETCH * (main.1 - main.0);
    let floor = (main.0 - stretch).max(limits.0).min(main.0);
    let ceiling = (main.1 + stretch).min(limits.1).max(main.1);
    let all = beside
        .flat_map(|(time_s, columns)| columns.map(|column| extent(part(time_s, column, window))))
        .flatten()
        // Not `clamp`, which panics where a main column is so large that the stretch is not finite.
        .map(|(low, high)| (low.max(floor).min(ceiling), high.max(floor).min(ceiling)))
        .fold(main, join);
    let room = ROOM * (all.1 - all.0);
    (all.0 - room, all.1 + room)
}

pub(super) fn join(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    (a.0.min(b.0), a.1.max(b.1))
}

/// Lowest and highest finite value.
pub(super) fn extent(values: &[f64]) -> Option<(f64, f64)> {
    values.iter().filter(|value| value.is_finite()).map(|&value| (value, value)).reduce(join)
}

/// The part of a column at times inside the window.
pub(super) fn part<'a>(time_s: &[f64], column: &'a [f64], (from, to): (f64, f64)) -> &'a [f64] {
    let first = time_s.partition_point(|&time| time < from);
    let end = time_s.partition_point(|&time| time <= to).max(first);
    column.get(first..end.min(column.len())).unwrap_or_default()
}
