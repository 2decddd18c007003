use serde::{Deserialize, Serialize};

use crate::sim::level::LevelRunError;
use crate::tuning::LevelProblem;
use crate::tuning::search::{AxisError, Evaluated, Genetic, GeneticSettings, Gradient, NelderMead, Search, advance};

use super::{LevelLoopSetup, PiTuning};

/// A method of search with what it needs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum SearchMethod {
    /// Steepest descent from a start.
    Gradient(PiTuning),
    /// The simplex of Nelder and Mead from a start.
    NelderMead(PiTuning),
    /// A genetic search.
    Genetic(GeneticSettings),
}

/// A search for the PI settings of a setup, in slices.
#[derive(Clone, Debug)]
pub struct LevelSearch {
    problem: LevelProblem,
    state: State,
    evaluations: usize,
}

#[derive(Clone, Debug)]
enum State {
    Gradient(Gradient<2>),
    NelderMead(NelderMead<2>),
    Genetic(Genetic<2>),
}

impl LevelSearch {
    /// A search for the least cost of a setup in its box.
    ///
    /// # Errors
    /// [`LevelRunError`] for a loop without a run, or for a box that cannot be searched, under the name `search`.
    pub fn new(setup: &LevelLoopSetup, method: SearchMethod) -> Result<Self, LevelRunError> {
        let problem = LevelProblem::new(&setup.plant(), &setup.experiment, setup.cost(), setup.anti_windup())?;
        let axes = setup.search.axes();
        let start = |tuning: PiTuning| [tuning.gain, tuning.integral_time_s];
        let state = match method {
            SearchMethod::Gradient(tuning) => Gradient::new(axes, start(tuning)).map(State::Gradient),
            SearchMethod::NelderMead(tuning) => NelderMead::new(axes, start(tuning)).map(State::NelderMead),
            SearchMethod::Genetic(settings) => Genetic::new(axes, settings).map(State::Genetic),
        };
        let refuse = |AxisError { low, .. }| LevelRunError::OutOfRange { field: "search", value: low };
        Ok(Self { problem, state: state.map_err(refuse)?, evaluations: 0 })
    }

    /// Evaluates up to so many settings; says whether it goes on. To cancel a search, drop it.
    pub fn advance(&mut self, budget: usize) -> bool {
        let (problem, evaluations) = (&mut self.problem, &mut self.evaluations);
        let mut cost = |settings: [f64; 2]| {
            *evaluations += 1;
            problem.cost(settings)
        };
        match &mut self.state {
            State::Gradient(search) => advance(search, budget, &mut cost),
            State::NelderMead(search) => advance(search, budget, &mut cost),
            State::Genetic(search) => advance(search, budget, &mut cost),
        }
    }

    /// How many settings were evaluated.
    pub fn evaluations(&self) -> usize {
        self.evaluations
    }

    /// The best settings so far.
    pub fn best(&self) -> Option<Evaluated<2>> {
        match &self.state {
            State::Gradient(search) => search.best(),
            State::NelderMead(search) => search.best(),
            State::Genetic(search) => search.best(),
        }
    }

    /// Where the search stood: a point for each step, simplex or generation.
    pub fn path(&self) -> &[Evaluated<2>] {
        match &self.state {
            State::Gradient(search) => search.path(),
            State::NelderMead(search) => search.path(),
            State::Genetic(search) => search.path(),
        }
    }

    /// Gains and integral times (s) of the present population; empty for the other methods.
    pub fn population(&self) -> Vec<[f64; 2]> {
        match &self.state {
            State::Genetic(search) => search.population().collect(),
            State::Gradient(_) | State::NelderMead(_) => Vec::new(),
        }
    }
}
