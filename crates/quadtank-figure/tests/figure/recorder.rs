//! A backend that remembers what it was asked to draw.

use std::cell::RefCell;
use std::convert::Infallible;
use std::rc::Rc;

use plotters::coord::Shift;
use plotters::prelude::DrawingArea;
use plotters_backend::{BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind};
use quadtank_figure::{Chart, Rgb, Sheet, Size, Style, paint};

/// A thing that was drawn, in CSS px.
#[derive(Clone, Debug, PartialEq)]
pub enum Drawn {
    Path { points: Vec<(f64, f64)>, color: Rgb, width: f64 },
    Polygon { points: Vec<(f64, f64)>, color: Rgb },
    Block { corners: [(f64, f64); 2], color: Rgb },
    Circle { center: (f64, f64), color: Rgb },
    Text { text: String, at: (f64, f64) },
}

/// The calls of a painting, in order.
pub fn record(charts: &[Chart], size: Size, style: &Style) -> Vec<Drawn> {
    record_sheet(charts, size, style, Sheet::Both)
}

/// The calls of painting one sheet, in order.
pub fn record_sheet(charts: &[Chart], size: Size, style: &Style, sheet: Sheet) -> Vec<Drawn> {
    let clamped = size.clamped();
    let scale = style.scale;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a clamped size is small")]
    let fine = |length: f64| (length * f64::from(scale)) as u32;
    let recorder = Recorder { size: (fine(clamped.width), fine(clamped.height)), scale, drawn: Vec::new() };
    let backend = Rc::new(RefCell::new(recorder));
    let area = DrawingArea::<Recorder, Shift>::from(&backend);
    paint(&area, charts, size, style, sheet).expect("the recorder never fails");
    backend.take().drawn
}

#[derive(Default)]
struct Recorder {
    size: (u32, u32),
    scale: u32,
    drawn: Vec<Drawn>,
}

impl Recorder {
    fn css(&self, (x, y): BackendCoord) -> (f64, f64) {
        (f64::from(x) / f64::from(self.scale), f64::from(y) / f64::from(self.scale))
    }

    fn all(&self, points: impl IntoIterator<Item = BackendCoord>) -> Vec<(f64, f64)> {
        points.into_iter().map(|point| self.css(point)).collect()
    }
}

fn rgb(color: BackendColor) -> Rgb {
    Rgb(color.rgb.0, color.rgb.1, color.rgb.2)
}

type Done = Result<(), DrawingErrorKind<Infallible>>;

impl DrawingBackend for Recorder {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        self.size
    }

    fn ensure_prepared(&mut self) -> Done {
        Ok(())
    }

    fn present(&mut self) -> Done {
        Ok(())
    }

    fn draw_pixel(&mut self, _: BackendCoord, _: BackendColor) -> Done {
        panic!("no shape may be drawn by pixels");
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Done {
        let points = self.all(path);
        let width = f64::from(style.stroke_width()) / f64::from(self.scale);
        self.drawn.push(Drawn::Path { points, color: rgb(style.color()), width });
        Ok(())
    }

    fn draw_rect<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S, fill: bool) -> Done {
        assert!(fill, "nothing is framed by a rectangle");
        self.drawn.push(Drawn::Block { corners: [self.css(from), self.css(to)], color: rgb(style.color()) });
        Ok(())
    }

    fn draw_circle<S: BackendStyle>(&mut self, center: BackendCoord, _: u32, style: &S, _: bool) -> Done {
        self.drawn.push(Drawn::Circle { center: self.css(center), color: rgb(style.color()) });
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, outline: I, style: &S) -> Done {
        let points = self.all(outline);
        self.drawn.push(Drawn::Polygon { points, color: rgb(style.color()) });
        Ok(())
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, _: &S, at: BackendCoord) -> Done {
        self.drawn.push(Drawn::Text { text: text.into(), at: self.css(at) });
        Ok(())
    }

    fn estimate_text_size<S: BackendTextStyle>(
        &self,
        _: &str,
        _: &S,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        panic!("no text may be measured: in a browser that costs a layout");
    }
}
