use approx::assert_relative_eq;

use super::*;

#[test]
fn the_three_forms_are_one_controller() {
    let series = SeriesPid { gain: 2.0, integral_time: 5.0, derivative_time: 1.25 };
    let isa = IsaPid::from(series);
    let w = 0.8;
    let s = Complex::new(0.0, w);
    let expected = ((s * 5.0).inv() + 1.0) * (s * 1.25 + 1.0) * 2.0;
    assert_relative_eq!((isa.ideal_at(w) - expected).norm(), 0.0, epsilon = 1e-14);
    assert_relative_eq!((ParallelPid::from(isa).ideal_at(w) - expected).norm(), 0.0, epsilon = 1e-14);
    let back = SeriesPid::from_isa(isa).unwrap();
    assert_relative_eq!(back.integral_time, 5.0, max_relative = 1e-14);
    assert_relative_eq!(back.derivative_time, 1.25, max_relative = 1e-14);
    assert_relative_eq!(back.gain, 2.0, max_relative = 1e-14);
    assert_eq!(SeriesPid::from_isa(IsaPid { gain: 1.0, integral_time: 3.9, derivative_time: 1.0 }), None);
    // Ti = 4 Td, as rules have it, in any rounding: both times of the series form are half of Ti.
    for k in 1..1000 {
        let derivative_time = f64::from(k) * 0.037;
        let pid = ParallelPid::from(IsaPid { gain: 0.3, integral_time: 4.0 * derivative_time, derivative_time });
        let series = IsaPid::from_parallel(pid).and_then(SeriesPid::from_isa).unwrap();
        assert_relative_eq!(series.derivative_time, 2.0 * derivative_time, max_relative = 1e-4);
    }
    let again = IsaPid::from_parallel(ParallelPid::from(isa)).unwrap();
    assert_relative_eq!(again.integral_time, isa.integral_time, max_relative = 1e-14);
}

#[test]
fn a_sampled_controller_is_what_it_is_at_low_frequency() {
    let pid = ParallelPid { proportional: 2.0, integral: 0.5, derivative: 3.0, ..ParallelPid::default() };
    let ts = 1e-3;
    let mut running = PidMatrix::decentralised([pid, pid]).start(ts);
    // A ramp e = t: kp t + ki t²/2 + kd.
    let mut output = [0.0; 2];
    for k in 0..=4000 {
        output = running.step([f64::from(k) * ts, 0.0]);
    }
    assert_relative_eq!(output[0], 2.0 * 4.0 + 0.5 * 8.0 + 3.0, max_relative = 1e-6);
    assert_eq!(output[1], 0.0);
}

#[test]
fn a_decoupler_adds_what_the_other_loop_does() {
    let p = |proportional| ParallelPid { proportional, ..ParallelPid::default() };
    let mut running = PidMatrix::decoupled([p(2.0), p(-3.0)], [0.5, 0.25]).start(1.0);
    assert_eq!(running.step([1.0, 1.0]), [2.0 - 1.5, -3.0 + 0.5]);
}

#[test]
fn a_derivative_is_filtered_a_hundred_times_quicker_than_it_acts() {
    let pid = ParallelPid { proportional: -2.0, integral: 0.5, derivative: 3.0, ..ParallelPid::default() };
    assert_relative_eq!(pid.filter_time(), 0.015, max_relative = 1e-15);
    assert_eq!(ParallelPid { derivative: 0.0, ..pid }.filter_time(), 0.0);
    assert_eq!(ParallelPid { proportional: 0.0, ..pid }.filter_time(), 0.0);
    assert_eq!(ParallelPid { filter: Some(0.3), ..pid }.filter_time(), 0.3);
    let s = Complex::new(0.0, 4.0);
    let expected = s.inv() * 0.5 + s * 3.0 / (s * 0.015 + 1.0) - 2.0;
    assert_relative_eq!((pid.at(4.0) - expected).norm(), 0.0, epsilon = 1e-14);
    let ideal = s.inv() * 0.5 + s * 3.0 - 2.0;
    assert_relative_eq!((pid.ideal_at(4.0) - ideal).norm(), 0.0, epsilon = 1e-14);
}

#[test]
fn a_sampled_controller_steps_as_by_hand() {
    let pid = ParallelPid { proportional: 2.0, integral: 0.5, derivative: 100.0, ..ParallelPid::default() };
    let mut running = PidMatrix::decentralised([ParallelPid::default(), pid]).start(0.25);
    // Tf = 0.5: the derivative starts at 100/(0.5 + 0.25) and falls to 0.5/(0.5 + 0.25) of itself; half of the first
    // sample of the integral counts.
    let outputs = [0; 3].map(|_| running.step([0.0, 1.0])[1]);
    let derivative = [0, 1, 2].map(|k| 100.0 / 0.75 * (2.0_f64 / 3.0).powi(k));
    let integral = [0.0625, 0.1875, 0.3125];
    for k in 0..3 {
        assert_relative_eq!(outputs[k], 2.0 + integral[k] + derivative[k], max_relative = 1e-14);
    }
}

#[test]
fn a_series_controller_has_the_isa_form_of_eq_11() {
    let isa = IsaPid::from(SeriesPid { gain: 3.0, integral_time: 6.0, derivative_time: 2.0 });
    assert_eq!(isa, IsaPid { gain: 4.0, integral_time: 8.0, derivative_time: 1.5 });
}

#[test]
fn a_detuned_controller_is_weaker_and_slower() {
    let isa = IsaPid { gain: 3.0, integral_time: 8.0, derivative_time: 2.0 };
    let expected = IsaPid { gain: 2.0, integral_time: 12.0, derivative_time: 3.0 };
    assert_eq!(isa.detuned(1.5), expected);
}

#[test]
fn what_has_no_other_form_is_none() {
    let pid = ParallelPid { proportional: 2.0, derivative: 3.0, ..ParallelPid::default() };
    let isa = IsaPid::from_parallel(pid).unwrap();
    assert_eq!((isa.integral_time, isa.derivative_time), (f64::INFINITY, 1.5));
    assert_eq!(SeriesPid::from_isa(isa), None);
    assert_eq!(IsaPid::from_parallel(ParallelPid { proportional: 0.0, ..pid }), None);
}

#[test]
fn controllers_between_matrices_are_a_product_of_matrices() {
    let (a, b) = (Matrix2::new(1.0, 2.0, -3.0, 5.0), Matrix2::new(0.5, -1.5, 4.0, 6.0));
    let matrix = PidMatrix::between(&a, [(2.0, 0.5), (-3.0, 0.25)], &b);
    let s = Complex::new(0.0, 0.3);
    let diagonal = Matrix2::new(s.inv() * 0.5 + 2.0, Complex::ZERO, Complex::ZERO, s.inv() * 0.25 - 3.0);
    let expected = a.map(Complex::from) * diagonal * b.map(Complex::from);
    assert_relative_eq!((matrix.at(0.3) - expected).norm(), 0.0, epsilon = 1e-12);
    assert_eq!(matrix.integral()[(1, 0)], matrix.0[1][0].integral);
}

#[test]
fn a_decoupler_stands_behind_the_filters_of_the_controllers() {
    let pid = |proportional, derivative, filter| ParallelPid { proportional, integral: 0.5, derivative, filter };
    let pids = [pid(2.0, 3.0, None), pid(-3.0, 7.0, Some(0.4))];
    let decoupler = Matrix2::new(1.0, 0.0, -0.5, 1.0).map(Complex::from);
    let [first, second] = pids.map(|pid| pid.at(0.3));
    let expected = decoupler * Matrix2::new(first, Complex::ZERO, Complex::ZERO, second);
    assert_relative_eq!((PidMatrix::decoupled(pids, [0.0, -0.5]).at(0.3) - expected).norm(), 0.0, epsilon = 1e-12);
}

#[test]
fn integrators_are_counted_by_the_rank_of_the_integral_gains() {
    let matrix = |gains: [[f64; 2]; 2]| {
        PidMatrix(gains.map(|row| row.map(|integral| ParallelPid { integral, ..ParallelPid::default() })))
    };
    assert_eq!(matrix([[0.0; 2]; 2]).integrators(), 0);
    assert_eq!(matrix([[1e-3, 2e-3], [3e-3, 6e-3]]).integrators(), 1);
    assert_eq!(matrix([[1e3, 0.0], [0.0, 0.0]]).integrators(), 1);
    for size in [1e-6, 1.0, 1e6] {
        assert_eq!(matrix([[size, 0.0], [0.0, 1e-9 * size]]).integrators(), 2, "{size}");
        assert_eq!(matrix([[size, size], [size, size * (1.0 + 2.0 * f64::EPSILON)]]).integrators(), 1, "{size}");
    }
}
