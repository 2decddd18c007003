use plotters::coord::Shift;
use plotters::prelude::{DrawingArea, DrawingBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontDesc, FontFamily, FontStyle, FontTransform, RGBAColor, ShapeStyle, TextStyle};

use super::dashes::dashes;
use super::frame::tick_counts;
use super::legend::{self, SAMPLE};
use super::measure::{BOLD, CHARACTER, FONT, LINE, TICK_GAP};
use super::paper::{Fine, PaintError, Paper, Surface};
use super::trace::{self, Px};
use super::{
    Anchor, Axis, Chart, Frame, Label, Layer, Name, Names, Palette, Pen, Rect, Rgb, Sample, Size, cells, ends, field,
    layout, names,
};

/// Fonts of the charts, as a CSS family list: those of the page, nothing to load.
pub const FONT_FAMILY: &str = "system-ui, -apple-system, Segoe UI, Roboto, DejaVu Sans, sans-serif";

/// How charts look, apart from what they show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Colours.
    pub palette: Palette,
    /// Decimal separator of the reader's language.
    pub decimal: char,
    /// Backend pixels per CSS px. Backends of plotters take whole pixels only; curves are smooth with 8.
    pub scale: u32,
}

/// Which part of charts is painted: all of it, or one of two sheets that lie upon each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sheet {
    /// All of it.
    Both,
    /// What stays while curves move ([`Chart::ground`]).
    Ground,
    /// The rest, which lies upon it.
    Curves,
}

impl Sheet {
    fn has(self, is_ground: bool) -> bool {
        match self {
            Self::Both => true,
            Self::Ground => is_ground,
            Self::Curves => !is_ground,
        }
    }
}

/// A part of a chart, as announced while painting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Part<'a> {
    /// Shades under the grid, or lines and marks on it.
    Layer(&'a Layer<'a>),
    /// Grid, edge, numbers and labels.
    Axes,
    /// Legend.
    Legend,
}

/// Paints charts on top of each other onto `area`, which stands for a figure of `size` in CSS px and has
/// `style.scale` pixels for each of them. The background is left as it is. The frames are those of [`layout`].
///
/// # Errors
/// The first that the backend reports.
pub fn paint<DB: DrawingBackend>(
    area: &DrawingArea<DB, Shift>,
    charts: &[Chart],
    size: Size,
    style: &Style,
    sheet: Sheet,
) -> Result<(), PaintError<DB>> {
    paint_parts(area, charts, size, style, sheet, &mut |_| ())
}

/// As [`paint`], and announces every part before it is painted.
pub(super) fn paint_parts<DB: DrawingBackend>(
    area: &DrawingArea<DB, Shift>,
    charts: &[Chart],
    size: Size,
    style: &Style,
    sheet: Sheet,
    announce: &mut dyn FnMut(Part),
) -> Result<(), PaintError<DB>> {
    let surface = Surface::of(area);
    for (chart, frame) in charts.iter().zip(layout(charts, size)) {
        let has_cells = chart.layers.iter().any(|layer| matches!(layer, Layer::Cells(_)));
        Brush { paper: &surface, style, frame, has_cells }.chart(chart, sheet, announce);
    }
    surface.outcome()
}

/// Width of a line (CSS px).
fn width(pen: Pen) -> f64 {
    match pen {
        Pen::Solid => 2.0,
        Pen::Broad => 4.5,
        Pen::Dotted => 1.8,
        Pen::Dashed | Pen::Faded | Pen::Pinned(_) => 1.3,
        Pen::Hair => 1.0,
        Pen::Trail => 5.0,
    }
}

/// Width of a line that turns so often that a wider one would hide its own swings (CSS px). Renderers have a quicker way for one
/// pixel, too: 2000 s with moving valves are painted in half the time.
const FINE_WIDTH: f64 = 1.0;
/// Corners for each px of the plot from which on a line is that fine.
const DENSE: f64 = 0.8;
/// Most of the height of a plot that words at flags may pile up to.
const WORDS_SHARE: f64 = 0.4;

/// Paints the things of one chart, given in CSS px.
pub(super) struct Brush<'a> {
    pub(super) paper: &'a dyn Paper,
    pub(super) style: &'a Style,
    pub(super) frame: Frame,
    /// Whether marks stand on discs of background, since they may lie on any shade.
    pub(super) has_cells: bool,
}

impl Brush<'_> {
    fn chart(&self, chart: &Chart, sheet: Sheet, announce: &mut dyn FnMut(Part)) {
        let (shades, rest): (Vec<&Layer>, Vec<&Layer>) =
            chart.layers.iter().filter(|layer| sheet.has(layer.is_ground())).partition(|layer| layer.is_shade());
        for layer in shades {
            announce(Part::Layer(layer));
            self.layer(layer);
        }
        if sheet.has(true) {
            announce(Part::Axes);
            self.axes(chart);
        }
        for layer in rest {
            announce(Part::Layer(layer));
            self.layer(layer);
        }
        if sheet.has(true) && !chart.legend.is_empty() {
            announce(Part::Legend);
            self.legend(chart);
        }
    }

    fn layer(&self, layer: &Layer) {
        let (palette, plot) = (&self.style.palette, &self.frame.plot);
        match layer {
            Layer::Field(field) => {
                for patch in field::patches(field) {
                    let outline: Vec<Px> = patch.outline.iter().map(|&point| self.inside(point)).collect();
                    self.polygon(&outline, palette.shade(patch.shade));
                }
            }
            Layer::Cells(cells) => {
                for cells::Block { cell, from, to } in cells::blocks(cells, &self.frame) {
                    self.paper.block([self.fine(from), self.fine(to)], opaque(palette.cell(cell)));
                }
                for line in cells::hatching(cells, &self.frame) {
                    self.path(&line, palette.hatching(), FINE_WIDTH);
                }
            }
            &Layer::Region { x, y, role } => {
                let ((left, bottom), (right, top)) = (self.inside((x.0, y.0)), self.inside((x.1, y.1)));
                let corners = [(left, top), (right, top), (right, bottom), (left, bottom)];
                self.polygon(&corners, palette.region(role));
            }
            Layer::Line(series) => {
                for run in trace::polylines(series, &self.frame) {
                    self.line(&run, palette.line(series.role, series.pen), series.pen);
                }
            }
            &Layer::Upright { x, role, pen } => {
                let x = self.frame.x_px(x);
                self.straight((x, plot.bottom()), (x, plot.top), palette.line(role, pen), pen);
            }
            &Layer::Level { y, role, pen } => {
                let y = self.frame.y_px(y);
                self.straight((plot.left, y), (plot.right(), y), palette.line(role, pen), pen);
            }
            Layer::Marker(marker) => self.marker(marker),
            Layer::Label(label) => self.label(label),
            Layer::Names(names) => self.names(names),
            Layer::Ends(names) => self.ends(names),
        }
    }

    /// A line across the plot, if it is in it.
    fn straight(&self, from: Px, to: Px, color: Rgb, pen: Pen) {
        let finite = [from.0, from.1, to.0, to.1].into_iter().all(f64::is_finite);
        if let Some((from, to)) = trace::clipped(&self.frame.plot, from, to).filter(|_| finite) {
            self.line(&[from, to], color, pen);
        }
    }

    fn line(&self, run: &[Px], color: Rgb, pen: Pen) {
        let is_dense = run.len() as f64 > DENSE * self.frame.plot.width;
        let width = if is_dense { FINE_WIDTH } else { width(pen) };
        match pen.dash() {
            None => self.path(run, color, width),
            Some((on, off)) => {
                for dash in dashes(run, on, off) {
                    self.path(&dash, color, width);
                }
            }
        }
    }

    /// Pixel of a point of the data, or of the nearest point of the plot.
    pub(super) fn inside(&self, point: (f64, f64)) -> Px {
        let (x, y) = self.frame.to_px(point);
        let plot = &self.frame.plot;
        let within = |v: f64, low: f64, high: f64| if v.is_nan() { low } else { v.clamp(low, high) };
        (within(x, plot.left, plot.right()), within(y, plot.top, plot.bottom()))
    }

    fn label(&self, label: &Label) {
        let (x, y) = self.inside(label.at);
        let length = label.text.chars().count() as f64 * if label.bold { BOLD } else { CHARACTER };
        let (h_pos, behind, ahead) = match label.anchor {
            Anchor::Left => (HPos::Left, 0.0, length),
            Anchor::Middle => (HPos::Center, length / 2.0, length / 2.0),
            Anchor::Right => (HPos::Right, length, 0.0),
        };
        let plot = &self.frame.plot;
        let x = (x + label.offset.0).min(plot.right() - 2.0 - ahead).max(plot.left + 2.0 + behind);
        let font = if label.bold { FontStyle::Bold } else { FontStyle::Normal };
        let half = LINE / 2.0;
        if label.on_ground {
            // Words of several flags stand above each other; in a low plot the upper ones would cover the curves.
            if half - label.offset.1 > WORDS_SHARE * plot.height {
                return;
            }
        }
        // Not `clamp`, which panics where the plot is lower than a line.
        let inside = |at: f64| at.min(plot.bottom() - half).max(plot.top + half);
        let own_side = y + label.offset.1;
        let other_side = y - label.offset.1;
        let has_room = label.opposite.is_some_and(|opposite| {
            let distance = (self.inside((label.at.0, opposite)).1 - y).abs();
            distance >= 2.0 * label.offset.1.abs() + LINE && inside(other_side) == other_side
        });
        let y = if inside(own_side) != own_side && has_room { other_side } else { inside(own_side) };
        if label.on_ground {
            self.ground([(x - behind - 1.0, y - half), (x + ahead + 1.0, y + half)]);
        }
        let text = Text { words: &label.text, color: self.style.palette.color(label.role), font, h_pos, turned: false };
        self.text(&text, (x, y));
    }

    /// A piece of the background, for words to stand on.
    fn ground(&self, corners: [Px; 2]) {
        self.paper.block(corners.map(|corner| self.fine(corner)), opaque(self.style.palette.background));
    }

    fn names(&self, names: &Names) {
        let placed = names::placed(names, &self.frame);
        let color = |index: usize| self.style.palette.color(names.names[index].role);
        for (index, leader) in placed.iter().filter_map(|placed| Some((placed.index, placed.leader?))) {
            self.path(&leader, color(index), width(Pen::Hair));
        }
        for names::Placed { index, place, h_pos, .. } in placed {
            if names.on_ground {
                self.ground([(place.left, place.top), (place.right(), place.bottom())]);
            }
            let x = match h_pos {
                HPos::Left => place.left,
                HPos::Center => place.left + place.width / 2.0,
                HPos::Right => place.right(),
            };
            self.name(&names.names[index], h_pos, (x, place.top + place.height / 2.0));
        }
    }

    fn ends(&self, names: &[Name]) {
        let plot = &self.frame.plot;
        let heights: Vec<f64> = names.iter().map(|name| self.inside(name.at).1).collect();
        for (name, height) in names.iter().zip(ends::apart(&heights, (plot.top, plot.bottom()))) {
            self.name(name, HPos::Left, (plot.right() + TICK_GAP - 2.0, height));
        }
    }

    fn name(&self, name: &Name, h_pos: HPos, at: Px) {
        let font = if name.bold { FontStyle::Bold } else { FontStyle::Normal };
        let color = self.style.palette.color(name.role);
        self.text(&Text { words: &name.text, color, font, h_pos, turned: false }, at);
    }

    fn axes(&self, chart: &Chart) {
        let Palette { grid, edge, .. } = self.style.palette;
        let plot = &self.frame.plot;
        let (columns, rows) = tick_counts(chart, &self.frame);
        let (uprights, levels) = (chart.x.ticks(columns), chart.y.ticks(rows));
        for tick in &uprights {
            let x = snapped(self.frame.x_px(tick.value), plot.left, plot.right());
            self.path(&[(x, plot.top), (x, plot.bottom())], grid, 1.0);
        }
        for tick in &levels {
            let y = snapped(self.frame.y_px(tick.value), plot.top, plot.bottom());
            self.path(&[(plot.left, y), (plot.right(), y)], grid, 1.0);
        }
        self.edge(plot, edge);
        if chart.x.numbered {
            for tick in &uprights {
                let below = (self.frame.x_px(tick.value), plot.bottom() + TICK_GAP + LINE / 2.0 - 2.0);
                self.note(&tick.text(self.style.decimal), HPos::Center, below);
            }
        }
        if chart.y.numbered {
            for tick in &levels {
                let beside = (plot.left - TICK_GAP, self.frame.y_px(tick.value));
                self.note(&tick.text(self.style.decimal), HPos::Right, beside);
            }
        }
        self.axis_labels(&chart.x, &chart.y);
    }

    fn axis_labels(&self, x: &Axis, y: &Axis) {
        let Frame { outer, plot, .. } = &self.frame;
        let below = plot.bottom() + LINE / 2.0 + if x.numbered { TICK_GAP + LINE - 3.0 } else { 4.0 };
        self.note(&x.label, HPos::Center, (plot.left + plot.width / 2.0, below));
        let font = FontStyle::Normal;
        let color = self.style.palette.muted;
        let text = Text { words: &y.label, color, font, h_pos: HPos::Center, turned: true };
        self.text(&text, (outer.left + LINE / 2.0, plot.top + plot.height / 2.0));
    }

    /// The edge of the plot, just inside it.
    fn edge(&self, plot: &Rect, color: Rgb) {
        let (left, right, top, bottom) = (plot.left + 0.5, plot.right() - 0.5, plot.top + 0.5, plot.bottom() - 0.5);
        let corners = [(left, top), (right, top), (right, bottom), (left, bottom), (left, top)];
        self.path(&corners, color, 1.0);
    }

    fn legend(&self, chart: &Chart) {
        let Frame { outer, plot, .. } = &self.frame;
        let palette = &self.style.palette;
        for (entry, (left, row)) in chart.legend.iter().zip(legend::places(&chart.legend, outer.right())) {
            let (x, y) = (plot.left + left, outer.top + (row + 0.5) * LINE + 2.0);
            match entry.sample {
                Sample::Line(pen) => self.line(&[(x, y), (x + SAMPLE - 5.0, y)], palette.line(entry.role, pen), pen),
                Sample::Mark(shape) => self.mark(shape, (x + SAMPLE / 2.0, y), palette.color(entry.role)),
            }
            self.note(&entry.text, HPos::Left, (x + SAMPLE, y));
        }
    }

    /// Small print.
    fn note(&self, text: &str, h_pos: HPos, at: Px) {
        let color = self.style.palette.muted;
        self.text(&Text { words: text, color, font: FontStyle::Normal, h_pos, turned: false }, at);
    }

    fn text(&self, text: &Text, at: Px) {
        if text.words.is_empty() {
            return;
        }
        let turn = if text.turned { FontTransform::Rotate270 } else { FontTransform::None };
        let size = FONT * f64::from(self.style.scale);
        let font = FontDesc::new(FontFamily::Name(FONT_FAMILY), size, text.font).transform(turn);
        let color = opaque(text.color);
        let style = TextStyle::from(font).color(&color).pos(Pos::new(text.h_pos, VPos::Center));
        self.paper.text(text.words, &style, self.fine(at));
    }

    pub(super) fn path(&self, points: &[Px], color: Rgb, width: f64) {
        let points: Vec<_> = points.iter().map(|&point| self.fine(point)).collect();
        self.paper.path(points, self.stroke(color, width));
    }

    pub(super) fn polygon(&self, points: &[Px], color: Rgb) {
        let points: Vec<_> = points.iter().map(|&point| self.fine(point)).collect();
        self.paper.polygon(points, opaque(color));
    }

    pub(super) fn circle(&self, center: Px, radius: f64, color: Rgb, width: f64) {
        self.paper.circle(self.fine(center), self.length(radius), self.stroke(color, width));
    }

    pub(super) fn disc(&self, center: Px, radius: f64, color: Rgb) {
        let filled = ShapeStyle::from(opaque(color)).filled();
        self.paper.circle(self.fine(center), self.length(radius), filled);
    }

    fn stroke(&self, color: Rgb, width: f64) -> ShapeStyle {
        ShapeStyle { color: opaque(color), filled: false, stroke_width: self.length(width) }
    }

    /// Pixel of the backend.
    #[expect(clippy::cast_possible_truncation, reason = "the size of a figure is clamped far below i32")]
    fn fine(&self, (x, y): Px) -> Fine {
        let scale = f64::from(self.style.scale);
        ((x * scale).round() as i32, (y * scale).round() as i32)
    }

    /// Length in pixels of the backend.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "lengths are small and positive")]
    fn length(&self, length: f64) -> u32 {
        (length * f64::from(self.style.scale)).round().max(1.0) as u32
    }
}

/// A line of text, centred upwards on its point.
struct Text<'a> {
    words: &'a str,
    color: Rgb,
    font: FontStyle,
    h_pos: HPos,
    turned: bool,
}

/// The middle of the pixel in which a thin line is sharp.
fn snapped(at: f64, low: f64, high: f64) -> f64 {
    (at.floor() + 0.5).min(high - 0.5).max(low)
}

fn opaque(Rgb(red, green, blue): Rgb) -> RGBAColor {
    RGBAColor(red, green, blue, 1.0)
}
