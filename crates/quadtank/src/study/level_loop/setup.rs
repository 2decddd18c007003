use serde::{Deserialize, Serialize};

use crate::control::AntiWindup;
use crate::literature::{LevelPresetId, andreis};
use crate::plant::level::LevelPlant;
use crate::sim::level::{LevelController, LevelExperiment};
use crate::tuning::search::{Axis, AxisScale};
use crate::tuning::{CostMeasure, LevelCost, PiTuning, ReactionMethod};

/// The loop of a setup: a published one by name, or all its parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[expect(clippy::large_enum_variant, reason = "one per setup, and plain data is easier to share than a box")]
pub enum LevelPlantSpec {
    /// A published loop.
    Preset(LevelPresetId),
    /// A loop of one's own.
    Parameters(LevelPlant),
}

impl LevelPlantSpec {
    /// The plant.
    pub fn plant(&self) -> LevelPlant {
        match self {
            Self::Preset(id) => id.plant(),
            Self::Parameters(plant) => plant.clone(),
        }
    }
}

/// A step test by hand, and how it is read.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct StepTestSpec {
    /// Level at the start (m).
    pub level: f64,
    /// Inflow (m³/s).
    pub inflow: f64,
    /// Step of the controller output, in its unit.
    pub step: f64,
    /// When it comes (s).
    pub step_time_s: f64,
    /// When the output steps back (s), to tell self-regulating from integrating; `None` for one step.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub return_time_s: Option<f64>,
    /// Length of the test (s).
    pub duration_s: f64,
    /// How a model is read from it.
    pub method: ReactionMethod,
}

/// What the loop is for (Andreis 2017, §2.5).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Objective {
    /// The level is to stay at its set-point.
    Tight,
    /// The tank is to absorb the disturbance, the level within a band (m).
    Averaging {
        /// Lowest and highest level; 30 to 70 % of the range is usual (Foley 2000; Horton 2003).
        band: [f64; 2],
    },
}

/// Where the rules take their model from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum ModelSource {
    /// The step test.
    Test,
    /// The linear model around the rest of the experiment, by the half rule.
    Local,
}

/// How the model on which tunings are compared differs from the plant.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ModelError {
    /// Area of the model over that of the plant.
    pub area_factor: f64,
    /// Flows of the model over those of the plant: the ratio of the valve coefficients.
    pub flow_factor: f64,
}

impl ModelError {
    /// None.
    pub const NONE: Self = Self { area_factor: 1.0, flow_factor: 1.0 };
}

/// What is searched, and within which limits.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SearchSpec {
    /// Limits of the gain.
    pub gain: [f64; 2],
    /// Limits of the integral time (s).
    pub integral_time_s: [f64; 2],
    /// The cost. Its band is that of averaging control when `keep_band` is set.
    pub measure: CostMeasure,
    /// Added to the cost for each square of a move of the output.
    #[serde(default)]
    pub move_penalty: f64,
    /// Largest sensitivity peak Ms of the linear loop.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub largest_sensitivity: Option<f64>,
    /// Whether the level has to stay in the band of the objective.
    #[serde(default)]
    pub keep_band: bool,
}

impl SearchSpec {
    /// The box, divided by logarithms.
    pub fn axes(&self) -> [Axis; 2] {
        [self.gain, self.integral_time_s].map(|[low, high]| Axis { low, high, scale: AxisScale::Logarithmic })
    }

    /// Whether gain and integral time (s) of a point are at an end of the box, within a thousandth of it in the logarithm.
    pub fn at_bounds(&self, point: [f64; 2]) -> [bool; 2] {
        let axes = self.axes();
        [0, 1].map(|k| {
            let share = axes[k].share(point[k]);
            !(0.001..=0.999).contains(&share)
        })
    }

    /// Settings moved into the box.
    pub fn clip(&self, tuning: PiTuning) -> PiTuning {
        let within = |value: f64, [low, high]: [f64; 2]| value.max(low).min(high);
        PiTuning {
            gain: within(tuning.gain, self.gain),
            integral_time_s: within(tuning.integral_time_s, self.integral_time_s),
        }
    }
}

/// How the Harris index is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Harris {
    /// Dead time in rows of the log, that of the sampling included.
    pub dead_time_rows: usize,
    /// Order of the autoregressive model.
    pub order: usize,
}

/// Everything that the bench depends on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct LevelLoopSetup {
    /// The plant.
    pub plant: LevelPlantSpec,
    /// The step test.
    pub test: StepTestSpec,
    /// What the loop is for.
    pub objective: Objective,
    /// Where the rules take their model from.
    pub model_source: ModelSource,
    /// Closed-loop time constant that is asked of SIMC and Lambda tuning (s).
    pub closed_loop_time_s: f64,
    /// The controller.
    pub controller: LevelController,
    /// The tuning that the controller is held against, on the model with its error.
    pub reference: PiTuning,
    /// Error of that model.
    pub model_error: ModelError,
    /// What is done to the loop.
    pub experiment: LevelExperiment,
    /// What is searched.
    pub search: SearchSpec,
    /// How the Harris index is computed.
    pub harris: Harris,
}

impl LevelLoopSetup {
    /// The plant.
    pub fn plant(&self) -> LevelPlant {
        self.plant.plant()
    }

    /// The model of the plant on which the reference is computed.
    pub fn model(&self) -> LevelPlant {
        let plant = self.plant();
        plant.with_model_error(plant.tank.area * self.model_error.area_factor, self.model_error.flow_factor)
    }

    /// The cost that is searched.
    pub fn cost(&self) -> LevelCost {
        let band = match self.objective {
            Objective::Averaging { band } if self.search.keep_band => Some(band),
            _ => None,
        };
        LevelCost {
            measure: self.search.measure,
            move_penalty: self.search.move_penalty,
            largest_sensitivity: self.search.largest_sensitivity,
            level_band: band,
        }
    }

    /// The anti-windup of the controller; a search gives it to all candidates.
    pub fn anti_windup(&self) -> AntiWindup {
        match &self.controller {
            LevelController::Pi { anti_windup, .. } => *anti_windup,
            LevelController::Sampled { settings, .. } => settings.anti_windup,
            LevelController::Manual { .. } | LevelController::Pid { .. } => AntiWindup::Off,
        }
    }

    /// The integral time (s) of the controller where it is a PI controller.
    pub fn integral_time_s(&self) -> Option<f64> {
        match &self.controller {
            LevelController::Pi { integral_time_s, .. } => Some(*integral_time_s),
            LevelController::Sampled { settings, .. } => Some(settings.integral_time_s),
            LevelController::Manual { .. } | LevelController::Pid { .. } => None,
        }
    }

    /// Whether the set-point changes during the run. The variance of the level (m²) then contains the set-point change itself: a
    /// loop that stays below the new set-point has a smaller variance and a better index.
    pub fn steps_set_point(&self) -> bool {
        let experiment = &self.experiment;
        experiment.set_point_steps.iter().any(|step| step.size != 0.0 && step.time_s <= experiment.duration_s)
    }

    /// Dead time of the Harris index (s).
    pub fn harris_dead_time_s(&self) -> f64 {
        self.harris.dead_time_rows as f64 * self.experiment.log_step_s
    }

    /// The set-point (m) after all of its steps within the run.
    pub fn final_set_point(&self) -> f64 {
        let (experiment, transmitter) = (&self.experiment, self.plant().transmitter);
        let steps = experiment.set_point_steps.iter().filter(|step| step.time_s <= experiment.duration_s);
        steps.fold(experiment.level, |level, step| level + experiment.step_in_metres(step, &transmitter))
    }

    /// The same controller and reference in the experiment, on the plant and the model of another setup: how a pinned setup is
    /// compared.
    #[must_use]
    pub fn in_experiment_of(&self, other: &Self) -> Self {
        Self { controller: self.controller.clone(), reference: self.reference, ..other.clone() }
    }
}

/// The plant of Andreis (2017) with its current controller under Sine L, and the step test of the source.
impl Default for LevelLoopSetup {
    fn default() -> Self {
        super::published_setup(LevelPresetId::Andreis, andreis::PublishedDisturbance::SineL)
    }
}
