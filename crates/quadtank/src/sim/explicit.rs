//! One step of the classical Runge–Kutta method of order 4 for the nonlinear plant.

use crate::numeric::larger;

use super::hydraulics::Hydraulics;

impl Hydraulics {
    /// √h after a step (s), with the flows from the pumps (m³/s) at its beginning, middle and end. A tank that meets its
    /// wall goes on as if it were higher.
    #[expect(clippy::inline_always, reason = "measured: three equal flows then cost nothing")]
    #[inline(always)]
    pub(super) fn explicit_step(&self, step: f64, pumped: &[[f64; 4]; 3]) -> [f64; 4] {
        let h = self.levels();
        let from_here = |k: [f64; 4], by: f64| [h[0] + by * k[0], h[1] + by * k[1], h[2] + by * k[2], h[3] + by * k[3]];
        let k1 = self.slopes(h, &pumped[0]);
        let k2 = self.slopes(from_here(k1, step / 2.0), &pumped[1]);
        let k3 = self.slopes(from_here(k2, step / 2.0), &pumped[1]);
        let k4 = self.slopes(from_here(k3, step), &pumped[2]);
        let end = |i: usize| larger(h[i] + step / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]), 0.0).sqrt();
        [end(0), end(1), end(2), end(3)]
    }
}
