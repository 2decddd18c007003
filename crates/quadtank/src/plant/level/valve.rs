use serde::{Deserialize, Serialize};

use super::LevelError;
use super::error::within;

/// Inherent characteristic of a valve: its opening f, the share of the flow of the open valve, over its travel X, both 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Characteristic {
    /// `f = X`.
    Linear,
    /// `f = R_G^(X − 1)` (Andreis 2017, Appendix B). The closed valve leaks `1/R_G`.
    EqualPercentage {
        /// Rangeability `R_G`, above 1.
        rangeability: f64,
    },
    /// `f = √X`.
    QuickOpening,
}

impl Characteristic {
    /// Opening at a travel, which is cut to 0 to 1.
    pub fn opening(&self, travel: f64) -> f64 {
        let travel = travel.clamp(0.0, 1.0);
        match *self {
            Self::Linear => travel,
            Self::EqualPercentage { rangeability } => (rangeability.ln() * (travel - 1.0)).exp(),
            Self::QuickOpening => travel.sqrt(),
        }
    }

    /// df/dX at a travel; infinite for a closed valve that opens quickly.
    pub fn slope(&self, travel: f64) -> f64 {
        match *self {
            Self::Linear => 1.0,
            Self::EqualPercentage { rangeability } => rangeability.ln() * self.opening(travel),
            Self::QuickOpening => 0.5 / travel.clamp(0.0, 1.0).sqrt(),
        }
    }

    /// Travel for an opening, `X = ln f/ln R_G + 1` for equal percentage (Andreis 2017, Eq. 85).
    ///
    /// # Errors
    /// [`LevelError::ValveOutOfReach`] for an opening that no travel gives.
    pub fn travel(&self, opening: f64) -> Result<f64, LevelError> {
        let (min, max) = (self.opening(0.0), 1.0);
        // An opening that is an end of the range but for rounding is that end.
        let slack = 4.0 * f64::EPSILON;
        if !(opening >= min * (1.0 - slack) && opening <= max + slack) {
            return Err(LevelError::ValveOutOfReach { needed: opening, min, max });
        }
        Ok(match *self {
            Self::Linear => opening,
            Self::EqualPercentage { rangeability } => opening.ln() / rangeability.ln() + 1.0,
            Self::QuickOpening => opening * opening,
        }
        .clamp(0.0, 1.0))
    }

    fn check(&self) -> Result<(), LevelError> {
        match *self {
            Self::EqualPercentage { rangeability } => within("rangeability", rangeability, 1.0 + 1e-9, f64::MAX),
            Self::Linear | Self::QuickOpening => Ok(()),
        }
    }
}

/// Where the control valve stands.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ValvePlace {
    /// In the outlet: the outflow is the law of the tank times the opening.
    Outlet,
    /// In a feed of its own beside the disturbed inflow; the outlet is open.
    Inlet {
        /// Flow of the open valve (m³/s).
        full_flow: f64,
    },
}

/// The valve that the loop moves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ControlValve {
    /// Opening over travel.
    pub characteristic: Characteristic,
    /// In which pipe.
    pub place: ValvePlace,
}

impl ControlValve {
    pub(super) fn check(&self) -> Result<(), LevelError> {
        self.characteristic.check()?;
        match self.place {
            ValvePlace::Outlet => Ok(()),
            ValvePlace::Inlet { full_flow } => within("full_flow", full_flow, f64::MIN_POSITIVE, f64::MAX),
        }
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    const ALL: [Characteristic; 3] =
        [Characteristic::Linear, Characteristic::EqualPercentage { rangeability: 30.0 }, Characteristic::QuickOpening];

    #[test]
    fn travel_inverts_opening_and_slope_is_its_derivative() {
        for valve in ALL {
            for travel in [0.0, 0.25, 0.7, 1.0] {
                assert_relative_eq!(valve.travel(valve.opening(travel)).unwrap(), travel, epsilon = 1e-14);
            }
            let slope = (valve.opening(0.4 + 1e-6) - valve.opening(0.4 - 1e-6)) / 2e-6;
            assert_relative_eq!(valve.slope(0.4), slope, max_relative = 1e-9);
        }
    }

    #[test]
    fn openings_beyond_the_valve_are_refused_with_their_value() {
        let valve = Characteristic::EqualPercentage { rangeability: 30.0 };
        assert_eq!(
            valve.travel(1.2),
            Err(LevelError::ValveOutOfReach { needed: 1.2, min: valve.opening(0.0), max: 1.0 })
        );
        assert!(valve.travel(0.03).is_err() && valve.travel(f64::NAN).is_err());
        assert!(Characteristic::Linear.travel(-1e-3).is_err());
    }
}
