//! Relay-tuning documents: published cases, versions, bad input.

use std::f64::consts::TAU;

use quadtank::control::Pairing;
use quadtank::linear::Complex;
use quadtank::linear::LoopStability;
use quadtank::literature::PresetId;
use quadtank::literature::campestrini::PublishedCase;
use quadtank::study::relay_tuning::{
    Element, PlantStudy, TestKind, TestSpec, Tested, TuningPlant, TuningSetup, printed_figures, tune,
};
use quadtank::tuning::RelayReading;
use quadtank_scenario::report::tuning::TuningReport;
use quadtank_scenario::tuning::TuningScenario;
use quadtank_scenario::{Document, ScenarioError, document_from_json, document_from_link, from_json, to_json, to_link};
use serde_json::{Value, json};

/// What print and computation differ in by more than the digits of the print and of its periods leave open. Where the source is
/// called a slip elsewhere it is among them; the others are off by less than a unit of the last digit or 1 % of a period.
const DIFFERENT: [(u32, usize, &str); 23] = [
    // The gain of locus 1 belongs to another period.
    (3, 1, "Kc"),
    (3, 1, "Tc"),
    (3, 1, "kp"),
    (3, 1, "ki"),
    (3, 2, "Tc"),
    (3, 2, "kp"),
    // Within the rounding of A and B.
    (88, 1, "kp11"),
    (88, 1, "kp21"),
    (88, 1, "ki21"),
    (88, 1, "kp22"),
    (88, 1, "ki22"),
    // Cut, not rounded.
    (5, 1, "ki2"),
    // r2 by its own definition is 6.58 and 0.564.
    (7, 1, "r2"),
    (7, 1, "Tc"),
    (7, 2, "r2"),
    (7, 2, "Tc"),
    (7, 4, "kc1"),
    (7, 4, "Tc"),
    // p2 = α p1 gives −0.0245.
    (9, 1, "ki2"),
    (13, 2, "r2"),
    (13, 2, "Tc"),
    (13, 3, "Tc"),
    // 0.357 min.
    (0, 1, "td"),
];

#[test]
fn every_published_case_gives_its_printed_numbers_but_for_those_known() {
    let mut different = Vec::new();
    for case in PublishedCase::all() {
        let study = PlantStudy::of(&TuningSetup::published(case).plant).unwrap();
        let figures = printed_figures(case, &study).unwrap();
        assert!(!figures.is_empty(), "{}", case.name());
        for figure in figures.iter().filter(|figure| !figure.agrees()) {
            different.push((case.table, case.row, figure.printed.symbol, figure.printed.value, figure.computed));
        }
    }
    let names: Vec<_> = different.iter().map(|&(table, row, symbol, ..)| (table, row, symbol)).collect();
    assert_eq!(names, DIFFERENT, "{different:?}");
}

#[test]
fn every_published_placement_is_stable_but_one() {
    for case in PublishedCase::all().filter(|case| case.is_placement()) {
        let scenario = TuningScenario::from(TuningSetup::published(case));
        let design = tune(&scenario.tuning).unwrap().design.unwrap();
        let stable = design.chosen_root().stability == LoopStability::Stable;
        assert_eq!(stable, case != PublishedCase { table: 15, row: 2 }, "{}", case.name());
        // The figures of an unstable loop mean nothing.
        assert_eq!(design.response.is_bounded, stable, "{}", case.name());
    }
}

#[test]
fn documents_of_both_versions_come_back() {
    for case in PublishedCase::all() {
        assert_eq!(PublishedCase::from_name(&case.name()), Some(case));
        let text = to_json(&TuningScenario::from(TuningSetup::published(case))).unwrap();
        assert_eq!(document_from_json(&text), Ok(Document::Tuning(TuningScenario::from(TuningSetup::published(case)))));
        // Who reads only the first version says so.
        assert!(matches!(from_json(&text), Err(ScenarioError::UnknownVersion { found: 2, newest: 1 })));
    }
    let text = include_str!("../data/scenario-v1-johansson.json");
    assert_eq!(document_from_json(text), from_json(text).map(Document::Quadruple));
    let unknown = document_from_json(r#"{"version": 5}"#);
    assert_eq!(unknown, Err(ScenarioError::UnknownVersion { found: 5, newest: 4 }));
}

#[test]
fn a_wrong_field_is_named() {
    let text = to_json(&TuningScenario::from(TuningSetup::published(PublishedCase { table: 5, row: 1 }))).unwrap();
    let refused = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        document_from_json(&text.replacen(from, to, 1)).unwrap_err().to_string()
    };
    assert!(refused("\"root\": 2", "\"root\": 3").starts_with("tuning.design.root: 3"));
    assert!(refused("\"step\": 0.05", "\"step\": 0.0").starts_with("tuning.test.step: 0"));
    assert!(refused("\"period\": 12.9", "\"period\": -1").starts_with("tuning.design.critical.point.period: -1"));
    assert!(refused("\"wood-berry\"", "\"wood\"").starts_with("tuning.plant.published"));
}

#[test]
fn what_may_be_absent_is_as_if_it_were_not_used() {
    let mut document: Value = serde_json::from_str(&to_json(&TuningScenario::default()).unwrap()).unwrap();
    document.as_object_mut().unwrap().remove("pinned");
    let tuning = &mut document["tuning"];
    for (part, names) in [
        ("test", &["number", "behind", "hysteresis", "bias", "detuning", "passes"][..]),
        ("design", &["decoupler"]),
        ("response", &["compare"]),
    ] {
        for name in names {
            tuning[part].as_object_mut().unwrap().remove(*name).unwrap();
        }
    }
    assert_eq!(document_from_json(&document.to_string()), Ok(Document::Tuning(TuningScenario::default())));

    let rig = json!({ "preset": "johansson-2000-minimum-phase", "pairing": "diagonal" });
    document["tuning"]["plant"] = json!({ "quadruple_tank": rig });
    let Ok(Document::Tuning(scenario)) = document_from_json(&document.to_string()) else { panic!("a session") };
    let expected = TuningPlant::QuadrupleTank {
        preset: PresetId::JohanssonMinimumPhase,
        valves: None,
        pairing: Pairing::Diagonal,
        dead_time_s: 0.0,
        lag_s: 0.0,
        nonlinear: false,
    };
    assert_eq!(scenario.tuning.plant, expected);
    let element = json!({ "numerator": [1], "denominator": [1, 2.5] });
    document["tuning"]["plant"] = json!({ "elements": [[element, element], [element, element]] });
    let Ok(Document::Tuning(scenario)) = document_from_json(&document.to_string()) else { panic!("a session") };
    let TuningPlant::Elements(rows) = &scenario.tuning.plant else { panic!("elements") };
    assert_eq!(rows[1][0], Element { numerator: vec![1.0], denominator: vec![1.0, 2.5], dead_time: 0.0 });
    assert_eq!(document_from_json(&to_json(&scenario).unwrap()), Ok(Document::Tuning(scenario)));
}

#[test]
fn links_bring_sessions_back_and_are_short() {
    let scenarios = PublishedCase::all().map(|case| TuningScenario::from(TuningSetup::published(case)));
    let rigs = PresetId::ALL
        .map(|id| TuningScenario { tuning: TuningSetup::on(TuningPlant::rig(id)), ..TuningScenario::default() });
    for scenario in scenarios.chain(rigs) {
        let link = to_link(&scenario).unwrap();
        assert_eq!(document_from_link(&link), Ok(Document::Tuning(scenario)), "{link}");
        assert!(link.len() < 250, "{}: {link}", link.len());
    }
    let default = TuningScenario::default();
    let full = TuningScenario { pinned: vec![default.tuning.clone(); TuningScenario::MAX_PINNED], ..default };
    assert_eq!(document_from_link(&to_link(&full).unwrap()), Ok(Document::Tuning(full)));
}

// A link that is out in the world: this one never changes, nor does the dictionary.
#[test]
fn an_old_link_still_opens() {
    let scenario = TuningScenario::from(TuningSetup::published(PublishedCase { table: 16, row: 2 }));
    assert_eq!(
        document_from_link(include_str!("../data/scenario-v2-table-16.link").trim()),
        Ok(Document::Tuning(scenario))
    );
}

#[test]
fn a_session_on_a_rig_begins_with_a_test_that_oscillates() {
    for id in PresetId::ALL {
        let found = tune(&TuningSetup::on(TuningPlant::rig(id))).unwrap();
        let Tested::Simultaneous(test, _) = found.test else { panic!("a simultaneous test") };
        println!("{id:?}: {:?} {:?}", test.reading.verdict, test.reading.oscillation.map(|o| o.period));
        let design = found.design.expect("an ultimate point");
        println!(
            "  {:?} {:?}",
            design.roots.iter().map(|root| root.stability).collect::<Vec<_>>(),
            design.critical.map(|critical| critical.period())
        );
    }
}

/// Two loops e^(−2s)/(10 s + 1) without interaction, under relays of amplitude 1, in tests of a kind.
fn two_lags(kind: TestKind) -> TuningSetup {
    let element = |gain: f64| Element { numerator: vec![gain], denominator: vec![1.0, 10.0], dead_time: 2.0 };
    let mut setup = TuningScenario::default().tuning;
    setup.plant = TuningPlant::Elements([[element(1.0), element(0.0)], [element(0.0), element(1.0)]]);
    setup.test = TestSpec { kind, ..TestSpec::simultaneous(200.0, 0.0, 0.01) };
    setup
}

/// Period and gain by first harmonics of both loops.
fn oscillations(setup: &TuningSetup) -> [(f64, f64); 2] {
    let study = PlantStudy::of(&setup.plant).unwrap();
    let of = |reading: &RelayReading, index: usize| {
        let oscillation = reading.oscillation.unwrap();
        (oscillation.period, oscillation.loops[index].gain_by_harmonic.unwrap())
    };
    match study.test(setup).unwrap() {
        Tested::Independent(loops) => [0, 1].map(|i| of(&loops[i].0.reading, i)),
        Tested::Sequential(steps) => [0, 1].map(|i| of(&steps[i].test.reading, i)),
        Tested::Simultaneous(test, _) => [0, 1].map(|i| of(&test.reading, i)),
        Tested::Single(test, _) => [of(&test.reading, 0); 2],
    }
}

/// Period, and gain by first harmonics, of 1/(10 s + 1) e^(−2 s) under a relay of amplitude 1, in closed form: when the relay
/// has switched, the output goes on for the dead time and then turns.
fn exact_oscillation(bias: f64, hysteresis: f64) -> (f64, f64) {
    let (lag, dead_time) = (10.0, 2.0);
    let (up, down) = (bias + 1.0, bias - 1.0);
    let after_dead_time = |level: f64, input: f64| input + (level - input) * f64::exp(-dead_time / lag);
    let bottom = after_dead_time(-hysteresis, down);
    let top = after_dead_time(hysteresis, up);
    let rising = lag * ((up - bottom) / (up - hysteresis)).ln();
    let falling = lag * ((top - down) / (-hysteresis - down)).ln();
    let period = 2.0 * dead_time + rising + falling;
    (period, (TAU / period * lag).hypot(1.0))
}

#[test]
fn bias_and_hysteresis_act_in_every_test_of_both_loops() {
    for kind in [TestKind::Independent, TestKind::Sequential, TestKind::Simultaneous] {
        for (bias, hysteresis) in [(0.0, 0.0), (0.3, 0.0), (0.0, 0.05), (-0.2, 0.1)] {
            let mut setup = two_lags(kind);
            (setup.test.bias, setup.test.hysteresis) = ([bias; 2], [hysteresis; 2]);
            let (period, gain) = exact_oscillation(bias, hysteresis);
            for found in oscillations(&setup) {
                // Rows every 0.01 make the output straight lines: 1e-5 of a period.
                assert!((found.0 / period - 1.0).abs() < 1e-5, "{kind:?}: {found:?}, {period}");
                assert!((found.1 / gain - 1.0).abs() < 1e-5, "{kind:?}: {found:?}, {gain}");
            }
        }
    }
    // The figures of the closed form: 7.3318, 7.833 and 8.08, 9.039.
    assert!((exact_oscillation(0.3, 0.0).0 - 7.833).abs() < 5e-4);
    assert!((exact_oscillation(0.3, 0.0).1 - 8.08).abs() < 5e-3);
    assert!((exact_oscillation(0.0, 0.05).0 - 9.039).abs() < 5e-4);
}

#[test]
fn tests_of_each_loop_are_reported_with_what_their_settings_do_together() {
    let report = |kind: TestKind| {
        let mut setup = TuningSetup::default();
        setup.test.kind = kind;
        serde_json::to_value(TuningReport::of(&setup, &tune(&setup).unwrap()).unwrap()).unwrap()
    };
    let independent = report(TestKind::Independent);
    let (pair, loops) = (&independent["test"]["pair"], &independent["test"]["loops"]);
    for k in 0..2 {
        let [kp, gain] = [&pair["controllers"][k]["kp"], &loops[k]["settings"]["gain"]].map(|v| v.as_f64().unwrap());
        assert!((kp - gain).abs() <= 1e-12 * gain.abs(), "{kp} {gain}");
    }
    assert!(report(TestKind::Simultaneous)["test"].get("pair").is_none());
    for kind in [TestKind::Independent, TestKind::Sequential] {
        let pair = &report(kind)["test"]["pair"];
        let gains = [0, 1].map(|k| ["kp", "ki"].map(|name| pair["controllers"][k][name].as_f64().unwrap()));
        let (distance, peak) = wood_berry_margins(gains);
        // The grid is finer than 1e-3 of any feature of the loci, so the extremum is met to its square.
        assert!((pair["distance_from_minus_one"].as_f64().unwrap() / distance - 1.0).abs() < 1e-4, "{distance} {pair}");
        assert!((pair["sensitivity_peak"].as_f64().unwrap() / peak - 1.0).abs() < 1e-4, "{peak} {pair}");
        assert!(pair["stability"]["stable"].as_bool().unwrap());
    }
}

/// Smallest distance of the characteristic loci from −1 and largest singular value of S, by brute force, of the column of Wood and Berry
/// (1973) with the PI gains kp and ki of both loops on the diagonal.
fn wood_berry_margins(gains: [[f64; 2]; 2]) -> (f64, f64) {
    // Gain, dead time and time constant of each element (min).
    let elements = [[(12.8, 1.0, 16.7), (-18.9, 3.0, 21.0)], [(6.6, 7.0, 10.9), (-19.4, 3.0, 14.4)]];
    let mut extremes = (f64::INFINITY, 0.0_f64);
    for step in 0..40_000 {
        let s = Complex::new(0.0, 1e-3 * (1e4_f64).powf(f64::from(step) / 40_000.0));
        let controllers = gains.map(|[kp, ki]| s.inv() * ki + kp);
        let l = elements.map(|row| {
            [0, 1].map(|j: usize| {
                let (gain, dead_time, time_constant) = row[j];
                (-s * dead_time).exp() * gain / (s * time_constant + 1.0) * controllers[j]
            })
        });
        let (half_trace, det) = (0.5 * (l[0][0] + l[1][1]), l[0][0] * l[1][1] - l[0][1] * l[1][0]);
        let root = (half_trace * half_trace - det).sqrt();
        let nearest = [half_trace + root, half_trace - root].map(|locus| (locus + 1.0).norm());
        extremes.0 = extremes.0.min(nearest[0]).min(nearest[1]);
        // The singular values of S are the inverse ones of I + L: of a 2 × 2 matrix by its norm and determinant.
        let return_difference = [l[0][0] + 1.0, l[0][1], l[1][0], l[1][1] + 1.0];
        let norm: f64 = return_difference.iter().map(Complex::norm_sqr).sum();
        let det = (return_difference[0] * return_difference[3] - return_difference[1] * return_difference[2]).norm();
        let smallest = 0.5 * (norm - (norm * norm - 4.0 * det * det).sqrt());
        extremes.1 = extremes.1.max(smallest.sqrt().recip());
    }
    extremes
}
