//! From a series to what the eye can tell of it: polylines in CSS px inside the plot, with as few corners as will do.

use super::{Course, Frame, Rect, Scale, Series};

/// A point of the figure in CSS px.
pub(super) type Px = (f64, f64);

/// Pixels beyond this are all equally far outside.
const FAR: f64 = 1e6;
/// How far a simplified curve may be from the full one (CSS px): as little as nobody sees. What a curve costs goes with its corners, and
/// these with the root of it.
const TOLERANCE: f64 = 0.15;

/// The visible pieces of a series. Each has at least two points, all inside the plot rectangle or on its edge.
///
/// Rising series are thinned on the way: to the corners of a curve that stays within [`TOLERANCE`] of every point,
/// and where there are still many, to the first, lowest, highest and last of a pixel column, so that noise keeps its
/// height.
pub(super) fn polylines(series: &Series, frame: &Frame) -> Vec<Vec<Px>> {
    let (x, y) = (&series.x[..], &series.y[..]);
    let length = x.len().min(y.len());
    let (x, y) = (&x[..length], &y[..length]);
    let rising = x.is_sorted();
    let (x, y) = if rising { visible(x, y, frame.x) } else { (x, y) };
    let pixels = Pixels::of(frame, series.y_scale);
    let mut tracer =
        Tracer { rising, corners: Corners::default(), columns: Columns::default(), clip: Clip::new(frame.plot) };
    let mut held: Option<f64> = None;
    for (&x, &y) in x.iter().zip(y) {
        let point = pixels.at(x, y);
        match point {
            None => tracer.lift(),
            Some(point) => {
                if let Some(height) = held.filter(|&height| series.course == Course::Held && height != point.1) {
                    tracer.line_to((point.0, height));
                }
                tracer.line_to(point);
            }
        }
        held = point.map(|point| point.1);
    }
    tracer.lift();
    tracer.clip.runs
}

/// From all points to the few that are drawn.
struct Tracer {
    rising: bool,
    corners: Corners,
    columns: Columns,
    clip: Clip,
}

impl Tracer {
    fn line_to(&mut self, point: Px) {
        if !self.rising {
            self.clip.line_to(point);
        } else if let Some(corner) = self.corners.add(point) {
            self.columns.add(corner, &mut self.clip);
        }
    }

    fn lift(&mut self) {
        for corner in self.corners.take() {
            self.columns.add(corner, &mut self.clip);
        }
        self.columns.flush(&mut self.clip);
        self.clip.lift();
    }
}

/// The points between two abscissae and one more at either end, so that the curve reaches the edge.
fn visible<'a>(x: &'a [f64], y: &'a [f64], (min, max): (f64, f64)) -> (&'a [f64], &'a [f64]) {
    let first = x.partition_point(|&x| x < min).saturating_sub(1);
    let last = (x.partition_point(|&x| x <= max) + 1).min(x.len());
    (&x[first..last], &y[first..last])
}

/// From data to pixels as [`Frame::to_px`] does, without a division for each point.
struct Pixels {
    x: Ruler,
    y: Ruler,
}

impl Pixels {
    fn of(frame: &Frame, y_scale: f64) -> Self {
        let (left, right, bottom, top) = (frame.plot.left, frame.plot.right(), frame.plot.bottom(), frame.plot.top);
        Self {
            x: Ruler::new(frame.x_scale, frame.x, (left, right), 1.0),
            y: Ruler::new(frame.y_scale, frame.y, (bottom, top), y_scale),
        }
    }

    fn at(&self, x: f64, y: f64) -> Option<Px> {
        let (x, y) = (self.x.px(x), self.y.px(y));
        (x.is_finite() && y.is_finite()).then(|| (x.clamp(-FAR, FAR), y.clamp(-FAR, FAR)))
    }
}

/// The same along one axis: a straight line over the values times a factor, or over their logarithms.
struct Ruler {
    scale: Scale,
    factor: f64,
    origin: f64,
    slope: f64,
}

impl Ruler {
    fn new(scale: Scale, (from, to): (f64, f64), (first, last): (f64, f64), factor: f64) -> Self {
        match scale {
            Scale::Linear => {
                let slope = (last - first) / (to - from);
                Self { scale, factor, origin: first - from * slope, slope: slope * factor }
            }
            Scale::Logarithmic => {
                let slope = (last - first) / (to / from).ln();
                Self { scale, factor, origin: first - from.ln() * slope, slope }
            }
        }
    }

    fn px(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => self.origin + value * self.slope,
            Scale::Logarithmic => self.origin + logarithm(value * self.factor) * self.slope,
        }
    }
}

/// Out of line, because the compiler otherwise takes the logarithm of values on linear axes too and throws it away: 0.4 of the 3 ms
/// that the charts of the home bench took to paint (2026-11-28).
#[inline(never)]
fn logarithm(value: f64) -> f64 {
    value.ln()
}

/// The corners that a rising curve needs: a point is left out while one straight line passes all those left out since
/// the last corner within [`TOLERANCE`].
#[derive(Default)]
struct Corners {
    /// The last corner, the point after it, and the slopes of the lines that pass all points between.
    state: Option<(Px, Px, (f64, f64))>,
}

const EVERY_SLOPE: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);
const NO_SLOPE: (f64, f64) = (f64::INFINITY, f64::NEG_INFINITY);

impl Corners {
    /// Takes the next point; gives back a corner when it is certain that it is one.
    fn add(&mut self, point: Px) -> Option<Px> {
        let Some((corner, previous, slopes)) = self.state else {
            self.state = Some((point, point, EVERY_SLOPE));
            return None;
        };
        let (width, rise) = (point.0 - corner.0, point.1 - corner.1);
        let fits = width > 0.0 && slopes.0 * width <= rise && rise <= slopes.1 * width;
        if fits || previous == corner {
            self.state = Some((corner, point, narrowed(slopes, corner, point)));
            None
        } else {
            self.state = Some((previous, point, narrowed(EVERY_SLOPE, previous, point)));
            Some(corner)
        }
    }

    /// The points that are still owed.
    fn take(&mut self) -> impl Iterator<Item = Px> + use<> {
        let owed = self.state.take().map(|(corner, previous, _)| [corner, previous]);
        owed.into_iter().flatten()
    }
}

/// The slopes that pass this point too.
fn narrowed((low, high): (f64, f64), corner: Px, point: Px) -> (f64, f64) {
    let width = point.0 - corner.0;
    if width > 0.0 {
        let (rise, per_width) = (point.1 - corner.1, width.recip());
        (low.max((rise - TOLERANCE) * per_width), high.min((rise + TOLERANCE) * per_width))
    } else {
        NO_SLOPE
    }
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
    high_is_later: bool,
    last: Px,
}

impl Columns {
    fn add(&mut self, point: Px, clip: &mut Clip) {
        let number = point.0.floor();
        match &mut self.column {
            Some(column) if column.number == number => {
                column.last = point;
                if point.1 < column.low.1 {
                    column.low = point;
                    column.high_is_later = false;
                }
                if point.1 > column.high.1 {
                    column.high = point;
                    column.high_is_later = true;
                }
            }
            _ => {
                self.flush(clip);
                self.column =
                    Some(Column { number, first: point, low: point, high: point, high_is_later: true, last: point });
            }
        }
    }

    fn flush(&mut self, clip: &mut Clip) {
        if let Some(Column { first, low, high, high_is_later, last, .. }) = self.column.take() {
            let (earlier, later) = if high_is_later { (low, high) } else { (high, low) };
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

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::{Axis, Chart, Pen, Role, Size, layout};

    fn frame(x: (f64, f64), y: (f64, f64)) -> Frame {
        let chart = Chart::new(Axis::new("", x), Axis::new("", y));
        layout(&[chart], Size { width: 400.0, height: 300.0 })[0]
    }

    fn series(x: Vec<f64>, y: Vec<f64>, course: Course) -> Series<'static> {
        let (role, pen) = (Role::Loop1, Pen::Solid);
        Series { name: "".into(), role, pen, course, x: x.into(), y: y.into(), y_scale: 1.0 }
    }

    /// Up to what rounding leaves of a few hundred pixels.
    fn assert_same(run: &[Px], expected: &[Px]) {
        assert_eq!(run.len(), expected.len());
        for (a, b) in run.iter().zip(expected) {
            assert!((a.0 - b.0).abs().max((a.1 - b.1).abs()) < 1e-9, "{a:?} {b:?}");
        }
    }

    /// Height of a polyline at an abscissa.
    fn height(run: &[Px], x: f64) -> f64 {
        let pair = run.windows(2).find(|pair| pair[0].0 <= x && x <= pair[1].0).expect("inside the curve");
        let width = pair[1].0 - pair[0].0;
        if width == 0.0 { pair[0].1 } else { pair[0].1 + (x - pair[0].0) / width * (pair[1].1 - pair[0].1) }
    }

    #[test]
    fn a_smooth_curve_keeps_its_shape_with_few_corners() {
        let frame = frame((0.0, 20.0), (-1.5, 1.5));
        let x: Vec<f64> = (0..=20_000).map(|k| f64::from(k) * 1e-3).collect();
        let curve = series(x.clone(), x.iter().map(|x| x.sin()).collect(), Course::Straight);
        let runs = polylines(&curve, &frame);
        assert_eq!(runs.len(), 1);
        assert!(runs[0].len() < 400, "{} corners", runs[0].len());
        for x in x.iter().step_by(7) {
            let drawn = height(&runs[0], frame.x_px(*x));
            assert!((drawn - frame.y_px(x.sin())).abs() < 2.0 * TOLERANCE, "at {x}");
        }
    }

    #[test]
    fn noise_keeps_its_extremes_with_four_points_a_column() {
        let frame = frame((0.0, 1.0), (-1.0, 1.0));
        let x: Vec<f64> = (0..20_000).map(|k| f64::from(k) / 20_000.0).collect();
        let mut y: Vec<f64> =
            (0..20_000u32).map(|k| f64::from(k.wrapping_mul(2_654_435_761) >> 16) / 65_536.0 - 0.5).collect();
        (y[12_345], y[4_321]) = (0.9, -0.9);
        let run = polylines(&series(x, y, Course::Straight), &frame).concat();
        assert!(run.len() as f64 <= 4.0 * (frame.plot.width + 1.0));
        let highest = run.iter().map(|point| point.1).fold(f64::INFINITY, f64::min);
        let lowest = run.iter().map(|point| point.1).fold(0.0, f64::max);
        assert!((highest - frame.y_px(0.9)).abs() < 1e-9);
        assert!((lowest - frame.y_px(-0.9)).abs() < 1e-9);
    }

    #[test]
    fn a_held_curve_is_a_staircase_at_its_own_times() {
        let frame = frame((0.0, 3.0), (0.0, 3.0));
        let stairs = series(vec![0.0, 1.0, 2.0, 3.0], vec![1.0, 2.0, 2.0, 1.0], Course::Held);
        let corners = [(0.0, 1.0), (1.0, 1.0), (1.0, 2.0), (3.0, 2.0), (3.0, 1.0)];
        let runs = polylines(&stairs, &frame);
        assert_eq!(runs.len(), 1);
        assert_same(&runs[0], &corners.map(|corner| frame.to_px(corner)));
    }

    #[test]
    fn a_step_inside_a_pixel_column_stays_upright() {
        let frame = frame((0.0, 30_000.0), (0.0, 3.0));
        let x: Vec<f64> = (0..30_000).map(f64::from).collect();
        let y = x.iter().map(|&x| if x < 1000.0 { 1.0 } else { 2.0 }).collect();
        let run = polylines(&series(x, y, Course::Held), &frame).concat();
        let step = frame.x_px(1000.0);
        assert_same(&run[1..3], &[(step, frame.y_px(1.0)), (step, frame.y_px(2.0))]);
        assert_eq!(run.len(), 4);
    }

    #[test]
    fn a_power_is_straight_on_logarithmic_axes() {
        let chart = Chart::new(Axis::logarithmic("", (1e-2, 1e2)), Axis::logarithmic("", (1.0, 1e8)));
        let frame = layout(&[chart], Size { width: 400.0, height: 300.0 })[0];
        let x: Vec<f64> = (-20..=20).map(|k| 10f64.powf(f64::from(k) / 10.0)).collect();
        let y = x.iter().map(|x| x * x).collect();
        let square = Series { y_scale: 1e4, ..series(x, y, Course::Straight) };
        let runs = polylines(&square, &frame);
        assert_eq!(runs.len(), 1);
        assert_same(&runs[0], &[(1e-2, 1.0), (1e2, 1e8)].map(|point| frame.to_px(point)));
        let zero = series(vec![0.1, 1.0, 10.0], vec![10.0, 0.0, 10.0], Course::Straight);
        assert!(polylines(&zero, &frame).is_empty(), "zero interrupts");
    }

    #[test]
    fn a_growing_curve_is_cut_at_the_edge() {
        let frame = frame((0.0, 10.0), (0.0, 1.0));
        let x: Vec<f64> = (0..1000).map(|k| f64::from(k) * 0.01).collect();
        let y = x.iter().map(|x| 0.5 + 0.001 * (9.0 * x).exp() * (3.0 * x).cos()).collect();
        let runs = polylines(&series(x, y, Course::Straight), &frame);
        assert!(!runs.is_empty());
        for point in runs.concat() {
            assert!(frame.plot.contains(point), "{point:?}");
        }
    }

    #[test]
    fn a_point_that_is_not_finite_interrupts() {
        let frame = frame((0.0, 4.0), (0.0, 4.0));
        let curve =
            series(vec![0.0, 1.0, 2.0, 3.0, 4.0], vec![1.0, 2.0, f64::NAN, 1.0, f64::INFINITY], Course::Straight);
        let runs = polylines(&curve, &frame);
        assert_eq!(runs, [vec![frame.to_px((0.0, 1.0)), frame.to_px((1.0, 2.0))]]);
    }

    #[test]
    fn a_zoomed_curve_reaches_both_edges() {
        let frame = frame((4.5, 5.5), (0.0, 10.0));
        let x: Vec<f64> = (0..=10).map(f64::from).collect();
        let run = polylines(&series(x.clone(), x, Course::Straight), &frame).concat();
        assert_eq!(run.first().map(|point| point.0), Some(frame.plot.left));
        assert_eq!(run.last().map(|point| point.0), Some(frame.plot.right()));
    }
}
