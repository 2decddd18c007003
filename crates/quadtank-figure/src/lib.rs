//! Charts as data, and how to paint them on any plotters backend.
//!
//! A picture is made in three steps that know little of each other:
//!
//! 1. A builder ([`valve_plane`], [`pole_zero`], [`responses`], [`critical_curve`],
//!    [`model_free_course`] …) turns numbers and words into [`Chart`]s: axes and
//!    layers, in the units of the axes. The words come from the caller; this room knows no language.
//! 2. [`layout`] says where on the page each chart stands. Its [`Frame`]s map data to CSS pixels and back; the painter
//!    uses them, and so does the app for cursors and handles.
//! 3. [`paint`] draws on any plotters [`DrawingBackend`](plotters::prelude::DrawingBackend): the canvas on screen, the
//!    recorder of the tests, or the SVG backend behind [`to_svg`].
//!
//! Plotters gives the backends and the shapes. Its own chart type is not used: it measures every label, which in a
//! browser costs a layout each; it moves points outside the plot to the edge, which bends a curve that leaves it; and
//! it draws every point of a series.

mod axis;
mod cells;
mod chart;
mod dashes;
mod ends;
mod field;
mod flag;
mod frame;
mod frequency;
mod judged;
mod legend;
mod level_loop;
mod levels;
mod marks;
mod measure;
mod model_free;
mod names;
mod number;
mod paint;
mod palette;
mod paper;
mod pole_zero;
mod range;
mod residuals;
mod responses;
mod scale;
mod steady;
mod svg;
mod table;
mod trace;
mod tuning;
mod valve_plane;

pub use axis::{Axis, Tick};
pub use chart::{
    Anchor, Cell, Cells, Chart, Course, Entry, Field, Label, Layer, Marker, Name, Names, Pen, Role, Sample, Series,
    Shape,
};
pub use flag::Flag;
pub use frame::{Frame, Rect, Size, layout};
pub use frequency::{ClosedLoopGains, FrequencyCharts, FrequencyTexts, over_frequency};
pub use judged::JudgedStep;
pub use level_loop::{
    CostCell, CostMapChart, LevelLoopCharts, LevelLoopTexts, LevelRunColumns, NamedPoint, StaticCurve, StepTestCharts,
    StepTestTexts, TradeOffChart, cost_map, level_loop, static_curve, step_test, trade_off,
};
pub use levels::{Levels, levels};
pub use model_free::{ModelFreeCourse, ModelFreeTexts, model_free_course};
pub use number::signed;
pub use paint::{FONT_FAMILY, Sheet, Style, paint};
pub use palette::{Palette, Rgb};
pub use paper::PaintError;
pub use pole_zero::{PoleZero, PoleZeroTexts, pole_zero};
pub use residuals::{Residuals, residuals};
pub use responses::{ResponseTexts, Responses, RunColumns, responses};
pub use scale::Scale;
pub use steady::hold_value_axes;
pub use svg::{escape, to_svg};
pub use table::{Summary, Table, table};
pub use tuning::{
    CurveChart, LociChart, LoopsChart, LoopsRecord, RulePoint, characteristic_loci, critical_curve, two_loops,
};
pub use valve_plane::{ValvePlane, ValvePlaneTexts, valve_plane, with_valve_path};
