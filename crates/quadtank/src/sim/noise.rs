//! Noise: what the sensors make of the true levels, and what pumps add to their flow.

use crate::plant::{Disturbance, Sensor};

use super::experiment::{Experiment, Measurement};
use super::gaussian::GaussianSource;

/// The measurement of a run: white Gaussian noise from a seed, then the sensor.
pub(super) struct Noise {
    source: GaussianSource,
    measurement: Measurement,
}

impl Noise {
    pub(super) fn new(measurement: &Measurement) -> Self {
        Self { source: GaussianSource::new(measurement.seed), measurement: *measurement }
    }

    /// Measured signals (V) for the true levels 1 and 2 (m).
    pub(super) fn measure(&mut self, sensor: &Sensor, levels: [f64; 2]) -> [f64; 2] {
        [self.signal(sensor, levels[0]), self.signal(sensor, levels[1])]
    }

    fn signal(&mut self, sensor: &Sensor, level: f64) -> f64 {
        let signal = sensor.measure(level + self.deviation());
        if self.measurement.quantised { sensor.quantise(signal) } else { signal }
    }

    /// One deviation (m).
    fn deviation(&mut self) -> f64 {
        if self.measurement.noise_std == 0.0 {
            return 0.0;
        }
        self.measurement.noise_std * self.source.next()
    }
}

/// Seeds of the noise of pumps and of sensors differ by this, so that the two are independent.
const FLOW_STREAM: u32 = 0x9E37_79B9;

/// White Gaussian noise on the flow of each pump, held from sample to sample.
pub(super) struct FlowNoise {
    source: GaussianSource,
    /// Standard deviation (m³/s).
    std: f64,
    flow: [f64; 2],
}

impl FlowNoise {
    pub(super) fn new(experiment: &Experiment) -> Self {
        let source = GaussianSource::new(experiment.measurement.seed ^ FLOW_STREAM);
        Self { source, std: experiment.pump_flow_noise_std, flow: [0.0; 2] }
    }

    /// Draws the noise that holds from this sample on.
    pub(super) fn draw(&mut self) {
        if self.std > 0.0 {
            self.flow = [(); 2].map(|()| self.std * self.source.next());
        }
    }

    /// The given loads with the noise that holds.
    pub(super) fn on(&self, loads: &Disturbance) -> Disturbance {
        let pump_flow = [loads.pump_flow[0] + self.flow[0], loads.pump_flow[1] + self.flow[1]];
        Disturbance { pump_flow, ..*loads }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SENSOR: Sensor = Sensor { gain: 50.0, range: 0.2, resolution: 0.01 };

    fn signals(noise_std: f64, seed: u32, quantised: bool, level: f64) -> Vec<f64> {
        let mut noise = Noise::new(&Measurement { noise_std, seed, quantised });
        (0..5000).flat_map(|_| noise.measure(&SENSOR, [level, level])).collect()
    }

    #[test]
    fn noise_has_the_deviation_asked_for_and_no_bias() {
        let signals = signals(1e-3, 7, false, 0.1);
        let n = signals.len() as f64;
        let mean = signals.iter().sum::<f64>() / n;
        let variance = signals.iter().map(|y| (y - mean).powi(2)).sum::<f64>() / n;
        // Four standard errors.
        assert!((mean - 5.0).abs() < 4.0 * 0.05 / n.sqrt());
        assert!((variance.sqrt() / 0.05 - 1.0).abs() < 4.0 / (2.0 * n).sqrt());
    }

    #[test]
    fn noise_of_the_pumps_adds_to_their_loads_and_is_its_own() {
        let measurement = Measurement { noise_std: 1.0, seed: 7, quantised: false };
        let experiment = Experiment { measurement, pump_flow_noise_std: 1e-7, ..Experiment::at_rest(1.0) };
        let load = Disturbance { pump_flow: [3e-7, 0.0], leak_area: [1e-6; 4], ..Disturbance::default() };
        let (mut noise, mut of_sensors) = (FlowNoise::new(&experiment), Noise::new(&measurement));
        let rows: Vec<[f64; 2]> = (0..5000)
            .map(|_| {
                noise.draw();
                let acting = noise.on(&load);
                assert_eq!(acting, noise.on(&load), "it holds until the next sample");
                assert_eq!(acting.leak_area, load.leak_area);
                [(acting.pump_flow[0] - 3e-7) / 1e-7, of_sensors.deviation()]
            })
            .collect();
        let n = rows.len() as f64;
        let mean = |of: fn(&[f64; 2]) -> f64| rows.iter().map(of).sum::<f64>() / n;
        // Four standard errors of mean, deviation and correlation.
        assert!(mean(|row| row[0]).abs() < 4.0 / n.sqrt());
        assert!((mean(|row| row[0].powi(2)).sqrt() - 1.0).abs() < 4.0 / (2.0 * n).sqrt());
        assert!(mean(|row| row[0] * row[1]).abs() < 4.0 / n.sqrt());
    }

    #[test]
    fn a_seed_gives_the_same_noise_on_every_platform() {
        let mut noise = Noise::new(&Measurement { noise_std: 1.0, seed: 2000, quantised: false });
        let mixed = (0..20_000).fold(0_u64, |mixed, _| mixed.rotate_left(7) ^ noise.deviation().to_bits());
        assert_eq!(mixed, 17_554_538_392_856_532_387);
        assert_ne!(signals(1.0, 1, false, 0.1), signals(1.0, 2, false, 0.1));
    }

    #[test]
    fn a_real_sensor_rounds_and_saturates() {
        assert_eq!(signals(0.0, 1, false, 0.3)[0], 15.0);
        assert_eq!(signals(0.0, 1, true, 0.3)[0], 10.0);
        assert!((signals(0.0, 1, true, 0.100_06)[0] - 5.0).abs() < 1e-12);
    }
}
