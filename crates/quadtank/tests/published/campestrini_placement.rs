//! The tables of Campestrini (2006) with controllers by placement of the ultimate point, from the printed critical points
//! of Tables 7 and 13. Tolerance: half a unit of the last printed digit, and 0.05 % for the printed periods, whose own half
//! unit is 0.04 to 0.4 % of them.

use std::f64::consts::TAU;

use quadtank::control::ParallelPid;
use quadtank::linear::Complex;
use quadtank::literature::campestrini::PublishedPlant;
use quadtank::tuning::{ControllerPair, TuningRule, integral_action_may_be_stable, place_both_loci, place_one_locus};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

/// Periods of the printed critical points, by their numbers (Tables 7 and 13).
const WOOD_BERRY: [f64; 4] = [11.57, 12.70, 12.25, 12.00];
const PROCESS_TWO: [f64; 3] = [1.46, 1.35, 1.17];

/// A plant at the frequency of one of its critical points.
struct Case {
    plant: PublishedPlant,
    frequency: f64,
}

impl Case {
    fn wood_berry(point: usize) -> Self {
        Self { plant: PublishedPlant::WoodBerry, frequency: TAU / WOOD_BERRY[point - 1] }
    }

    fn process_two(point: usize) -> Self {
        Self { plant: PublishedPlant::ProcessTwo, frequency: TAU / PROCESS_TWO[point - 1] }
    }

    fn method_a(&self, re: f64, im: f64) -> [ControllerPair; 2] {
        let transfer = self.plant.transfer_matrix().unwrap();
        let gain = transfer.dc_gain();
        let g = transfer.at(Complex::new(0.0, self.frequency));
        place_one_locus(&g, Complex::new(re, im), gain[(0, 0)] / gain[(1, 1)])
    }

    /// The root that the source takes: Re p1 with the sign of g11(0), here positive.
    fn method_a_by_sign(&self, re: f64, im: f64) -> ControllerPair {
        let mut fitting = self.method_a(re, im).into_iter().filter(|[p1, _]| p1.re > 0.0);
        let root = fitting.next().expect("a root with the sign of the plant");
        assert!(fitting.next().is_none(), "both roots have the sign of the plant");
        root
    }

    fn method_b(&self, target: Complex) -> [ControllerPair; 2] {
        let transfer = self.plant.transfer_matrix().unwrap();
        place_both_loci(&transfer.at(Complex::new(0.0, self.frequency)), target)
    }

    fn pi(&self, pair: ControllerPair) -> [f64; 4] {
        let [one, two] = pair.map(|p| ParallelPid::pi_through(p, self.frequency));
        [one.proportional, one.integral, two.proportional, two.integral]
    }

    fn pid(&self, pair: ControllerPair) -> [f64; 6] {
        let [one, two] = pair.map(|p| ParallelPid::pid_through(p, self.frequency).unwrap());
        [one.proportional, one.integral, one.derivative, two.proportional, two.integral, two.derivative]
    }
}

/// What the last digit of the periods leaves open.
const PERIOD_SHARE: f64 = 5e-4;

/// All printed with three decimals.
fn check<const N: usize>(found: [f64; N], printed: [f64; N]) {
    for (found, printed) in found.iter().zip(printed) {
        assert!((found - printed).abs() <= 5e-4 + PERIOD_SHARE * printed.abs(), "{found} is not {printed}");
    }
}

#[test]
fn table_5_method_a_pi() {
    let case = Case { plant: PublishedPlant::WoodBerry, frequency: TAU / 12.90 };
    let found = case.pi(case.method_a_by_sign(-0.40, 0.08));
    // Printed 0.178 0.017 −0.118 −0.011, the integral gains cut, not rounded; recomputed to four decimals.
    for (found, recomputed) in found.iter().zip([0.1782, 0.0175, -0.1176, -0.0115]) {
        assert!((found - recomputed).abs() <= 5e-5, "{found} is not {recomputed}");
    }
}

#[test]
fn table_6_method_b_pid() {
    let case = Case::wood_berry(1);
    let [one, two] = case.method_b(Complex::new(-0.60, -0.28));
    check(case.pid(one), [0.567, 0.336, 0.239, -0.102, -0.018, -0.144]);
    check(case.pid(two), [0.155, 0.085, 0.070, -0.400, -0.076, -0.530]);
}

#[test]
fn table_8_method_a_pi() {
    for (point, printed) in [(1, [0.162, 0.004, -0.107, -0.003]), (2, [0.138, 0.016, -0.091, -0.011])] {
        let case = Case::wood_berry(point);
        check(case.pi(case.method_a_by_sign(-0.3, 0.08)), printed);
    }
}

#[test]
fn table_9_method_a_pid_but_for_one_slip() {
    let case = Case::wood_berry(1);
    let found = case.pid(case.method_a_by_sign(0.2, -0.5));
    // ki2 is printed as −0.026; p2 = α p1 gives −0.0245.
    check(found, [0.250, 0.037, 0.420, -0.165, -0.0245, -0.277]);
}

#[test]
fn in_the_third_quadrant_the_sign_does_not_choose_a_root_of_method_a() {
    for (re, im) in [(-0.6, -0.28), (-0.2, -0.5)] {
        for point in 1..=4 {
            let roots = Case::wood_berry(point).method_a(re, im);
            assert!(roots.iter().all(|[p1, _]| p1.re > 0.0), "{re} {im}, point {point}");
        }
    }
    let case = Case::wood_berry(2);
    let mut found = case.method_a(-0.6, -0.28).map(|pair| case.pid(pair));
    found.sort_by(|x, y| x[0].total_cmp(&y[0]));
    for (found, recomputed) in found
        .iter()
        .zip([[0.1648, 0.1627, 0.0417, -0.1087, -0.1074, -0.0275], [0.2697, 0.0412, 0.4415, -0.1780, -0.0272, -0.2913]])
    {
        for (found, recomputed) in found.iter().zip(recomputed) {
            assert!((found - recomputed).abs() <= 5.1e-5, "{found} is not {recomputed}");
        }
    }
}

#[test]
fn table_10_method_b_pi() {
    for (point, printed) in [(1, [0.025, 0.029, -0.128, -0.009]), (2, [0.013, 0.026, -0.114, -0.015])] {
        let case = Case::wood_berry(point);
        let [_, two] = case.method_b(Complex::new(-0.2, 0.01));
        check(case.pi(two), printed);
    }
}

#[test]
fn table_11_method_b_pid_at_the_tyreus_luyben_point() {
    let case = Case::wood_berry(2);
    let [one, two] = case.method_b(TuningRule::TyreusLuybenPid.target());
    check(case.pid(one), [0.582, 0.223, 0.379, -0.087, -0.014, -0.136]);
    check(case.pid(two), [0.143, 0.063, 0.082, -0.312, -0.043, -0.559]);
}

#[test]
fn table_12_method_b_pid() {
    for (point, printed) in [
        (1, [0.106, 0.032, 0.087, -0.144, -0.014, -0.382]),
        (2, [0.093, 0.031, 0.069, -0.151, -0.016, -0.365]),
        (3, [0.098, 0.032, 0.076, -0.149, -0.015, -0.372]),
        (4, [0.101, 0.032, 0.080, -0.148, -0.014, -0.376]),
    ] {
        let case = Case::wood_berry(point);
        let [_, two] = case.method_b(Complex::new(-0.2, -0.3));
        check(case.pid(two), printed);
    }
}

#[test]
fn table_14_method_a_pi() {
    for (point, (re, im), printed) in [
        (1, (-0.3, 0.1), [0.812, 1.723, 0.169, 0.359]),
        (2, (-0.3, 0.1), [0.931, 1.537, 0.194, 0.320]),
        (3, (-0.3, 0.1), [1.171, 0.765, 0.244, 0.159]),
        (3, (-0.4, 0.15), [1.573, 1.347, 0.328, 0.281]),
    ] {
        let case = Case::process_two(point);
        check(case.pi(case.method_a_by_sign(re, im)), printed);
    }
}

#[test]
fn table_15_method_b_pi() {
    for (point, printed, may_be_stable) in
        [(1, [-0.101, 0.630, 0.721, 0.385], true), (2, [-0.096, 0.741, 0.850, -0.035], false)]
    {
        let case = Case::process_two(point);
        let [_, two] = case.method_b(Complex::new(-0.2, 0.01));
        let found = case.pi(two);
        check(found, printed);
        // Row 2 is unstable, which the sign of det(G(0) diag ki) foretells.
        let gain = case.plant.transfer_matrix().unwrap().dc_gain();
        assert_eq!(integral_action_may_be_stable(&gain, [found[1], found[3]]), may_be_stable);
    }
}

#[test]
fn table_16_method_b_pid() {
    for (point, printed) in
        [(1, [0.087, 1.600, 0.001, 1.165, 1.148, 0.296]), (2, [0.114, 1.792, 0.002, 1.196, 1.058, 0.338])]
    {
        let case = Case::process_two(point);
        let [_, two] = case.method_b(Complex::new(-0.3, -0.3));
        check(case.pid(two), printed);
    }
}

#[test]
fn a_placed_locus_is_where_it_was_asked_for() {
    for (case, re, im) in
        [(Case::wood_berry(3), -0.35, -0.2), (Case::process_two(1), 0.1, -0.4), (Case::process_two(3), -0.5, 0.2)]
    {
        let target = Complex::new(re, im);
        let g = case.plant.transfer_matrix().unwrap().at(Complex::new(0.0, case.frequency));
        // det(λI − G diag p): zero for method A, and with λ as a double eigenvalue for method B.
        let characteristic = |[p1, p2]: ControllerPair| {
            let trace = g[(0, 0)] * p1 + g[(1, 1)] * p2;
            let determinant = (g[(0, 0)] * g[(1, 1)] - g[(0, 1)] * g[(1, 0)]) * p1 * p2;
            ((target * target - trace * target + determinant).norm(), (trace - target * 2.0).norm())
        };
        for pair in case.method_a(re, im) {
            assert!(characteristic(pair).0 < 1e-12);
        }
        for pair in case.method_b(target) {
            let (value, slope) = characteristic(pair);
            assert!(value < 1e-12 && slope < 1e-12);
        }
        for p in case.method_b(target).into_iter().flatten() {
            assert!((ParallelPid::pi_through(p, case.frequency).ideal_at(case.frequency) - p).norm() < 1e-12);
            let pid = ParallelPid::pid_through(p, case.frequency).unwrap();
            assert!((pid.ideal_at(case.frequency) - p).norm() < 1e-12);
            assert!(pid.integral * pid.proportional > 0.0 && pid.derivative * pid.proportional > 0.0);
        }
    }
}
