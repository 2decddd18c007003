use serde::{Deserialize, Serialize};

use crate::control::{AntiWindup, IsaPid, level_loop};
use crate::plant::level::LevelPlant;
use crate::sim::level::{LevelController, LevelExperiment, LevelFigures, LevelLog, LevelRunError, LevelSimulation};

/// What a level loop is judged by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum CostMeasure {
    /// Variance of the level (m²): tight control (Andreis 2017, Eqs. 47, 48).
    LevelVariance,
    /// Variance of the outflow ((m³/s)²): averaging control (Andreis 2017, Eqs. 49, 50).
    OutflowVariance,
    /// Integral of the absolute error (m s).
    Iae,
    /// Integral of the square of the error (m² s).
    Ise,
    /// Integral of time times the absolute error (m s²).
    Itae,
}

/// Cost of a level loop: a measure, a penalty on the moves of the output, and constraints.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct LevelCost {
    /// The measure.
    pub measure: CostMeasure,
    /// Weight of the sum of the squared moves of the output from row to row (unit of the measure per squared unit of
    /// the output).
    pub move_penalty: f64,
    /// Largest sensitivity peak Ms of the linear loop; `None` for any loop.
    pub largest_sensitivity: Option<f64>,
    /// Levels (m) between which the level has to stay, such as 30 and 70 % of the range; `None` for any level.
    pub level_band: Option<[f64; 2]>,
}

impl LevelCost {
    /// A measure alone.
    pub const fn plain(measure: CostMeasure) -> Self {
        Self { measure, move_penalty: 0.0, largest_sensitivity: None, level_band: None }
    }
}

/// Evaluation of a pair of settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Evaluation {
    /// The cost of settings that keep to all constraints.
    Cost(f64),
    /// By what share a constraint is violated: Ms of its limit, the level of the width of its band. Infinite for an unstable loop.
    Violates(f64),
    /// The loop has no run.
    NoRun(LevelRunError),
}

/// Smallest cost of settings that violate a constraint; feasible costs are below it (Deb 2000). It is beyond all costs of a
/// document, and small enough for the squares of differences of it.
pub const VIOLATION: f64 = 1e100;
/// Largest relative violation that is distinguished.
const WORST: f64 = 1e6;

impl Evaluation {
    /// The cost for a search: every feasible pair costs less than any that violates a constraint, and those cost more the larger the
    /// violation (Deb 2000). Infinite for settings without a run.
    pub fn cost(&self) -> f64 {
        match *self {
            Self::Cost(cost) => cost.min(VIOLATION.next_down()),
            Self::Violates(share) => VIOLATION * (1.0 + share.min(WORST)),
            Self::NoRun(_) => f64::INFINITY,
        }
    }
}

/// A level loop whose PI settings are sought.
#[derive(Clone, Debug)]
pub struct LevelProblem {
    simulation: LevelSimulation,
    transmitter_gain: f64,
    cost: LevelCost,
    anti_windup: AntiWindup,
    log: LevelLog,
}

impl LevelProblem {
    /// Prepares the runs.
    ///
    /// # Errors
    /// As [`LevelSimulation::new`].
    pub fn new(
        plant: &LevelPlant,
        experiment: &LevelExperiment,
        cost: LevelCost,
        anti_windup: AntiWindup,
    ) -> Result<Self, LevelRunError> {
        let simulation = LevelSimulation::new(plant, experiment)?;
        let transmitter_gain = plant.transmitter.gain();
        Ok(Self { simulation, transmitter_gain, cost, anti_windup, log: LevelLog::default() })
    }

    /// Cost of a gain and an integral time (s) for a search, see [`Evaluation::cost`].
    pub fn cost(&mut self, settings: [f64; 2]) -> f64 {
        self.evaluate(settings).cost()
    }

    /// Evaluates a gain and an integral time (s).
    pub fn evaluate(&mut self, [gain, integral_time_s]: [f64; 2]) -> Evaluation {
        let controller = LevelController::Pi { gain, integral_time_s, anti_windup: self.anti_windup };
        if let Err(error) = controller.check() {
            return Evaluation::NoRun(error);
        }
        if let Some(share) = self.sensitivity_violation(gain, integral_time_s) {
            return Evaluation::Violates(share);
        }
        if let Err(error) = self.simulation.run_into(&controller, &mut self.log) {
            return Evaluation::NoRun(error);
        }
        // A run has two rows at least.
        let Some(figures) = LevelFigures::of(&self.log, self.transmitter_gain) else {
            return Evaluation::Violates(f64::INFINITY);
        };
        if let Some(share) = self.band_violation(&figures) {
            return Evaluation::Violates(share);
        }
        let measured = match self.cost.measure {
            CostMeasure::LevelVariance => figures.level.variance,
            CostMeasure::OutflowVariance => figures.outflow.variance,
            CostMeasure::Iae => figures.iae,
            CostMeasure::Ise => figures.ise,
            CostMeasure::Itae => figures.itae,
        };
        Evaluation::Cost(measured + self.cost.move_penalty * figures.squared_moves)
    }

    /// By what share Ms is too large; `None` where it is not.
    fn sensitivity_violation(&self, gain: f64, integral_time_s: f64) -> Option<f64> {
        let largest = self.cost.largest_sensitivity?;
        let peak = sensitivity_peak(&self.simulation, gain, integral_time_s).unwrap_or(f64::INFINITY);
        (peak > largest).then(|| peak / largest - 1.0)
    }

    /// By what share of its width the level leaves the band; `None` where it does not.
    fn band_violation(&self, figures: &LevelFigures) -> Option<f64> {
        let [low, high] = self.cost.level_band?;
        let beyond = (low - figures.level.minimum).max(figures.level.maximum - high);
        (beyond > 0.0).then(|| beyond / (high - low).max(f64::MIN_POSITIVE))
    }
}

/// Ms of the linear loop around the rest of a simulation; `None` for an unstable loop, or where it is not computed.
pub fn sensitivity_peak(simulation: &LevelSimulation, gain: f64, integral_time_s: f64) -> Option<f64> {
    let pid = IsaPid { gain, integral_time: integral_time_s, derivative_time: 0.0 };
    level_loop(simulation.gains(), &pid.into(), 0.0, 0.0).ok()?.sensitivity_peak()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::literature::andreis::{self, PublishedDisturbance};

    #[test]
    fn whatever_keeps_to_the_constraints_costs_less_than_what_does_not() {
        let experiment = PublishedDisturbance::Random.experiment();
        let plant = andreis::plant();
        let problem = |cost| LevelProblem::new(&plant, &experiment, cost, AntiWindup::Off).unwrap();
        let plain = LevelCost::plain(CostMeasure::LevelVariance);
        let feasible = problem(LevelCost { move_penalty: 1e12, ..plain }).cost([50.0, 100.0]);
        let narrow = Some([experiment.level, experiment.level + 1e-3]);
        let infeasible = problem(LevelCost { level_band: narrow, ..plain }).cost([50.0, 100.0]);
        assert!(feasible > 1e12 && feasible < infeasible, "{feasible:e} {infeasible:e}");
        let worst = [Evaluation::Cost(f64::MAX), Evaluation::Cost(f64::INFINITY)].map(|feasible| feasible.cost());
        assert!(worst.iter().all(|&cost| cost < Evaluation::Violates(0.0).cost()));
        assert!(Evaluation::Violates(f64::INFINITY).cost() < f64::INFINITY);
    }
}
