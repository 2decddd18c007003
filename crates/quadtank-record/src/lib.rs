//! Records of a rig of one's own: [tables](Table) of measurements as laboratories write them, the [meaning](Mapping) of their columns,
//! and how well a run of the laboratory [agrees](agreement) with them. Nothing here needs a browser or a file.

mod agreement;
mod error;
mod mapping;
mod number;
mod record;
mod replay;
mod table;

pub use agreement::{Agreement, RecordAgreement, agreement};
pub use error::RecordError;
pub use mapping::{ColumnMeaning, Mapping, Signal, Unit};
pub use record::Record;
pub use replay::replay;
pub use table::{Column, MAX_BYTES, Table};
