use serde::Serialize;

use super::{Disturbance, PlantError, QuadrupleTank};

/// Distance of γ1 + γ2 from 1 below which the plant counts as singular at steady state.
///
/// The flow balance has the condition number `≈ 1/|γ1 + γ2 − 1|`: closer than this, rounding alone leaves fewer than
/// seven digits in the voltages that [`QuadrupleTank::inputs_for_levels`] finds.
pub const SINGULAR_MARGIN: f64 = 1e-9;

/// Where the plant rests: the levels that given pump voltages hold, or the voltages that hold given lower levels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
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
        let [q1, q2, q3, q4] = self.valve_flows(&pump_voltage, &Disturbance::default());
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
    /// `[q1; q2] = [γ1 k1, (1 − γ2) k2; (1 − γ1) k1, γ2 k2] [ϑ1; ϑ2]` with `q = k_l a √(2 g h)` (Cocota 2009, §3.2.1).
    ///
    /// # Errors
    /// - [`PlantError::LevelOutOfRange`]: a given level is negative or above the walls, or an upper tank would overflow.
    /// - [`PlantError::SingularPlant`]: γ1 + γ2 is within [`SINGULAR_MARGIN`] of 1.
    /// - [`PlantError::VoltageOutOfRange`]: a pump would leave its limits, or have to take water out of the plant.
    pub fn inputs_for_levels(&self, levels: [f64; 2]) -> Result<OperatingPoint, PlantError> {
        if let Some(error) = levels.into_iter().enumerate().find_map(|(tank, level)| self.level_violation(tank, level))
        {
            return Err(error);
        }
        let gamma_sum = self.valves[0] + self.valves[1];
        if (gamma_sum - 1.0).abs() < SINGULAR_MARGIN {
            return Err(PlantError::SingularPlant { gamma_sum });
        }
        let needed = self.checked(self.free_equilibrium(self.balancing_voltages(levels)))?;
        Ok(OperatingPoint { levels: [levels[0], levels[1], needed.levels[2], needed.levels[3]], ..needed })
    }

    /// What keeps an operating point from existing on the rig: first the voltages outside their limits, then the levels
    /// outside the walls. Empty for a feasible point.
    pub fn violations(&self, operating_point: &OperatingPoint) -> Vec<PlantError> {
        self.violations_of(operating_point).collect()
    }

    /// Solves the flow balance of the lower tanks for the pump voltages (V), without any check.
    pub(super) fn balancing_voltages(&self, levels: [f64; 2]) -> [f64; 2] {
        let [gamma_1, gamma_2] = self.valves;
        let q1 = self.tanks[0].outflow(levels[0], self.gravity);
        let q2 = self.tanks[1].outflow(levels[1], self.gravity);
        let determinant = gamma_1 + gamma_2 - 1.0;
        [
            (gamma_2 * q1 - (1.0 - gamma_2) * q2) / (determinant * self.pumps[0].gain),
            (gamma_1 * q2 - (1.0 - gamma_1) * q1) / (determinant * self.pumps[1].gain),
        ]
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
        let limits = self.pumps.get(pump)?;
        let (min, max) = (limits.voltage_min.max(0.0), limits.voltage_max);
        (!(min..=max).contains(&value)).then_some(PlantError::VoltageOutOfRange { pump, value, min, max })
    }

    fn level_violation(&self, tank: usize, value: f64) -> Option<PlantError> {
        let max = self.tanks.get(tank)?.height;
        (!(0.0..=max).contains(&value)).then_some(PlantError::LevelOutOfRange { tank, value, max })
    }
}
