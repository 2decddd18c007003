use quadtank::study::level_loop::{LevelSearch, PiTuning, Results, SearchMethod, TradeOff, TradeOffPoint, trade_off};
use quadtank::tuning::VIOLATION;
use quadtank::tuning::search::Evaluated;
use serde::Serialize;

use super::{PiReport, SuggestionReport};
use crate::level_loop::{LevelLoopWarning, warnings};

/// What a search for PI settings finds.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LevelSearchReport {
    /// The method.
    pub method: MethodName,
    /// The best settings; null where none was evaluated.
    pub best: Option<EvaluatedReport>,
    /// How many settings were evaluated.
    pub evaluations: usize,
    /// Where the search stood after each step, simplex or generation.
    pub path: Vec<EvaluatedReport>,
    /// What rules suggest.
    pub suggestions: Vec<SuggestionReport>,
    /// Variance of the level against that of the outflow.
    pub trade_off: TradeOffReport,
    /// What the document may not have been meant to say.
    pub warnings: Vec<LevelLoopWarning>,
}

/// The name of a method of search.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum MethodName {
    /// Steepest descent.
    Gradient,
    /// The simplex of Nelder and Mead.
    NelderMead,
    /// A genetic search.
    Genetic,
}

/// Settings with their cost.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EvaluatedReport {
    /// Gain Kp (signal per signal).
    pub gain: f64,
    /// Integral time Ti (s).
    pub integral_time_s: f64,
    /// Their cost, in the unit of the measure; null for settings that violate a constraint or have no run.
    pub cost: Option<f64>,
}

/// Variance of the level against that of the outflow. A row is null where it is of settings without a run, or of none.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TradeOffReport {
    /// Over the gains of the search, with the integral time of the controller.
    pub curve: Vec<TradeOffRow>,
    /// With the tuning of the document.
    pub current: Option<TradeOffRow>,
    /// With the reference, on the plant.
    pub reference: Option<TradeOffRow>,
    /// With the best settings of the search.
    pub best: Option<TradeOffRow>,
}

/// A tuning with its variances.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TradeOffRow {
    /// The tuning.
    pub tuning: PiReport,
    /// Variance of the level (m²).
    pub level_variance: f64,
    /// Variance of the outflow ((m³/s)²).
    pub outflow_variance: f64,
}

impl LevelSearchReport {
    /// The report of a search that was made for the setup of some results, whose present tuning is another, if it has one.
    pub fn of(found: &Results, method: SearchMethod, search: &LevelSearch, current: Option<PiTuning>) -> Self {
        let setup = &*found.setup;
        let best = search.best();
        let best_tuning = best.map(|best| PiTuning { gain: best.point[0], integral_time_s: best.point[1] });
        let asked = [current, Some(setup.reference), best_tuning];
        let tunings: Vec<PiTuning> = asked.into_iter().flatten().collect();
        let trade_off = trade_off(setup, &tunings);
        Self {
            method: method.into(),
            best: best.map(EvaluatedReport::from),
            evaluations: search.evaluations(),
            path: search.path().iter().copied().map(EvaluatedReport::from).collect(),
            suggestions: SuggestionReport::all(setup, &found.suggestions),
            trade_off: TradeOffReport::of(&trade_off, asked),
            warnings: warnings(setup),
        }
    }
}

impl TradeOffReport {
    /// Reports a trade-off whose points are those of the `asked` tunings that are not `None`, in their order.
    fn of(found: &TradeOff, asked: [Option<PiTuning>; 3]) -> Self {
        let mut points = found.points.iter();
        let [current, reference, best] =
            asked.map(|tuning| tuning.and_then(|_| points.next().copied().flatten()).map(TradeOffRow::from));
        Self { curve: found.curve.iter().copied().map(TradeOffRow::from).collect(), current, reference, best }
    }
}

impl From<SearchMethod> for MethodName {
    fn from(method: SearchMethod) -> Self {
        match method {
            SearchMethod::Gradient(_) => Self::Gradient,
            SearchMethod::NelderMead(_) => Self::NelderMead,
            SearchMethod::Genetic(_) => Self::Genetic,
        }
    }
}

impl From<Evaluated<2>> for EvaluatedReport {
    fn from(found: Evaluated<2>) -> Self {
        let [gain, integral_time_s] = found.point;
        Self { gain, integral_time_s, cost: (found.cost < VIOLATION).then_some(found.cost) }
    }
}

impl From<TradeOffPoint> for TradeOffRow {
    fn from(point: TradeOffPoint) -> Self {
        Self { tuning: point.tuning.into(), level_variance: point.level, outflow_variance: point.outflow }
    }
}
