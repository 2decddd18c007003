use std::sync::Arc;

use crate::control::level_transfer_function;
use crate::plant::level::{LevelError, LevelGains, LevelSignals};
use crate::sim::level::{LevelRunError, LevelSimulation, MAX_LEVEL_STEPS};
use crate::study::{PinnedResults, Quantity, Study, update_pinned};
use crate::tuning::{ProcessModel, UltimatePoint, ultimate_point_of};

use super::quantities::QUANTITIES;
use super::{
    LevelLoopAnswer, LevelLoopError, LevelLoopSetup, ModelSource, StepTestAnswer, StepTestError, Suggestion,
    run_level_loop, run_step_test, suggest,
};

/// The study of the level-loop bench.
#[derive(Clone, Copy, Debug)]
pub struct LevelLoopStudy;

/// The plant around the rest of the experiment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlantAnswer {
    /// Signals at rest.
    pub rest: LevelSignals,
    /// The linear model.
    pub gains: LevelGains,
    /// The same as a first-order process, by the half rule.
    pub model: ProcessModel,
    /// The ultimate point of its linear loop with proportional control; `None` where it has none.
    pub ultimate: Option<UltimatePoint>,
}

/// What the level-loop bench shows of a setup. What is slower and only read, the trade-off and the map of a cost, is computed by
/// [`trade_off`](super::trade_off) and [`ContourMap`](super::ContourMap).
#[derive(Clone, Debug)]
pub struct Results {
    /// The setup that the results are of.
    pub setup: Arc<LevelLoopSetup>,
    /// The plant at rest.
    pub plant: Arc<Result<PlantAnswer, LevelError>>,
    /// The step test.
    pub test: Arc<Result<StepTestAnswer, StepTestError>>,
    /// What the rules suggest.
    pub suggestions: Arc<Vec<Suggestion>>,
    /// The run with its figures.
    pub answer: Arc<Result<LevelLoopAnswer, LevelLoopError>>,
    /// Pinned tunings in the present experiment, see [`LevelLoopSetup::in_experiment_of`].
    pub pinned: PinnedResults<LevelLoopSetup, Result<LevelLoopAnswer, LevelLoopError>>,
}

impl PlantAnswer {
    /// Of a setup.
    ///
    /// # Errors
    /// [`LevelError`] for a rest that does not exist.
    pub fn of(setup: &LevelLoopSetup) -> Result<Self, LevelError> {
        let plant = setup.plant();
        let rest = plant.rest(setup.experiment.level, setup.experiment.inflow)?;
        let gains = plant.gains(&rest);
        let lags = [gains.actuator_lag_s, gains.transmitter_lag_s];
        let model = match (gains.process_gain(), gains.time_constant()) {
            (Some(gain), Some(time_constant)) => {
                ProcessModel::by_half_rule(gain, &[time_constant, lags[0], lags[1]], 0.0)
            }
            _ => ProcessModel::integrating_by_half_rule(gains.slope_gain(), &lags, 0.0),
        };
        let ultimate = level_transfer_function(&gains).and_then(|process| ultimate_point_of(&process)).ok().flatten();
        Ok(Self { rest, gains, model, ultimate })
    }
}

impl Study for LevelLoopStudy {
    type Setup = LevelLoopSetup;
    type Results = Results;
    const QUANTITIES: &'static [Quantity<Results>] = QUANTITIES;

    fn setup_of(results: &Results) -> &Arc<LevelLoopSetup> {
        &results.setup
    }

    /// The test depends on plant and test alone, the plant at rest on the plant and where the experiment starts; a change of the
    /// controller leaves both and the suggestions as they are.
    fn update(setup: &LevelLoopSetup, pinned: &[LevelLoopSetup], last: Option<&Results>) -> Results {
        let compared: Vec<LevelLoopSetup> = pinned.iter().map(|pinned| pinned.in_experiment_of(setup)).collect();
        let bounded = |pinned: &LevelLoopSetup| run_pinned(pinned, compared.len());
        let pinned = update_pinned(&compared, last.map(|last| &last.pinned), bounded);
        if let Some(last) = last.filter(|last| *last.setup == *setup) {
            return Results { pinned, ..last.clone() };
        }
        let same_plant = last.filter(|last| last.setup.plant == setup.plant);
        let test = same_plant.filter(|last| last.setup.test == setup.test).map(|last| Arc::clone(&last.test));
        let test = test.unwrap_or_else(|| Arc::new(run_step_test(&setup.plant(), &setup.test)));
        let plant = same_plant.filter(|last| has_same_rest(&last.setup, setup)).map(|last| Arc::clone(&last.plant));
        let plant = plant.unwrap_or_else(|| Arc::new(PlantAnswer::of(setup)));
        let same_models = last.filter(|last| Arc::ptr_eq(&last.test, &test) && Arc::ptr_eq(&last.plant, &plant));
        let suggestions = same_models.filter(|last| has_same_rule_inputs(&last.setup, setup));
        let suggestions = suggestions
            .map_or_else(|| Arc::new(suggestions_of(setup, &test, &plant)), |last| Arc::clone(&last.suggestions));
        let answer = last.filter(|last| has_same_run(&last.setup, setup)).map(|last| Arc::clone(&last.answer));
        let answer = answer.unwrap_or_else(|| Arc::new(run_level_loop(setup)));
        Results { setup: Arc::new(setup.clone()), plant, test, suggestions, answer, pinned }
    }
}

/// The run of a pinned loop, one of `count`. All of them together are given the steps of integration of one run, so that a document
/// with many long ones does not stop the page for long.
fn run_pinned(setup: &LevelLoopSetup, count: usize) -> Result<LevelLoopAnswer, LevelLoopError> {
    let max = MAX_LEVEL_STEPS / count as f64;
    let steps =
        LevelSimulation::new(&setup.plant(), &setup.experiment).map_or(0.0, |simulation| simulation.steps() as f64);
    if steps > max {
        return Err(LevelLoopError {
            field: "pinned",
            fault: LevelRunError::TooMuchWork { field: "duration_s", steps, max },
        });
    }
    run_level_loop(setup)
}

fn has_same_rest(one: &LevelLoopSetup, other: &LevelLoopSetup) -> bool {
    let rest = |setup: &LevelLoopSetup| (setup.experiment.level, setup.experiment.inflow);
    rest(one) == rest(other)
}

fn has_same_rule_inputs(one: &LevelLoopSetup, other: &LevelLoopSetup) -> bool {
    let inputs = |setup: &LevelLoopSetup| (setup.model_source, setup.closed_loop_time_s);
    inputs(one) == inputs(other)
}

/// Whether all is the same but test, rules and search.
fn has_same_run(one: &LevelLoopSetup, other: &LevelLoopSetup) -> bool {
    let run = LevelLoopSetup {
        test: other.test,
        model_source: other.model_source,
        closed_loop_time_s: other.closed_loop_time_s,
        search: other.search,
        ..one.clone()
    };
    run == *other
}

fn suggestions_of(
    setup: &LevelLoopSetup,
    test: &Result<StepTestAnswer, StepTestError>,
    plant: &Result<PlantAnswer, LevelError>,
) -> Vec<Suggestion> {
    let local = plant.as_ref().ok();
    let model = match setup.model_source {
        ModelSource::Test => test.as_ref().ok().and_then(|test| test.fit.as_ref().ok()).map(|fit| fit.model),
        ModelSource::Local => local.map(|plant| plant.model),
    };
    suggest(setup, model.as_ref(), local.and_then(|plant| plant.ultimate))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::literature::LevelPresetId;
    use crate::literature::andreis::PublishedDisturbance;
    use crate::sim::level::LevelController;
    use crate::study::level_loop::{LevelPlantSpec, ModelMatch, PiTuning, published_setup};

    fn results(setup: &LevelLoopSetup, pinned: &[LevelLoopSetup], last: Option<&Results>) -> Results {
        let found = LevelLoopStudy::update(setup, pinned, last);
        let anew = LevelLoopStudy::update(setup, pinned, None);
        assert_eq!((&*found.plant, &*found.test), (&*anew.plant, &*anew.test));
        assert_eq!((&*found.suggestions, &*found.answer), (&*anew.suggestions, &*anew.answer));
        found
    }

    /// The main finding on the source: its step test at 0.006 m³/s shows K/τ = 0.0098, the plant at 0.017 m³/s has 0.0231.
    #[test]
    fn the_test_of_the_source_does_not_suit_the_plant_where_it_works() {
        let mut setup = LevelLoopSetup::default();
        let matched = |setup: &LevelLoopSetup| {
            let found = results(setup, &[], None);
            ModelMatch::of(found.test.as_ref().as_ref().unwrap(), found.plant.as_ref().as_ref().unwrap()).unwrap()
        };
        let there = matched(&setup);
        assert!((there.tested - 0.0098).abs() < 1e-4 && !there.suits(), "{there:?}");
        setup.test.inflow = setup.experiment.inflow;
        setup.test.step = 0.2;
        assert!(matched(&setup).suits(), "{:?}", matched(&setup));
    }

    #[test]
    fn a_change_of_the_controller_keeps_test_plant_and_suggestions() {
        let mut setup = LevelLoopSetup::default();
        let before = results(&setup, &[], None);
        setup.controller = LevelController::pi(5.0, 300.0);
        let after = results(&setup, &[], Some(&before));
        assert!(Arc::ptr_eq(&before.test, &after.test) && Arc::ptr_eq(&before.plant, &after.plant));
        assert!(Arc::ptr_eq(&before.suggestions, &after.suggestions) && !Arc::ptr_eq(&before.answer, &after.answer));
    }

    #[test]
    fn a_change_of_test_wish_or_search_keeps_the_run() {
        let setup = LevelLoopSetup::default();
        let before = results(&setup, &[], None);
        let changes: [fn(&mut LevelLoopSetup); 3] =
            [|s| s.test.step = 0.5, |s| s.closed_loop_time_s = 20.0, |s| s.search.keep_band = true];
        for change in changes {
            let mut changed = setup.clone();
            change(&mut changed);
            let after = results(&changed, &[], Some(&before));
            assert!(Arc::ptr_eq(&before.answer, &after.answer));
        }
        let same = results(&setup, &[], Some(&before));
        assert!(Arc::ptr_eq(&before.setup, &same.setup) && Arc::ptr_eq(&before.answer, &same.answer));
    }

    #[test]
    fn whatever_else_changes_makes_the_run_anew() {
        let setup = LevelLoopSetup::default();
        let before = results(&setup, &[], None);
        let changes: [fn(&mut LevelLoopSetup); 5] = [
            |s| s.plant = LevelPlantSpec::Preset(LevelPresetId::AndreisUncertain),
            |s| s.experiment.inflow = 0.012,
            |s| s.reference = PiTuning { gain: 1.0, integral_time_s: 100.0 },
            |s| s.model_error.area_factor = 1.1,
            |s| s.harris.order = 5,
        ];
        for change in changes {
            let mut changed = setup.clone();
            change(&mut changed);
            let after = results(&changed, &[], Some(&before));
            assert!(!Arc::ptr_eq(&before.answer, &after.answer));
        }
    }

    #[test]
    fn many_long_pinned_runs_are_refused_by_their_work() {
        let mut setup = LevelLoopSetup::default();
        setup.experiment.duration_s = 15_000.0;
        let with = |count: usize| {
            let pinned: Vec<LevelLoopSetup> = std::iter::repeat_n(setup.clone(), count).collect();
            results(&setup, &pinned, None)
        };
        assert!(with(1).pinned[0].result.is_ok());
        let many = with(8);
        let fault = many.pinned[7].result.as_ref().as_ref().unwrap_err();
        assert!(
            matches!(fault.fault, LevelRunError::TooMuchWork { max, .. } if max == MAX_LEVEL_STEPS / 8.0),
            "{fault}"
        );
        assert!(many.answer.is_ok());
    }

    #[test]
    fn a_pinned_tuning_is_run_in_the_present_experiment_once() {
        let pinned = LevelLoopSetup::default();
        let mut setup = published_setup(LevelPresetId::Andreis, PublishedDisturbance::SineH);
        setup.controller = LevelController::pi(5.0, 2999.7);
        let before = results(&setup, std::slice::from_ref(&pinned), None);
        let compared = before.pinned[0].clone();
        assert_eq!((&compared.setup.experiment, &compared.setup.controller), (&setup.experiment, &pinned.controller));
        assert_eq!(*compared.result, run_level_loop(&compared.setup));
        setup.controller = LevelController::pi(6.0, 2999.7);
        let after = results(&setup, &[pinned], Some(&before));
        assert!(Arc::ptr_eq(&before.pinned, &after.pinned));
    }
}
