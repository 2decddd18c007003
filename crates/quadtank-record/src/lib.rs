//! Records of a rig of one's own: [tables](Table) of measurements as laboratories write them, the [meaning](Mapping) of their columns,
//! how well a run of the laboratory [agrees](agreement) with
//! them, and parameters of a rig that are [fitted](Fit) to them. Nothing here needs a browser or a file.

mod agreement;
mod error;
mod fit;
mod mapping;
mod number;
mod record;
mod replay;
mod sequence;
mod table;
mod unit_name;

use agreement::interpolated;
pub use agreement::{Agreement, RecordAgreement, agreement, residuals};
pub use error::RecordError;
pub use fit::{Estimate, Fit, FitReport, Parameter, Sought, levels_at_start};
pub use mapping::{ColumnMeaning, Mapping, Signal, Unit};
pub use record::Record;
use replay::first_levels;
pub use replay::replay;
pub use sequence::{pump_sequence, pump_sequence_text};
pub use table::{Column, MAX_BYTES, Table};
pub use unit_name::NamedUnit;
