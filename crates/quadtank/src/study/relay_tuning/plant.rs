use crate::control::Pairing;
use crate::linear::{Complex, TransferFunction, TransferMatrix};
use crate::literature::PresetId;
use crate::literature::campestrini::PublishedPlant;
use crate::plant::QuadrupleTank;
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
    /// The linear model of a rig that the document describes, at given pump voltages, from voltages to measured levels, s.
    Parameters {
        /// The rig, with its valves.
        rig: Box<QuadrupleTank>,
        /// Voltages of pumps 1 and 2 at rest (V).
        pump_voltage: [f64; 2],
        /// Which pump each loop drives.
        pairing: Pairing,
        /// A dead time in every element (s), besides that of the hoses.
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

/// A quadruple tank that is tuned, published or of one's own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TunedTank {
    /// The rig, with its valves as they stand.
    pub rig: QuadrupleTank,
    /// Voltages of pumps 1 and 2 at rest (V).
    pub pump_voltage: [f64; 2],
    /// Which pump each loop drives.
    pub pairing: Pairing,
    /// A dead time in every element (s).
    pub dead_time_s: f64,
    /// A lag in every element (s).
    pub lag_s: f64,
    /// Whether relays and response run on the nonlinear plant.
    pub nonlinear: bool,
}

/// What can be changed on a quadruple tank that is tuned, published or of one's own.
#[derive(Debug)]
pub struct TunedTankMut<'a> {
    /// Which pump each loop drives.
    pub pairing: &'a mut Pairing,
    /// A dead time in every element (s).
    pub dead_time_s: &'a mut f64,
    /// A lag in every element (s).
    pub lag_s: &'a mut f64,
    /// Whether relays and response run on the nonlinear plant.
    pub nonlinear: &'a mut bool,
}

impl TunedTank {
    /// The linear model at rest, from the pumps of loops 1 and 2 to measured levels.
    fn transfer_matrix(&self) -> Result<TransferMatrix, TuningError> {
        let jacobian = self.rig.linearise(&self.rig.free_equilibrium(self.pump_voltage));
        let behind = TransferFunction::lags(1.0, &[self.lag_s], self.dead_time_s)?;
        let transfer = tank_transfer_matrix(&jacobian)?.followed_by(&behind);
        Ok(match self.pairing {
            Pairing::Diagonal => transfer,
            Pairing::Swapped => transfer.swapped(),
        })
    }
}

/// The kinds of plant: a tank is either a published rig or one that the document describes.
enum Kind<'a> {
    Published(PublishedPlant),
    Tank(Box<TunedTank>),
    Elements(&'a [[Element; 2]; 2]),
}

impl TuningPlant {
    fn kind(&self) -> Kind<'_> {
        match *self {
            Self::Published(plant) => Kind::Published(plant),
            Self::QuadrupleTank { preset, valves, pairing, dead_time_s, lag_s, nonlinear } => {
                let published = preset.preset();
                let rig = published.plant.with_valves(valves.unwrap_or(published.plant.valves));
                let pump_voltage = published.pump_voltage;
                Kind::Tank(Box::new(TunedTank { rig, pump_voltage, pairing, dead_time_s, lag_s, nonlinear }))
            }
            Self::Parameters { ref rig, pump_voltage, pairing, dead_time_s, lag_s, nonlinear } => {
                Kind::Tank(Box::new(TunedTank { rig: **rig, pump_voltage, pairing, dead_time_s, lag_s, nonlinear }))
            }
            Self::Elements(ref rows) => Kind::Elements(rows),
        }
    }

    /// The quadruple tank that is tuned; `None` for another plant.
    pub fn tank(&self) -> Option<TunedTank> {
        match self.kind() {
            Kind::Tank(tank) => Some(*tank),
            Kind::Published(_) | Kind::Elements(_) => None,
        }
    }

    /// The settings of the quadruple tank that is tuned, to be changed; `None` for another plant.
    pub fn tank_mut(&mut self) -> Option<TunedTankMut<'_>> {
        match self {
            Self::QuadrupleTank { pairing, dead_time_s, lag_s, nonlinear, .. }
            | Self::Parameters { pairing, dead_time_s, lag_s, nonlinear, .. } => {
                Some(TunedTankMut { pairing, dead_time_s, lag_s, nonlinear })
            }
            Self::Published(_) | Self::Elements(_) => None,
        }
    }

    /// Turns the valves of a quadruple tank to γ1, γ2; does nothing to another plant.
    pub fn set_valves(&mut self, valves: [f64; 2]) {
        match self {
            Self::QuadrupleTank { valves: given, .. } => *given = Some(valves),
            Self::Parameters { rig, .. } => rig.valves = valves,
            Self::Published(_) | Self::Elements(_) => {}
        }
    }

    /// As transfer functions.
    ///
    /// # Errors
    /// [`TuningError::Linear`] for coefficients that are no transfer function.
    pub fn transfer_matrix(&self) -> Result<TransferMatrix, TuningError> {
        match self.kind() {
            Kind::Published(plant) => Ok(plant.transfer_matrix()?),
            Kind::Tank(tank) => tank.transfer_matrix(),
            Kind::Elements(rows) => {
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
            (Self::Elements(_), Self::Elements(_)) => true,
            _ => self.tank().is_some() && other.tank().is_some(),
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
