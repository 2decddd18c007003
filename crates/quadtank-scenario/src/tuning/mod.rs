//! The document of a relay-tuning session, version 2, and the tables of its results.

mod csv;
mod document;
mod validate;
mod warnings;

pub use csv::{curve_to_csv, loci_to_csv, record_to_csv, response_to_csv};
pub use document::TuningScenario;
pub use warnings::{TuningWarning, warnings};
