//! Charts as data, and how to paint them on any plotters backend.

mod axis;
mod chart;
mod frame;

pub use axis::{Axis, Tick};
pub use chart::{Anchor, Chart, Course, Entry, Field, Label, Layer, Marker, Pen, Role, Sample, Series, Shape};
pub use frame::{Frame, Rect, Size, layout};
