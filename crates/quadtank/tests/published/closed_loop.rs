//! Figures that Cocota (2009) publishes, or that follow from his experiments, about the running plant: §3.6 open loop,
//! §4.2 decentralised PI. Tolerances are half a unit of the last printed digit unless they say otherwise.

use quadtank::control::{AntiWindup, DecentralisedPi, LoopMode, Pairing, PiSettings, closed_loop};
use quadtank::linear::Stability;
use quadtank::literature::PresetId;
use quadtank::plant::{OperatingPoint, QuadrupleTank};
use quadtank::sim::{
    EventKind, Experiment, Load, LoadStep, LoopMetrics, SetPointStep, Settling, Trajectory, loop_metrics, simulate,
    simulate_linear,
};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

struct Rig {
    plant: QuadrupleTank,
    op: OperatingPoint,
}

impl Rig {
    fn new(id: PresetId) -> Self {
        let preset = id.preset();
        let op = preset.plant.free_equilibrium(preset.pump_voltage);
        Self { plant: preset.plant, op }
    }

    fn minimum_phase() -> Self {
        Self::new(PresetId::CocotaMinimumPhase)
    }

    fn non_minimum_phase() -> Self {
        Self::new(PresetId::CocotaNonMinimumPhase)
    }

    /// A step of 5 % of the operating level.
    fn step(&self, level: usize, time_s: f64) -> SetPointStep {
        SetPointStep { level, time_s, size: 0.05 * self.op.levels[level] }
    }

    fn metrics(&self, law: &DecentralisedPi, experiment: &Experiment) -> [LoopMetrics; 2] {
        loop_metrics(&simulate(&self.plant, &self.op, law, experiment), &self.plant, law, experiment)
    }
}

/// The published settings by pump, Tt = Ti/2, one sample per second.
fn law(pairing: Pairing, gains: [f64; 2], integral_times: [f64; 2]) -> DecentralisedPi {
    let of_pump = |j: usize| PiSettings {
        gain: gains[j],
        integral_time_s: integral_times[j],
        set_point_weight: 1.0,
        anti_windup: AntiWindup::BackCalculation { tracking_ratio: 0.5 },
        mode: LoopMode::Automatic,
    };
    DecentralisedPi { pairing, loops: pairing.by_loop([of_pump(0), of_pump(1)]), sampling_time_s: 1.0 }
}

fn minimum_phase_law() -> DecentralisedPi {
    law(Pairing::Diagonal, [1.0, 1.0], [32.0, 32.0])
}

fn non_minimum_phase_law() -> DecentralisedPi {
    law(Pairing::Swapped, [1.75, 1.39], [365.0, 380.0])
}

fn experiment(duration_s: f64, set_point_steps: Vec<SetPointStep>) -> Experiment {
    Experiment { set_point_steps, ..Experiment::at_rest(duration_s) }
}

/// Both loops in manual mode at the operating point; +10 % of the flow of pump 1 at 250 s, then of pump 2. A load on the
/// flow ahead of the valve is the same as a step of the pump voltage.
fn open_loop(rig: &Rig, second_step_s: f64, duration_s: f64) -> [Trajectory; 2] {
    let Rig { plant, op } = rig;
    let mut law = minimum_phase_law();
    for (i, settings) in law.loops.iter_mut().enumerate() {
        let output = op.pump_voltage[i] / plant.power_gain;
        settings.mode = LoopMode::Manual { output, until_s: f64::INFINITY };
    }
    let more = |pump: usize, time_s| LoadStep {
        time_s,
        load: Load::PumpFlow { pump, flow: 0.1 * plant.pumps[pump].gain * op.pump_voltage[pump] },
    };
    let experiment =
        Experiment { load_steps: vec![more(0, 250.0), more(1, second_step_s)], ..experiment(duration_s, vec![]) };
    let jacobian = plant.linearise(op);
    [simulate(plant, op, &law, &experiment), simulate_linear(plant, op, &jacobian, &law, &experiment)]
}

/// Levels 1 and 2 of the row at `time` (mm).
fn levels_mm(trajectory: &Trajectory, time: f64) -> [f64; 2] {
    let row = trajectory.time_s.iter().position(|&t| (t - time).abs() < 1e-6).unwrap();
    [0, 1].map(|i| 1e3 * trajectory.levels[i][row])
}

#[track_caller]
fn assert_levels(actual: [f64; 2], printed: [f64; 2]) {
    for (actual, printed) in actual.into_iter().zip(printed) {
        assert!((actual - printed).abs() <= 0.005, "{actual} instead of {printed} mm");
    }
}

#[test]
fn ten_percent_of_the_inputs_move_the_minimum_phase_levels_as_in_figure_3_8() {
    let [nonlinear, linear] = open_loop(&Rig::minimum_phase(), 1000.0, 1750.0);
    assert_levels(levels_mm(&nonlinear, 1000.0), [181.38, 160.42]);
    assert_levels(levels_mm(&linear, 1000.0), [180.48, 160.33]);
    assert_levels(levels_mm(&nonlinear, 1750.0), [189.62, 184.48]);
    assert_levels(levels_mm(&linear, 1750.0), [188.06, 182.97]);
}

#[test]
fn ten_percent_of_the_inputs_move_the_non_minimum_phase_levels_as_in_figure_3_9() {
    let [nonlinear, linear] = open_loop(&Rig::non_minimum_phase(), 2250.0, 4250.0);
    assert_levels(levels_mm(&nonlinear, 2250.0), [170.25, 176.64]);
    assert_levels(levels_mm(&linear, 2250.0), [169.95, 176.12]);
    assert_levels(levels_mm(&nonlinear, 4250.0), [189.03, 191.00]);
    assert_levels(levels_mm(&linear, 4250.0), [187.47, 189.43]);
}

fn settling_s(settling: Option<Settling>) -> f64 {
    match settling {
        Some(Settling::After { time_s }) => time_s,
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_minimum_phase_loops_overshoot_and_settle_as_in_figure_4_7() {
    let rig = Rig::minimum_phase();
    let experiment = experiment(1750.0, vec![rig.step(0, 250.0), rig.step(1, 1000.0)]);
    let [first, second] = rig.metrics(&minimum_phase_law(), &experiment);
    assert!((first.overshoot.unwrap() - 0.099).abs() <= 0.0005);
    assert!((second.overshoot.unwrap() - 0.087).abs() <= 0.0005);
    // Whole samples in the source, interpolated here.
    assert!((settling_s(first.settling_2_percent) - 255.0).abs() <= 1.0);
    assert!((settling_s(second.settling_2_percent) - 258.0).abs() <= 1.0);
    // "At most 9 % of the step".
    assert!(first.other_peak <= 0.09 * 0.05 * rig.op.levels[0]);
    assert!(second.other_peak <= 0.09 * 0.05 * rig.op.levels[1]);
}

#[test]
fn the_non_minimum_phase_loops_are_ten_times_slower_and_fight() {
    let rig = Rig::non_minimum_phase();
    // Reference 2 moves when loop 1 has settled.
    let experiment = experiment(9000.0, vec![rig.step(0, 250.0), rig.step(1, 5000.0)]);
    let [first, second] = rig.metrics(&non_minimum_phase_law(), &experiment);
    // "About 3230 s" and "about 2620 s", printed to tens.
    assert!((settling_s(first.settling_2_percent) - 3230.0).abs() <= 10.0);
    assert!((settling_s(second.settling_2_percent) - 2620.0).abs() <= 10.0);
    assert_eq!((first.overshoot, second.overshoot), (Some(0.0), Some(0.0)));
    let crossed = |metrics: &LoopMetrics, level: usize| metrics.other_peak / (0.05 * rig.op.levels[level]);
    assert!((crossed(&first, 0) - 0.76).abs() <= 0.005);
    assert!((crossed(&second, 1) - 1.06).abs() <= 0.005);
    assert!(first.undershoot.unwrap() > 0.0, "a non-minimum-phase level goes the wrong way first");
}

#[test]
fn the_diagonal_pairing_of_the_non_minimum_phase_plant_diverges_until_a_pump_saturates() {
    let rig = Rig::non_minimum_phase();
    let jacobian = rig.plant.linearise(&rig.op);
    for integral_time_s in [32.0, 365.0, 3000.0] {
        let law = law(Pairing::Diagonal, [1.0, 1.0], [integral_time_s; 2]);
        assert_eq!(closed_loop(&jacobian, &law, rig.plant.power_gain).unwrap().stability, Stability::Unstable);
        let experiment = experiment(60_000.0, vec![rig.step(0, 250.0)]);
        let run = simulate(&rig.plant, &rig.op, &law, &experiment);
        let saturated = run.events.iter().find(|event| matches!(event.kind, EventKind::Saturated { .. }));
        assert!(saturated.is_some(), "Ti = {integral_time_s} s: {:?}", run.events);
    }
}

#[test]
fn the_published_loops_are_stable() {
    for (rig, law) in [(Rig::minimum_phase(), minimum_phase_law()), (Rig::non_minimum_phase(), non_minimum_phase_law())]
    {
        let closed = closed_loop(&rig.plant.linearise(&rig.op), &law, rig.plant.power_gain).unwrap();
        assert_eq!(closed.stability, Stability::Stable);
        assert_eq!(closed.poles_z.len(), 6);
    }
}
