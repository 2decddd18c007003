use crate::control::{AntiWindup, DecentralisedPi, LoopMode, PiSettings};
use crate::literature::PresetId;
use crate::sim::{Experiment, Measurement, SetPointStep};

use super::{OperatingPointSpec, PlantSpec, Setup};

/// Sampling time of every published run (Cocota 2009, table of §4.2; Junqueira et al.).
const SAMPLING_TIME_S: f64 = 1.0;
/// Tracking time over integral time (Cocota 2009, §4.2: Tt = Ti/2).
const TRACKING_RATIO: f64 = 0.5;
/// Set-point steps as a share of the operating level (Cocota 2009, §4.2).
const RELATIVE_STEP: f64 = 0.05;

/// A published rig at its published inputs, with its published controller where there is one, and an experiment that
/// steps both references by 5 % of their exact equilibrium levels.
pub fn setup_of(id: PresetId) -> Setup {
    let preset = id.preset();
    let levels = preset.plant.free_equilibrium(preset.pump_voltage).levels;
    let step = |level: usize| SetPointStep {
        level,
        time_s: preset.pi.step_times_s[level],
        size: RELATIVE_STEP * levels[level],
    };
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
            sampling_time_s: SAMPLING_TIME_S,
        },
        experiment: Experiment {
            duration_s: preset.pi.duration_s,
            set_point_steps: vec![step(0), step(1)],
            load_steps: Vec::new(),
            measurement: Measurement { noise_std: 0.0, seed: 1, quantised: false },
            initial_levels: None,
            pump_voltage_steps: Vec::new(),
        },
    }
}
