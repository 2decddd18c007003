use serde::Serialize;

use crate::linear::Complex;

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

/// The poles of the sampled linear closed loop.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosedLoop {
    /// Poles of the sampled loop (z-plane), by falling modulus.
    pub poles_z: Vec<Complex>,
    /// The same mapped to the s-plane, `s = ln(z)/Ts` (1/s); a pole at z = 0 has no image and is left out.
    pub poles_s: Vec<Complex>,
    /// The verdict.
    pub stability: Stability,
}

impl ClosedLoop {
    /// The pole that decides how fast the loop forgets or grows: the one with the largest real part (1/s).
    pub fn slowest(&self) -> Option<Complex> {
        self.poles_s.iter().copied().max_by(|x, y| x.re.total_cmp(&y.re))
    }
}
