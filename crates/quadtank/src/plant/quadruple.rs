use std::array::from_fn;

use serde::{Deserialize, Serialize};

use crate::numeric::{complements, larger};

use super::tank::torricelli_speed;
use super::{FlowFractions, Pump, Tank, Valve};

/// The level sensors of the two lower tanks: `y = gain × level`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Sensor {
    /// Sensor gain `k_c` (V/m).
    pub gain: f64,
    /// Level above which the signal saturates (m).
    pub range: f64,
    /// Smallest signal difference that the sensor tells apart (V); 0 for an ideal one.
    pub resolution: f64,
}

impl Sensor {
    /// Signal of an ideal sensor at `level` (V), `k_c h`.
    #[inline]
    pub fn measure(&self, level: f64) -> f64 {
        self.gain * level
    }

    /// Signal of the real sensor for the ideal `signal` (both V): limited to its range, then rounded to its resolution.
    #[inline]
    pub fn quantise(&self, signal: f64) -> f64 {
        let limited = signal.max(0.0).min(self.gain * self.range);
        if self.resolution > 0.0 { (limited / self.resolution).round() * self.resolution } else { limited }
    }
}

/// The quadruple-tank process of Johansson (2000), with the trapezoidal tank, the losses and the power module of
/// Cocota (2009, eqs. 3.1–3.4).
///
/// Tanks 1 and 2 are below, 3 drains into 1, 4 into 2. Pump 1 feeds tank 1 with the fraction γ1 and tank 4 with the
/// rest; pump 2 feeds tank 2 with the fraction γ2 and tank 3 with the rest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct QuadrupleTank {
    /// Tanks 1 to 4.
    pub tanks: [Tank; 4],
    /// Pumps 1 and 2.
    pub pumps: [Pump; 2],
    /// Valve fractions γ1, γ2, each in [0, 1].
    pub valves: [f64; 2],
    /// Growth s1, s2 of the valve fractions with the flow through each valve (s/m³): γ is then the fraction to which that of the flow
    /// tends as it goes to 0, see [`Valve`].
    #[serde(default, skip_serializing_if = "is_alike_at_any_flow")]
    pub valve_slopes: [f64; 2],
    /// Gain of the power module between controller output and pump voltage (Cocota 2009: `k_mod`); 1 where there is none.
    pub power_gain: f64,
    /// The level sensors.
    pub sensor: Sensor,
    /// Acceleration of gravity (m/s²).
    pub gravity: f64,
    /// Constant flow that each tank receives from outside of the rig (m³/s), as from the disturbance pumps of the modified
    /// four-tank system (Azam and Jørgensen 2015).
    #[serde(default, skip_serializing_if = "is_nothing")]
    pub inflow: [f64; 4],
}

/// Whether no tank receives anything from outside, as on most rigs.
fn is_nothing(inflow: &[f64; 4]) -> bool {
    *inflow == [0.0; 4]
}

/// Whether the valves divide any flow alike, as on most rigs.
fn is_alike_at_any_flow(valve_slopes: &[f64; 2]) -> bool {
    *valve_slopes == [0.0; 2]
}

/// Loads that act on the plant besides its inputs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Disturbance {
    /// Flow added to that of each pump, ahead of its valve (m³/s); may be negative.
    pub pump_flow: [f64; 2],
    /// Area of an additional hole in the bottom of each tank whose water leaves the plant (m²).
    pub leak_area: [f64; 4],
    /// Flow added to that which each tank receives from outside (m³/s); may be negative.
    pub tank_flow: [f64; 4],
    /// Share by which the flow of each pump grows at any voltage; −1 stops it.
    pub pump_gain_change: [f64; 2],
    /// Change of each valve fraction; the sum stays within [0, 1].
    pub valve_change: [f64; 2],
    /// Share by which the outlet of each tank widens; −1 closes it.
    pub outlet_change: [f64; 4],
}

impl Disturbance {
    /// Valve fractions under the load, where they are `[γ1, γ2]` without it.
    #[inline]
    pub fn valves(&self, valves: [f64; 2]) -> [f64; 2] {
        from_fn(|i| (valves[i] + self.valve_change[i]).clamp(0.0, 1.0))
    }

    /// Area of each outlet under the load as a share of its area without, at least 0.
    #[inline]
    pub fn outlet_share(&self) -> [f64; 4] {
        self.outlet_change.map(|change| larger(1.0 + change, 0.0))
    }

    /// Flow of each pump under the load as a share of its flow without, at least 0.
    #[inline]
    pub fn pump_share(&self) -> [f64; 2] {
        self.pump_gain_change.map(|change| larger(1.0 + change, 0.0))
    }

    /// Flow of a pump under the load (m³/s), where it is `flow` (m³/s) without it.
    #[inline]
    fn flow_of_pump(&self, pump: usize, flow: f64) -> f64 {
        larger(self.pump_share()[pump] * flow + self.pump_flow[pump], 0.0)
    }
}

impl QuadrupleTank {
    /// The same plant with the valves set to `[γ1, γ2]`.
    #[must_use]
    pub fn with_valves(self, valves: [f64; 2]) -> Self {
        Self { valves, ..self }
    }

    /// The valve of each pump.
    pub fn valves(&self) -> [Valve; 2] {
        self.valves_at(self.valves)
    }

    /// The same with the valves set to `[γ1, γ2]`.
    #[inline]
    fn valves_at(&self, fractions: [f64; 2]) -> [Valve; 2] {
        from_fn(|i| Valve { fraction: fractions[i], slope: self.valve_slopes[i] })
    }

    /// Whether the fraction of a valve depends on the flow through it.
    pub fn has_flow_dependent_valves(&self) -> bool {
        !is_alike_at_any_flow(&self.valve_slopes)
    }

    /// Valve fractions γ1(q1), γ2(q2) of the flows that these pump voltages (V) make.
    pub fn fractions_at(&self, pump_voltage: [f64; 2]) -> [f64; 2] {
        from_fn(|i| self.valves()[i].fraction_at(self.pumps[i].flow(pump_voltage[i])))
    }

    /// How the valves divide flows at these pump voltages (V); `None` where they divide any flow alike.
    pub fn flow_fractions(&self, pump_voltage: [f64; 2]) -> Option<FlowFractions> {
        let incremental = self.incremental_fractions(pump_voltage);
        self.has_flow_dependent_valves()
            .then(|| FlowFractions { of_flow: self.fractions_at(pump_voltage), incremental })
    }

    /// Incremental valve fractions γ̃1, γ̃2 at these pump voltages (V), which take the place of γ1 and γ2 in a linear model; see
    /// [`Valve::incremental_fraction`].
    pub fn incremental_fractions(&self, pump_voltage: [f64; 2]) -> [f64; 2] {
        from_fn(|i| self.valves()[i].incremental_fraction(self.pumps[i].flow(pump_voltage[i])))
    }

    /// Rates of change of the four levels (m/s) at the given levels (m) and pump voltages (V) under the given loads
    /// (Cocota 2009, eqs. 3.1–3.4).
    ///
    /// Neither walls nor voltage limits are applied. A level below 0 drains nothing, and a flow of a pump or from outside that a
    /// load turns negative counts as none.
    #[inline]
    pub fn derivative(&self, levels: &[f64; 4], pump_voltage: &[f64; 2], disturbance: &Disturbance) -> [f64; 4] {
        let net = self.net_inflows(levels, pump_voltage, disturbance);
        from_fn(|j| net[j] / self.tanks[j].section.area(levels[j]))
    }

    /// Water that each tank receives less what it loses (m³/s).
    #[inline]
    pub(super) fn net_inflows(
        &self,
        levels: &[f64; 4],
        pump_voltage: &[f64; 2],
        disturbance: &Disturbance,
    ) -> [f64; 4] {
        let inflow = self.feed_flows(pump_voltage, disturbance);
        let speed = levels.map(|level| torricelli_speed(level, self.gravity));
        let share = disturbance.outlet_share();
        let outflow: [f64; 4] = from_fn(|j| share[j] * self.tanks[j].outlet.effective_area() * speed[j]);
        let from_above = [outflow[2], outflow[3], 0.0, 0.0];
        from_fn(|j| inflow[j] + from_above[j] - outflow[j] - disturbance.leak_area[j] * speed[j])
    }

    /// Flow that each tank receives but for what drains into it (m³/s): through the valves and from outside.
    #[inline]
    pub fn feed_flows(&self, pump_voltage: &[f64; 2], disturbance: &Disturbance) -> [f64; 4] {
        self.feed_flows_at(self.valves, pump_voltage, disturbance)
    }

    /// The same with the valves at `[γ1, γ2]` before any load.
    #[inline]
    pub fn feed_flows_at(&self, valves: [f64; 2], pump_voltage: &[f64; 2], disturbance: &Disturbance) -> [f64; 4] {
        let through_valves = self.valve_flows_at(valves, pump_voltage, disturbance);
        let from_outside = self.flows_from_outside(disturbance);
        from_fn(|j| through_valves[j] + from_outside[j])
    }

    /// Flow that each tank receives from outside of the rig (m³/s).
    #[inline]
    pub fn flows_from_outside(&self, disturbance: &Disturbance) -> [f64; 4] {
        from_fn(|j| larger(self.inflow[j] + disturbance.tank_flow[j], 0.0))
    }

    /// Flow that each tank receives through the valves (m³/s): `γ1 q1`, `γ2 q2`, `(1 − γ2) q2`, `(1 − γ1) q1`, where γ may depend on q.
    #[inline]
    pub fn valve_flows(&self, pump_voltage: &[f64; 2], disturbance: &Disturbance) -> [f64; 4] {
        self.valve_flows_at(self.valves, pump_voltage, disturbance)
    }

    /// The same with the valves at `[γ1, γ2]` before any load.
    #[inline]
    pub fn valve_flows_at(&self, valves: [f64; 2], pump_voltage: &[f64; 2], disturbance: &Disturbance) -> [f64; 4] {
        let flows: [f64; 2] = from_fn(|i| disturbance.flow_of_pump(i, self.pumps[i].flow(pump_voltage[i])));
        let valves = self.valves_at(disturbance.valves(valves));
        let fractions = from_fn(|i| valves[i].fraction_at(flows[i]));
        let ([q1, q2], [gamma_1, gamma_2], [above_1, above_2]) = (flows, fractions, complements(fractions));
        [gamma_1 * q1, gamma_2 * q2, above_2 * q2, above_1 * q1]
    }

    /// Flow through the outlet of each tank at the given levels (m³/s).
    pub fn outflows(&self, levels: &[f64; 4]) -> [f64; 4] {
        from_fn(|j| self.tanks[j].outflow(levels[j], self.gravity))
    }

    /// Lowest and highest controller output of each pump (V): its voltage limits ahead of the power module.
    pub fn controller_limits(&self) -> [(f64, f64); 2] {
        self.pumps.map(|pump| (pump.voltage_min / self.power_gain, pump.voltage_max / self.power_gain))
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::literature::PresetId;

    #[test]
    fn sensor_limits_then_rounds() {
        let sensor = Sensor { gain: 100.0 / 3.0, range: 0.3, resolution: 10.0 / 2_f64.powi(11) };
        assert_relative_eq!(sensor.measure(0.15), 5.0, max_relative = 1e-15);
        assert_eq!(sensor.quantise(-1.0), 0.0);
        assert_relative_eq!(sensor.quantise(11.0), 10.0, max_relative = 1e-15);
        assert_eq!(sensor.quantise(0.4 * sensor.resolution), 0.0);
        assert_eq!(sensor.quantise(3.6 * sensor.resolution), 4.0 * sensor.resolution);
        assert_eq!(Sensor { resolution: 0.0, ..sensor }.quantise(1.234), 1.234);
    }

    #[test]
    fn controller_limits_are_ahead_of_the_power_module() {
        let mut plant = PresetId::CocotaMinimumPhase.preset().plant;
        plant.pumps[1].voltage_min = 2.4;
        let [first, second] = plant.controller_limits();
        for (found, expected) in [(first, (0.0, 10.0)), (second, (2.0, 10.0))] {
            assert_relative_eq!(found.0, expected.0, max_relative = 1e-15);
            assert_relative_eq!(found.1, expected.1, max_relative = 1e-15);
        }
    }

    #[test]
    fn a_load_on_a_pump_passes_its_valve() {
        let plant = PresetId::JohanssonMinimumPhase.preset().plant;
        let load = Disturbance { pump_flow: [1e-6, 0.0], ..Disturbance::default() };
        let [tank_1, tank_2, tank_3, tank_4] = plant.valve_flows(&[0.0, 0.0], &load);
        assert_relative_eq!(tank_1, 0.7e-6, max_relative = 1e-12);
        assert_relative_eq!(tank_4, 0.3e-6, max_relative = 1e-12);
        assert_eq!([tank_2, tank_3], [0.0, 0.0]);
    }

    #[test]
    fn no_load_makes_a_pump_suck() {
        let plant = PresetId::JohanssonMinimumPhase.preset().plant;
        let load = Disturbance { pump_flow: [-1.0, 0.0], ..Disturbance::default() };
        assert_eq!(plant.derivative(&[0.0; 4], &[3.0, 0.0], &load), [0.0; 4]);
    }

    #[test]
    fn a_leak_takes_water_from_its_tank_only() {
        let plant = PresetId::JohanssonMinimumPhase.preset().plant;
        let levels = [0.12, 0.13, 0.02, 0.01];
        let leak = Disturbance { leak_area: [0.0, 0.0, 1e-6, 0.0], ..Disturbance::default() };
        let with = plant.derivative(&levels, &[3.0; 2], &leak);
        let without = plant.derivative(&levels, &[3.0; 2], &Disturbance::default());
        let lost = 1e-6 * (2.0 * 9.81 * 0.02_f64).sqrt() / 28e-4;
        assert_relative_eq!(without[2] - with[2], lost, max_relative = 1e-9);
        assert_eq!([with[0], with[1], with[3]], [without[0], without[1], without[3]]);
    }
}
