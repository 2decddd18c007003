use thiserror::Error;

use crate::assess::{
    BothIndices, HarrisError, HarrisIndex, IndexError, LoopQuality, ValveTravel, VarianceIndex, harris_index,
};
use crate::linear::LinearError;
use crate::sim::level::{LevelController, LevelFigures, LevelLog, LevelRunError, LevelSimulation, LevelStepResponse};

use super::{Finding, LevelLoopSetup, Objective, findings};

/// The run of the loop with all figures.
#[derive(Clone, Debug, PartialEq)]
pub struct LevelLoopAnswer {
    /// The log.
    pub log: LevelLog,
    /// Figures of it.
    pub figures: LevelFigures,
    /// The answer to the set-point; `None` where that does not step once, at the start.
    pub step: Option<LevelStepResponse>,
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
    let step = match experiment.set_point_steps.as_slice() {
        [step] if step.time_s <= 0.0 => {
            LevelStepResponse::of(&log, experiment.step_in_metres(step, &plant.transmitter))
        }
        _ => None,
    };
    let quality = LoopQuality::of(simulation.gains(), &setup.controller);
    let harris = harris_index(&log.level, setup.harris.dead_time_rows, setup.harris.order);
    let findings = findings::of(setup, &plant, &log, &figures, quality.as_ref().ok().and_then(Option::as_ref));
    let travel = ValveTravel::of(&log.travel);
    Ok(LevelLoopAnswer { log, figures, step, travel, quality, reference, indices, harris, findings })
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
            let offset = answer.step.unwrap().offset;
            assert!((offset - missing / 0.05).abs() < 1e-9 && offset.abs() < 0.01, "{offset}");
        }
    }
}
