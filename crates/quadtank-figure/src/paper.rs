//! Between the brush, which is compiled once, and whatever backend there is.

use std::cell::RefCell;

use plotters::coord::Shift;
use plotters::drawing::DrawingAreaErrorKind;
use plotters::element::{Circle, PathElement, Polygon, Rectangle};
use plotters::prelude::{DrawingArea, DrawingBackend};
use plotters::style::{RGBAColor, ShapeStyle, TextStyle};

/// What can go wrong while painting: only what the backend reports.
pub type PaintError<DB> = DrawingAreaErrorKind<<DB as DrawingBackend>::ErrorType>;

/// What a brush paints on. Behind it is any backend, so that the brush is compiled once and not for each of them.
pub(super) trait Paper {
    fn path(&self, points: Vec<Fine>, style: ShapeStyle);
    fn polygon(&self, points: Vec<Fine>, color: RGBAColor);
    fn block(&self, corners: [Fine; 2], color: RGBAColor);
    fn circle(&self, center: Fine, radius: u32, style: ShapeStyle);
    fn text(&self, words: &str, style: &TextStyle, at: Fine);
}

/// A pixel of the backend.
pub(super) type Fine = (i32, i32);

/// The area of a backend, and what went wrong on it first.
pub(super) struct Surface<'a, DB: DrawingBackend> {
    area: &'a DrawingArea<DB, Shift>,
    outcome: RefCell<Result<(), PaintError<DB>>>,
}

impl<'a, DB: DrawingBackend> Surface<'a, DB> {
    pub(super) fn of(area: &'a DrawingArea<DB, Shift>) -> Self {
        Self { area, outcome: RefCell::new(Ok(())) }
    }

    pub(super) fn outcome(self) -> Result<(), PaintError<DB>> {
        self.outcome.into_inner()
    }

    fn keep(&self, drawn: Result<(), PaintError<DB>>) {
        let mut outcome = self.outcome.borrow_mut();
        if outcome.is_ok() {
            *outcome = drawn;
        }
    }
}

impl<DB: DrawingBackend> Paper for Surface<'_, DB> {
    fn path(&self, points: Vec<Fine>, style: ShapeStyle) {
        self.keep(self.area.draw(&PathElement::new(points, style)));
    }

    fn polygon(&self, points: Vec<Fine>, color: RGBAColor) {
        self.keep(self.area.draw(&Polygon::new(points, color)));
    }

    fn block(&self, corners: [Fine; 2], color: RGBAColor) {
        self.keep(self.area.draw(&Rectangle::new(corners, ShapeStyle::from(color).filled())));
    }

    fn circle(&self, center: Fine, radius: u32, style: ShapeStyle) {
        self.keep(self.area.draw(&Circle::new(center, radius, style)));
    }

    fn text(&self, words: &str, style: &TextStyle, at: Fine) {
        self.keep(self.area.draw_text(words, style, at));
    }
}
