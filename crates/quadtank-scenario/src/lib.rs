//! The document that describes an experiment: its types, versions, validation and links, and what follows from it.
//!
//! A [`Scenario`], [`TuningScenario`](tuning::TuningScenario) or [`ModelFreeScenario`](model_free::ModelFreeScenario) is a file, a
//! link, an embed, a command-line run. It comes in by [`document_from_bytes`] or [`document_from_link`], which check every number
//! against its row in the table of [parameters](params) and take any bytes; [`to_json`] and [`to_link`] write it, with all digits.
//! [`setup_of`] gives the published rigs. [`analyse()`] says what theory says about a setup, [`run()`] what happens, and
//! [`ValveMap`] where the zeros go when its valves move: the lower rooms put together, here and nowhere else.

mod analyse;
mod codec;
mod csv;
mod document;
mod error;
pub mod limits;
mod link;
mod margins;
pub mod model_free;
mod pack;
pub mod params;
mod path;
mod presets;
mod reader;
mod report;
mod run;
#[cfg(feature = "schema")]
mod schema;
mod setting;
mod text;
mod tree;
pub mod tuning;
mod validate;
mod valve_map;

pub use analyse::{Analysis, analyse};
pub use codec::{
    DOCUMENT_LIMIT, Document, check_length, document_from_bytes, document_from_json, from_json, model_free_to_json,
    to_json, tuning_to_json,
};
pub use document::{OperatingPointSpec, PlantSpec, Scenario, Setup, View};
pub use error::ScenarioError;
pub use limits::Limits;
pub use link::{LINK_LIMIT, document_from_link, model_free_to_link, to_link, tuning_to_link};
pub use margins::Margins;
pub use presets::setup_of;
pub use report::AnalysisReport;
pub use run::{Run, run};
#[cfg(feature = "schema")]
pub use schema::schema_of;
pub use valve_map::ValveMap;
