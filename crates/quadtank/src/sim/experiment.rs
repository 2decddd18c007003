use std::array::from_fn;

use serde::{Deserialize, Serialize};

use crate::plant::OperatingPoint;

/// A step of a reference of at most this size has no figures (m): no sensor resolves it, and rounding errors of a level, which
/// are up to 2e-15 m, would show in shares of a still smaller one.
pub(super) const MIN_STEP: f64 = 1e-9;

/// Sum of changes that act together; exactly 0 where they cancel to rounding.
pub(super) fn net(changes: impl Iterator<Item = f64> + Clone) -> f64 {
    let sum: f64 = changes.clone().sum();
    let rounding: f64 = changes.map(|change| f64::EPSILON * change.abs()).sum();
    if sum.abs() <= 2.0 * rounding { 0.0 } else { sum }
}

/// A step of one reference, relative to the operating point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
    /// Flow into a tank from outside of the rig, added to its constant inflow `QuadrupleTank::inflow`.
    TankFlow {
        /// Index of the tank, 0 to 3.
        tank: usize,
        /// Additional flow (m³/s).
        flow: f64,
    },
    /// A pump whose flow at any voltage grows by a share of what it is on the rig, as when it wears out or clogs.
    PumpGain {
        /// Index of the pump, 0 or 1.
        pump: usize,
        /// Share by which the flow grows; −1 stops the pump, and less than that does too.
        change: f64,
    },
    /// A valve that is turned by hand.
    Valve {
        /// Index of the valve, 0 or 1.
        valve: usize,
        /// Change of the valve fraction, which stays within 0 to 1.
        change: f64,
    },
    /// An outlet that is throttled or widened.
    Outlet {
        /// Index of the tank, 0 to 3.
        tank: usize,
        /// Share by which the area of the outlet grows; −1 closes it, and less than that does too.
        change: f64,
    },
}

impl Load {
    /// The size of the change: a flow (m³/s), an area (m²) or a share.
    pub fn size_mut(&mut self) -> &mut f64 {
        match self {
            Self::PumpFlow { flow, .. } | Self::TankFlow { flow, .. } => flow,
            Self::Leak { area, .. } => area,
            Self::PumpGain { change, .. } | Self::Valve { change, .. } | Self::Outlet { change, .. } => change,
        }
    }

    /// What the load acts on, as an index that no other kind of load has, and the size of the change.
    fn change(self) -> (usize, f64) {
        match self {
            Self::PumpFlow { pump, flow } => (pump, flow),
            Self::Leak { tank, area } => (2 + tank, area),
            Self::TankFlow { tank, flow } => (6 + tank, flow),
            Self::PumpGain { pump, change } => (10 + pump, change),
            Self::Valve { valve, change } => (12 + valve, change),
            Self::Outlet { tank, change } => (14 + tank, change),
        }
    }
}

/// A load that begins at a time and stays.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct LoadStep {
    /// When (s).
    pub time_s: f64,
    /// What acts from then on.
    pub load: Load,
}

/// A step of the voltage of a pump that is moved by hand.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PumpVoltageStep {
    /// Index of the pump, 0 or 1.
    pub pump: usize,
    /// When (s): at the first sample at or after it.
    pub time_s: f64,
    /// The voltage from then on (V).
    pub voltage: f64,
}

/// A step of the flow that a tank receives from outside, as it was measured.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct InflowStep {
    /// Index of the tank, 0 to 3.
    pub tank: usize,
    /// When (s): exactly then.
    pub time_s: f64,
    /// The flow from then on (m³/s).
    pub flow: f64,
}

/// What the sensors add to the true level.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
    /// Levels that the run begins at (m); absent for those of the operating point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub initial_levels: Option<[f64; 4]>,
    /// Steps of the voltages of pumps that are moved by hand, as an input sequence. A pump that has one here follows no controller:
    /// until its first step it keeps the voltage of the operating point.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pump_voltage_steps: Vec<PumpVoltageStep>,
    /// Steps of the flow into tanks from outside, as a measured disturbance. From its first step on it takes the place of the constant
    /// inflow of the rig; loads add to either.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub inflow_steps: Vec<InflowStep>,
    /// Process noise: standard deviation of the white Gaussian noise on the flow of each pump (m³/s), drawn anew at each sample
    /// and held until the next, from the same seed as the noise of the sensors.
    #[serde(default, skip_serializing_if = "crate::numeric::is_zero")]
    pub pump_flow_noise_std: f64,
}

impl Experiment {
    /// An experiment of `duration_s` (s) in which nothing happens: ideal sensors, no steps, no loads.
    pub const fn at_rest(duration_s: f64) -> Self {
        Self {
            duration_s,
            set_point_steps: Vec::new(),
            load_steps: Vec::new(),
            measurement: Measurement { noise_std: 0.0, seed: 0, quantised: false },
            initial_levels: None,
            pump_voltage_steps: Vec::new(),
            inflow_steps: Vec::new(),
            pump_flow_noise_std: 0.0,
        }
    }

    /// Reference of a level (m) right after `time_s` (s), where it rests at `rest` (m) before any step.
    pub fn reference_after(&self, level: usize, rest: f64, time_s: f64) -> f64 {
        let before = self.set_point_steps.iter().filter(|s| s.level == level && s.time_s <= time_s);
        before.map(|s| s.size).fold(rest, |sum, size| sum + size)
    }

    /// The levels that a run begins at (m), which are those of the operating point where none are given.
    pub fn first_levels<'a>(&'a self, operating_point: &'a OperatingPoint) -> &'a [f64; 4] {
        self.initial_levels.as_ref().unwrap_or(&operating_point.levels)
    }

    /// Whether a pump follows a sequence and no controller.
    pub fn is_by_hand(&self, pump: usize) -> bool {
        self.pump_voltage_steps.iter().any(|step| step.pump == pump)
    }

    /// The reference step (m) that comes first, in all levels that step at that time; `None` when no reference moves. Steps
    /// of one level at the same time add up, and those that cancel are none.
    pub fn first_reference_step(&self) -> Option<[f64; 2]> {
        let mut times: Vec<f64> = self.set_point_steps.iter().map(|step| step.time_s).collect();
        times.sort_by(f64::total_cmp);
        let step_at = |time_s: f64| -> [f64; 2] {
            from_fn(|level| {
                let acting = self.set_point_steps.iter().filter(|step| step.level == level && step.time_s == time_s);
                net(acting.map(|step| step.size))
            })
        };
        times.into_iter().map(step_at).find(|step| *step != [0.0; 2])
    }

    /// The first step of the reference of a level (m), which is all of its steps at that time, added; `None` when it never moves.
    pub fn first_step_of(&self, level: usize) -> Option<f64> {
        let of_level = self.set_point_steps.iter().filter(|step| step.level == level).copied();
        let [first, second] = Self { set_point_steps: of_level.collect(), ..self.clone() }.first_reference_step()?;
        Some(if level == 0 { first } else { second })
    }

    /// Whether sensors or pumps are noisy.
    pub fn is_noisy(&self) -> bool {
        self.measurement.noise_std > 0.0 || self.pump_flow_noise_std > 0.0
    }

    /// The same experiment without noise of sensors and pumps.
    #[must_use]
    pub fn without_noise(&self) -> Self {
        let measurement = Measurement { noise_std: 0.0, ..self.measurement };
        Self { measurement, pump_flow_noise_std: 0.0, ..self.clone() }
    }

    /// When the reference of a level (index) would first step at the end of the experiment or after it (s).
    pub fn step_after_end_s(&self, level: usize) -> Option<f64> {
        let steps = self.set_point_steps.iter().filter(|step| step.level == level && step.size != 0.0);
        steps.map(|step| step.time_s).filter(|&time_s| time_s >= self.duration_s).min_by(f64::total_cmp)
    }

    /// When a load, or a pump that is moved by hand, first changes after `time_s` (s). Loads that cancel or have no size change nothing.
    pub(super) fn next_change_s(&self, time_s: f64) -> Option<f64> {
        self.changes_s().filter(|&begin| begin > time_s).min_by(f64::total_cmp)
    }

    /// When one of them last changed before `time_s` (s).
    pub(super) fn last_change_s(&self, time_s: f64) -> Option<f64> {
        self.changes_s().filter(|&begin| begin < time_s).max_by(f64::total_cmp)
    }

    fn changes_s(&self) -> impl Iterator<Item = f64> {
        let inflows = self.inflow_steps.iter().map(|step| step.time_s);
        self.load_changes_s().chain(self.pump_voltage_steps.iter().map(|step| step.time_s)).chain(inflows)
    }

    /// The steps of loads and of measured inflows as changes of what acts, where the rig has this constant inflow (m³/s), by time.
    pub fn all_loads(&self, inflow: [f64; 4]) -> Vec<LoadStep> {
        let mut flow = inflow;
        let mut steps = self.load_steps.clone();
        let mut measured: Vec<&InflowStep> = self.inflow_steps.iter().filter(|step| step.tank < 4).collect();
        measured.sort_by(|one, other| one.time_s.total_cmp(&other.time_s));
        for &InflowStep { tank, time_s, flow: next } in measured {
            steps.push(LoadStep { time_s, load: Load::TankFlow { tank, flow: next - flow[tank] } });
            flow[tank] = next;
        }
        steps
    }

    /// When loads change (s), those left out that cancel or have no size.
    fn load_changes_s(&self) -> impl Iterator<Item = f64> {
        let changes_at = |begin: f64| {
            let acting = || self.load_steps.iter().filter(|step| step.time_s == begin).map(|step| step.load.change());
            acting().any(|(index, _)| net(acting().filter(|change| change.0 == index).map(|change| change.1)) != 0.0)
        };
        self.load_steps.iter().map(|step| step.time_s).filter(move |&begin| changes_at(begin))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_steps(steps: &[(usize, f64, f64)]) -> Experiment {
        Experiment {
            set_point_steps: steps.iter().map(|&(level, time_s, size)| SetPointStep { level, time_s, size }).collect(),
            ..Experiment::at_rest(100.0)
        }
    }

    #[test]
    fn a_reference_rests_and_then_adds_up_its_own_steps() {
        let experiment = with_steps(&[(0, 10.0, 0.25), (1, 20.0, 0.5), (0, 30.0, -0.125)]);
        let reference = |time_s| experiment.reference_after(0, 2.0, time_s);
        assert_eq!([0.0, 10.0, 25.0, 30.0, 90.0].map(reference), [2.0, 2.25, 2.25, 2.125, 2.125]);
        assert_eq!(experiment.reference_after(1, 3.0, 90.0), 3.5);
    }

    #[test]
    fn the_first_step_is_of_all_levels_that_move_at_that_time() {
        let experiment =
            with_steps(&[(0, 30.0, 1.0), (1, 5.0, 0.0), (1, 10.0, 0.5), (0, 10.0, -0.25), (0, 10.0, 0.125)]);
        assert_eq!(experiment.first_reference_step(), Some([-0.125, 0.5]));
        assert_eq!(with_steps(&[(0, 10.0, 0.0)]).first_reference_step(), None);
    }

    #[test]
    fn steps_that_cancel_are_none() {
        let cancelling = [(0, 5.0, 0.1), (0, 5.0, 0.2), (0, 5.0, -0.3), (1, 9.0, 0.25), (0, 12.0, 1.0)];
        assert_eq!(with_steps(&cancelling).first_reference_step(), Some([0.0, 0.25]));
        assert_eq!(with_steps(&cancelling[..3]).first_reference_step(), None);
        // The smallest number is a step where nothing cancels it.
        assert_eq!(with_steps(&[(0, 5.0, 5e-324)]).first_reference_step(), Some([5e-324, 0.0]));
    }

    #[test]
    fn the_next_load_is_the_first_that_changes_anything() {
        let flow = |time_s: f64, pump: usize, flow: f64| LoadStep { time_s, load: Load::PumpFlow { pump, flow } };
        let leak = |time_s: f64, tank: usize, area: f64| LoadStep { time_s, load: Load::Leak { tank, area } };
        let mut experiment = with_steps(&[]);
        experiment.load_steps = vec![
            leak(40.0, 0, 1e-6),
            flow(20.0, 0, 1e-6),
            flow(20.0, 0, -1e-6),
            leak(25.0, 3, 0.0),
            flow(30.0, 0, 1e-6),
            flow(30.0, 1, -1e-6),
        ];
        assert_eq!([0.0, 30.0, 40.0].map(|after| experiment.next_change_s(after)), [Some(30.0), Some(40.0), None]);
        assert_eq!([30.0, 40.0, 99.0].map(|before| experiment.last_change_s(before)), [None, Some(30.0), Some(40.0)]);
    }
}
