use crate::control::Pairing;
use crate::linear::{Complex, TransferFunction, TransferMatrix};
use crate::literature::PresetId;
use crate::literature::campestrini::PublishedPlant;
use crate::tuning::{TuningError, tank_transfer_matrix};
use serde::{Deserialize, Serialize};

use super::Element;

/// The plant that is tuned. Times are in its own unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum TuningPlant {
    /// A plant of the literature.
    Published(PublishedPlant),
    /// The linear model of a published quadruple tank at its published pump voltages, from voltages to measured levels, s.
    QuadrupleTank {
        /// The rig.
        preset: PresetId,
        /// Valve fractions γ1, γ2; those of the rig where they are not given.
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
                let [[g11, g12], [g21, g22]] =
                    rows.each_ref().map(|row| row.each_ref().map(Element::transfer_function));
                Ok(TransferMatrix([[g11?, g12?], [g21?, g22?]]))
            }
        }
    }

    /// Its elements, row by output.
    ///
    /// # Errors
    /// As [`transfer_matrix`](Self::transfer_matrix).
    pub fn elements(&self) -> Result<[[Element; 2]; 2], TuningError> {
        match self {
            Self::Elements(rows) => Ok(rows.clone()),
            other => Ok(other.transfer_matrix()?.0.map(|row| row.map(Element::from))),
        }
    }

    /// Whether times are in the same unit for both, as far as documents tell: published plants have a unit each.
    pub fn has_same_time_unit(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Published(one), Self::Published(two)) => one == two,
            (Self::QuadrupleTank { .. }, Self::QuadrupleTank { .. }) | (Self::Elements(_), Self::Elements(_)) => true,
            _ => false,
        }
    }

    /// Largest magnitude of a pole (rad per unit of time of the plant) and longest dead time; `None` where the
    /// coefficients are no transfer function.
    pub fn fastest_rate_and_dead_time(&self) -> Option<(f64, f64)> {
        let transfer = self.transfer_matrix().ok()?;
        let elements = transfer.0.as_flattened();
        let quickest = elements.iter().filter_map(|g| g.poles().ok()).flatten().map(Complex::norm).fold(0.0, f64::max);
        Some((quickest, elements.iter().map(TransferFunction::dead_time).fold(0.0, f64::max)))
    }
}
