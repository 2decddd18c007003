//! The document that describes an experiment: its types, versions, validation and links, and what follows from it.
//!
//! A [`Scenario`] is a file, a link, an embed, a command-line run. [`analyse`] says what theory says about it,
//! [`run`] what happens.

mod analyse;
mod codec;
mod document;
mod error;
mod presets;
mod run;
mod validate;

pub use analyse::{Analysis, analyse};
pub use codec::{LINK_LIMIT, from_json, from_link, to_json, to_link};
pub use document::{OperatingPointSpec, PlantSpec, Scenario, Setup, View};
pub use error::ScenarioError;
pub use presets::setup_of;
pub use run::{Run, run};
pub use validate::{Limits, limits};
