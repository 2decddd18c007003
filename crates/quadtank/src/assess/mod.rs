//! How well a running loop does: variance indices, the Harris index of routine data, margins of its linear loop, valve travel.

mod harris;
mod loop_quality;
mod travel;
mod variance;

pub use harris::{HarrisError, HarrisIndex, harris_index};
pub use loop_quality::LoopQuality;
pub use travel::ValveTravel;
pub use variance::{BothIndices, IndexError, IndexVerdict, VarianceIndex};
