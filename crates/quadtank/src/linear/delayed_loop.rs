//! Stability of a sampled loop whose inputs are delayed, by the principle of the argument on the unit circle.
//!
//! With a delay of d samples the loop has d poles more for each input, far too many for eigenvalues. What it takes is whether one of
//! them is outside the unit circle.

use std::f64::consts::PI;

use super::taylor_model::{Arithmetic, Cell, TaylorModel, dominant_dead_time};
use super::{Complex, Stability, UNIT_CIRCLE_TOLERANCE};

/// The characteristic function of a sampled loop, `g(w) = Σ tᵢ(w) w^dᵢ` with w = 1/z: analytic for |w| ≤ 1, with a zero at 1/z for
/// each pole z of the closed loop outside the unit circle.
pub(crate) trait DelayedLoop {
    /// The terms tᵢ, without their delays.
    fn terms<T: Arithmetic>(&self, w: T) -> [T; 4];
    /// The delays dᵢ in whole samples.
    fn delays(&self) -> [f64; 4];
}

/// Most arcs of the unit circle that are looked at: about 30 ms.
const MAX_ARCS: u32 = 30_000;

/// The verdict on a loop; `None` where its function turns too often to be followed within the bound on work.
///
/// Along the upper half of the unit circle, from w = 1 to w = −1, g turns by Δ, and `−Δ/π` poles are outside. Arcs are halved until
/// each has an enclosure of g that excludes zero, which makes the count exact; an arc as narrow as the tolerance of a pole on the unit
/// circle has one there.
pub(crate) fn stability(of: &impl DelayedLoop) -> Option<Stability> {
    let mut arcs = vec![Cell { low: 0.0, high: PI }];
    let (mut turned, mut count) = (0.0, 0);
    while let Some(arc) = arcs.pop() {
        count += 1;
        if count > MAX_ARCS {
            return None;
        }
        match turn_over(of, arc) {
            Some(angle) => turned += angle,
            None if arc.half_width() <= UNIT_CIRCLE_TOLERANCE => return Some(Stability::Marginal),
            None => arcs.extend(arc.halves()),
        }
    }
    Some(if (-turned / PI).round() > 0.0 { Stability::Unstable } else { Stability::Stable })
}

/// Change of the argument of g over an arc of angles of z (rad); `None` where the enclosure of g contains zero.
/// Computed in a frame that rotates with the largest term.
fn turn_over(of: &impl DelayedLoop, arc: Cell) -> Option<f64> {
    let terms = of.terms(TaylorModel::dead_time(1.0, arc));
    let delays = of.delays();
    let frame = dominant_dead_time(std::array::from_fn::<_, 4, _>(|i| (terms[i], delays[i])), arc)?;
    let [before, after] = [arc.low, arc.high].map(|angle| at(of, angle, frame));
    Some((after / before).arg() - frame * (arc.high - arc.low))
}

/// g at an angle of z (rad), without a delay of `frame` samples.
fn at(of: &impl DelayedLoop, angle: f64, frame: f64) -> Complex {
    let terms = of.terms(Complex::cis(-angle));
    terms.into_iter().zip(of.delays()).map(|(term, delay)| term * Complex::cis((frame - delay) * angle)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An integrator `1/(z − 1)` under a gain, d samples late: `g = (1 − w) + K w^(d + 1)`.
    struct Integrator {
        gain: f64,
        delay: f64,
    }

    impl DelayedLoop for Integrator {
        fn terms<T: Arithmetic>(&self, w: T) -> [T; 4] {
            [T::real(1.0) - w, T::real(self.gain) * w, T::real(0.0), T::real(0.0)]
        }

        fn delays(&self) -> [f64; 4] {
            [0.0, self.delay, 0.0, 0.0]
        }
    }

    #[test]
    fn an_integrator_bears_its_textbook_gain() {
        // |z − 1| = K and d θ + (π + θ)/2 = π at the limit: K = 2 sin(π/(2 (2 d + 1))).
        for delay in [0.0, 1.0, 7.0, 300.0, 12_000.0] {
            let limit = 2.0 * (PI / (2.0 * (2.0 * delay + 1.0))).sin();
            let verdict = |share: f64| stability(&Integrator { gain: share * limit, delay });
            assert_eq!(verdict(0.999), Some(Stability::Stable), "{delay}");
            assert_eq!(verdict(1.001), Some(Stability::Unstable), "{delay}");
            assert_eq!(verdict(0.0), Some(Stability::Marginal), "{delay}");
            assert_eq!(verdict(-0.5), Some(Stability::Unstable), "{delay}");
        }
        let fast = Integrator { gain: 1.9, delay: 12_000.0 };
        assert!(matches!(stability(&fast), Some(Stability::Unstable) | None));
    }
}
