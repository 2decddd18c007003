//! What theory says of a setup of the model-free bench and what happens in its run, version 3.

use quadtank::control::ModelFreePoles;
use quadtank::linear::LinearError;
use quadtank::linear::Stability;
use quadtank::plant::{OperatingPoint, PlantError};
use quadtank::sim::{Event, TrackingMetrics, ZeroDynamicsEnd};
use quadtank::study::LinearPlant;
use quadtank::study::model_free::{ModelFreeAnalysis, ModelFreeAnswer, ModelFreeSetup, PredictedLoss};
use serde::Serialize;

use super::{Answer, ComplexNumber, complex_numbers};

/// Steps along each side of the outline of the levels that can be held.
const OUTLINE_STEPS: u32 = 8;

/// What theory says at the references that a run ends with, with the valves where they come to rest.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ModelFreeAnalysisReport {
    /// Where the loops should end: levels (m) and pump voltages (V), or why nothing holds those levels.
    pub rest: Answer<OperatingPoint, PlantError>,
    /// The plant there; null where there is no rest.
    pub at_rest: Option<MomentReport>,
    /// The linear loop there, the estimator included; null where there is no rest.
    pub closed_loop: Option<Answer<LoopPoles>>,
    /// Poles of the loop in continuous time without estimator there (1/s); null where there is no rest.
    pub continuous_poles_without_estimator: Option<Answer<Vec<ComplexNumber>>>,
    /// Smallest α̂ of a stable loop there (m/(s V)); null where there is none.
    pub smallest_model_gain: Option<f64>,
    /// The same of each lower tank alone and without drain (m/(s V)); null where there is no rest.
    pub smallest_model_gain_of_integrators: Option<[f64; 2]>,
    /// Outline of the levels 1 and 2 (m) that the pumps can hold, walls ignored.
    pub levels_in_range_of_the_pumps: Vec<[f64; 2]>,
}

/// What linear theory says of the plant at one moment.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MomentReport {
    /// Valve fractions γ1, γ2 (no unit).
    pub valves: [f64; 2],
    /// Transmission zeros (1/s), one of them exactly zero where G(0) is singular.
    pub zeros: Answer<Vec<ComplexNumber>>,
    /// Relative gain λ11 (no unit); null where G(0) is singular.
    pub rga_11: Option<f64>,
    /// Niederlinski index of the diagonal pairing (no unit); null where it is not defined.
    pub niederlinski_diagonal: Option<f64>,
    /// Niederlinski index of the swapped pairing (no unit); null where it is not defined.
    pub niederlinski_swapped: Option<f64>,
}

/// Poles of the linear loop of a law that does not touch its limits.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LoopPoles {
    /// Whether the loop is stable.
    pub stability: Stability,
    /// Its poles in the s-plane (1/s), by falling real part.
    pub poles: Vec<ComplexNumber>,
}

/// What happens in the run of a setup.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ModelFreeReport {
    /// How loops 1 and 2 did.
    pub figures: [TrackingMetrics; 2],
    /// The same of two PI loops in the same experiment; null where none are asked for.
    pub comparison: Option<[TrackingMetrics; 2]>,
    /// Whether the figures of the responses are those of the same experiment without noise, since this one has some.
    pub judged_without_noise: bool,
    /// What the zero dynamics foretell once both levels are held; null where they never are, while valves move, and where the
    /// linear loop is stable.
    pub predicted: Option<PredictedLossReport>,
    /// What happened to tanks and pumps, in order; each kind once, when it first began.
    pub events: Vec<Event>,
}

/// When the upper tanks will end the tracking.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PredictedLossReport {
    /// From when on it is predicted (s).
    pub from_s: f64,
    /// When and how it ends; null when it goes on.
    pub ends: Option<EndsReport>,
}

/// What ends the holding of both levels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
pub enum EndsReport {
    /// A pump would have to leave its limits.
    Pump {
        /// Number of the pump, 1 or 2.
        pump_at_its_limit: usize,
        /// When, from the time of the prediction on (s).
        after_s: f64,
    },
    /// An upper tank runs over.
    Tank {
        /// Number of the tank, 3 or 4.
        tank_runs_over: usize,
        /// When, from the time of the prediction on (s).
        after_s: f64,
    },
}

impl ModelFreeAnalysisReport {
    /// The report of the analysis of a setup.
    pub fn of(setup: &ModelFreeSetup, found: &ModelFreeAnalysis) -> Self {
        let plant = setup.plant_at(setup.valves_rest_from_s());
        Self {
            rest: Answer::of(&found.rest, |rest| *rest),
            at_rest: found.linear.as_ref().map(|linear| MomentReport::of(plant.valves, linear)),
            closed_loop: found.poles.as_ref().map(|poles| Answer::of(poles, LoopPoles::from)),
            continuous_poles_without_estimator: found
                .continuous_poles
                .as_ref()
                .map(|poles| Answer::of(poles, |poles| complex_numbers(poles))),
            smallest_model_gain: found.smallest_model_gain,
            smallest_model_gain_of_integrators: found.smallest_of_integrators,
            levels_in_range_of_the_pumps: plant.feasible_outline(OUTLINE_STEPS),
        }
    }
}

impl MomentReport {
    fn of(valves: [f64; 2], linear: &Result<LinearPlant, LinearError>) -> Self {
        let plant = linear.as_ref().ok();
        let [niederlinski_diagonal, niederlinski_swapped] = plant.map_or([None; 2], |plant| plant.niederlinski);
        let zeros = linear.as_ref().map_err(|&error| error).and_then(|plant| plant.zeros.clone());
        Self {
            valves,
            zeros: Answer::of(&zeros, |zeros| zeros.iter().map(|zero| zero.value.into()).collect()),
            rga_11: plant.and_then(|plant| plant.rga_11.ok()),
            niederlinski_diagonal,
            niederlinski_swapped,
        }
    }
}

impl From<&ModelFreePoles> for LoopPoles {
    fn from(poles: &ModelFreePoles) -> Self {
        Self { stability: poles.stability, poles: complex_numbers(&poles.poles_s) }
    }
}

impl From<&ModelFreeAnswer> for ModelFreeReport {
    fn from(found: &ModelFreeAnswer) -> Self {
        Self {
            figures: found.figures,
            comparison: found.comparison.as_ref().map(|(_, figures)| *figures),
            judged_without_noise: found.judged_without_noise,
            predicted: found.predicted.map(PredictedLossReport::from),
            events: found.run.trajectory.events.clone(),
        }
    }
}

impl From<PredictedLoss> for PredictedLossReport {
    fn from(predicted: PredictedLoss) -> Self {
        Self { from_s: predicted.from_s, ends: predicted.ends.map(EndsReport::from) }
    }
}

impl From<ZeroDynamicsEnd> for EndsReport {
    fn from(ends: ZeroDynamicsEnd) -> Self {
        match ends {
            ZeroDynamicsEnd::Pump { pump, after_s } => Self::Pump { pump_at_its_limit: pump + 1, after_s },
            ZeroDynamicsEnd::Overflow { tank, after_s } => Self::Tank { tank_runs_over: tank + 1, after_s },
        }
    }
}
