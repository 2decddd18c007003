//! The two transmission zeros of the quadruple tank in closed form: `(T3 s + 1)(T4 s + 1) = η`,
//! `η = (1−γ1)(1−γ2)/(γ1γ2)` (Cocota 2009, eqs. 3.22–3.23).
//!
//! Read as a root locus in η: at η = 0 the zeros are −1/T3 and −1/T4; as η grows they move apart on the real axis; at
//! η = 1, where γ1 + γ2 = 1, one of them is at the origin; beyond, it is in the right half-plane; as η → ∞ they go to
//! ±∞. Time constants (s) are plain arguments, those of the upper tanks at the operating point; a dry upper tank passes
//! its inflow on at once and has T = 0.
//!
//! Nothing here allocates: a chart asks thousands of times.

use super::{Complex, LinearError};
use crate::numeric::{complements, excess_over_one};

/// The finite zeros, at most two (1/s).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FiniteZeros {
    /// Both are at infinity: a valve sends nothing to its lower tank, or both upper tanks are dry.
    None,
    /// One is at infinity: an upper tank is dry.
    One(f64),
    /// The ordinary case: both real, the smaller first.
    Two([f64; 2]),
    /// A conjugate pair, by the one above the real axis. It takes an incremental fraction outside [0, 1], with which more flow of a
    /// pump lowers that into one of its tanks.
    Conjugate(Complex),
}

impl FiniteZeros {
    /// The real zeros as a slice.
    pub fn as_slice(&self) -> &[f64] {
        match self {
            Self::None | Self::Conjugate(_) => &[],
            Self::One(zero) => std::slice::from_ref(zero),
            Self::Two(zeros) => zeros,
        }
    }

    /// Both zeros, the one further to the left or below first; `None` where one is at infinity.
    pub fn pair(&self) -> Option<[Complex; 2]> {
        match self {
            Self::None | Self::One(_) => None,
            Self::Two(zeros) => Some(zeros.map(Complex::from)),
            Self::Conjugate(zero) => Some([zero.conj(), *zero]),
        }
    }

    /// The right-most zero, or the real part of the right-most ones, which says whether the plant is minimum phase.
    pub fn rightmost(&self) -> Option<f64> {
        match self {
            Self::Conjugate(zero) => Some(zero.re),
            _ => self.as_slice().last().copied(),
        }
    }
}

/// A point on a path through the valve plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathPoint {
    /// Valve settings γ1, γ2.
    pub gammas: [f64; 2],
    /// The zeros there, or why there are none.
    pub zeros: Result<FiniteZeros, LinearError>,
}

/// `η = (1−γ1)(1−γ2)/(γ1γ2)` (Cocota 2009, eq. 3.23): infinite where a γ is 0, undefined (`None`) where in addition the
/// other one is 1.
pub fn eta(gammas: [f64; 2]) -> Option<f64> {
    let ([gamma1, gamma2], [above1, above2]) = (gammas, complements(gammas));
    let eta = above1 * above2 / (gamma1 * gamma2);
    (!eta.is_nan()).then_some(eta)
}

/// Finite transmission zeros at rest for upper time constants `t3`, `t4` (s, 0 for a dry tank) and valve settings γ1, γ2.
///
/// At γ1 + γ2 = 1 the right-most one is exactly 0.
///
/// # Errors
/// [`LinearError::OutOfRange`] for a negative, infinite or undefined time constant or a γ outside [0, 1];
/// [`LinearError::DegenerateRank`] where det G(s) ≡ 0: at (γ1, γ2) = (1, 0) and (0, 1), and at γ1 + γ2 = 1 when both
/// upper tanks are dry.
pub fn zeros(t3: f64, t4: f64, gammas: [f64; 2]) -> Result<FiniteZeros, LinearError> {
    check("gamma1", gammas[0], (0.0, 1.0))?;
    check("gamma2", gammas[1], (0.0, 1.0))?;
    zeros_off_rest(t3, t4, gammas, 1.0)
}

/// As [`zeros`], at levels that need not be at rest: `(T3 s + 1)(T4 s + 1) = ρ η`, where `ρ` is `passed`, the product of the
/// steady-state gains from inflow to outflow of both upper tanks. Each is 1 at rest, and in a tank with upright walls. The fractions
/// may be incremental ones, γ̃, outside [0, 1] (`plant::Valve`).
///
/// # Errors
/// As [`zeros`] but for the range of γ, which only has to be finite, and [`LinearError::OutOfRange`] for a negative, infinite or
/// undefined `passed`.
pub fn zeros_off_rest(t3: f64, t4: f64, gammas: [f64; 2], passed: f64) -> Result<FiniteZeros, LinearError> {
    for (field, value) in [("t3", t3), ("t4", t4), ("passed", passed)] {
        check(field, value, (0.0, f64::MAX))?;
    }
    check("gamma1", gammas[0], (f64::MIN, f64::MAX))?;
    check("gamma2", gammas[1], (f64::MIN, f64::MAX))?;
    let [gamma1, gamma2] = gammas;
    let sum = t3 + t4;
    let degenerate = LinearError::DegenerateRank { rank: 1, size: 2 };
    let Some(eta) = eta(gammas) else { return Err(degenerate) };
    if eta.is_infinite() {
        return Ok(FiniteZeros::None);
    }
    // 1 − ρη without cancellation, so that the zero at the origin is exact.
    let gap = excess_over_one(gammas) / (gamma1 * gamma2) - (passed - 1.0) * eta;
    let eta = passed * eta;
    if sum == 0.0 {
        return if gap == 0.0 { Err(degenerate) } else { Ok(FiniteZeros::None) };
    }
    // The discriminant is (T3 − T4)² + 4 T3 T4 η, a sum of squares for fractions in [0, 1], and the smaller root comes from the
    // product.
    let root = if eta >= 0.0 {
        (t3 - t4).hypot(2.0 * (t3 * t4 * eta).sqrt())
    } else {
        let discriminant = (t3 - t4) * (t3 - t4) + 4.0 * t3 * t4 * eta;
        if discriminant < 0.0 {
            return Ok(FiniteZeros::Conjugate(Complex::new(-sum, (-discriminant).sqrt()) / (2.0 * t3 * t4)));
        }
        discriminant.sqrt()
    };
    let spread = sum + root;
    let right = 0.0 - 2.0 * gap / spread;
    let left = -spread / (2.0 * t3 * t4);
    Ok(match (left.is_finite(), right.is_finite()) {
        (true, true) => FiniteZeros::Two([left, right]),
        (false, true) => FiniteZeros::One(right),
        (_, false) => FiniteZeros::None,
    })
}

fn check(field: &'static str, value: f64, (min, max): (f64, f64)) -> Result<(), LinearError> {
    if (min..=max).contains(&value) { Ok(()) } else { Err(LinearError::OutOfRange { field, value }) }
}

/// The right-most finite zero (1/s), negative for a minimum-phase plant; `None` where [`zeros`] has none or fails.
///
/// Its sign is that of 1 − γ1 − γ2, whatever the time constants.
pub fn rightmost_zero(t3: f64, t4: f64, gammas: [f64; 2]) -> Option<f64> {
    zeros(t3, t4, gammas).ok()?.rightmost()
}

/// The path of both zeros while the valves go in a straight line from one setting to another, at `points` (at least
/// two) settings, ends included. `zeros_at` gives them at a setting, since the operating point may move too.
pub fn path(
    from: [f64; 2],
    to: [f64; 2],
    points: usize,
    zeros_at: impl Fn([f64; 2]) -> Result<FiniteZeros, LinearError>,
) -> impl Iterator<Item = PathPoint> {
    let points = points.max(2);
    (0..points).map(move |i| {
        let share = i as f64 / (points - 1) as f64;
        let gammas = [0, 1].map(|k: usize| from[k] * (1.0 - share) + to[k] * share);
        PathPoint { gammas, zeros: zeros_at(gammas) }
    })
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    fn two(t3: f64, t4: f64, gammas: [f64; 2]) -> [f64; 2] {
        match zeros(t3, t4, gammas) {
            Ok(FiniteZeros::Two(zeros)) => zeros,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn printed_zeros_at_the_printed_levels() {
        // Johansson 2000 as recomputed from the printed levels, five digits after the point.
        for (t3, t4, gammas, expected) in [
            (23.89, 29.99, [0.70, 0.60], [-0.0580, -0.0172]),
            (39.01, 56.11, [0.43, 0.34], [-0.05623, 0.01278]),
            (87.353, 91.059, [0.75, 0.75], [-0.01496, -0.00747]),
            (219.241, 255.402, [0.43, 0.43], [-0.00985, 0.00137]),
        ] {
            let [left, right] = two(t3, t4, gammas);
            assert!((left - expected[0]).abs() <= 5e-5 && (right - expected[1]).abs() <= 5e-5, "{left} {right}");
        }
    }

    #[test]
    fn both_zeros_solve_the_equation() {
        for gammas in [[0.3, 0.9], [0.01, 0.2], [0.999, 0.6], [0.5, 0.5]] {
            for zero in two(23.0, 250.0, gammas) {
                let product = (23.0 * zero + 1.0) * (250.0 * zero + 1.0);
                assert_relative_eq!(product, eta(gammas).unwrap(), max_relative = 1e-12);
            }
        }
    }

    #[test]
    fn incremental_fractions_outside_0_to_1_can_make_a_conjugate_pair() {
        let Ok(FiniteZeros::Conjugate(zero)) = zeros_off_rest(30.0, 31.0, [1.1, 0.5], 1.0) else { panic!("a pair") };
        let product = (zero * 30.0 + 1.0) * (zero * 31.0 + 1.0);
        assert_relative_eq!(product.re, eta([1.1, 0.5]).unwrap(), max_relative = 1e-12);
        assert!(product.im.abs() < 1e-12 && zero.re < 0.0);
        // Time constants that are far apart leave both real.
        let Ok(FiniteZeros::Two(pair)) = zeros_off_rest(3.0, 310.0, [1.1, 0.5], 1.0) else { panic!("two zeros") };
        for zero in pair {
            let product = (3.0 * zero + 1.0) * (310.0 * zero + 1.0);
            assert_relative_eq!(product, eta([1.1, 0.5]).unwrap(), max_relative = 1e-12);
        }
    }

    #[test]
    fn on_the_line_one_zero_is_exactly_at_the_origin() {
        for gamma in [0.1, 0.25, 0.3, 0.5, 0.7, 0.9] {
            let [left, right] = two(30.0, 40.0, [gamma, 1.0 - gamma]);
            assert_eq!(right.to_bits(), 0.0_f64.to_bits());
            assert_relative_eq!(left, -70.0 / 1200.0, max_relative = 1e-15);
        }
    }

    #[test]
    fn valves_at_their_ends() {
        assert_eq!(zeros(30.0, 40.0, [0.0, 0.5]), Ok(FiniteZeros::None));
        assert_eq!(zeros(30.0, 40.0, [0.0, 0.0]), Ok(FiniteZeros::None));
        assert_eq!(two(20.0, 50.0, [1.0, 0.5]), [-1.0 / 20.0, -1.0 / 50.0]);
        for gammas in [[1.0, 0.0], [0.0, 1.0]] {
            assert_eq!(zeros(30.0, 40.0, gammas), Err(LinearError::DegenerateRank { rank: 1, size: 2 }));
        }
    }

    #[test]
    fn dry_upper_tanks() {
        // One lag left: T4 s + 1 = η.
        let Ok(FiniteZeros::One(zero)) = zeros(0.0, 40.0, [0.6, 0.8]) else { panic!("one zero expected") };
        assert_relative_eq!(zero, (0.4 * 0.2 / (0.6 * 0.8) - 1.0) / 40.0, max_relative = 1e-14);
        assert_eq!(zeros(40.0, 0.0, [0.6, 0.8]), Ok(FiniteZeros::One(zero)));
        assert_eq!(zeros(0.0, 0.0, [1.0, 1.0]), Ok(FiniteZeros::None));
        assert_eq!(zeros(0.0, 0.0, [0.5, 0.5]), Err(LinearError::DegenerateRank { rank: 1, size: 2 }));
    }

    #[test]
    fn arguments_out_of_range_are_named() {
        let error = |field, value| Err(LinearError::OutOfRange { field, value });
        assert_eq!(zeros(-1.0, 1.0, [0.5, 0.6]), error("t3", -1.0));
        assert_eq!(zeros(1.0, f64::INFINITY, [0.5, 0.6]), error("t4", f64::INFINITY));
        assert_eq!(zeros(1.0, 1.0, [0.5, 1.5]), error("gamma2", 1.5));
        assert!(zeros(1.0, 1.0, [f64::NAN, 0.5]).is_err());
        assert_eq!(rightmost_zero(1.0, 1.0, [1.5, 0.5]), None);
    }

    #[test]
    fn extreme_arguments_give_no_nan() {
        for t in [1e-300, 1e-12, 1e12, 1e300] {
            for gamma in [1e-300, 1e-12, 0.5, 1.0 - 1e-16, 1.0] {
                if let Ok(zeros) = zeros(t, 1.0, [gamma, 0.5]) {
                    assert!(zeros.as_slice().iter().all(|zero| zero.is_finite()), "{t} {gamma} {zeros:?}");
                }
            }
        }
    }

    #[test]
    fn along_a_path_the_right_most_zero_crosses_the_origin_where_the_valves_sum_to_one() {
        let points: Vec<PathPoint> = path([0.9, 0.9], [0.1, 0.1], 101, |gammas| zeros(30.0, 40.0, gammas)).collect();
        assert_eq!(points.len(), 101);
        assert_eq!(points[0].gammas, [0.9, 0.9]);
        assert_eq!(points[100].gammas, [0.1, 0.1]);
        for point in points {
            let margin = point.gammas[0] + point.gammas[1] - 1.0;
            let rightmost = point.zeros.unwrap().rightmost().unwrap();
            assert!(rightmost * margin <= 0.0, "{point:?}");
        }
    }
}
