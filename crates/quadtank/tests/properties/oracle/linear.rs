//! Every figure of the independent oracle (`tests/data/quadruple-tank.json`) that the rooms `linear` and `interaction`
//! compute, for every plant in it, and the singular cases of the quadruple tank, each with its typed error.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, dmatrix};
use quadtank::interaction::{
    PairingReason, PairingVerdict, niederlinski, recommend_pairing, relative_gain_array, relative_gain_array_at,
};
use quadtank::linear::{Complex, LinearError, StateSpace, quadruple, transmission_zeros};
use serde::Deserialize;

/// The bar of the project for figures away from singular cases.
const RELATIVE: f64 = 1e-9;

#[derive(Deserialize)]
struct Reference {
    cases: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    name: String,
    plant: Plant,
    time_constants: [f64; 4],
    a: Vec<Vec<f64>>,
    b: Vec<Vec<f64>>,
    c: Vec<Vec<f64>>,
    poles: Vec<f64>,
    zeros: Vec<f64>,
    zero_output_directions: Vec<[f64; 2]>,
    dc_gain: Vec<Vec<f64>>,
    rga_11: f64,
    niederlinski_diagonal: f64,
    niederlinski_swapped: f64,
    rga_11_at_rad_s: BTreeMap<String, [f64; 2]>,
    singular_values_at_rad_s: BTreeMap<String, [f64; 2]>,
}

#[derive(Deserialize)]
struct Plant {
    gamma: [f64; 2],
}

impl Case {
    fn model(&self) -> StateSpace {
        StateSpace::strictly_proper(matrix(&self.a), matrix(&self.b), matrix(&self.c)).unwrap()
    }
}

fn matrix(rows: &[Vec<f64>]) -> DMatrix<f64> {
    DMatrix::from_row_iterator(rows.len(), rows[0].len(), rows.iter().flatten().copied())
}

fn cases() -> Vec<Case> {
    let reference: Reference = serde_json::from_str(include_str!("../../data/quadruple-tank.json")).unwrap();
    assert_eq!(reference.cases.len(), 14);
    reference.cases
}

fn close(name: &str, what: &str, value: f64, expected: f64) {
    let error = (value - expected).abs() / expected.abs();
    assert!(error <= RELATIVE, "{name}: {what} = {value}, expected {expected}, relative error {error:e}");
}

#[test]
fn poles() {
    for case in cases() {
        let poles = case.model().poles().unwrap();
        assert_eq!(poles.len(), case.poles.len());
        for (pole, expected) in poles.iter().zip(&case.poles) {
            close(&case.name, "pole", pole.re, *expected);
            assert_eq!(pole.im, 0.0);
        }
    }
}

#[test]
fn zeros_and_their_output_directions() {
    for case in cases() {
        let zeros = transmission_zeros(&case.model()).unwrap();
        assert_eq!(zeros.len(), case.zeros.len(), "{}", case.name);
        for ((zero, expected), direction) in zeros.iter().zip(&case.zeros).zip(&case.zero_output_directions) {
            close(&case.name, "zero", zero.value.re, *expected);
            assert_eq!(zero.value.im, 0.0);
            let computed = [zero.output_direction[0], zero.output_direction[1]];
            assert!(computed.iter().all(|entry| entry.im == 0.0));
            let sign = (computed[0].re * direction[0] + computed[1].re * direction[1]).signum();
            close(&case.name, "direction, first entry", sign * computed[0].re, direction[0]);
            close(&case.name, "direction, second entry", sign * computed[1].re, direction[1]);
        }
    }
}

#[test]
fn zeros_in_closed_form() {
    for case in cases() {
        let [.., t3, t4] = case.time_constants;
        let closed_form = quadruple::zeros(t3, t4, case.plant.gamma).unwrap();
        for (zero, expected) in closed_form.as_slice().iter().zip(&case.zeros) {
            close(&case.name, "closed form", *zero, *expected);
        }
        assert_eq!(quadruple::rightmost_zero(t3, t4, case.plant.gamma), closed_form.rightmost());
    }
}

#[test]
fn steady_state_gain() {
    for case in cases() {
        let gain = case.model().dc_gain().unwrap();
        for (value, expected) in gain.iter().zip(matrix(&case.dc_gain).iter()) {
            close(&case.name, "G(0)", *value, *expected);
        }
    }
}

#[test]
fn relative_gain_and_niederlinski_indices() {
    for case in cases() {
        let gain = case.model().dc_gain().unwrap();
        close(&case.name, "λ11", relative_gain_array(&gain).unwrap()[(0, 0)], case.rga_11);
        let [diagonal, swapped] = niederlinski(&gain);
        close(&case.name, "diagonal index", diagonal.unwrap(), case.niederlinski_diagonal);
        close(&case.name, "swapped index", swapped.unwrap(), case.niederlinski_swapped);
    }
}

#[test]
fn the_recommended_pairing_has_the_positive_relative_gain() {
    for case in cases() {
        let [gamma1, gamma2] = case.plant.gamma;
        match recommend_pairing(&case.model().dc_gain().unwrap()) {
            PairingVerdict::Diagonal(PairingReason::OnlyPositiveRelativeGain { relative_gain }) => {
                // Cocota 2009, eq. 4.10.
                close(&case.name, "λ11", relative_gain, gamma1 * gamma2 / (gamma1 + gamma2 - 1.0));
            }
            PairingVerdict::Swapped(PairingReason::OnlyPositiveRelativeGain { relative_gain }) => {
                // Cocota 2009, eq. 4.14.
                let expected = (1.0 - gamma1) * (1.0 - gamma2) / (1.0 - gamma1 - gamma2);
                close(&case.name, "λ12", relative_gain, expected);
            }
            other => panic!("{}: {other:?}", case.name),
        }
    }
}

#[test]
fn relative_gain_over_frequency() {
    for case in cases() {
        assert_eq!(case.rga_11_at_rad_s.len(), 3);
        for (w, expected) in &case.rga_11_at_rad_s {
            let value = relative_gain_array_at(&case.model(), w.parse().unwrap()).unwrap()[(0, 0)];
            let expected = Complex::new(expected[0], expected[1]);
            assert!((value - expected).norm() <= RELATIVE * expected.norm(), "{}: {value} {expected}", case.name);
        }
    }
}

#[test]
fn singular_values_over_frequency() {
    for case in cases() {
        assert_eq!(case.singular_values_at_rad_s.len(), 3);
        for (w, expected) in &case.singular_values_at_rad_s {
            let values = case.model().singular_values(w.parse().unwrap()).unwrap();
            assert_eq!(values.len(), 2);
            close(&case.name, "largest singular value", values[0], expected[0]);
            close(&case.name, "smallest singular value", values[1], expected[1]);
        }
    }
}

/// The linear model of a quadruple tank (Cocota 2009, eqs. 3.14–3.17) with unequal tanks, in SI.
fn quadruple_tank([t1, t2, t3, t4]: [f64; 4], [gamma1, gamma2]: [f64; 2]) -> StateSpace {
    let area = [0.0028, 0.0032, 0.0028, 0.0032];
    let pump = [3.33e-6, 3.35e-6];
    let a = dmatrix![
        -1.0 / t1, 0.0, area[2] / (area[0] * t3), 0.0;
        0.0, -1.0 / t2, 0.0, area[3] / (area[1] * t4);
        0.0, 0.0, -1.0 / t3, 0.0;
        0.0, 0.0, 0.0, -1.0 / t4
    ];
    let b = dmatrix![
        gamma1 * pump[0] / area[0], 0.0;
        0.0, gamma2 * pump[1] / area[1];
        0.0, (1.0 - gamma2) * pump[1] / area[2];
        (1.0 - gamma1) * pump[0] / area[3], 0.0
    ];
    let c = dmatrix![50.0, 0.0, 0.0, 0.0; 0.0, 50.0, 0.0, 0.0];
    StateSpace::strictly_proper(a, b, c).unwrap()
}

const TIMES: [f64; 4] = [62.0, 90.0, 23.0, 30.0];

#[test]
fn a_valve_pair_that_feeds_one_tank_only_is_singular_at_every_frequency() {
    for gammas in [[1.0, 0.0], [0.0, 1.0]] {
        let model = quadruple_tank(TIMES, gammas);
        let error = LinearError::DegenerateRank { rank: 1, size: 2 };
        assert_eq!(transmission_zeros(&model), Err(error));
        assert_eq!(quadruple::zeros(TIMES[2], TIMES[3], gammas), Err(error));
        assert_eq!(model.normal_rank(), Ok(1));
    }
}

#[test]
fn valves_that_sum_to_one_put_a_zero_at_the_origin() {
    for gamma1 in [0.01, 0.1, 0.25, 0.3, 0.5, 0.7, 0.99] {
        let model = quadruple_tank(TIMES, [gamma1, 1.0 - gamma1]);
        let zeros = transmission_zeros(&model).unwrap();
        assert_eq!(zeros.len(), 2);
        assert!(zeros[1].value.norm() <= 1e-12 * zeros[0].value.norm(), "{zeros:?}");
        let gain = model.dc_gain().unwrap();
        assert!(matches!(relative_gain_array(&gain), Err(LinearError::SingularGain { .. })));
        assert_eq!(recommend_pairing(&gain), PairingVerdict::None(PairingReason::SingularGain));
        assert_eq!(model.normal_rank(), Ok(2));
    }
}

#[test]
fn a_valve_that_sends_nothing_below_leaves_no_finite_zero() {
    for gammas in [[0.0, 0.4], [0.6, 0.0], [0.0, 0.0]] {
        assert_eq!(transmission_zeros(&quadruple_tank(TIMES, gammas)), Ok(vec![]));
        assert_eq!(quadruple::zeros(TIMES[2], TIMES[3], gammas), Ok(quadruple::FiniteZeros::None));
    }
}

#[test]
fn a_valve_that_sends_everything_below_leaves_the_zero_of_the_other_upper_tank() {
    // γ1 = 1 leaves tank 4 without water: its mode is not controllable, hence no zero of G. Tank 3 is still there.
    let zeros = transmission_zeros(&quadruple_tank(TIMES, [1.0, 0.6])).unwrap();
    assert_eq!(zeros.len(), 1);
    close("γ1 = 1", "zero", zeros[0].value.re, -1.0 / TIMES[2]);
    assert_eq!(transmission_zeros(&quadruple_tank(TIMES, [1.0, 1.0])), Ok(vec![]));
    // The same with the dry tank left out, as the closed form sees it.
    let closed_form = quadruple::zeros(TIMES[2], 0.0, [1.0, 0.6]).unwrap();
    assert_eq!(closed_form.as_slice().len(), 1);
    close("γ1 = 1", "closed form", closed_form.as_slice()[0], -1.0 / TIMES[2]);
}

#[test]
fn general_zeros_agree_with_the_closed_form_all_over_the_valve_plane() {
    for i in 1..40 {
        for j in 1..40 {
            let gammas = [f64::from(i) / 40.0, f64::from(j) / 40.0];
            let zeros = transmission_zeros(&quadruple_tank(TIMES, gammas)).unwrap();
            let closed_form = quadruple::zeros(TIMES[2], TIMES[3], gammas).unwrap();
            assert_eq!(zeros.len(), 2);
            let largest = zeros[0].value.norm().max(zeros[1].value.norm());
            for (zero, expected) in zeros.iter().zip(closed_form.as_slice()) {
                assert!((zero.value - expected).norm() <= 1e-12 * largest, "{gammas:?}: {zero:?} {expected}");
            }
        }
    }
}

#[test]
fn lags_realised_twice_are_no_zeros() {
    // Cocota 2009 realises each entry of G on its own, six states for four, and lists −1/T1 and −1/T2 as zeros too.
    let [t1, t2, t3, t4] = TIMES;
    let (gamma1, gamma2) = (0.7, 0.6);
    let a = DMatrix::from_row_slice(
        6,
        6,
        &[
            -1.0 / t1,
            0.0,
            0.0,
            0.0,
            0.0,
            0.0,
            0.0,
            -1.0 / t1,
            1.0 / t1,
            0.0,
            0.0,
            0.0,
            0.0,
            0.0,
            -1.0 / t3,
            0.0,
            0.0,
            0.0,
            0.0,
            0.0,
            0.0,
            -1.0 / t2,
            1.0 / t2,
            0.0,
            0.0,
            0.0,
            0.0,
            0.0,
            -1.0 / t4,
            0.0,
            0.0,
            0.0,
            0.0,
            0.0,
            0.0,
            -1.0 / t2,
        ],
    );
    let b = dmatrix![
        gamma1 / t1, 0.0; 0.0, 0.0; 0.0, (1.0 - gamma2) / t3; 0.0, 0.0; (1.0 - gamma1) / t4, 0.0; 0.0, gamma2 / t2
    ];
    let c = dmatrix![1.0, 1.0, 0.0, 0.0, 0.0, 0.0; 0.0, 0.0, 0.0, 1.0, 0.0, 1.0];
    let zeros = transmission_zeros(&StateSpace::strictly_proper(a, b, c).unwrap()).unwrap();
    let expected = quadruple::zeros(t3, t4, [gamma1, gamma2]).unwrap();
    assert_eq!(zeros.len(), 2);
    for (zero, expected) in zeros.iter().zip(expected.as_slice()) {
        close("six states", "zero", zero.value.re, *expected);
    }
}

#[test]
fn directions_at_the_printed_levels_of_johansson() {
    // Johansson 2000, P− at the printed levels: T = 62.70, 90.34, 23.89, 29.99 s; directions to three digits.
    let model = quadruple_tank([62.70, 90.34, 23.89, 29.99], [0.70, 0.60]);
    let zeros = transmission_zeros(&model).unwrap();
    for (zero, expected) in zeros.iter().zip([[0.413, 0.911], [-0.154, 0.988]]) {
        for (entry, expected) in zero.output_direction.iter().zip(expected) {
            assert!((entry.re - expected).abs() <= 1e-3, "{zero:?}");
        }
    }
}
