//! Tanks that stand full and tanks that run dry, against an independent integration and closed forms. The bar is 1e-6 of the
//! largest excursion of a level, as for every other run.
#![cfg(not(target_arch = "wasm32"))]

mod tank_reference;

use approx::assert_abs_diff_eq;
use proptest::prelude::*;
use quadtank::control::{AntiWindup, DecentralisedPi, LoopMode, Pairing, PiSettings};
use quadtank::plant::{OperatingPoint, PresetId, QuadrupleTank, ValveSchedule};
use quadtank::sim::{
    EventKind, Experiment, HeldPlant, HeldTank, Load, LoadStep, Measurement, SetPointStep, Trajectory, simulate,
    simulate_with_valves,
};
use tank_reference::{Reference, pumped};

/// Allowed deviation, as a fraction of the largest excursion of a level.
const BAR: f64 = 1e-6;
/// Allowed deviation of the time of an event (s), beside the time in which the level moves by its own allowed deviation.
const TIME_BAR: f64 = 1e-6;
const SAMPLING_TIMES: [f64; 4] = [0.1, 1.0, 10.0, 60.0];

/// Pumps at fixed voltages from given levels on, with loads at their times.
#[derive(Clone, Debug)]
struct OpenLoop {
    plant: QuadrupleTank,
    start: OperatingPoint,
    loads: Vec<LoadStep>,
    duration_s: f64,
}

impl OpenLoop {
    fn new(plant: &QuadrupleTank, levels: [f64; 4], pump_voltage: [f64; 2], duration_s: f64) -> Self {
        Self { plant: *plant, start: OperatingPoint { levels, pump_voltage }, loads: vec![], duration_s }
    }

    fn pump_flow(mut self, time_s: f64, flow: [f64; 2]) -> Self {
        let step = |pump: usize| LoadStep { time_s, load: Load::PumpFlow { pump, flow: flow[pump] } };
        self.loads.extend([step(0), step(1)]);
        self
    }

    fn leak(mut self, time_s: f64, tank: usize, area: f64) -> Self {
        self.loads.push(LoadStep { time_s, load: Load::Leak { tank, area } });
        self
    }

    fn experiment(&self) -> Experiment {
        Experiment {
            duration_s: self.duration_s,
            set_point_steps: vec![],
            load_steps: self.loads.clone(),
            measurement: Measurement { noise_std: 0.0, seed: 1, quantised: false },
        }
    }

    fn by_hand(&self, sampling_time_s: f64) -> DecentralisedPi {
        let by_hand = |pump: usize| PiSettings {
            gain: 1.0,
            integral_time_s: 100.0,
            set_point_weight: 1.0,
            anti_windup: AntiWindup::Off,
            mode: LoopMode::Manual {
                output: self.start.pump_voltage[pump] / self.plant.power_gain,
                until_s: f64::INFINITY,
            },
        };
        DecentralisedPi { pairing: Pairing::Diagonal, loops: [by_hand(0), by_hand(1)], sampling_time_s }
    }

    fn run(&self, sampling_time_s: f64) -> Trajectory {
        simulate(&self.plant, &self.start, &self.by_hand(sampling_time_s), &self.experiment())
    }

    fn run_with(&self, valves: &[ValveSchedule; 2], sampling_time_s: f64) -> Trajectory {
        simulate_with_valves(&self.plant, valves, &self.start, &self.by_hand(sampling_time_s), &self.experiment()).0
    }

    /// The reference at given times, over every load at its time and every break of the valves.
    fn reference(&self, valves: &[ValveSchedule; 2], times: &[f64]) -> (Vec<[f64; 4]>, Reference) {
        let plant = self.plant.with_valves(valves.map(|valve| valve.at(0.0)));
        let mut water = Reference::new(&plant, self.start.levels);
        let mut rows = vec![];
        for &time in times {
            while water.time < time {
                let breaks = valves.iter().flat_map(ValveSchedule::breaks_s).flatten();
                let begins = self.loads.iter().map(|load| load.time_s).chain(breaks);
                let next = begins.filter(|&at| at > water.time).fold(time, f64::min);
                let (flow, leaks) = self.acting(water.time);
                let last = next.next_down();
                let flows = |t: f64| {
                    let plant = plant.with_valves(valves.map(|valve| valve.at(t.min(last))));
                    pumped(&plant, self.start.pump_voltage, flow)
                };
                water.run_until(next, flows, &leaks);
            }
            rows.push(water.levels);
        }
        (rows, water)
    }

    /// Flows added to the pumps and leaks from a time on.
    fn acting(&self, time: f64) -> ([f64; 2], [f64; 4]) {
        let (mut flow, mut leaks) = ([0.0; 2], [0.0; 4]);
        for step in self.loads.iter().filter(|step| step.time_s <= time) {
            match step.load {
                Load::PumpFlow { pump, flow: size } => flow[pump] += size,
                Load::Leak { tank, area } => leaks[tank] += area,
            }
        }
        (flow, leaks)
    }

    fn standing_valves(&self) -> [ValveSchedule; 2] {
        self.plant.valves.map(|gamma| ValveSchedule::Constant { gamma })
    }

    /// Compares all levels and the times of all events; gives back the reference at the end.
    fn check(&self, name: &str, sampling_time_s: f64) -> Reference {
        self.compare(name, &self.standing_valves(), &self.run(sampling_time_s))
    }

    fn compare(&self, name: &str, valves: &[ValveSchedule; 2], run: &Trajectory) -> Reference {
        let (rows, end) = self.reference(valves, &run.time_s);
        let start = rows[0];
        let excursion = rows.iter().flat_map(|h| (0..4).map(|i| (h[i] - start[i]).abs())).fold(0.0, f64::max);
        let mut worst = (0.0, 0, 0.0);
        for (row, expected) in rows.iter().enumerate() {
            for (tank, (column, expected)) in run.levels.iter().zip(expected).enumerate() {
                let error = (column[row] - expected).abs() / excursion;
                if error > worst.0 {
                    worst = (error, tank, run.time_s[row]);
                }
            }
        }
        for i in 0..4 {
            for (kind, expected) in [
                (EventKind::Overflow { tank: i }, end.first_overflow[i]),
                (EventKind::Empty { tank: i }, end.first_empty[i]),
            ] {
                let found = run.events.iter().find(|event| event.kind == kind).map(|event| event.time_s);
                assert_eq!(found.is_some(), expected.is_some(), "{name}: {kind:?} at {found:?}, not {expected:?}");
                if let (Some(found), Some((expected, slope))) = (found, expected) {
                    assert_abs_diff_eq!(found, expected, epsilon = TIME_BAR + BAR * excursion / slope);
                }
            }
        }
        let (error, tank, time) = worst;
        assert!(error <= BAR, "{name}: {error:.1e} of {excursion:.3} m in tank {} at {time} s", tank + 1);
        end
    }
}

fn johansson(valves: [f64; 2], heights: [f64; 4]) -> QuadrupleTank {
    with_heights(PresetId::JohanssonMinimumPhase.preset().plant.with_valves(valves), heights)
}

fn with_heights(mut plant: QuadrupleTank, heights: [f64; 4]) -> QuadrupleTank {
    for (tank, height) in plant.tanks.iter_mut().zip(heights) {
        tank.height = height;
    }
    plant
}

#[test]
fn two_full_upper_tanks_pass_on_what_drains_at_their_walls() {
    // Johansson's P+ with low upper walls, three tenths of the water going down directly.
    let plant = PresetId::JohanssonNonMinimumPhase.preset().plant.with_valves([0.3, 0.3]);
    let plant = with_heights(plant, [1.0, 1.0, 0.1, 0.1]);
    let levels = plant.free_equilibrium([5.0, 5.0]).levels;
    let set = OpenLoop::new(&plant, levels, [5.0, 5.0], 6000.0);
    // All digits that the case of the issue prints.
    let printed = [0.217_150, 0.261_827];
    for sampling_time_s in SAMPLING_TIMES {
        let run = set.run(sampling_time_s);
        for (i, printed) in printed.into_iter().enumerate() {
            let pumped = plant.valves[i] * plant.pumps[i].gain * 5.0;
            let above = plant.tanks[i + 2].outflow(0.1, plant.gravity);
            let expected = plant.tanks[i].level_for_outflow(pumped + above, plant.gravity);
            assert_abs_diff_eq!(*run.levels[i].last().unwrap(), expected, epsilon = BAR * expected);
            assert_abs_diff_eq!(expected, printed, epsilon = 5e-7);
            assert!(run.levels[i + 2].iter().all(|&h| h == 0.1));
            assert!(run.events.iter().any(|e| e.kind == EventKind::Overflow { tank: i + 2 } && e.time_s == 0.0));
        }
        set.check(&format!("both upper full, {sampling_time_s} s"), sampling_time_s);
    }
}

#[test]
fn an_upper_tank_is_full_while_more_comes_in_than_drains() {
    let plant = johansson([0.3, 0.3], [1.0, 1.0, 0.12, 0.08]);
    let start = plant.free_equilibrium([2.5, 2.5]).levels;
    let more = [7e-6, 8e-6];
    let set = OpenLoop::new(&plant, start, [2.5, 2.5], 1500.0)
        .pump_flow(103.3, more)
        .pump_flow(703.7, more.map(|flow| -0.8 * flow))
        .leak(300.05, 2, 3e-6)
        .leak(450.25, 3, 1e-6);
    for sampling_time_s in SAMPLING_TIMES {
        let end = set.check(&format!("full for a time, {sampling_time_s} s"), sampling_time_s);
        assert!(end.overflow[2] > 0.0 && end.overflow[3] > 0.0);
    }
}

#[test]
fn a_full_lower_tank_loses_what_it_does_not_drain() {
    let plant = johansson([0.4, 0.4], [0.1, 0.15, 0.5, 0.5]);
    let start = plant.free_equilibrium([2.0, 2.0]).levels;
    let set = OpenLoop::new(&plant, start, [2.0, 2.0], 1500.0)
        .pump_flow(50.5, [4e-6, 5e-6])
        .leak(300.05, 0, 2e-6)
        .pump_flow(600.7, [-6e-6, -8e-6])
        .leak(640.0, 1, 1e-6);
    for sampling_time_s in SAMPLING_TIMES {
        let end = set.check(&format!("lower full, {sampling_time_s} s"), sampling_time_s);
        assert!(end.overflow[0] > 0.0 && end.overflow[1] > 0.0);
    }
}

#[test]
fn a_level_that_only_touches_its_wall_between_two_rows_loses_water() {
    // Tank 1 rises on the water of tank 3, with its pump shut, and falls again: the walls are at several shares of the peak.
    let plant = |height: f64| johansson([0.7, 0.6], [height, 1.0, 1.0, 1.0]);
    let set = |height: f64| OpenLoop::new(&plant(height), [0.02, 0.0, 0.3, 0.0], [0.0; 2], 400.0);
    let free = set(1.0).run(0.1);
    let peak = free.levels[0].iter().copied().fold(0.0, f64::max);
    for share in [0.9, 0.99, 0.999, 0.9999, 0.99999] {
        for sampling_time_s in [1.0, 10.0, 60.0] {
            let end = set(share * peak).check(&format!("touch {share}, {sampling_time_s} s"), sampling_time_s);
            assert!(end.overflow[0] > 0.0);
        }
    }
}

#[test]
fn a_tank_runs_dry_and_fills_again() {
    for id in [PresetId::JohanssonMinimumPhase, PresetId::CocotaMinimumPhase, PresetId::JunqueiraA] {
        let plant = with_heights(id.preset().plant, [1.0; 4]);
        let voltage = id.preset().pump_voltage;
        let start = plant.free_equilibrium(voltage).levels;
        let flow = [0, 1].map(|i| plant.pumps[i].gain * voltage[i]);
        let set = OpenLoop::new(&plant, start, voltage, 2400.0)
            .pump_flow(20.3, flow.map(|q| -q))
            .pump_flow(800.9, flow)
            .pump_flow(1000.0, flow.map(|q| -0.3 * q));
        for sampling_time_s in SAMPLING_TIMES {
            set.check(&format!("dry and refilled, {id:?}, {sampling_time_s} s"), sampling_time_s);
        }
    }
}

#[test]
fn an_empty_plant_fills() {
    for id in [PresetId::JohanssonMinimumPhase, PresetId::CocotaMinimumPhase, PresetId::JunqueiraA] {
        let plant = with_heights(id.preset().plant, [1.0; 4]);
        let set = OpenLoop::new(&plant, [0.0; 4], id.preset().pump_voltage, 1200.0);
        for sampling_time_s in SAMPLING_TIMES {
            set.check(&format!("from empty, {id:?}, {sampling_time_s} s"), sampling_time_s);
        }
    }
}

#[test]
fn trapezoidal_tanks_have_walls_too() {
    let preset = PresetId::CocotaMinimumPhase.preset();
    let start = preset.plant.free_equilibrium(preset.pump_voltage).levels;
    let flow = [0, 1].map(|i| preset.plant.pumps[i].gain * preset.pump_voltage[i]);
    let heights = [1.1 * start[0], 1.05 * start[1], 1.2 * start[2], 1.1 * start[3]];
    let set = OpenLoop::new(&with_heights(preset.plant, heights), start, preset.pump_voltage, 3000.0)
        .pump_flow(33.3, flow.map(|q| 0.3 * q))
        .leak(900.0, 3, 1e-6)
        .pump_flow(1500.5, flow.map(|q| -1.3 * q))
        .pump_flow(2400.2, flow.map(|q| 1.2 * q));
    for sampling_time_s in SAMPLING_TIMES {
        let end = set.check(&format!("trapezoids, {sampling_time_s} s"), sampling_time_s);
        assert!(end.overflow.iter().all(|&v| v > 0.0));
    }
}

#[test]
fn a_closed_loop_drives_a_tank_over_its_wall() {
    // Cocota's P+ with the pairing that does not work: tank 4 is full from about 1250 s on.
    let preset = PresetId::CocotaNonMinimumPhase.preset();
    let op = preset.plant.free_equilibrium(preset.pump_voltage);
    let pi = PiSettings {
        gain: 1.5,
        integral_time_s: 110.0,
        set_point_weight: 1.0,
        anti_windup: AntiWindup::BackCalculation { tracking_ratio: 0.5 },
        mode: LoopMode::Automatic,
    };
    let law = DecentralisedPi { pairing: Pairing::Diagonal, loops: [pi; 2], sampling_time_s: 1.0 };
    let size = 0.05 * op.levels[0];
    let experiment = Experiment {
        duration_s: 3000.0,
        set_point_steps: vec![SetPointStep { level: 0, time_s: 100.0, size }],
        load_steps: vec![],
        measurement: Measurement { noise_std: 0.0, seed: 1, quantised: false },
    };
    let run = simulate(&preset.plant, &op, &law, &experiment);
    let mut reference = Reference::new(&preset.plant, op.levels);
    for row in 0..run.time_s.len() - 1 {
        let flows = pumped(&preset.plant, [0, 1].map(|i| run.pump_voltage[i][row]), [0.0; 2]);
        reference.run_until(run.time_s[row + 1], |_| flows, &[0.0; 4]);
        for (column, expected) in run.levels.iter().zip(reference.levels) {
            assert_abs_diff_eq!(column[row + 1], expected, epsilon = BAR * size);
        }
    }
    assert!(reference.overflow.iter().any(|&volume| volume > 0.0));
}

/// A pump that gives just what its full tank drains, and a little more or less.
#[test]
fn nothing_chatters_where_the_inflow_is_just_what_drains_at_the_wall() {
    for share in [1.0, 1.0 - 1e-15, 1.0 + 1e-15, 1.0 - 1e-9, 1.0 + 1e-9] {
        let mut plant = johansson([0.3, 0.3], [1.0; 4]);
        let voltage = [4.0, 4.5];
        let levels = plant.free_equilibrium(voltage).levels;
        plant = with_heights(plant, [levels[0], 1.0, share * levels[2], share * levels[3]]);
        let set = OpenLoop::new(&plant, levels, voltage, 3000.0);
        for sampling_time_s in SAMPLING_TIMES {
            let run = set.run(sampling_time_s);
            let (rows, _) = set.reference(&set.standing_valves(), &[3000.0]);
            let last = run.time_s.len() - 1;
            for i in 0..4 {
                assert_abs_diff_eq!(run.levels[i][last], rows[0][i], epsilon = 1e-12);
                assert!(run.levels[i].iter().all(|h| (h - levels[i]).abs() <= 2e-9 * levels[i]));
            }
        }
    }
}

#[test]
fn a_moving_valve_passes_through_the_wall() {
    let preset = PresetId::JunqueiraA.preset();
    let ramp = |from, to| ValveSchedule::Ramp { from, to, begin_s: 100.2, end_s: 500.7 };
    let sine = |mean, frequency| ValveSchedule::Sine { mean, amplitude: 0.25, frequency, phase: 0.3 };
    let step = ValveSchedule::Step { from: 0.7, to: 0.3, at_s: 300.3 };
    let slow = 2.0 * std::f64::consts::PI / 400.0;
    for (name, valves) in [
        ("ramps", [ramp(0.7, 0.3), ramp(0.65, 0.25)]),
        ("up and down", [ramp(0.3, 0.8), ramp(0.8, 0.2)]),
        ("slow sines", [sine(0.5, slow), sine(0.55, 1.3 * slow)]),
        ("quick sines", [sine(0.5, 0.2), sine(0.45, 0.3)]),
        ("a step and a sine", [step, sine(0.5, 0.05)]),
    ] {
        let plant = preset.plant.with_valves(valves.map(|valve| valve.at(0.0)));
        let levels = plant.free_equilibrium(preset.pump_voltage).levels;
        let middle = plant.with_valves([0.5, 0.5]).free_equilibrium(preset.pump_voltage).levels;
        let heights = [1.1 * middle[0], 1.0, 1.05 * middle[2], 1.02 * middle[3]];
        let set = OpenLoop::new(&with_heights(plant, heights), levels, preset.pump_voltage, 1200.0);
        for sampling_time_s in SAMPLING_TIMES {
            let run = set.run_with(&valves, sampling_time_s);
            let end = set.compare(&format!("{name}, {sampling_time_s} s"), &valves, &run);
            assert!(end.overflow[2] > 0.0 && end.overflow[3] > 0.0);
        }
    }
}

#[test]
fn a_valve_that_shuts_for_a_moment_leaves_its_tank_almost_dry() {
    let preset = PresetId::JunqueiraA.preset();
    let sine = ValveSchedule::Sine { mean: 0.5, amplitude: 0.5, frequency: 0.05, phase: 0.0 };
    let valves = [sine, ValveSchedule::Ramp { from: 0.6, to: 1.0, begin_s: 50.0, end_s: 120.0 }];
    let plant = preset.plant.with_valves(valves.map(|valve| valve.at(0.0)));
    let set = OpenLoop::new(&with_heights(plant, [1.0; 4]), [0.0; 4], preset.pump_voltage, 800.0);
    for sampling_time_s in SAMPLING_TIMES {
        let run = set.run_with(&valves, sampling_time_s);
        set.compare(&format!("a valve that shuts, {sampling_time_s} s"), &valves, &run);
    }
}

/// A long stretch of time at once, and the same in uneven pieces.
#[test]
fn a_plant_that_is_advanced_piece_by_piece_goes_where_one_long_step_leads() {
    let preset = PresetId::JohanssonMinimumPhase.preset();
    let plant = with_heights(preset.plant.with_valves([0.3, 0.3]), [0.3, 0.14, 0.1, 0.08]);
    let op = plant.free_equilibrium([2.0, 2.0]);
    let mut at_once = HeldTank::new(&plant, &op, Pairing::Diagonal);
    let mut in_pieces = at_once.clone();
    let mut reference = Reference::new(&plant, op.levels);
    for (inputs, duration) in [([4.0, 3.0], 500.0), ([-2.0, 1.0], 90.0), ([-2.0, -2.0], 700.0), ([3.0, 0.0], 40.0)] {
        at_once.set_inputs(inputs);
        in_pieces.set_inputs(inputs);
        at_once.advance(duration);
        let frames = [0.016, 0.02, 0.7, 0.017, 3.1];
        let mut left = duration;
        for frame in frames.into_iter().cycle() {
            in_pieces.advance(f64::min(frame, left));
            left -= frame;
            if left <= 0.0 {
                break;
            }
        }
        let flows = pumped(&plant, [0, 1].map(|i| op.pump_voltage[i] + inputs[i]), [0.0; 2]);
        reference.run_until(reference.time + duration, |_| flows, &[0.0; 4]);
        for i in 0..4 {
            // 1e-6 of a tank of 0.3 m.
            assert_abs_diff_eq!(at_once.levels()[i], reference.levels[i], epsilon = 3e-7);
            assert_abs_diff_eq!(in_pieces.levels()[i], reference.levels[i], epsilon = 3e-7);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn random_rigs_keep_the_bar_at_their_walls(set in open_loops(), sampling_time_s in prop_oneof![0.5..2.0, 2.0..60.0]) {
        set.check("random", sampling_time_s);
    }
}

/// Not almost shut: the explicit steps of the reference would be too short.
fn valve() -> impl Strategy<Value = f64> {
    prop_oneof![8 => 0.05..0.95, 1 => Just(0.0), 1 => Just(1.0)]
}

prop_compose! {
    /// Rigs of a laboratory with tanks of any shape, walls about their levels at rest, pumps that change three times.
    fn open_loops()(
        id in prop::sample::select(&PresetId::ALL),
        valves in [valve(), valve()],
        voltage in [1.0..8.0, 1.0..8.0],
        slopes in [0.0..0.05, 0.0..0.05, 0.0..0.05, 0.0..0.05_f64],
        heights in [0.5..1.5, 0.5..1.5, 0.5..1.5, 0.5..1.5],
        changes in [(10.0..500.0, [0.0..2.0, 0.0..2.0]), (600.0..1200.0, [0.0..2.0, 0.0..2.0])],
        leak in (0.0..1500.0, 0..4_usize, 0.0..5e-6),
        duration_s in prop_oneof![1500.0..3000.0, Just(15_000.0)],
    ) -> OpenLoop {
        let mut plant = id.preset().plant.with_valves(valves);
        for (tank, slope) in plant.tanks.iter_mut().zip(slopes) {
            tank.section.area_slope += slope;
        }
        let levels = plant.free_equilibrium(voltage).levels;
        plant = with_heights(plant, std::array::from_fn(|i| f64::max(heights[i] * levels[i], 0.01)));
        let mut set = OpenLoop::new(&plant, levels, voltage, duration_s).leak(leak.0, leak.1, leak.2);
        let mut now = [1.0; 2];
        for (time_s, shares) in changes {
            // Shares below one half shut the pump.
            let shares = shares.map(|share: f64| if share < 0.5 { 0.0 } else { share });
            set = set.pump_flow(time_s, [0, 1].map(|i| (shares[i] - now[i]) * plant.pumps[i].gain * voltage[i]));
            now = shares;
        }
        set
    }
}
