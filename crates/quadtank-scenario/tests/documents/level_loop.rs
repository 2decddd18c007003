//! Documents of level loops: what goes out comes back, and what is broken is named.

use quadtank::literature::LevelPresetId;
use quadtank::literature::andreis::PublishedDisturbance;
use quadtank::plant::level::LevelError;
use quadtank::sim::level::{LevelController, SignalStep};
use quadtank::study::Study;
use quadtank::study::level_loop::{LevelLoopStudy, LevelPlantSpec, Objective, published_setup, trade_off};
use quadtank_scenario::level_loop::{LevelLoopScenario, run_to_csv, trade_off_to_csv};
use quadtank_scenario::report::level_loop::{LevelLoopAnalysisReport, LevelLoopReport};
use quadtank_scenario::{
    BenchDocument, Document, LINK_LIMIT, ScenarioError, document_from_json, document_from_link, to_json, to_link,
};

use super::bounded_work::draw::Draw;

const DICTIONARY: &str = include_str!("../../src/dictionary-4.jsonl");

pub fn published() -> impl Iterator<Item = LevelLoopScenario> {
    let cases = LevelPresetId::ALL.into_iter().flat_map(|id| PublishedDisturbance::ALL.map(|of| (id, of)));
    cases.map(|(id, disturbance)| LevelLoopScenario::from(published_setup(id, disturbance)))
}

fn random() -> impl Iterator<Item = LevelLoopScenario> {
    let mut draw = Draw(11);
    std::iter::repeat_with(move || draw.level_loop()).filter(|scenario| scenario.validate().is_ok())
}

#[test]
fn json_and_links_bring_back_every_digit() {
    let mut longest = 0;
    for scenario in random().take(60) {
        let read = document_from_json(&to_json(&scenario).unwrap());
        assert_eq!(read, Ok(Document::LevelLoop(scenario.clone())));
        let link = to_link(&scenario).unwrap();
        assert!(link.starts_with("q4.") && link.len() <= LINK_LIMIT);
        longest = longest.max(link.len());
        assert_eq!(document_from_link(&link), Ok(Document::LevelLoop(scenario)));
    }
    // Every number has all its digits, most lists some entries.
    assert!((1000..LINK_LIMIT).contains(&longest), "{longest}");
}

/// Whatever a valid document says, there are results or reasons, and they can be written.
#[test]
fn any_document_is_answered() {
    let mut held = 0;
    for scenario in random().take(60) {
        let setup = &scenario.level_loop;
        let found = LevelLoopStudy::update(setup, std::slice::from_ref(setup), None);
        let analysis = serde_json::to_string(&LevelLoopAnalysisReport::of(&found)).unwrap();
        assert!(analysis.starts_with("{\"rest\":{"), "{analysis}");
        if let Ok(answer) = found.answer.as_ref() {
            assert!(serde_json::to_string(&LevelLoopReport::of(setup, answer)).is_ok());
            assert_eq!(run_to_csv(answer, setup).lines().count(), answer.log.len() + 1);
            held += 1;
        }
        let table = trade_off_to_csv(&trade_off(setup, &[setup.reference]));
        assert!(!table.contains("NaN") && !table.contains("inf"), "{table}");
    }
    assert!(held > 15, "{held}");
}

#[test]
fn a_published_loop_takes_a_short_link() {
    for scenario in published() {
        let link = to_link(&scenario).unwrap();
        assert!(link.len() <= 30, "{}: {link}", link.len());
        assert_eq!(document_from_link(&link), Ok(Document::LevelLoop(scenario)));
    }
}

#[test]
fn a_changed_tuning_takes_a_short_link_too() {
    let mut scenario = LevelLoopScenario::default();
    scenario.level_loop.controller = LevelController::pi(12.3, 456.7);
    assert!(to_link(&scenario).unwrap().len() <= 60);
    // A plant by all its parameters, of which one is another.
    let mut plant = scenario.level_loop.plant();
    plant.tank.area = 1.3;
    scenario.level_loop.plant = LevelPlantSpec::Parameters(plant);
    assert!(to_link(&scenario).unwrap().len() <= 80, "{}", to_link(&scenario).unwrap());
}

/// The dictionary holds documents as they are written, some of the published loops among them.
#[test]
fn the_dictionary_holds_documents_as_they_are_written() {
    for line in DICTIONARY.lines() {
        let Ok(Document::LevelLoop(scenario)) = document_from_json(line) else { panic!("{line}") };
        let text = to_json(&scenario).unwrap();
        assert_eq!(text.lines().map(str::trim_start).collect::<String>(), line);
    }
    let known = published().filter(|scenario| {
        let line: String = to_json(scenario).unwrap().lines().map(str::trim_start).collect();
        DICTIONARY.lines().any(|known| known == line)
    });
    assert_eq!(known.count(), 7);
}

#[test]
fn what_does_not_fit_together_is_named() {
    let refused = |change: &dyn Fn(&mut LevelLoopScenario)| {
        let mut scenario = LevelLoopScenario::default();
        change(&mut scenario);
        scenario.validate().unwrap_err().to_string()
    };
    let plant = |change: &dyn Fn(&mut quadtank::plant::level::LevelPlant)| {
        refused(&|scenario| {
            let mut plant = scenario.level_loop.plant();
            change(&mut plant);
            scenario.level_loop.plant = LevelPlantSpec::Parameters(plant);
        })
    };
    let at = "level_loop.plant.parameters";
    for (said, expected) in [
        (
            plant(&|plant| plant.transmitter.level_range = [1.0, 1.0]),
            "transmitter.level_range[1]: 1 is outside 1.001 to",
        ),
        (plant(&|plant| plant.output.signal.low = 20.0), "output.signal.high: 20 is outside 20.001 to"),
        (plant(&|plant| plant.actuator.lag_s = 1e-9), "actuator.lag_s: 0.000000001 is outside 0.001 to"),
        (plant(&|plant| plant.actuator.curve.0[2][0] = 6.0), "actuator.curve[2][0]: 6 is outside 6.001 to"),
        (plant(&|plant| plant.actuator.curve.0[0][1] = 1.5), "actuator.curve[0][1]: 1.5 is outside 0 to 1"),
        (plant(&|plant| plant.actuator.curve.0[2][1] = 0.9), "actuator.curve[2]: the actuator curve is not monotonic"),
        (plant(&|plant| plant.actuator.curve.0.truncate(1)), "actuator.curve: the actuator curve is not monotonic"),
        (plant(&|plant| plant.actuator.curve.0.clear()), "actuator.curve: the actuator curve is not monotonic"),
    ] {
        assert!(said.starts_with(&format!("{at}.{expected}")), "{said}");
    }
    for (said, expected) in [
        (
            refused(&|s| s.level_loop.objective = Objective::Averaging { band: [0.5, 2.5] }),
            "objective.averaging.band[1]",
        ),
        (
            refused(&|s| s.level_loop.objective = Objective::Averaging { band: [1.5, 1.2] }),
            "objective.averaging.band[1]",
        ),
        (refused(&|s| s.level_loop.search.gain = [5.0, 5.0]), "search.gain[1]"),
        (refused(&|s| s.level_loop.search.integral_time_s = [50.0, 5.0]), "search.integral_time_s[1]"),
        (refused(&|s| s.level_loop.experiment.disturbance.until_s = 49.0), "experiment.disturbance.until_s"),
        (refused(&|s| s.level_loop.experiment.log_step_s = 0.001), "experiment.log_step_s: 0.001 is outside 0.015"),
        (refused(&|s| s.level_loop.experiment.log_step_s = 301.0), "experiment.log_step_s"),
        (refused(&|s| s.level_loop.test.step_time_s = 5000.0), "test.step_time_s"),
        (refused(&|s| s.level_loop.test.return_time_s = Some(5000.0)), "test.return_time_s"),
        (refused(&|s| s.level_loop.test.return_time_s = Some(400.0)), "test.step_time_s"),
        (refused(&|s| s.level_loop.controller = LevelController::pi(1e-12, 60.0)), "controller.pi.gain"),
        (refused(&|s| s.level_loop.reference.gain = f64::NAN), "reference.gain"),
    ] {
        assert!(said.starts_with(&format!("level_loop.{expected}")), "{said}");
    }
    let said = refused(&|scenario| {
        scenario.level_loop.experiment.set_point_steps = vec![SignalStep { time_s: 0.0, size: 0.1 }; 9];
    });
    assert_eq!(said, "level_loop.experiment.set_point_steps: 9 entries, at most 8");
    let pinned = refused(&|scenario| {
        let mut other = scenario.level_loop.clone();
        other.search.gain = [5.0, 1.0];
        scenario.pinned_loops = vec![scenario.level_loop.clone(), other];
    });
    assert!(pinned.starts_with("pinned_loops[1].search.gain[1]: 1 is outside"), "{pinned}");
}

#[test]
fn the_error_of_a_plant_carries_its_values() {
    let mut scenario = LevelLoopScenario::default();
    let mut plant = scenario.level_loop.plant();
    plant.actuator.curve.0[3][1] = 0.6;
    scenario.level_loop.plant = LevelPlantSpec::Parameters(plant);
    let expected = ScenarioError::Level {
        field: "level_loop.plant.parameters.actuator.curve[3]".to_owned(),
        error: LevelError::ActuatorCurve { index: 3 },
    };
    assert_eq!(scenario.validate(), Err(expected));
}

#[test]
fn what_may_be_absent_stands_only_where_it_is() {
    let text = to_json(&LevelLoopScenario::default()).unwrap();
    for absent in ["cursor_s", "pinned_loops", "return_time_s", "largest_sensitivity", "label", "null"] {
        assert!(!text.contains(absent), "{absent}");
    }
}

// A link that is out in the world: this one never changes, nor does the dictionary.
#[test]
fn an_old_link_still_opens() {
    let mut scenario = LevelLoopScenario::from(published_setup(LevelPresetId::Andreis, PublishedDisturbance::SineH));
    scenario.level_loop.controller = LevelController::pi(5.5, 1234.5);
    scenario.level_loop.objective = Objective::Averaging { band: [0.6, 1.4] };
    scenario.cursor_s = Some(75.0);
    let link = include_str!("../data/scenario-v4-andreis.link").trim();
    assert_eq!(to_link(&scenario).as_deref(), Ok(link));
    assert_eq!(document_from_link(link), Ok(Document::LevelLoop(scenario)));
}
