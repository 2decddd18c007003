use serde::Serialize;

use crate::assess::LoopQuality;
use crate::linear::LoopStability;
use crate::plant::level::{LevelError, LevelPlant};
use crate::sim::level::{InflowSignal, LevelController, LevelExperiment, LevelFigures, LevelLog};

use super::{LevelLoopSetup, Objective};

/// What is to be said about a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "finding", rename_all = "kebab-case")]
pub enum Finding {
    /// The loop cannot hold the set-point that it is given.
    SetPointOutOfReach {
        /// The set-point (m).
        level: f64,
        /// Why the loop cannot hold it.
        reason: LevelError,
    },
    /// The tank is full to the brim for a time; what comes in above it is lost.
    TankFull {
        /// How long (s).
        time_s: f64,
    },
    /// The tank is empty for a time.
    TankEmpty {
        /// How long (s).
        time_s: f64,
    },
    /// The output is at an end of its range, so the loop is open.
    OutputAtLimit {
        /// Share of the rows.
        share: f64,
    },
    /// The disturbance takes more from the inflow than there is; less than none is not fed.
    InflowCut {
        /// Lowest inflow of the disturbed experiment (m³/s).
        lowest: f64,
    },
    /// The controller has no gain: nothing is controlled.
    NoGain,
    /// The linear loop is unstable around the rest.
    Unstable,
    /// The level leaves the band of averaging control.
    LeavesBand {
        /// Lowest and highest level (m).
        levels: [f64; 2],
    },
    /// Nothing moves: no variance, and no index.
    NothingMoves,
}

impl Finding {
    /// Whether the finding is a failure of the loop (`true`) or only information about the run (`false`).
    pub const fn is_failure(&self) -> bool {
        match self {
            Self::OutputAtLimit { .. } | Self::InflowCut { .. } | Self::NothingMoves => false,
            Self::SetPointOutOfReach { .. }
            | Self::TankFull { .. }
            | Self::TankEmpty { .. }
            | Self::NoGain
            | Self::Unstable
            | Self::LeavesBand { .. } => true,
        }
    }
}

/// Share of a range within which an output is at its end.
const AT_END: f64 = 1e-9;

pub(super) fn of(
    setup: &LevelLoopSetup,
    plant: &LevelPlant,
    log: &LevelLog,
    figures: &LevelFigures,
    quality: Option<&LoopQuality>,
) -> Vec<Finding> {
    let mut found = Vec::new();
    found.extend(set_point_out_of_reach(setup, plant));
    if log.full_s > 0.0 {
        found.push(Finding::TankFull { time_s: log.full_s });
    }
    if log.empty_s > 0.0 {
        found.push(Finding::TankEmpty { time_s: log.empty_s });
    }
    let range = plant.output.signal;
    let at_end = |output: &&f64| {
        let share = range.share(**output);
        share <= AT_END || share >= 1.0 - AT_END
    };
    let share = log.output.iter().filter(at_end).count() as f64 / log.len() as f64;
    if plant.output.clips && share > 0.0 {
        found.push(Finding::OutputAtLimit { share });
    }
    found.extend(inflow_cut(setup));
    if has_no_gain(&setup.controller) {
        found.push(Finding::NoGain);
    }
    if quality.is_some_and(|quality| matches!(quality.stability, LoopStability::Unstable { .. })) {
        found.push(Finding::Unstable);
    }
    if let Objective::Averaging { band: [low, high] } = setup.objective {
        let levels = [figures.level.minimum, figures.level.maximum];
        if levels[0] < low || levels[1] > high {
            found.push(Finding::LeavesBand { levels });
        }
    }
    if figures.level.is_still() && figures.outflow.is_still() {
        found.push(Finding::NothingMoves);
    }
    found
}

/// The set-point after all its steps, at the inflow of the start and at that of a step of it that lasts.
pub(super) fn set_point_out_of_reach(setup: &LevelLoopSetup, plant: &LevelPlant) -> Option<Finding> {
    let experiment = &setup.experiment;
    if experiment.set_point_steps.is_empty() || matches!(setup.controller, LevelController::Manual { .. }) {
        return None;
    }
    let level = setup.final_set_point();
    let reason = plant.rest(level, (experiment.inflow + lasting_inflow(experiment)).max(0.0)).err()?;
    Some(Finding::SetPointOutOfReach { level, reason })
}

/// What a step of the inflow adds to it until the end (m³/s).
pub(super) fn lasting_inflow(experiment: &LevelExperiment) -> f64 {
    match experiment.disturbance.signal {
        InflowSignal::Step { size } if experiment.disturbance.until_s >= experiment.duration_s => size,
        _ => 0.0,
    }
}

/// Sines and steps that ask for less than no inflow.
fn inflow_cut(setup: &LevelLoopSetup) -> Option<Finding> {
    let least = match setup.experiment.disturbance.signal {
        InflowSignal::Step { size } => size.min(0.0),
        InflowSignal::Sine { amplitude, .. } => -amplitude.abs(),
        // Normal deviates beyond three standard deviations are rare.
        InflowSignal::Normal { std, .. } | InflowSignal::SimulinkNormal { std, .. } => -3.0 * std.abs(),
        InflowSignal::None => 0.0,
    };
    let lowest = setup.experiment.inflow + least;
    (lowest < 0.0).then_some(Finding::InflowCut { lowest })
}

fn has_no_gain(controller: &LevelController) -> bool {
    match controller {
        LevelController::Manual { .. } => false,
        LevelController::Pi { gain, .. } => *gain == 0.0,
        LevelController::Pid { proportional, integral, derivative, .. } => {
            [*proportional, *integral, *derivative] == [0.0; 3]
        }
        LevelController::Sampled { settings, .. } => settings.gain == 0.0,
    }
}
