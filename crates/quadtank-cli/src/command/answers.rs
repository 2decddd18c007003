//! What the commands answer about a document: one implementation for each kind.

use quadtank::sim::level::LevelRunError;
use quadtank::study::StudyError;
use quadtank::study::level_loop::{LevelLoopFault, StepTestFault};
use quadtank::study::quadruple_tank::{analyse, run};
use quadtank::tuning::TuningError;
use quadtank_export::{ExportError, Language, export};
use quadtank_figure::Style;
use quadtank_scenario::level_loop::{self as level_loops, LevelLoopScenario};
use quadtank_scenario::model_free::ModelFreeScenario;
use quadtank_scenario::report::quadruple::AnalysisReport;
use quadtank_scenario::report::tuning::TuningAnalysisReport;
use quadtank_scenario::tuning::{TuningScenario, warnings};
use quadtank_scenario::{BenchDocument, Document, Scenario, ScenarioError, UnknownQuantity, run_to_csv};
use serde::Serialize;
use thiserror::Error;

use super::level_loop::{self, SearchOptions};
use super::{Format, level_plot, model_free, plot, quantities, tune};

/// What is to be drawn, and how.
pub struct Drawing {
    /// Of a run of the quadruple tank.
    pub chart: plot::Chart,
    /// Of a relay-tuning session.
    pub picture: tune::Picture,
    /// Of a level loop.
    pub level_picture: level_plot::LevelPicture,
    /// Colours and size.
    pub style: Style,
}

/// Why a document has no answer.
#[derive(Debug, Error)]
pub enum Fault {
    #[error("{0}")]
    Scenario(#[from] ScenarioError),
    #[error("tuning: {0}")]
    Tuning(#[from] TuningError),
    #[error("level_loop.{0}")]
    LevelLoop(#[from] LevelLoopFault),
    #[error("level_loop: {0}")]
    LevelRun(#[from] LevelRunError),
    #[error("this command needs a relay-tuning session, version 2, or a level loop, version 4")]
    NoTuning,
    #[error("this command needs an experiment of the quadruple tank, version 1")]
    NoExport,
    #[error("level_loop.test: {0}")]
    StepTest(#[from] StepTestFault),
    #[error("{error}{}", quantities::suggested_quantities(near))]
    UnknownQuantity { error: UnknownQuantity, near: Vec<&'static str> },
    #[error("{0}")]
    Json(#[from] serde_json::Error),
}

/// The answers to all commands, each a text to print.
pub trait Answers {
    /// What theory says, as JSON.
    fn analyse(&self) -> Result<String, Fault>;
    /// What happens in the run.
    fn simulate(&self, format: Format) -> Result<String, Fault>;
    /// A picture, as SVG.
    fn plot(&self, drawing: &Drawing) -> Result<String, Fault>;
    /// What relay test and design find, or a search for the settings of a level loop.
    fn tune(&self, _: Format, _: &SearchOptions) -> Result<String, Fault> {
        Err(Fault::NoTuning)
    }
    /// The experiment as a script.
    fn export(&self, _: Language) -> Result<String, Fault> {
        Err(Fault::NoExport)
    }
    /// What the document may not have been meant to say.
    fn warnings(&self) -> Vec<String> {
        Vec::new()
    }
}

/// The answers of a document.
pub fn of(document: &Document) -> &dyn Answers {
    match document {
        Document::Quadruple(scenario) => scenario,
        Document::Tuning(scenario) => scenario,
        Document::ModelFree(scenario) => scenario,
        Document::LevelLoop(scenario) => scenario,
    }
}

impl Answers for Scenario {
    fn analyse(&self) -> Result<String, Fault> {
        json(&AnalysisReport::from(&studied::<Self, _>(analyse(&self.setup))?))
    }

    fn simulate(&self, format: Format) -> Result<String, Fault> {
        let run = studied::<Self, _>(run(&self.setup))?;
        match format {
            Format::Csv => Ok(run_to_csv(&run)),
            Format::Json => json(&run),
        }
    }

    fn plot(&self, drawing: &Drawing) -> Result<String, Fault> {
        studied::<Self, _>(plot::svg(&self.setup, drawing.chart, &drawing.style))
    }

    fn export(&self, language: Language) -> Result<String, Fault> {
        export(self, language).map_err(|error| match error {
            ExportError::Scenario(error) => error.into(),
            ExportError::Study(error) => ScenarioError::Study { setup: Self::ROOT, error }.into(),
        })
    }
}

impl Answers for TuningScenario {
    fn analyse(&self) -> Result<String, Fault> {
        json_by_key(&TuningAnalysisReport::of(&self.tuning)?)
    }

    fn simulate(&self, format: Format) -> Result<String, Fault> {
        match format {
            Format::Csv => Ok(tune::response_csv(&self.tuning)?),
            Format::Json => json_by_key(&tune::report(&self.tuning)?),
        }
    }

    fn plot(&self, drawing: &Drawing) -> Result<String, Fault> {
        Ok(tune::svg(&self.tuning, drawing.picture, &drawing.style)?)
    }

    fn tune(&self, format: Format, _: &SearchOptions) -> Result<String, Fault> {
        match format {
            Format::Csv => Ok(tune::test_csv(&self.tuning)?),
            Format::Json => json_by_key(&tune::report(&self.tuning)?),
        }
    }

    fn warnings(&self) -> Vec<String> {
        warnings(&self.tuning).iter().map(ToString::to_string).collect()
    }
}

impl Answers for ModelFreeScenario {
    fn analyse(&self) -> Result<String, Fault> {
        json_by_key(&model_free::analysis(&self.model_free))
    }

    fn simulate(&self, format: Format) -> Result<String, Fault> {
        match format {
            Format::Csv => studied::<Self, _>(model_free::csv(&self.model_free)),
            Format::Json => json_by_key(&studied::<Self, _>(model_free::report(&self.model_free))?),
        }
    }

    fn plot(&self, drawing: &Drawing) -> Result<String, Fault> {
        studied::<Self, _>(model_free::svg(&self.model_free, &drawing.style))
    }
}

impl Answers for LevelLoopScenario {
    fn analyse(&self) -> Result<String, Fault> {
        json(&level_loop::analysis(&self.level_loop))
    }

    fn simulate(&self, format: Format) -> Result<String, Fault> {
        match format {
            Format::Csv => Ok(level_loop::csv(&self.level_loop)?),
            Format::Json => json(&level_loop::report(&self.level_loop)?),
        }
    }

    fn plot(&self, drawing: &Drawing) -> Result<String, Fault> {
        level_plot::svg(&self.level_loop, drawing.level_picture, &drawing.style)
    }

    fn tune(&self, format: Format, options: &SearchOptions) -> Result<String, Fault> {
        match format {
            Format::Csv => Ok(level_loop::search_csv(&self.level_loop, options)?),
            Format::Json => json(&level_loop::search_report(&self.level_loop, options)?),
        }
    }

    fn warnings(&self) -> Vec<String> {
        level_loops::warnings(&self.level_loop).iter().map(ToString::to_string).collect()
    }
}

/// A result of the setup of a document.
fn studied<D: BenchDocument, T>(result: Result<T, StudyError>) -> Result<T, Fault> {
    Ok(result.map_err(|error| ScenarioError::Study { setup: D::ROOT, error })?)
}

pub fn json<T: Serialize>(report: &T) -> Result<String, Fault> {
    Ok(serde_json::to_string_pretty(report)? + "\n")
}

/// A report of version 2 or 3, whose keys have always been in alphabetical order.
fn json_by_key<T: Serialize>(report: &T) -> Result<String, Fault> {
    json(&serde_json::to_value(report)?)
}
