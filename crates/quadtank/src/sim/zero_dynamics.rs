//! Zero dynamics of the nonlinear plant: the motion of the upper levels while levels 1 and 2 are held constant.

use crate::numeric::runge_kutta_step;
use crate::plant::{Disturbance, QuadrupleTank};

/// Step of the integration, as a share of the smaller time constant of the upper tanks at the start.
const STEP: f64 = 1.0 / 50.0;

/// Most steps of a prediction.
const MAX_STEPS: f64 = 100_000.0;

/// Zero dynamics of the plant: the motion of the upper levels while the pumps hold levels 1 and 2 exactly, by whatever voltages
/// that takes. The valves stand still.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ZeroDynamics<'a> {
    plant: &'a QuadrupleTank,
    /// Outflow of the lower tanks (m³/s).
    outflow: [f64; 2],
}

/// What ends the motion along the zero dynamics: from there on both outputs cannot be held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ZeroDynamicsEnd {
    /// A pump would have to leave its limits.
    Pump {
        /// Index of the pump.
        pump: usize,
        /// When (s from the start).
        after_s: f64,
    },
    /// An upper tank runs over.
    Overflow {
        /// Index of the tank.
        tank: usize,
        /// When (s from the start).
        after_s: f64,
    },
}

impl ZeroDynamicsEnd {
    /// When it ends (s from the start of the prediction).
    pub const fn after_s(self) -> f64 {
        match self {
            Self::Pump { after_s, .. } | Self::Overflow { after_s, .. } => after_s,
        }
    }
}

impl<'a> ZeroDynamics<'a> {
    /// Levels 1 and 2 held at `references` (m).
    pub fn new(plant: &'a QuadrupleTank, references: [f64; 2]) -> Self {
        let outflow = [0, 1].map(|tank| plant.tanks[tank].outflow(references[tank], plant.gravity));
        Self { plant, outflow }
    }

    /// The pump voltages (V) that hold the outputs with the upper tanks at `upper` (m): what a lower tank does not get from
    /// above and from outside its own pump must give, `γ_i q_i = o_i − o_{i+2}` with the flow `q` of the pump and the outflows `o`.
    pub fn voltages(&self, upper: [f64; 2]) -> [f64; 2] {
        let plant = self.plant;
        [0, 1].map(|i| {
            let from_above = plant.tanks[i + 2].outflow(upper[i].max(0.0), plant.gravity);
            plant.pumps[i].voltage_for(plant.valves()[i].flow_for(self.outflow[i] - from_above - plant.inflow[i]))
        })
    }

    /// Rates of change of the upper levels (m/s) at `upper` (m). Linear around the equilibrium, they have the transmission
    /// zeros as eigenvalues.
    pub fn rates(&self, upper: [f64; 2]) -> [f64; 2] {
        let flows = self.plant.feed_flows(&self.voltages(upper), &Disturbance::default());
        [0, 1].map(|i| {
            let (tank, level) = (&self.plant.tanks[i + 2], upper[i].max(0.0));
            (flows[i + 2] - tank.outflow(level, self.plant.gravity)) / tank.section.area(level)
        })
    }

    /// What first ends the motion from the levels `upper` (m) on; `None` when nothing does within `within_s` (s).
    pub fn ends(&self, upper: [f64; 2], within_s: f64) -> Option<ZeroDynamicsEnd> {
        let quickest = [0, 1].map(|i| {
            let (tank, level) = (&self.plant.tanks[i + 2], upper[i].max(1e-3));
            tank.section.area(level) / tank.outflow_slope(level, self.plant.gravity)
        });
        let step = (STEP * quickest[0].min(quickest[1])).max(within_s / MAX_STEPS);
        let (mut levels, mut now) = (upper, 0.0);
        while now <= within_s {
            if let Some(end) = self.end_at(levels, now) {
                return Some(end);
            }
            levels = runge_kutta_step(|upper| self.rates(upper), levels, step);
            now += step;
        }
        None
    }

    fn end_at(&self, upper: [f64; 2], after_s: f64) -> Option<ZeroDynamicsEnd> {
        let voltages = self.voltages(upper);
        let within = |pump: usize| {
            let (least, most) = self.plant.pumps[pump].acting_range();
            (least..=most).contains(&voltages[pump])
        };
        if let Some(pump) = (0..2).find(|&pump| !within(pump)) {
            return Some(ZeroDynamicsEnd::Pump { pump, after_s });
        }
        let over = (0..2).find(|&i| upper[i] > self.plant.tanks[i + 2].height);
        over.map(|i| ZeroDynamicsEnd::Overflow { tank: i + 2, after_s })
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::linear::{Complex, StateSpace, transmission_zeros};
    use crate::literature::PresetId;

    #[test]
    fn at_rest_nothing_moves_and_around_it_the_zeros_are_the_rates() {
        // In shares of the flow at rest, so that they mean as much on any rig.
        let growths = [[0.0, 0.0], [0.14, -0.1]];
        for (id, growth) in PresetId::ALL.into_iter().flat_map(|id| growths.map(|growth| (id, growth))) {
            let preset = id.preset();
            let flow = [0, 1].map(|pump: usize| preset.plant.pumps[pump].flow(preset.pump_voltage[pump]));
            let valve_slopes = [growth[0] / flow[0], growth[1] / flow[1]];
            let plant = QuadrupleTank { valve_slopes, ..preset.plant };
            let op = plant.free_equilibrium(preset.pump_voltage);
            let zero_dynamics = ZeroDynamics::new(&plant, [op.levels[0], op.levels[1]]);
            let upper = [op.levels[2], op.levels[3]];
            for i in 0..2 {
                assert_relative_eq!(zero_dynamics.voltages(upper)[i], op.pump_voltage[i], max_relative = 1e-9);
                assert!(zero_dynamics.rates(upper)[i].abs() < 1e-12);
            }
            let nudge = 1e-6;
            let column = |k: usize| {
                let moved = |sign: f64| {
                    let mut upper = upper;
                    upper[k] += sign * nudge;
                    zero_dynamics.rates(upper)
                };
                let (up, down) = (moved(1.0), moved(-1.0));
                [0, 1].map(|i| (up[i] - down[i]) / (2.0 * nudge))
            };
            let [[a, c], [b, d]] = [column(0), column(1)];
            let (a_matrix, b_matrix, c_matrix) = plant.linearise(&op).reduced();
            let model = StateSpace::strictly_proper(a_matrix, b_matrix, c_matrix).unwrap();
            let zeros = transmission_zeros(&model).unwrap();
            // They may be a conjugate pair where fractions depend on the flow.
            let (sum, product): (Complex, Complex) =
                (zeros.iter().map(|zero| zero.value).sum(), zeros.iter().map(|zero| zero.value).product());
            assert_relative_eq!(a + d, sum.re, max_relative = 1e-5);
            assert_relative_eq!(a * d - b * c, product.re, max_relative = 1e-5);
        }
    }
}
