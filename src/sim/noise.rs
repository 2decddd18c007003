//! What the sensors make of the true levels.

use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg32;
use rand_pcg::rand_core::SeedableRng;

use crate::plant::Sensor;

use super::experiment::Measurement;

/// The measurement of a run: white Gaussian noise from a seed, then the sensor.
pub(super) struct Noise {
    source: Pcg32,
    measurement: Measurement,
}

impl Noise {
    pub(super) fn new(measurement: &Measurement) -> Self {
        Self { source: Pcg32::seed_from_u64(u64::from(measurement.seed)), measurement: *measurement }
    }

    /// Measured signals (V) for the true levels 1 and 2 (m).
    pub(super) fn measure(&mut self, sensor: &Sensor, levels: [f64; 2]) -> [f64; 2] {
        levels.map(|level| {
            let signal = sensor.measure(level + self.deviation());
            if self.measurement.quantised { sensor.quantise(signal) } else { signal }
        })
    }

    /// One deviation (m). Single precision is plenty for noise and hides the last bit of the logarithm, in which
    /// platforms differ; so a seed gives the same run everywhere.
    fn deviation(&mut self) -> f64 {
        if self.measurement.noise_std == 0.0 {
            return 0.0;
        }
        let normal: f32 = StandardNormal.sample(&mut self.source);
        self.measurement.noise_std * f64::from(normal)
    }
}
