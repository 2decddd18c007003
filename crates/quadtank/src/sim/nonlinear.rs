//! Runs of the nonlinear plant with its sampled controllers.

use crate::control::DecentralisedPi;
use crate::plant::{Disturbance, OperatingPoint, QuadrupleTank};

use super::course::{self, Events, Process};
use super::experiment::Experiment;
use super::hydraulics::Hydraulics;
use super::trajectory::Trajectory;

/// The plant with its water.
struct Rig<'a> {
    plant: &'a QuadrupleTank,
    water: Hydraulics,
}

impl Process for Rig<'_> {
    fn levels(&self) -> [f64; 4] {
        self.water.levels()
    }

    fn set_inputs(&mut self, pump_voltage: &[f64; 2], disturbance: &Disturbance) {
        self.water.set_inputs(self.plant, pump_voltage, disturbance);
    }

    fn work(&self) -> u64 {
        self.water.work
    }

    fn advance(&mut self, time: f64, duration: f64, events: &mut Events) {
        self.water.advance(time, duration, events);
    }
}

/// Runs an experiment on the nonlinear plant with two sampled PI loops.
///
/// The run starts at the operating point, or at the levels that the experiment gives, clipped to the walls, with the controllers
/// as at rest at the operating point. Samples are at `k Ts`; pump voltages are held between them. A reference, or a pump that is
/// moved by hand, steps at the first sample at or after its time, a load begins at its exact time. A tank that receives more than
/// drains at the top of its wall stays full, and the excess leaves the plant. There is a row per sample, and rows in between where
/// samples are further apart than 1/1500 of the duration. A run of more than [`MAX_ROWS`](super::MAX_ROWS) rows is cut there.
///
/// # Examples
/// A step of one level by 1 cm on the rig of Johansson (2000), and what becomes of it:
/// ```
/// use quadtank::control::{AntiWindup, DecentralisedPi, LoopMode, Pairing, PiSettings};
/// use quadtank::literature::PresetId;
/// use quadtank::sim::{Experiment, Measurement, SetPointStep, loop_metrics, simulate};
///
/// let rig = PresetId::JohanssonMinimumPhase.preset();
/// let rest = rig.plant.equilibrium(rig.pump_voltage)?;
/// let pi = PiSettings {
///     gain: 3.0,
///     integral_time_s: 30.0,
///     set_point_weight: 1.0,
///     anti_windup: AntiWindup::BackCalculation { tracking_ratio: 0.5 },
///     mode: LoopMode::Automatic,
/// };
/// let controller = DecentralisedPi { pairing: Pairing::Diagonal, loops: [pi; 2], sampling_time_s: 1.0 };
/// let experiment = Experiment {
///     set_point_steps: vec![SetPointStep { level: 0, time_s: 100.0, size: 0.01 }],
///     ..Experiment::at_rest(600.0)
/// };
/// let run = simulate(&rig.plant, &rest, &controller, &experiment);
/// let [stepped, other] = loop_metrics(&run, &rig.plant, &controller, &experiment);
/// assert!(stepped.rise_time_s.is_some_and(|time_s| time_s < 60.0));
/// assert_eq!(other.rise_time_s, None);
/// # Ok::<(), quadtank::plant::PlantError>(())
/// ```
pub fn simulate(
    plant: &QuadrupleTank,
    op: &OperatingPoint,
    controller: &DecentralisedPi,
    experiment: &Experiment,
) -> Trajectory {
    let mut rig = Rig { plant, water: Hydraulics::new(plant, experiment.first_levels(op)) };
    course::run_pi(&mut rig, plant, op, controller, experiment)
}
