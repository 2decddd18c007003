//! Runs of the linear model with the same sampled controllers.

use nalgebra::Vector4;

use crate::control::DecentralisedPi;
use crate::linear::ZeroOrderHold;
use crate::plant::{Disturbance, Jacobian, OperatingPoint, QuadrupleTank};

use super::course::{self, Events, Process};
use super::experiment::Experiment;
use super::trajectory::Trajectory;

/// Durations that differ by less than this fraction are the same, up to the rounding of times.
const SAME_DURATION: f64 = 1e-9;

/// The linear model with its state, in deviations from the operating point.
struct LinearModel<'a> {
    plant: &'a QuadrupleTank,
    op: &'a OperatingPoint,
    jacobian: &'a Jacobian,
    deviation: Vector4<f64>,
    /// What a leak takes at the level of the operating point, for its area (1/(m s)): nothing from a dry tank.
    leak_rate: [f64; 4],
    /// `B u` plus the loads (m/s).
    forcing: Vector4<f64>,
    hold: ZeroOrderHold,
    hold_duration: f64,
    /// `Ψ forcing` (m).
    push: Vector4<f64>,
}

impl<'a> LinearModel<'a> {
    fn new(
        plant: &'a QuadrupleTank,
        op: &'a OperatingPoint,
        jacobian: &'a Jacobian,
        levels: &[f64; 4],
        duration: f64,
    ) -> Self {
        let leak_rate = std::array::from_fn(|tank| {
            let level = op.levels[tank];
            (2.0 * plant.gravity * level).sqrt() / plant.tanks[tank].section.area(level)
        });
        Self {
            plant,
            op,
            jacobian,
            deviation: Vector4::from_fn(|tank, _| levels[tank] - op.levels[tank]),
            leak_rate,
            forcing: Vector4::zeros(),
            hold: ZeroOrderHold::new(&jacobian.a, duration),
            hold_duration: duration,
            push: Vector4::zeros(),
        }
    }

    /// A load on the flow of a pump, as the voltage that makes the same flow (V).
    fn voltage_of(&self, pump: usize, flow: f64) -> f64 {
        if flow == 0.0 { 0.0 } else { flow / self.plant.pumps[pump].gain }
    }
}

impl Process for LinearModel<'_> {
    fn levels(&self) -> [f64; 4] {
        let ([h1, h2, h3, h4], x) = (self.op.levels, &self.deviation);
        [h1 + x.x, h2 + x.y, h3 + x.z, h4 + x.w]
    }

    fn set_inputs(&mut self, pump_voltage: &[f64; 2], disturbance: &Disturbance) {
        let u1 = pump_voltage[0] - self.op.pump_voltage[0] + self.voltage_of(0, disturbance.pump_flow[0]);
        let u2 = pump_voltage[1] - self.op.pump_voltage[1] + self.voltage_of(1, disturbance.pump_flow[1]);
        let load = |tank: usize| {
            let rise = disturbance.tank_flow[tank] / self.plant.tanks[tank].section.area(self.op.levels[tank]);
            rise - self.leak_rate[tank] * disturbance.leak_area[tank]
        };
        let b = &self.jacobian.b;
        self.forcing = Vector4::new(
            b.m11 * u1 + b.m12 * u2 + load(0),
            b.m21 * u1 + b.m22 * u2 + load(1),
            b.m31 * u1 + b.m32 * u2 + load(2),
            b.m41 * u1 + b.m42 * u2 + load(3),
        );
        self.push = self.hold.push(&self.forcing);
    }

    fn work(&self) -> u64 {
        0
    }

    fn advance(&mut self, _time: f64, duration: f64, _events: &mut Events) {
        if (duration - self.hold_duration).abs() <= SAME_DURATION * self.hold_duration {
            self.deviation = self.hold.pass(&self.deviation, &self.push);
        } else {
            let hold = ZeroOrderHold::new(&self.jacobian.a, duration);
            self.deviation = hold.pass(&self.deviation, &hold.push(&self.forcing));
        }
    }
}

/// Runs an experiment on the linear model around `op` with the same sampled controllers and limits as
/// [`simulate`](super::simulate), in absolute levels (m).
///
/// Loads are inputs of the model: the flow of a pump or into a tank exactly, a leak with the outflow that it has at the operating
/// point. The model knows no walls, so its levels may leave the tank; they stay finite because the plant itself is
/// stable and the limits of the pumps bound its inputs. A dry tank stays dry. There are no events.
pub fn simulate_linear(
    plant: &QuadrupleTank,
    op: &OperatingPoint,
    jacobian: &Jacobian,
    controller: &DecentralisedPi,
    experiment: &Experiment,
) -> Trajectory {
    let row_spacing = course::row_spacing(experiment, controller.sampling_time_s);
    let mut model = LinearModel::new(plant, op, jacobian, experiment.first_levels(op), row_spacing);
    let mut trajectory = course::run_pi(&mut model, plant, op, controller, experiment);
    trajectory.events.clear();
    trajectory
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::control::{AntiWindup, LoopMode, Pairing, PiSettings};
    use crate::literature::PresetId;
    use crate::sim::{Load, LoadStep, Measurement, simulate};

    /// Levels (m) that a load moves in the end, with both pumps by hand: nonlinear and linear.
    fn moved_by(load: Load) -> [[f64; 4]; 2] {
        let preset = PresetId::JohanssonMinimumPhase.preset();
        let op = preset.plant.free_equilibrium(preset.pump_voltage);
        let by_hand = |pump: usize| PiSettings {
            gain: 1.0,
            integral_time_s: 30.0,
            set_point_weight: 1.0,
            anti_windup: AntiWindup::Off,
            mode: LoopMode::Manual { output: op.pump_voltage[pump], until_s: f64::INFINITY },
        };
        let controller =
            DecentralisedPi { pairing: Pairing::Diagonal, loops: [by_hand(0), by_hand(1)], sampling_time_s: 1.0 };
        let experiment = Experiment {
            duration_s: 2000.0,
            set_point_steps: vec![],
            load_steps: vec![LoadStep { time_s: 10.0, load }],
            measurement: Measurement { noise_std: 0.0, seed: 1, quantised: false },
            initial_levels: None,
            pump_voltage_steps: Vec::new(),
        };
        let jacobian = preset.plant.linearise(&op);
        let runs = [
            simulate(&preset.plant, &op, &controller, &experiment),
            simulate_linear(&preset.plant, &op, &jacobian, &controller, &experiment),
        ];
        runs.map(|run| std::array::from_fn(|i| run.levels[i].last().copied().unwrap_or(f64::NAN) - op.levels[i]))
    }

    #[test]
    fn a_small_load_moves_the_linear_model_as_it_moves_the_plant() {
        let leaks = (0..4).map(|tank| Load::Leak { tank, area: 1e-9 });
        let flows = (0..2).map(|pump| Load::PumpFlow { pump, flow: 1e-9 });
        let from_outside = (0..4).map(|tank| Load::TankFlow { tank, flow: 1e-9 });
        for load in leaks.chain(flows).chain(from_outside) {
            let [nonlinear, linear] = moved_by(load);
            assert!(nonlinear.iter().any(|x| x.abs() > 1e-6), "{load:?} {nonlinear:?}");
            for i in 0..4 {
                // The load is small: what is left is the square of a share of 1e-4.
                assert_relative_eq!(nonlinear[i], linear[i], max_relative = 1e-3, epsilon = 1e-10);
            }
        }
    }
}
