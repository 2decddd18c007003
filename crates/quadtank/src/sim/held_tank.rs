//! The nonlinear plant under inputs that are held, in deviations from an operating point.

use crate::control::Pairing;
use crate::plant::{Disturbance, OperatingPoint, QuadrupleTank};

use super::hydraulics::Hydraulics;
use super::two_loops::HeldPlant;
use super::walls::Watch;

/// The quadruple tank as a [`HeldPlant`]: inputs are deviations of the voltages (V) of the pumps that loops 1 and 2 drive,
/// outputs deviations of the measured levels 1 and 2 (V). Voltages beyond the limits of a pump are cut there; levels stay within the walls.
#[derive(Clone, Debug)]
pub struct HeldTank<'a> {
    plant: &'a QuadrupleTank,
    op: OperatingPoint,
    pairing: Pairing,
    water: Hydraulics,
}

/// Tanks of a laboratory take longer than this to turn there and back (s).
const PACE_S: f64 = 1.0;
/// Longest piece of a motion (s), each of which is up to eight steps of the integration, and most pieces.
const PIECE_S: f64 = 5.0;
const MAX_PIECES: f64 = 32.0;
/// Work of one piece, in multiplications; measured.
const MULTIPLICATIONS: f64 = 300.0;

fn pieces(duration: f64) -> f64 {
    (duration / PIECE_S).ceil().clamp(1.0, MAX_PIECES)
}

/// Lets `duration` seconds pass.
fn pass(water: &mut Hydraulics, duration: f64) {
    let pieces = pieces(duration);
    let mut done = 0.0;
    while done < pieces {
        water.advance(0.0, duration / pieces, &mut Unwatched);
        done += 1.0;
    }
}

/// Ignores overflows and empty tanks: this plant reports no events.
struct Unwatched;

impl Watch for Unwatched {
    fn overflow(&mut self, _: usize, _: f64) {}
    fn empty(&mut self, _: usize, _: f64) {}
}

impl<'a> HeldTank<'a> {
    /// The plant at rest at an operating point.
    pub fn new(plant: &'a QuadrupleTank, op: &OperatingPoint, pairing: Pairing) -> Self {
        let mut tank = Self { plant, op: *op, pairing, water: Hydraulics::new(plant, &op.levels) };
        tank.set_inputs([0.0; 2]);
        tank
    }

    /// Levels (m).
    pub fn levels(&self) -> [f64; 4] {
        self.water.levels()
    }

    fn signals(&self, water: &Hydraulics) -> [f64; 2] {
        let [h1, h2, ..] = water.levels();
        [(h1 - self.op.levels[0]) * self.plant.sensor.gain, (h2 - self.op.levels[1]) * self.plant.sensor.gain]
    }
}

impl HeldPlant for HeldTank<'_> {
    fn outputs(&self) -> [f64; 2] {
        self.signals(&self.water)
    }

    fn set_inputs(&mut self, inputs: [f64; 2]) -> [f64; 2] {
        let wanted = self.pairing.by_pump(inputs);
        let rest = self.op.pump_voltage;
        let taken = [0, 1].map(|i| {
            let pump = &self.plant.pumps[i];
            wanted[i].max(pump.voltage_min - rest[i]).min(pump.voltage_max - rest[i])
        });
        self.water.set_inputs(self.plant, &[rest[0] + taken[0], rest[1] + taken[1]], &Disturbance::default());
        self.pairing.by_loop(taken)
    }

    fn time_to_arrival(&self) -> f64 {
        f64::INFINITY
    }

    fn outputs_after(&self, duration: f64) -> [f64; 2] {
        let mut water = self.water;
        pass(&mut water, duration);
        self.signals(&water)
    }

    fn advance(&mut self, duration: f64) {
        pass(&mut self.water, duration);
    }

    fn search_step(&self) -> f64 {
        PACE_S
    }

    fn multiplications(&self, duration: f64) -> f64 {
        MULTIPLICATIONS * pieces(duration)
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::control::{ParallelPid, PidMatrix, Relay};
    use crate::literature::PresetId;
    use crate::sim::{TwoLoops, run_two_loops};

    #[test]
    fn at_rest_nothing_moves_and_small_steps_are_linear() {
        let preset = PresetId::JohanssonMinimumPhase.preset();
        let op = preset.plant.free_equilibrium(preset.pump_voltage);
        let mut tank = HeldTank::new(&preset.plant, &op, Pairing::Diagonal);
        tank.advance(500.0);
        assert!(tank.outputs().iter().all(|y| y.abs() < 1e-9));
        tank.set_inputs([1e-4, 0.0]);
        // Far beyond the slowest time constant.
        for _ in 0..30 {
            tank.advance(50.0);
        }
        let g = preset.plant.linearise(&op);
        let gain = -g.c * g.a.try_inverse().unwrap() * g.b;
        for i in 0..2 {
            assert_relative_eq!(tank.outputs()[i], 1e-4 * gain[(i, 0)], max_relative = 1e-3);
        }
    }

    #[test]
    fn a_record_shows_what_the_pumps_took_not_what_was_asked_of_them() {
        let preset = PresetId::CocotaNonMinimumPhase.preset();
        let op = preset.plant.free_equilibrium(preset.pump_voltage);
        let limits = preset.plant.pumps.map(|pump| (pump.voltage_min, pump.voltage_max));
        let pid = ParallelPid { proportional: 1e3, ..ParallelPid::default() };
        let loops = TwoLoops {
            relays: [None; 2],
            controllers: PidMatrix::decentralised([pid, ParallelPid { proportional: 1e-3, ..pid }]),
            references: [1.0, 0.0],
            release: 0.0,
            duration: 300.0,
            step: 1.0,
        };
        let trace = run_two_loops(&mut HeldTank::new(&preset.plant, &op, Pairing::Swapped), &loops);
        assert_eq!(trace.limited, [true, false]);
        // Loop 1 drives pump 2.
        let (low, high) = (limits[1].0 - op.pump_voltage[1], limits[1].1 - op.pump_voltage[1]);
        assert_eq!(trace.inputs[0][0], high);
        assert!(trace.inputs[0].iter().all(|u| (low..=high).contains(u)));
    }

    #[test]
    fn relays_with_hysteresis_swing_around_the_operating_point() {
        let preset = PresetId::JohanssonMinimumPhase.preset();
        let op = preset.plant.free_equilibrium(preset.pump_voltage);
        let relay = Relay { hysteresis: 0.05, ..Relay::ideal(0.5, 1.0) };
        let loops = TwoLoops {
            relays: [Some(relay), Some(relay)],
            controllers: PidMatrix::default(),
            references: [0.0; 2],
            release: 5.0,
            duration: 600.0,
            step: 0.5,
        };
        let trace = run_two_loops(&mut HeldTank::new(&preset.plant, &op, Pairing::Diagonal), &loops);
        assert_eq!(trace.halt, None);
        for i in 0..2 {
            assert!(trace.switches[i].len() > 10);
            // Relays of relative degree 1 turn at once: the output stays within the hysteresis once it is there.
            let late = trace.time.iter().zip(&trace.outputs[i]).filter(|(time, _)| **time > 100.0);
            assert!(late.map(|(_, y)| y.abs()).fold(0.0, f64::max) < 0.0501);
        }
    }
}
