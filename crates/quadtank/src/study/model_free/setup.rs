use serde::{Deserialize, Serialize};

use crate::control::{DecentralisedPi, ModelFree};
use crate::literature::PresetId;
use crate::literature::junqueira::{PublishedExperiment, PublishedValves};
use crate::plant::{OperatingPoint, QuadrupleTank, ValveSchedule};
use crate::sim::{Experiment, SetPointStep};
use crate::study::StudyError;
use crate::study::quadruple_tank::{PlantSpec, setup_of};

/// Where a run begins.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum StartSpec {
    /// At rest with these levels of tanks 1 and 2 (m), as the valves stand at the start.
    Rest([f64; 2]),
    /// With empty tanks and pumps that stand still.
    Empty,
}

/// Everything that a run under the model-free law depends on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compare: Option<DecentralisedPi>,
    /// What is done to the loops. Steps of the references count from the levels of the start.
    pub experiment: Experiment,
}

impl ModelFreeSetup {
    /// A published case under the published law.
    pub fn published(valves: PublishedValves, experiment: PublishedExperiment) -> Self {
        let (levels, experiment) = experiment.parts();
        Self {
            plant: PlantSpec::Preset(PresetId::JunqueiraA),
            valves: valves.schedules(),
            start: levels.map_or(StartSpec::Empty, StartSpec::Rest),
            controller: ModelFree::PUBLISHED,
            compare: None,
            experiment,
        }
    }

    /// The rig, with its valves as they stand at a time (s).
    pub fn plant_at(&self, time_s: f64) -> QuadrupleTank {
        self.plant.rig().with_valves(self.valves.map(|valve| valve.at(time_s)))
    }

    /// When the last step or ramp of a valve within the experiment ends (s); 0 where there is none.
    pub fn valves_rest_from_s(&self) -> f64 {
        let breaks = self.valves.iter().flat_map(ValveSchedule::breaks_s).flatten();
        breaks.filter(|&time| time <= self.experiment.duration_s).fold(0.0, f64::max)
    }

    /// By how much the reference of a level (index) steps in all (m).
    pub fn set_point_step(&self, level: usize) -> f64 {
        self.experiment.reference_after(level, 0.0, f64::INFINITY)
    }

    /// Makes the last step of the reference of a level (index) such that it steps by `size` (m) in all; a level that has no step
    /// gets one when the other one steps.
    pub fn set_set_point_step(&mut self, level: usize, size: f64) {
        let by = size - self.set_point_step(level);
        let steps = &mut self.experiment.set_point_steps;
        if let Some(step) = steps.iter_mut().rev().find(|step| step.level == level) {
            step.size += by;
        } else {
            let time_s = steps.first().map_or(0.0, |step| step.time_s);
            steps.push(SetPointStep { level, time_s, size: by });
        }
    }

    /// What the reference of a level (index) may step by in all, from the bottom of its tank to the brim (m).
    pub fn set_point_steps(&self, level: usize) -> (f64, f64) {
        let start = match self.start {
            StartSpec::Rest(levels) => levels[level],
            StartSpec::Empty => 0.0,
        };
        (-start, self.plant_at(0.0).tanks[level].height - start)
    }

    /// The shortest run in which each reference has stepped for ten samples (s).
    pub fn shortest_s(&self) -> f64 {
        let last = self.experiment.set_point_steps.iter().map(|step| step.time_s).fold(0.0, f64::max);
        last + 10.0 * self.controller.sampling_time_s
    }

    /// Two PI loops to compare with. The source has none: these are ours for its rig, diagonal where most water goes straight
    /// down, swapped where it does not.
    pub fn usual_pi(&self) -> DecentralisedPi {
        let straight: f64 = self.valves.iter().map(ValveSchedule::midpoint).sum();
        setup_of(if straight >= 1.0 { PresetId::JunqueiraA } else { PresetId::JunqueiraB }).controller
    }

    /// Levels and voltages that the run begins with.
    ///
    /// # Errors
    /// [`StudyError`] at `start` when no input holds the given levels.
    pub fn start(&self) -> Result<OperatingPoint, StudyError> {
        match self.start {
            StartSpec::Rest(levels) => self.plant_at(0.0).rest_at(levels).map_err(StudyError::at("start")),
            StartSpec::Empty => Ok(OperatingPoint { levels: [0.0; 4], pump_voltage: [0.0; 2] }),
        }
    }
}

/// Case a, both set-points stepping: what the paper begins with.
impl Default for ModelFreeSetup {
    fn default() -> Self {
        Self::published(PublishedValves::A, PublishedExperiment::S2)
    }
}
