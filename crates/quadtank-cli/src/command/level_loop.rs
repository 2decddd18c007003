//! Level loops without a screen: what theory says, what happens in a run, and searches for settings, as a report or CSV.

use clap::{Args, ValueEnum};
use quadtank::sim::level::{LevelController, LevelRunError};
use quadtank::study::Study;
use quadtank::study::level_loop::{
    LevelLoopFault, LevelLoopSetup, LevelLoopStudy, LevelSearch, PiTuning, SearchMethod, run_level_loop,
};
use quadtank::tuning::search::GeneticSettings;
use quadtank_scenario::level_loop::{run_to_csv, search_to_csv};
use quadtank_scenario::report::level_loop::{LevelLoopAnalysisReport, LevelLoopReport, LevelSearchReport};

/// Evaluations between two looks at a search; any number gives the same.
const SLICE: usize = 100;

/// How the settings of a level loop are searched.
#[derive(Args)]
pub struct SearchOptions {
    /// Search for the settings of a level loop (version 4); gradient and nelder-mead begin at the PI settings of the document, or at
    /// its reference where its controller is no PI
    #[arg(long, value_enum, default_value_t = Method::NelderMead)]
    method: Method,
    /// Seed of the genetic search
    #[arg(long, default_value_t = GeneticSettings::default().seed)]
    seed: u32,
    /// Individuals of the genetic search
    #[arg(long, default_value_t = 25, value_parser = clap::value_parser!(u32).range(4..=1000))]
    population: u32,
    /// Generations of the genetic search
    #[arg(long, default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..=1000))]
    generations: u32,
}

/// A method of search.
#[derive(Clone, Copy, ValueEnum)]
enum Method {
    /// Steepest descent
    Gradient,
    /// The simplex of Nelder and Mead
    NelderMead,
    /// A genetic search
    Genetic,
}

impl SearchOptions {
    fn method(&self, setup: &LevelLoopSetup) -> SearchMethod {
        let start = tuning(&setup.controller).unwrap_or(setup.reference);
        match self.method {
            Method::Gradient => SearchMethod::Gradient(start),
            Method::NelderMead => SearchMethod::NelderMead(start),
            Method::Genetic => SearchMethod::Genetic(GeneticSettings {
                seed: self.seed,
                population: self.population as usize,
                generations: self.generations as usize,
                ..GeneticSettings::default()
            }),
        }
    }
}

/// The PI settings of a controller; `None` where it is no PI controller.
fn tuning(controller: &LevelController) -> Option<PiTuning> {
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

/// What theory says at the rest where the experiment begins.
pub fn analysis(setup: &LevelLoopSetup) -> LevelLoopAnalysisReport {
    LevelLoopAnalysisReport::of(&LevelLoopStudy::update(setup, &[], None))
}

/// What happens in the run.
pub fn report(setup: &LevelLoopSetup) -> Result<LevelLoopReport, LevelLoopFault> {
    Ok(LevelLoopReport::of(setup, &run_level_loop(setup)?))
}

/// The run, one line for each row of its log.
pub fn csv(setup: &LevelLoopSetup) -> Result<String, LevelLoopFault> {
    Ok(run_to_csv(&run_level_loop(setup)?, setup))
}

/// A search to its end.
fn searched(setup: &LevelLoopSetup, method: SearchMethod) -> Result<LevelSearch, LevelRunError> {
    let mut search = LevelSearch::new(setup, method)?;
    while search.advance(SLICE) {}
    Ok(search)
}

/// What a search finds, beside what rules suggest.
pub fn search_report(setup: &LevelLoopSetup, options: &SearchOptions) -> Result<LevelSearchReport, LevelRunError> {
    let method = options.method(setup);
    let search = searched(setup, method)?;
    let found = LevelLoopStudy::update(setup, &[], None);
    Ok(LevelSearchReport::of(&found, method, &search, tuning(&setup.controller)))
}

/// Where a search stood, one line for each step, simplex or generation.
pub fn search_csv(setup: &LevelLoopSetup, options: &SearchOptions) -> Result<String, LevelRunError> {
    Ok(search_to_csv(&searched(setup, options.method(setup))?))
}
