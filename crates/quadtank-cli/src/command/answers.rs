//! What the commands answer about a document, each a text to print.

use quadtank::sim::level::LevelRunError;
use quadtank_export::ExportError;
use quadtank_scenario::answers::{AnswerError, SearchRequest};
use quadtank_scenario::{BenchDocument, CsvStyle, Document, Scenario, ScenarioError, TwoCommas, UnknownQuantity};
use thiserror::Error;

use super::{Format, quantities};

/// Why a document has no answer.
#[derive(Debug, Error)]
pub enum Fault {
    #[error("{0}")]
    Answer(#[from] AnswerError),
    #[error("this command needs an experiment of the quadruple tank, version 1")]
    NoExport,
    #[error("{error}{}", quantities::suggested_quantities(near))]
    UnknownQuantity { error: UnknownQuantity, near: Vec<&'static str> },
    #[error("{0}")]
    Table(#[from] TwoCommas),
}

impl From<ScenarioError> for Fault {
    fn from(error: ScenarioError) -> Self {
        Self::Answer(error.into())
    }
}

impl From<LevelRunError> for Fault {
    fn from(error: LevelRunError) -> Self {
        Self::Answer(error.into())
    }
}

/// What happens in the run.
pub fn simulate(document: &Document, format: Format, table: CsvStyle) -> Result<String, AnswerError> {
    match format {
        Format::Csv => Ok(table.apply(&document.run_csv()?).into_owned()),
        Format::Json => document.run_json(),
    }
}

/// What relay test and design find, or a search for the settings of a level loop.
pub fn tune(
    document: &Document,
    format: Format,
    request: &SearchRequest,
    table: CsvStyle,
) -> Result<String, AnswerError> {
    match format {
        Format::Csv => Ok(table.apply(&document.tuning_csv(request)?).into_owned()),
        Format::Json => document.tuning_json(request),
    }
}

/// The experiment in another language.
pub fn exported(
    document: &Document,
    write: impl Fn(&Scenario) -> Result<String, ExportError>,
) -> Result<String, Fault> {
    let Document::Quadruple(scenario) = document else { return Err(Fault::NoExport) };
    write(scenario).map_err(|error| match error {
        ExportError::Scenario(error) => error.into(),
        ExportError::Study(error) => ScenarioError::Study { setup: Scenario::ROOT, error }.into(),
    })
}
