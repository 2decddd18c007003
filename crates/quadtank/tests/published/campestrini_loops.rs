//! Loops that Campestrini (2006) tuned: whether they are stable, how near −1 their loci come, how they close; Table 3 and the
//! controller of eq. 88; her method on the quadruple tank. What the thesis shows only as curves was recomputed by an
//! independent program.

use std::f64::consts::TAU;

use approx::assert_relative_eq;
use nalgebra::Matrix2;
use quadtank::control::{ParallelPid, PidMatrix, Relay};
use quadtank::linear::{Complex, DelayedPlant, LociClosure, LoopStability, TransferFunction, TransferMatrix};
use quadtank::literature::campestrini::PublishedPlant;
use quadtank::sim::{TwoLoops, run_two_loops};
use quadtank::tuning::{
    CriticalSearch, Design, GainLimit, RelayVerdict, TestTime, complete_response, frequency_range,
    importance_direction, place_both_loci, place_one_locus, relay_test, simultaneous_test, sine_test,
};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

fn pid([proportional, integral, derivative]: [f64; 3]) -> ParallelPid {
    ParallelPid { proportional, integral, derivative, ..ParallelPid::default() }
}

/// kp1, ki1, kd1, kp2, ki2, kd2.
fn controllers(gains: [f64; 6]) -> PidMatrix {
    let [a, b, c, d, e, f] = gains;
    PidMatrix::decentralised([pid([a, b, c]), pid([d, e, f])])
}

fn pi(gains: [f64; 4]) -> PidMatrix {
    let [a, b, c, d] = gains;
    controllers([a, b, 0.0, c, d, 0.0])
}

fn stability(plant: PublishedPlant, k: PidMatrix) -> LoopStability {
    Design::new(&plant.transfer_matrix().unwrap(), k).unwrap().stability()
}

fn distance(plant: PublishedPlant, k: PidMatrix) -> f64 {
    let plant = plant.transfer_matrix().unwrap();
    let design = Design::new(&plant, k).unwrap();
    design.margins().unwrap().distance
}

use PublishedPlant::{ProcessTwo, WoodBerry};

#[test]
fn published_loops_of_wood_and_berry_are_stable() {
    for k in [
        pi([0.178, 0.017, -0.118, -0.011]),                         // Table 5
        controllers([0.567, 0.336, 0.239, -0.102, -0.018, -0.144]), // Table 6
        controllers([0.155, 0.085, 0.070, -0.400, -0.076, -0.530]),
        pi([0.162, 0.004, -0.107, -0.003]), // Table 8
        pi([0.138, 0.016, -0.091, -0.011]),
        controllers([0.250, 0.037, 0.420, -0.165, -0.026, -0.277]), // Table 9, as printed
        pi([0.025, 0.029, -0.128, -0.009]),                         // Table 10
        pi([0.038, 0.004, -0.167, -0.018]),
        pi([0.013, 0.026, -0.114, -0.015]),
        pi([0.284, 0.028, -0.106, -0.010]),
        controllers([0.582, 0.223, 0.379, -0.087, -0.014, -0.136]), // Table 11
        controllers([0.143, 0.063, 0.082, -0.312, -0.043, -0.559]),
        controllers([0.106, 0.032, 0.087, -0.144, -0.014, -0.382]), // Table 12
        controllers([0.093, 0.031, 0.069, -0.151, -0.016, -0.365]),
        controllers([0.098, 0.032, 0.076, -0.149, -0.015, -0.372]),
        controllers([0.101, 0.032, 0.080, -0.148, -0.014, -0.376]),
    ] {
        assert_eq!(stability(WoodBerry, k), LoopStability::Stable, "{k:?}");
    }
}

#[test]
fn published_loops_of_process_two_are_stable_but_one() {
    for gains in [
        [0.812, 1.723, 0.169, 0.359], // Table 14
        [0.931, 1.537, 0.194, 0.320],
        [1.171, 0.765, 0.244, 0.159],
        [1.573, 1.347, 0.328, 0.281],
        [-0.101, 0.630, 0.721, 0.385], // Table 15
    ] {
        assert_eq!(stability(ProcessTwo, pi(gains)), LoopStability::Stable, "{gains:?}");
    }
    // Table 15, row 2: a real pole in the right half-plane.
    assert_eq!(stability(ProcessTwo, pi([-0.096, 0.741, 0.850, -0.035])), LoopStability::Unstable { poles: 1 });
    // Table 16.
    for gains in [[0.087, 1.600, 0.001, 1.165, 1.148, 0.296], [0.114, 1.792, 0.002, 1.196, 1.058, 0.338]] {
        assert_eq!(stability(ProcessTwo, controllers(gains)), LoopStability::Stable, "{gains:?}");
    }
}

/// Gains by Ziegler and Nichols for PID: 0.6 Kc, 0.5 Tc, Tc/8.
fn ziegler_nichols([k1, k2]: [f64; 2], period: f64) -> PidMatrix {
    let of = |k: f64| pid([0.6 * k, 0.6 * k / (0.5 * period), 0.6 * k * 0.125 * period]);
    PidMatrix::decentralised([of(k1), of(k2)])
}

#[test]
fn one_rule_on_points_of_one_curve_is_excellent_or_unstable() {
    // Figs. 22, 23 and 31.
    assert_eq!(stability(WoodBerry, ziegler_nichols([0.42, -0.30], 12.87)), LoopStability::Stable);
    for (gains, period) in [([1.27, -0.25], 12.25), ([1.62, -0.2524], 12.07)] {
        let verdict = stability(WoodBerry, ziegler_nichols(gains, period));
        assert!(matches!(verdict, LoopStability::Unstable { .. }), "{gains:?}: {verdict:?}");
    }
}

#[test]
fn roots_that_the_sign_does_not_choose_differ_in_stability() {
    // Method A, λ = −0.6 − 0.28j at point 2 of Table 7: "unstable" holds for one root only.
    let one = controllers([0.1648, 0.1627, 0.0417, -0.1087, -0.1074, -0.0275]);
    let other = controllers([0.2697, 0.0412, 0.4415, -0.1780, -0.0272, -0.2913]);
    assert_eq!(stability(WoodBerry, one), LoopStability::Unstable { poles: 2 });
    assert_eq!(stability(WoodBerry, other), LoopStability::Stable);
    // Method B, PI, λ = −0.4 + 0.08j at point 2 (Fig. 43): both unstable.
    for gains in [[0.0838, 0.2041, -0.0547, -0.0152], [0.0096, 0.0542, -0.2212, -0.0463]] {
        assert_eq!(stability(WoodBerry, pi(gains)), LoopStability::Unstable { poles: 2 }, "{gains:?}");
    }
}

#[test]
fn distances_from_minus_one() {
    // Recomputed on a grid of 400,000 frequencies, for Process II to three digits: λ = −0.2 + 0.01j, PI, at point 2 of Wood and Berry; λ = −0.45 − 0.42j, PID, at point 1 of
    // Process II (Figs. 44 and 55). Both roots of method B.
    let pairs = |plant: PublishedPlant, period: f64, re: f64, im: f64| {
        let transfer = plant.transfer_matrix().unwrap();
        place_both_loci(&transfer.at(Complex::new(0.0, TAU / period)), Complex::new(re, im))
    };
    for (pair, printed) in pairs(WoodBerry, 12.70, -0.2, 0.01).into_iter().zip([0.043_792, 0.295_193]) {
        let found =
            distance(WoodBerry, PidMatrix::decentralised(pair.map(|p| ParallelPid::pi_through(p, TAU / 12.70))));
        assert!((found - printed).abs() <= 5.1e-4, "{found} is not {printed}");
    }
    for (pair, printed) in pairs(ProcessTwo, 1.46, -0.45, -0.42).into_iter().zip([0.425, 0.521]) {
        let k = pair.map(|p| ParallelPid::pid_through(p, TAU / 1.46).unwrap());
        let found = distance(ProcessTwo, PidMatrix::decentralised(k));
        assert!((found - printed).abs() <= 5.1e-4, "{found} is not {printed}");
    }
}

#[test]
fn loci_close_separately_or_jointly() {
    let plant = ProcessTwo.transfer_matrix().unwrap();
    let closure = |k1: f64, k2: f64| Design::new(&plant, pi([k1, 0.0, k2, 0.0])).unwrap().closure();
    assert_eq!(closure(1.0, 1.0), LociClosure::Joint);
    assert_eq!(closure(1.25, 1.08), LociClosure::Joint);
    assert_eq!(closure(8.0, 0.19), LociClosure::Separate);
}

#[test]
fn table_3_ultimates_of_each_locus() {
    let plant = WoodBerry.transfer_matrix().unwrap();
    let design = Design::new(&plant, pi([1.0, 0.0, 1.0, 0.0])).unwrap();
    let crossings = design.loci().unwrap().real_crossings(|w| design.ratio(w));
    let has = |gain: f64, period: f64| {
        let near = |x: f64, y: f64, half_unit: f64| (x - y).abs() <= half_unit;
        crossings.iter().any(|c| near(-1.0 / c.value.re, gain, 5e-5) && near(TAU / c.frequency, period, 5e-4))
    };
    // Locus 2, printed −0.37 and 10.70.
    assert!(has(-0.3696, 10.747), "{crossings:?}");
    // Locus 1: the printed gain 0.97 belongs to a period of 4.470, not to the printed 3.54.
    assert!(
        crossings
            .iter()
            .any(|c| (-1.0 / c.value.re - 0.9706).abs() <= 5e-5 && (TAU / c.frequency - 4.470).abs() <= 5e-4)
    );
    assert!(
        crossings
            .iter()
            .any(|c| (-1.0 / c.value.re - 1.198).abs() <= 5e-4 && (TAU / c.frequency - 3.566).abs() <= 5e-4)
    );
    // Printed kp and ki follow 0.45 Kc and 0.8 Tc from the printed Kc and Tc.
    for (kc, tc, kp, ki) in [(0.97_f64, 3.54, 0.437, 0.154), (-0.37, 10.70, -0.167, -0.019)] {
        assert!((0.45 * kc - kp).abs() <= 5.1e-4 && (0.45 * kc / (0.8 * tc) - ki).abs() <= 5.1e-4);
    }
}

#[test]
fn equation_88_with_the_sign_that_was_lost() {
    let mu = [(0.437, 0.154), (-0.167, -0.019)];
    let b = Matrix2::new(-1.08, 0.45, -0.20, 1.08);
    let k = |a21: f64| PidMatrix::between(&Matrix2::new(-1.0, 0.42, a21, 1.0), mu, &b).0;
    // Recomputed with A21 = −0.18; the printed second row, 0.120 0.035 −0.217 −0.034, is within the rounding of A and B.
    let expected = [[(0.486, 0.168), (-0.2724, -0.0779)], [(0.1184, 0.0337), (-0.2158, -0.0330)]];
    for (found, expected) in k(-0.18).as_flattened().iter().zip(expected.as_flattened()) {
        assert!((found.proportional - expected.0).abs() <= 5.1e-4, "{found:?}");
        assert!((found.integral - expected.1).abs() <= 5.1e-4, "{found:?}");
    }
    // As printed, +0.18, the second row is another one.
    assert_relative_eq!(k(0.18)[1][0].proportional, -0.0516, epsilon = 5.1e-5);
    assert_relative_eq!(k(0.18)[1][1].proportional, -0.145, epsilon = 5.1e-4);
    // The published controller is stable.
    let printed = PidMatrix([
        [pid([0.487, 0.168, 0.0]), pid([-0.272, -0.078, 0.0])],
        [pid([0.120, 0.035, 0.0]), pid([-0.217, -0.034, 0.0])],
    ]);
    assert_eq!(stability(WoodBerry, printed), LoopStability::Stable);
}

#[test]
fn the_count_of_encirclements_agrees_with_the_response() {
    // Every verdict above is also what a simulation does: it settles or diverges.
    let cases = [
        (WoodBerry, pi([0.178, 0.017, -0.118, -0.011]), 600.0, 0.05),
        (WoodBerry, ziegler_nichols([1.27, -0.25], 12.25), 2000.0, 0.02),
        (WoodBerry, controllers([0.2697, 0.0412, 0.4415, -0.1780, -0.0272, -0.2913]), 600.0, 0.02),
        (WoodBerry, controllers([0.1648, 0.1627, 0.0417, -0.1087, -0.1074, -0.0275]), 2000.0, 0.02),
        (ProcessTwo, pi([0.812, 1.723, 0.169, 0.359]), 60.0, 0.005),
        (ProcessTwo, pi([-0.096, 0.741, 0.850, -0.035]), 4000.0, 0.02),
    ];
    for (plant, k, duration, step) in cases {
        let transfer = plant.transfer_matrix().unwrap();
        let references = [1.0, 0.0];
        let loops = TwoLoops { relays: [None; 2], controllers: k, references, release: 0.0, duration, step };
        let trace = run_two_loops(&mut DelayedPlant::new(&transfer.paths()).unwrap(), &loops);
        let last = trace.outputs.iter().map(|y| *y.last().unwrap()).zip(references).map(|(y, r)| (y - r).abs());
        let settled = trace.halt.is_none() && last.fold(0.0, f64::max) < 0.02;
        assert_eq!(settled, stability(plant, k) == LoopStability::Stable, "{plant:?} {k:?}");
    }
}

#[test]
fn the_stable_root_of_method_a_responds_well() {
    // Recomputed: y1 overshoots by 2 % and settles within 2 % after 38 time units.
    let transfer = WoodBerry.transfer_matrix().unwrap();
    let controllers = controllers([0.2697, 0.0412, 0.4415, -0.1780, -0.0272, -0.2913]);
    let references = [1.0, 0.0];
    let loops = TwoLoops { relays: [None; 2], controllers, references, release: 0.0, duration: 300.0, step: 0.02 };
    let trace = run_two_loops(&mut DelayedPlant::new(&transfer.paths()).unwrap(), &loops);
    let y = &trace.outputs[0];
    let peak = y.iter().copied().fold(0.0, f64::max);
    let settled =
        trace.time.iter().zip(y).filter(|(_, y)| (*y - 1.0).abs() > 0.02).map(|(t, _)| *t).fold(0.0, f64::max);
    assert!((0.015..0.025).contains(&(peak - 1.0)), "{peak}");
    assert_relative_eq!(settled, 38.0, epsilon = 1.0);
}

#[test]
fn g_at_point_1_and_how_to_measure_it() {
    // Printed as for 1.84 rad/s, which is Tc/2π; the frequency is 2π/11.57.
    let plant = WoodBerry.transfer_matrix().unwrap();
    let w = TAU / 11.57;
    let g = plant.at(Complex::new(0.0, w));
    let printed = [(-0.589, -1.273), (1.650, 0.048), (0.520, 0.969), (2.455, 0.169)];
    for (at, (re, im)) in [(0, 0), (0, 1), (1, 0), (1, 1)].into_iter().zip(printed) {
        assert!((g[at] - Complex::new(re, im)).norm() <= 7.1e-4, "{at:?}: {}", g[at]);
    }
    let column = sine_test(&plant, 0, w, 60).unwrap();
    assert!((column[0] - g[(0, 0)]).norm() <= 1e-3 && (column[1] - g[(1, 0)]).norm() <= 1e-3, "{column:?}");
}

#[test]
fn without_a_model_relays_and_a_sine_give_the_same_controllers() {
    let plant = WoodBerry.transfer_matrix().unwrap();
    let time = TestTime { duration: 1500.0, release: 15.0, step: 0.02 };
    let test = simultaneous_test(&plant, [1.0, 5.0], time).unwrap();
    let oscillation = test.reading.oscillation.unwrap();
    let w = oscillation.frequency();
    let measured = complete_response(sine_test(&plant, 0, w, 60).unwrap(), &oscillation);
    let g = plant.at(Complex::new(0.0, w));
    assert!((measured - g).norm() <= 5e-3 * g.norm(), "{measured} {g}");
    let target = Complex::new(-0.2, -0.3);
    for (of_model, of_test) in place_both_loci(&g, target).into_iter().zip(place_both_loci(&measured, target)) {
        for i in [0, 1] {
            assert!((of_model[i] - of_test[i]).norm() <= 0.02 * of_model[i].norm(), "{of_model:?} {of_test:?}");
        }
    }
}

/// The linear models of Johansson (2000, §3) with the printed gains and times.
fn johansson(minimum_phase: bool) -> TransferMatrix {
    let g = |gain: f64, times: &[f64]| TransferFunction::lags(gain, times, 0.0).unwrap();
    TransferMatrix(if minimum_phase {
        [[g(2.6, &[62.0]), g(1.5, &[23.0, 62.0])], [g(1.4, &[30.0, 90.0]), g(2.8, &[90.0])]]
    } else {
        [[g(1.5, &[63.0]), g(2.5, &[39.0, 63.0])], [g(2.5, &[56.0, 91.0]), g(1.6, &[91.0])]]
    })
}

fn limit(plant: &TransferMatrix, importance: f64) -> GainLimit {
    let (low, high) = frequency_range(plant).unwrap();
    CriticalSearch::new(plant, low, high).limit(importance_direction(&plant.dc_gain(), importance))
}

#[test]
fn the_minimum_phase_tank_has_no_ultimate_point_until_a_dead_time_is_added() {
    let plant = johansson(true);
    for importance in [0.001, 0.1, 1.0, 10.0, 1000.0] {
        assert_eq!(limit(&plant, importance), GainLimit::None, "{importance}");
    }
    // Recomputed: K and Tc for r2 = 1 with 5 s and with 1 s.
    for (dead_time, k1, k2, period, digits) in [(5.0, 7.799, 7.242, 19.41, 5e-3), (1.0, 37.72, 35.02, 3.974, 5e-4)] {
        let delay = TransferFunction::new(vec![1.0], vec![1.0], dead_time).unwrap();
        let GainLimit::Oscillation(point) = limit(&plant.followed_by(&delay), 1.0) else { panic!("it oscillates") };
        assert_relative_eq!(point.gains[0], k1, max_relative = 1.4e-4);
        assert_relative_eq!(point.gains[1], k2, max_relative = 1.4e-4);
        assert_relative_eq!(point.period(), period, epsilon = digits);
    }
}

#[test]
fn the_other_tank_drifts_with_the_diagonal_pairing_and_swings_with_the_other() {
    let plant = johansson(false);
    // A real pole: factor 1.629 in normalised gains.
    let GainLimit::RealPole { factor, .. } = limit(&plant, 1.0) else { panic!("a real pole bounds the gains") };
    assert_relative_eq!(factor, 1.629, epsilon = 5e-4);
    let swapped = plant.swapped();
    let GainLimit::Oscillation(point) = limit(&swapped, 1.0) else { panic!("it oscillates") };
    // Rounded up to 1.776 elsewhere; here both gains to all digits of a second program.
    assert_relative_eq!(point.gains[0], 1.775_489_198_480_984, max_relative = 1e-12);
    assert_relative_eq!(point.gains[1], 1.775_489_198_480_984, max_relative = 1e-12);
    assert_relative_eq!(point.period(), 233.9, epsilon = 0.05);
    // Method B, PID, λ = −0.3 − 0.3j: both pairs stable, with distances 0.658 and 0.670.
    let g = swapped.at(Complex::new(0.0, point.frequency));
    let expected = [
        ([0.6777, 0.0186, 6.178, 0.2342, 0.0016, 8.639], 0.658),
        ([0.1652, 0.0016, 4.237, 1.3556, 0.0257, 17.86], 0.670),
    ];
    for (pair, (gains, distance)) in place_both_loci(&g, Complex::new(-0.3, -0.3)).into_iter().zip(expected) {
        let found = pair.map(|p| ParallelPid::pid_through(p, point.frequency).unwrap());
        let design = Design::new(&swapped, PidMatrix::decentralised(found)).unwrap();
        for (found, expected) in found.iter().flat_map(|c| [c.proportional, c.integral, c.derivative]).zip(gains) {
            assert!(
                (found - expected).abs() <= 6e-5 * 1000.0_f64.powf(expected.abs().log10().max(0.0)),
                "{found} {expected}"
            );
        }
        assert_eq!(design.stability(), LoopStability::Stable);
        assert_relative_eq!(design.margins().unwrap().distance, distance, epsilon = 2e-3);
    }
}

#[test]
fn relays_on_the_tank() {
    let time = TestTime { duration: 3000.0, release: 30.0, step: 0.1 };
    let delay = TransferFunction::new(vec![1.0], vec![1.0], 5.0).unwrap();
    let plant = johansson(true).followed_by(&delay);
    let test = simultaneous_test(&plant, [1.0, 1.0], time).unwrap();
    assert_eq!(test.reading.verdict, RelayVerdict::Unimodal);
    let found = test.reading.oscillation.unwrap();
    // Recomputed with relays on a sampling grid, which delays every switch a little: T = 20.40 s, (5.78, 8.09) by peaks,
    // (7.10, 9.98) by first harmonics. Exact switches find a period 0.6 % shorter.
    assert_relative_eq!(found.period, 20.40, max_relative = 0.01);
    let ([p1, p2], [h1, h2]) = (found.gains_by_peak().unwrap(), found.gains_by_harmonic().unwrap());
    for (found, expected) in [(p1, 5.78), (p2, 8.09), (h1, 7.10), (h2, 9.98)] {
        assert_relative_eq!(found, expected, max_relative = 0.01);
    }
    // Without a dead time the diagonal elements have relative degree 1: ideal relays chatter.
    let test = simultaneous_test(&johansson(true), [1.0, 1.0], time).unwrap();
    assert!(matches!(test.reading.verdict, RelayVerdict::Chattering { .. }), "{:?}", test.reading.verdict);
    // P+, swapped, no dead time, d2/d1 = 2: T = 158 s with a complex U/Y.
    let swapped = johansson(false).swapped();
    let long = TestTime { duration: 8000.0, release: 80.0, step: 0.5 };
    let test = simultaneous_test(&swapped, [1.0, 2.0], long).unwrap();
    let found = test.reading.oscillation.unwrap();
    assert_relative_eq!(found.period, 158.0, max_relative = 0.01);
    assert!(!found.is_proportional());
    let relays = [1.0, 1.0].map(|d| Some(Relay { hysteresis: 0.1, ..Relay::ideal(d, 1.0) }));
    let test =
        relay_test(&mut DelayedPlant::new(&swapped.paths()).unwrap(), relays, PidMatrix::default(), long).unwrap();
    assert!(test.reading.oscillation.is_some(), "{:?}", test.reading.verdict);
}

#[test]
fn bad_targets_and_plants_are_told() {
    // λ = 0 asks for no controller at all, and λ = −1 for the critical gains themselves.
    let plant = WoodBerry.transfer_matrix().unwrap();
    let g = plant.at(Complex::new(0.0, TAU / 12.0));
    for pair in place_both_loci(&g, Complex::ZERO) {
        assert_eq!(ParallelPid::pid_through(pair[0], 1.0), None);
    }
    let at_minus_one = place_one_locus(&g, Complex::from(-1.0), -0.66)[0].map(|p| pid([p.re, 0.0, 0.0]));
    assert!(at_minus_one.iter().all(|p| p.proportional.is_finite()));
}
