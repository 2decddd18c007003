//! What theory says of a level loop, what happens in its run and what a search finds, version 4. Gains are per signal; signals are in
//! the units of their ranges.

mod run;
mod search;
mod tuning;

use quadtank::assess::LoopQuality;
use quadtank::plant::level::{LevelError, LevelGains, LevelSignals};
use quadtank::study::level_loop::{PlantAnswer, Results, StepTestAnswer, StepTestError};
use quadtank::tuning::{ProcessModel, ReactionError, ReactionFit, Regulation, RegulationError, UltimatePoint};
use serde::Serialize;

pub use run::{HarrisReport, IndexReport, IndicesReport, LevelLoopReport, ObjectiveOf};
pub use search::{EvaluatedReport, LevelSearchReport, MethodName, TradeOffReport, TradeOffRow};
pub use tuning::{PiReport, RuleName, SuggestionReport};

use super::Answer;
use super::tuning::LoopStabilityReport;
use crate::level_loop::{LevelLoopWarning, warnings};

/// What theory says of a level loop at the rest where its experiment begins.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LevelLoopAnalysisReport {
    /// The signals at rest at every element, or why the loop cannot hold that level.
    pub rest: Answer<LevelSignals, LevelError>,
    /// The linear model there; null where there is no rest.
    pub linear: Option<LinearReport>,
    /// Where the linear loop oscillates under proportional control; null where it never does.
    pub ultimate_point: Option<UltimatePointReport>,
    /// The linear loop with the controller; null for an output by hand, and where there is no rest.
    pub closed_loop: Option<Answer<ClosedLoopReport>>,
    /// What the step test says, or why it cannot be run.
    pub step_test: Answer<StepTestReport, StepTestError>,
    /// What rules suggest, by the model of the test or the one of the rest as the document says.
    pub suggestions: Vec<SuggestionReport>,
    /// What the document may not have been meant to say.
    pub warnings: Vec<LevelLoopWarning>,
}

/// The linear model of a level loop, `K/((τ s + 1)(τ_a s + 1)(τ_t s + 1))`, or `K'/s` in the place of `K/(τ s + 1)`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LinearReport {
    /// Resistance R = dh/dq (s/m²); null for a tank that integrates, as one with a closed outlet does.
    pub resistance: Option<f64>,
    /// Time constant τ = R A (s); null for a tank that integrates.
    pub time_constant_s: Option<f64>,
    /// Gain K (signal per signal); null for a tank that integrates.
    pub gain: Option<f64>,
    /// Slope K' = K/τ (1/s); null where the valve opens infinitely quickly.
    pub slope_gain: Option<f64>,
    /// Net flow into the tank per unit of output (m³/s per signal); null likewise.
    pub flow_gain: Option<f64>,
    /// Gain of the transmitter (signal per m).
    pub transmitter_gain: f64,
    /// Lag of the actuator (s).
    pub actuator_lag_s: f64,
    /// Lag of the transmitter (s).
    pub transmitter_lag_s: f64,
    /// The same as a process with one lag and a dead time, by the half rule; null where its numbers are not finite.
    pub model: Option<ProcessModel>,
}

/// The gain and the period of an oscillation under proportional control.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct UltimatePointReport {
    /// Gain Kc (signal per signal).
    pub gain: f64,
    /// Period Tc (s).
    pub period_s: f64,
}

/// Stability and margins of the linear loop with its controller. A margin is null where there is none or it is not computed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ClosedLoopReport {
    /// Whether it is stable; frequencies are in rad/s.
    pub stability: LoopStabilityReport,
    /// Sensitivity peak Ms (no unit); null for a loop that is not stable.
    pub sensitivity_peak: Option<f64>,
    /// Smallest factor above 1 on the gain at which the loop oscillates (no unit).
    pub gain_margin: Option<f64>,
    /// Largest factor below 1 at which it does (no unit).
    pub lower_gain_margin: Option<f64>,
    /// Smallest phase lag at which it does (rad).
    pub phase_margin_rad: Option<f64>,
}

/// What a step test says.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StepTestReport {
    /// The model that is read from the record, or why there is none.
    pub fit: Answer<FitReport, ReactionError>,
    /// Whether the tank finds a level of its own; null for a test without a step back.
    pub regulation: Option<Answer<Regulation, RegulationError>>,
}

/// A process model with the points of the reaction curve from which it is read.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FitReport {
    /// The model.
    pub model: ProcessModel,
    /// The transmitter signal before the step and at the end.
    pub ends: [f64; 2],
    /// When 28.3 and 63.2 % of the change were reached (s after the step); null for a ramp.
    pub times_s: Option<[f64; 2]>,
}

/// A number, unless it is infinite or none.
fn finite(number: f64) -> Option<f64> {
    number.is_finite().then_some(number)
}

fn is_finite(model: &ProcessModel) -> bool {
    let numbers = match *model {
        ProcessModel::SelfRegulating { gain, time_constant_s, dead_time_s } => [gain, time_constant_s, dead_time_s],
        ProcessModel::Integrating { slope, dead_time_s } => [slope, dead_time_s, 0.0],
    };
    numbers.into_iter().all(f64::is_finite)
}

impl LevelLoopAnalysisReport {
    /// The report of the results of a setup.
    pub fn of(found: &Results) -> Self {
        let setup = &*found.setup;
        let plant = found.plant.as_ref();
        let at_rest = plant.as_ref().ok();
        let quality = at_rest.and_then(|plant| LoopQuality::of(&plant.gains, &setup.controller).transpose());
        Self {
            rest: Answer::of(plant, |plant| plant.rest),
            linear: at_rest.map(LinearReport::from),
            ultimate_point: at_rest.and_then(|plant| plant.ultimate).map(UltimatePointReport::from),
            closed_loop: quality.map(|quality| Answer::of(&quality, ClosedLoopReport::from)),
            step_test: Answer::of(&*found.test, StepTestReport::from),
            suggestions: SuggestionReport::all(setup, &found.suggestions),
            warnings: warnings(setup),
        }
    }
}

impl From<&PlantAnswer> for LinearReport {
    fn from(plant: &PlantAnswer) -> Self {
        let gains: &LevelGains = &plant.gains;
        Self {
            resistance: gains.resistance.and_then(finite),
            time_constant_s: gains.time_constant().and_then(finite),
            gain: gains.process_gain().and_then(finite),
            slope_gain: finite(gains.slope_gain()),
            flow_gain: finite(gains.flow_gain),
            transmitter_gain: gains.transmitter_gain,
            actuator_lag_s: gains.actuator_lag_s,
            transmitter_lag_s: gains.transmitter_lag_s,
            model: is_finite(&plant.model).then_some(plant.model),
        }
    }
}

impl From<UltimatePoint> for UltimatePointReport {
    fn from(point: UltimatePoint) -> Self {
        Self { gain: point.gain, period_s: point.period }
    }
}

impl From<&LoopQuality> for ClosedLoopReport {
    fn from(quality: &LoopQuality) -> Self {
        Self {
            stability: quality.stability.into(),
            sensitivity_peak: quality.sensitivity_peak().and_then(finite),
            gain_margin: quality.margins.and_then(|margins| margins.gain_up),
            lower_gain_margin: quality.margins.and_then(|margins| margins.gain_down),
            phase_margin_rad: quality.margins.and_then(|margins| margins.phase),
        }
    }
}

impl From<&StepTestAnswer> for StepTestReport {
    fn from(test: &StepTestAnswer) -> Self {
        Self {
            fit: Answer::of(&test.fit, FitReport::from),
            regulation: test.regulation.as_ref().map(|regulation| Answer::of(regulation, |regulation| *regulation)),
        }
    }
}

impl From<&ReactionFit> for FitReport {
    fn from(fit: &ReactionFit) -> Self {
        Self { model: fit.model, ends: fit.ends, times_s: fit.times_s }
    }
}
