//! The pieces of one slider tick on the home bench, and of relay tuning, natively: `cargo bench -p quadtank-scenario`.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use quadtank::control::{
    AntiWindup, DecentralisedPi, LoopMode, Pairing, ParallelPid, PiSettings, PidMatrix, closed_loop,
};
use quadtank::interaction::relative_gain_array;
use quadtank::linear::{DelayedPlant, StateSpace, transmission_zeros};
use quadtank::literature::PresetId;
use quadtank::literature::campestrini::PublishedPlant;
use quadtank::literature::junqueira::{PublishedExperiment, PublishedValves};
use quadtank::plant::{OperatingPoint, QuadrupleTank};
use quadtank::sim::{
    Experiment, SetPointStep, TwoLoops, loop_metrics, run_two_loops, simulate, simulate_linear, simulate_model_free,
};
use quadtank::study::model_free::ModelFreeSetup;
use quadtank::tuning::{CriticalCurve, CriticalSearch, Design, TestTime, frequency_range, simultaneous_test};

/// Johansson (2000), P−, with its published controllers: 3000 s at one sample per second, a step of 5 % of each
/// reference.
struct Bench {
    rig: QuadrupleTank,
    op: OperatingPoint,
    law: DecentralisedPi,
    experiment: Experiment,
}

impl Bench {
    fn with_valves(valves: [f64; 2]) -> Self {
        let preset = PresetId::JohanssonMinimumPhase.preset();
        let rig = preset.plant.with_valves(valves);
        let op = rig.free_equilibrium(preset.pump_voltage);
        let pi = |gain, integral_time_s| PiSettings {
            gain,
            integral_time_s,
            set_point_weight: 1.0,
            anti_windup: AntiWindup::BackCalculation { tracking_ratio: 0.5 },
            mode: LoopMode::Automatic,
        };
        let law =
            DecentralisedPi { pairing: Pairing::Diagonal, loops: [pi(3.0, 30.0), pi(2.7, 40.0)], sampling_time_s: 1.0 };
        let step = |level: usize, time_s| SetPointStep { level, time_s, size: 0.05 * op.levels[level] };
        let experiment =
            Experiment { set_point_steps: vec![step(0, 100.0), step(1, 1500.0)], ..Experiment::at_rest(3000.0) };
        Self { rig, op, law, experiment }
    }

    fn noisy(mut self) -> Self {
        self.experiment.measurement.noise_std = 1e-4;
        self
    }
}

fn theory(c: &mut Criterion) {
    let bench = Bench::with_valves([0.7, 0.6]);
    let jacobian = bench.rig.linearise(&bench.op);
    let (a, b, output) = jacobian.reduced();
    let model = StateSpace::strictly_proper(a, b, output).expect("matrices that fit");
    let gain = model.dc_gain().expect("a plant with a steady state");
    c.bench_function("linearise", |t| t.iter(|| black_box(&bench.rig).linearise(&bench.op)));
    c.bench_function("transmission zeros", |t| t.iter(|| transmission_zeros(black_box(&model))));
    c.bench_function("relative gain array", |t| t.iter(|| relative_gain_array(black_box(&gain))));
    c.bench_function("closed loop", |t| t.iter(|| closed_loop(black_box(&jacobian), &bench.law, 1.0)));
}

fn runs(c: &mut Criterion) {
    let stiff = [0.999, 0.995];
    for (name, bench) in [
        ("nonlinear run", Bench::with_valves([0.7, 0.6])),
        ("nonlinear run, noise", Bench::with_valves([0.7, 0.6]).noisy()),
        ("nonlinear run, upper tanks almost dry", Bench::with_valves(stiff)),
        ("nonlinear run, upper tanks dry", Bench::with_valves([1.0, 1.0])),
    ] {
        let Bench { rig, op, law, experiment } = &bench;
        c.bench_function(name, |t| t.iter(|| simulate(black_box(rig), op, law, experiment)));
    }
    let bench = Bench::with_valves([0.7, 0.6]);
    let Bench { rig, op, law, experiment } = &bench;
    let jacobian = rig.linearise(op);
    c.bench_function("linear run", |t| t.iter(|| simulate_linear(black_box(rig), op, &jacobian, law, experiment)));
    let run = simulate(rig, op, law, experiment);
    c.bench_function("metrics", |t| t.iter(|| loop_metrics(black_box(&run), rig, law, experiment)));
}

/// Relay tuning of Wood and Berry: the pieces of one drag of the target.
fn relay_tuning(c: &mut Criterion) {
    let plant = PublishedPlant::WoodBerry.transfer_matrix().expect("printed parameters");
    let (low, high) = frequency_range(&plant).expect("poles of lags");
    let search = CriticalSearch::new(&plant, low, high);
    let table_6 = [pid(0.567, 0.336, 0.239), pid(-0.102, -0.018, -0.144)];
    let controllers = PidMatrix::decentralised(table_6);
    let design = Design::new(&plant, controllers).expect("a stable plant");
    let test = TestTime { duration: 400.0, release: 4.0, step: 0.05 };
    let response =
        TwoLoops { relays: [None; 2], controllers, references: [1.0, 0.0], release: 0.0, duration: 200.0, step: 0.1 };
    c.bench_function("critical search, grid", |t| t.iter(|| CriticalSearch::new(black_box(&plant), low, high)));
    c.bench_function("critical curve, 200 directions", |t| {
        t.iter(|| CriticalCurve::of(black_box(&plant), &search, 200));
    });
    c.bench_function("both loci, 600 frequencies", |t| t.iter(|| black_box(&design).loci()));
    c.bench_function("encirclements", |t| t.iter(|| black_box(&design).stability()));
    c.bench_function("margins", |t| t.iter(|| black_box(&design).margins()));
    // Gains a million times too large: both searches end at their bounds on work.
    let far = PidMatrix::decentralised([pid(1e6, 1e6, 0.0), pid(-1e6, -1e6, 0.0)]);
    let far = Design::new(&plant, far).expect("a stable plant");
    c.bench_function("encirclements, given up", |t| t.iter(|| black_box(&far).stability()));
    c.bench_function("margins, given up", |t| t.iter(|| black_box(&far).margins()));
    c.bench_function("simultaneous relay test, 400", |t| {
        t.iter(|| simultaneous_test(black_box(&plant), [1.0; 2], test));
    });
    c.bench_function("step of two PID loops, 200", |t| {
        t.iter(|| DelayedPlant::new(&plant.paths()).map(|mut held| run_two_loops(&mut held, black_box(&response))));
    });
}

fn pid(proportional: f64, integral: f64, derivative: f64) -> ParallelPid {
    ParallelPid { proportional, integral, derivative, ..ParallelPid::default() }
}

/// 2000 s of each published case under the published law.
fn model_free(c: &mut Criterion) {
    for valves in PublishedValves::ALL {
        let mut setup = ModelFreeSetup::published(valves, PublishedExperiment::S2);
        setup.experiment.duration_s = 2000.0;
        let (plant, start) = (setup.plant_at(0.0), setup.start().expect("equal levels"));
        let ModelFreeSetup { valves: schedules, controller, experiment, .. } = &setup;
        c.bench_function(&format!("model-free run, case {valves:?}"), |t| {
            t.iter(|| simulate_model_free(black_box(&plant), schedules, &start, controller, experiment));
        });
    }
}

criterion_group!(benches, theory, runs, relay_tuning, model_free);
criterion_main!(benches);
