use crate::control::{AntiWindup, DecentralisedPi, LoopMode, PiSettings};
use crate::literature::{PresetId, ReferenceMoves};
use crate::sim::{Experiment, Measurement, SetPointStep};

use super::{OperatingPointSpec, PlantSpec, Setup};

/// Tracking time over integral time (Cocota 2009, §4.2: Tt = Ti/2).
const TRACKING_RATIO: f64 = 0.5;
/// Set-point steps as a share of the operating level (Cocota 2009, §4.2).
const RELATIVE_STEP: f64 = 0.05;

/// A published rig at its published inputs, with its published controller where there is one, and an experiment that
/// moves the references as published, else each by 5 % of its exact equilibrium level.
pub fn setup_of(id: PresetId) -> Setup {
    let preset = id.preset();
    let [rest_1, rest_2, ..] = preset.plant.free_equilibrium(preset.pump_voltage).levels;
    let pi = |i: usize| PiSettings {
        gain: preset.pi.gains[i],
        integral_time_s: preset.pi.integral_times_s[i],
        set_point_weight: 1.0,
        anti_windup: AntiWindup::BackCalculation { tracking_ratio: TRACKING_RATIO },
        mode: LoopMode::Automatic,
    };
    Setup {
        plant: PlantSpec::Preset(id),
        valves: preset.plant.valves,
        operating_point: OperatingPointSpec::PumpVoltage(preset.pump_voltage),
        controller: DecentralisedPi {
            pairing: preset.pi.pairing,
            loops: [pi(0), pi(1)],
            sampling_time_s: preset.pi.sampling_time_s,
        },
        experiment: Experiment {
            set_point_steps: set_point_steps(preset.pi.references, [rest_1, rest_2]),
            measurement: Measurement { noise_std: 0.0, seed: 1, quantised: false },
            ..Experiment::at_rest(preset.pi.duration_s)
        },
    }
}

/// The steps of the references, which rest at `rest` (m).
fn set_point_steps(moves: ReferenceMoves, rest: [f64; 2]) -> Vec<SetPointStep> {
    match moves {
        ReferenceMoves::Apart(times_s) => {
            let step = |level: usize| SetPointStep { level, time_s: times_s[level], size: RELATIVE_STEP * rest[level] };
            vec![step(0), step(1)]
        }
        ReferenceMoves::Sequence(levels) => {
            let mut steps = Vec::new();
            let mut last = rest;
            for &(time_s, next) in levels {
                let moved = (0..2).filter(|&level| next[level] != last[level]);
                steps.extend(moved.map(|level| SetPointStep { level, time_s, size: next[level] - last[level] }));
                last = next;
            }
            steps
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sequence_goes_to_its_levels() {
        let setup = setup_of(PresetId::Seville);
        let [rest_1, rest_2, ..] = setup.operating_point().unwrap().levels;
        let references = |time_s: f64| {
            [(0, rest_1), (1, rest_2)].map(|(level, rest)| setup.experiment.reference_after(level, rest, time_s))
        };
        for (time_s, expected) in
            [(3000.0, [0.30, 0.30]), (5999.0, [0.30, 0.30]), (6000.0, [0.50, 0.75]), (9000.0, [0.90, 0.75])]
        {
            for (found, expected) in references(time_s).into_iter().zip(expected) {
                assert!((found - expected).abs() < 1e-15, "{found} for {expected} at {time_s} s");
            }
        }
        // Level 2 stays where it is at 9000 s, and both rest at 0.65 m before the first step.
        assert_eq!(setup.experiment.set_point_steps.len(), 5);
        assert!(references(0.0).iter().all(|level| (level - 0.65).abs() < 0.005));
        assert_eq!((setup.controller.sampling_time_s, setup.experiment.duration_s), (5.0, 12_000.0));
    }
}
