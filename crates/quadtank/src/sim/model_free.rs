//! The nonlinear plant with valves that move, under the model-free law or two PI loops.

use std::array::from_fn;

use crate::control::{DecentralisedPi, EstimatorError, ModelFree, RunningModelFree};
use crate::plant::{Disturbance, OperatingPoint, QuadrupleTank, ValveSchedule};

use super::course::{self, Events, Law, Loads, Process, Sampled, TIME_SLACK};
use super::experiment::Experiment;
use super::hydraulics::Hydraulics;
use super::trajectory::Trajectory;

/// Longest step of the integration, in the time in which a valve turns by one radian. About a part in a million of the
/// ripple is left.
const TURN: f64 = 0.25;

/// The plant with its water and its moving valves.
struct MovingRig<'a> {
    plant: QuadrupleTank,
    valves: &'a [ValveSchedule; 2],
    water: Hydraulics,
    voltage: [f64; 2],
    disturbance: Disturbance,
}

impl<'a> MovingRig<'a> {
    fn new(plant: &QuadrupleTank, valves: &'a [ValveSchedule; 2], levels: &[f64; 4]) -> Self {
        let plant = plant.with_valves(valves.map(|valve| valve.at(0.0)));
        let water = Hydraulics::new(&plant, levels);
        Self { plant, valves, water, voltage: [0.0; 2], disturbance: Disturbance::default() }
    }

    fn is_still(&self) -> bool {
        self.valves.iter().all(ValveSchedule::is_constant)
    }
}

impl Process for MovingRig<'_> {
    fn levels(&self) -> [f64; 4] {
        self.water.levels()
    }

    fn set_inputs(&mut self, pump_voltage: &[f64; 2], disturbance: &Disturbance) {
        (self.voltage, self.disturbance) = (*pump_voltage, *disturbance);
        self.water.set_inputs(&self.plant, pump_voltage, disturbance);
    }

    /// A step with valves that move takes twice the time of one with valves at rest.
    fn work(&self) -> u64 {
        if self.is_still() { self.water.work } else { 2 * self.water.work }
    }

    /// From break to break of the schedules, so that no step of the integration sees both sides of one.
    fn advance(&mut self, time: f64, duration: f64, events: &mut Events) {
        if self.is_still() {
            return self.water.advance(time, duration, events);
        }
        let Self { plant, valves, water, voltage, disturbance } = self;
        let longest = TURN / valves[0].angular_frequency().max(valves[1].angular_frequency());
        let end = time + duration;
        let mut now = time;
        while now < end {
            let breaks = valves.iter().flat_map(ValveSchedule::breaks_s).flatten();
            let next = breaks.filter(|&at| now < at && at < end).fold(end, f64::min);
            let last = next.next_down();
            let flows = |t: f64| plant.feed_flows_at(valves.map(|valve| valve.at(t.min(last))), voltage, disturbance);
            water.advance_with(now, next - now, longest, flows, events);
            now = next;
        }
    }
}

/// A run under the model-free law.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelFreeRun {
    /// The course; every `rows_per_sample`-th row is a sample.
    pub trajectory: Trajectory,
    /// Rows from one sample to the next.
    pub rows_per_sample: usize,
    /// φ̂ of loops 1 and 2 at each sample, as the law used it (m/s).
    pub estimates: [Vec<f64>; 2],
    /// What φ really is from each sample on, `dh/dt − α̂ u` (m/s).
    pub true_values: [Vec<f64>; 2],
}

impl ModelFreeRun {
    /// φ̂ of loops 1 and 2, and φ itself, as of the sample in force at a time (s), in m/s; `None` for a run without rows.
    pub fn phi_at(&self, time_s: f64) -> Option<[[f64; 2]; 2]> {
        let sample = self.trajectory.row_at(time_s)? / self.rows_per_sample;
        let at_sample = |[first, second]: &[Vec<f64>; 2]| Some([*first.get(sample)?, *second.get(sample)?]);
        Some([at_sample(&self.estimates)?, at_sample(&self.true_values)?])
    }
}

/// The law with the estimates that it used.
struct Recorded {
    law: RunningModelFree,
    sensor_gain: f64,
    estimates: [Vec<f64>; 2],
}

impl Law for Recorded {
    fn step(&mut self, _: f64, reference: [f64; 2], measured: [f64; 2]) -> [f64; 2] {
        let level = |signal: f64| signal / self.sensor_gain;
        let output = self.law.step(reference.map(level), measured.map(level));
        for (column, estimate) in self.estimates.iter_mut().zip(self.law.estimates()) {
            column.push(estimate);
        }
        output
    }
}

/// Runs an experiment on the nonlinear plant with valves that move, under the model-free law.
///
/// The valves of `plant` count for nothing. The run starts at `start`, which need not be an equilibrium, or at the levels that the
/// experiment gives: references begin at the levels of `start`, φ̂ at `−α̂` times its voltages. Samples, loads and walls are as in [`simulate`](super::simulate); the schedules
/// enter the integration itself, not only at samples.
///
/// # Errors
/// As [`ModelFree::check`].
pub fn simulate_model_free(
    plant: &QuadrupleTank,
    valves: &[ValveSchedule; 2],
    start: &OperatingPoint,
    law: &ModelFree,
    experiment: &Experiment,
) -> Result<ModelFreeRun, EstimatorError> {
    let ModelFree { pairing, sampling_time_s, .. } = *law;
    let output = course::output_at_rest(plant, start);
    let running = law.start(plant.controller_limits(), output, [start.levels[0], start.levels[1]])?;
    let mut recorded = Recorded { law: running, sensor_gain: plant.sensor.gain, estimates: Default::default() };
    let sampled = Sampled { law: &mut recorded, pairing, sampling_time_s };
    let mut rig = MovingRig::new(plant, valves, experiment.first_levels(start));
    let trajectory = course::run(&mut rig, plant, start, sampled, experiment);
    let rows_per_sample = course::rows_per_sample(experiment, sampling_time_s);
    let true_values = true_values(plant, valves, law, experiment, &trajectory, rows_per_sample);
    Ok(ModelFreeRun { trajectory, rows_per_sample, estimates: recorded.estimates, true_values })
}

/// Runs the same experiment with two PI loops, to compare with; see [`simulate_model_free`]. Also how many rows it is from one
/// sample to the next.
pub fn simulate_with_valves(
    plant: &QuadrupleTank,
    valves: &[ValveSchedule; 2],
    start: &OperatingPoint,
    controller: &DecentralisedPi,
    experiment: &Experiment,
) -> (Trajectory, usize) {
    let mut rig = MovingRig::new(plant, valves, experiment.first_levels(start));
    let run = course::run_pi(&mut rig, plant, start, controller, experiment);
    (run, course::rows_per_sample(experiment, controller.sampling_time_s))
}

fn true_values(
    plant: &QuadrupleTank,
    valves: &[ValveSchedule; 2],
    law: &ModelFree,
    experiment: &Experiment,
    run: &Trajectory,
    rows_per_sample: usize,
) -> [Vec<f64>; 2] {
    let steps = experiment.all_loads(plant.inflow);
    let mut loads = Loads::new(&steps);
    let slack = TIME_SLACK * law.sampling_time_s;
    let mut values: [Vec<f64>; 2] = Default::default();
    for row in (0..run.time_s.len()).step_by(rows_per_sample) {
        let plant = plant.with_valves(valves.map(|valve| valve.at(run.time_s[row])));
        let levels = from_fn(|tank| run.levels[tank][row]);
        let voltage = [run.pump_voltage[0][row], run.pump_voltage[1][row]];
        let slope = plant.derivative(&levels, &voltage, loads.at(run.time_s[row] + slack));
        for (i, column) in values.iter_mut().enumerate() {
            // At its wall a level rises no further, whatever comes in.
            let is_full = levels[i] >= plant.tanks[i].height;
            let slope = if is_full { slope[i].min(0.0) } else { slope[i] };
            column.push(slope - law.loops[i].model_gain * run.controller_output[i][row]);
        }
    }
    values
}
