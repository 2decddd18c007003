//! Runs of the linear model with the same sampled controllers.

use std::array::from_fn;
use std::collections::VecDeque;

use nalgebra::{Vector2, Vector4};

use crate::control::DecentralisedPi;
use crate::linear::ZeroOrderHold;
use crate::numeric::complements;
use crate::plant::{Disturbance, Jacobian, OperatingPoint, QuadrupleTank};

use super::course::{self, Events, Process};
use super::experiment::Experiment;
use super::trajectory::Trajectory;

/// Durations that differ by less than this fraction are the same, up to the rounding of times.
const SAME_DURATION: f64 = 1e-9;
/// Holds that are remembered: more than two delays cut a row into.
const PIECES: usize = 6;

fn is_same(duration: f64, known: f64) -> bool {
    (duration - known).abs() <= SAME_DURATION * known
}

/// The linear model with its state, in deviations from the operating point.
struct LinearModel<'a> {
    plant: &'a QuadrupleTank,
    op: &'a OperatingPoint,
    jacobian: &'a Jacobian,
    deviation: Vector4<f64>,
    /// The loads that act, which change a few times in a run, and the slopes (m/s) that they make on top of the drift.
    loads: Disturbance,
    loaded: Vector4<f64>,
    /// `d + B u` plus the loads (m/s).
    forcing: Vector4<f64>,
    hold: ZeroOrderHold,
    hold_duration: f64,
    /// Holds for pieces between rows, which come again where a hose delays by no whole number of rows; the oldest first.
    pieces: VecDeque<(f64, ZeroOrderHold)>,
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
        Self {
            plant,
            op,
            jacobian,
            deviation: Vector4::from_fn(|tank, _| levels[tank] - op.levels[tank]),
            loads: Disturbance::default(),
            loaded: jacobian.drift,
            forcing: Vector4::zeros(),
            hold: ZeroOrderHold::new(&jacobian.a, duration),
            hold_duration: duration,
            pieces: VecDeque::new(),
            push: Vector4::zeros(),
        }
    }

    fn hold_for(&mut self, duration: f64) -> ZeroOrderHold {
        if let Some((_, hold)) = self.pieces.iter().find(|(known, _)| is_same(duration, *known)) {
            return *hold;
        }
        if self.pieces.len() == PIECES {
            self.pieces.pop_front();
        }
        let hold = ZeroOrderHold::new(&self.jacobian.a, duration);
        self.pieces.push_back((duration, hold));
        hold
    }

    /// What the loads bring to each tank (m³/s), to first order around the operating point: a change of a flow that follows the
    /// state or the voltage counts as at the operating point.
    fn load_flows(&self, load: &Disturbance) -> [f64; 4] {
        let (plant, op) = (self.plant, self.op);
        let fractions = plant.incremental_fractions(op.pump_voltage);
        let ([gamma_1, gamma_2], [above_1, above_2]) = (fractions, complements(fractions));
        let pumped: [f64; 2] = from_fn(|i| plant.pumps[i].flow(op.pump_voltage[i]));
        let turned = plant.with_valves(load.valves(plant.valves)).fractions_at(op.pump_voltage);
        let before = plant.fractions_at(op.pump_voltage);
        let more: [f64; 2] = from_fn(|i| (load.pump_share()[i] - 1.0) * pumped[i] + load.pump_flow[i]);
        let turned: [f64; 2] = from_fn(|i| (turned[i] - before[i]) * pumped[i]);
        let through_valves = [
            gamma_1 * more[0] + turned[0],
            gamma_2 * more[1] + turned[1],
            above_2 * more[1] - turned[1],
            above_1 * more[0] - turned[0],
        ];
        let drained: [f64; 4] =
            from_fn(|j| (load.outlet_share()[j] - 1.0) * plant.tanks[j].outflow(op.levels[j], plant.gravity));
        let from_above = [drained[2], drained[3], 0.0, 0.0];
        let leaked: [f64; 4] = from_fn(|j| load.leak_area[j] * (2.0 * plant.gravity * op.levels[j]).sqrt());
        let outside = plant.flows_from_outside(load);
        from_fn(|j| through_valves[j] + from_above[j] - drained[j] - leaked[j] + outside[j] - plant.inflow[j])
    }
}

impl Process for LinearModel<'_> {
    fn levels(&self) -> [f64; 4] {
        let ([h1, h2, h3, h4], x) = (self.op.levels, &self.deviation);
        [h1 + x.x, h2 + x.y, h3 + x.z, h4 + x.w]
    }

    fn set_inputs(&mut self, pump_voltage: &[f64; 2], disturbance: &Disturbance) {
        let input = Vector2::new(pump_voltage[0] - self.op.pump_voltage[0], pump_voltage[1] - self.op.pump_voltage[1]);
        if *disturbance != self.loads {
            self.loads = *disturbance;
            let area = from_fn(|j| self.plant.tanks[j].section.area(self.op.levels[j]));
            let slopes = self.jacobian.slopes_by_flows(self.load_flows(disturbance), area);
            self.loaded = self.jacobian.drift + Vector4::from(slopes);
        }
        self.forcing = self.jacobian.b * input + self.loaded;
        self.push = self.hold.push(&self.forcing);
    }

    fn work(&self) -> u64 {
        0
    }

    fn advance(&mut self, _time: f64, duration: f64, _events: &mut Events) {
        if is_same(duration, self.hold_duration) {
            self.deviation = self.hold.pass(&self.deviation, &self.push);
        } else {
            let hold = self.hold_for(duration);
            self.deviation = hold.pass(&self.deviation, &hold.push(&self.forcing));
        }
    }
}

/// Runs an experiment on the linear model around `op` with the same sampled controllers and limits as
/// [`simulate`](super::simulate), in absolute levels (m).
///
/// Loads are inputs of the model. What flows into a tank from outside does so exactly, and never runs back. What is added to the flow
/// of a pump is added as it is, also where pump and load together would run backwards, which the plant does not let them. Leaks,
/// valves, outlets and pumps that change do so with the flows that they have at the operating point; a pump or an outlet that is lost
/// by several loads is lost once, as in the plant.
///
/// The model knows no walls, so its levels may leave the tank; they stay finite because the plant itself is stable and the limits of
/// the pumps bound its inputs. A dry tank stays dry. There are no events.
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
    use crate::sim::{Load, LoadStep, simulate};

    /// Levels (m) that a load moves in the end, with both pumps by hand and valves of these slopes: nonlinear and linear.
    fn moved_by(load: Load, valve_slopes: [f64; 2]) -> [[f64; 4]; 2] {
        let preset = PresetId::JohanssonMinimumPhase.preset();
        moved_on(&QuadrupleTank { valve_slopes, ..preset.plant }, &[load])
    }

    /// The same of several loads on a rig.
    fn moved_on(plant: &QuadrupleTank, loads: &[Load]) -> [[f64; 4]; 2] {
        let preset = PresetId::JohanssonMinimumPhase.preset();
        let op = plant.free_equilibrium(preset.pump_voltage);
        let by_hand = |pump: usize| PiSettings {
            gain: 1.0,
            integral_time_s: 30.0,
            set_point_weight: 1.0,
            anti_windup: AntiWindup::Off,
            mode: LoopMode::Manual { output: op.pump_voltage[pump], until_s: f64::INFINITY },
        };
        let controller =
            DecentralisedPi { pairing: Pairing::Diagonal, loops: [by_hand(0), by_hand(1)], sampling_time_s: 1.0 };
        let load_steps = loads.iter().map(|&load| LoadStep { time_s: 10.0, load }).collect();
        let experiment = Experiment { load_steps, ..Experiment::at_rest(2000.0) };
        let jacobian = plant.linearise(&op);
        let runs = [
            simulate(plant, &op, &controller, &experiment),
            simulate_linear(plant, &op, &jacobian, &controller, &experiment),
        ];
        runs.map(|run| std::array::from_fn(|i| run.levels[i].last().copied().unwrap_or(f64::NAN) - op.levels[i]))
    }

    #[test]
    fn away_from_rest_the_linear_model_drifts_as_the_plant_does() {
        let preset = PresetId::CocotaMinimumPhase.preset();
        let rest = preset.plant.free_equilibrium(preset.pump_voltage);
        // Levels that are off their rest by a tenth.
        let op = OperatingPoint { levels: rest.levels.map(|level| 1.1 * level), ..rest };
        let by_hand = |pump: usize| PiSettings {
            mode: LoopMode::Manual { output: op.pump_voltage[pump] / preset.plant.power_gain, until_s: f64::INFINITY },
            ..PiSettings {
                gain: 1.0,
                integral_time_s: 30.0,
                set_point_weight: 1.0,
                anti_windup: AntiWindup::Off,
                mode: LoopMode::Automatic,
            }
        };
        let controller =
            DecentralisedPi { pairing: Pairing::Diagonal, loops: [by_hand(0), by_hand(1)], sampling_time_s: 1.0 };
        let experiment = Experiment::at_rest(20.0);
        let jacobian = preset.plant.linearise(&op);
        let nonlinear = simulate(&preset.plant, &op, &controller, &experiment);
        let linear = simulate_linear(&preset.plant, &op, &jacobian, &controller, &experiment);
        for tank in 0..4 {
            let [moved, linear_moved] =
                [&nonlinear, &linear].map(|run| run.levels[tank].last().copied().unwrap_or(f64::NAN) - op.levels[tank]);
            assert!(moved < -1e-4, "{tank}: {moved}");
            // What is left is the square of the way, in 20 s a few hundredths of the level.
            assert_relative_eq!(moved, linear_moved, max_relative = 0.02);
        }
    }

    #[test]
    fn a_small_load_moves_the_linear_model_as_it_moves_the_plant() {
        let leaks = (0..4).map(|tank| Load::Leak { tank, area: 1e-9 });
        let flows = (0..2).map(|pump| Load::PumpFlow { pump, flow: 1e-9 });
        let from_outside = (0..4).map(|tank| Load::TankFlow { tank, flow: 1e-9 });
        let of_pumps = (0..2).map(|pump| Load::PumpGain { pump, change: -1e-4 });
        let of_valves = (0..2).map(|valve| Load::Valve { valve, change: 1e-4 });
        let of_outlets = (0..4).map(|tank| Load::Outlet { tank, change: -1e-4 });
        let loads = leaks.chain(flows).chain(from_outside).chain(of_pumps).chain(of_valves).chain(of_outlets);
        for (load, slopes) in loads.flat_map(|load| [(load, [0.0; 2]), (load, [8e3, -5e3])]) {
            let [nonlinear, linear] = moved_by(load, slopes);
            assert!(nonlinear.iter().any(|x| x.abs() > 1e-6), "{load:?} {nonlinear:?}");
            for i in 0..4 {
                // The load is small: what is left is the square of a share of 1e-4.
                assert_relative_eq!(nonlinear[i], linear[i], max_relative = 1e-3, epsilon = 1e-10);
            }
        }
    }

    #[test]
    fn loads_add_up_to_no_more_than_there_is() {
        let plant = PresetId::JohanssonMinimumPhase.preset().plant;
        let lost = |change: f64| Load::PumpGain { pump: 0, change };
        // Two losses that add up to more than all of the pump are the loss of the pump.
        let [_, twice] = moved_on(&plant, &[lost(-0.6), lost(-0.6)]);
        let [_, once] = moved_on(&plant, &[lost(-1.0)]);
        assert_eq!(twice, once);

        // A tank gives back no more than it receives from outside.
        let fed = QuadrupleTank { inflow: [0.0, 0.0, 1e-7, 0.0], ..plant };
        let taken = |flow: f64| moved_on(&fed, &[Load::TankFlow { tank: 2, flow }]);
        let [[[nonlinear, ..], more], [_, all]] = [taken(-1e-5), taken(-1e-7)];
        assert_eq!(more, all);
        assert_relative_eq!(more[0], nonlinear, max_relative = 0.1);
    }
}
