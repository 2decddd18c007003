use crate::control::{ModelFree, ModelFreeWindup};
use crate::plant::ValveSchedule;
use crate::scenario::codec::{misread, tree_of, version_of};
use crate::scenario::limits::{self, Limits};
use crate::scenario::validate::{Checked, check_controller, check_experiment, check_plant, each, pair, within};
use crate::scenario::{ScenarioError, Tree};

use super::{ModelFreeScenario, ModelFreeSetup, StartSpec};

/// Gain α̂ of the ultra-local model (m/(s V)).
const MODEL_GAIN: Limits = Limits::new(1e-7, 1.0);
/// Kp (1/s), and Ki (1/s²).
const FEEDBACK: Limits = Limits::new(0.0, 1e3);
/// Angular frequency of a valve (rad/s).
const FREQUENCY: Limits = Limits::new(0.0, 10.0);
/// Phase of a valve (rad).
const PHASE: Limits = Limits::new(-100.0, 100.0);

/// Reads a document of version 3 from JSON: length, then version, then shape, then every number.
///
/// # Errors
/// As [`from_json`](crate::scenario::from_json).
pub fn model_free_from_json(text: &str) -> Result<ModelFreeScenario, ScenarioError> {
    let tree: Tree = tree_of(text)?;
    let found = version_of(&tree)?;
    if found != u64::from(ModelFreeScenario::VERSION) {
        return Err(ScenarioError::UnknownVersion { found, newest: ModelFreeScenario::VERSION });
    }
    let scenario: ModelFreeScenario = tree.read().map_err(|error| misread(&error))?;
    scenario.validate()?;
    Ok(scenario)
}

impl ModelFreeScenario {
    /// Checks every number and the lengths of all lists.
    ///
    /// # Errors
    /// [`ScenarioError::OutOfRange`], [`ScenarioError::Law`] or [`ScenarioError::TooMany`] for the first field that is
    /// not allowed.
    pub fn validate(&self) -> Result<(), ScenarioError> {
        self.model_free.validate()
    }
}

impl ModelFreeSetup {
    fn validate(&self) -> Checked {
        const ROOT: &str = "model_free";
        check_plant(&self.plant, &format!("{ROOT}.plant"))?;
        each(&self.valves, format_args!("{ROOT}.valves"), check_valve)?;
        if let StartSpec::Rest(levels) = self.start {
            pair(levels, limits::LEVEL, format_args!("{ROOT}.start.rest"))?;
        }
        check_law(&self.controller, &format!("{ROOT}.controller"))?;
        if let Some(compare) = &self.compare {
            check_controller(compare, &format!("{ROOT}.compare"))?;
            // Its samples are no more than those of the law, whose duration is checked below.
            let sampling_time = Limits { min: self.controller.sampling_time_s.min(1.0), ..limits::SAMPLING_TIME_S };
            within(compare.sampling_time_s, sampling_time, format_args!("{ROOT}.compare.sampling_time_s"))?;
        }
        check_experiment(&self.experiment, self.controller.sampling_time_s, &format!("{ROOT}.experiment"))
    }
}

/// γ stays in [0, 1] whatever the time.
fn check_valve(valve: &ValveSchedule, path: &str) -> Checked {
    match *valve {
        ValveSchedule::Constant { .. } => {}
        ValveSchedule::Step { at_s, .. } => within(at_s, limits::TIME_S, format_args!("{path}.step.at_s"))?,
        ValveSchedule::Ramp { begin_s, end_s, .. } => {
            within(begin_s, limits::TIME_S, format_args!("{path}.ramp.begin_s"))?;
            within(end_s, Limits { min: begin_s, ..limits::TIME_S }, format_args!("{path}.ramp.end_s"))?;
        }
        ValveSchedule::Sine { frequency, phase, .. } => {
            within(frequency, FREQUENCY, format_args!("{path}.sine.frequency"))?;
            within(phase, PHASE, format_args!("{path}.sine.phase"))?;
        }
    }
    let (lowest, highest) = valve.extremes();
    within(lowest, limits::VALVE, path)?;
    within(highest, limits::VALVE, path)
}

fn check_law(law: &ModelFree, path: &str) -> Checked {
    each(&law.loops, format_args!("{path}.loops"), |settings, path| {
        within(settings.model_gain, MODEL_GAIN, format_args!("{path}.model_gain"))?;
        within(settings.proportional, FEEDBACK, format_args!("{path}.proportional"))?;
        within(settings.integral, FEEDBACK, format_args!("{path}.integral"))?;
        match settings.anti_windup {
            ModelFreeWindup::Off | ModelFreeWindup::Conditional => Ok(()),
            ModelFreeWindup::BackCalculation { tracking_time_s } => within(
                tracking_time_s,
                limits::INTEGRAL_TIME_S,
                format_args!("{path}.anti_windup.back_calculation.tracking_time_s"),
            ),
        }
    })?;
    within(law.sampling_time_s, limits::SAMPLING_TIME_S, format_args!("{path}.sampling_time_s"))?;
    let Some(estimator) = law.estimator else { return Ok(()) };
    let samples = estimator.samples(law.sampling_time_s).map(|_| ());
    samples.map_err(|error| ScenarioError::Law { field: format!("{path}.estimator.window_s"), error })
}
