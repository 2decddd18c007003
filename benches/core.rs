//! The pieces of one slider tick on the home bench, natively: `cargo bench --no-default-features`.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use quadtank::control::{AntiWindup, DecentralisedPi, LoopMode, Pairing, PiSettings};
use quadtank::interaction::relative_gain_array;
use quadtank::linear::{StateSpace, transmission_zeros};
use quadtank::plant::{OperatingPoint, PresetId, QuadrupleTank};
use quadtank::sim::{Experiment, Measurement, SetPointStep, closed_loop, loop_metrics, simulate, simulate_linear};

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
        let experiment = Experiment {
            duration_s: 3000.0,
            set_point_steps: vec![step(0, 100.0), step(1, 1500.0)],
            load_steps: vec![],
            measurement: Measurement { noise_std: 0.0, seed: 1, quantised: false },
        };
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

criterion_group!(benches, theory, runs);
criterion_main!(benches);
