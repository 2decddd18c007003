//! The printed numbers of Campestrini (2006) on critical points and tuning rules, one test per table. Tolerances are half a
//! unit of the last printed digit, or say what was recomputed.

use approx::assert_relative_eq;
use quadtank::linear::TransferMatrix;
use quadtank::literature::campestrini::{PublishedPlant, USOL};
use quadtank::tuning::{
    CriticalCurve, CriticalSearch, GainLimit, TuningRule, UltimatePoint, frequency_range, importance_direction,
};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

fn with_search<T>(plant: PublishedPlant, work: impl FnOnce(&TransferMatrix, &CriticalSearch) -> T) -> T {
    let transfer = plant.transfer_matrix().unwrap();
    let (lowest, highest) = frequency_range(&transfer).unwrap();
    work(&transfer, &CriticalSearch::new(&transfer, lowest, highest))
}

fn within(found: f64, printed: f64, half_unit: f64) {
    assert!((found - printed).abs() <= half_unit * 1.000_001, "{found} is not {printed}");
}

#[test]
fn table_1_and_2_rules() {
    let point = UltimatePoint { gain: 2.0, period: 10.0 };
    // The variant of 1942 is not in these tables.
    let printed = TuningRule::ALL.into_iter().filter(|rule| *rule != TuningRule::ZieglerNichols1942Pi);
    let rows: Vec<_> = printed
        .map(|rule| {
            let c = rule.settings(point);
            (c.gain, c.integral_time, c.derivative_time)
        })
        .collect();
    let expected = [
        (1.0, f64::INFINITY, 0.0),
        (0.8, 8.0, 0.0),
        (1.2, 5.0, 1.25),
        (2.0 / 3.2, 22.0, 0.0),
        (2.0 / 2.2, 22.0, 10.0 / 6.3),
    ];
    assert_eq!(rows.len(), expected.len());
    for (found, expected) in rows.into_iter().zip(expected) {
        assert_relative_eq!(found.0, expected.0, max_relative = 1e-15);
        assert!(found.1 == expected.1 || (found.1 - expected.1).abs() < 1e-12);
        assert_relative_eq!(found.2, expected.2, max_relative = 1e-15);
    }
}

#[test]
fn table_4_where_each_rule_moves_the_ultimate_point() {
    let printed = [
        (TuningRule::ZieglerNicholsPi, (-0.4, 0.08), (0.05, 0.005)),
        (TuningRule::ZieglerNicholsPid, (-0.6, -0.28), (0.05, 0.005)),
        (TuningRule::TyreusLuybenPi, (-0.31, 0.023), (0.005, 0.0005)),
        (TuningRule::TyreusLuybenPid, (-0.45, -0.42), (0.005, 0.005)),
    ];
    for (rule, (re, im), half_units) in printed {
        within(rule.target().re, re, half_units.0);
        within(rule.target().im, im, half_units.1);
        // The same by the controller itself, at the ultimate frequency of a loop with Kc G(jωc) = −1.
        let point = UltimatePoint { gain: -3.0, period: 7.0 };
        let moved = rule.settings(point).ideal_at(std::f64::consts::TAU / point.period) / -point.gain;
        assert_relative_eq!((moved - rule.target()).norm(), 0.0, epsilon = 1e-12);
    }
}

#[test]
fn table_5_ziegler_nichols_beside_it() {
    let printed = [(0.450, 0.180, 0.0174), (-0.290, -0.116, -0.0112)];
    for (gain, kp, ki) in printed {
        let c = TuningRule::ZieglerNicholsPi.settings(UltimatePoint { gain, period: 12.90 });
        within(c.gain, kp, 5e-4);
        within(c.gain / c.integral_time, ki, 5e-5);
    }
}

/// Kc1, Kc2, Tc as printed; the factor that reaches the curve from there and the period there, recomputed to four digits.
type Point = (f64, f64, f64, f64, f64);

fn check_points(plant: PublishedPlant, points: &[Point]) {
    with_search(plant, |_, search| {
        for &(k1, k2, printed_period, factor, period) in points {
            let found = search.nearest([k1, k2]).unwrap();
            within(found.factor, factor, 5e-5);
            within(found.period(), period, 5e-3);
            assert!((found.period() / printed_period - 1.0).abs() < 0.011, "{k1}, {k2}: {}", found.period());
        }
    });
}

#[test]
fn table_7_critical_points_of_wood_and_berry() {
    check_points(
        PublishedPlant::WoodBerry,
        &[
            (0.096, -0.417, 11.57, 1.0001, 11.58),
            (0.710, -0.264, 12.70, 0.9992, 12.71),
            (1.270, -0.252, 12.25, 1.0002, 12.25),
            (1.900, -0.253, 12.00, 1.0014, 11.98),
            (0.42, -0.30, 12.87, 0.9998, 12.88),
            (1.62, -0.2524, 12.07, 0.9998, 12.08),
            (0.450, -0.290, 12.90, 1.0095, 12.89),
        ],
    );
}

#[test]
fn table_13_critical_points_of_process_two() {
    check_points(
        PublishedPlant::ProcessTwo,
        &[
            (1.250, 1.082, 1.46, 1.0002, 1.459),
            (0.100, 2.110, 1.35, 0.9999, 1.344),
            (5.000, 0.494, 1.17, 0.9995, 1.181),
        ],
    );
}

#[test]
fn single_loops_have_the_ultimate_points_of_their_elements() {
    // Recomputed from the elements alone: Kc and Tc.
    let expected = [
        (PublishedPlant::WoodBerry, [1.0, 0.0], 2.0994, 3.907),
        (PublishedPlant::WoodBerry, [0.0, -1.0], 0.4221, 11.132),
        (PublishedPlant::ProcessTwo, [1.0, 0.0], 9.0, 0.8886),
        (PublishedPlant::ProcessTwo, [0.0, 1.0], 2.278, 1.318),
    ];
    for (plant, direction, gain, period) in expected {
        with_search(plant, |_, search| {
            let found = search.nearest(direction).unwrap();
            within(found.factor, gain, 5e-4);
            within(found.period(), period, 5e-4);
        });
    }
}

#[test]
fn the_curve_of_wood_and_berry_by_importance() {
    // Recomputed by an independent program: r2, k1, k2, Tc.
    let golden = [
        (10.0, 0.0639, -0.4217, 11.403),
        (5.0, 0.1242, -0.4099, 11.759),
        (2.0, 0.2652, -0.3500, 12.583),
        (1.0, 0.4462, -0.2944, 12.889),
        (0.5, 0.7876, -0.2598, 12.638),
        (0.3, 1.2733, -0.2520, 12.252),
        (0.25, 1.5285, -0.2521, 12.120),
        (0.2, 1.9078, -0.2518, 3.940),
        (0.1, 1.9849, -0.1310, 3.931),
    ];
    with_search(PublishedPlant::WoodBerry, |plant, search| {
        for (importance, k1, k2, period) in golden {
            let found = search.nearest(importance_direction(&plant.dc_gain(), importance)).unwrap();
            within(found.gains[0], k1, 5e-5);
            within(found.gains[1], k2, 5e-5);
            within(found.period(), period, 5e-4);
        }
    });
}

#[test]
fn at_the_corner_of_wood_and_berry_both_loci_pass_minus_one() {
    with_search(PublishedPlant::WoodBerry, |plant, search| {
        let curve = CriticalCurve::of(plant, search, 200);
        let [corner] = curve.corners[..] else { panic!("one corner, not {:?}", curve.corners) };
        // Recomputed by an independent program.
        within(corner.importance, 0.20137, 5e-6);
        for point in corner.points {
            within(point.gains[0], 1.90694, 5e-6);
            within(point.gains[1], -0.253_364, 5e-7);
        }
        within(corner.points[0].period(), 11.9807, 1e-4);
        within(corner.points[1].period(), 3.93999, 1e-4);
        // Non-convex: between k1 = 1.27 and the corner |k2| rises again.
        let at = |importance: f64| search.nearest(importance_direction(&plant.dc_gain(), importance)).unwrap().gains;
        assert!(at(0.3)[0] < at(0.25)[0] && at(0.3)[1].abs() < 0.2522 && corner.points[0].gains[1].abs() > 0.2533);
    });
}

#[test]
fn process_two_has_no_corner_and_its_ends_are_single_loops() {
    with_search(PublishedPlant::ProcessTwo, |plant, search| {
        let curve = CriticalCurve::of(plant, search, 200);
        assert!(curve.corners.is_empty());
        assert!(curve.points.iter().all(|point| matches!(point.limit, GainLimit::Oscillation(_))));
        let GainLimit::Oscillation(first) = curve.points[0].limit else { panic!("loop 1 alone oscillates") };
        assert_eq!(first.gains[1], 0.0);
        within(first.gains[0], 9.0, 1e-9);
    });
}

#[test]
fn a_critical_point_puts_a_locus_on_minus_one() {
    for plant in [PublishedPlant::WoodBerry, PublishedPlant::ProcessTwo] {
        with_search(plant, |transfer, search| {
            for k in 0..40 {
                let angle = std::f64::consts::FRAC_PI_2 * (f64::from(k) + 0.5) / 40.0;
                let sign = if plant == PublishedPlant::WoodBerry { -1.0 } else { 1.0 };
                let direction = [angle.cos(), sign * angle.sin()];
                let point = search.nearest(direction).unwrap();
                let g = transfer.at(quadtank::linear::Complex::new(0.0, point.frequency));
                let [k1, k2] = point.gains;
                let trace = g[(0, 0)] * k1 + g[(1, 1)] * k2;
                let determinant = (g[(0, 0)] * g[(1, 1)] - g[(0, 1)] * g[(1, 0)]) * (k1 * k2);
                // det(I + GK), against the size of its terms.
                let size = 1.0 + trace.norm() + determinant.norm();
                assert!((trace + determinant + 1.0).norm() <= 1e-9 * size, "{plant:?}, {angle}");
            }
        });
    }
}

#[test]
fn the_record_of_usol() {
    let point = USOL.ultimate_point();
    within(point.gain, USOL.printed_gain, 0.05);
    let pi = TuningRule::TyreusLuybenPi.settings(point);
    let pid = TuningRule::TyreusLuybenPid.settings(point);
    let [kp, ti, td] = USOL.printed_pid;
    // Called PID, but kp is that of the PI row; Ti agrees with both.
    within(pi.gain, kp, 0.5);
    assert!((pid.gain - kp).abs() > 7.0);
    within(pid.integral_time, ti, 0.5);
    // Td = Tc/6.3 is 0.357 min; printed is 4 min, ten times as much.
    within(pid.derivative_time, 0.357, 5e-4);
    assert!(td / pid.derivative_time > 10.0);
}
