//! Options of a search for the settings of a level loop.

use clap::{Args, ValueEnum};
use quadtank::tuning::search::GeneticSettings;
use quadtank_scenario::answers::{SearchKind, SearchRequest};

/// How the settings of a level loop are searched.
#[derive(Clone, Copy, Args)]
pub struct SearchOptions {
    /// Search for the settings of a level loop (version 4); gradient and nelder-mead begin at the PI settings of the document, or at
    /// its reference where its controller is no PI
    #[arg(long, value_enum, default_value_t = Method::NelderMead)]
    method: Method,
    /// Seed of the genetic search
    #[arg(long, default_value_t = GeneticSettings::default().seed)]
    seed: u32,
    /// Individuals of the genetic search
    #[arg(long, default_value_t = 25, value_parser = within(SearchRequest::POPULATION))]
    population: u32,
    /// Generations of the genetic search
    #[arg(long, default_value_t = 100, value_parser = within(SearchRequest::GENERATIONS))]
    generations: u32,
}

fn within([min, max]: [u32; 2]) -> clap::builder::RangedI64ValueParser<u32> {
    clap::value_parser!(u32).range(i64::from(min)..=i64::from(max))
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

impl From<SearchOptions> for SearchRequest {
    fn from(options: SearchOptions) -> Self {
        let SearchOptions { method, seed, population, generations } = options;
        let method = match method {
            Method::Gradient => SearchKind::Gradient,
            Method::NelderMead => SearchKind::NelderMead,
            Method::Genetic => SearchKind::Genetic,
        };
        Self { method, seed, population, generations }
    }
}
