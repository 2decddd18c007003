//! Parts that every bench is made of. None of them knows what it shows.

mod card;
mod chart;
mod choice;
mod data_table;
mod element_size;
mod field;
mod folded;
mod handle;
mod handler;
pub mod html;
mod player;
mod point;
mod segmented;
mod tick;
mod time_surface;

pub use card::{card, figures, remark, sentence, verdict};
pub use chart::{ChartCanvas, ChartMenu, Picture};
pub use choice::Choice;
pub use data_table::DataTable;
pub use field::{NumberField, Scale, SliderField};
pub use folded::folded;
pub use handle::{Drag, Handle, Nudge};
pub use handler::{effect, handler};
pub use player::Player;
pub use point::{PointHandle, first_frame};
pub use segmented::Segmented;
pub use tick::tick;
pub use time_surface::{TimeAxis, TimeSurface, ZoomButtons};
