use serde::{Deserialize, Serialize};

use crate::control::DecentralisedPi;
use crate::literature::{DisplayUnit, PresetId};
use crate::plant::{OperatingPoint, QuadrupleTank};
use crate::sim::Experiment;
use crate::study::StudyError;

/// The plant of a setup: a published rig by name, or all its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[expect(clippy::large_enum_variant, reason = "one per scenario, and plain data is easier to share than a box")]
pub enum PlantSpec {
    /// A published rig; its valves are overridden by those of the setup.
    Preset(PresetId),
    /// A rig of one's own.
    Parameters {
        /// All parameters, in SI; the valves are overridden by those of the setup.
        rig: QuadrupleTank,
        /// The unit to show levels in.
        display_unit: DisplayUnit,
    },
}

impl PlantSpec {
    /// The rig, with valves of its own.
    pub fn rig(&self) -> QuadrupleTank {
        match *self {
            Self::Preset(id) => id.preset().plant,
            Self::Parameters { rig, .. } => rig,
        }
    }

    /// The unit to show levels in.
    pub fn display_unit(&self) -> DisplayUnit {
        match *self {
            Self::Preset(id) => id.preset().display_unit,
            Self::Parameters { display_unit, .. } => display_unit,
        }
    }
}

/// How the operating point is given.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum OperatingPointSpec {
    /// The pump voltages (V); the levels follow, for any valves.
    PumpVoltage([f64; 2]),
    /// The levels of tanks 1 and 2 (m); the voltages follow, unless γ1 + γ2 = 1.
    Levels([f64; 2]),
    /// Levels of all tanks (m) and pump voltages (V), at rest or not, such as those that are printed somewhere: the linear model
    /// is the one around them, and a run begins there.
    State(OperatingPoint),
}

/// Everything that one run depends on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Setup {
    /// The plant.
    pub plant: PlantSpec,
    /// Valve fractions γ1, γ2, each in [0, 1].
    pub valves: [f64; 2],
    /// Where it is before the experiment: at rest, but for a state of one's own.
    pub operating_point: OperatingPointSpec,
    /// The controller.
    pub controller: DecentralisedPi,
    /// What is done to it.
    pub experiment: Experiment,
}

impl Setup {
    /// The rig, with the valves of this setup.
    pub fn plant(&self) -> QuadrupleTank {
        self.plant.rig().with_valves(self.valves)
    }

    /// The controller as it acts in the experiment: a loop whose pump is moved by hand is open.
    pub fn acting_controller(&self) -> DecentralisedPi {
        let mut acting = self.controller;
        for (index, settings) in acting.loops.iter_mut().enumerate() {
            if self.experiment.is_by_hand(self.controller.pairing.pump_of(index)) {
                settings.gain = 0.0;
            }
        }
        acting
    }

    /// Whether λ11 is γ1γ2/(γ1 + γ2 − 1) (Cocota 2009, eq. 4.10): where the upper tanks pass on all of a change of their inflow in the
    /// long run, so at rest, and in upright walls also away from it.
    pub fn has_relative_gain_of_valves(&self) -> bool {
        let is_state = matches!(self.operating_point, OperatingPointSpec::State(_));
        !is_state || self.plant.rig().tanks[2..].iter().all(|tank| tank.section.area_slope == 0.0)
    }

    /// This setup in the experiment of `present`, so that both runs can be compared: rig, valves and controller are its own. The
    /// operating point is that of `present` too where both have the same rig; one of another rig says nothing of this one.
    #[must_use]
    pub fn in_experiment_of(&self, present: &Self) -> Self {
        let operating_point = if self.is_same_rig(present) { present.operating_point } else { self.operating_point };
        Self { operating_point, experiment: present.experiment.clone(), ..self.clone() }
    }

    /// Whether both have the same rig, apart from its valves.
    pub fn is_same_rig(&self, other: &Self) -> bool {
        self.plant.rig().with_valves([0.5; 2]) == other.plant.rig().with_valves([0.5; 2])
    }

    /// What the experiment starts from, whether or not walls and pumps allow it: an equilibrium, but for a state of one's own.
    ///
    /// # Errors
    /// [`StudyError`] at `operating_point` when levels are given and no input holds them.
    pub fn operating_point(&self) -> Result<OperatingPoint, StudyError> {
        let plant = self.plant();
        match self.operating_point {
            OperatingPointSpec::PumpVoltage(voltage) => Ok(plant.free_equilibrium(voltage)),
            OperatingPointSpec::Levels(levels) => {
                plant.inputs_for_levels(levels).map_err(StudyError::at("operating_point"))
            }
            OperatingPointSpec::State(state) => Ok(state),
        }
    }
}
