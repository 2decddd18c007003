//! Relay tests of Campestrini (2006): exact limit cycles (§2.4.2), simulated tests against them, and what simultaneous
//! relays find of the critical curve. The thesis prints curves only; the numbers were recomputed by an independent program.

use approx::assert_relative_eq;
use quadtank::control::Relay;
use quadtank::linear::{Complex, TransferFunction};
use quadtank::literature::campestrini::PublishedPlant;
use quadtank::tuning::{
    CriticalSearch, CurveDistance, LimitCycle, RelayTest, RelayVerdict, TestTime, TuningError, TuningRule,
    distance_from_curve, frequency_range, independent_tuning, limit_cycles, modulus_estimator, read_relay_test,
    sequential_tuning, simultaneous_test, sine_test, single_loop_test, with_integrator,
};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

/// Plants of the exact test: 1/(s+1)³, 1/(s+1)⁴, and both diagonal elements of Process II.
fn plants() -> [TransferFunction; 4] {
    let process_two = PublishedPlant::ProcessTwo.transfer_matrix().unwrap().0;
    let [[g11, _], [_, g22]] = process_two;
    let lags = |n: usize| TransferFunction::lags(1.0, &vec![1.0; n], 0.0).unwrap();
    [lags(3), lags(4), g11, g22]
}

fn only_cycle(plant: &TransferFunction) -> LimitCycle {
    let mut cycles = limit_cycles(plant, 0.01, 100.0).unwrap();
    assert_eq!(cycles.len(), 1);
    cycles.remove(0)
}

#[test]
fn exact_limit_cycles_of_delay_free_loops() {
    // Period and peak to half a unit of the fifth decimal, gains and multipliers to that of their last digit.
    let expected = [
        (3.67975, 0.16306, 7.808, 7.748, [0.384, 0.0104]),
        (6.32733, 0.32410, 3.929, 3.945, [0.239, 0.0075]),
        (0.89585, 0.14432, 8.822, 8.855, [0.243, 0.0050]),
        (1.33109, 0.57176, 2.227, 2.234, [0.246, 0.0023]),
    ];
    for (plant, (period, amplitude, by_peak, by_harmonic, multipliers)) in plants().iter().zip(expected) {
        let cycle = only_cycle(plant);
        assert_relative_eq!(cycle.period, period, epsilon = 5.1e-6);
        assert_relative_eq!(cycle.amplitude, amplitude, epsilon = 5.1e-6);
        assert_relative_eq!(cycle.gain_by_peak(), by_peak, epsilon = 5.1e-4);
        assert_relative_eq!(cycle.gain_by_first_harmonic(plant), by_harmonic, epsilon = 5.1e-4);
        assert_relative_eq!(cycle.multipliers[0].norm(), multipliers[0], epsilon = 5.1e-4);
        assert_relative_eq!(cycle.multipliers[1].norm(), multipliers[1], epsilon = 5.1e-5);
        assert!(cycle.multipliers.last().unwrap().norm() < 1e-6);
        assert!(cycle.is_stable());
    }
}

fn ratio_test(plant: PublishedPlant, ratio: f64, duration: f64, step: f64) -> RelayTest {
    simultaneous_test(
        &plant.transfer_matrix().unwrap(),
        [1.0, ratio],
        TestTime { duration, release: 0.01 * duration, step },
    )
    .unwrap()
}

/// Excess over the critical curve in its own direction, by peaks and by first harmonics.
fn excess(plant: PublishedPlant, test: &RelayTest) -> [CurveDistance; 2] {
    let transfer = plant.transfer_matrix().unwrap();
    let (lowest, highest) = frequency_range(&transfer).unwrap();
    let search = CriticalSearch::new(&transfer, lowest, highest);
    let oscillation = test.reading.oscillation.unwrap();
    [oscillation.gains_by_peak(), oscillation.gains_by_harmonic()]
        .map(|gains| distance_from_curve(&search, gains.unwrap(), oscillation.period).unwrap())
}

#[test]
fn a_simulated_test_agrees_with_the_exact_limit_cycle() {
    for plant in plants() {
        let cycle = only_cycle(&plant);
        let duration = 40.0 * cycle.period;
        let time = TestTime { duration, release: 0.01 * duration, step: cycle.period / 200.0 };
        let test = single_loop_test(&plant, Relay::ideal(3.0, 1.0), time).unwrap();
        assert_eq!(test.reading.verdict, RelayVerdict::Unimodal);
        let found = test.reading.oscillation.unwrap();
        // The bar is 0.1 %.
        assert_relative_eq!(found.period, cycle.period, max_relative = 1e-6);
        assert_relative_eq!(found.loops[0].amplitude, 3.0 * cycle.amplitude, max_relative = 2e-4);
        assert_relative_eq!(found.loops[0].gain_by_peak.unwrap(), cycle.gain_by_peak(), max_relative = 2e-4);
        let by_harmonic = cycle.gain_by_first_harmonic(&plant);
        assert_relative_eq!(found.loops[0].gain_by_harmonic.unwrap(), by_harmonic, max_relative = 2e-4);
    }
}

#[test]
fn simultaneous_relays_on_process_two_are_unimodal_and_near_the_curve() {
    for ratio in [20.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.02] {
        let test = ratio_test(PublishedPlant::ProcessTwo, ratio, 150.0, 0.005);
        assert_eq!(test.reading.verdict, RelayVerdict::Unimodal, "{ratio}");
        assert!(test.reading.oscillation.unwrap().is_proportional(), "{ratio}");
        let [_, by_harmonic] = excess(PublishedPlant::ProcessTwo, &test);
        assert!(by_harmonic.same_branch && by_harmonic.excess.abs() <= 0.03, "{ratio}: {by_harmonic:?}");
    }
}

#[test]
fn simultaneous_relays_on_wood_and_berry() {
    let plant = PublishedPlant::WoodBerry;
    let test = |ratio: f64| ratio_test(plant, ratio, 1500.0, 0.05);
    // Peaks lie 7 to 20 % inside the curve, first harmonics within 3 %.
    for ratio in [20.0, 10.0, 5.0, 2.0, 1.0, 0.05, 0.02] {
        let test = test(ratio);
        assert_eq!(test.reading.verdict, RelayVerdict::Unimodal, "{ratio}");
        assert!(test.reading.oscillation.unwrap().is_proportional(), "{ratio}");
        let [by_peak, by_harmonic] = excess(plant, &test);
        assert!((-0.20..=-0.07).contains(&by_peak.excess), "{ratio}: {by_peak:?}");
        assert!(by_harmonic.same_branch && by_harmonic.excess.abs() <= 0.03, "{ratio}: {by_harmonic:?}");
    }
    // In the non-convex stretch the oscillation is multimodal or none at all.
    for ratio in [0.6, 0.5, 0.4, 0.3, 0.2, 0.15] {
        let verdict = test(ratio).reading.verdict;
        assert!(matches!(verdict, RelayVerdict::Multimodal { .. } | RelayVerdict::NotPeriodic), "{ratio}: {verdict:?}");
    }
    // Near it the relay of loop 1 is no proportional loop any more, which the angle tells.
    let near = test(0.7);
    assert_eq!(near.reading.verdict, RelayVerdict::Unimodal);
    assert!(!near.reading.oscillation.unwrap().is_proportional());
    // Locked on the quick branch: unimodal, and yet far outside the stable gains.
    let locked = test(0.1);
    assert_eq!(locked.reading.verdict, RelayVerdict::Unimodal);
    assert_relative_eq!(locked.reading.oscillation.unwrap().period, 3.94, epsilon = 0.01);
    let [_, by_harmonic] = excess(plant, &locked);
    assert!(!by_harmonic.same_branch && by_harmonic.excess > 0.3);
}

#[test]
fn relays_that_act_the_wrong_way_are_refused_or_told() {
    let plant = PublishedPlant::WoodBerry.transfer_matrix().unwrap();
    let time = TestTime { duration: 100.0, release: 1.0, step: 0.1 };
    let refused = simultaneous_test(&plant, [0.0, 1.0], time);
    assert_eq!(refused.err(), Some(TuningError::OutOfRange { field: "amplitude", value: 0.0 }));
    // A hysteresis that no output reaches.
    let wide = Relay { hysteresis: 100.0, ..Relay::ideal(1.0, 1.0) };
    let test = single_loop_test(&plant.0[0][0], wide, time).unwrap();
    assert_eq!(test.reading.verdict, RelayVerdict::NoOscillation);
    // The wrong sign: the relay drives the output to one end and stays there.
    let test = single_loop_test(&plant.0[1][1], Relay::ideal(1.0, 1.0), time).unwrap();
    assert_eq!(test.reading.verdict, RelayVerdict::NoOscillation);
    let mut unstable = plant;
    unstable.0[0][1] = TransferFunction::new(vec![1.0], vec![-1.0, 2.0], 0.0).unwrap();
    let unstable_plant = Some(TuningError::UnstablePlant { real_part: 0.5 });
    assert_eq!(simultaneous_test(&unstable, [1.0; 2], time).err(), unstable_plant);
    assert_eq!(sine_test(&unstable, 0, 1.0, 10).err(), unstable_plant);
}

#[test]
fn an_integrator_finds_the_point_with_a_quarter_turn_less() {
    // ∠1/(s+1)³ = −90° at ω = tan 30°.
    let plant = &plants()[0];
    let frequency = 1.0 / 3.0_f64.sqrt();
    let period = std::f64::consts::TAU / frequency;
    let time = TestTime { duration: 60.0 * period, release: 0.1 * period, step: period / 200.0 };
    let test = single_loop_test(&with_integrator(plant), Relay::ideal(1.0, 1.0), time).unwrap();
    let found = test.reading.oscillation.unwrap();
    assert_relative_eq!(found.frequency(), frequency, max_relative = 0.02);
    // |F| = ω π a/(4 d), by peaks; 5 % is what the describing function leaves here.
    let modulus = found.frequency() / found.loops[0].gain_by_peak.unwrap();
    assert_relative_eq!(modulus, plant.at(Complex::new(0.0, frequency)).norm(), max_relative = 0.05);
}

#[test]
fn the_estimator_oscillates_where_the_modulus_is_r_if_r_is_small() {
    let plant = &plants()[0];
    // What the describing function leaves: little for small r, and beyond r = 0.4 |H(0)| the estimate is none. The exact
    // limit cycle of F/s says the same, so this is the method, not its simulation.
    for (r, lowest, highest) in [(0.15_f64, 1.0, 1.002), (0.2, 1.0, 1.015), (0.3, 1.0, 1.06), (0.5, 1.6, 1.7)] {
        let estimator = modulus_estimator(plant, r).unwrap();
        let cycle = only_cycle(&estimator);
        let time = TestTime { duration: 60.0 * cycle.period, release: cycle.period, step: cycle.period / 200.0 };
        let test = single_loop_test(&estimator, Relay::ideal(1.0, 1.0), time).unwrap();
        assert_eq!(test.reading.verdict, RelayVerdict::Unimodal, "{r}");
        let oscillation = test.reading.oscillation.unwrap();
        assert_relative_eq!(oscillation.period, cycle.period, max_relative = 1e-6);
        let modulus = plant.at(Complex::new(0.0, oscillation.frequency())).norm();
        assert!((lowest..=highest).contains(&(modulus / r)), "{r}: {modulus}");
    }
    // The same for an element with negative gain.
    let turned = modulus_estimator(&plant.scaled(-1.0), 0.3).unwrap();
    let straight = modulus_estimator(plant, 0.3).unwrap();
    let s = Complex::new(0.0, 1.1);
    assert_relative_eq!((turned.at(s) - straight.at(s)).norm(), 0.0, epsilon = 1e-14);
    let [no_dead_time, no_modulus] = [(1.0, 0.5), (0.0, -1.0)]
        .map(|(dead_time, r)| modulus_estimator(&TransferFunction::lags(1.0, &[1.0], dead_time).unwrap(), r).err());
    assert_eq!(no_dead_time, Some(TuningError::OutOfRange { field: "dead_time", value: 1.0 }));
    assert_eq!(no_modulus, Some(TuningError::OutOfRange { field: "r", value: -1.0 }));
}

#[test]
fn independent_tests_see_single_loops_and_detuning_weakens_them() {
    let plant = PublishedPlant::WoodBerry.transfer_matrix().unwrap();
    let time = TestTime { duration: 300.0, release: 3.0, step: 0.02 };
    let rule = TuningRule::ZieglerNicholsPi;
    let tuned = independent_tuning(&plant, [Relay::ideal(1.0, 12.8), Relay::ideal(1.0, -19.4)], rule, [1.0, 2.0], time)
        .unwrap();
    let [one, two] = tuned.map(|(_, settings)| settings.unwrap());
    // Single loops: Kc 2.0994 and −0.4221, Tc 3.907 and 11.132; the relay is within 3 %.
    assert_relative_eq!(one.gain, 0.4 * 2.0994, max_relative = 0.03);
    assert_relative_eq!(one.integral_time, 0.8 * 3.907, max_relative = 0.03);
    assert_relative_eq!(two.gain, 0.4 * -0.4221 / 2.0, max_relative = 0.03);
    assert_relative_eq!(two.integral_time, 0.8 * 11.132 * 2.0, max_relative = 0.03);
}

#[test]
fn a_sequence_of_tests_converges_on_process_two() {
    let plant = PublishedPlant::ProcessTwo.transfer_matrix().unwrap();
    let time = TestTime { duration: 120.0, release: 1.2, step: 0.01 };
    let steps = sequential_tuning(&plant, [Relay::ideal(1.0, 1.0); 2], TuningRule::TyreusLuybenPi, 4, time).unwrap();
    assert_eq!(steps.len(), 8);
    let gains: Vec<f64> = steps.iter().map(|step| step.settings.unwrap().gain).collect();
    let change = |pass: usize, i: usize| (gains[2 * pass + i] / gains[2 * pass + i - 2] - 1.0).abs();
    for i in [0, 1] {
        assert!(change(3, i) < 0.01, "{gains:?}");
        assert!(change(3, i) < change(1, i), "{gains:?}");
    }
}

#[test]
fn a_relay_that_has_stuck_is_not_read_as_an_oscillation() {
    let plant = &plants()[0];
    let cycle = only_cycle(plant);
    let time = TestTime { duration: 40.0 * cycle.period, release: cycle.period, step: cycle.period / 100.0 };
    let test = single_loop_test(plant, Relay::ideal(1.0, 1.0), time).unwrap();
    let relays = [Some(Relay::ideal(1.0, 1.0)), None];
    let mut trace = test.trace.clone();
    assert_eq!(read_relay_test(&trace, relays).verdict, RelayVerdict::Unimodal);
    // The record goes on, the switches do not.
    let half = trace.switches[0].len() / 2;
    trace.switches[0].truncate(half);
    assert_eq!(read_relay_test(&trace, relays).verdict, RelayVerdict::NotPeriodic);
}

#[test]
fn coarse_rows_lose_no_switch_and_are_no_chattering() {
    let plant = PublishedPlant::WoodBerry.transfer_matrix().unwrap();
    let read = |step: f64| {
        let time = TestTime { duration: 400.0, release: 4.0, step };
        simultaneous_test(&plant, [1.0, 0.05], time).unwrap()
    };
    let (fine, coarse) = (read(0.05), read(40.0));
    assert_eq!(coarse.trace.halt, None);
    assert_eq!(coarse.reading.verdict, fine.reading.verdict);
    let period = |test: &RelayTest| test.reading.oscillation.unwrap().period;
    assert_relative_eq!(period(&coarse), period(&fine), max_relative = 1e-6);
}
