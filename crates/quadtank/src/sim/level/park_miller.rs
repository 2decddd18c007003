//! The "Random Number" block of Simulink.

/// Modulus 2³¹ − 1 of the generator.
const MODULUS: u64 = 2_147_483_647;
/// State for a seed that would give none.
const FALLBACK: u32 = 1_144_108_930;

/// Normal deviates as the block "Random Number" of Simulink makes them from a seed: the minimal standard generator of Park and
/// Miller (1988), `u ← 16807 u mod (2³¹ − 1)`, and the first variate of the polar method of Marsaglia.
///
/// Seed 0 gives the sequence of Andreis (2017); the source prints neither generator nor seed.
///
/// ```
/// use quadtank::sim::level::ParkMillerNormal;
///
/// let first = ParkMillerNormal::new(0).next().unwrap();
/// assert!((first - 1.164954).abs() < 5e-7);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParkMillerNormal {
    state: u64,
}

impl ParkMillerNormal {
    /// The sequence of a seed. The seed is mixed as the block does it; a state of 0 becomes that of seed 0.
    pub fn new(seed: u32) -> Self {
        let high = seed >> 16;
        let bit = seed & 0x8000;
        let low = seed.wrapping_sub(high << 16).wrapping_add(bit);
        let mixed = (low << 16).wrapping_add(bit).wrapping_add(high);
        let state = if mixed == 0 { FALLBACK } else { mixed.min(0x7FFF_FFFE) };
        Self { state: u64::from(state) }
    }

    fn uniform(&mut self) -> f64 {
        self.state = 16_807 * self.state % MODULUS;
        self.state as f64 / MODULUS as f64
    }
}

impl Iterator for ParkMillerNormal {
    type Item = f64;

    fn next(&mut self) -> Option<f64> {
        loop {
            let (a, b) = (2.0 * self.uniform() - 1.0, 2.0 * self.uniform() - 1.0);
            let square = a * a + b * b;
            if square <= 1.0 && square > 0.0 {
                return Some(a * (-2.0 * square.ln() / square).sqrt());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_seed_gives_normal_deviates_and_another_sequence() {
        for seed in [0, 1, 2, 32_768, 65_535, 65_536, u32::MAX] {
            let sample: Vec<f64> = ParkMillerNormal::new(seed).take(20_000).collect();
            let mean = sample.iter().sum::<f64>() / 2e4;
            let variance = sample.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / 2e4;
            // Four standard errors.
            assert!(mean.abs() < 4.0 / 2e4_f64.sqrt(), "{seed}: {mean}");
            assert!((variance - 1.0).abs() < 4.0 * (2.0 / 2e4_f64).sqrt(), "{seed}: {variance}");
        }
        assert_ne!(ParkMillerNormal::new(1).next(), ParkMillerNormal::new(2).next());
    }
}
