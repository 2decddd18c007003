use crate::linear::quadruple::{FiniteZeros, path, zeros_off_rest};
use crate::linear::{Complex, LinearError};
use crate::plant::{OperatingPoint, QuadrupleTank};

use super::{OperatingPointSpec, Setup};
use crate::study::StudyError;

/// Where a rig is while its valves move.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Standing {
    /// At rest at these pump voltages (V).
    Rest([f64; 2]),
    /// In a state of one's own, which stays.
    State(OperatingPoint),
}

/// The transmission zeros of a rig as its valves move and its pump voltages, or its state, stay: the map under the valve plane,
/// and the paths in the pole-zero chart. Each question takes well under a microsecond.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValveMap {
    plant: QuadrupleTank,
    standing: Standing,
}

impl ValveMap {
    /// The map at the pump voltages of a setup, or at its state.
    ///
    /// # Errors
    /// [`StudyError`] at `operating_point` when levels are given and no input holds them.
    pub fn of(setup: &Setup) -> Result<Self, StudyError> {
        let standing = match setup.operating_point {
            OperatingPointSpec::State(state) => Standing::State(state),
            _ => Standing::Rest(setup.operating_point()?.pump_voltage),
        };
        Ok(Self { plant: setup.plant(), standing })
    }

    /// The map of a rig at these pump voltages (V), or in the middle of what its pumps can do.
    pub fn at(plant: QuadrupleTank, pump_voltage: Option<[f64; 2]>) -> Self {
        let middle = plant.pumps.each_ref().map(|pump| f64::midpoint(pump.voltage_min, pump.voltage_max));
        Self { plant, standing: Standing::Rest(pump_voltage.unwrap_or(middle)) }
    }

    /// The same map without a present setting: equal for any two settings of one rig at the same voltages, so that what
    /// shows the whole plane is redone only when the plane changes.
    #[must_use]
    pub fn without_setting(self) -> Self {
        Self { plant: self.plant.with_valves([1.0, 1.0]), ..self }
    }

    /// Right-most finite zero (1/s) at valve fractions γ1, γ2; `None` where there is none.
    pub fn rightmost_zero(&self, valves: [f64; 2]) -> Option<f64> {
        self.zeros(valves).ok()?.rightmost()
    }

    /// The sum γ1 + γ2 at which the gain at steady state is singular and a zero is at the origin: 1, or where fractions depend on the
    /// flow, the sum at which γ̃1 + γ̃2 = 1 as long as neither γ(q) is at an end.
    pub fn singular_sum(&self) -> f64 {
        let pump_voltage = match self.standing {
            Standing::Rest(pump_voltage) => pump_voltage,
            Standing::State(state) => state.pump_voltage,
        };
        let growth = |pump: usize| self.plant.valve_slopes[pump] * self.plant.pumps[pump].flow(pump_voltage[pump]);
        1.0 - 2.0 * (growth(0) + growth(1))
    }

    fn zeros(&self, valves: [f64; 2]) -> Result<FiniteZeros, LinearError> {
        let plant = self.plant.with_valves(valves);
        // A tank that is dry follows its inflow at once.
        let upper_time_constants = |point: &OperatingPoint| {
            let [_, _, t3, t4] = plant.time_constants_s(point);
            [t3, t4].map(|time_constant| time_constant.unwrap_or(0.0))
        };
        match self.standing {
            Standing::Rest(pump_voltage) => {
                let [t3, t4] = upper_time_constants(&plant.free_equilibrium(pump_voltage));
                zeros_off_rest(t3, t4, plant.incremental_fractions(pump_voltage), 1.0)
            }
            Standing::State(state) => {
                let [t3, t4] = upper_time_constants(&state);
                // What an upper tank passes on of a change of its inflow in the long run.
                let passed = |upper: usize, time_constant: f64| {
                    let (tank, level) = (plant.tanks[upper], state.levels[upper]);
                    let rate = tank.outflow_slope(level, plant.gravity) / tank.section.area(level);
                    if time_constant > 0.0 { time_constant * rate } else { 1.0 }
                };
                let fractions = plant.incremental_fractions(state.pump_voltage);
                zeros_off_rest(t3, t4, fractions, passed(2, t3) * passed(3, t4))
            }
        }
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
        for point in path(from, to, points, |valves| self.zeros(valves)) {
            let zeros = point.zeros.ok().and_then(|zeros| zeros.pair());
            for (path, zero) in paths.iter_mut().zip(zeros.into_iter().flatten()) {
                path.push(zero);
            }
        }
        paths
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::literature::PresetId;
    use crate::study::quadruple_tank::{PlantSpec, ZeroSituation, analyse, setup_of};

    #[test]
    fn where_fractions_depend_on_the_flow_the_line_is_where_theory_has_it() {
        let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
        let mut rig = setup.plant.rig();
        rig.valve_slopes = [1e4, -2e3];
        setup.plant = PlantSpec::Parameters { rig, display_unit: setup.plant.display_unit() };
        let sum = ValveMap::of(&setup).unwrap().singular_sum();
        // 1 − 2 (s1 k1 v1 + s2 k2 v2), with about 10 cm³/s from each pump.
        assert!((sum - (1.0 - 2.0 * (1e4 * 9.99e-6 - 2e3 * 10.05e-6))).abs() < 1e-12, "{sum}");
        for gamma_1 in [0.3, 0.5, 0.7] {
            let mut found_at = |off: f64| {
                setup.valves = [gamma_1, sum - gamma_1 + off];
                let analysis = analyse(&setup).unwrap();
                let by_map = ValveMap::of(&setup).unwrap().rightmost_zero(setup.valves).unwrap();
                (analysis.zero_situation(&setup), by_map)
            };
            for off in [-0.05, 0.05] {
                match found_at(off) {
                    (ZeroSituation::Left(zero), by_map) if off > 0.0 => {
                        assert!((zero - by_map).abs() < 1e-9 * zero.abs());
                    }
                    (ZeroSituation::Right(zero), by_map) if off < 0.0 => assert!((zero - by_map).abs() < 1e-9 * zero),
                    other => panic!("{gamma_1} {off}: {other:?}"),
                }
            }
            assert!(found_at(0.0).1.abs() < 1e-12);
        }
    }

    #[test]
    fn at_a_state_of_ones_own_the_map_has_the_zeros_of_theory() {
        let mut setup = setup_of(PresetId::CocotaNonMinimumPhase);
        let mut rig = setup.plant.rig();
        // With an upper tank that tapers, as the lower one does, zeros and gains depend on the drift.
        rig.tanks[3].section = rig.tanks[1].section;
        assert!(rig.tanks[3].section.area_slope != 0.0);
        setup.plant = PlantSpec::Parameters { rig, display_unit: setup.plant.display_unit() };
        let rest = setup.operating_point().unwrap();
        assert!(setup.has_relative_gain_of_valves());
        for share in [1.0, 0.5, 1.5] {
            let levels = rest.levels.map(|level| share * level);
            setup.operating_point = OperatingPointSpec::State(OperatingPoint { levels, ..rest });
            assert!(!setup.has_relative_gain_of_valves());
            for valves in [[0.43, 0.43], [0.7, 0.6], [0.3, 0.2]] {
                setup.valves = valves;
                let linear = analyse(&setup).unwrap().linear;
                let expected = linear.rightmost_zero().unwrap().value.re;
                let found = ValveMap::of(&setup).unwrap().rightmost_zero(valves).unwrap();
                assert!((found - expected).abs() <= 1e-9 * expected.abs(), "{share} {valves:?}: {found} {expected}");
                let by_valves = valves[0] * valves[1] / (valves[0] + valves[1] - 1.0);
                let error = (linear.rga_11.unwrap() / by_valves - 1.0).abs();
                // Other valves than those of the rest make a drift too.
                let is_at_rest = share == 1.0 && valves == [0.43, 0.43];
                assert_eq!(error < 1e-9, is_at_rest, "{share} {valves:?}: {error}");
            }
        }
    }
}
