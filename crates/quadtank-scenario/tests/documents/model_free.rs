//! Documents of runs under the model-free law: what goes out comes back, and what is broken is named.

use proptest::prelude::*;
use quadtank::literature::junqueira::{PublishedExperiment, PublishedValves};
use quadtank::study::model_free::ModelFreeSetup;
use quadtank_scenario::model_free::ModelFreeScenario;
use quadtank_scenario::{Document, LINK_LIMIT, document_from_json, document_from_link, limits, to_json, to_link};

pub fn published() -> impl Iterator<Item = ModelFreeScenario> {
    let cases = PublishedValves::ALL.into_iter().flat_map(|valves| PublishedExperiment::ALL.map(|run| (valves, run)));
    cases.map(|(valves, run)| ModelFreeScenario::from(ModelFreeSetup::published(valves, run)))
}

proptest! {
    #[test]
    fn json_brings_back_every_digit(
        scenario in crate::random::model_free(limits::MAX_STEPS),
    ) {
        let text = to_json(&scenario).unwrap();
        prop_assert_eq!(document_from_json(&text), Ok(Document::ModelFree(scenario)));
    }

    #[test]
    fn links_bring_back_every_digit(scenario in crate::random::model_free(2)) {
        let link = to_link(&scenario).unwrap();
        prop_assert!(link.starts_with("q3.") && link.len() <= LINK_LIMIT);
        prop_assert_eq!(document_from_link(&link), Ok(Document::ModelFree(scenario)));
    }
}

#[test]
fn a_published_case_takes_a_short_link() {
    for scenario in published() {
        let link = to_link(&scenario).unwrap();
        assert!(link.len() <= 30, "{}: {link}", link.len());
        assert_eq!(document_from_link(&link), Ok(Document::ModelFree(scenario)));
    }
}

/// One line for each published case, as they are written: dictionaries never change, so neither does the text.
#[test]
fn the_dictionary_holds_the_published_cases_as_they_are_written() {
    let dictionary = include_str!("../../src/dictionary-3.jsonl");
    for scenario in published() {
        let text = to_json(&scenario).unwrap();
        let line: String = text.lines().map(str::trim_start).collect();
        assert!(dictionary.lines().any(|known| known == line), "{line}");
    }
    for line in dictionary.lines() {
        let Ok(Document::ModelFree(scenario)) = document_from_json(line) else { panic!("{line}") };
        let text = to_json(&scenario).unwrap();
        assert_eq!(text.lines().map(str::trim_start).collect::<String>(), line);
    }
}

#[test]
fn cursor_and_comparison_stand_only_where_there_are_any() {
    let mut scenario = ModelFreeScenario::default();
    let text = to_json(&scenario).unwrap();
    assert!(!text.contains("cursor_s") && !text.contains("compare"));
    scenario.model_free.compare = Some(scenario.model_free.usual_pi());
    scenario.cursor_s = Some(12.5);
    let text = to_json(&scenario).unwrap();
    assert_eq!(document_from_json(&text), Ok(Document::ModelFree(scenario.clone())));
    let link = to_link(&scenario).unwrap();
    assert!(link.len() <= 200, "{}: {link}", link.len());

    scenario.model_free.controller.loops[1].model_gain = 0.0;
    let refused = to_json(&scenario).unwrap_err();
    assert!(refused.to_string().starts_with("model_free.controller.loops[1].model_gain: 0"), "{refused}");
}

// A link that is out in the world: this one never changes, nor does the dictionary.
#[test]
fn an_old_link_still_opens() {
    let mut scenario = ModelFreeScenario::from(ModelFreeSetup::published(PublishedValves::B, PublishedExperiment::S3));
    scenario.model_free.controller.loops[0].proportional = 0.5;
    scenario.cursor_s = Some(123.0);
    let link = include_str!("../data/scenario-v3-junqueira.link").trim();
    assert_eq!(to_link(&scenario).as_deref(), Ok(link));
    assert_eq!(document_from_link(link), Ok(Document::ModelFree(scenario)));
}

#[test]
fn a_hose_that_delays_is_refused_by_name() {
    let document = include_str!("../data/everything-acts-model-free.json");
    let mut document: serde_json::Value = serde_json::from_str(document).unwrap();
    let pump = "/model_free/plant/parameters/rig/pumps/1";
    document.pointer_mut(pump).unwrap()["delay_s"] = serde_json::json!(3.5);
    let error = quadtank_scenario::document_from_json(&document.to_string()).unwrap_err().to_string();
    assert_eq!(error, "model_free.plant.parameters.rig.pumps[1].delay_s: 3.5 is outside 0 to 0");
}
