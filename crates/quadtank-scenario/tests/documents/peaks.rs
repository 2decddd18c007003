//! Largest sensitivity and biggest log modulus of random loops against brute force.

use nalgebra::Matrix2;
use num_complex::Complex64;
use quadtank::control::PidMatrix;
use quadtank::tuning::Design;

use super::margins::{Loop, Random};

/// Frequencies in each factor of e, and times that the neighbourhood of the highest is divided by three.
const PER_E: f64 = 200.0;
const REFINEMENTS: usize = 40;

/// |W/(1 + W)| with 1 + W = det(I + L).
fn modulus(ratio: &Matrix2<Complex64>) -> f64 {
    (1.0 - 1.0 / (Matrix2::identity() + ratio).determinant()).norm()
}

/// Largest singular value of (I + L)⁻¹.
fn sensitivity(ratio: &Matrix2<Complex64>) -> f64 {
    let inverse = (Matrix2::identity() + ratio).try_inverse().unwrap();
    let squares = inverse.adjoint() * inverse;
    let (mean, product) = (squares.trace().re / 2.0, squares.determinant().re);
    (mean + (mean * mean - product).max(0.0).sqrt()).sqrt()
}

/// The largest value on a dense grid, refined around its highest points; the turns of dead times ask for a denser one at high
/// frequencies, where the loop is small.
fn highest(of: &Loop, at: fn(&Matrix2<Complex64>) -> f64) -> f64 {
    let value = |w: f64| at(&of.ratio(w));
    let longest = of.elements().map(|element| element.dead_time).fold(0.0, f64::max);
    let mut best = (0.0_f64, 0.0, 0.0);
    let mut w = 1e-6;
    while w < 1e4 {
        let step = (w / PER_E).min(0.02 / longest);
        let found = value(w);
        if found > best.0 {
            best = (found, (w - step).max(1e-9), w + step);
        }
        let size = of.ratio(w).iter().map(|x| x.norm()).sum::<f64>();
        if size < 0.02 && w > 1.0 {
            break;
        }
        w += step;
    }
    let (mut highest, mut low, mut high) = best;
    for _ in 0..REFINEMENTS {
        let third = (high - low) / 3.0;
        let [left, right] = [low + third, high - third].map(value);
        highest = highest.max(left).max(right);
        if left > right { high -= third } else { low += third }
    }
    highest
}

#[test]
fn peaks_of_8_random_loops_are_those_of_a_brute_force_search() {
    let mut random = Random(3);
    for number in 0..8 {
        let of = Loop::random(&mut random);
        let plant = of.transfer_matrix();
        let design = Design::new(&plant, PidMatrix::decentralised(of.controllers)).unwrap();
        let found = [design.largest_sensitivity(), design.biggest_log_modulus()].map(|peak| peak.unwrap().value);
        let exact = [highest(&of, sensitivity).max(1.0), 20.0 * highest(&of, modulus).log10()];
        // One part in ten thousand, that is 0.0009 dB, beside what the grid leaves.
        assert!((found[0] / exact[0] - 1.0).abs() < 3e-4, "{number}: {found:?} is not {exact:?} of {of:?}");
        assert!((found[1] - exact[1]).abs() < 3e-3, "{number}: {found:?} is not {exact:?} of {of:?}");
    }
}
