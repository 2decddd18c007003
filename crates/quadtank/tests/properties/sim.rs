//! What must hold for every run: water is neither made nor lost, levels keep within the walls, nothing is infinite, a
//! seed decides a run, the linear model is the limit of small steps, and poles foretell growth.

use proptest::prelude::*;
use quadtank::control::{AntiWindup, DecentralisedPi, LoopMode, Pairing, PiSettings, closed_loop};
use quadtank::linear::Stability;
use quadtank::literature::PresetId;
use quadtank::plant::{Disturbance, OperatingPoint, QuadrupleTank};
use quadtank::sim::{
    EventKind, Experiment, Load, LoadStep, Measurement, SetPointStep, Trajectory, loop_metrics, simulate,
    simulate_linear,
};
use quadtank::study::quadruple_tank::setup_of;

#[derive(Clone, Debug)]
struct Setup {
    plant: QuadrupleTank,
    op: OperatingPoint,
    law: DecentralisedPi,
    experiment: Experiment,
}

impl Setup {
    fn run(&self) -> Trajectory {
        simulate(&self.plant, &self.op, &self.law, &self.experiment)
    }

    fn run_linear(&self) -> Trajectory {
        let jacobian = self.plant.linearise(&self.op);
        simulate_linear(&self.plant, &self.op, &jacobian, &self.law, &self.experiment)
    }
}

fn plants() -> impl Strategy<Value = QuadrupleTank> {
    let valve = prop_oneof![8 => 0.0..=1.0, 1 => Just(0.0), 1 => Just(1.0), 1 => 0.99..1.0];
    (prop::sample::select(&PresetId::ALL), [valve.clone(), valve])
        .prop_map(|(id, valves)| id.preset().plant.with_valves(valves))
}

fn settings(gain: impl Strategy<Value = f64>) -> impl Strategy<Value = PiSettings> {
    let anti_windup = prop_oneof![
        Just(AntiWindup::Off),
        (0.01..5.0).prop_map(|tracking_ratio| AntiWindup::BackCalculation { tracking_ratio }),
    ];
    let mode = prop_oneof![
        3 => Just(LoopMode::Automatic),
        1 => (-5.0..15.0, 0.0..500.0).prop_map(|(output, until_s)| LoopMode::Manual { output, until_s }),
    ];
    (gain, 0.1..1e4, 0.0..2.0, anti_windup, mode).prop_map(
        |(gain, integral_time_s, set_point_weight, anti_windup, mode)| PiSettings {
            gain,
            integral_time_s,
            set_point_weight,
            anti_windup,
            mode,
        },
    )
}

fn wild_gain() -> impl Strategy<Value = f64> {
    prop_oneof![-10.0..10.0, -1e6..1e6, Just(0.0), Just(1e12)]
}

fn loads() -> impl Strategy<Value = Vec<LoadStep>> {
    let load = prop_oneof![
        (0..2_usize, -2e-5..2e-5).prop_map(|(pump, flow)| Load::PumpFlow { pump, flow }),
        (0..4_usize, 0.0..2e-5).prop_map(|(tank, area)| Load::Leak { tank, area }),
    ];
    prop::collection::vec((-10.0..600.0, load).prop_map(|(time_s, load)| LoadStep { time_s, load }), 0..4)
}

prop_compose! {
    /// Anything that a document may hold.
    fn wild_setups()(
        plant in plants(),
        voltage in [0.0..12.0, 0.0..12.0_f64],
        pairing in prop::sample::select(&Pairing::ALL),
        loops in [settings(wild_gain()), settings(wild_gain())],
        sampling_time_s in prop_oneof![0.5..2.0, 2.0..60.0],
        steps in prop::collection::vec((0..2_usize, -10.0..600.0, -1.0..1.0), 0..4),
        load_steps in loads(),
        noise_std in prop_oneof![Just(0.0), 0.0..0.01],
        seed in any::<u32>(),
        quantised in any::<bool>(),
    ) -> Setup {
        Setup {
            plant,
            op: plant.free_equilibrium(voltage),
            law: DecentralisedPi { pairing, loops, sampling_time_s },
            experiment: Experiment {
                set_point_steps: steps.into_iter()
                    .map(|(level, time_s, size)| SetPointStep { level, time_s, size }).collect(),
                load_steps,
                measurement: Measurement { noise_std, seed, quantised },
                ..Experiment::at_rest(500.0)
            },
        }
    }
}

/// One of the published plants with settings that work, and a step of a fraction of the level.
fn gentle(id: PresetId, relative_step: f64) -> Setup {
    let preset = id.preset();
    let op = preset.plant.free_equilibrium(preset.pump_voltage);
    let pi = PiSettings {
        gain: 1.0,
        integral_time_s: 60.0,
        set_point_weight: 1.0,
        anti_windup: AntiWindup::BackCalculation { tracking_ratio: 0.5 },
        mode: LoopMode::Automatic,
    };
    Setup {
        plant: preset.plant,
        op,
        law: DecentralisedPi { pairing: Pairing::Diagonal, loops: [pi; 2], sampling_time_s: 1.0 },
        experiment: Experiment {
            set_point_steps: vec![SetPointStep { level: 0, time_s: 10.0, size: relative_step * op.levels[0] }],
            ..Experiment::at_rest(3000.0)
        },
    }
}

fn columns(run: &Trajectory) -> impl Iterator<Item = &Vec<f64>> {
    let pairs = run.references.iter().chain(&run.controller_output).chain(&run.pump_voltage);
    std::iter::once(&run.time_s).chain(&run.levels).chain(pairs)
}

fn is_finite(run: &Trajectory) -> bool {
    columns(run).flatten().all(|x| x.is_finite())
}

/// Water in the plant (m³) at a row.
fn volume(plant: &QuadrupleTank, run: &Trajectory, row: usize) -> f64 {
    (0..4).map(|i| plant.tanks[i].section.volume(run.levels[i][row])).sum()
}

/// What comes in by the pumps and from outside, less what the lower tanks let out, between two rows (m³); the outflow by the trapezium rule.
fn exchanged(plant: &QuadrupleTank, run: &Trajectory, row: usize) -> f64 {
    let levels = |row: usize| [0, 1, 2, 3].map(|i| run.levels[i][row]);
    let out = |row: usize| plant.outflows(&levels(row))[..2].iter().sum::<f64>();
    let voltage = [run.pump_voltage[0][row], run.pump_voltage[1][row]];
    let fed: f64 = plant.feed_flows(&voltage, &Disturbance::default()).iter().sum();
    (run.time_s[row + 1] - run.time_s[row]) * (fed - f64::midpoint(out(row), out(row + 1)))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn nothing_leaves_its_bounds_however_wild_the_setup(setup in wild_setups()) {
        let (run, linear) = (setup.run(), setup.run_linear());
        for trajectory in [&run, &linear] {
            prop_assert!(is_finite(trajectory), "{trajectory:?}");
            prop_assert!(columns(trajectory).all(|column| column.len() == trajectory.time_s.len()));
            prop_assert!(trajectory.time_s.windows(2).all(|t| t[1] > t[0]));
            prop_assert!(*trajectory.time_s.last().unwrap() <= setup.experiment.duration_s);
            for (voltage, pump) in trajectory.pump_voltage.iter().zip(setup.plant.pumps) {
                let slack = 1e-12 * pump.voltage_max;
                prop_assert!(voltage.iter().all(|&v| v >= pump.voltage_min - slack && v <= pump.voltage_max + slack));
            }
        }
        for (levels, tank) in run.levels.iter().zip(setup.plant.tanks) {
            prop_assert!(levels.iter().all(|&h| (0.0..=tank.height * (1.0 + 1e-15)).contains(&h)));
        }
        for event in &run.events {
            prop_assert!(event.time_s >= 0.0 && event.time_s <= setup.experiment.duration_s);
        }
        prop_assert!(run.events.windows(2).all(|pair| pair[0].time_s <= pair[1].time_s));
        prop_assert!(linear.events.is_empty());
        for metrics in loop_metrics(&run, &setup.plant, &setup.law, &setup.experiment) {
            let sums = [metrics.iae, metrics.ise, metrics.itae, metrics.other_peak, metrics.total_variation, metrics.saturated_s];
            prop_assert!(sums.iter().all(|x| x.is_finite() && *x >= 0.0), "{metrics:?}");
            let figures = [metrics.rise_time_s, metrics.overshoot, metrics.undershoot];
            prop_assert!(figures.into_iter().flatten().all(|x| x.is_finite() && x >= 0.0), "{metrics:?}");
        }
    }

    #[test]
    fn a_seed_decides_a_run(setup in wild_setups()) {
        prop_assert_eq!(setup.run(), setup.run());
    }

    #[test]
    fn closed_loops_have_finite_poles_in_order(setup in wild_setups()) {
        let jacobian = setup.plant.linearise(&setup.op);
        let closed = closed_loop(&jacobian, &setup.law, setup.plant.power_gain).unwrap();
        prop_assert!(closed.poles_z.windows(2).all(|pair| pair[0].norm() >= pair[1].norm()));
        prop_assert!(closed.poles_s.iter().all(|s| s.is_finite()));
        prop_assert_eq!(closed.sensitivity_peak.is_some(), closed.stability == Stability::Stable);
        prop_assert!(closed.sensitivity_peak.is_none_or(|peak| peak.value >= 0.99 && peak.value.is_finite()));
    }

    #[test]
    fn water_is_neither_made_nor_lost(
        id in prop::sample::select(&PresetId::ALL),
        relative_step in -0.1..0.1,
        valves in [0.3..0.7, 0.3..0.7],
    ) {
        let mut setup = gentle(id, relative_step);
        setup.plant = setup.plant.with_valves(valves);
        setup.op = setup.plant.free_equilibrium(setup.op.pump_voltage);
        let run = setup.run();
        prop_assume!(!run.events.iter().any(|event| matches!(event.kind, EventKind::Overflow { .. })));
        let last = run.time_s.len() - 1;
        let change = volume(&setup.plant, &run, last) - volume(&setup.plant, &run, 0);
        let balance: f64 = (0..last).map(|row| exchanged(&setup.plant, &run, row)).sum();
        // The trapezium rule of this test is what limits it: Δt²/12 times the change of the outflow's slope.
        let through = setup.plant.outflows(&setup.op.levels)[..2].iter().sum::<f64>() * run.time_s[last];
        prop_assert!((change - balance).abs() <= 1e-6 * through, "{change} against {balance} m3");
    }

    #[test]
    fn an_unstable_loop_leaves_its_operating_point_and_a_stable_one_returns(
        id in prop::sample::select(&PresetId::ALL),
        gains in [-3.0..3.0, -3.0..3.0],
        integral_times in [20.0..300.0, 20.0..300.0],
        pairing in prop::sample::select(&Pairing::ALL),
    ) {
        let mut setup = gentle(id, 0.0);
        for (settings, (gain, integral_time_s)) in setup.law.loops.iter_mut().zip(gains.into_iter().zip(integral_times)) {
            (settings.gain, settings.integral_time_s) = (gain, integral_time_s);
        }
        setup.law.pairing = pairing;
        setup.experiment.duration_s = 6000.0;
        // A load that goes away again leaves a small disturbance of the state.
        let flow = 1e-5 * setup.plant.pumps[0].gain;
        let push = |time_s, flow| LoadStep { time_s, load: Load::PumpFlow { pump: 0, flow } };
        setup.experiment.load_steps = vec![push(0.0, flow), push(30.0, -flow)];
        let closed = closed_loop(&setup.plant.linearise(&setup.op), &setup.law, setup.plant.power_gain).unwrap();
        let rate = closed.rightmost_pole().unwrap().re;
        prop_assume!(rate.abs() > 4e-3);
        let run = setup.run_linear();
        let distance = |row: usize| (0..4).map(|i| (run.levels[i][row] - setup.op.levels[i]).abs()).sum::<f64>();
        let (early, late) = (distance(40), distance(run.time_s.len() - 1));
        prop_assert_eq!(late > early, closed.stability == Stability::Unstable, "{} 1/s: {} to {} m", rate, early, late);
    }
}

#[test]
fn the_linear_model_is_the_limit_of_small_steps() {
    for id in PresetId::ALL {
        let difference = |relative_step: f64| {
            let mut setup = gentle(id, relative_step);
            // Loops of its own: those of another rig may be unstable, and what grows is soon far from any linear model.
            let own = setup_of(id).controller;
            (setup.law.pairing, setup.law.loops) = (own.pairing, own.loops);
            let (run, linear) = (setup.run(), setup.run_linear());
            let rows = 0..=300;
            let worst =
                rows.flat_map(|k| (0..4).map(move |i| (i, k))).map(|(i, k)| run.levels[i][k] - linear.levels[i][k]);
            worst.fold(0.0, |max: f64, x| max.max(x.abs()))
        };
        let (large, small) = (difference(1e-2), difference(1e-3));
        // The first thing that the linear model leaves out is of second order in the step.
        assert!((80.0..120.0).contains(&(large / small)), "{id:?}: {large} and {small}");
    }
}

#[test]
fn automatic_takes_over_from_manual_without_a_bump() {
    let mut setup = gentle(PresetId::CocotaMinimumPhase, 0.0);
    let output = setup.op.pump_voltage[0] / setup.plant.power_gain;
    setup.law.loops[0].mode = LoopMode::Manual { output: output - 0.5, until_s: 300.0 };
    let run = setup.run();
    let column = &run.controller_output[0];
    assert_eq!(column[299], output - 0.5);
    // One sample of integration of the error that manual mode left.
    let error = setup.plant.sensor.gain * (run.references[0][300] - run.levels[0][300]);
    assert!(error > 0.1);
    assert!((column[300] - column[299]).abs() <= 1.1 * error / 60.0, "{} to {}", column[299], column[300]);
}

#[test]
fn a_load_begins_at_its_exact_time() {
    let mut setup = gentle(PresetId::JohanssonMinimumPhase, 0.0);
    for settings in &mut setup.law.loops {
        settings.gain = 0.0;
    }
    let flow = 1e-6;
    setup.experiment.load_steps = vec![LoadStep { time_s: 20.25, load: Load::PumpFlow { pump: 0, flow } }];
    for run in [setup.run(), setup.run_linear()] {
        let rise = run.levels[0][21] - setup.op.levels[0];
        let tank = setup.plant.tanks[0];
        let expected = 0.75 * setup.plant.valves[0] * flow / tank.section.area(setup.op.levels[0]);
        assert_eq!(run.levels[0][20], run.levels[0][19]);
        // Within the share that has run out again in 0.75 s, T1 being about a minute.
        assert!((rise / expected - 1.0).abs() < 0.02, "{rise} instead of {expected} m");
    }
}

#[test]
fn rows_are_dense_even_if_samples_are_not() {
    let mut setup = gentle(PresetId::JohanssonMinimumPhase, 0.05);
    setup.law.sampling_time_s = 30.0;
    let run = setup.run();
    assert_eq!((run.time_s.len(), run.time_s[1]), (1501, 2.0));
    let jumps = run.pump_voltage[0].windows(2).enumerate().filter(|(_, v)| v[0] != v[1]);
    assert!(jumps.clone().count() > 10);
    assert!(jumps.into_iter().all(|(row, _)| (row + 1) % 15 == 0), "the pumps move at samples only");
}

#[test]
fn a_full_tank_overflows_and_an_empty_one_says_so_once() {
    let mut setup = gentle(PresetId::JohanssonMinimumPhase, 0.0);
    setup.experiment.set_point_steps = vec![
        SetPointStep { level: 0, time_s: 50.0, size: 1.0 },
        SetPointStep { level: 1, time_s: 50.0, size: 1.0 },
        SetPointStep { level: 0, time_s: 400.0, size: -3.0 },
        SetPointStep { level: 1, time_s: 400.0, size: -3.0 },
    ];
    let run = setup.run();
    let first = |kind: EventKind| {
        let times: Vec<f64> = run.events.iter().filter(|event| event.kind == kind).map(|event| event.time_s).collect();
        assert_eq!(times.len(), 1, "{kind:?}: {:?}", run.events);
        times[0]
    };
    for tank in 0..2 {
        let (full, empty) = (first(EventKind::Overflow { tank }), first(EventKind::Empty { tank }));
        assert!(full > 50.0 && full < 400.0 && empty > 400.0);
        let row = run.levels[tank].iter().position(|&h| h >= setup.plant.tanks[tank].height - 1e-12).unwrap();
        assert!((run.time_s[row] - full).abs() <= 1.0);
    }
    assert_eq!(first(EventKind::Saturated { pump: 0 }), 50.0);
}

#[test]
fn nonsense_gives_short_runs_and_not_panics() {
    for (duration_s, sampling_time_s) in
        [(f64::NAN, 1.0), (-1.0, 1.0), (0.0, 1.0), (100.0, f64::NAN), (100.0, 0.0), (100.0, -1.0), (f64::INFINITY, 1.0)]
    {
        let mut setup = gentle(PresetId::JohanssonMinimumPhase, 0.05);
        setup.experiment.duration_s = duration_s;
        setup.law.sampling_time_s = sampling_time_s;
        setup.experiment.set_point_steps.push(SetPointStep { level: 7, time_s: 0.0, size: 1.0 });
        setup.experiment.load_steps.push(LoadStep { time_s: 0.0, load: Load::Leak { tank: 9, area: 1.0 } });
        for run in [setup.run(), setup.run_linear()] {
            assert!(run.time_s.len() <= quadtank::sim::MAX_ROWS);
            loop_metrics(&run, &setup.plant, &setup.law, &setup.experiment);
        }
        let _ = closed_loop(&setup.plant.linearise(&setup.op), &setup.law, setup.plant.power_gain);
    }
}
