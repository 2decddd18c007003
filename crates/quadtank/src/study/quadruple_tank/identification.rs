use crate::sim::{PumpVoltageStep, binary_moves};

use super::Setup;

/// How far a pseudo-random sequence moves a pump to either side, as a share of its range.
const SHARE: f64 = 0.05;
/// Bits of such a sequence in an experiment.
const BITS: f64 = 60.0;

impl Setup {
    /// Pseudo-random steps of both pumps around the operating point, within their limits, each at a sample: an experiment from which a
    /// rig can be identified. Empty where there is no operating point.
    pub fn random_moves(&self) -> Vec<PumpVoltageStep> {
        let Ok(point) = self.operating_point() else { return Vec::new() };
        let pumps = self.plant().pumps;
        let end = |side: f64| {
            [0, 1].map(|k| {
                let range = pumps[k].voltage_max - pumps[k].voltage_min;
                (point.pump_voltage[k] + side * SHARE * range).max(pumps[k].voltage_min).min(pumps[k].voltage_max)
            })
        };
        let sampling = self.controller.sampling_time_s;
        let clock_s = (self.experiment.duration_s / BITS / sampling).ceil() * sampling;
        binary_moves(end(-1.0), end(1.0), clock_s, self.experiment.duration_s)
    }
}

#[cfg(test)]
mod tests {
    use crate::literature::PresetId;
    use crate::study::quadruple_tank::{run, setup_of};

    #[test]
    fn random_moves_are_at_samples_within_the_limits() {
        for id in PresetId::ALL {
            let mut setup = setup_of(id);
            let moves = setup.random_moves();
            assert!(moves.len() > 40, "{id:?}: {}", moves.len());
            for step in &moves {
                let pump = setup.plant().pumps[step.pump];
                assert!((pump.voltage_min..=pump.voltage_max).contains(&step.voltage), "{id:?} {step:?}");
                let samples = step.time_s / setup.controller.sampling_time_s;
                assert!((samples - samples.round()).abs() < 1e-9, "{id:?} {step:?}");
            }
            setup.experiment.pump_voltage_steps = moves;
            assert!(run(&setup).is_ok(), "{id:?}");
        }
    }
}
