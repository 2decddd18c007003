use serde::{Deserialize, Serialize};

use crate::scenario::ScenarioError;
use crate::tuning::{Action, PlacementMethod, TuningError, TuningRule, importance};

use super::TuningPlant;

/// The longest record: rows.
const MOST_ROWS: f64 = 100_000.0;
/// Most passes of a sequence.
const MOST_PASSES: usize = 20;
/// Rows of all records of a sequence together.
const MOST_ROWS_OF_ALL: f64 = 500_000.0;
/// Largest number of most fields, and smallest where only positive ones make sense.
pub(super) const LARGEST: f64 = 1e6;
const SMALLEST: f64 = 1e-6;
/// Which relay test is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum TestKind {
    /// One element of the diagonal alone, perhaps with something behind the relay.
    Single,
    /// One loop after the other, each alone.
    Independent,
    /// One loop after the other, those before closed by the rule.
    Sequential,
    /// Both at once.
    Simultaneous,
}

/// What stands behind the relay of a single test, and which point of the frequency response it finds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Behind {
    /// Nothing: the point with −180°, if the relay has no hysteresis.
    #[default]
    Nothing,
    /// An integrator: the point with −90°.
    Integrator,
    /// The estimator of the point with this modulus r.
    Modulus(f64),
}

/// A relay test.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct TestSpec {
    /// Which one.
    pub kind: TestKind,
    /// Number of the loop of a single test, 1 or 2.
    #[serde(default = "one")]
    pub number: usize,
    /// What stands behind the relay of a single test.
    #[serde(default)]
    pub behind: Behind,
    /// Amplitudes d1, d2.
    pub amplitudes: [f64; 2],
    /// Half widths ε of the hysteresis; of simultaneous and single tests.
    #[serde(default)]
    pub hysteresis: [f64; 2],
    /// Means of the relay outputs; of simultaneous and single tests.
    #[serde(default)]
    pub bias: [f64; 2],
    /// The rule of independent and sequential tests.
    pub rule: TuningRule,
    /// Factors f by which independent tests are made weaker.
    #[serde(default = "ones")]
    pub detuning: [f64; 2],
    /// Passes of a sequential test.
    #[serde(default = "one")]
    pub passes: usize,
    /// How long.
    pub duration: f64,
    /// When the relays begin to switch.
    pub release: f64,
    /// Time between rows.
    pub step: f64,
}

fn ones() -> [f64; 2] {
    [1.0; 2]
}

fn one() -> usize {
    1
}

/// The critical point that a design starts from.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum CriticalSpec {
    /// The point of the curve where loop 2 has this importance r2.
    Importance(f64),
    /// A point as printed or measured.
    Point {
        /// Gains kc1, kc2.
        gains: [f64; 2],
        /// Period Tc.
        period: f64,
    },
}

/// What stands between controllers and plant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum DecouplerSpec {
    /// Nothing.
    #[default]
    None,
    /// Constant gains.
    Static,
    /// Both cross paths removed.
    Dynamic,
    /// Only the way from loop 2 to output 1.
    FirstOutput,
    /// Only the way from loop 1 to output 2.
    SecondOutput,
}

/// A placement of the critical point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct DesignSpec {
    /// From where.
    pub critical: CriticalSpec,
    /// Which loci.
    pub method: PlacementMethod,
    /// With which controllers.
    pub action: Action,
    /// Target λ: real and imaginary part.
    pub target: [f64; 2],
    /// Root 1 or 2; root 1 has the larger controller in loop 1.
    pub root: usize,
    /// Decoupler of the response.
    #[serde(default)]
    pub decoupler: DecouplerSpec,
}

/// What the response is compared with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum CompareSpec {
    /// Nothing.
    #[default]
    Nothing,
    /// Each loop by Ziegler and Nichols from the critical point.
    ZieglerNichols,
    /// Each loop by Tyreus and Luyben from the critical point.
    TyreusLuyben,
    /// The full controller of the column of Wood and Berry (Campestrini 2006, eq. 88); nothing on other plants.
    Full,
}

/// Steps of the references.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ResponseSpec {
    /// References of both loops, from the start on.
    pub references: [f64; 2],
    /// How long.
    pub duration: f64,
    /// Sampling time of the controllers.
    pub step: f64,
    /// What it is compared with.
    #[serde(default)]
    pub compare: CompareSpec,
}

/// Everything that a tuning session depends on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct TuningSetup {
    /// The plant.
    pub plant: TuningPlant,
    /// The relay test.
    pub test: TestSpec,
    /// The controllers.
    pub design: DesignSpec,
    /// The response.
    pub response: ResponseSpec,
}

/// A relay-tuning session.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct TuningScenario {
    /// Version of the document: 2. It is checked before anything else is read.
    pub version: u32,
    /// The session.
    pub tuning: TuningSetup,
    /// Sessions whose responses stay in sight, oldest first.
    #[serde(default)]
    pub pinned: Vec<TuningSetup>,
}

impl TuningScenario {
    /// The version of these documents.
    pub const VERSION: u32 = 2;
    /// Most pinned sessions.
    pub const MAX_PINNED: usize = 3;

    /// Checks every number and the lengths of all lists.
    ///
    /// # Errors
    /// [`ScenarioError::OutOfRange`] or [`ScenarioError::TooMany`] for the first field that is not allowed.
    pub fn validate(&self) -> Result<(), ScenarioError> {
        let (count, max) = (self.pinned.len(), Self::MAX_PINNED);
        if count > max {
            return Err(ScenarioError::TooMany { field: "pinned".to_owned(), count, max });
        }
        self.pinned.iter().try_for_each(TuningSetup::validate)?;
        self.tuning.validate()
    }
}

impl TuningSetup {
    /// Importance r2 of the critical point that the design starts from.
    ///
    /// # Errors
    /// What is wrong with the plant.
    pub fn importance(&self) -> Result<f64, TuningError> {
        match self.design.critical {
            CriticalSpec::Importance(r) => Ok(r),
            CriticalSpec::Point { gains, .. } => Ok(importance(&self.plant.transfer_matrix()?.dc_gain(), gains)),
        }
    }

    fn validate(&self) -> Result<(), ScenarioError> {
        let Self { plant, test, design, response } = self;
        plant.check()?;
        for i in [0, 1] {
            within(test.amplitudes[i], SMALLEST, LARGEST, || format!("tuning.test.amplitudes[{i}]"))?;
            within(test.hysteresis[i], 0.0, LARGEST, || format!("tuning.test.hysteresis[{i}]"))?;
            within(test.bias[i], -LARGEST, LARGEST, || format!("tuning.test.bias[{i}]"))?;
            within(test.detuning[i], SMALLEST, LARGEST, || format!("tuning.test.detuning[{i}]"))?;
            within(design.target[i], -LARGEST, LARGEST, || format!("tuning.design.target[{i}]"))?;
            within(response.references[i], -LARGEST, LARGEST, || format!("tuning.response.references[{i}]"))?;
        }
        within(test.number as f64, 1.0, 2.0, || "tuning.test.number".to_owned())?;
        if let Behind::Modulus(r) = test.behind {
            within(r, SMALLEST, LARGEST, || "tuning.test.behind.modulus".to_owned())?;
        }
        within(test.passes as f64, 1.0, MOST_PASSES as f64, || "tuning.test.passes".to_owned())?;
        within(test.release, 0.0, test.duration, || "tuning.test.release".to_owned())?;
        check_time(test.duration, test.step, "tuning.test")?;
        check_time(response.duration, response.step, "tuning.response")?;
        let rows = test.passes as f64 * test.duration / test.step;
        within(rows, 0.0, MOST_ROWS_OF_ALL, || "tuning.test: passes * duration / step".to_owned())?;
        plant.check_pace(test.duration.max(response.duration))?;
        within(design.root as f64, 1.0, 2.0, || "tuning.design.root".to_owned())?;
        match design.critical {
            CriticalSpec::Importance(r) => {
                within(r, SMALLEST, LARGEST, || "tuning.design.critical.importance".to_owned())
            }
            CriticalSpec::Point { gains, period } => {
                within(period, SMALLEST, LARGEST, || "tuning.design.critical.point.period".to_owned())?;
                gains.iter().enumerate().try_for_each(|(i, &gain)| {
                    within(gain, -LARGEST, LARGEST, || format!("tuning.design.critical.point.gains[{i}]"))
                })
            }
        }
    }
}

fn check_time(duration: f64, step: f64, path: &str) -> Result<(), ScenarioError> {
    within(duration, SMALLEST, LARGEST, || format!("{path}.duration"))?;
    within(step, duration / MOST_ROWS, duration, || format!("{path}.step"))
}

pub(super) fn within(value: f64, min: f64, max: f64, field: impl Fn() -> String) -> Result<(), ScenarioError> {
    if value >= min && value <= max {
        Ok(())
    } else {
        Err(ScenarioError::OutOfRange { field: field(), value, min, max })
    }
}
