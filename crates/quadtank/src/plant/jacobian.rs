use nalgebra::{DMatrix, Matrix2x4, Matrix4, Matrix4x2, Vector4};

use super::{Disturbance, OperatingPoint, QuadrupleTank};
use crate::numeric::complements;

/// An upper tank whose time constant is at most this share of the longest is quasi-steady: slow poles and zeros move by no
/// larger share when its state is left out. With it, from 4e-9 on zeros get lost in the rounding of the fast entries of A.
const QUASI_STEADY: f64 = 1e-8;

/// A tank with less water than this (m) counts as dry. It is far below the size of an atom, and far above the levels at which
/// the slope of the outflow, `∝ 1/√h`, would leave the range of numbers.
const DRY_LEVEL_M: f64 = 1e-60;

/// A tank whose inflow and outflow differ by at most this share of the largest flow in the plant is at rest: it is far above
/// the rounding of an equilibrium, and far below what any printed level leaves.
const BALANCED: f64 = 1e-9;

/// The linear model `dx/dt = d + A x + B u(t − θ)`, `y = C x` of the plant around an operating point, in deviations: `x` levels
/// (m), `u` pump voltages (V), each delayed by its own hose, `y` measured signals (V). At rest the drift d is 0.
///
/// A tank without water at the operating point is dry: its √-slope is infinite, so it follows its inflow at once. An upper
/// tank with so little water that its time constant is below 1e-8 of the longest is taken to do so too. Such tanks are
/// listed in `quasi_steady`, their row and column in A, their row in B and their column in C are zero, and
/// [`Jacobian::reduced`] leaves them out. What a pump sends into such an upper tank stands in the row of B of the lower one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jacobian {
    /// System matrix (1/s), 4 × 4.
    pub a: Matrix4<f64>,
    /// Input matrix (m/(s V)), 4 × 2.
    pub b: Matrix4x2<f64>,
    /// Output matrix (V/m), 2 × 4.
    pub c: Matrix2x4<f64>,
    /// Which tanks follow their inflow at once and have no state.
    pub quasi_steady: [bool; 4],
    /// Transport delay θ of each input (s).
    pub input_delay_s: [f64; 2],
    /// Drift d: how fast the levels leave the operating point by themselves (m/s).
    pub drift: Vector4<f64>,
}

impl Jacobian {
    /// The model without the quasi-steady tanks: `(A, B, C)` with n × n, n × 2 and 2 × n entries, the n tanks that have a
    /// state in their order. n is 0 when every tank is dry.
    pub fn reduced(&self) -> (DMatrix<f64>, DMatrix<f64>, DMatrix<f64>) {
        let states: Vec<usize> = (0..4).filter(|&j| !self.quasi_steady[j]).collect();
        let n = states.len();
        (
            DMatrix::from_fn(n, n, |i, j| self.a[(states[i], states[j])]),
            DMatrix::from_fn(n, 2, |i, j| self.b[(states[i], j)]),
            DMatrix::from_fn(2, n, |i, j| self.c[(i, states[j])]),
        )
    }

    /// Slopes of the levels (m/s) that flows into the tanks (m³/s) make, where the tanks have these cross-sections (m²). Water
    /// passes a quasi-steady upper tank at once; a dry lower tank stays dry.
    pub fn slopes_by_flows(&self, flow: [f64; 4], area: [f64; 4]) -> [f64; 4] {
        let passed = |lower: usize| if self.quasi_steady[lower + 2] { flow[lower + 2] } else { 0.0 };
        let flow = [flow[0] + passed(0), flow[1] + passed(1), flow[2], flow[3]];
        std::array::from_fn(|j| if self.quasi_steady[j] { 0.0 } else { flow[j] / area[j] })
    }

    /// Whether the plant rests at the operating point.
    pub fn is_at_rest(&self) -> bool {
        self.drift == Vector4::zeros()
    }
}

impl QuadrupleTank {
    /// Time constants T1…T4 (s) at any point, at rest or not; `None` for a dry tank, one without water:
    /// `1/T_j = (k_l a/A) √(g/(2h)) + δ_j` with `δ_j = (A′/A²) (inflow − outflow)`, which is 0 at an exact equilibrium
    /// and for a prismatic tank (Cocota 2009, eqs. 3.14–3.17).
    pub fn time_constants_s(&self, operating_point: &OperatingPoint) -> [Option<f64>; 4] {
        let OperatingPoint { levels, pump_voltage } = operating_point;
        let net_inflow = self.net_inflows(levels, pump_voltage, &Disturbance::default());
        self.decay_rates(levels, &net_inflow).map(|rate| rate.map(f64::recip))
    }

    /// The exact linear model at any point, at rest or not (Cocota 2009, eqs. 3.14–3.17), with γ̃ for γ where that depends on the
    /// flow.
    pub fn linearise(&self, operating_point: &OperatingPoint) -> Jacobian {
        let levels = operating_point.levels;
        let area: [f64; 4] = std::array::from_fn(|j| self.tanks[j].section.area(levels[j]));
        let net_inflow = self.net_inflows(&levels, &operating_point.pump_voltage, &Disturbance::default());
        let rates = self.decay_rates(&levels, &net_inflow);
        let quasi_steady = self.quasi_steady(&levels);
        let fractions = self.incremental_fractions(operating_point.pump_voltage);
        let above = complements(fractions);

        let mut jacobian = Jacobian {
            a: Matrix4::zeros(),
            b: Matrix4x2::zeros(),
            c: Matrix2x4::zeros(),
            quasi_steady,
            input_delay_s: self.pumps.map(|pump| pump.delay_s),
            drift: Vector4::zeros(),
        };
        let largest = self.largest_flow(operating_point);
        if net_inflow.iter().any(|net| net.abs() > BALANCED * largest) {
            jacobian.drift = jacobian.slopes_by_flows(net_inflow, area).into();
        }
        for (j, rate) in rates.into_iter().enumerate() {
            jacobian.a[(j, j)] = if quasi_steady[j] { 0.0 } else { -rate.unwrap_or(0.0) };
        }
        for lower in 0..2 {
            let (upper, other) = (lower + 2, 1 - lower);
            // Flow per volt of the pump that feeds the lower tank, and of the other one that feeds the upper tank.
            let direct = fractions[lower] * self.pumps[lower].gain;
            let from_above = above[other] * self.pumps[other].gain;
            if !quasi_steady[upper] {
                jacobian.b[(upper, other)] = from_above / area[upper];
            }
            if quasi_steady[lower] {
                continue;
            }
            jacobian.b[(lower, lower)] = direct / area[lower];
            jacobian.c[(lower, lower)] = self.sensor.gain;
            if quasi_steady[upper] {
                jacobian.b[(lower, other)] = from_above / area[lower];
            } else {
                let slope = self.tanks[upper].outflow_slope(levels[upper], self.gravity);
                jacobian.a[(lower, upper)] = slope / area[lower];
            }
        }
        jacobian
    }

    /// The largest flow into or out of a tank (m³/s).
    fn largest_flow(&self, operating_point: &OperatingPoint) -> f64 {
        let fed = self.feed_flows(&operating_point.pump_voltage, &Disturbance::default());
        fed.into_iter().chain(self.outflows(&operating_point.levels)).fold(0.0, f64::max)
    }

    /// `1/T_j` (1/s) at given levels (m) and inflows less outflows (m³/s), `None` for a dry tank.
    fn decay_rates(&self, levels: &[f64; 4], net_inflow: &[f64; 4]) -> [Option<f64>; 4] {
        std::array::from_fn(|j| {
            let (tank, level) = (&self.tanks[j], levels[j]);
            let area = tank.section.area(level);
            let delta = tank.section.area_slope / (area * area) * net_inflow[j];
            (level > DRY_LEVEL_M).then(|| tank.outflow_slope(level, self.gravity) / area + delta)
        })
    }

    /// Which tanks follow their inflow at once, at given levels (m).
    fn quasi_steady(&self, levels: &[f64; 4]) -> [bool; 4] {
        let time: [f64; 4] = std::array::from_fn(|j| {
            let (tank, level) = (&self.tanks[j], levels[j]);
            if level > DRY_LEVEL_M { tank.section.area(level) / tank.outflow_slope(level, self.gravity) } else { 0.0 }
        });
        let longest = time.into_iter().fold(0.0, f64::max);
        std::array::from_fn(|j| time[j] == 0.0 || (j >= 2 && time[j] <= QUASI_STEADY * longest))
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::literature::PresetId;

    fn johansson(valves: [f64; 2], pump_voltage: [f64; 2]) -> (QuadrupleTank, OperatingPoint) {
        let plant = PresetId::JohanssonMinimumPhase.preset().plant.with_valves(valves);
        (plant, plant.free_equilibrium(pump_voltage))
    }

    #[test]
    fn delta_2_is_that_of_cocota_and_zero_at_rest() {
        let preset = PresetId::CocotaMinimumPhase.preset();
        let levels = preset.printed.map(|printed| printed.levels).unwrap_or_default();
        let point = OperatingPoint { levels, pump_voltage: preset.pump_voltage };
        let plant = preset.plant;
        let [_, tank_2, _, tank_4] = &plant.tanks;
        let area = tank_2.section.area(levels[1]);
        let imbalance = tank_2.outflow(levels[1], plant.gravity)
            - tank_4.outflow(levels[3], plant.gravity)
            - plant.valves[1] * plant.pumps[1].gain * preset.pump_voltage[1];
        let delta_2 = -tank_2.section.area_slope / (area * area) * imbalance;
        let expected = tank_2.outflow_slope(levels[1], plant.gravity) / area + delta_2;
        assert!(delta_2.abs() > 1e-7);
        assert_relative_eq!(plant.linearise(&point).a[(1, 1)], -expected, max_relative = 1e-12);

        let rest = plant.free_equilibrium(preset.pump_voltage);
        let without_delta = tank_2.outflow_slope(rest.levels[1], plant.gravity) / tank_2.section.area(rest.levels[1]);
        assert_relative_eq!(plant.linearise(&rest).a[(1, 1)], -without_delta, max_relative = 1e-12);
    }

    #[test]
    fn the_drift_is_how_fast_the_levels_leave_a_point_that_is_not_at_rest() {
        for id in PresetId::ALL {
            let preset = id.preset();
            assert!(preset.plant.linearise(&preset.plant.free_equilibrium(preset.pump_voltage)).is_at_rest(), "{id:?}");
            let Some(printed) = preset.printed else { continue };
            let point = OperatingPoint { levels: printed.levels, pump_voltage: preset.pump_voltage };
            let jacobian = preset.plant.linearise(&point);
            let expected = preset.plant.derivative(&point.levels, &point.pump_voltage, &Disturbance::default());
            for (tank, slope) in expected.into_iter().enumerate() {
                // Some print all digits of levels at rest, which the share of the flows says that counts as rest.
                let rest = BALANCED * preset.plant.largest_flow(&point)
                    / preset.plant.tanks[tank].section.area(point.levels[tank]);
                assert_relative_eq!(jacobian.drift[tank], slope, max_relative = 1e-12, epsilon = rest);
            }
            if id == PresetId::JohanssonMinimumPhase {
                assert!(!jacobian.is_at_rest());
            }
        }
    }

    #[test]
    fn what_drips_into_a_dry_upper_tank_drives_the_lower_one() {
        let (plant, _) = johansson([0.7, 0.6], [3.0, 3.0]);
        let point = OperatingPoint { levels: [0.12, 0.13, 0.0, 0.01], pump_voltage: [3.0, 3.0] };
        let drift = plant.linearise(&point).drift;
        let net = 0.7 * 3.33e-6 * 3.0 + 0.4 * 3.35e-6 * 3.0 - plant.tanks[0].outflow(0.12, plant.gravity);
        assert_relative_eq!(drift[0], net / 28e-4, max_relative = 1e-12);
        assert_eq!(drift[2], 0.0);
    }

    #[test]
    fn an_open_valve_leaves_its_upper_tank_out() {
        let (plant, point) = johansson([0.7, 1.0], [3.0, 3.0]);
        let jacobian = plant.linearise(&point);
        assert_eq!(jacobian.quasi_steady, [false, false, true, false]);
        assert_eq!(plant.time_constants_s(&point)[2], None);
        assert_eq!(jacobian.b[(0, 1)], 0.0);
        let (a, b, c) = jacobian.reduced();
        assert_eq!((a.shape(), b.shape(), c.shape()), ((3, 3), (3, 2), (2, 3)));
        // Tank 4 is now the third state.
        assert_eq!(a[(1, 2)], jacobian.a[(1, 3)]);
        assert_eq!(b[(2, 0)], jacobian.b[(3, 0)]);
        assert!(a.iter().chain(&b).chain(&c).all(|entry| entry.is_finite()));
    }

    #[test]
    fn water_passes_a_dry_tank_at_once() {
        // Pump 2 is off, so tank 3 is dry although its valve would feed it.
        let (plant, point) = johansson([0.7, 0.6], [3.0, 0.0]);
        let jacobian = plant.linearise(&point);
        assert_eq!(jacobian.quasi_steady, [false, false, true, false]);
        assert_relative_eq!(jacobian.b[(0, 1)], 0.4 * 3.35e-6 / 28e-4, max_relative = 1e-12);

        // The limit of a nearly dry one: the same gain from pump 2 to level 1 at rest.
        let gain = |voltage| {
            let (plant, point) = johansson([0.7, 0.6], [3.0, voltage]);
            let (a, b, c) = plant.linearise(&point).reduced();
            a.lu().solve(&b).map(|x| (c * x)[(0, 1)])
        };
        let (dry, wet) = (gain(0.0).unwrap_or(f64::NAN), gain(1e-3).unwrap_or(f64::NAN));
        assert_relative_eq!(dry, wet, max_relative = 1e-3);
    }

    #[test]
    fn an_empty_plant_has_no_states() {
        let (plant, point) = johansson([0.7, 0.6], [0.0, 0.0]);
        let (a, b, c) = plant.linearise(&point).reduced();
        assert_eq!((a.shape(), b.shape(), c.shape()), ((0, 0), (0, 2), (2, 0)));
    }

    #[test]
    fn a_tank_with_less_water_than_an_atom_is_dry() {
        let (plant, _) = johansson([0.7, 0.6], [0.0, 0.0]);
        for level in [5e-324, 1e-300, 1e-61] {
            let point = OperatingPoint { levels: [0.1, level, level, 0.1], pump_voltage: [3.0, 3.0] };
            assert_eq!(plant.time_constants_s(&point)[1..3], [None, None]);
            let jacobian = plant.linearise(&point);
            assert_eq!(jacobian.quasi_steady, [false, true, true, false]);
            assert!(jacobian.a.iter().chain(&jacobian.b).all(|entry| entry.is_finite()));
        }
    }

    #[test]
    fn a_tank_with_a_small_flow_is_not_dry() {
        let (plant, point) = johansson([0.999_999, 0.6], [3.0, 3.0]);
        // T = A q/(a² g) of a tank at rest.
        let expected = 32e-4 * 1e-6 * 3.33e-6 * 3.0 / (5.7e-6_f64.powi(2) * plant.gravity);
        assert_relative_eq!(plant.time_constants_s(&point)[3].unwrap(), expected, max_relative = 1e-9);
        assert_eq!(plant.linearise(&point).quasi_steady, [false; 4]);
        // With less its state goes, its time constant stays.
        let (plant, point) = johansson([1.0 - 1e-12, 0.6], [3.0, 3.0]);
        assert_relative_eq!(plant.time_constants_s(&point)[3].unwrap(), 1e-6 * expected, max_relative = 1e-3);
        assert_eq!(plant.linearise(&point).quasi_steady, [false, false, false, true]);
        let (plant, point) = johansson([1.0, 0.6], [3.0, 3.0]);
        assert_eq!(plant.time_constants_s(&point)[3], None);
    }

    #[test]
    fn a_lower_tank_with_a_small_flow_keeps_its_output() {
        let (plant, point) = johansson([1e-6, 1.0], [3.0, 3.0]);
        let jacobian = plant.linearise(&point);
        assert_eq!(jacobian.quasi_steady, [false, false, true, false]);
        assert_eq!(jacobian.c[(0, 0)], plant.sensor.gain);
    }
}
