//! Properties of loops with dead time and of tuning over random plants: two independent ways to the same answer.

use nalgebra::Matrix2;
use proptest::prelude::*;
use quadtank::control::{ParallelPid, PidMatrix};
use quadtank::linear::{Complex, DelayedPlant, LoopStability, SignalPath, TransferFunction, TransferMatrix};
use quadtank::sim::{Halt, TwoLoops, run_two_loops};
use quadtank::tuning::{
    Action, CriticalSearch, Design, GainLimit, PlacementMethod, TestTime, frequency_range, importance_direction,
    propose, response_at, simultaneous_test,
};

/// One or two lags with a gain of either sign and a dead time.
fn element(dead_time: impl Strategy<Value = f64>) -> impl Strategy<Value = TransferFunction> {
    let gain = prop_oneof![0.2..3.0_f64, -3.0..-0.2_f64];
    (gain, prop::collection::vec(0.5..20.0_f64, 1..=2), dead_time)
        .prop_map(|(gain, lags, dead_time)| TransferFunction::lags(gain, &lags, dead_time).unwrap())
}

fn of_elements<S: Strategy<Value = TransferFunction>>(
    element: impl Fn() -> S,
) -> impl Strategy<Value = TransferMatrix> {
    (element(), element(), element(), element()).prop_map(|(a, b, c, d)| TransferMatrix([[a, b], [c, d]]))
}

/// With or without dead times.
fn plant() -> impl Strategy<Value = TransferMatrix> {
    of_elements(|| element(prop_oneof![Just(0.0), 0.1..6.0_f64]))
}

/// With a dead time in every path, which keeps the bandwidth of a loop in sight of its ultimate frequency.
fn delayed_plant() -> impl Strategy<Value = TransferMatrix> {
    of_elements(|| element(0.5..6.0_f64))
}

/// `det(xI − L)` and its slope at x, relative to the size of their terms: both are zero where both eigenvalues of L are x.
fn characteristic(ratio: &Matrix2<Complex>, x: Complex) -> [f64; 2] {
    let (trace, determinant) = (ratio.trace(), ratio.determinant());
    let size = x.norm_sqr() + trace.norm() * x.norm() + ratio.norm_squared();
    [(x * x - trace * x + determinant).norm() / size, (x * 2.0 - trace).norm() / size.sqrt()]
}

fn proportional(gains: [f64; 2]) -> PidMatrix {
    PidMatrix::decentralised(gains.map(|proportional| ParallelPid { proportional, ..ParallelPid::default() }))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// The search for critical points and the count of encirclements know nothing of each other.
    #[test]
    fn a_loop_is_stable_just_below_its_limit_and_not_just_above(plant in plant(), importance in 0.05..20.0_f64) {
        let (low, high) = frequency_range(&plant).unwrap();
        let search = CriticalSearch::new(&plant, low, high);
        let stability = |gains: [f64; 2]| Design::new(&plant, proportional(gains)).unwrap().stability();
        let direction = importance_direction(&plant.dc_gain(), importance);
        let gains = match search.limit(direction) {
            // Near the end of the searched frequencies, at gains that no loop has, the crossing back may lie beyond them.
            GainLimit::Oscillation(point) if point.frequency > 0.2 * high => return Ok(()),
            GainLimit::Oscillation(point) => point.gains,
            GainLimit::RealPole { gains, .. } | GainLimit::AlgebraicLoop { gains, .. } => gains,
            GainLimit::None => return Ok(()),
        };
        prop_assert_eq!(stability(gains.map(|k| 0.98 * k)), LoopStability::Stable);
        // With a dead time a loop may be stable again beyond a second crossing, which can be near.
        let next = search.crossings(direction).iter().map(|point| point.gains[0] / gains[0]).find(|&share| share > 1.0 + 1e-9);
        let beyond = next.map_or(1.01, |share| share.sqrt().min(1.01));
        prop_assert!(stability(gains.map(|k| beyond * k)) != LoopStability::Stable, "{:?} {}", gains, beyond);
    }

    #[test]
    fn at_a_critical_point_a_locus_is_on_minus_one(plant in plant(), importance in 0.05..20.0_f64) {
        let (low, high) = frequency_range(&plant).unwrap();
        let search = CriticalSearch::new(&plant, low, high);
        let points = search.crossings(importance_direction(&plant.dc_gain(), importance));
        prop_assert_eq!(points.first().copied(), search.nearest(importance_direction(&plant.dc_gain(), importance)));
        for point in points {
            let ratio = response_at(&plant, point.frequency) * Matrix2::from_diagonal(&point.gains.map(Complex::from).into());
            // The search takes a locus for real within 1e-6: where two crossings nearly meet, rounding allows no more.
            prop_assert!(characteristic(&ratio, Complex::from(-1.0))[0] <= 2e-6, "{:?}", point);
        }
    }

    #[test]
    fn placed_loci_are_on_their_target(plant in plant(), w in 0.02..2.0_f64, re in -1.0..1.0_f64, im in -1.0..1.0_f64) {
        let target = Complex::new(re, im);
        prop_assume!(target.norm() > 1e-3);
        let g = response_at(&plant, w);
        prop_assume!(g.determinant().norm() > 1e-3 * g.norm_squared());
        for method in [PlacementMethod::OneLocus, PlacementMethod::BothLoci] {
            for action in [Action::Pi, Action::Pid] {
                let Ok(roots) = propose(&plant.dc_gain(), &g, w, method, action, target) else { continue };
                for root in roots {
                    // Without the filter, which the placement does not know.
                    let k = Matrix2::from_diagonal(&root.controllers.map(|pid| pid.ideal_at(w)).into());
                    let ratio = g * k;
                    let [value, slope] = characteristic(&ratio, target);
                    prop_assert!(value <= 1e-9, "{:?} {:?}: {}", method, action, value);
                    prop_assert!(method == PlacementMethod::OneLocus || slope <= 1e-9, "{:?}: {}", action, slope);
                }
            }
        }
    }

    /// A dead time only shifts, and superposition holds, for steps at any instants.
    #[test]
    fn a_dead_time_shifts_the_response(element in element(prop_oneof![Just(0.0), 0.1..6.0_f64]), later in 0.0..5.0_f64, times in prop::collection::vec(0.01..3.0_f64, 1..12)) {
        let delay = TransferFunction::new(vec![1.0], vec![1.0], later).unwrap();
        let held = |element: TransferFunction| DelayedPlant::new(&[SignalPath { input: 0, output: 0, element }]).unwrap();
        let (mut plain, mut delayed) = (held(element.clone()), held(element.times(&delay)));
        let mut along = held(element.times(&delay));
        for (k, &time) in times.iter().enumerate() {
            let input = if k % 2 == 0 { 1.0 } else { -0.5 };
            for plant in [&mut plain, &mut delayed, &mut along] {
                plant.set_inputs([input, 0.0]);
            }
            plain.advance(time);
            delayed.advance(time);
            // The same in two parts.
            along.advance(0.37 * time);
            along.advance(time - 0.37 * time);
            prop_assert!((delayed.outputs()[0] - along.outputs()[0]).abs() <= 1e-12);
        }
        delayed.advance(later);
        prop_assert!((delayed.outputs()[0] - plain.outputs()[0]).abs() <= 1e-11);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// The verdict by encirclements is what a simulation does.
    #[test]
    fn stable_loops_settle_and_unstable_ones_do_not(plant in delayed_plant(), share in prop_oneof![0.2..0.7_f64, 1.3..2.0_f64]) {
        let (low, high) = frequency_range(&plant).unwrap();
        let search = CriticalSearch::new(&plant, low, high);
        let GainLimit::Oscillation(point) = search.limit(importance_direction(&plant.dc_gain(), 1.0)) else { return Ok(()) };
        // Far beyond the first limit a loop may be stable again; the count says so either way.
        let controllers = proportional(point.gains.map(|k| share * k));
        let stable = Design::new(&plant, controllers).unwrap().stability() == LoopStability::Stable;
        let step = point.period() / 400.0;
        // At 0.7 and 1.3 of the limit a period changes the swing by a few per cent at least.
        let duration = 300.0 * point.period() + 400.0;
        prop_assume!(duration / step < 200_000.0);
        let loops = TwoLoops { relays: [None; 2], controllers, references: [1.0, 0.5], release: 0.0, duration, step };
        let trace = run_two_loops(&mut DelayedPlant::new(&plant.paths()).unwrap(), &loops);
        let y = &trace.outputs[0];
        let swing = |part: &[f64]| {
            part.iter().copied().fold(f64::NEG_INFINITY, f64::max) - part.iter().copied().fold(f64::INFINITY, f64::min)
        };
        let (early, late) = (swing(&y[..y.len() / 4]), swing(&y[y.len() * 3 / 4..]));
        prop_assert_eq!(stable, !matches!(trace.halt, Some(Halt::Diverged { .. })) && late < 0.5 * early, "{} {}", early, late);
    }

    /// Whatever the relays do, the reading is a verdict.
    #[test]
    fn a_relay_test_never_panics(plant in plant(), d1 in 0.01..10.0_f64, d2 in 0.01..10.0_f64, step in 0.05..2.0_f64) {
        let test = simultaneous_test(&plant, [d1, d2], TestTime { duration: 200.0, release: 2.0, step }).unwrap();
        if let Some(oscillation) = test.reading.oscillation {
            prop_assert!(oscillation.period > 0.0);
            prop_assert!(oscillation.loops.iter().all(|l| l.amplitude.is_finite() && l.output.is_finite()));
        }
    }
}
