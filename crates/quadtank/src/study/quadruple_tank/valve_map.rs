use crate::linear::Complex;
use crate::linear::quadruple::{path, rightmost_zero};
use crate::plant::QuadrupleTank;

use super::Setup;
use crate::study::StudyError;

/// The transmission zeros of a rig as its valves move and its pump voltages stay: the map under the valve plane, and the
/// paths in the pole-zero chart. Each question takes well under a microsecond.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValveMap {
    plant: QuadrupleTank,
    pump_voltage: [f64; 2],
}

impl ValveMap {
    /// The map at the pump voltages of a setup.
    ///
    /// # Errors
    /// [`StudyError`] at `operating_point` when levels are given and no input holds them.
    pub fn of(setup: &Setup) -> Result<Self, StudyError> {
        Ok(Self { plant: setup.plant(), pump_voltage: setup.operating_point()?.pump_voltage })
    }

    /// The map of a rig at these pump voltages (V), or in the middle of what its pumps can do.
    pub fn at(plant: QuadrupleTank, pump_voltage: Option<[f64; 2]>) -> Self {
        let middle = plant.pumps.each_ref().map(|pump| f64::midpoint(pump.voltage_min, pump.voltage_max));
        Self { plant, pump_voltage: pump_voltage.unwrap_or(middle) }
    }

    /// The same map without a present setting: equal for any two settings of one rig at the same voltages, so that what
    /// shows the whole plane is redone only when the plane changes.
    #[must_use]
    pub fn without_setting(self) -> Self {
        Self { plant: self.plant.with_valves([1.0, 1.0]), ..self }
    }

    /// Right-most finite zero (1/s) at valve fractions γ1, γ2; `None` where there is none.
    pub fn rightmost_zero(&self, valves: [f64; 2]) -> Option<f64> {
        let [t3, t4] = self.upper_time_constants_s(valves);
        rightmost_zero(t3, t4, valves)
    }

    /// T3 and T4 (s) at valve fractions γ1, γ2; 0 for a tank that is dry, which follows its inflow at once.
    pub fn upper_time_constants_s(&self, valves: [f64; 2]) -> [f64; 2] {
        let plant = self.plant.with_valves(valves);
        let [_, _, t3, t4] = plant.time_constants_s(&plant.free_equilibrium(self.pump_voltage));
        [t3, t4].map(|time_constant| time_constant.unwrap_or(0.0))
    }

    /// The paths of both zeros (1/s) while both valves open by the same amount, along the line through the present
    /// setting from edge to edge of the valve plane, in `points` steps. What has gone to infinity is left out.
    pub fn zero_paths(&self, points: usize) -> [Vec<Complex>; 2] {
        let [gamma_1, gamma_2] = self.plant.valves;
        let back = gamma_1.min(gamma_2);
        let ahead = 1.0 - gamma_1.max(gamma_2);
        let from = [gamma_1 - back, gamma_2 - back];
        let to = [gamma_1 + ahead, gamma_2 + ahead];
        let mut paths = [Vec::new(), Vec::new()];
        for point in path(from, to, points, |valves| self.upper_time_constants_s(valves)) {
            let zeros = point.zeros.as_ref().map_or(&[][..], |zeros| zeros.as_slice());
            if let [left, right] = *zeros {
                for (path, zero) in paths.iter_mut().zip([left, right]) {
                    path.push(Complex::new(zero, 0.0));
                }
            }
        }
        paths
    }
}
