use serde::{Deserialize, Serialize};

use super::{Disturbance, PlantError, QuadrupleTank};
use crate::numeric::{complements, excess_over_one};

/// Distance of γ1 + γ2 from 1 below which the plant counts as singular at steady state.
///
/// The flow balance has the condition number `≈ 1/|γ1 + γ2 − 1|`: closer than this, rounding alone leaves fewer than
/// seven digits in the voltages that [`QuadrupleTank::inputs_for_levels`] finds.
pub const SINGULAR_MARGIN: f64 = 1e-9;

/// Most steps of Newton's method, and how often one is halved at most, to find the flows that valves with a slope need.
const MAX_STEPS: u32 = 60;
const MAX_HALVED: i32 = 40;

/// What is left of a flow balance by rounding, as a share of the flow.
const BALANCED: f64 = 1e-14;

/// Levels and voltages around which the plant is looked at. It rests there where the voltages hold the levels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct OperatingPoint {
    /// Levels h1…h4 (m).
    pub levels: [f64; 4],
    /// Pump voltages (V).
    pub pump_voltage: [f64; 2],
}

impl QuadrupleTank {
    /// The levels that the given pump voltages (V) hold, by the flow balance of each tank (Cocota 2009, §3.2.1); walls
    /// and voltage limits are ignored. A negative voltage pumps nothing.
    pub fn free_equilibrium(&self, pump_voltage: [f64; 2]) -> OperatingPoint {
        let [q1, q2, q3, q4] = self.feed_flows(&pump_voltage, &Disturbance::default());
        let inflow = [q1 + q3, q2 + q4, q3, q4];
        let levels = std::array::from_fn(|j| self.tanks[j].level_for_outflow(inflow[j], self.gravity));
        OperatingPoint { levels, pump_voltage }
    }

    /// The levels that the given pump voltages (V) hold.
    ///
    /// # Errors
    /// The first of the [`violations`](Self::violations): [`PlantError::VoltageOutOfRange`], or
    /// [`PlantError::LevelOutOfRange`] when a tank would overflow.
    pub fn equilibrium(&self, pump_voltage: [f64; 2]) -> Result<OperatingPoint, PlantError> {
        self.checked(self.free_equilibrium(pump_voltage))
    }

    /// The pump voltages that hold the given levels (m) of tanks 1 and 2, and the levels of tanks 3 and 4 that follow:
    /// `[q1; q2] = [γ1 k1, (1 − γ2) k2; (1 − γ1) k1, γ2 k2] [ϑ1; ϑ2]` with `q = k_l a √(2 g h)` (Cocota 2009, §3.2.1), less what
    /// comes from outside.
    ///
    /// # Errors
    /// - [`PlantError::LevelOutOfRange`]: a given level is negative or above the walls, or an upper tank would overflow.
    /// - [`PlantError::SingularPlant`]: γ1 + γ2 is within [`SINGULAR_MARGIN`] of 1. Where the fractions depend on the flow, γ̃1 + γ̃2
    ///   counts (see [`Valve`](super::Valve)), and levels beyond those at which it is 1.
    /// - [`PlantError::VoltageOutOfRange`]: a pump would leave its limits, or have to take water out of the plant.
    pub fn inputs_for_levels(&self, levels: [f64; 2]) -> Result<OperatingPoint, PlantError> {
        if let Some(error) = levels.into_iter().enumerate().find_map(|(tank, level)| self.level_violation(tank, level))
        {
            return Err(error);
        }
        if self.has_flow_dependent_valves() {
            let flows = self.balancing_flows(self.pumped_at_rest(levels))?;
            // The levels that these voltages hold differ from the given ones by rounding, which a fraction that is the small difference of
            // two numbers makes larger: with the given ones the plant would not be at rest.
            return self.equilibrium([0, 1].map(|pump| self.pumps[pump].voltage_for(flows[pump])));
        }
        check_gain(self.valves[0] + self.valves[1])?;
        let needed = self.checked(self.free_equilibrium(self.balancing_voltages(levels)))?;
        Ok(OperatingPoint { levels: [levels[0], levels[1], needed.levels[2], needed.levels[3]], ..needed })
    }

    /// As [`inputs_for_levels`](Self::inputs_for_levels), and also where the plant is singular but the levels happen to be
    /// among those that it can hold: each pump then gives just what its lower tank loses.
    ///
    /// # Errors
    /// As [`inputs_for_levels`](Self::inputs_for_levels).
    pub fn rest_at(&self, levels: [f64; 2]) -> Result<OperatingPoint, PlantError> {
        let found = self.inputs_for_levels(levels);
        if !matches!(found, Err(PlantError::SingularPlant { .. })) {
            return found;
        }
        let flow = self.pumped_at_rest(levels);
        let point = self.free_equilibrium([0, 1].map(|pump| self.pumps[pump].voltage_for(flow[pump])));
        let holds = (0..2).all(|i| (point.levels[i] - levels[i]).abs() <= SINGULAR_MARGIN * levels[i].abs());
        if holds { self.checked(point) } else { found }
    }

    /// What keeps an operating point from existing on the rig: first the voltages outside their limits, then the levels
    /// outside the walls. Empty for a feasible point.
    pub fn violations(&self, operating_point: &OperatingPoint) -> Vec<PlantError> {
        self.violations_of(operating_point).collect()
    }

    /// The flows of the pumps (m³/s) that bring the lower tanks `needed` (m³/s), by way of the upper ones too, where fractions depend
    /// on them. Both together are what both tanks need, so that one equation is left, `γ1(q1) q1 + (1 − γ2(q2)) q2 = needed1`, whose
    /// slope is γ̃1 + γ̃2 − 1. It may have two solutions, one on each side of slope 0; from equal flows on Newton's method finds the
    /// one on their side.
    ///
    /// # Errors
    /// [`PlantError::SingularPlant`] where it ends with the slope 0.
    fn balancing_flows(&self, needed: [f64; 2]) -> Result<[f64; 2], PlantError> {
        let total = needed[0] + needed[1];
        let valves = self.valves();
        let lower = |i: usize, flow: f64| valves[i].fraction_at(flow) * flow;
        let excess = |q1: f64| lower(0, q1) + (total - q1) - lower(1, total - q1) - needed[0];
        let gamma_sum = |q1: f64| valves[0].incremental_fraction(q1) + valves[1].incremental_fraction(total - q1);
        let mut q1 = 0.5 * total;
        for _ in 0..MAX_STEPS {
            check_gain(gamma_sum(q1))?;
            let step = excess(q1) / (gamma_sum(q1) - 1.0);
            let is_closer = |tried: &f64| excess(*tried).abs() < excess(q1).abs();
            let Some(next) = (0..MAX_HALVED).map(|times| q1 - step * 0.5_f64.powi(times)).find(is_closer) else {
                break;
            };
            q1 = next;
        }
        if excess(q1).abs() > BALANCED * total.abs() {
            return Err(PlantError::SingularPlant { gamma_sum: gamma_sum(q1) });
        }
        Ok([q1, total - q1])
    }

    /// Solves the flow balance of the lower tanks for the pump voltages (V), without any check; the fractions are the same for any
    /// flow.
    pub(crate) fn balancing_voltages(&self, levels: [f64; 2]) -> [f64; 2] {
        let ([gamma_1, gamma_2], [above_1, above_2]) = (self.valves, complements(self.valves));
        let [k1, k2] = self.pumps.map(|pump| pump.gain);
        let determinant = excess_over_one(self.valves);
        let solve = |[q1, q2]: [f64; 2]| {
            [(gamma_2 * q1 - above_2 * q2) / (determinant * k1), (gamma_1 * q2 - above_1 * q1) / (determinant * k2)]
        };
        let flow = self.pumped_at_rest(levels);
        let [v1, v2] = solve(flow);
        // A step of iterative refinement: near the singular line Cramer's rule leaves more of the balance than rounding.
        let left = [flow[0] - gamma_1 * k1 * v1 - above_2 * k2 * v2, flow[1] - gamma_2 * k2 * v2 - above_1 * k1 * v1];
        let [more_1, more_2] = solve(left);
        // What the curve of each pump gives at 0 V needs no voltage.
        let [free_1, free_2] = self.pumps.map(|pump| pump.offset / pump.gain);
        [v1 + more_1 - free_1, v2 + more_2 - free_2]
    }

    /// What the pumps have to bring each lower tank, by way of its upper one too, so that it rests at its level (m³/s).
    fn pumped_at_rest(&self, levels: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|i| self.tanks[i].outflow(levels[i], self.gravity) - self.inflow[i] - self.inflow[i + 2])
    }

    fn checked(&self, operating_point: OperatingPoint) -> Result<OperatingPoint, PlantError> {
        self.violations_of(&operating_point).next().map_or(Ok(operating_point), Err)
    }

    fn violations_of(&self, operating_point: &OperatingPoint) -> impl Iterator<Item = PlantError> {
        let voltages = operating_point.pump_voltage.into_iter().enumerate();
        let levels = operating_point.levels.into_iter().enumerate();
        voltages
            .filter_map(|(pump, voltage)| self.voltage_violation(pump, voltage))
            .chain(levels.filter_map(|(tank, level)| self.level_violation(tank, level)))
    }

    fn voltage_violation(&self, pump: usize, value: f64) -> Option<PlantError> {
        let (min, max) = self.pumps.get(pump)?.acting_range();
        (!(min..=max).contains(&value)).then_some(PlantError::VoltageOutOfRange { pump, value, min, max })
    }

    fn level_violation(&self, tank: usize, value: f64) -> Option<PlantError> {
        let max = self.tanks.get(tank)?.height;
        (!(0.0..=max).contains(&value)).then_some(PlantError::LevelOutOfRange { tank, value, max })
    }
}

/// Whether the gain at steady state can be inverted, with valve fractions of this sum.
fn check_gain(gamma_sum: f64) -> Result<(), PlantError> {
    if (gamma_sum - 1.0).abs() < SINGULAR_MARGIN { Err(PlantError::SingularPlant { gamma_sum }) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::literature::PresetId;

    fn johansson(valves: [f64; 2]) -> QuadrupleTank {
        PresetId::JohanssonMinimumPhase.preset().plant.with_valves(valves)
    }

    #[test]
    fn singular_plant_on_the_line_and_at_its_ends() {
        for valves in [[0.5, 0.5], [0.7, 0.3], [1.0, 0.0], [0.0, 1.0], [0.43, 0.57 + 1e-12]] {
            let plant = johansson(valves);
            let expected = PlantError::SingularPlant { gamma_sum: valves[0] + valves[1] };
            assert_eq!(plant.inputs_for_levels([0.12, 0.12]), Err(expected));
            // Inputs still have their equilibrium.
            assert!(plant.free_equilibrium([3.0, 3.0]).levels.iter().all(|level| level.is_finite()));
        }
    }

    #[test]
    fn on_the_line_some_levels_can_still_be_held() {
        let plant = PresetId::JunqueiraA.preset().plant.with_valves([0.5, 0.5]);
        let point = plant.rest_at([0.1, 0.1]).unwrap();
        // As with any other equal valves (Junqueira, Neves and Angelico, eqs. 1 to 4 at rest).
        let elsewhere = plant.with_valves([0.6, 0.6]).rest_at([0.1, 0.1]).unwrap();
        for i in 0..2 {
            assert!((point.levels[i] - 0.1).abs() < 1e-12);
            assert!((point.pump_voltage[i] - elsewhere.pump_voltage[i]).abs() < 1e-9);
        }
        assert!(matches!(plant.rest_at([0.1, 0.12]), Err(PlantError::SingularPlant { .. })));
    }

    #[test]
    fn the_singular_band_is_as_narrow_as_stated() {
        let outside = johansson([0.5, 0.5 + 2.0 * SINGULAR_MARGIN]).inputs_for_levels([0.12, 0.12]);
        assert!(!matches!(outside, Err(PlantError::SingularPlant { .. })));
        let inside = johansson([0.5, 0.5 + 0.5 * SINGULAR_MARGIN]).inputs_for_levels([0.12, 0.12]);
        assert!(matches!(inside, Err(PlantError::SingularPlant { .. })));
    }

    #[test]
    fn levels_are_held_where_fractions_depend_on_the_flow() {
        let rigs = [PresetId::JohanssonMinimumPhase, PresetId::JohanssonNonMinimumPhase, PresetId::CocotaMinimumPhase];
        for plant in rigs.map(|id| id.preset().plant) {
            for slopes in [[3e3, -2e3], [-2e3, 0.0], [0.0, 4e3]] {
                let plant = QuadrupleTank { valve_slopes: slopes, ..plant };
                let point = plant.equilibrium([3.0, 3.2]).unwrap();
                let found = plant.inputs_for_levels([point.levels[0], point.levels[1]]).unwrap();
                for i in 0..2 {
                    let (found, expected) = (found.pump_voltage[i], point.pump_voltage[i]);
                    assert!((found - expected).abs() < 1e-9, "{slopes:?}: {found} {expected}");
                }
            }
        }
    }

    #[test]
    fn levels_beyond_the_fold_of_the_flows_are_not_held() {
        // γ̃1 + γ̃2 = 1 at 10 cm³/s of pump 1, where the share of tank 1 of all water is the largest that there is.
        let plant = QuadrupleTank { valve_slopes: [-5e3, 0.0], ..johansson([0.55, 0.55]) };
        let result = plant.inputs_for_levels([0.12, 0.02]);
        assert!(
            matches!(result, Err(PlantError::SingularPlant { gamma_sum }) if (gamma_sum - 1.0).abs() < 1e-3),
            "{result:?}"
        );
    }

    #[test]
    fn levels_outside_the_walls() {
        let plant = johansson([0.7, 0.6]);
        for (levels, tank, value) in [([-0.01, 0.1], 0, -0.01), ([0.1, 0.21], 1, 0.21)] {
            let expected = PlantError::LevelOutOfRange { tank, value, max: 0.2 };
            assert_eq!(plant.inputs_for_levels(levels), Err(expected));
        }
        assert!(matches!(plant.inputs_for_levels([f64::NAN, 0.1]), Err(PlantError::LevelOutOfRange { tank: 0, .. })));
    }

    #[test]
    fn an_upper_tank_that_would_overflow() {
        // The outlets above are the smaller ones, and γ = 0.2 sends four fifths of the water through them.
        let plant = PresetId::CocotaNonMinimumPhase.preset().plant.with_valves([0.2, 0.2]);
        let result = plant.inputs_for_levels([0.15, 0.15]);
        assert!(matches!(result, Err(PlantError::LevelOutOfRange { tank: 2 | 3, value, max: 0.395 }) if value > 0.395));
    }

    #[test]
    fn a_pump_that_would_have_to_suck() {
        let result = johansson([0.7, 0.6]).inputs_for_levels([0.19, 0.01]);
        assert!(matches!(result, Err(PlantError::VoltageOutOfRange { pump: 1, value, min: 0.0, .. }) if value < 0.0));
        // A lower limit below 0 does not make it possible.
        let mut plant = johansson([0.7, 0.6]);
        plant.pumps = plant.pumps.map(|pump| crate::plant::Pump { voltage_min: -10.0, ..pump });
        assert_eq!(plant.inputs_for_levels([0.19, 0.01]), result);
    }

    #[test]
    fn a_pump_that_is_too_weak() {
        let mut plant = johansson([0.7, 0.6]);
        plant.pumps[0].voltage_max = 2.0;
        assert_eq!(
            plant.equilibrium([3.0, 3.0]),
            Err(PlantError::VoltageOutOfRange { pump: 0, value: 3.0, min: 0.0, max: 2.0 })
        );
        let needed = plant.inputs_for_levels([0.12, 0.12]);
        assert!(matches!(needed, Err(PlantError::VoltageOutOfRange { pump: 0, max: 2.0, .. })));
    }

    #[test]
    fn every_violation_is_named() {
        let plant = johansson([0.7, 0.6]);
        let point = plant.free_equilibrium([11.0, -1.0]);
        let found = plant.violations(&point);
        assert!(found.contains(&PlantError::VoltageOutOfRange { pump: 0, value: 11.0, min: 0.0, max: 10.0 }));
        assert!(found.contains(&PlantError::VoltageOutOfRange { pump: 1, value: -1.0, min: 0.0, max: 10.0 }));
        assert!(found.contains(&PlantError::LevelOutOfRange { tank: 0, value: point.levels[0], max: 0.2 }));
        assert!(plant.violations(&plant.free_equilibrium([3.0, 3.0])).is_empty());
    }

    #[test]
    fn shut_pumps_empty_the_plant() {
        assert_eq!(johansson([0.7, 0.6]).free_equilibrium([0.0, 0.0]).levels, [0.0; 4]);
        assert_eq!(johansson([0.7, 0.6]).free_equilibrium([-1.0, -1.0]).levels, [0.0; 4]);
    }

    #[test]
    fn open_valves_dry_the_upper_tanks() {
        let levels = johansson([1.0, 1.0]).free_equilibrium([3.0, 3.0]).levels;
        assert!(levels[0] > 0.0 && levels[1] > 0.0);
        assert_eq!([levels[2], levels[3]], [0.0, 0.0]);
    }
}
