use serde::{Deserialize, Serialize};

use super::error::within;
use super::{LevelError, LevelTank};

/// A tank that is heated through its bottom: level and temperature (the lecture slides, Example 5).
///
/// `ρ c_p A h dT/dt = ρ c_p q (T_in − T) + U A (T_h − T)`. The slides print U per second and compute with it per hour; here it is
/// per second, so their U is divided by 3600.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct HeatedTank {
    /// The tank.
    pub tank: LevelTank,
    /// Temperature of the inflow `T_in` (K).
    pub inflow_temperature: f64,
    /// Temperature of the heater `T_h` (K).
    pub heater_temperature: f64,
    /// Heat transfer coefficient U, referred to the cross-section (W/(m² K)).
    pub heat_transfer: f64,
    /// Density ρ (kg/m³).
    pub density: f64,
    /// Heat capacity `c_p` (J/(kg K)).
    pub heat_capacity: f64,
}

impl HeatedTank {
    /// Refuses parameters without meaning.
    ///
    /// # Errors
    /// [`LevelError::OutOfRange`] with the first of them.
    pub fn check(&self) -> Result<(), LevelError> {
        self.tank.check()?;
        within("inflow_temperature", self.inflow_temperature, 0.0, f64::MAX)?;
        within("heater_temperature", self.heater_temperature, 0.0, f64::MAX)?;
        within("heat_transfer", self.heat_transfer, 0.0, f64::MAX)?;
        within("density", self.density, f64::MIN_POSITIVE, f64::MAX)?;
        within("heat_capacity", self.heat_capacity, f64::MIN_POSITIVE, f64::MAX)
    }

    /// dh/dt (m/s) and dT/dt (K/s) at a level above 0 (m), a temperature (K) and an inflow (m³/s).
    #[inline]
    pub fn rates(&self, level: f64, temperature: f64, inflow: f64) -> [f64; 2] {
        let area = self.tank.area;
        let by_inflow = inflow / area * (self.inflow_temperature - temperature);
        let by_heater = self.conductance() * (self.heater_temperature - temperature);
        [(inflow - self.tank.outflow.flow(level)) / area, (by_inflow + by_heater) / level]
    }

    /// Temperature at rest (K), the mean of both temperatures with the weights q/A and U/(ρ `c_p`); that of the inflow where
    /// neither inflow nor heater acts.
    pub fn rest_temperature(&self, inflow: f64) -> f64 {
        let (fed, heated) = (inflow / self.tank.area, self.conductance());
        if fed + heated > 0.0 {
            (fed * self.inflow_temperature + heated * self.heater_temperature) / (fed + heated)
        } else {
            self.inflow_temperature
        }
    }

    /// U/(ρ `c_p`) (m/s).
    fn conductance(&self) -> f64 {
        self.heat_transfer / (self.density * self.heat_capacity)
    }
}

#[cfg(test)]
mod tests {
    use crate::literature::level_slides;

    #[test]
    fn nothing_moves_at_rest() {
        let (tank, inflow) = (level_slides::heated_tank(), level_slides::HEATED_INFLOW);
        let level = tank.tank.outflow.level_for(inflow).unwrap();
        let temperature = tank.rest_temperature(inflow);
        let [dh, dt] = tank.rates(level, temperature, inflow);
        assert!(dh.abs() < 1e-15 && dt.abs() < 1e-12, "{dh} {dt}");
        assert!(temperature > tank.inflow_temperature && temperature < tank.heater_temperature);
        assert_eq!(tank.rest_temperature(0.0), tank.heater_temperature);
    }
}
