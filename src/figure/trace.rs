//! From a series to what the eye can tell of it: polylines in CSS px inside the plot, with as few corners as will do.

use super::{Course, Frame, Rect, Series};

/// A point of the figure in CSS px.
pub(super) type Px = (f64, f64);

/// Pixels beyond this are all equally far outside.
const FAR: f64 = 1e6;
/// How far a simplified curve may be from the full one (CSS px): half of the finest pixel that is painted.
const TOLERANCE: f64 = 0.06;

/// The visible pieces of a series. Each has at least two points, all inside the plot rectangle or on its edge.
///
/// Rising series are thinned to the first, lowest, highest and last point of every pixel column, so that noise keeps
/// its height, and then to the corners of a curve that stays within [`TOLERANCE`] of them.
pub(super) fn polylines(series: &Series, frame: &Frame) -> Vec<Vec<Px>> {
    let (x, y) = (&series.x[..], &series.y[..]);
    let length = x.len().min(y.len());
    let (x, y) = (&x[..length], &y[..length]);
    let rising = x.is_sorted();
    let (x, y) = if rising { visible(x, y, frame.x) } else { (x, y) };
    let mut clip = Clip::new(frame.plot);
    let mut columns = Columns::default();
    let mut held = None;
    for (&x, &y) in x.iter().zip(y) {
        let Some(point) = pixel(frame, (x, y * series.y_scale)) else {
            columns.flush(&mut clip);
            clip.lift();
            held = None;
            continue;
        };
        if let Some(height) = held.filter(|_| series.course == Course::Held) {
            columns.add((point.0, height), rising, &mut clip);
        }
        columns.add(point, rising, &mut clip);
        held = Some(point.1);
    }
    columns.flush(&mut clip);
    let runs = clip.finish();
    if rising { runs.iter().map(|run| simplified(run)).collect() } else { runs }
}

/// The points between two abscissae and one more at either end, so that the curve reaches the edge.
fn visible<'a>(x: &'a [f64], y: &'a [f64], (min, max): (f64, f64)) -> (&'a [f64], &'a [f64]) {
    let first = x.partition_point(|&x| x < min).saturating_sub(1);
    let last = (x.partition_point(|&x| x <= max) + 1).min(x.len());
    (&x[first..last], &y[first..last])
}

fn pixel(frame: &Frame, point: (f64, f64)) -> Option<Px> {
    let (x, y) = frame.to_px(point);
    (x.is_finite() && y.is_finite()).then(|| (x.clamp(-FAR, FAR), y.clamp(-FAR, FAR)))
}

/// The points of one pixel column of a rising curve.
#[derive(Default)]
struct Columns {
    column: Option<Column>,
}

#[derive(Clone, Copy)]
struct Column {
    number: f64,
    first: Px,
    low: Px,
    high: Px,
    last: Px,
}

impl Columns {
    fn add(&mut self, point: Px, rising: bool, clip: &mut Clip) {
        if !rising {
            return clip.line_to(point);
        }
        let number = point.0.floor();
        match &mut self.column {
            Some(column) if column.number == number => {
                column.last = point;
                if point.1 < column.low.1 {
                    column.low = point;
                }
                if point.1 > column.high.1 {
                    column.high = point;
                }
            }
            _ => {
                self.flush(clip);
                self.column = Some(Column { number, first: point, low: point, high: point, last: point });
            }
        }
    }

    fn flush(&mut self, clip: &mut Clip) {
        if let Some(Column { first, low, high, last, .. }) = self.column.take() {
            let (earlier, later) = if low.0 <= high.0 { (low, high) } else { (high, low) };
            for point in [first, earlier, later, last] {
                clip.line_to(point);
            }
        }
    }
}

/// Cuts a line at the edge of a rectangle, into as many pieces as it takes.
struct Clip {
    plot: Rect,
    previous: Option<Px>,
    runs: Vec<Vec<Px>>,
}

impl Clip {
    fn new(plot: Rect) -> Self {
        Self { plot, previous: None, runs: Vec::new() }
    }

    fn lift(&mut self) {
        self.previous = None;
    }

    fn line_to(&mut self, point: Px) {
        let Some(previous) = self.previous.replace(point).filter(|&previous| previous != point) else { return };
        let Some((from, to)) = clipped(&self.plot, previous, point) else { return };
        match self.runs.last_mut() {
            Some(run) if from == previous && run.last() == Some(&from) => run.push(to),
            _ => self.runs.push(vec![from, to]),
        }
    }

    fn finish(self) -> Vec<Vec<Px>> {
        self.runs
    }
}

/// The part of a segment inside a rectangle (Liang and Barsky 1984).
pub(super) fn clipped(plot: &Rect, from: Px, to: Px) -> Option<(Px, Px)> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let bounds = [
        (-dx, from.0 - plot.left),
        (dx, plot.right() - from.0),
        (-dy, from.1 - plot.top),
        (dy, plot.bottom() - from.1),
    ];
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for (speed, room) in bounds {
        if speed == 0.0 && room < 0.0 {
            return None;
        }
        if speed < 0.0 {
            enter = enter.max(room / speed);
        } else if speed > 0.0 {
            leave = leave.min(room / speed);
        }
    }
    let at = |share: f64| {
        let x = (from.0 + share * dx).clamp(plot.left, plot.right());
        (x, (from.1 + share * dy).clamp(plot.top, plot.bottom()))
    };
    let start = if enter > 0.0 { at(enter) } else { from };
    let end = if leave < 1.0 { at(leave) } else { to };
    (enter <= leave).then_some((start, end))
}

/// The corners that a rising curve needs: a point is left out while one straight line passes all those left out since
/// the last corner within [`TOLERANCE`].
fn simplified(run: &[Px]) -> Vec<Px> {
    let (Some(&first), Some(&end)) = (run.first(), run.last()) else { return Vec::new() };
    let mut kept = vec![first];
    let (mut corner, mut previous) = (first, first);
    let mut slopes = EVERY_SLOPE;
    for &point in run.iter().skip(1) {
        let fits = slope(corner, point).is_some_and(|slope| slopes.0 <= slope && slope <= slopes.1);
        if !fits && previous != corner {
            kept.push(previous);
            corner = previous;
            slopes = EVERY_SLOPE;
        }
        let (low, high) =
            (slope(corner, (point.0, point.1 - TOLERANCE)), slope(corner, (point.0, point.1 + TOLERANCE)));
        slopes = match (low, high) {
            (Some(low), Some(high)) => (slopes.0.max(low), slopes.1.min(high)),
            _ => NO_SLOPE,
        };
        previous = point;
    }
    kept.push(end);
    kept
}

const EVERY_SLOPE: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);
const NO_SLOPE: (f64, f64) = (f64::INFINITY, f64::NEG_INFINITY);

fn slope(from: Px, to: Px) -> Option<f64> {
    let dx = to.0 - from.0;
    (dx > 0.0).then(|| (to.1 - from.1) / dx)
}

/// The dashes of a polyline: `on` px drawn, `off` px left out, and so on round its corners.
pub(super) fn dashes(run: &[Px], on: f64, off: f64) -> Vec<Vec<Px>> {
    let mut dashes = Vec::new();
    let mut dash: Vec<Px> = run.first().copied().into_iter().collect();
    let (mut drawing, mut left) = (true, on);
    for pair in run.windows(2) {
        let &[mut from, to] = pair else { continue };
        let mut length = (to.0 - from.0).hypot(to.1 - from.1);
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
