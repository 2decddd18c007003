//! The document of a level loop, version 4, and the tables of its results.

mod clamp;
mod csv;
mod document;
mod validate;
mod warnings;

pub use clamp::within_limits;
pub use csv::{cost_map_to_csv, run_to_csv, search_to_csv, step_test_to_csv, trade_off_to_csv};
pub use document::LevelLoopScenario;
pub use warnings::{LevelLoopWarning, warnings};
