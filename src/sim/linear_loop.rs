//! The linear model in the same closed loop.

use nalgebra::Vector4;

use crate::control::DecentralisedPi;
use crate::plant::{Disturbance, Jacobian, OperatingPoint, QuadrupleTank};

use super::course::{self, Events, Process};
use super::experiment::Experiment;
use super::hold::Hold;
use super::trajectory::Trajectory;

/// Durations that differ by less than this fraction are the same, up to the rounding of times.
const SAME_DURATION: f64 = 1e-9;

/// The linear model with its state, in deviations from the operating point.
struct LinearModel<'a> {
    plant: &'a QuadrupleTank,
    op: &'a OperatingPoint,
    jacobian: &'a Jacobian,
    deviation: Vector4<f64>,
    /// `B u` plus the loads (m/s).
    forcing: Vector4<f64>,
    hold: Hold,
    hold_duration: f64,
    /// `Ψ forcing` (m).
    push: Vector4<f64>,
}

impl<'a> LinearModel<'a> {
    fn new(plant: &'a QuadrupleTank, op: &'a OperatingPoint, jacobian: &'a Jacobian, duration: f64) -> Self {
        Self {
            plant,
            op,
            jacobian,
            deviation: Vector4::zeros(),
            forcing: Vector4::zeros(),
            hold: Hold::new(&jacobian.a, duration),
            hold_duration: duration,
            push: Vector4::zeros(),
        }
    }

    /// A load on the flow of a pump, as the voltage that makes the same flow (V).
    fn voltage_of(&self, pump: usize, flow: f64) -> f64 {
        if flow == 0.0 { 0.0 } else { flow / self.plant.pumps[pump].gain }
    }

    /// What a leak takes at the level of the operating point (m/s); a dry tank has nothing to lose.
    fn leak_rate(&self, tank: usize, area: f64) -> f64 {
        let level = self.op.levels[tank];
        if area == 0.0 || self.jacobian.dry[tank] {
            return 0.0;
        }
        -area * (2.0 * self.plant.gravity * level).sqrt() / self.plant.tanks[tank].section.area(level)
    }
}

impl Process for LinearModel<'_> {
    fn levels(&self) -> [f64; 4] {
        std::array::from_fn(|i| self.op.levels[i] + self.deviation[i])
    }

    fn set_inputs(&mut self, pump_voltage: &[f64; 2], disturbance: &Disturbance) {
        let [u1, u2] =
            [0, 1].map(|j| pump_voltage[j] - self.op.pump_voltage[j] + self.voltage_of(j, disturbance.pump_flow[j]));
        let leaks = Vector4::from_fn(|i, _| self.leak_rate(i, disturbance.leak_area[i]));
        self.forcing = self.jacobian.b.column(0) * u1 + self.jacobian.b.column(1) * u2 + leaks;
        self.push = self.hold.response * self.forcing;
    }

    fn advance(&mut self, _time: f64, duration: f64, _events: &mut Events) {
        if (duration - self.hold_duration).abs() <= SAME_DURATION * self.hold_duration {
            self.deviation = self.hold.transition * self.deviation + self.push;
        } else {
            let hold = Hold::new(&self.jacobian.a, duration);
            self.deviation = hold.transition * self.deviation + hold.response * self.forcing;
        }
    }
}

/// Runs an experiment on the linear model around `op` with the same sampled controllers and limits as
/// [`simulate`](super::simulate), in absolute levels (m).
///
/// Loads are inputs of the model: the flow of a pump exactly, a leak with the outflow that it has at the operating
/// point. The model knows no walls, so its levels may leave the tank; they stay finite because the plant itself is
/// stable and the limits of the pumps bound its inputs. A dry tank stays dry. There are no events.
pub fn simulate_linear(
    plant: &QuadrupleTank,
    op: &OperatingPoint,
    jacobian: &Jacobian,
    controller: &DecentralisedPi,
    experiment: &Experiment,
) -> Trajectory {
    let row_spacing = course::row_spacing(experiment, controller);
    let model = LinearModel::new(plant, op, jacobian, row_spacing);
    let mut trajectory = course::run(model, plant, op, controller, experiment);
    trajectory.events.clear();
    trajectory
}
