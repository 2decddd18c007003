use approx::assert_relative_eq;

use super::*;
use crate::control::ParallelPid;
use crate::linear::{SignalPath, TransferFunction};

fn single(element: TransferFunction) -> DelayedPlant {
    DelayedPlant::new(&[SignalPath { input: 0, output: 0, element }]).unwrap()
}

fn relay_loop(relay: Relay, duration: f64, step: f64) -> TwoLoops {
    let controllers = PidMatrix::default();
    TwoLoops { relays: [Some(relay), None], controllers, references: [0.0; 2], release: 0.0, duration, step }
}

#[test]
fn an_integrator_with_dead_time_swings_as_by_hand() {
    // y' = u(t − θ): a triangle of period 4 θ and amplitude d θ.
    let theta = 0.7;
    let mut plant = single(TransferFunction::new(vec![1.0], vec![0.0, 1.0], theta).unwrap());
    let trace = run_two_loops(&mut plant, &relay_loop(Relay::ideal(2.0, 1.0), 30.0, 0.13));
    assert_eq!(trace.halt, None);
    let times: Vec<f64> = trace.switches[0].iter().map(|&(time, _)| time).collect();
    // Up to the first switch y rises from 0 at θ; it stands at exactly 0 until then.
    for pair in times[1..].windows(2) {
        assert_relative_eq!(pair[1] - pair[0], 2.0 * theta, max_relative = 1e-12);
    }
    let peak = trace.outputs[0].iter().copied().fold(0.0, f64::max);
    assert_relative_eq!(peak, 2.0 * theta, max_relative = 1e-12);
}

#[test]
fn a_relay_on_a_lag_chatters_and_hysteresis_cures_it() {
    let lag = || single(TransferFunction::lags(1.0, &[3.0], 0.0).unwrap());
    let ideal = Relay::ideal(1.0, 1.0);
    let trace = run_two_loops(&mut lag(), &relay_loop(ideal, 10.0, 0.1));
    assert!(matches!(trace.halt, Some(Halt::Chattering { relay: 0, .. })));
    let trace = run_two_loops(&mut lag(), &relay_loop(Relay { hysteresis: 0.5, ..ideal }, 50.0, 0.1));
    assert_eq!(trace.halt, None);
    // From −0.5 to 0.5 with the end value 1: T ln 3.
    let times: Vec<f64> = trace.switches[0].iter().map(|&(time, _)| time).collect();
    for pair in times[1..].windows(2) {
        assert_relative_eq!(pair[1] - pair[0], 3.0 * 3.0_f64.ln(), max_relative = 1e-11);
    }
}

#[test]
fn a_reversed_relay_swings_a_plant_with_negative_gain() {
    let plant = |gain: f64| single(TransferFunction::lags(gain, &[1.0], 0.5).unwrap());
    let one = run_two_loops(&mut plant(2.0), &relay_loop(Relay::ideal(1.0, 2.0), 20.0, 0.1));
    let other = run_two_loops(&mut plant(-2.0), &relay_loop(Relay::ideal(1.0, -2.0), 20.0, 0.1));
    assert_eq!(one.switches, other.switches);
    assert_eq!(one.outputs, other.outputs);
}

#[test]
fn a_pi_loop_reaches_its_reference_and_a_wrong_sign_diverges() {
    let pid = |proportional, integral| ParallelPid { proportional, integral, ..ParallelPid::default() };
    let run = |first| {
        let controllers = PidMatrix::decentralised([first, ParallelPid::default()]);
        let loops = TwoLoops {
            controllers,
            references: [1.0, 0.0],
            duration: 200.0,
            step: 0.05,
            relays: [None; 2],
            release: 0.0,
        };
        run_two_loops(&mut single(TransferFunction::lags(2.0, &[5.0], 1.0).unwrap()), &loops)
    };
    let trace = run(pid(0.8, 0.15));
    assert_eq!(trace.halt, None);
    assert_relative_eq!(*trace.outputs[0].last().unwrap(), 1.0, epsilon = 1e-9);
    assert!(matches!(run(pid(-2.0, -0.5)).halt, Some(Halt::Diverged { .. })));
}

#[test]
fn a_step_that_is_none_ends_with_a_full_record() {
    for step in [0.0, -1.0] {
        let mut plant = single(TransferFunction::lags(1.0, &[3.0], 0.5).unwrap());
        let trace = run_two_loops(&mut plant, &relay_loop(Relay::ideal(1.0, 1.0), 10.0, step));
        assert_eq!((trace.halt, trace.time.len()), (Some(Halt::Full { time: 0.0 }), MAX_ROWS + 1));
    }
}

#[test]
fn no_switch_of_a_quick_resonance_is_passed_over() {
    // A quick resonance behind a slow lag, whose mean time constant is far longer than the period of the resonance.
    let element = TransferFunction::lags(1.0, &[100.0], 0.0).unwrap();
    let element = element.times(&TransferFunction::new(vec![1.0], vec![1.0, 2e-4, 1e-4], 0.0).unwrap());
    let relay = Relay { hysteresis: 1e-4, ..Relay::ideal(1.0, 1.0) };
    let switches = |step: f64| run_two_loops(&mut single(element.clone()), &relay_loop(relay, 2.0, step)).switches;
    let (coarse, fine) = (switches(2.0), switches(1e-3));
    assert!(fine[0].len() > 20, "{fine:?}");
    assert_eq!(coarse[0].len(), fine[0].len());
    for (one, other) in coarse[0].iter().zip(&fine[0]) {
        assert_relative_eq!(one.0, other.0, epsilon = 1e-9);
    }
}
