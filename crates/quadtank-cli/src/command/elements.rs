//! A plant from the lines of MATLAB or python-control that define it.

use std::path::Path;

use quadtank::study::relay_tuning::{TuningPlant, TuningSetup};
use quadtank_formula::{FormulaError, MAX_BYTES, elements_from_script};
use quadtank_scenario::tuning::TuningScenario;
use quadtank_scenario::{BenchDocument, to_json};
use thiserror::Error;

use super::files::{bytes_of, file_name, print};
use super::{Failure, told};

/// Why there is no plant.
#[derive(Debug, Error)]
pub enum ElementsFault {
    #[error("{file}: not UTF-8 text")]
    NotText { file: String },
    #[error("{file}: line {line}, column {column}: {error}")]
    Script { file: String, line: usize, column: usize, error: FormulaError },
}

/// Prints a relay-tuning session on the plant of a script.
pub fn execute(file: &Path) -> Result<(), Failure> {
    let bytes = bytes_of(file, MAX_BYTES)?;
    let text = String::from_utf8(bytes).map_err(|_| ElementsFault::NotText { file: file_name(file) })?;
    let text = text.trim_start_matches('\u{feff}');
    let elements = elements_from_script(text).map_err(|error| {
        let position = error.position(text);
        ElementsFault::Script { file: file_name(file), line: position.line, column: position.column, error }
    })?;
    let session = TuningScenario::from(TuningSetup::on(TuningPlant::Elements(elements)));
    told(file, session.validate())?;
    print(&(told(file, to_json(&session))? + "\n"))
}
