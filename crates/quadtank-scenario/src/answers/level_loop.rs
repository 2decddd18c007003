use quadtank::sim::level::{LevelController, LevelRunError};
use quadtank::study::Study;
use quadtank::study::level_loop::{
    LevelLoopSetup, LevelLoopStudy, LevelSearch, PiTuning, SearchMethod, run_level_loop,
};
use quadtank::tuning::search::GeneticSettings;
use serde::Deserialize;

use super::{AnswerError, Answers, report_json};
use crate::level_loop::{LevelLoopScenario, run_to_csv, search_to_csv, warnings};
use crate::limits::Limits;
use crate::report::level_loop::{LevelLoopAnalysisReport, LevelLoopReport, LevelSearchReport};
use crate::{ScenarioError, error};

/// Evaluations between two looks at a search; any number gives the same.
const SLICE: usize = 100;

/// How the settings of a level loop are searched.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SearchKind {
    /// Steepest descent.
    Gradient,
    /// The simplex of Nelder and Mead.
    #[default]
    NelderMead,
    /// A genetic search.
    Genetic,
}

/// A search for the settings of a level loop. Gradient and simplex begin at the PI settings of the document, or at its reference
/// where its controller is no PI; seed, population and generations are those of the genetic search.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SearchRequest {
    /// The method.
    pub method: SearchKind,
    /// Seed of the genetic search.
    pub seed: u32,
    /// Its individuals, [`POPULATION`](Self::POPULATION).
    pub population: u32,
    /// Its generations, [`GENERATIONS`](Self::GENERATIONS).
    pub generations: u32,
}

impl SearchRequest {
    /// Least and largest population.
    pub const POPULATION: [u32; 2] = [4, 1000];
    /// Least and largest number of generations.
    pub const GENERATIONS: [u32; 2] = [1, 1000];

    /// Whether its numbers are within their limits.
    ///
    /// # Errors
    /// [`ScenarioError::OutOfRange`] with the name of the number.
    pub fn check(&self) -> Result<(), ScenarioError> {
        let of =
            [("population", self.population, Self::POPULATION), ("generations", self.generations, Self::GENERATIONS)];
        for (name, value, [min, max]) in of {
            if !(min..=max).contains(&value) {
                let limits = Limits { min: min.into(), max: max.into() };
                return Err(error::out_of_range(name, value.into(), limits));
            }
        }
        Ok(())
    }

    fn method(&self, setup: &LevelLoopSetup) -> SearchMethod {
        let start = tuning_of(&setup.controller).unwrap_or(setup.reference);
        match self.method {
            SearchKind::Gradient => SearchMethod::Gradient(start),
            SearchKind::NelderMead => SearchMethod::NelderMead(start),
            SearchKind::Genetic => SearchMethod::Genetic(GeneticSettings {
                seed: self.seed,
                population: self.population as usize,
                generations: self.generations as usize,
                ..GeneticSettings::default()
            }),
        }
    }
}

impl Default for SearchRequest {
    fn default() -> Self {
        Self { method: SearchKind::default(), seed: GeneticSettings::default().seed, population: 25, generations: 100 }
    }
}

/// The PI settings of a controller, sampled or not; `None` where it is no PI controller.
fn tuning_of(controller: &LevelController) -> Option<PiTuning> {
    match controller {
        LevelController::Pi { gain, integral_time_s, .. } => {
            Some(PiTuning { gain: *gain, integral_time_s: *integral_time_s })
        }
        LevelController::Sampled { settings, .. } => {
            Some(PiTuning { gain: settings.gain, integral_time_s: settings.integral_time_s })
        }
        LevelController::Manual { .. } | LevelController::Pid { .. } => None,
    }
}

/// A search to its end.
fn searched(setup: &LevelLoopSetup, method: SearchMethod) -> Result<LevelSearch, LevelRunError> {
    let mut search = LevelSearch::new(setup, method)?;
    while search.advance(SLICE) {}
    Ok(search)
}

impl Answers for LevelLoopScenario {
    fn analysis_json(&self) -> Result<String, AnswerError> {
        report_json(&LevelLoopAnalysisReport::of(&LevelLoopStudy::update(&self.level_loop, &[], None)))
    }

    fn run_json(&self) -> Result<String, AnswerError> {
        report_json(&LevelLoopReport::of(&self.level_loop, &run_level_loop(&self.level_loop)?))
    }

    fn run_csv(&self) -> Result<String, AnswerError> {
        Ok(run_to_csv(&run_level_loop(&self.level_loop)?, &self.level_loop))
    }

    fn tuning_json(&self, request: &SearchRequest) -> Result<String, AnswerError> {
        let setup = &self.level_loop;
        let method = request.method(setup);
        let search = searched(setup, method)?;
        let found = LevelLoopStudy::update(setup, &[], None);
        report_json(&LevelSearchReport::of(&found, method, &search, tuning_of(&setup.controller)))
    }

    fn tuning_csv(&self, request: &SearchRequest) -> Result<String, AnswerError> {
        Ok(search_to_csv(&searched(&self.level_loop, request.method(&self.level_loop))?))
    }

    fn warnings(&self) -> Vec<String> {
        warnings(&self.level_loop).iter().map(ToString::to_string).collect()
    }
}
