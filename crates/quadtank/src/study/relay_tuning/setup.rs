use serde::{Deserialize, Serialize};

use crate::tuning::{TuningError, TuningRule, importance};

use super::{CriticalSpec, DesignSpec, TuningPlant};

/// Which relay test is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
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
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum SeriesElement {
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
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct TestSpec {
    /// Which one.
    pub kind: TestKind,
    /// Number of the loop of a single test, 1 or 2.
    #[serde(default = "one")]
    pub number: usize,
    /// What stands behind the relay of a single test.
    #[serde(default)]
    pub behind: SeriesElement,
    /// Amplitudes d1, d2.
    pub amplitudes: [f64; 2],
    /// Half widths ε of the hysteresis.
    #[serde(default)]
    pub hysteresis: [f64; 2],
    /// Means of the relay outputs.
    #[serde(default)]
    pub bias: [f64; 2],
    /// The rule of independent and sequential tests.
    pub rule: TuningRule,
    /// Factors f by which independent tests are made weaker.
    #[serde(default = "not_weaker")]
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

/// What a document without the field has: the first loop, a single pass.
fn one() -> usize {
    1
}

/// What a document without detuning has.
fn not_weaker() -> [f64; 2] {
    [1.0; 2]
}

/// What the response is compared with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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

impl TuningSetup {
    /// This session with the steps of `present`, so that both responses can be compared: plant, controllers and their sampling time
    /// are its own. The duration is that of `present` too where times are in the same unit.
    #[must_use]
    pub fn in_experiment_of(&self, present: &Self) -> Self {
        let ResponseSpec { references, duration, .. } = present.response;
        let duration = if self.plant.has_same_time_unit(&present.plant) { duration } else { self.response.duration };
        Self { response: ResponseSpec { references, duration, ..self.response }, ..self.clone() }
    }

    /// Importance r2 of the critical point that the design starts from.
    ///
    /// # Errors
    /// [`TuningError::Linear`] for coefficients that are no transfer function.
    pub fn importance(&self) -> Result<f64, TuningError> {
        match self.design.critical {
            CriticalSpec::Importance(r) => Ok(r),
            CriticalSpec::Point { gains, .. } => Ok(importance(&self.plant.transfer_matrix()?.rest_gain(), gains)),
        }
    }
}
