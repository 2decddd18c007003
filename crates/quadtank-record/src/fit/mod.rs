//! Parameters of a rig from a record, by least squares (Levenberg and Marquardt).

mod parameter;
mod problem;

use levenberg_marquardt::{LevenbergMarquardt, TerminationReason};
use nalgebra_of_solver::DMatrix;
use quadtank::study::quadruple_tank::Setup;
use serde::Serialize;

pub use parameter::{Parameter, Sought};
use problem::Problem;

use crate::{Record, RecordError, first_levels, replay};

/// Times that the solver may go through all parameters before it shows where it stands.
const PATIENCE: usize = 2;
/// First step at most, as a share of the size of the scaled coordinates: a longer one may leave the valley of a delay.
const STEP_BOUND: f64 = 1.0;
/// Most such rounds.
const MAX_ROUNDS: usize = 40;
/// A value this near to a bound, as a share of the range, is at it.
const AT_BOUND: f64 = 2e-3;
/// Correlation of two estimates from which on the record does not tell them apart, unless it tells both better than [`SURE`].
const ALIKE: f64 = 0.97;
/// Standard error over the value up to which a parameter is known whatever it goes together with.
const SURE: f64 = 0.02;
/// Smallest over largest pivot of the Cholesky factor of `JᵀJ` from which on down rounding alone tells the parameters apart.
const SINGULAR: f64 = 1e-7;
/// Standard error over the value from which on the record does not tell a parameter.
const VAGUE: f64 = 0.25;
/// The same for a delay or a level, which may be 0, as a share of the range in which it is sought.
const VAGUE_SHARE: f64 = 0.05;

/// A fitted parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Estimate {
    /// The parameter.
    pub parameter: Parameter,
    /// Starting value, in the unit of the parameter.
    pub start: f64,
    /// Lower and upper bound, in the unit of the parameter.
    pub bounds: [f64; 2],
    /// Its value, in its unit.
    pub value: f64,
    /// Standard error, if the residuals were independent; those of a record seldom are, so it is a lower bound. `None` where the record
    /// does not tell the parameters apart at all.
    pub standard_error: Option<f64>,
    /// Whether it ended at a bound of the search.
    pub is_at_bound: bool,
}

/// What a record says of the parameters of a rig.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FitReport {
    /// The parameters.
    pub estimates: Vec<Estimate>,
    /// Correlation of the estimates, by their order; `None` where the record does not tell them apart at all.
    pub correlation: Option<Vec<Vec<f64>>>,
    /// Pairs of parameters that the record does not tell apart, by their order.
    pub alike: Vec<[usize; 2]>,
    /// Parameters that it hardly tells, by their order.
    pub vague: Vec<usize>,
    /// Root of the mean squared difference of the levels before and after (m).
    pub rmse: [f64; 2],
    /// Values of the record that were compared.
    pub values: usize,
    /// Whether the search came to an end by itself.
    pub converged: bool,
}

/// A fit under way: [`advance`](Self::advance) until it is [over](Self::is_over), then [`report`](Self::report).
#[derive(Clone, Debug)]
pub struct Fit {
    problem: Problem,
    first_rmse: f64,
    rounds: usize,
    converged: bool,
    over: bool,
}

impl Fit {
    /// Parameters of the rig of a setup, sought from what they are there, in the experiment of a record.
    ///
    /// # Errors
    /// As [`replay`]; [`RecordError::NothingToFit`] without a parameter or without levels; [`RecordError::TooFewValues`] with fewer
    /// values than parameters; [`RecordError::CannotRun`] where the rig cannot be run.
    pub fn new(setup: &Setup, record: &Record, parameters: &[Parameter]) -> Result<Self, RecordError> {
        let (rig, first) = (setup.plant(), levels_at_start(setup, record));
        let sought: Vec<Sought> = parameters.iter().map(|&parameter| Sought::usual(parameter, &rig, &first)).collect();
        Self::within(setup, record, &sought)
    }

    /// Prepares a fit with given starting values and bounds.
    ///
    /// # Errors
    /// As [`Self::new`]; [`RecordError::WrongBounds`].
    pub fn within(setup: &Setup, record: &Record, sought: &[Sought]) -> Result<Self, RecordError> {
        let rig = setup.plant();
        if let Some(wrong) = sought.iter().find(|sought| !sought.is_valid(&rig)) {
            let allowed = wrong.parameter.allowed(&rig);
            return Err(RecordError::WrongBounds { parameter: wrong.parameter, min: allowed.min, max: allowed.max });
        }
        let mut problem = Problem::new(replay(record, setup)?, record, sought.to_vec());
        if sought.is_empty() || problem.count() == 0 {
            return Err(RecordError::NothingToFit);
        }
        if problem.count() <= sought.len() {
            return Err(RecordError::TooFewValues { values: problem.count(), parameters: sought.len() });
        }
        let first_rmse = rmse(&problem).ok_or(RecordError::CannotRun)?;
        problem.place_delays();
        Ok(Self { problem, first_rmse, rounds: 0, converged: false, over: false })
    }

    /// Lets the solver go on for a while, some ten runs of the plant for each parameter.
    pub fn advance(&mut self) {
        if self.over {
            return;
        }
        let solver = LevenbergMarquardt::new()
            .with_patience(PATIENCE)
            .with_ftol(1e-10)
            .with_xtol(1e-8)
            .with_stepbound(STEP_BOUND);
        let (problem, report) = solver.minimize(self.problem.clone());
        self.problem = problem;
        self.rounds += 1;
        let goes_on = matches!(report.termination, TerminationReason::LostPatience);
        self.converged = report.termination.was_successful();
        self.over = !goes_on || self.rounds >= MAX_ROUNDS;
    }

    /// Whether there is nothing left to do.
    pub fn is_over(&self) -> bool {
        self.over
    }

    /// Root of the mean squared difference of the levels now (m).
    pub fn rmse(&self) -> f64 {
        rmse(&self.problem).unwrap_or(self.first_rmse)
    }

    /// The levels that the fit began with (m): the first recorded ones, at rest where one was not recorded.
    pub fn levels_before(&self) -> [f64; 4] {
        self.problem.levels_before()
    }

    /// The setup with what has been found, in its own experiment. Where that is the experiment of the record, it begins at the levels that
    /// were found, and levels that were neither sought nor recorded begin at the rest of the rig that was found.
    pub fn setup(&self, setup: &Setup) -> Setup {
        let found = self.problem.setup_with(&self.problem.values());
        let fitted = Setup { plant: found.plant, valves: found.valves, ..setup.clone() };
        let replayed = |setup: &Setup| replay(self.problem.record(), setup).ok();
        let is_of_record = replayed(setup).is_some_and(|replayed| replayed.experiment == setup.experiment);
        if !is_of_record {
            return fitted;
        }
        let mut fitted = replayed(&fitted).unwrap_or(fitted);
        let sought = self.problem.free.iter().zip(self.problem.values());
        if let Some(levels) = &mut fitted.experiment.initial_levels {
            for (free, value) in sought {
                if let Parameter::StartLevel(tank) = free.parameter {
                    levels[tank] = value;
                }
            }
        }
        fitted
    }

    /// What the record says, as far as the search has come.
    pub fn report(&self) -> FitReport {
        let values = self.problem.values();
        let covariance = self.covariance(&values);
        let errors: Option<Vec<f64>> =
            covariance.as_ref().map(|covariance| covariance.diagonal().iter().map(|v| v.sqrt()).collect());
        let estimate = |(index, free): (usize, &Sought)| {
            let [low, high] = free.bounds;
            let margin = AT_BOUND * (high - low);
            Estimate {
                parameter: free.parameter,
                start: free.start,
                bounds: free.bounds,
                value: values[index],
                standard_error: errors.as_ref().map(|errors| errors[index]),
                is_at_bound: values[index] - low < margin || high - values[index] < margin,
            }
        };
        let estimates: Vec<Estimate> = self.problem.free.iter().enumerate().map(estimate).collect();
        let correlation = covariance.zip(errors).map(|(covariance, errors)| {
            let row = |i: usize| (0..errors.len()).map(|j| covariance[(i, j)] / (errors[i] * errors[j])).collect();
            (0..errors.len()).map(row).collect::<Vec<Vec<f64>>>()
        });
        FitReport {
            alike: correlation.as_deref().map(|correlation| alike(correlation, &estimates)).unwrap_or_default(),
            vague: (0..estimates.len())
                .filter(|&index| is_vague(&estimates[index], self.problem.free[index].bounds))
                .collect(),
            estimates,
            correlation,
            rmse: [self.first_rmse, self.rmse()],
            values: self.problem.count(),
            converged: self.converged,
        }
    }

    /// Covariance of the estimates, `s² (JᵀJ)⁻¹` with the variance s² of the residuals (Ljung 1999, §9.4).
    fn covariance(&self, values: &[f64]) -> Option<DMatrix<f64>> {
        let (residuals, slopes) = (self.problem.differences(values)?, self.problem.slopes(values)?);
        let freedom = residuals.len() - values.len();
        let variance = residuals.norm_squared() / freedom as f64;
        // In shares of the ranges, so that a small unit does not look like a singular matrix.
        let widths: Vec<f64> = self.problem.free.iter().map(|free| free.bounds[1] - free.bounds[0]).collect();
        let mut scaled = slopes;
        widths.iter().enumerate().for_each(|(index, &width)| scaled.column_mut(index).scale_mut(width));
        let factor = (scaled.transpose() * scaled).cholesky()?;
        let pivots = factor.l_dirty().diagonal();
        if pivots.min() <= SINGULAR * pivots.max() {
            return None;
        }
        let inverse = factor.inverse();
        Some(DMatrix::from_fn(values.len(), values.len(), |i, j| variance * inverse[(i, j)] * widths[i] * widths[j]))
    }
}

/// Starting values of the initial levels (m): the first recorded ones, else those of the operating point, within the walls; zero where
/// neither is known, a record without levels, which no fit accepts.
pub fn levels_at_start(setup: &Setup, record: &Record) -> [f64; 4] {
    first_levels(record, setup).unwrap_or_default()
}

fn rmse(problem: &Problem) -> Option<f64> {
    let differences = problem.differences(&problem.values())?;
    // Differences are in centimetres.
    Some(0.01 * (differences.norm_squared() / differences.len() as f64).sqrt())
}

/// Pairs whose estimates go together, and are not known well each by itself.
fn alike(correlation: &[Vec<f64>], estimates: &[Estimate]) -> Vec<[usize; 2]> {
    let is_sure = |index: usize| {
        estimates[index].standard_error.is_some_and(|error| error <= SURE * estimates[index].value.abs())
    };
    let pairs = (0..correlation.len()).flat_map(|i| (i + 1..correlation.len()).map(move |j| [i, j]));
    pairs.filter(|&[i, j]| correlation[i][j].abs() > ALIKE && !(is_sure(i) && is_sure(j))).collect()
}

/// Whether the standard error is a large share of the value, or, of what may well be 0, of the range of the search.
fn is_vague(estimate: &Estimate, [low, high]: [f64; 2]) -> bool {
    let least_told = match estimate.parameter {
        Parameter::LevelOffset(_) => f64::INFINITY,
        Parameter::PumpDelay(_) | Parameter::StartLevel(_) => VAGUE_SHARE * (high - low),
        _ => VAGUE * estimate.value.abs(),
    };
    estimate.standard_error.is_none_or(|error| error > least_told)
}

#[cfg(test)]
mod tests;
