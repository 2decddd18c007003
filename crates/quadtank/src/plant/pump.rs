use serde::{Deserialize, Serialize};

use crate::numeric::{larger, smaller};

/// A pump with its voltage limits and its curve: a straight line, `gain × voltage` (Cocota 2009, eq. 2.25), with an
/// optional offset, dead zone and saturation.
///
/// The flow at a voltage `v` is `k v + offset` from `start_voltage` on, never below 0 nor above `flow_max`, and 0 before.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Pump {
    /// Flow per volt `k` (m³/(s V)), the slope of the curve.
    pub gain: f64,
    /// Lowest voltage (V).
    pub voltage_min: f64,
    /// Highest voltage (V).
    pub voltage_max: f64,
    /// Flow that the straight line of the curve has at 0 V (m³/s); below 0 for a pump that needs some voltage before it lifts
    /// water.
    #[serde(default, skip_serializing_if = "crate::numeric::is_zero")]
    pub offset: f64,
    /// Dead zone: voltage below which the pump gives nothing (V).
    #[serde(default, skip_serializing_if = "crate::numeric::is_zero")]
    pub start_voltage: f64,
    /// Largest flow (m³/s); absent where the voltage alone limits it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub flow_max: Option<f64>,
    /// Transport delay θ of the hose behind the pump (s): what its voltage does to the flow reaches the tanks that much later.
    #[serde(default, skip_serializing_if = "crate::numeric::is_zero")]
    pub delay_s: f64,
}

impl Pump {
    /// A pump whose flow is `gain × voltage` at any voltage (m³/(s V); limits in V).
    pub const fn proportional(gain: f64, voltage_min: f64, voltage_max: f64) -> Self {
        Self { gain, voltage_min, voltage_max, offset: 0.0, start_voltage: 0.0, flow_max: None, delay_s: 0.0 }
    }

    /// Flow at `voltage` (m³/s, V).
    #[inline]
    pub fn flow(&self, voltage: f64) -> f64 {
        if voltage < self.start_voltage {
            return 0.0;
        }
        let flow = larger(self.gain * voltage + self.offset, 0.0);
        self.flow_max.map_or(flow, |most| smaller(flow, most))
    }

    /// The pump with a largest flow (m³/s); without one where the voltage limits it to less anyway.
    #[must_use]
    pub fn limited_to(self, flow: f64) -> Self {
        let unlimited = Self { flow_max: None, ..self };
        Self { flow_max: (flow < unlimited.flow(self.voltage_max)).then_some(flow), ..self }
    }

    /// Voltage on the straight line of the curve at which the flow is `flow` (V, m³/s).
    pub fn voltage_for(&self, flow: f64) -> f64 {
        (flow - self.offset) / self.gain
    }

    /// The voltages within the limits at which the flow follows the voltage (V): there, and only there, the pump has its gain. The
    /// first is above the second where there is none.
    pub fn acting_range(&self) -> (f64, f64) {
        let first_flow = if self.offset == 0.0 { 0.0 } else { self.voltage_for(0.0) };
        let least = self.voltage_min.max(0.0).max(self.start_voltage).max(first_flow);
        let most = self.flow_max.map_or(self.voltage_max, |flow| self.voltage_max.min(self.voltage_for(flow)));
        (least, most)
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    const PROPORTIONAL: Pump = Pump::proportional(3e-6, 0.0, 10.0);
    /// 3 cm³/s for each volt beyond 1 V, nothing below 2 V, 20 cm³/s at most.
    const CURVED: Pump = Pump { offset: -3e-6, start_voltage: 2.0, flow_max: Some(20e-6), ..PROPORTIONAL };

    #[test]
    fn a_curve_has_a_dead_zone_a_line_and_an_end() {
        let flows = [-1.0, 0.0, 1.5, 1.999, 2.0, 5.0, 7.5, 10.0].map(|voltage| CURVED.flow(voltage));
        for (found, expected) in flows.into_iter().zip([0.0, 0.0, 0.0, 0.0, 3e-6, 12e-6, 19.5e-6, 20e-6]) {
            assert_relative_eq!(found, expected, max_relative = 1e-14);
        }
        assert_relative_eq!(CURVED.voltage_for(12e-6), 5.0, max_relative = 1e-14);
        assert_eq!(PROPORTIONAL.flow(-1.0), 0.0);
        assert_eq!(PROPORTIONAL.limited_to(20e-6).flow_max, Some(20e-6));
        assert_eq!(CURVED.limited_to(27e-6).flow_max, None);
    }

    #[test]
    fn the_flow_follows_the_voltage_on_the_line_only() {
        let (least, most) = CURVED.acting_range();
        assert_eq!(least, 2.0);
        assert_relative_eq!(most, 23.0 / 3.0, max_relative = 1e-14);
        assert_eq!(PROPORTIONAL.acting_range(), (0.0, 10.0));
        let lifted = Pump { offset: -6e-6, ..PROPORTIONAL };
        assert_relative_eq!(lifted.acting_range().0, 2.0, max_relative = 1e-14);
        // More than nothing at 0 V: all of the limits.
        assert_eq!(Pump { offset: 6e-6, ..PROPORTIONAL }.acting_range(), (0.0, 10.0));
        let (least, most) = Pump { flow_max: Some(1e-6), ..CURVED }.acting_range();
        assert!(least > most);
    }
}
