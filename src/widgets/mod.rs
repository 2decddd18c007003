//! Parts that every bench is made of. None of them knows what it shows.

mod card;
mod chart;
mod data_table;
mod drawer;
mod element_size;
mod field;
mod handle;
mod marked;
mod pins;
mod point;
mod point_button;
mod read_on;
mod readout;
mod segmented;
mod select;
mod table;
mod terms;
mod text_field;
mod tick;
mod time_bar;
mod time_surface;
mod touch_gesture;

pub use card::{Card, Sentence, Verdict};
pub use chart::{ChartCanvas, ChartMenu, Picture};
pub use data_table::DataTable;
pub use drawer::Drawer;
pub use field::{NumberField, Scale, SliderField};
pub use handle::{Drag, Handle, Nudge};
pub use marked::{marked, unmarked};
pub use pins::Pins;
pub use point::{PointHandle, first_frame};
pub use point_button::PointButton;
pub use read_on::{MODEL, ReadOn};
pub use readout::Readout;
pub use segmented::Segmented;
pub use select::{Choice, Select};
pub use table::{
    Caption, Cells, Figure, FigureCells, Figures, Folded, Headings, ReasonedRow, Row, TableContent, is_open,
};
pub use terms::{Terms, Text};
pub use text_field::{TextField, limited};
pub use tick::Tick;
pub use time_bar::{Playback, TimeBar, prefers_less_motion, shown_times};
pub use time_surface::{TimeAxis, TimeSurface, ZoomButtons};
