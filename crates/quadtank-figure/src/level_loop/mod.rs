//! Charts of the bench of level loops: the run, the step test, the trade-off of variances, the map of costs, and static curves.

mod cost_map;
mod run;
mod static_curve;
mod step_test;
mod trade_off;

use std::borrow::Cow;

use super::{Course, Layer, Marker, Name, Pen, Role, Series, Shape};

pub use cost_map::{CostCell, CostMapChart, cost_map};
pub use run::{LevelLoopCharts, LevelLoopTexts, LevelRunColumns, level_loop};
pub use static_curve::{StaticCurve, static_curve};
pub use step_test::{StepTestCharts, StepTestTexts, step_test};
pub use trade_off::{TradeOffChart, trade_off};

/// A point with its name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NamedPoint<'a> {
    /// Its name; may be empty.
    pub name: &'a str,
    /// Where, in the units of the axes.
    pub at: (f64, f64),
    /// What it stands for.
    pub role: Role,
    /// Its mark.
    pub shape: Shape,
}

/// The marks of points: arrows at the edge for those outside.
fn marks<'a>(points: &[NamedPoint]) -> impl Iterator<Item = Layer<'a>> {
    points.iter().map(|point| mark(point.at, point.shape, point.role))
}

/// The words of points. They may lie on any shade, so they have the colour of text.
fn words(points: &[NamedPoint]) -> impl Iterator<Item = Name> {
    points.iter().map(|point| Name { at: point.at, text: point.name.to_owned(), role: Role::Neutral, bold: false })
}

fn mark<'a>(at: (f64, f64), shape: Shape, role: Role) -> Layer<'a> {
    Layer::Marker(Marker { at, shape, role, points_beyond: true })
}

/// A straight curve in the units of its axes.
fn curve<'a>(
    name: &'a str,
    role: Role,
    pen: Pen,
    x: impl Into<Cow<'a, [f64]>>,
    y: impl Into<Cow<'a, [f64]>>,
) -> Layer<'a> {
    let course = Course::Straight;
    Layer::Line(Series { name: name.into(), role, pen, course, x: x.into(), y: y.into(), y_scale: 1.0 })
}

/// Widens the range of a logarithmic axis at both ends by a share of its decades, `least` decades at least.
fn with_room((low, high): (f64, f64), share: f64, least: f64) -> (f64, f64) {
    let room = 10f64.powf((share * (high / low).log10()).max(least));
    (low / room, high * room)
}

/// Points between two corners of a curve that words keep off.
const BETWEEN: u32 = 4;

/// The corners of a curve and points between them, as it is drawn on logarithmic axes.
fn between(corners: &[(f64, f64)]) -> impl Iterator<Item = (f64, f64)> {
    corners.windows(2).flat_map(|pair| {
        let (a, b) = (pair[0], pair[1]);
        (0..=BETWEEN).map(move |k| {
            let share = f64::from(k) / f64::from(BETWEEN);
            (a.0 * (b.0 / a.0).powf(share), a.1 * (b.1 / a.1).powf(share))
        })
    })
}
