use serde::{Deserialize, Serialize};

use crate::control::Pairing;
use crate::linear::{Complex, TransferFunction, TransferMatrix};
use crate::plant::PresetId;
use crate::scenario::ScenarioError;
use crate::tuning::{Action, PlacementMethod, PublishedPlant, TuningError, TuningRule, tank_transfer_matrix};

/// The longest record: rows.
const MOST_ROWS: f64 = 100_000.0;
/// Most passes of a sequence.
const MOST_PASSES: usize = 20;
/// Rows of all records of a sequence together.
const MOST_ROWS_OF_ALL: f64 = 500_000.0;
/// Largest number of most fields, and smallest where only positive ones make sense.
const LARGEST: f64 = 1e6;
const SMALLEST: f64 = 1e-6;
/// Largest coefficient, and smallest that is not zero: products of them stay numbers.
const COEFFICIENT: f64 = 1e12;
/// How much quicker than a record, and than a dead time, the quickest part of a plant may be.
const QUICKEST_IN_RECORD: f64 = 2e6;
const QUICKEST_IN_DEAD_TIME: f64 = 1e4;
/// Longest list of coefficients.
const MOST_COEFFICIENTS: usize = 8;

/// An element `b(s)/a(s) e^(−θ s)` of a plant of one's own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Element {
    /// Coefficients of b by rising powers of s.
    pub numerator: Vec<f64>,
    /// Coefficients of a by rising powers of s.
    pub denominator: Vec<f64>,
    /// Dead time θ.
    #[serde(default)]
    pub dead_time: f64,
}

/// The plant that is tuned. Times are in its own unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum TuningPlant {
    /// A plant of the literature.
    Published(PublishedPlant),
    /// The linear model of a published quadruple tank at its published pump voltages, from voltages to measured levels, s.
    QuadrupleTank {
        /// The rig.
        preset: PresetId,
        /// Valve fractions γ1, γ2; those of the rig where they are not given.
        #[serde(default)]
        valves: Option<[f64; 2]>,
        /// Which pump each loop drives.
        pairing: Pairing,
        /// A dead time in every element (s).
        #[serde(default)]
        dead_time_s: f64,
        /// A lag in every element (s), of pump or sensor.
        #[serde(default)]
        lag_s: f64,
        /// Whether simultaneous relays and the response run on the nonlinear plant, which has neither dead time nor lag.
        #[serde(default)]
        nonlinear: bool,
    },
    /// Four elements, row by output.
    Elements([[Element; 2]; 2]),
}

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
    fn validate(&self) -> Result<(), ScenarioError> {
        let Self { plant, test, design, response } = self;
        check_plant(plant)?;
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
        check_pace(plant, test.duration.max(response.duration))?;
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

/// A part that is far quicker than everything else asks for more steps than anyone waits for. A plant that is none is told
/// when it is used.
fn check_pace(plant: &TuningPlant, duration: f64) -> Result<(), ScenarioError> {
    let Ok(transfer) = plant.transfer_matrix() else { return Ok(()) };
    let elements = transfer.0.as_flattened();
    let quickest = elements.iter().filter_map(|g| g.poles().ok()).flatten().map(Complex::norm).fold(0.0, f64::max);
    let dead_time = elements.iter().map(TransferFunction::dead_time).fold(0.0, f64::max);
    let field = |what: &str| format!("tuning.plant: quickest pole * {what}");
    within(quickest * duration, 0.0, QUICKEST_IN_RECORD, || field("duration"))?;
    within(quickest * dead_time, 0.0, QUICKEST_IN_DEAD_TIME, || field("dead time"))
}

fn check_plant(plant: &TuningPlant) -> Result<(), ScenarioError> {
    match plant {
        TuningPlant::Published(_) => Ok(()),
        TuningPlant::QuadrupleTank { valves, dead_time_s, lag_s, nonlinear, .. } => {
            let path = "tuning.plant.quadruple_tank";
            if *nonlinear {
                within(*dead_time_s, 0.0, 0.0, || format!("{path}.dead_time_s"))?;
                within(*lag_s, 0.0, 0.0, || format!("{path}.lag_s"))?;
            }
            for (i, &valve) in valves.iter().flatten().enumerate() {
                within(valve, 0.0, 1.0, || format!("{path}.valves[{i}]"))?;
            }
            within(*dead_time_s, 0.0, LARGEST, || format!("{path}.dead_time_s"))?;
            within(*lag_s, 0.0, LARGEST, || format!("{path}.lag_s"))
        }
        TuningPlant::Elements(rows) => rows.as_flattened().iter().enumerate().try_for_each(|(k, element)| {
            let path = format!("tuning.plant.elements[{}][{}]", k / 2, k % 2);
            for (name, list) in [("numerator", &element.numerator), ("denominator", &element.denominator)] {
                if list.len() > MOST_COEFFICIENTS {
                    let field = format!("{path}.{name}");
                    return Err(ScenarioError::TooMany { field, count: list.len(), max: MOST_COEFFICIENTS });
                }
                for (i, &c) in list.iter().enumerate() {
                    let smallest = if c == 0.0 { 0.0 } else { COEFFICIENT.recip() };
                    within(c.abs(), smallest, COEFFICIENT, || format!("{path}.{name}[{i}]"))?;
                }
            }
            within(element.dead_time, 0.0, LARGEST, || format!("{path}.dead_time"))
        }),
    }
}

fn within(value: f64, min: f64, max: f64, field: impl Fn() -> String) -> Result<(), ScenarioError> {
    if value >= min && value <= max {
        Ok(())
    } else {
        Err(ScenarioError::OutOfRange { field: field(), value, min, max })
    }
}

impl TuningPlant {
    /// As transfer functions.
    ///
    /// # Errors
    /// [`TuningError::Linear`] for coefficients that are no transfer function.
    pub fn transfer_matrix(&self) -> Result<TransferMatrix, TuningError> {
        match self {
            Self::Published(plant) => Ok(plant.transfer_matrix()?),
            Self::QuadrupleTank { preset, valves, pairing, dead_time_s, lag_s, .. } => {
                let rig = preset.preset();
                let plant = rig.plant.with_valves(valves.unwrap_or(rig.plant.valves));
                let jacobian = plant.linearise(&plant.free_equilibrium(rig.pump_voltage));
                let behind = TransferFunction::lags(1.0, &[*lag_s], *dead_time_s)?;
                let transfer = tank_transfer_matrix(&jacobian)?.followed_by(&behind);
                Ok(match pairing {
                    Pairing::Diagonal => transfer,
                    Pairing::Swapped => transfer.swapped(),
                })
            }
            Self::Elements(rows) => {
                let element =
                    |e: &Element| TransferFunction::new(e.numerator.clone(), e.denominator.clone(), e.dead_time);
                let [[g11, g12], [g21, g22]] = rows;
                Ok(TransferMatrix([[element(g11)?, element(g12)?], [element(g21)?, element(g22)?]]))
            }
        }
    }
}
