//! The work that any valid document asks for has a bound. Work is counted, not timed: steps of the integration, and
//! multiplications of exact motions.

pub mod draw;

use draw::Draw;
use quadtank::literature::campestrini::PublishedPlant;
use quadtank::plant::ValveSchedule;
use quadtank::sim::level::{LevelRunError, MAX_LEVEL_STEPS};
use quadtank::sim::{Halt, LoopTrace, MAX_RUN_WORK, MAX_WORK};
use quadtank::study::StudyErrorKind;
use quadtank::study::level_loop::{ContourMap, ContourSettings, run_level_loop, run_step_test};
use quadtank::study::model_free::{StartSpec, analyse_model_free, run_model_free};
use quadtank::study::quadruple_tank::{analyse, run};
use quadtank::study::relay_tuning::{PlantStudy, StepResponse, TestKind, Tested, TuningPlant};
use quadtank::tuning::RelayVerdict;
use quadtank_scenario::model_free::ModelFreeScenario;
use quadtank_scenario::tuning::TuningScenario;
use quadtank_scenario::{BenchDocument, Document, document_from_json, limits};

/// Documents of each version.
const DOCUMENTS: usize = 2000;
/// Level loops, of which one in three has a run.
const LEVEL_LOOPS: usize = 500;
/// Sessions with the same plant, whose critical curve takes longest.
const SESSIONS: usize = 40;
/// Work of the last motion of a run, which may begin just within the bound.
const LAST_MOTION: f64 = 1e5;

/// What a row may take beyond the bound: it is checked before each.
const LAST_ROW: u64 = 20_000;

fn assert_bounded(work: u64, document: &impl std::fmt::Debug) {
    assert!(work <= MAX_RUN_WORK + LAST_ROW, "{work}: {document:?}");
}

#[test]
fn runs_of_the_quadruple_tank_have_a_bound() {
    let mut draw = Draw(1);
    let valid = std::iter::repeat_with(|| draw.quadruple()).filter(|scenario| scenario.validate().is_ok());
    for scenario in valid.take(DOCUMENTS) {
        let _ = analyse(&scenario.setup);
        if let Ok(run) = run(&scenario.setup) {
            assert_bounded(run.nonlinear.work, &scenario);
        }
    }
}

#[test]
fn model_free_runs_have_a_bound() {
    let mut draw = Draw(3);
    let valid = std::iter::repeat_with(|| draw.model_free()).filter(|scenario| scenario.validate().is_ok());
    for scenario in valid.take(DOCUMENTS) {
        let _ = analyse_model_free(&scenario.model_free);
        if let Ok(answer) = run_model_free(&scenario.model_free) {
            assert_bounded(answer.run.trajectory.work, &scenario);
            if let Some((comparison, _)) = &answer.comparison {
                assert_bounded(comparison.work, &scenario);
            }
        }
    }
}

fn traces(test: &Tested) -> Vec<&LoopTrace> {
    match test {
        Tested::Single(test, _) | Tested::Simultaneous(test, _) => vec![&test.trace],
        Tested::Independent(loops) => loops.iter().map(|(test, _)| &test.trace).collect(),
        Tested::Sequential(steps) => steps.iter().map(|step| &step.test.trace).collect(),
    }
}

#[test]
fn relay_tests_and_responses_have_a_bound() {
    let mut draw = Draw(2);
    let mut left = DOCUMENTS;
    while left > 0 {
        let plant = draw.tuning_plant();
        let study = PlantStudy::of(&plant);
        for _ in 0..SESSIONS {
            let scenario = draw.tuning(plant.clone());
            if scenario.validate().is_err() {
                continue;
            }
            left = left.saturating_sub(1);
            let Ok(study) = &study else { continue };
            if let Ok(test) = study.test(&scenario.tuning) {
                let work: f64 = traces(&test).iter().map(|trace| trace.work).sum();
                assert!(work <= 4.0 * MAX_WORK + LAST_MOTION, "{work}: {scenario:?}");
            }
            if let Ok(Some(design)) = study.design(&scenario.tuning) {
                let compared = design.comparison.as_ref().map(|comparison| &comparison.response);
                for StepResponse { trace, .. } in [Some(&design.response), compared].into_iter().flatten() {
                    assert!(trace.work <= MAX_WORK + LAST_MOTION, "{}: {scenario:?}", trace.work);
                }
            }
        }
    }
}

/// Runs, step tests and the runs of a search take so many steps of integration at most; the rows of a log are bounded by the document.
#[test]
fn level_loops_have_a_bound() {
    let mut draw = Draw(4);
    let mut runs = 0;
    let valid = std::iter::repeat_with(|| draw.level_loop()).filter(|scenario| scenario.validate().is_ok());
    for scenario in valid.take(LEVEL_LOOPS) {
        let setup = &scenario.level_loop;
        let answer = run_level_loop(setup);
        let test = run_step_test(&setup.plant(), &setup.test);
        let logs = [answer.as_ref().ok().map(|answer| &answer.log), test.as_ref().ok().map(|test| &test.log)];
        for log in logs.into_iter().flatten() {
            assert!(log.steps as f64 <= MAX_LEVEL_STEPS, "{}: {scenario:?}", log.steps);
            assert!(log.len() as f64 <= limits::MAX_SAMPLES + 1.0, "{}: {scenario:?}", log.len());
        }
        runs += usize::from(answer.is_ok());
        if let Ok(mut map) = ContourMap::new(setup, ContourSettings { size: [2, 2] }) {
            while map.advance(1) {}
        }
    }
    assert!(runs > LEVEL_LOOPS / 4, "{runs} of {LEVEL_LOOPS} have a run");
}

/// A level at a wall or a valve at its limit in nearly every step, each of which is made anew in pieces: once up to nine times
/// what the bound allowed.
#[test]
fn level_loops_at_their_limits_are_refused_by_all_their_work() {
    let Ok(Document::LevelLoop(scenario)) = document_from_json(include_str!("../data/level-loop-at-its-limits.json"))
    else {
        panic!("a document within its limits")
    };
    let fault = run_level_loop(&scenario.level_loop).map(|answer| answer.log.steps).unwrap_err();
    let LevelRunError::TooMuchWork { steps, max, .. } = fault.fault else { panic!("{fault}") };
    assert!(steps > MAX_LEVEL_STEPS && steps < MAX_LEVEL_STEPS + 10.0 && max == MAX_LEVEL_STEPS, "{fault}");
}

/// Poles from 1e-7 to 8.7e3 in four elements of degree 7: once 65 s of steps of the quickest pole.
#[test]
fn a_response_of_stiff_elements_goes_to_its_end() {
    let Ok(Document::Tuning(scenario)) = document_from_json(include_str!("../data/stiff-elements.json")) else {
        panic!("a session within its limits")
    };
    let design = PlantStudy::of(&scenario.tuning.plant).unwrap().design(&scenario.tuning).unwrap().unwrap();
    let trace = &design.response.trace;
    assert_eq!((trace.halt, trace.time.len()), (None, 6001));
    assert!(trace.work < 2e6, "{}", trace.work);
}

/// A relay on lags that are a million times quicker than the record is long.
#[test]
fn a_relay_test_that_is_too_much_work_says_so() {
    let mut scenario = TuningScenario::default();
    scenario.tuning.plant = TuningPlant::Published(PublishedPlant::ProcessTwo);
    (scenario.tuning.test.duration, scenario.tuning.test.step) = (1e5, 1.0);
    let study = PlantStudy::of(&scenario.tuning.plant).unwrap();
    let Ok(Tested::Simultaneous(test, _)) = study.test(&scenario.tuning) else { panic!("a simultaneous test") };
    let Some(Halt::Full { time }) = test.trace.halt else { panic!("{:?}", test.trace.halt) };
    assert!(time > 100.0 && test.trace.work <= MAX_WORK + LAST_MOTION);
}

#[test]
fn a_sequence_that_is_too_much_work_ends_with_an_unfinished_test() {
    let mut scenario = TuningScenario::default();
    let test = &mut scenario.tuning.test;
    (test.kind, test.passes, test.step) = (TestKind::Sequential, 20, 0.016);
    assert_eq!(scenario.validate(), Ok(()));
    let study = PlantStudy::of(&scenario.tuning.plant).unwrap();
    let Ok(Tested::Sequential(steps)) = study.test(&scenario.tuning) else { panic!("a sequence") };
    let (last, before) = steps.split_last().unwrap();
    assert!(steps.len() < 40 && before.iter().all(|step| step.settings.is_some()));
    assert!(matches!(last.test.reading.verdict, RelayVerdict::Unfinished { time } if time < 400.0), "{last:?}");
}

#[test]
fn a_valve_that_turns_too_often_is_named() {
    let text = |frequency: f64| {
        let mut scenario = ModelFreeScenario::default();
        scenario.model_free.experiment.duration_s = 20_000.0;
        scenario.model_free.valves[1] = ValveSchedule::Sine { mean: 0.5, amplitude: 0.1, frequency, phase: 0.0 };
        scenario.validate().map_err(|error| error.to_string())
    };
    assert_eq!(text(0.5), Ok(()));
    assert_eq!(text(10.0), Err("model_free.valves[1].sine.frequency: 10 is outside 0 to 0.5".to_owned()));
}

/// Two upper tanks that a valve fills a little and lets run dry ten times in six seconds.
#[test]
fn a_run_that_is_too_much_work_names_its_duration() {
    let mut scenario = ModelFreeScenario::default();
    let setup = &mut scenario.model_free;
    (setup.start, setup.experiment.duration_s) = (StartSpec::Empty, 1000.0);
    setup.valves[0] = ValveSchedule::Sine { mean: 1e-4, amplitude: 9e-5, frequency: 10.0, phase: 0.0 };
    setup.valves[1] = ValveSchedule::Constant { gamma: 1e-5 };
    assert_eq!(scenario.validate(), Ok(()));
    let refused = run_model_free(&scenario.model_free).unwrap_err();
    assert!(
        matches!(refused.fault, StudyErrorKind::TooMuchWork { time_s } if (250.0..500.0).contains(&time_s)),
        "{refused}"
    );
    assert!(refused.to_string().starts_with("experiment.duration_s: not computed beyond "), "{refused}");
    scenario.model_free.experiment.duration_s = 250.0;
    assert!(run_model_free(&scenario.model_free).is_ok());
}
