//! Plotters on a canvas of the page, sharp at any pixel ratio and silent under a strict content security policy.

use leptos::prelude::document;
use leptos::wasm_bindgen::JsCast;
use plotters::drawing::IntoDrawingArea;
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind, FontTransform,
};
use plotters_canvas::CanvasBackend;
use web_sys::{CanvasRenderingContext2d, HtmlCanvasElement};

use crate::figure::{self, Chart, Size, Style};

/// Pixels of the backend for each CSS px: plotters counts in whole ones, and curves are smooth with this many.
pub const FINE: u32 = 8;

type CanvasError = <CanvasBackend as DrawingBackend>::ErrorType;
type Outcome<T = ()> = Result<T, DrawingErrorKind<CanvasError>>;

/// The canvas backend of plotters with two changes: its pixels are finer than those of the screen, because plotters
/// counts in whole ones, and text is measured by the canvas, because the original measures it by adding a styled element
/// to the page, which costs a layout and which the content security policy forbids.
struct FineCanvas {
    inner: CanvasBackend,
    context: CanvasRenderingContext2d,
    size: (u32, u32),
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
        self.inner.present()
    }

    fn draw_pixel(&mut self, point: BackendCoord, color: BackendColor) -> Outcome {
        self.inner.draw_pixel(point, color)
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Outcome {
        self.inner.draw_line(from, to, style)
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        upper_left: BackendCoord,
        bottom_right: BackendCoord,
        style: &S,
        fill: bool,
    ) -> Outcome {
        self.inner.draw_rect(upper_left, bottom_right, style, fill)
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Outcome {
        self.inner.draw_path(path, style)
    }

    fn draw_circle<S: BackendStyle>(&mut self, center: BackendCoord, radius: u32, style: &S, fill: bool) -> Outcome {
        self.inner.draw_circle(center, radius, style, fill)
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Outcome {
        self.inner.fill_polygon(path, style)
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, at: BackendCoord) -> Outcome {
        self.inner.draw_text(text, style, at)
    }

    fn estimate_text_size<S: BackendTextStyle>(&self, text: &str, style: &S) -> Outcome<(u32, u32)> {
        let font = format!("{} {}px {}", style.style().as_str(), style.size(), style.family().as_str());
        self.context.set_font(&font);
        let width = self.context.measure_text(text).map_or(0.0, |m| m.width());
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

/// Paints charts on a canvas of `size` CSS px on a screen with `ratio` pixels for each of them. A canvas that the browser
/// cannot paint on stays empty.
pub fn paint(canvas: &HtmlCanvasElement, charts: &[Chart], size: Size, ratio: f64, style: &Style) {
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
    let backend = FineCanvas { inner, context, size: (pixels(size.width, fine), pixels(size.height, fine)) };
    // Fails only if the canvas does, and then there is nowhere to say so.
    let _ = figure::paint(&backend.into_drawing_area(), charts, size, style);
}

fn context_of(canvas: &HtmlCanvasElement) -> Option<CanvasRenderingContext2d> {
    canvas.get_context("2d").ok()??.dyn_into().ok()
}
