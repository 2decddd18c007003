//! Closed loops of the reference file, computed independently with a high-accuracy integrator: levels, controller
//! outputs and integrated errors. The bar is 1e-6 of the set-point step.
//!
//! The reference cuts levels to the wall at samples only, which lets a full tank drain too fast between them. So it counts
//! until a tank is full; `full_and_dry` has what follows.

use quadtank::control::{AntiWindup, DecentralisedPi, LoopMode, Pairing, PiSettings};
use quadtank::plant::{OperatingPoint, QuadrupleTank};
use quadtank::sim::{EventKind, Experiment, SetPointStep, Trajectory, loop_metrics, simulate};
use serde::Deserialize;

use super::reference::Parameters;

/// Allowed deviation, as a fraction of the set-point step (of the step times sensor gain for controller outputs).
const BAR: f64 = 1e-6;

#[derive(Deserialize)]
struct Reference {
    cases: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    name: String,
    plant: Parameters,
    pump_voltage: [f64; 2],
    #[serde(default)]
    closed_loops: Vec<Loop>,
}

#[derive(Deserialize)]
struct Loop {
    controller: Controller,
    steps: Vec<Step>,
    tank_height: f64,
    samples: Vec<Sample>,
    iae_measured: [f64; 2],
}

/// By pump: `measures_output[j]` is the level, from 1, that pump j answers.
#[derive(Deserialize)]
struct Controller {
    gain: [f64; 2],
    integral_time: [f64; 2],
    measures_output: [usize; 2],
    sampling_time: f64,
    tracking_time: [f64; 2],
    output_limits: [f64; 2],
    actuator_gain: f64,
    set_point_weight: f64,
}

#[derive(Deserialize)]
struct Step {
    output: usize,
    time: f64,
    relative: f64,
}

#[derive(Deserialize)]
struct Sample {
    time: f64,
    levels: [f64; 4],
    controller_output: [f64; 2],
}

impl Case {
    fn rig(&self, run: &Loop) -> QuadrupleTank {
        let [low, high] = run.controller.output_limits.map(|limit| run.controller.actuator_gain * limit);
        let mut rig = self.plant.rig();
        rig.tanks.iter_mut().for_each(|tank| tank.height = run.tank_height);
        rig.pumps.iter_mut().for_each(|pump| (pump.voltage_min, pump.voltage_max) = (low, high));
        rig.power_gain = run.controller.actuator_gain;
        rig.sensor.range = 1.0;
        rig
    }
}

impl Controller {
    fn pairing(&self) -> Pairing {
        if self.measures_output == [1, 2] { Pairing::Diagonal } else { Pairing::Swapped }
    }

    fn law(&self) -> DecentralisedPi {
        let of_pump = |j: usize| PiSettings {
            gain: self.gain[j],
            integral_time_s: self.integral_time[j],
            set_point_weight: self.set_point_weight,
            anti_windup: AntiWindup::BackCalculation { tracking_ratio: self.tracking_time[j] / self.integral_time[j] },
            mode: LoopMode::Automatic,
        };
        let loops = self.pairing().by_loop([of_pump(0), of_pump(1)]);
        DecentralisedPi { pairing: self.pairing(), loops, sampling_time_s: self.sampling_time }
    }
}

impl Loop {
    fn experiment(&self, op: &OperatingPoint) -> Experiment {
        let step = |step: &Step| SetPointStep {
            level: step.output - 1,
            time_s: step.time,
            size: step.relative * op.levels[step.output - 1],
        };
        Experiment {
            set_point_steps: self.steps.iter().map(step).collect(),
            ..Experiment::at_rest(self.samples.last().unwrap().time)
        }
    }
}

fn cases() -> Vec<Case> {
    let reference: Reference = serde_json::from_str(include_str!("../../data/quadruple-tank.json")).unwrap();
    reference.cases
}

/// Runs every closed loop of the file.
fn for_each_loop(mut check: impl FnMut(&str, &Loop, &QuadrupleTank, &DecentralisedPi, &Experiment, &Trajectory)) {
    let mut loops = 0;
    for case in cases() {
        for run in &case.closed_loops {
            let rig = case.rig(run);
            let op = rig.free_equilibrium(case.pump_voltage);
            let (law, experiment) = (run.controller.law(), run.experiment(&op));
            check(&case.name, run, &rig, &law, &experiment, &simulate(&rig, &op, &law, &experiment));
            loops += 1;
        }
    }
    assert_eq!(loops, 5);
}

#[test]
fn levels_and_outputs_agree_with_the_reference() {
    for_each_loop(|name, run, rig, law, experiment, trajectory| {
        let step = experiment.set_point_steps[0].size;
        let mut worst = (0.0_f64, 0.0_f64);
        let before_a_wall = |sample: &&Sample| sample.levels.iter().all(|&level| level < run.tank_height);
        for sample in run.samples.iter().take_while(before_a_wall) {
            let row = trajectory.time_s.iter().position(|&t| (t - sample.time).abs() < 1e-9).unwrap();
            for (column, expected) in trajectory.levels.iter().zip(sample.levels) {
                worst.0 = worst.0.max((column[row] - expected).abs() / step);
            }
            let output = law.pairing.by_loop(sample.controller_output);
            for (column, expected) in trajectory.controller_output.iter().zip(output) {
                worst.1 = worst.1.max((column[row] - expected).abs() / (rig.sensor.gain * step));
            }
        }
        println!("{name} {:?}: levels {:.1e}, outputs {:.1e}", law.pairing, worst.0, worst.1);
        assert!(worst.0 <= BAR && worst.1 <= BAR, "{name}: {worst:?} of the step");
    });
}

#[test]
fn integrated_errors_agree_with_the_reference() {
    let mut compared = 0;
    for_each_loop(|name, run, rig, law, experiment, trajectory| {
        if trajectory.events.iter().any(|event| matches!(event.kind, EventKind::Overflow { .. })) {
            return;
        }
        compared += 1;
        let metrics = loop_metrics(trajectory, rig, law, experiment);
        for (metrics, expected) in metrics.iter().zip(run.iae_measured) {
            let iae = rig.sensor.gain * metrics.iae;
            assert!((iae / expected - 1.0).abs() <= BAR, "{name}: {iae} instead of {expected}");
        }
    });
    assert_eq!(compared, 4);
}
