use super::measure::{DIGIT, LINE, MAX_TICKS, MIN_CHARACTERS, NUMBER_GAP, RIGHT, TICK_DISTANCE, TICK_GAP, TOP};
use super::{Axis, Chart, Scale, legend};

/// Longest side that is painted (CSS px); keeps finely divided pixels inside `i32`.
const LONGEST_SIDE: f64 = 20_000.0;

/// Width and height in CSS px.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Width (CSS px).
    pub width: f64,
    /// Height (CSS px).
    pub height: f64,
}

impl Size {
    /// The size, made usable: at least 1 px each way, finite, and no larger than can be painted.
    #[must_use]
    pub fn clamped(self) -> Self {
        let side = |length: f64| if length.is_finite() { length.clamp(1.0, LONGEST_SIDE) } else { 1.0 };
        Self { width: side(self.width), height: side(self.height) }
    }
}

/// A rectangle in CSS px; y runs downwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// Left edge.
    pub left: f64,
    /// Upper edge.
    pub top: f64,
    /// Width, positive.
    pub width: f64,
    /// Height, positive.
    pub height: f64,
}

impl Rect {
    /// Right edge.
    pub fn right(&self) -> f64 {
        self.left + self.width
    }

    /// Lower edge.
    pub fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// Whether a point lies inside or on the edge.
    pub fn contains(&self, (x, y): (f64, f64)) -> bool {
        (self.left..=self.right()).contains(&x) && (self.top..=self.bottom()).contains(&y)
    }
}

/// Where a chart stands in its figure, and how data and pixels correspond. The painter and whoever lays a cursor or a
/// handle over the picture use the same frame, so they agree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The part of the figure that belongs to the chart, labels included.
    pub outer: Rect,
    /// The plot rectangle, on whole pixels.
    pub plot: Rect,
    /// Values at the left and right edge of the plot.
    pub x: (f64, f64),
    /// Values at the lower and upper edge of the plot.
    pub y: (f64, f64),
    /// How values are spread between the left and the right edge.
    pub x_scale: Scale,
    /// The same between the lower and the upper edge.
    pub y_scale: Scale,
}

impl Frame {
    /// A frame whose axes are linear.
    pub const fn linear(outer: Rect, plot: Rect, x: (f64, f64), y: (f64, f64)) -> Self {
        Self { outer, plot, x, y, x_scale: Scale::Linear, y_scale: Scale::Linear }
    }

    /// Pixel (CSS px, from the left edge of the figure) of a value on the x axis.
    pub fn x_px(&self, x: f64) -> f64 {
        self.plot.left + self.x_scale.share(self.x, x) * self.plot.width
    }

    /// Pixel (CSS px, from the upper edge of the figure) of a value on the y axis.
    pub fn y_px(&self, y: f64) -> f64 {
        self.plot.bottom() - self.y_scale.share(self.y, y) * self.plot.height
    }

    /// Pixel of a point of the data.
    pub fn to_px(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (self.x_px(x), self.y_px(y))
    }

    /// The point of the data under a pixel; outside the plot it goes on.
    pub fn to_data(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (
            self.x_scale.value(self.x, (x - self.plot.left) / self.plot.width),
            self.y_scale.value(self.y, (self.plot.bottom() - y) / self.plot.height),
        )
    }
}

/// How many ticks fit on the x and on the y axis.
pub(super) fn tick_counts(chart: &Chart, frame: &Frame) -> (usize, usize) {
    // Numbers grow at most by a digit from a few ticks to many.
    let number = widest(&chart.x, 4) as f64 * DIGIT + NUMBER_GAP;
    (ticks_in(frame.plot.width, number), ticks_in(frame.plot.height, TICK_DISTANCE))
}

/// Characters of the longest number on an axis with so many ticks.
fn widest(axis: &Axis, ticks: usize) -> usize {
    axis.ticks(ticks).iter().map(|tick| tick.text('.').chars().count()).max().unwrap_or(0)
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to a small positive number")]
fn ticks_in(length: f64, distance: f64) -> usize {
    (length / distance).floor().clamp(1.0, MAX_TICKS) as usize
}

/// Frames of charts that stand on top of each other in a figure of the given size (CSS px), heights in proportion to
/// [`Chart::weight`]. All plots have the same left and right edge, so that a shared axis lines up.
pub fn layout(charts: &[Chart], size: Size) -> Vec<Frame> {
    let size = size.clamped();
    let weights = charts.iter().map(|chart| weight(chart)).sum::<f64>();
    let decoration = charts.iter().map(|chart| above(chart, size.width) + below(&chart.x)).sum::<f64>();
    let height_per_weight = (size.height - decoration).max(0.0) / weights.max(f64::MIN_POSITIVE);
    let heights =
        charts.iter().map(|chart| above(chart, size.width) + below(&chart.x) + weight(chart) * height_per_weight);
    let tops = heights.clone().scan(0.0, |top, height| Some(std::mem::replace(top, *top + height)));
    let outers: Vec<Rect> =
        tops.zip(heights).map(|(top, height)| Rect { left: 0.0, top, width: size.width, height }).collect();
    let left = charts.iter().zip(&outers).map(|(chart, outer)| beside(chart, outer)).fold(0.0, f64::max);
    charts.iter().zip(outers).map(|(chart, outer)| frame(chart, outer, left)).collect()
}

fn weight(chart: &Chart) -> f64 {
    if chart.weight.is_finite() { chart.weight.clamp(1e-3, 1e3) } else { 1.0 }
}

fn above(chart: &Chart, width: f64) -> f64 {
    TOP + legend::height(&chart.legend, width)
}

fn below(x: &Axis) -> f64 {
    let numbers = if x.numbered { TICK_GAP + LINE - 2.0 } else { TOP };
    numbers + if x.label.is_empty() { 0.0 } else { LINE }
}

/// Width that the y axis needs to the left of the plot.
fn beside(chart: &Chart, outer: &Rect) -> f64 {
    let rows = ticks_in(outer.height - above(chart, outer.width) - below(&chart.x), TICK_DISTANCE);
    let numbers =
        if chart.y.numbered { widest(&chart.y, rows).max(MIN_CHARACTERS) as f64 * DIGIT + TICK_GAP } else { TOP };
    numbers + if chart.y.label.is_empty() { 0.0 } else { LINE }
}

fn frame(chart: &Chart, outer: Rect, left: f64) -> Frame {
    let width = (outer.width - left - RIGHT).max(1.0);
    let height = (outer.height - above(chart, outer.width) - below(&chart.x)).max(1.0);
    let side = width.min(height);
    let (width, height, indent) = if chart.square { (side, side, (width - side) / 2.0) } else { (width, height, 0.0) };
    let plot = Rect {
        left: (outer.left + left + indent).round(),
        top: (outer.top + above(chart, outer.width)).round(),
        width: width.floor().max(1.0),
        height: height.floor().max(1.0),
    };
    let outer = Rect { left: outer.left + indent, width: outer.width - indent, ..outer };
    let (x_scale, y_scale) = (chart.x.scale, chart.y.scale);
    Frame { outer, plot, x: chart.x.span(), y: chart.y.span(), x_scale, y_scale }
}
