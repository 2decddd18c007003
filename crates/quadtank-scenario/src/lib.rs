//! The document that describes an experiment: its versions, validation and links, and the tables and reports of its results.
//!
//! A [`Scenario`], [`TuningScenario`](tuning::TuningScenario), [`ModelFreeScenario`](model_free::ModelFreeScenario) or
//! [`LevelLoopScenario`](level_loop::LevelLoopScenario) is a file, a link, an embed, a command-line run. It comes in by [`document_from_bytes`] or [`document_from_link`], which check every number
//! against its row in the table of [parameters](params) and take any bytes; [`to_json`] and [`to_link`] write it, with all digits.
//! What a document holds besides its version, a setup, is a type of [`quadtank::study`], which also computes what follows from it.

pub mod answers;
mod codec;
mod csv;
mod csv_style;
mod csv_table;
mod difference;
mod document;
mod entries;
mod error;
mod label;
pub mod level_loop;
pub mod limits;
mod link;
pub mod model_free;
mod pack;
pub mod params;
mod path;
mod published;
mod quantities;
mod reader;
pub mod report;
mod scenes;
#[cfg(feature = "schema")]
mod schema;
mod setting;
mod text;
mod tree;
pub mod tuning;
mod validate;

pub use codec::{
    DOCUMENT_LIMIT, Document, check_length, document_from_bytes, document_from_json, from_json, read_json, to_json,
};
pub use csv::{frequency_to_csv, roots_to_csv, run_to_csv, valve_map_to_csv};
pub use csv_style::{CsvStyle, DecimalSign, Separator, TwoCommas};
pub use difference::Difference;
pub use document::{BenchDocument, Scenario, View};
pub use entries::{Entry, EntryValue, entries};
pub use error::{ScenarioError, is_gravity_in_cm, runs_backwards};
pub use label::Label;
pub use limits::Limits;
pub use link::{LINK_LIMIT, document_from_link, to_link};
pub use published::{level_loop_cases, model_free_cases, published_document, published_names};
pub use quantities::{Quantities, QuantityRow, UnknownQuantity, bench_of, quantities_of};
pub use scenes::{Opened, Scenes, opened_from_bytes};
#[cfg(feature = "schema")]
pub use schema::{schema_of, schema_of_report};
