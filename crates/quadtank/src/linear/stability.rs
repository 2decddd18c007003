//! Stability of a sampled loop by its poles.

use serde::Serialize;

use super::Complex;

/// `1 − |z|` below which a pole counts as on the unit circle. A slow but stable pole at this distance would take 30
/// years at one sample per second; rounding moves a simple pole at z = 1 by less than 1e-12.
pub const UNIT_CIRCLE_TOLERANCE: f64 = 1e-9;

/// Whether a sampled linear loop is stable, by its poles in the z-plane.
///
/// [`LoopStability`](super::LoopStability) is the verdict on loops with dead time in continuous time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Stability {
    /// Every pole is inside the unit circle.
    Stable,
    /// A pole is on the unit circle, to rounding.
    Marginal,
    /// A pole is outside the unit circle.
    Unstable,
}

impl Stability {
    /// The verdict on a loop with these poles (z-plane); a loop without poles is stable.
    pub fn of_poles(poles_z: &[Complex]) -> Self {
        let radius = spectral_radius(poles_z);
        if radius > 1.0 + UNIT_CIRCLE_TOLERANCE {
            Self::Unstable
        } else if radius < 1.0 - UNIT_CIRCLE_TOLERANCE {
            Self::Stable
        } else {
            Self::Marginal
        }
    }

    /// Distance of the poles (z-plane) from the circle inside which a loop is [`Stable`](Self::Stable), `1 − 1e-9 − max |z|`:
    /// positive for a stable loop.
    pub fn slack(poles_z: &[Complex]) -> f64 {
        1.0 - UNIT_CIRCLE_TOLERANCE - spectral_radius(poles_z)
    }
}

fn spectral_radius(poles_z: &[Complex]) -> f64 {
    poles_z.iter().map(|z| z.norm()).fold(0.0, f64::max)
}

/// Image in the s-plane of a pole `z` of a loop that repeats itself every `period_s` (s): `s = ln(z)/T` (1/s) with
/// `|Im s| ≤ π/T`. `None` for z = 0, which has no image.
pub fn s_from_z(z: Complex, period_s: f64) -> Option<Complex> {
    (z != Complex::ZERO).then(|| z.ln() / period_s)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pole_farthest_out_decides() {
        let verdict = |radius: f64| Stability::of_poles(&[Complex::new(0.0, -radius), Complex::from(0.5)]);
        assert_eq!(verdict(1.0 - 1e-8), Stability::Stable);
        assert_eq!(verdict(1.0 - 1e-10), Stability::Marginal);
        assert_eq!(verdict(1.0 + 1e-10), Stability::Marginal);
        assert_eq!(verdict(1.0 + 1e-8), Stability::Unstable);
        assert_eq!(Stability::of_poles(&[]), Stability::Stable);
        assert!(Stability::slack(&[Complex::from(-0.5)]) > 0.49 && Stability::slack(&[Complex::ONE]) < 0.0);
    }

    #[test]
    fn the_exponential_leads_back_from_the_s_plane() {
        let s = Complex::new(-0.2, 1.1);
        assert!((s_from_z((s * 2.0).exp(), 2.0).unwrap() - s).norm() < 1e-15);
        assert_eq!(s_from_z(Complex::ZERO, 2.0), None);
    }
}
