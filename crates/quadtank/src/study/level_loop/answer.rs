use thiserror::Error;

use crate::assess::{
    BothIndices, HarrisError, HarrisIndex, IndexError, LoopQuality, ValveTravel, VarianceIndex, harris_index,
};
use crate::linear::{LinearError, LoopStability};
use crate::plant::level::LevelPlant;
use crate::sim::level::{
    LevelController, LevelExperiment, LevelFigures, LevelLog, LevelRunError, LevelSimulation, LevelStepResponse,
    NoStepAnswer,
};

use super::{Finding, LevelLoopSetup, Objective, findings};

/// The run of the loop with all figures.
#[derive(Clone, Debug, PartialEq)]
pub struct LevelLoopAnswer {
    /// The log.
    pub log: LevelLog,
    /// Figures of it.
    pub figures: LevelFigures,
    /// The answer to the set-point, or why there is none; `None` where that does not step once, at the start.
    pub step: Option<Result<LevelStepResponse, NoStepAnswer>>,
    /// How the valve moves.
    pub travel: ValveTravel,
    /// Stability and margins of the linear loop; `None` for an output by hand.
    pub quality: Result<Option<LoopQuality>, LinearError>,
    /// The run of the reference tuning on the model with its error.
    pub reference: Result<LevelFigures, LevelRunError>,
    /// Variances of the reference over those of the loop; `None` without a run of the reference.
    pub indices: Option<Result<BothIndices, IndexError>>,
    /// The Harris index of the level.
    pub harris: Result<HarrisIndex, HarrisError>,
    /// What is to be said about the run.
    pub findings: Vec<Finding>,
}

/// Why there is no run.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("{field}: {fault}")]
pub struct LevelLoopError {
    /// Part of the setup.
    pub field: &'static str,
    /// What is wrong.
    pub fault: LevelRunError,
}

impl LevelLoopAnswer {
    /// The index of the objective: of the level for tight, of the outflow for averaging control.
    pub fn index_for(&self, objective: Objective) -> Option<VarianceIndex> {
        let both = self.indices?.ok()?;
        Some(match objective {
            Objective::Tight => both.level,
            Objective::Averaging { .. } => both.outflow,
        })
    }
}

/// Runs the loop of a setup.
///
/// # Errors
/// [`LevelLoopError`] with the part of the setup that allows no run.
pub fn run_level_loop(setup: &LevelLoopSetup) -> Result<LevelLoopAnswer, LevelLoopError> {
    let at = |field| move |fault| LevelLoopError { field, fault };
    setup.controller.check().map_err(at("controller"))?;
    let plant = setup.plant();
    let simulation = LevelSimulation::new(&plant, &setup.experiment).map_err(at("experiment"))?;
    let log = simulation.run(&setup.controller).map_err(at("controller"))?;
    let gain = plant.transmitter.gain();
    let experiment = &setup.experiment;
    let figures = LevelFigures::of(&log, gain).ok_or_else(|| at("experiment")(experiment.empty_log()))?;
    let reference = reference_figures(setup);
    let indices = reference
        .as_ref()
        .ok()
        .map(|reference| BothIndices::of(&[reference.level, reference.outflow], &[figures.level, figures.outflow]));
    let quality = LoopQuality::of(simulation.gains(), &setup.controller);
    let step = step_at_start(experiment, &plant).map(|step| step_answer(&log, step, &quality));
    let harris = harris_index(&log.level, setup.harris.dead_time_rows, setup.harris.order);
    let findings = findings::of(setup, &plant, &log, &figures, quality.as_ref().ok().and_then(Option::as_ref));
    let travel = ValveTravel::of(&log.travel);
    Ok(LevelLoopAnswer { log, figures, step, travel, quality, reference, indices, harris, findings })
}

/// Size (m) of the step of the set-point where there is one alone, at the start.
fn step_at_start(experiment: &LevelExperiment, plant: &LevelPlant) -> Option<f64> {
    match experiment.set_point_steps.as_slice() {
        [step] if step.time_s <= 0.0 && step.size != 0.0 => Some(experiment.step_in_metres(step, &plant.transmitter)),
        _ => None,
    }
}

/// The answer to a step (m) of the set-point of a loop. Stability that is not computed is no reason to keep it back.
fn step_answer(
    log: &LevelLog,
    step: f64,
    quality: &Result<Option<LoopQuality>, LinearError>,
) -> Result<LevelStepResponse, NoStepAnswer> {
    match quality.as_ref().map(|quality| quality.map(|quality| quality.stability)) {
        Ok(None) => Err(NoStepAnswer::ByHand),
        Ok(Some(LoopStability::Unstable { .. } | LoopStability::AlgebraicLoop { .. })) => {
            Err(NoStepAnswer::UnstableLoop)
        }
        Ok(Some(LoopStability::Marginal { .. })) => Err(NoStepAnswer::MarginalLoop),
        Ok(Some(LoopStability::Stable | LoopStability::NotComputed { .. })) | Err(_) => {
            LevelStepResponse::of(log, step).ok_or(NoStepAnswer::DoesNotMove)
        }
    }
}

/// The reference tuning on the model, which starts at its own bias (Andreis 2017, §5.1).
fn reference_figures(setup: &LevelLoopSetup) -> Result<LevelFigures, LevelRunError> {
    let model = setup.model();
    let controller = LevelController::Pi {
        gain: setup.reference.gain,
        integral_time_s: setup.reference.integral_time_s,
        anti_windup: setup.anti_windup(),
    };
    let experiment = &setup.experiment;
    let log = LevelSimulation::new(&model, experiment)?.run(&controller)?;
    LevelFigures::of(&log, model.transmitter.gain()).ok_or_else(|| experiment.empty_log())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::literature::LevelPresetId;
    use crate::literature::andreis::PublishedDisturbance;
    use crate::sim::level::{InflowDisturbance, SetPointScale, SignalStep};
    use crate::study::level_loop::published_setup;

    /// The loop of Andreis (2017), whose transmitter sends 4 to 20 mA, without a disturbance, with a step of 5 cm.
    fn stepped(gain: f64, integral_time_s: f64, scale: SetPointScale) -> LevelLoopAnswer {
        let mut setup = published_setup(LevelPresetId::Andreis, PublishedDisturbance::SineL);
        let size = match scale {
            SetPointScale::Level => 0.05,
            SetPointScale::Signal => 0.05 * setup.plant().transmitter.gain(),
        };
        setup.controller = LevelController::pi(gain, integral_time_s);
        setup.experiment.disturbance = InflowDisturbance::NONE;
        setup.experiment.set_point_steps = vec![SignalStep { time_s: 0.0, size }];
        setup.experiment.set_point_scale = scale;
        run_level_loop(&setup).unwrap()
    }

    #[test]
    fn the_offset_of_a_step_does_not_depend_on_the_zero_of_the_transmitter() {
        for scale in [SetPointScale::Level, SetPointScale::Signal] {
            let answer = stepped(10.0, 250.0, scale);
            let missing = 1.05 - answer.log.level.last().unwrap();
            let offset = answer.step.unwrap().unwrap().offset;
            assert!((offset - missing / 0.05).abs() < 1e-9 && offset.abs() < 0.01, "{offset}");
        }
    }
    #[test]
    fn a_loop_that_does_not_come_to_rest_has_no_times() {
        let unstable = stepped(100.0, 588.0, SetPointScale::Level);
        assert!(unstable.quality.unwrap().unwrap().sensitivity_peak().is_none());
        assert_eq!(unstable.step, Some(Err(NoStepAnswer::UnstableLoop)));
        // Without a gain the level moves by rounding alone, which once had an overshoot.
        assert_eq!(stepped(0.0, 588.0, SetPointScale::Level).step, Some(Err(NoStepAnswer::DoesNotMove)));
        let settled = stepped(10.0, 250.0, SetPointScale::Level).step.unwrap().unwrap();
        assert!(settled.settling_time_s.is_some_and(|time| time < 270.0), "{settled:?}");
    }

    #[test]
    fn an_output_by_hand_does_not_answer_the_set_point() {
        let mut setup = published_setup(LevelPresetId::Andreis, PublishedDisturbance::SineL);
        setup.controller = LevelController::off();
        setup.experiment.set_point_steps = vec![SignalStep { time_s: 0.0, size: 0.05 }];
        assert_eq!(run_level_loop(&setup).unwrap().step, Some(Err(NoStepAnswer::ByHand)));
    }
}
