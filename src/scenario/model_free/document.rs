use serde::{Deserialize, Serialize};

use crate::control::{DecentralisedPi, ModelFree};
use crate::plant::{OperatingPoint, QuadrupleTank, ValveSchedule};
use crate::scenario::{PlantSpec, ScenarioError};
use crate::sim::Experiment;

/// Where a run begins.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum StartSpec {
    /// At rest with these levels of tanks 1 and 2 (m), as the valves stand at the start.
    Rest([f64; 2]),
    /// With empty tanks and pumps that stand still.
    Empty,
}

/// Everything that a run under the model-free law depends on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ModelFreeSetup {
    /// The plant; its valves are those of the schedules.
    pub plant: PlantSpec,
    /// How the valve fractions γ1, γ2 move.
    pub valves: [ValveSchedule; 2],
    /// Where the run begins.
    pub start: StartSpec,
    /// The law.
    pub controller: ModelFree,
    /// Two PI loops to compare it with in the same experiment.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub compare: Option<DecentralisedPi>,
    /// What is done to the loops. Steps of the references count from the levels of the start.
    pub experiment: Experiment,
}

impl ModelFreeSetup {
    /// The rig, with its valves as they stand at a time (s).
    pub fn plant_at(&self, time_s: f64) -> QuadrupleTank {
        let rig = match self.plant {
            PlantSpec::Preset(id) => id.preset().plant,
            PlantSpec::Parameters { rig, .. } => rig,
        };
        rig.with_valves(self.valves.map(|valve| valve.at(time_s)))
    }

    /// When the last step or ramp of a valve within the experiment ends (s); 0 where there is none.
    pub fn valves_rest_from_s(&self) -> f64 {
        let breaks = self.valves.iter().flat_map(ValveSchedule::breaks_s).flatten();
        breaks.filter(|&time| time <= self.experiment.duration_s).fold(0.0, f64::max)
    }

    /// Levels and voltages that the run begins with.
    ///
    /// # Errors
    /// [`ScenarioError::Start`] when no input holds the given levels.
    pub fn start(&self) -> Result<OperatingPoint, ScenarioError> {
        match self.start {
            StartSpec::Rest(levels) => self.plant_at(0.0).rest_at(levels).map_err(ScenarioError::Start),
            StartSpec::Empty => Ok(OperatingPoint { levels: [0.0; 4], pump_voltage: [0.0; 2] }),
        }
    }
}

/// A run under the model-free law.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ModelFreeScenario {
    /// Version of the document: 3. It is checked before anything else is read.
    pub version: u32,
    /// The run.
    pub model_free: ModelFreeSetup,
}

impl ModelFreeScenario {
    /// The version of these documents.
    pub const VERSION: u32 = 3;
}

impl From<ModelFreeSetup> for ModelFreeScenario {
    fn from(model_free: ModelFreeSetup) -> Self {
        Self { version: Self::VERSION, model_free }
    }
}
