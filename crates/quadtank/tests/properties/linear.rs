//! Properties of the rooms `linear` and `interaction` over random models, with faer as an independent oracle.

use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use quadtank::interaction::{niederlinski, recommend_pairing, relative_gain_array, relative_gain_array_at};
use quadtank::linear::{
    Complex, LinearError, StateSpace, TransmissionZero, eigenvalues, singular_values, transmission_zeros,
};

/// A random matrix with entries in ±1. It is not simplified towards 0, where it would lose its rank.
fn matrix(rows: usize, columns: usize) -> impl Strategy<Value = DMatrix<f64>> {
    let entries = prop::collection::vec(-1.0..1.0_f64, rows * columns);
    entries.prop_map(move |v| DMatrix::from_vec(rows, columns, v)).no_shrink()
}

/// A random matrix many entries of which are exactly 0 or ±1, so that ranks drop.
fn sparse(rows: usize, columns: usize) -> impl Strategy<Value = DMatrix<f64>> {
    let entry = prop_oneof![4 => Just(0.0), 1 => Just(1.0), 1 => Just(-1.0), 2 => -1.0..1.0_f64];
    prop::collection::vec(entry, rows * columns).prop_map(move |v| DMatrix::from_vec(rows, columns, v))
}

/// A square model with n states and m inputs and outputs, with or without D.
fn model(n: usize, m: usize) -> impl Strategy<Value = StateSpace> {
    (matrix(n, n), matrix(n, m), matrix(m, n), matrix(m, m), any::<bool>()).prop_map(|(a, b, c, d, direct)| {
        let d = if direct { d } else { d * 0.0 };
        StateSpace::new(a, b, c, d).unwrap()
    })
}

/// A square model of any size whose normal rank is full: with D = 0 that takes as many states as inputs.
fn any_model() -> impl Strategy<Value = StateSpace> {
    (1..=8_usize, 1..=3_usize)
        .prop_flat_map(|(n, m)| model(n, m))
        .prop_filter("full normal rank", |model| model.order() >= model.inputs() || model.d.norm() > 0.0)
}

fn sparse_model() -> impl Strategy<Value = StateSpace> {
    (1..=8_usize, 1..=3_usize).prop_flat_map(|(n, m)| {
        (sparse(n, n), sparse(n, m), sparse(m, n), sparse(m, m))
            .prop_map(|(a, b, c, d)| StateSpace::new(a, b, c, d).unwrap())
    })
}

/// The residual of a direction in the pencil `[A − zI, B; C, D]`, relative to the size of the pencil: the distance of the
/// nearest singular pencil with the given input direction. Small exactly when z is a zero with that direction.
fn residual(model: &StateSpace, z: Complex, direction: &DVector<Complex>) -> f64 {
    let (n, m) = (model.order(), model.inputs());
    let mut top = model.a.map(Complex::from);
    for i in 0..n {
        top[(i, i)] -= z;
    }
    // The state that goes with u: the least-squares solution of [A − zI; C] x = −[B; D] u.
    let mut left = DMatrix::zeros(n + m, n);
    left.rows_mut(0, n).copy_from(&top);
    left.rows_mut(n, m).copy_from(&model.c.map(Complex::from));
    let mut right = DVector::zeros(n + m);
    right.rows_mut(0, n).copy_from(&(model.b.map(Complex::from) * direction));
    right.rows_mut(n, m).copy_from(&(model.d.map(Complex::from) * direction));
    let size = left.norm() + model.b.norm() + model.d.norm();
    let (q, r) = left.clone().qr().unpack();
    let state = -r.solve_upper_triangular(&(q.adjoint() * &right)).unwrap();
    let error = &left * &state + right;
    error.norm() / (size * (state.norm_squared() + 1.0).sqrt())
}

fn assert_directions(model: &StateSpace, zero: &TransmissionZero, tolerance: f64) -> Result<(), TestCaseError> {
    let input = residual(model, zero.value, &zero.input_direction);
    let output = residual(&model.dual(), zero.value, &zero.output_direction);
    prop_assert!(input <= tolerance && output <= tolerance, "{zero:?}: residuals {input:e}, {output:e}");
    for direction in [&zero.input_direction, &zero.output_direction] {
        prop_assert!((direction.norm() - 1.0).abs() < 1e-12);
    }
    Ok(())
}

/// Finite zeros by an independent route: the generalised eigenvalues of the pencil, by faer's QZ.
fn zeros_by_qz(model: &StateSpace) -> Vec<Complex> {
    let (n, size) = (model.order(), model.order() + model.inputs());
    let pencil = faer::Mat::from_fn(size, size, |i, j| match (i < n, j < n) {
        (true, true) => model.a[(i, j)],
        (true, false) => model.b[(i, j - n)],
        (false, true) => model.c[(i - n, j)],
        (false, false) => model.d[(i - n, j - n)],
    });
    let identity = faer::Mat::from_fn(size, size, |i, j| f64::from(u8::from(i == j && i < n)));
    let decomposition = pencil.generalized_eigen(&identity).unwrap();
    let (alpha, beta) = (decomposition.S_a(), decomposition.S_b());
    let pairs = (0..size).map(|i| (alpha.column_vector()[i], beta.column_vector()[i]));
    pairs
        .filter(|(alpha, beta)| beta.norm() > 1e-7 * alpha.norm())
        .map(|(alpha, beta)| Complex::new(alpha.re, alpha.im) / Complex::new(beta.re, beta.im))
        .collect()
}

/// Farthest zero that is compared with QZ.
const FARTHEST: f64 = 1e4;

/// Distance from a value to the nearest of a set.
fn nearest(values: &[Complex], value: Complex) -> f64 {
    values.iter().map(|other| (other - value).norm()).fold(f64::INFINITY, f64::min)
}

/// How far an eigenvalue moves when its matrix is disturbed by one rounding error, from the spread of the others.
fn separation(values: &[Complex], i: usize) -> f64 {
    let others = values.iter().enumerate().filter(|(j, _)| *j != i);
    others.map(|(_, other)| (other - values[i]).norm()).fold(1.0, f64::min)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn poles_agree_with_faer(a in (1..=8_usize).prop_flat_map(|n| matrix(n, n))) {
        let values = eigenvalues(&a).unwrap();
        let oracle = faer::Mat::from_fn(a.nrows(), a.nrows(), |i, j| a[(i, j)]).eigenvalues().unwrap();
        let oracle: Vec<Complex> = oracle.iter().map(|v| Complex::new(v.re, v.im)).collect();
        prop_assert_eq!(values.len(), oracle.len());
        for (i, value) in values.iter().enumerate() {
            let tolerance = 1e-11 / separation(&values, i).powi(2);
            prop_assert!(nearest(&oracle, *value) <= tolerance, "{value} not among {oracle:?}");
        }
        for value in &values {
            let shifted = a.map(Complex::from) - DMatrix::from_diagonal_element(a.nrows(), a.nrows(), *value);
            let backward_error = singular_values(&shifted).unwrap().pop().unwrap();
            prop_assert!(backward_error <= 1e-14 * a.norm(), "{value}: {backward_error:e}");
        }
        let trace: Complex = values.iter().sum();
        prop_assert!((trace - a.trace()).norm() < 1e-12);
        let determinant: Complex = values.iter().product();
        prop_assert!((determinant - a.determinant()).norm() < 1e-11);
        for pair in values.windows(2) {
            prop_assert!(pair[0].re <= pair[1].re);
        }
    }

    #[test]
    fn singular_values_agree_with_faer(a in (1..=5_usize, 1..=5_usize).prop_flat_map(|(p, m)| matrix(p, m))) {
        let values = singular_values(&a).unwrap();
        let oracle = faer::Mat::from_fn(a.nrows(), a.ncols(), |i, j| a[(i, j)]).singular_values().unwrap();
        prop_assert_eq!(values.len(), oracle.len());
        for (value, expected) in values.iter().zip(&oracle) {
            prop_assert!((value - expected).abs() <= 1e-14 * oracle[0], "{values:?} {oracle:?}");
        }
    }

    #[test]
    fn zeros_annihilate_their_directions(model in any_model()) {
        for zero in transmission_zeros(&model).unwrap() {
            assert_directions(&model, &zero, 1e-11)?;
        }
    }

    #[test]
    fn at_a_zero_the_gain_loses_rank(model in any_model()) {
        for zero in transmission_zeros(&model).unwrap() {
            let Ok(gain) = model.gain_at(zero.value) else { continue };
            let poles = model.poles().unwrap();
            let distance = nearest(&poles, zero.value);
            prop_assume!(distance > 1e-3);
            // G varies over 1/distance; rounding in z and in the resolvent grows with the size of z.
            let tolerance = 1e-9 * (gain.norm() + model.c.norm() * model.b.norm() / distance.powi(2)) * (1.0 + zero.value.norm());
            prop_assert!((&gain * &zero.input_direction).norm() <= tolerance);
            prop_assert!((gain.transpose() * &zero.output_direction).norm() <= tolerance);
        }
    }

    #[test]
    fn zeros_agree_with_a_generalised_eigenvalue_problem(model in any_model()) {
        let zeros = transmission_zeros(&model).unwrap();
        let (n, m) = (model.order(), model.inputs());
        let generic = if model.d.norm() > 0.0 { n } else { n.saturating_sub(m) };
        prop_assert_eq!(zeros.len(), generic);
        let oracle = zeros_by_qz(&model);
        let values: Vec<Complex> = zeros.iter().map(|zero| zero.value).collect();
        // Where CB is almost singular QZ no longer tells a far zero from an infinite one, and its own error is larger than any
        // tolerance that would mean something; such a zero is held to its directions alone, in the tests above.
        for (i, value) in values.iter().enumerate().filter(|(_, value)| value.norm() < FARTHEST) {
            let tolerance = 1e-8 * (1.0 + value.norm()).powi(2) / separation(&values, i).powi(2);
            prop_assert!(nearest(&oracle, *value) <= tolerance, "{value} not among {oracle:?}");
        }
    }

    #[test]
    fn a_zero_built_in_is_found(model in any_model(), z in -2.0..2.0_f64, column in 0..3_usize) {
        // Post-multiplying G by (s − z)/(s + 3) in one channel adds the zero z and the pole −3.
        let (n, m) = (model.order(), model.inputs());
        let channel = column % m;
        let select = DVector::from_fn(m, |i, _| f64::from(u8::from(i == channel)));
        let mut a = DMatrix::zeros(n + 1, n + 1);
        a.view_mut((0, 0), (n, n)).copy_from(&model.a);
        a.view_mut((0, n), (n, 1)).copy_from(&(&model.b * &select));
        a[(n, n)] = -3.0;
        let mut b = DMatrix::zeros(n + 1, m);
        b.view_mut((0, 0), (n, m)).copy_from(&model.b);
        b[(n, channel)] = -3.0 - z;
        let mut c = DMatrix::zeros(m, n + 1);
        c.view_mut((0, 0), (m, n)).copy_from(&model.c);
        c.view_mut((0, n), (m, 1)).copy_from(&(&model.d * &select));
        let with_zero = StateSpace::new(a, b, c, model.d.clone()).unwrap();
        let values: Vec<Complex> = transmission_zeros(&with_zero).unwrap().iter().map(|zero| zero.value).collect();
        let before = transmission_zeros(&model).unwrap();
        prop_assert_eq!(values.len(), before.len() + 1);
        let largest = values.iter().map(|v| v.norm()).fold(1.0, f64::max);
        let alone = before.iter().map(|zero| (zero.value - z).norm()).fold(1.0, f64::min);
        let tolerance = 1e-9 * largest.powi(2) / alone.powi(2);
        prop_assert!(nearest(&values, Complex::from(z)) <= tolerance, "{z} not among {values:?}");
    }

    #[test]
    fn singular_plants_are_told_apart(
        (first, second) in (3..=5_usize, 2..=3_usize).prop_flat_map(|(n, m)| (model(n, m), matrix(m, m))),
        less in 1..=3_usize,
    ) {
        // G(s) K with K of lower rank is singular at every s.
        let m = first.inputs();
        let rank = m.saturating_sub(less);
        let values = second.svd(true, true);
        let mut kept = values.singular_values.clone();
        kept.rows_mut(rank, m - rank).fill(0.0);
        prop_assume!(rank == 0 || kept[rank - 1] > 1e-3);
        let squeeze = values.u.unwrap() * DMatrix::from_diagonal(&kept) * values.v_t.unwrap();
        let plant = StateSpace::new(first.a, first.b * &squeeze, first.c, first.d * squeeze).unwrap();
        prop_assert_eq!(transmission_zeros(&plant), Err(LinearError::DegenerateRank { rank, size: m }));
        prop_assert_eq!(plant.normal_rank(), Ok(rank));
    }

    #[test]
    fn sparse_models_have_as_many_zeros_as_theory_allows(model in sparse_model()) {
        let rank = generic_rank(&model);
        prop_assert_eq!(model.normal_rank(), Ok(rank));
        match transmission_zeros(&model) {
            Ok(zeros) => {
                prop_assert_eq!(rank, model.inputs());
                prop_assert!(zeros.len() <= model.order());
                let poles = model.poles().unwrap();
                // A mode that G does not show may have the value of a zero; the pencil of all states then says nothing.
                for zero in zeros.into_iter().filter(|zero| nearest(&poles, zero.value) > 1e-3) {
                    assert_directions(&model, &zero, 1e-5)?;
                }
            }
            Err(error) => prop_assert_eq!(error, LinearError::DegenerateRank { rank, size: model.inputs() }),
        }
    }

    #[test]
    fn units_change_no_zero(model in model(4, 2), units in prop::collection::vec(-6..6_i32, 8), rate in -4..4_i32) {
        let ten = |k: i32| 10.0_f64.powi(k);
        let states = DMatrix::from_diagonal(&DVector::from_fn(4, |i, _| ten(units[i])));
        let inverse = DMatrix::from_diagonal(&DVector::from_fn(4, |i, _| ten(-units[i])));
        let inputs = DMatrix::from_diagonal(&DVector::from_fn(2, |i, _| ten(units[4 + i])));
        let outputs = DMatrix::from_diagonal(&DVector::from_fn(2, |i, _| ten(units[6 + i])));
        let scaled = StateSpace::new(
            &inverse * &model.a * &states * ten(rate),
            &inverse * &model.b * &inputs * ten(rate),
            &outputs * &model.c * &states,
            &outputs * &model.d * &inputs,
        ).unwrap();
        let (plain, scaled) = (transmission_zeros(&model).unwrap(), transmission_zeros(&scaled).unwrap());
        prop_assert_eq!(plain.len(), scaled.len());
        let values: Vec<Complex> = plain.iter().map(|zero| zero.value).collect();
        for zero in &scaled {
            let value = zero.value / ten(rate);
            let i = (0..values.len()).min_by(|i, j| (values[*i] - value).norm().total_cmp(&(values[*j] - value).norm())).unwrap();
            let tolerance = 1e-9 * (1.0 + value.norm()).powi(3) / separation(&values, i).powi(2);
            prop_assert!((values[i] - value).norm() <= tolerance, "{value} not among {values:?}");
        }
    }

    #[test]
    fn rows_and_columns_of_the_relative_gain_array_sum_to_one(gain in (1..=4_usize).prop_flat_map(|m| matrix(m, m))) {
        let condition = reciprocal_condition(&gain);
        prop_assume!(condition > 1e-4);
        let array = relative_gain_array(&gain).unwrap();
        for i in 0..gain.nrows() {
            prop_assert!((array.row(i).sum() - 1.0).abs() < 1e-10 / condition);
            prop_assert!((array.column(i).sum() - 1.0).abs() < 1e-10 / condition);
        }
        if gain.nrows() == 2 {
            let [diagonal, swapped] = niederlinski(&gain);
            // For two loops the index of a pairing is 1/λ of its loops.
            prop_assert!((diagonal.unwrap() * array[(0, 0)] - 1.0).abs() < 1e-9 / condition);
            prop_assert!((swapped.unwrap() * array[(0, 1)] - 1.0).abs() < 1e-9 / condition);
        }
    }

    #[test]
    fn the_dynamic_array_sums_to_one_and_ignores_units(model in model(4, 2), w in 0.01..10.0_f64, unit in 1e-6..1e6_f64) {
        let condition = model.singular_values(w).unwrap();
        prop_assume!(condition[1] > 1e-4 * condition[0]);
        let array = relative_gain_array_at(&model, w).unwrap();
        for i in 0..2 {
            prop_assert!((array.row(i).sum() - 1.0).norm() < 1e-8);
            prop_assert!((array.column(i).sum() - 1.0).norm() < 1e-8);
        }
        let mut other_units = model.clone();
        other_units.b.column_mut(0).scale_mut(unit);
        other_units.d.column_mut(0).scale_mut(unit);
        let same = relative_gain_array_at(&other_units, w).unwrap();
        prop_assert!((array - same).norm() < 1e-8);
    }

    #[test]
    fn steady_state_gain_is_the_response_at_zero_frequency(model in any_model()) {
        let poles = model.poles().unwrap();
        prop_assume!(nearest(&poles, Complex::ZERO) > 1e-3);
        let (at_rest, response) = (model.dc_gain().unwrap(), model.frequency_response(0.0).unwrap());
        let size = model.d.norm() + model.c.norm() * model.b.norm() / reciprocal_condition(&model.a);
        prop_assert!((at_rest.map(Complex::from) - response).norm() <= 1e-12 * size);
    }

    #[test]
    fn sampling_agrees_with_a_taylor_series_over_short_steps(model in any_model(), sampling_time in 0.01..5.0_f64) {
        let sampled = model.sampled(sampling_time).unwrap();
        let (phi, gamma) = refined(&model, sampling_time);
        prop_assert!((&sampled.a - &phi).norm() <= 1e-11 * phi.norm().max(1.0));
        prop_assert!((&sampled.b - &gamma).norm() <= 1e-11 * gamma.norm().max(1.0));
    }

    #[test]
    fn two_samples_make_one_of_twice_the_length(model in any_model(), sampling_time in 0.01..2.0_f64) {
        let (one, two) = (model.sampled(sampling_time).unwrap(), model.sampled(2.0 * sampling_time).unwrap());
        let (a, b) = (&one.a * &one.a, &one.a * &one.b + &one.b);
        prop_assert!((&two.a - &a).norm() <= 1e-12 * a.norm().max(1.0));
        prop_assert!((&two.b - &b).norm() <= 1e-12 * b.norm().max(1.0));
    }

    #[test]
    fn wild_models_give_numbers_or_errors(
        a in wild(3, 3), b in wild(3, 2), c in wild(2, 3), d in wild(2, 2), w in wild_entry()
    ) {
        let model = StateSpace { a, b, c, d };
        let finite = [&model.a, &model.b, &model.c, &model.d].iter().all(|m| m.iter().all(|x| x.is_finite()));
        let number = |x: &Complex| x.re.is_finite() && x.im.is_finite();
        match transmission_zeros(&model) {
            Ok(zeros) => {
                prop_assert!(finite);
                for zero in zeros {
                    prop_assert!(number(&zero.value));
                    prop_assert!(zero.input_direction.iter().all(number) && zero.output_direction.iter().all(number));
                }
            }
            Err(LinearError::DegenerateRank { rank, size }) => prop_assert!(finite && rank < size),
            Err(error) => prop_assert_eq!(error, LinearError::NoConvergence { size: 3 }),
        }
        if let Ok(poles) = model.poles() {
            prop_assert!(poles.iter().all(number));
        }
        if let Ok(gain) = model.dc_gain() {
            prop_assert!(gain.iter().all(|g| g.is_finite()));
            let _ = niederlinski(&gain);
            let _ = recommend_pairing(&gain);
            if let Ok(array) = relative_gain_array(&gain) {
                prop_assert!(array.iter().all(|g| g.is_finite()));
            }
        }
        if let Ok(values) = model.singular_values(w) {
            prop_assert!(values.iter().all(|value| value.is_finite()) && values[0] >= values[1]);
        }
        if let Ok(array) = relative_gain_array_at(&model, w) {
            prop_assert!(array.iter().all(number));
        }
        if let Ok(sampled) = model.sampled(w) {
            prop_assert!(sampled.a.iter().chain(sampled.b.iter()).all(|x| x.is_finite()));
        }
        if let Ok(rank) = model.normal_rank() {
            prop_assert!(finite && rank <= 2);
        }
    }

    #[test]
    fn sizes_that_do_not_fit_are_errors(sizes in prop::collection::vec(0..4_usize, 8)) {
        let zeros = |i: usize| DMatrix::from_element(sizes[i], sizes[i + 1], 1.0);
        let (a, b, c, d) = (zeros(0), zeros(2), zeros(4), zeros(6));
        let fits = sizes[0] == sizes[1] && sizes[2] == sizes[0] && sizes[5] == sizes[0]
            && sizes[6] == sizes[4] && sizes[7] == sizes[3];
        prop_assert_eq!(StateSpace::new(a.clone(), b.clone(), c.clone(), d.clone()).is_ok(), fits);
        let model = StateSpace { a, b, c, d };
        if !fits {
            let errors = [
                transmission_zeros(&model).err(), model.frequency_response(1.0).err(), model.sampled(1.0).err(),
                model.dc_gain().err(), model.normal_rank().err(), model.poles().err(),
            ];
            let dimension = |error: &Option<LinearError>| matches!(error, Some(LinearError::Dimension { .. }));
            prop_assert!(errors.iter().all(dimension), "{:?}", errors);
        }
        if fits {
            let _ = (transmission_zeros(&model), model.dc_gain(), model.singular_values(1.0), model.sampled(1.0));
            let _ = (relative_gain_array_at(&model, 1.0), model.normal_rank(), model.poles());
        }
    }
}

/// Numbers that no plant has.
fn wild_entry() -> impl Strategy<Value = f64> {
    prop_oneof![
        6 => -1.0..1.0_f64,
        3 => Just(0.0),
        3 => (-12..=12_i32, -1.0..1.0_f64).prop_map(|(k, x)| x * 10.0_f64.powi(k)),
        1 => prop::sample::select(vec![1e-300, 1e300, -1e300, f64::MAX, f64::MIN_POSITIVE, 5e-324]),
    ]
}

/// A matrix of them; one in four has an entry that is not finite.
fn wild(rows: usize, columns: usize) -> impl Strategy<Value = DMatrix<f64>> {
    let infinite = prop::sample::select(vec![f64::INFINITY, f64::NEG_INFINITY, f64::NAN]);
    (prop::collection::vec(wild_entry(), rows * columns), 0..rows * columns, prop::option::weighted(0.1, infinite))
        .prop_map(move |(mut entries, i, infinite)| {
            if let Some(infinite) = infinite {
                entries[i] = infinite;
            }
            DMatrix::from_vec(rows, columns, entries)
        })
}

fn reciprocal_condition(matrix: &DMatrix<f64>) -> f64 {
    let values = matrix.singular_values();
    values.min() / values.max()
}

/// Normal rank by another route: the largest rank of G at some points of the s-plane that no model knows.
fn generic_rank(model: &StateSpace) -> usize {
    let points = [Complex::new(0.7431, 1.9127), Complex::new(-1.3717, 2.6311), Complex::new(2.2379, -0.5113)];
    let rank = |s: &Complex| {
        let values = singular_values(&model.gain_at(*s).unwrap()).unwrap();
        values.iter().filter(|value| **value > 1e-10).count()
    };
    points.iter().map(rank).max().unwrap()
}

/// Φ and Γ from a Taylor series over a thousandth of the step, repeated.
fn refined(model: &StateSpace, sampling_time: f64) -> (DMatrix<f64>, DMatrix<f64>) {
    let (n, m) = (model.order(), model.inputs());
    let mut generator = DMatrix::zeros(n + m, n + m);
    generator.view_mut((0, 0), (n, n)).copy_from(&model.a);
    generator.view_mut((0, n), (n, m)).copy_from(&model.b);
    generator *= sampling_time / 1000.0;
    let mut step = DMatrix::identity(n + m, n + m);
    let mut term = step.clone();
    for k in 1..=12 {
        term = &term * &generator / f64::from(k);
        step += &term;
    }
    let all = (0..1000).fold(DMatrix::identity(n + m, n + m), |product, _| product * &step);
    (all.view((0, 0), (n, n)).into_owned(), all.view((0, n), (n, m)).into_owned())
}
