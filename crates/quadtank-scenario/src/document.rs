use quadtank::control::DecentralisedPi;
use quadtank::plant::{DisplayUnit, OperatingPoint, PresetId, QuadrupleTank};
use quadtank::sim::Experiment;
use serde::{Deserialize, Serialize};

use super::{ScenarioError, params, validate};

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

/// How the operating point is given.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum OperatingPointSpec {
    /// The pump voltages (V); the levels follow, for any valves.
    PumpVoltage([f64; 2]),
    /// The levels of tanks 1 and 2 (m); the voltages follow, unless γ1 + γ2 = 1.
    Levels([f64; 2]),
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
    /// Where it rests before the experiment.
    pub operating_point: OperatingPointSpec,
    /// The controller.
    pub controller: DecentralisedPi,
    /// What is done to it.
    pub experiment: Experiment,
}

impl Setup {
    /// The rig, with the valves of this setup.
    pub fn plant(&self) -> QuadrupleTank {
        let rig = match self.plant {
            PlantSpec::Preset(id) => id.preset().plant,
            PlantSpec::Parameters { rig, .. } => rig,
        };
        rig.with_valves(self.valves)
    }

    /// The unit to show levels in.
    pub fn display_unit(&self) -> DisplayUnit {
        match self.plant {
            PlantSpec::Preset(id) => id.preset().display_unit,
            PlantSpec::Parameters { display_unit, .. } => display_unit,
        }
    }

    /// The equilibrium that the experiment starts from, whether or not walls and pumps allow it.
    ///
    /// # Errors
    /// [`ScenarioError::Plant`] when levels are given and no input holds them.
    pub fn operating_point(&self) -> Result<OperatingPoint, ScenarioError> {
        let plant = self.plant();
        match self.operating_point {
            OperatingPointSpec::PumpVoltage(voltage) => Ok(plant.free_equilibrium(voltage)),
            OperatingPointSpec::Levels(levels) => Ok(plant.inputs_for_levels(levels)?),
        }
    }
}

/// What the screen shows beside the run itself. Nothing here changes a number.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct View {
    /// Time at which the cursor of the responses stands (s); `None` at rest.
    pub cursor_s: Option<f64>,
    /// Shown part of the time axis (s); `None` for all of it.
    pub zoom_s: Option<[f64; 2]>,
    /// Whether the linear responses are hidden.
    #[serde(default)]
    pub hide_linear: bool,
}

/// A run of the quadruple-tank laboratory, and what is shown of it.
///
/// In JSON every key is in snake case, also the name of a choice that holds fields, and every name of a rig in kebab
/// case; units are SI.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// Version of the document: 1. It is checked before anything else is read.
    pub version: u32,
    /// The run that is worked on.
    pub setup: Setup,
    /// Runs pinned to compare with, at most 3.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pinned: Vec<Setup>,
    /// What the screen shows.
    #[serde(default)]
    pub view: View,
}

impl Scenario {
    /// The version that this program writes.
    pub const VERSION: u32 = 1;
    /// How many pinned runs a scenario holds.
    pub const MAX_PINNED: usize = 3;

    /// Checks every number against its [row](super::params), the lengths of all lists, and what has to hold between numbers.
    ///
    /// # Errors
    /// [`ScenarioError::OutOfRange`] or [`ScenarioError::TooMany`] for the first field that is not allowed.
    pub fn validate(&self) -> Result<(), ScenarioError> {
        params::check(self)?;
        validate::version(self.version, Self::VERSION)?;
        validate::setup(&self.setup, "setup")?;
        validate::each(&self.pinned, "pinned", validate::setup)?;
        validate::view(&self.view, "view")
    }
}
