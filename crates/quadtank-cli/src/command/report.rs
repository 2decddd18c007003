//! Schemas of what commands print as JSON.

use clap::ValueEnum;
use quadtank::study::quadruple_tank::Run;
use quadtank_scenario::BenchDocument;
use quadtank_scenario::level_loop::LevelLoopScenario;
use quadtank_scenario::model_free::ModelFreeScenario;
use quadtank_scenario::report::level_loop::{LevelLoopAnalysisReport, LevelLoopReport, LevelSearchReport};
use quadtank_scenario::report::model_free::{ModelFreeAnalysisReport, ModelFreeReport};
use quadtank_scenario::report::quadruple::AnalysisReport;
use quadtank_scenario::report::tuning::{TuningAnalysisReport, TuningReport};
use quadtank_scenario::tuning::TuningScenario;
use quadtank_scenario::{Scenario, schema_of_report};
use serde_json::Value;

/// A command that reports on a document.
#[derive(Clone, Copy, ValueEnum)]
pub enum Report {
    /// What theory says
    Analyse,
    /// What happens in the run; of version 2 the same as of tune
    Simulate,
    /// What the relay test and the design find, or a search for settings of a level loop
    Tune,
}

impl Report {
    /// The schema of what the command prints about documents of a version; `None` where it refuses them.
    pub fn schema(self, version: u32) -> Option<Value> {
        match (self, version) {
            (Self::Analyse, Scenario::VERSION) => Some(schema_of_report::<AnalysisReport>()),
            (Self::Analyse, TuningScenario::VERSION) => Some(schema_of_report::<TuningAnalysisReport>()),
            (Self::Analyse, ModelFreeScenario::VERSION) => Some(schema_of_report::<ModelFreeAnalysisReport>()),
            (Self::Simulate, Scenario::VERSION) => Some(schema_of_report::<Run>()),
            (Self::Simulate | Self::Tune, TuningScenario::VERSION) => Some(schema_of_report::<TuningReport>()),
            (Self::Simulate, ModelFreeScenario::VERSION) => Some(schema_of_report::<ModelFreeReport>()),
            (Self::Analyse, LevelLoopScenario::VERSION) => Some(schema_of_report::<LevelLoopAnalysisReport>()),
            (Self::Simulate, LevelLoopScenario::VERSION) => Some(schema_of_report::<LevelLoopReport>()),
            (Self::Tune, LevelLoopScenario::VERSION) => Some(schema_of_report::<LevelSearchReport>()),
            _ => None,
        }
    }
}
