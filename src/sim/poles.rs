use serde::Serialize;

use crate::control::DecentralisedPi;
use crate::linear::{Complex, LinearError, eigenvalues};
use crate::plant::Jacobian;

use super::open_loop::OpenLoop;

/// `1 − |z|` below which a pole counts as on the unit circle. A slow but stable pole at this distance would take 30
/// years at one sample per second; rounding moves a simple pole at z = 1 by less than 1e-12.
pub const UNIT_CIRCLE_TOLERANCE: f64 = 1e-9;

/// Whether the sampled linear closed loop is stable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
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
    /// The verdict on a loop with these poles (z-plane).
    fn of(poles_z: &[Complex]) -> Self {
        let radius = poles_z.iter().map(|z| z.norm()).fold(0.0, f64::max);
        if radius > 1.0 + UNIT_CIRCLE_TOLERANCE {
            Self::Unstable
        } else if radius < 1.0 - UNIT_CIRCLE_TOLERANCE {
            Self::Stable
        } else {
            Self::Marginal
        }
    }
}

/// The poles of the sampled linear closed loop.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosedLoop {
    /// Poles of the sampled loop (z-plane), by falling modulus.
    pub poles_z: Vec<Complex>,
    /// The same mapped to the s-plane, `s = ln(z)/Ts` (1/s); a pole at z = 0 has no image and is left out.
    pub poles_s: Vec<Complex>,
    /// The verdict.
    pub stability: Stability,
    /// Peak Ms of the largest singular value of the sensitivity at the outputs, over all frequencies up to Nyquist;
    /// `None` when the loop is not stable. 1.2 to 2 is usual for a loop that keeps its distance from instability.
    pub sensitivity_peak: Option<f64>,
}

impl ClosedLoop {
    /// The pole that decides how fast the loop forgets or grows: the one with the largest real part (1/s).
    pub fn slowest(&self) -> Option<Complex> {
        self.poles_s.iter().copied().max_by(|x, y| x.re.total_cmp(&y.re))
    }
}

/// Poles, verdict and sensitivity peak of the sampled linear loop: the plant of `jacobian` under zero-order hold with
/// the two PI laws, both in automatic mode and away from their limits.
///
/// One state per tank that is not dry and one per loop. A loop with gain 0 does not act and its integral is left out.
/// `power_gain` is that of the power module.
///
/// # Errors
/// [`LinearError::NoConvergence`] when an entry of the closed-loop matrix is not finite.
pub fn closed_loop(
    jacobian: &Jacobian,
    controller: &DecentralisedPi,
    power_gain: f64,
) -> Result<ClosedLoop, LinearError> {
    let open = OpenLoop::new(jacobian, controller, power_gain);
    let mut poles_z = eigenvalues(&open.closed(&jacobian.dry))?;
    poles_z.sort_by(|x, y| y.norm().total_cmp(&x.norm()).then(y.im.total_cmp(&x.im)));
    let stability = Stability::of(&poles_z);
    let images = poles_z.iter().filter(|&&z| z != Complex::ZERO);
    let poles_s: Vec<Complex> = images.map(|z| z.ln() / controller.sampling_time_s).collect();
    let sensitivity_peak = (stability == Stability::Stable).then(|| open.sensitivity_peak(&poles_s));
    Ok(ClosedLoop { poles_z, poles_s, stability, sensitivity_peak })
}
