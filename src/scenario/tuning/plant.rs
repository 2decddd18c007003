use serde::{Deserialize, Serialize};

use crate::control::Pairing;
use crate::linear::{Complex, TransferFunction, TransferMatrix};
use crate::plant::PresetId;
use crate::scenario::ScenarioError;
use crate::tuning::{PublishedPlant, TuningError, tank_transfer_matrix};

use super::document::{LARGEST, within};

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

    /// A part that is far quicker than everything else asks for more steps than anyone waits for. A plant that is none is told
    /// when it is used.
    pub(super) fn check_pace(&self, duration: f64) -> Result<(), ScenarioError> {
        let Ok(transfer) = self.transfer_matrix() else { return Ok(()) };
        let elements = transfer.0.as_flattened();
        let quickest = elements.iter().filter_map(|g| g.poles().ok()).flatten().map(Complex::norm).fold(0.0, f64::max);
        let dead_time = elements.iter().map(TransferFunction::dead_time).fold(0.0, f64::max);
        let field = |what: &str| format!("tuning.plant: quickest pole * {what}");
        within(quickest * duration, 0.0, QUICKEST_IN_RECORD, || field("duration"))?;
        within(quickest * dead_time, 0.0, QUICKEST_IN_DEAD_TIME, || field("dead time"))
    }

    /// Checks every number and the lengths of all lists.
    pub(super) fn check(&self) -> Result<(), ScenarioError> {
        match self {
            Self::Published(_) => Ok(()),
            Self::QuadrupleTank { valves, dead_time_s, lag_s, nonlinear, .. } => {
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
            Self::Elements(rows) => rows.as_flattened().iter().enumerate().try_for_each(|(k, element)| {
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
}
