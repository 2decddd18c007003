use nalgebra::Matrix2;

use crate::control::ParallelPid;
use crate::linear::Complex;
use crate::numeric::square_root;

/// What the two controllers have to be at the frequency of the critical point: p1 and p2.
pub type ControllerPair = [Complex; 2];

/// Method A: one characteristic locus of `G diag(p1, p2)` passes through λ, with `p2 = α p1` (Campestrini 2006, eq. 104).
///
/// `g` is G(jωc), `ratio` is α; equal importance of the loops is α = g11(0)/g22(0) (eq. 103). Both roots of
/// `α (g12 g21 − g11 g22) p1² + λ (g11 + α g22) p1 − λ² = 0`, the one with the larger p1 first. The source takes the one
/// whose real part has the sign of g11(0); in the third quadrant both may have it, and only the loci tell. Not finite where
/// det G(jωc) = 0.
pub fn place_one_locus(g: &Matrix2<Complex>, target: Complex, ratio: f64) -> [ControllerPair; 2] {
    let a = (g[(0, 1)] * g[(1, 0)] - g[(0, 0)] * g[(1, 1)]) * ratio;
    let b = target * (g[(0, 0)] + g[(1, 1)] * ratio);
    let root = square_root(b * b + a * target * target * 4.0);
    larger_first([root, -root].map(|root| {
        let p1 = (root - b) / (a * 2.0);
        [p1, p1 * ratio]
    }))
}

/// Method B: both characteristic loci pass through λ (Campestrini 2006, eqs. 112–117).
///
/// With the dynamic relative gain `Λ11 = g11 g22/det G` at the frequency of `g`, the two roots are
/// `p1 = (λ/g11)(1 ± √(1 − Λ11))`, `p2 = (λ/g22)(1 ∓ √(1 − Λ11))`; the one with the larger p1 first. Without interaction
/// (Λ11 = 1) each loop is placed alone. λ is a double eigenvalue: the loci are sensitive there.
pub fn place_both_loci(g: &Matrix2<Complex>, target: Complex) -> [ControllerPair; 2] {
    let root = square_root(Complex::ONE - dynamic_relative_gain(g));
    larger_first([root, -root].map(|root| [target / g[(0, 0)] * (root + 1.0), target / g[(1, 1)] * (-root + 1.0)]))
}

/// `Λ11(jω) = g11 g22/det G`, the dynamic relative gain at a frequency: with method B, `p1 = (λ/g11)(1 ± √(1 − Λ11))`.
pub fn dynamic_relative_gain(g: &Matrix2<Complex>) -> Complex {
    let product = g[(0, 0)] * g[(1, 1)];
    product / (product - g[(0, 1)] * g[(1, 0)])
}

fn larger_first([one, other]: [ControllerPair; 2]) -> [ControllerPair; 2] {
    if one[0].norm() >= other[0].norm() { [one, other] } else { [other, one] }
}

impl ParallelPid {
    /// The PI controller that is `p` at a frequency: `kp = Re p`, `ki = −ω Im p` (Campestrini 2006, eqs. 105–109).
    pub fn pi_through(p: Complex, frequency: f64) -> Self {
        Self { proportional: p.re, integral: -frequency * p.im, ..Self::default() }
    }

    /// The PID controller with Td = Ti/4 that is `p` at a frequency: `kp = Re p`, and `x = Ti ω` is the positive root of
    /// `Re p x² − 4 Im p x − 4 Re p = 0` (Campestrini 2006, eq. 111). Its roots have the product −4, so one is positive.
    /// `None` without a proportional part, where Ti says nothing.
    pub fn pid_through(p: Complex, frequency: f64) -> Option<Self> {
        if p.re == 0.0 {
            return None;
        }
        let slope = 2.0 * p.im / p.re;
        let length = slope.hypot(2.0);
        // The positive root, without cancellation: the other one is −4 over it.
        let x = if slope < 0.0 { 4.0 / (length - slope) } else { length + slope };
        let integral_time = x / frequency;
        Some(Self {
            proportional: p.re,
            integral: p.re / integral_time,
            derivative: p.re * integral_time / 4.0,
            filter: None,
        })
    }
}

/// Whether two loops with integral action may be stable: `det(G(0) diag(ki1, ki2)) > 0` is necessary for it. A stable plant
/// with two proportional-integral loops that fail this has a real pole in the right half-plane.
pub fn integral_action_may_be_stable(dc_gain: &Matrix2<f64>, integral: [f64; 2]) -> bool {
    dc_gain.determinant() * integral[0] * integral[1] > 0.0
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    /// A G(jω) without symmetry, and a target in the third quadrant.
    fn example() -> (Matrix2<Complex>, Complex) {
        let c = Complex::new;
        (Matrix2::new(c(2.0, -1.0), c(0.3, 0.4), c(-0.7, 0.2), c(1.5, -0.6)), c(-0.6, -0.3))
    }

    /// Trace and determinant of `G diag(p1, p2)`: sum and product of its characteristic loci at the frequency of `g`.
    fn loci(g: &Matrix2<Complex>, [p1, p2]: ControllerPair) -> [Complex; 2] {
        let placed = g * Matrix2::from_diagonal(&nalgebra::Vector2::new(p1, p2));
        [placed.trace(), placed.determinant()]
    }

    #[test]
    fn one_locus_passes_through_the_target_with_the_ratio_asked_for() {
        let (g, target) = example();
        for ratio in [0.4, -2.5] {
            let [first, second] = place_one_locus(&g, target, ratio);
            assert!(first[0].norm() > second[0].norm());
            for pair in [first, second] {
                let [trace, determinant] = loci(&g, pair);
                assert!((target * target - target * trace + determinant).norm() < 1e-14);
                assert!((pair[1] - pair[0] * ratio).norm() < 1e-15);
            }
        }
    }

    #[test]
    fn both_loci_pass_through_the_target() {
        let (g, target) = example();
        let [first, second] = place_both_loci(&g, target);
        assert!(first[0].norm() > second[0].norm());
        for pair in [first, second] {
            let [trace, determinant] = loci(&g, pair);
            assert!((trace - target * 2.0).norm() < 1e-14 && (determinant - target * target).norm() < 1e-14);
        }
    }

    #[test]
    fn controllers_are_what_they_have_to_be_at_the_frequency() {
        let frequency = 0.7;
        for p in [(2.0, -0.5), (2.0, 3.0), (-1.5, 0.4), (-1.5, -4.0), (1.0, 0.0)].map(|(re, im)| Complex::new(re, im)) {
            let pi = ParallelPid::pi_through(p, frequency);
            assert!((pi.ideal_at(frequency) - p).norm() < 1e-14 && pi.derivative == 0.0);
            let pid = ParallelPid::pid_through(p, frequency).unwrap();
            assert!((pid.ideal_at(frequency) - p).norm() < 1e-14, "{p}");
            // Td = Ti/4, with a positive Ti.
            assert_relative_eq!(4.0 * pid.derivative * pid.integral, p.re * p.re, max_relative = 1e-14);
            assert!(pid.proportional == p.re && pid.integral / p.re > 0.0);
        }
        assert_eq!(ParallelPid::pid_through(Complex::new(0.0, 1.0), frequency), None);
        // The short root beside a long one keeps its digits: x = −Re p/Im p (1 − …) as Im p grows.
        let short = ParallelPid::pid_through(Complex::new(1e-8, -1.0), frequency).unwrap();
        assert_relative_eq!(short.proportional / short.integral * frequency, 1e-8, max_relative = 1e-12);
    }

    #[test]
    fn integral_action_has_to_have_the_sign_of_the_plant() {
        let positive = Matrix2::new(2.0, 1.0, 1.0, 3.0);
        let negative = Matrix2::new(1.0, 2.0, 3.0, 1.0);
        for (gain, integral, expected) in [
            (positive, [1.0, 2.0], true),
            (positive, [-1.0, -2.0], true),
            (positive, [1.0, -2.0], false),
            (negative, [1.0, 2.0], false),
            (negative, [-1.0, 2.0], true),
            (positive, [0.0, 2.0], false),
        ] {
            assert_eq!(integral_action_may_be_stable(&gain, integral), expected, "{integral:?}");
        }
    }
}
