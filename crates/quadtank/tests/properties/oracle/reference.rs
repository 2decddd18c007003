use std::array::from_fn;

use quadtank::plant::{CrossSection, Outlet, Pump, QuadrupleTank, Sensor, Tank};
use serde::Deserialize;

/// A rig of the reference file, in its units (SI).
#[derive(Deserialize)]
pub struct Parameters {
    pub gravity: f64,
    pub gamma: [f64; 2],
    pub pump_gain: [f64; 2],
    pub sensor_gain: f64,
    pub outlet_area: [f64; 4],
    pub area_at_empty: [f64; 4],
    pub area_slope: [f64; 4],
}

impl Parameters {
    /// The rig of the reference, which knows neither walls nor voltage limits.
    pub fn rig(&self) -> QuadrupleTank {
        QuadrupleTank {
            tanks: from_fn(|j| Tank {
                section: CrossSection { area_at_empty: self.area_at_empty[j], area_slope: self.area_slope[j] },
                outlet: Outlet { area: self.outlet_area[j], loss_coefficient: 1.0 },
                height: f64::INFINITY,
            }),
            pumps: self.pump_gain.map(|gain| Pump::proportional(gain, 0.0, f64::INFINITY)),
            valves: self.gamma,
            valve_slopes: [0.0; 2],
            power_gain: 1.0,
            sensor: Sensor { gain: self.sensor_gain, range: f64::INFINITY, resolution: 0.0 },
            gravity: self.gravity,
            inflow: [0.0; 4],
        }
    }
}
