//! Stability of a loop with two inputs and outputs by the generalised Nyquist criterion, dead times included.

use std::f64::consts::PI;

use nalgebra::Matrix2;

use super::Complex;

/// Stability of a loop of stable parts, by the number of encirclements of −1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LoopStability {
    /// No pole in the right half-plane.
    Stable,
    /// That many poles in the right half-plane.
    Unstable {
        /// Number of them.
        poles: u32,
    },
    /// A locus passes through −1, to rounding: an oscillation that stays.
    Marginal {
        /// Its frequency; 0 for a pole at the origin.
        frequency: f64,
    },
}

/// What the count of encirclements needs to know of a loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopOutline {
    /// Frequency below which only integral action moves.
    pub low: f64,
    /// Frequency above which the size of the loop only falls.
    pub high: f64,
    /// Integrators in the loop: the order of the pole of det(I + L) at the origin.
    pub integrators: u32,
    /// Smallest damping ratio of a resonance, 1 where there is none.
    pub damping: f64,
    /// Sum of the longest dead times of both loops: how fast det(I + L) turns.
    pub dead_time: f64,
}

/// Turn of det(I + L) between two frequencies of the count (rad) that is followed without a closer look.
const QUIET_TURN: f64 = 0.4;
/// Largest |det(I + L) − 1| that passes for near 1.
const QUIET: f64 = 0.9;
/// Resonances narrower than this are taken for so narrow.
const LEAST_DAMPING: f64 = 1e-4;
/// Steps of the count, relative to the frequency.
const STRIDE: f64 = 0.03;
/// Bisections of one step of the count; a turn that is not resolved by then goes through zero.
const DEPTH: u32 = 40;
/// Decades that the count goes beyond the outline on each side to find the limits.
const DECADES: u32 = 9;

impl LoopStability {
    /// The verdict on a loop whose parts are stable, but for integrators.
    ///
    /// Loci that together encircle −1 are the same as det(I + L) = (1 + λ1)(1 + λ2) that encircles 0. Followed from 0 to ∞
    /// its argument grows by Δ, and passing the pole of order n at the origin on its right side costs n π, so
    /// `Z = n/2 − Δ/π` poles of the closed loop are in the right half-plane (Campestrini 2006, Theorem 1, with P = 0).
    pub fn of(ratio: impl Fn(f64) -> Matrix2<Complex>, outline: &LoopOutline) -> Self {
        let value = |w: f64| return_difference(&ratio(w));
        let integrators = outline.integrators;
        // Below all else det(I + L) is R/(jω)^n with a real R.
        let residue = |w: f64| value(w) * Complex::new(0.0, w).powu(integrators);
        let settled = |r: Complex| r.im.abs() <= 0.05 * r.re.abs();
        let mut w = outline.low * 1e-3;
        for _ in 0..DECADES {
            if !settled(residue(w)) {
                w *= 0.1;
            }
        }
        let first = residue(w);
        if !settled(first) {
            return Self::Marginal { frequency: 0.0 };
        }
        let mut turn = if first.re > 0.0 { first.arg() } else { (-first).arg() };
        let loudest = outline.high * 10.0_f64.powi(i32::try_from(DECADES).unwrap_or(0));
        let mut here = ratio(w);
        while !(w > outline.high && is_quiet(&here)) && w < loudest {
            let both_quiet = |next: &Matrix2<Complex>| is_quiet(&here) && is_quiet(next);
            let stride = w * STRIDE.min(0.25 * outline.damping.max(LEAST_DAMPING));
            let careful = if outline.dead_time > 0.0 { QUIET_TURN / outline.dead_time } else { f64::INFINITY };
            let mut next = w + stride;
            let mut there = ratio(next);
            let (before, after);
            if both_quiet(&there) {
                // Near 1 the argument is its principal value, however often the dead time turns in between.
                (before, after) = (return_difference(&here), return_difference(&there));
                turn += after.arg() - before.arg();
            } else {
                if careful < stride {
                    next = w + careful;
                    there = ratio(next);
                }
                (before, after) = (return_difference(&here), return_difference(&there));
                match turned(&value, (w, before), (next, after), DEPTH) {
                    Ok(angle) => turn += angle,
                    Err(frequency) => return Self::Marginal { frequency },
                }
            }
            (w, here) = (next, there);
        }
        turn -= return_difference(&here).arg();
        let poles = (f64::from(integrators) / 2.0 - turn / PI).round();
        if poles <= 0.0 { Self::Stable } else { Self::Unstable { poles: count(poles) } }
    }
}

/// det(I + L).
fn return_difference(ratio: &Matrix2<Complex>) -> Complex {
    (Matrix2::identity() + ratio).determinant()
}

/// Whether the size of the loop alone keeps det(I + L) near 1.
fn is_quiet(ratio: &Matrix2<Complex>) -> bool {
    let [a, b, c, d] = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|at| ratio[at].norm());
    a + d + a * d + b * c < QUIET
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number of poles")]
fn count(poles: f64) -> u32 {
    poles as u32
}

/// Angle by which a function of frequency turns between two points; the frequency where it cannot be told.
fn turned(
    value: &impl Fn(f64) -> Complex,
    (low, at_low): (f64, Complex),
    (high, at_high): (f64, Complex),
    depth: u32,
) -> Result<f64, f64> {
    let angle = (at_high / at_low).arg();
    if angle.abs() <= QUIET_TURN {
        return Ok(angle);
    }
    if depth == 0 || !angle.is_finite() {
        return Err(low);
    }
    let middle = f64::midpoint(low, high);
    let at_middle = value(middle);
    Ok(turned(value, (low, at_low), (middle, at_middle), depth - 1)?
        + turned(value, (middle, at_middle), (high, at_high), depth - 1)?)
}

/// Loops that the tests of loci and of encirclements share.
#[cfg(test)]
pub(super) mod examples {
    use super::{Complex, Matrix2};

    pub fn diagonal(a: Complex, b: Complex) -> Matrix2<Complex> {
        Matrix2::new(a, Complex::ZERO, Complex::ZERO, b)
    }

    /// `k/(s + 1)^3` in loop 1 and a harmless loop 2; unstable beyond k = 8.
    pub fn cubic(k: f64) -> impl Fn(f64) -> Matrix2<Complex> {
        move |w| {
            let lag = Complex::new(1.0, w).inv();
            diagonal(lag.powu(3) * k, lag * 0.5)
        }
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::examples::{cubic, diagonal};
    use super::*;

    const OUTLINE: LoopOutline = LoopOutline { low: 0.01, high: 100.0, integrators: 0, damping: 1.0, dead_time: 0.0 };

    #[test]
    fn a_triple_lag_is_stable_up_to_eight() {
        assert_eq!(LoopStability::of(cubic(7.9), &OUTLINE), LoopStability::Stable);
        assert_eq!(LoopStability::of(cubic(8.1), &OUTLINE), LoopStability::Unstable { poles: 2 });
        let LoopStability::Marginal { frequency } = LoopStability::of(cubic(8.0), &OUTLINE) else {
            panic!("a locus on −1 is marginal")
        };
        assert_relative_eq!(frequency, 3.0_f64.sqrt(), max_relative = 0.05);
        // Negative gain: the real pole at k < −1.
        assert_eq!(LoopStability::of(cubic(-1.1), &OUTLINE), LoopStability::Unstable { poles: 1 });
    }

    #[test]
    fn a_narrow_resonance_is_not_passed_over() {
        // 0.02 e^(−s)/(s² + 0.002 s + 1): the locus reaches far beyond −1 within a thousandth of its frequency.
        let resonance = |w: f64| {
            let s = Complex::new(0.0, w);
            diagonal(Complex::cis(-w) * 0.02 / (s * s + s * 0.002 + 1.0), Complex::cis(-w) * 0.02 / (s + 1.0))
        };
        let outline = LoopOutline { damping: 1e-3, dead_time: 2.0, ..OUTLINE };
        assert_eq!(LoopStability::of(resonance, &outline), LoopStability::Unstable { poles: 2 });
    }

    #[test]
    fn integrators_and_dead_time_are_counted() {
        // k e^(−s)/s is stable up to π/2; in both loops it counts twice.
        let delayed = |k: f64| {
            move |w: f64| {
                let g = Complex::cis(-w) / Complex::new(0.0, w) * k;
                diagonal(g, g)
            }
        };
        let outline = LoopOutline { low: 0.01, high: 100.0, integrators: 2, damping: 1.0, dead_time: 2.0 };
        assert_eq!(LoopStability::of(delayed(1.5), &outline), LoopStability::Stable);
        assert_eq!(LoopStability::of(delayed(1.65), &outline), LoopStability::Unstable { poles: 4 });
        // Far beyond: pairs of poles cross at (4 n + 1) π/2.
        assert_eq!(LoopStability::of(delayed(8.0), &outline), LoopStability::Unstable { poles: 8 });
        // The wrong sign: one real pole in each loop.
        assert_eq!(LoopStability::of(delayed(-0.1), &outline), LoopStability::Unstable { poles: 2 });
    }
}
