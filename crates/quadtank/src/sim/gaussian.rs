//! Normal deviates from a seed.

use std::f64::consts::TAU;

use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// White Gaussian noise of unit variance from a seed, the same on every platform.
#[derive(Clone, Debug)]
pub(super) struct GaussianSource(Pcg32);

impl GaussianSource {
    pub(super) fn new(seed: u32) -> Self {
        Self(Pcg32::seed_from_u64(u64::from(seed)))
    }

    /// One deviate, by the transform of Box and Muller (1958): it needs no table. Single precision is plenty for noise and hides
    /// the last bit of logarithm and cosine, in which platforms differ; so a seed gives the same run everywhere.
    pub(super) fn next(&mut self) -> f64 {
        // Above 0, so that the logarithm is finite, and up to 1.
        let mut uniform = || (f64::from(self.0.next_u32()) + 1.0) / (f64::from(u32::MAX) + 1.0);
        let (radius, angle) = ((-2.0 * uniform().ln()).sqrt(), TAU * uniform());
        #[expect(clippy::cast_possible_truncation, reason = "to single precision, see above")]
        let normal = (radius * angle.cos()) as f32;
        f64::from(normal)
    }
}
