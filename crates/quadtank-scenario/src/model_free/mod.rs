//! The document of a run under the model-free law, version 3, and the tables of its results.

mod csv;
mod document;
mod validate;

pub use csv::{roots_to_csv, run_to_csv};
pub use document::ModelFreeScenario;
