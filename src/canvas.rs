//! Plotters on a canvas of the page, sharp at any pixel ratio and silent under a strict content security policy.

use std::f64::consts::TAU;

use leptos::prelude::document;
use leptos::wasm_bindgen::JsCast;
use plotters::drawing::IntoDrawingArea;
use plotters_backend::text_anchor::HPos;
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind, FontTransform,
};
use plotters_canvas::CanvasBackend;
use web_sys::{CanvasRenderingContext2d, HtmlCanvasElement};

use quadtank_figure::{Chart, Sheet, Size, Style};

/// Pixels of the backend for each CSS px: plotters counts in whole ones, and curves are smooth with this many.
pub const FINE: u32 = 8;

type CanvasError = <CanvasBackend as DrawingBackend>::ErrorType;
type Outcome<T = ()> = Result<T, DrawingErrorKind<CanvasError>>;

/// Drawing backend that replaces that of plotters, which is kept only to begin and end a picture. Its pixels are finer
/// than those of the screen, because plotters counts in whole ones. Shapes alike are joined into one path and settings
/// are made once, because a dotted curve is hundreds of strokes and each call out of WebAssembly with a text costs
/// about a microsecond. And text is measured by the canvas, because the original measures it by adding a styled element
/// to the page, which costs a layout and which the content security policy forbids.
struct FineCanvas {
    inner: CanvasBackend,
    context: CanvasRenderingContext2d,
    size: (u32, u32),
    /// Colour of the path that is not painted yet, and its width; without one it is filled.
    pen: Option<(Ink, Option<u32>)>,
    /// What the context has, where this is known.
    stroke: Option<Ink>,
    fill: Option<Ink>,
    font: String,
    align: &'static str,
}

/// A colour that can be compared; what plotters paints here is opaque.
type Ink = (u8, u8, u8);

impl FineCanvas {
    /// Selects the pen of the following shapes; a pending path in another pen is painted first.
    fn take_pen(&mut self, color: BackendColor, width: Option<u32>) {
        let pen = (color.rgb, width);
        if self.pen != Some(pen) {
            self.end_path();
            self.context.begin_path();
            self.pen = Some(pen);
        }
    }

    /// Paints what is pending.
    fn end_path(&mut self) {
        match self.pen.take() {
            Some((ink, Some(width))) => {
                if self.stroke.replace(ink) != Some(ink) {
                    self.context.set_stroke_style_str(&css(ink));
                }
                self.context.set_line_width(width.into());
                self.context.stroke();
            }
            Some((ink, None)) => {
                self.set_fill(ink);
                self.context.fill();
            }
            None => (),
        }
    }

    fn set_fill(&mut self, ink: Ink) {
        if self.fill.replace(ink) != Some(ink) {
            self.context.set_fill_style_str(&css(ink));
        }
    }

    fn trace(&self, points: impl IntoIterator<Item = BackendCoord>) {
        for (k, (x, y)) in points.into_iter().enumerate() {
            if k == 0 {
                self.context.move_to(x.into(), y.into());
            } else {
                self.context.line_to(x.into(), y.into());
            }
        }
    }
}

/// The corner of the upright square that stands for a dash no longer than it is wide. Browsers paint hundreds of squares in a fifth of
/// the time that they take for as many short strokes.
fn dot(points: &[BackendCoord], width: u32) -> Option<BackendCoord> {
    let (&(x, y), &(u, v)) = (points.first()?, points.last()?);
    let is_near = |p: &BackendCoord| p.0.abs_diff(x).max(p.1.abs_diff(y)) <= width;
    let half = i32::try_from(width / 2).ok()?;
    points.iter().all(is_near).then(|| (i32::midpoint(x, u) - half, i32::midpoint(y, v) - half))
}

fn css((red, green, blue): Ink) -> String {
    format!("rgb({red} {green} {blue})")
}

fn font_of(style: &impl BackendTextStyle) -> String {
    format!("{} {}px {}", style.style().as_str(), style.size(), style.family().as_str())
}

impl DrawingBackend for FineCanvas {
    type ErrorType = CanvasError;

    fn get_size(&self) -> (u32, u32) {
        self.size
    }

    fn ensure_prepared(&mut self) -> Outcome {
        self.inner.ensure_prepared()
    }

    fn present(&mut self) -> Outcome {
        self.end_path();
        self.inner.present()
    }

    fn draw_pixel(&mut self, point: BackendCoord, color: BackendColor) -> Outcome {
        self.draw_rect(point, (point.0 + 1, point.1 + 1), &color, true)
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Outcome {
        self.draw_path([from, to], style)
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        (left, top): BackendCoord,
        (right, bottom): BackendCoord,
        style: &S,
        fill: bool,
    ) -> Outcome {
        self.take_pen(style.color(), (!fill).then(|| style.stroke_width()));
        self.context.rect(left.into(), top.into(), (right - left).into(), (bottom - top).into());
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Outcome {
        let (points, width) = (path.into_iter().collect::<Vec<_>>(), style.stroke_width());
        if let Some((left, top)) = dot(&points, width) {
            self.take_pen(style.color(), None);
            self.context.rect(left.into(), top.into(), width.into(), width.into());
        } else {
            self.take_pen(style.color(), Some(width));
            self.trace(points);
        }
        Ok(())
    }

    fn draw_circle<S: BackendStyle>(&mut self, (x, y): BackendCoord, radius: u32, style: &S, fill: bool) -> Outcome {
        self.end_path();
        self.take_pen(style.color(), (!fill).then(|| style.stroke_width()));
        // Fails only for a negative radius.
        let _ = self.context.arc(x.into(), y.into(), radius.into(), 0.0, TAU);
        self.end_path();
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Outcome {
        // Alone: two that overlap would leave a hole where they turn in opposite ways.
        self.end_path();
        self.take_pen(style.color(), None);
        self.trace(path);
        self.end_path();
        Ok(())
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, (x, y): BackendCoord) -> Outcome {
        self.end_path();
        let font = font_of(style);
        if font != self.font {
            self.context.set_font(&font);
            self.font = font;
        }
        let align = match style.anchor().h_pos {
            HPos::Left => "start",
            HPos::Center => "center",
            HPos::Right => "end",
        };
        if align != self.align {
            self.context.set_text_align(align);
            self.align = align;
        }
        self.set_fill(style.color().rgb);
        let (x, y) = (f64::from(x), f64::from(y));
        let (cos, sin) = match style.transform() {
            FontTransform::None => (1.0, 0.0),
            FontTransform::Rotate90 => (0.0, 1.0),
            FontTransform::Rotate180 => (-1.0, 0.0),
            FontTransform::Rotate270 => (0.0, -1.0),
        };
        let turned = sin != 0.0 || cos < 0.0;
        let drawn = if turned {
            self.context.save();
            let drawn =
                self.context.transform(cos, sin, -sin, cos, x, y).and_then(|()| self.context.fill_text(text, 0.0, 0.0));
            self.context.restore();
            drawn
        } else {
            self.context.fill_text(text, x, y)
        };
        // Fails only where the browser has no text at all; the picture without is then better than none.
        let _ = drawn;
        Ok(())
    }

    fn estimate_text_size<S: BackendTextStyle>(&self, text: &str, style: &S) -> Outcome<(u32, u32)> {
        self.context.set_font(&font_of(style));
        let measured = self.context.measure_text(text);
        self.context.set_font(&self.font);
        let width = measured.map_or(0.0, |m| m.width());
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a size of text on a screen")]
        let (width, height) = (width.ceil() as u32, (style.size() * 1.2).ceil() as u32);
        Ok(match style.transform() {
            FontTransform::Rotate90 | FontTransform::Rotate270 => (height, width),
            FontTransform::None | FontTransform::Rotate180 => (width, height),
        })
    }
}

/// A canvas that is not on the page, to export from.
pub fn new_canvas() -> Option<HtmlCanvasElement> {
    document().create_element("canvas").ok()?.dyn_into().ok()
}

/// Fills a canvas with the background of the theme; an exported picture has no page behind it.
pub fn fill_background(canvas: &HtmlCanvasElement, style: &Style) {
    let Some(context) = context_of(canvas) else { return };
    let _ = context.reset_transform();
    context.set_global_composite_operation("destination-over").unwrap_or_default();
    let background = style.palette.background;
    context.set_fill_style_str(&format!("rgb({} {} {})", background.0, background.1, background.2));
    context.fill_rect(0.0, 0.0, canvas.width().into(), canvas.height().into());
}

/// Paints a sheet of charts on a canvas of `size` CSS px on a screen with `ratio` pixels for each of them. A canvas that the browser
/// cannot paint on stays empty.
pub fn paint(canvas: &HtmlCanvasElement, charts: &[Chart], size: Size, ratio: f64, style: &Style, sheet: Sheet) {
    let Some(context) = context_of(canvas) else { return };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a size on a screen")]
    let pixels = |length: f64, ratio: f64| (length * ratio).round() as u32;
    let device = (pixels(size.width, ratio), pixels(size.height, ratio));
    if (canvas.width(), canvas.height()) != device {
        canvas.set_width(device.0);
        canvas.set_height(device.1);
    }
    let fine = f64::from(style.scale);
    if context.set_transform(ratio / fine, 0.0, 0.0, ratio / fine, 0.0, 0.0).is_err() {
        return;
    }
    context.clear_rect(0.0, 0.0, size.width * fine, size.height * fine);
    let Some(inner) = CanvasBackend::with_canvas_object(canvas.clone()) else { return };
    // Every text of the charts is centred on its line.
    context.set_text_baseline("middle");
    let backend = FineCanvas {
        inner,
        context,
        size: (pixels(size.width, fine), pixels(size.height, fine)),
        pen: None,
        stroke: None,
        fill: None,
        font: String::new(),
        align: "",
    };
    let area = backend.into_drawing_area();
    // Fails only if the canvas does, and then there is nowhere to say so.
    let _ = quadtank_figure::paint(&area, charts, size, style, sheet).and_then(|()| area.present());
}

fn context_of(canvas: &HtmlCanvasElement) -> Option<CanvasRenderingContext2d> {
    canvas.get_context("2d").ok()??.dyn_into().ok()
}
