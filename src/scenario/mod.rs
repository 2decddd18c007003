//! The document that describes an experiment: its types, versions, validation and links, and what follows from it.
//!
//! A [`Scenario`] is a file, a link, an embed, a command-line run. [`analyse`] says what theory says about it,
//! [`run`] what happens.

mod analyse;
mod codec;
mod csv;
mod document;
mod error;
pub mod limits;
mod link;
mod margins;
mod presets;
mod report;
mod run;
mod validate;
mod valve_map;

pub use analyse::{Analysis, analyse};
pub use codec::{DOCUMENT_LIMIT, from_json, to_json};
pub use document::{OperatingPointSpec, PlantSpec, Scenario, Setup, View};
pub use error::ScenarioError;
pub use limits::Limits;
pub use link::{LINK_LIMIT, from_link, to_link};
pub use margins::Margins;
pub use presets::setup_of;
pub use report::AnalysisReport;
pub use run::{Run, run};
pub use valve_map::ValveMap;
