//! Sessions with given controllers.

use quadtank::control::Pairing;
use quadtank::linear::LoopStability;
use quadtank::literature::wood_berry::PublishedControllers;
use quadtank::study::relay_tuning::{DesignSpec, GivenPid, TuningSetup, tune};
use quadtank_scenario::report::tuning::TuningReport;
use quadtank_scenario::tuning::{TuningScenario, warnings};
use quadtank_scenario::{
    Document, Quantities, document_from_json, document_from_link, published_document, to_json, to_link,
};
use serde_json::{Value, json};

/// A file from outside: the column of Wood and Berry with the gains of the BLT method (Luyben 1986).
const FILE: &str = include_str!("../data/wood-berry-given-gains.json");

fn session(text: &str) -> TuningScenario {
    match document_from_json(text) {
        Ok(Document::Tuning(scenario)) => scenario,
        other => panic!("{other:?}"),
    }
}

/// Expected: stable, largest singular value of S 2.10, biggest log modulus 3.98 dB, overshoot 10 %, IAE 4.53 and 16.50 for controllers
/// that are not sampled. Sampled every 0.1 min as in the file, an independent simulation gives an overshoot of 10.745 % and IAE of
/// 4.5679 and 16.4974.
#[test]
fn a_file_from_outside_is_read_and_answered() {
    let scenario = session(FILE);
    assert_eq!(scenario.tuning, TuningSetup::with_published(PublishedControllers::Blt));
    assert_eq!(warnings(&scenario.tuning), []);
    let found = tune(&scenario.tuning).unwrap();
    let report = TuningReport::of(&scenario.tuning, &found).unwrap();
    let design = report.design.unwrap();
    let [root] = &design.roots[..] else { panic!("one root") };
    assert_eq!(found.design.unwrap().chosen_root().stability, LoopStability::Stable);
    assert!((root.sensitivity_peak.unwrap() - 2.10).abs() < 0.005, "{root:?}");
    assert!((root.biggest_log_modulus_db.unwrap() - 3.98).abs() < 0.005, "{root:?}");
    let [one, two] = design.figures;
    assert!((one.overshoot.unwrap() - 0.10745).abs() < 0.5e-5, "{one:?}");
    assert!((one.iae - 4.5679).abs() < 0.5e-4 && (two.iae - 16.4974).abs() < 0.5e-4, "{one:?} {two:?}");
    // The same by their names.
    let quantities = Quantities::of(&Document::Tuning(scenario));
    let value = |name: &str| quantities.value(name).unwrap();
    assert_eq!(value("closed_loop.sensitivity_peak"), root.sensitivity_peak);
    assert_eq!(value("closed_loop.log_modulus"), root.biggest_log_modulus_db);
    assert_eq!(
        (value("loop2.gain"), value("root1.is_stable"), value("placement.placed_re")),
        (Some(-0.075), None, None)
    );
    assert!((value("loop1.integral_time").unwrap() - 8.29).abs() < 1e-12);
    assert!(value("margins.gain").unwrap() > 1.0);
}

#[test]
fn published_controllers_are_compared_side_by_side() {
    let scenario = session(FILE);
    let report = TuningReport::of(&scenario.tuning, &tune(&scenario.tuning).unwrap()).unwrap();
    let design = report.design.unwrap();
    let rows = &report.published_controllers;
    assert_eq!(
        rows.iter().map(|row| row.case).collect::<Vec<_>>(),
        PublishedControllers::ALL.map(PublishedControllers::name)
    );
    let blt = &rows[0];
    assert_eq!((blt.figures, blt.stability), (Some(design.figures), design.roots[0].stability));
    assert_eq!(
        (blt.sensitivity_peak, blt.controllers),
        (design.roots[0].sensitivity_peak, design.roots[0].controllers)
    );
    let other = TuningReport::of(&TuningSetup::default(), &tune(&TuningSetup::default()).unwrap()).unwrap();
    assert_eq!(other.published_controllers.len(), rows.len());
}

#[test]
fn documents_and_links_come_back() {
    let mut open = TuningSetup::with_published(PublishedControllers::Blt);
    open.design.controllers = Some([GivenPid { gain: 0.3, ..GivenPid::default() }, GivenPid::default()]);
    let mut beside_a_placement = TuningSetup::default();
    beside_a_placement.design.controllers = open.design.controllers;
    beside_a_placement.design.pairing = Pairing::Swapped;
    let published = PublishedControllers::ALL.map(TuningSetup::with_published);
    for setup in published.into_iter().chain([open, beside_a_placement]) {
        let scenario = TuningScenario::from(setup);
        assert_eq!(session(&to_json(&scenario).unwrap()), scenario);
        let link = to_link(&scenario).unwrap();
        assert!(link.len() < 250, "{}: {link}", link.len());
        assert_eq!(document_from_link(&link), Ok(Document::Tuning(scenario)));
    }
    for controllers in PublishedControllers::ALL {
        let expected = TuningScenario::from(TuningSetup::with_published(controllers));
        assert_eq!(published_document(controllers.name()), Some(Document::Tuning(expected)));
    }
}

/// A design in the document of the file.
fn with_design(design: Value) -> String {
    let mut document: Value = serde_json::from_str(FILE).unwrap();
    document["tuning"]["design"] = design;
    document.to_string()
}

#[test]
fn a_placement_needs_all_its_fields_and_given_controllers_none() {
    let placement = serde_json::to_value(DesignSpec::default()).unwrap();
    for name in ["critical", "method", "action", "target", "root"] {
        let mut design = placement.clone();
        design.as_object_mut().unwrap().remove(name).unwrap();
        let error = document_from_json(&with_design(design)).unwrap_err().to_string();
        assert_eq!(error, format!("tuning.design: missing field `{name}`"));
    }
    let refused = |controllers: Value| {
        document_from_json(&with_design(json!({ "controllers": controllers }))).unwrap_err().to_string()
    };
    let good = json!({ "gain": 1, "integral_time": 2 });
    let error = refused(json!([good, { "integral_time": 2 }]));
    assert_eq!(error, "tuning.design.controllers[1]: missing field `gain`");
    let error = refused(json!([good, { "gain": 1, "integral_time": 0 }]));
    assert!(error.starts_with("tuning.design.controllers[1].integral_time: 0"), "{error}");
    let error = refused(json!([good, { "gain": 1, "reset_time": 2 }]));
    assert!(error.starts_with("tuning.design.controllers[1].reset_time: unknown field"), "{error}");
    assert!(refused(json!([good])).starts_with("tuning.design.controllers: invalid length 1"));
}

#[test]
fn what_a_given_controller_has_no_use_for_is_warned_about() {
    let fields = |design: Value| {
        let scenario = session(&with_design(design));
        warnings(&scenario.tuning).iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    let warned = fields(json!({
        "method": "one-locus", "action": "pi", "target": [-0.4, 0.1], "root": 2,
        "controllers": [{ "gain": 0, "integral_time": 2, "derivative_time": 1 }, { "gain": 1, "filter_time": 2 }],
    }));
    let named = [
        "design.method",
        "design.action",
        "design.target",
        "design.root",
        "design.controllers[0].integral_time",
        "design.controllers[0].derivative_time",
        "design.controllers[1].filter_time",
    ];
    assert_eq!(warned.len(), named.len(), "{warned:?}");
    for (warning, name) in warned.iter().zip(named) {
        assert!(warning.starts_with(&format!("tuning.{name}: without effect here")), "{warning}");
    }
    let mut placement = serde_json::to_value(DesignSpec::default()).unwrap();
    placement["pairing"] = json!("swapped");
    assert_eq!(fields(placement).len(), 1);
}
