use serde::{Deserialize, Serialize};

/// A step of one reference, relative to the operating point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SetPointStep {
    /// Index of the loop (and lower tank), 0 or 1.
    pub level: usize,
    /// When (s).
    pub time_s: f64,
    /// By how much (m of level).
    pub size: f64,
}

/// What a load step changes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Load {
    /// Flow added to that of a pump, ahead of its valve.
    PumpFlow {
        /// Index of the pump, 0 or 1.
        pump: usize,
        /// Additional flow (m³/s).
        flow: f64,
    },
    /// A hole in the bottom of a tank; its water leaves the plant.
    Leak {
        /// Index of the tank, 0 to 3.
        tank: usize,
        /// Area of the hole (m²).
        area: f64,
    },
}

/// A load that begins at a time and stays.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct LoadStep {
    /// When (s).
    pub time_s: f64,
    /// What.
    pub load: Load,
}

/// What the sensors add to the true level.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Measurement {
    /// Standard deviation of white Gaussian noise at each sample (m of level); 0 for none.
    pub noise_std: f64,
    /// Seed of the noise: the same seed gives the same run everywhere.
    pub seed: u32,
    /// Whether the range and the resolution of the sensor apply.
    pub quantised: bool,
}

/// What is done to the closed loop, from the operating point on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Experiment {
    /// How long (s).
    pub duration_s: f64,
    /// Steps of the references.
    pub set_point_steps: Vec<SetPointStep>,
    /// Steps of the loads.
    pub load_steps: Vec<LoadStep>,
    /// Sensors.
    pub measurement: Measurement,
}

impl Experiment {
    /// Reference of a level (m) right after `time_s` (s), where it rests at `rest` (m) before any step.
    pub fn reference_after(&self, level: usize, rest: f64, time_s: f64) -> f64 {
        let before = self.set_point_steps.iter().filter(|s| s.level == level && s.time_s <= time_s);
        before.map(|s| s.size).fold(rest, |sum, size| sum + size)
    }

    /// The reference step (m) that comes first, in all levels that step at that time; `None` when no reference moves.
    pub fn first_reference_step(&self) -> Option<[f64; 2]> {
        let moving = || self.set_point_steps.iter().filter(|s| s.size != 0.0);
        let first = moving().map(|s| s.time_s).min_by(f64::total_cmp)?;
        let mut step = [0.0; 2];
        for s in moving().filter(|s| s.time_s == first) {
            if let Some(size) = step.get_mut(s.level) {
                *size += s.size;
            }
        }
        Some(step)
    }
}
