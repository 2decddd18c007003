//! Parts that every bench is made of. None of them knows what it shows.

mod chart;
mod element_size;
mod field;
mod handle;
mod rich;
mod segmented;

pub use chart::{ChartCanvas, ChartMenu, Picture};
pub use field::{NumberField, Scale, SliderField};
pub use handle::{Drag, Handle, Nudge};
pub use rich::rich;
pub use segmented::Segmented;
