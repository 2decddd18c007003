//! Numbers by their names: the tables of all benches, over published and random documents.

use std::collections::HashSet;
use std::fmt::Debug;

use quadtank::literature::PresetId;
use quadtank::literature::campestrini::PublishedCase;
use quadtank::study::quadruple_tank::setup_of;
use quadtank::study::relay_tuning::TuningSetup;
use quadtank::study::{Study, UNITS};
use quadtank_scenario::tuning::TuningScenario;
use quadtank_scenario::{BenchDocument, Document, Quantities, Scenario, bench_of, document_from_json, quantities_of};

use super::bounded_work::draw::Draw;
use super::examples;

/// Random documents of each version; sessions of relay tuning take longest.
const DOCUMENTS: usize = 150;
const SESSIONS: usize = 12;

/// Every number that a document has is finite.
fn assert_finite<D: BenchDocument + Debug>(document: &D) {
    let results = D::Study::update(document.setup(), &[], None);
    for quantity in <D::Study as Study>::QUANTITIES {
        let value = (quantity.read)(&results);
        assert!(value.is_none_or(f64::is_finite), "{}: {value:?} of {document:?}", quantity.name);
        assert_eq!(quantity.value(&results), value);
        if quantity.unit == "yes/no" {
            assert!(value.is_none_or(|value| value == 0.0 || value == 1.0), "{}: {value:?}", quantity.name);
        }
    }
}

#[test]
fn names_are_unique_and_units_are_known() {
    let mut used = HashSet::new();
    for version in 1..=4 {
        let rows = quantities_of(version);
        assert!(rows.len() > 50, "{version}: {}", rows.len());
        let names: HashSet<&str> = rows.iter().map(|row| row.name).collect();
        assert_eq!(names.len(), rows.len(), "{version}");
        for row in rows {
            let is_of_name = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '.' || c == '_';
            assert!(row.name.chars().all(is_of_name) && !row.name.is_empty(), "{}", row.name);
            assert!(UNITS.contains(&row.unit), "{}: {}", row.name, row.unit);
            assert!(row.description.ends_with('.') && !row.description.contains('\n'), "{}", row.name);
            used.insert(row.unit);
        }
    }
    assert_eq!(used.len(), UNITS.len(), "{used:?}");
    assert_eq!((quantities_of(0), quantities_of(5), bench_of(5)), (vec![], vec![], None));
    assert_eq!([1, 2, 3, 4].map(bench_of), ["quadruple-tank", "relay-tuning", "model-free", "level-loop"].map(Some));
}

#[test]
fn a_name_that_means_the_same_has_the_same_unit_on_tank_benches() {
    let home = quantities_of(1);
    for row in quantities_of(3) {
        if let Some(same) = home.iter().find(|same| same.name == row.name) {
            assert_eq!(same.unit, row.unit, "{}", row.name);
        }
    }
}

#[test]
fn published_documents_have_finite_numbers() {
    for id in PresetId::ALL {
        assert_finite(&Scenario::from(setup_of(id)));
    }
    super::model_free::published().for_each(|document| assert_finite(&document));
    super::level_loop::published().for_each(|document| assert_finite(&document));
    PublishedCase::all().for_each(|case| assert_finite(&TuningScenario::from(TuningSetup::published(case))));
}

#[test]
fn examples_of_every_choice_have_finite_numbers() {
    for document in examples::all() {
        match document_from_json(&document.to_string()).unwrap() {
            Document::Quadruple(document) => assert_finite(&document),
            Document::Tuning(document) => assert_finite(&document),
            Document::ModelFree(document) => assert_finite(&document),
            Document::LevelLoop(document) => assert_finite(&document),
        }
    }
}

#[test]
fn random_documents_have_finite_numbers() {
    let mut draw = Draw(11);
    std::iter::repeat_with(|| draw.quadruple())
        .filter(|document| document.validate().is_ok())
        .take(DOCUMENTS)
        .for_each(|document| assert_finite(&document));
    std::iter::repeat_with(|| draw.model_free())
        .filter(|document| document.validate().is_ok())
        .take(DOCUMENTS)
        .for_each(|document| assert_finite(&document));
    std::iter::repeat_with(|| draw.level_loop())
        .filter(|document| document.validate().is_ok())
        .take(DOCUMENTS)
        .for_each(|document| assert_finite(&document));
    for _ in 0..SESSIONS {
        let plant = draw.tuning_plant();
        let document = draw.tuning(plant);
        if document.validate().is_ok() {
            assert_finite(&document);
        }
    }
}

#[test]
fn a_document_is_asked_by_name() {
    let quantities = Quantities::of(&Document::from(Scenario::default()));
    assert_eq!(quantities.rows(), quantities_of(1));
    assert!(quantities.value("zero.rightmost").unwrap().unwrap() < 0.0);
    assert_eq!(quantities.value("interpolation.area"), Ok(None));
    let unknown = quantities.value("zero.topmost").unwrap_err();
    assert_eq!((unknown.name.as_str(), unknown.bench), ("zero.topmost", "quadruple-tank"));
    assert!(unknown.to_string().contains("`zero.topmost`"));
}
