//! Documents, links and runs as WebAssembly: the same figures as on the host. The published tables have a run of their own, in
//! `crates/quadtank/tests/published`.

use crate::seeded;
use quadtank::literature::PresetId;
use quadtank::literature::junqueira::{PublishedExperiment, PublishedValves};
use quadtank::study::model_free::{ModelFreeSetup, run_model_free};
use quadtank::study::quadruple_tank::{analyse, run, setup_of};
use quadtank_scenario::{Document, Scenario, ScenarioError, document_from_link, to_link};
use wasm_bindgen_test::wasm_bindgen_test;

/// The scenario of a link.
fn from_link(link: &str) -> Result<Scenario, ScenarioError> {
    document_from_link(link).map(|document| match document {
        Document::Quadruple(scenario) => scenario,
        _ => panic!("{link} is no run of the quadruple tank"),
    })
}

/// λ11 = γ1 γ2 / (γ1 + γ2 − 1), Cocota (2009), eq. 4.10.
fn relative_gain([one, two]: [f64; 2]) -> f64 {
    one * two / (one + two - 1.0)
}

#[wasm_bindgen_test]
fn every_published_rig_is_analysed() {
    for id in PresetId::ALL {
        let setup = setup_of(id);
        let analysis = analyse(&setup).expect("a published rig has an operating point");
        let expected = relative_gain(setup.valves);
        let found = analysis.linear.rga_11.expect("no published rig is singular");
        assert!((found - expected).abs() <= 1e-9 * expected.abs(), "{id:?}: λ11 = {found}, by hand {expected}");

        let gamma_sum: f64 = setup.valves.iter().sum();
        let zero = analysis.linear.rightmost_zero().expect("a published rig has two zeros").value.re;
        assert_eq!(zero < 0.0, gamma_sum > 1.0, "{id:?}: right-most zero {zero}, γ1 + γ2 = {gamma_sum}");
    }
}

#[wasm_bindgen_test]
fn a_run_stays_finite_and_reaches_its_end() {
    let setup = setup_of(PresetId::JohanssonMinimumPhase);
    let answer = run(&setup).expect("the published experiment runs");
    let trajectory = &answer.nonlinear;
    let end = trajectory.time_s.last().expect("a run has rows");
    assert!((end - setup.experiment.duration_s).abs() < 1e-6, "ends at {end} s");
    assert!(trajectory.levels.iter().flatten().all(|level| level.is_finite()));
}

#[wasm_bindgen_test]
fn a_link_brings_every_rig_back() {
    for id in PresetId::ALL {
        let scenario = Scenario { setup: setup_of(id), ..Scenario::default() };
        let link = to_link(&scenario).expect("a published rig fits into a link");
        assert_eq!(from_link(&link).expect("an own link can be read"), scenario, "{link}");
    }
}

#[wasm_bindgen_test]
fn a_damaged_link_is_an_error() {
    let link = to_link(&Scenario::default()).expect("the default fits into a link");
    assert!(from_link(&link[..link.len() - 3]).is_err());
    assert!(from_link("no link at all").is_err());
}

#[wasm_bindgen_test]
fn a_seed_gives_the_same_run_as_on_the_host() {
    let found = seeded::total_variation();
    assert!((found - seeded::TOTAL_VARIATION).abs() <= seeded::TOLERANCE, "{found}");
}

#[wasm_bindgen_test]
fn model_free_control_does_here_what_it_does_on_the_host() {
    // Junqueira, Neves and Angelico from empty tanks, IAE of tank 1 (cm s), as in crates/quadtank/tests/published/junqueira.rs.
    for (valves, iae) in PublishedValves::ALL.into_iter().zip([190.3, 269.1, 207.2]) {
        let answer = run_model_free(&ModelFreeSetup::published(valves, PublishedExperiment::S1)).expect("empty tanks");
        let found = 100.0 * answer.figures[0].iae;
        assert!((found - iae).abs() <= 0.05, "{valves:?}: {found}");
    }
}
