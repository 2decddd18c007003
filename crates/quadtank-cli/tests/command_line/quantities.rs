//! Quantities by their names, against the full reports and the page that lists them.

use std::fs;

use quadtank::literature::PresetId;
use serde_json::Value;

use super::{pipe, preset, run, stderr, stdout};

fn parsed(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

fn report(arguments: &[&str], document: &str) -> Value {
    parsed(&stdout(&pipe(arguments, document.as_bytes())))
}

/// Every pair of a quantity and a JSON pointer agrees.
fn assert_agree(document: &str, report: &Value, pairs: &[(&str, &str)]) {
    let mut arguments = vec!["analyse", "-"];
    for (name, _) in pairs {
        arguments.extend(["--only", name]);
    }
    let found = parsed(&stdout(&pipe(&arguments, document.as_bytes())));
    for (name, pointer) in pairs {
        let reported = report.pointer(pointer).unwrap_or_else(|| panic!("{pointer}"));
        assert_eq!(&found[name], reported, "{name}");
    }
}

#[test]
fn quantities_of_the_home_bench_are_those_of_its_reports() {
    for id in [PresetId::JohanssonMinimumPhase, PresetId::JohanssonNonMinimumPhase, PresetId::CocotaMinimumPhase] {
        let document = preset(id);
        let theory = [
            ("levels.h1", "/operating_point/levels/0"),
            ("pumps.v2", "/operating_point/pump_voltage/1"),
            ("tank3.time_constant", "/time_constants_s/2"),
            ("zero.rightmost", "/zeros/1/value/re"),
            ("zero.leftmost", "/zeros/0/value/re"),
            ("zero.output_direction2", "/zeros/1/output_direction/1/re"),
            ("rga.lambda11", "/rga_11"),
            ("niederlinski.diagonal", "/niederlinski/diagonal"),
            ("closed_loop.sensitivity_peak", "/closed_loop/sensitivity_peak"),
            ("closed_loop.sensitivity_peak_frequency", "/closed_loop/sensitivity_peak_frequency"),
            ("closed_loop.guaranteed_phase", "/closed_loop/guaranteed_margins/phase_rad"),
        ];
        assert_agree(&document, &report(&["analyse", "-"], &document), &theory);
        let costs = [
            ("level1.overshoot", "/metrics/0/overshoot"),
            ("level2.iae", "/metrics/1/iae"),
            ("level1.settling_2_percent", "/metrics/0/settling_2_percent/after/time_s"),
            ("level1.coupling", "/metrics/0/other_peak"),
            ("level2.itae", "/metrics/1/itae"),
            ("run.final_level4", "/nonlinear/levels/3/LAST"),
        ];
        let run = report(&["simulate", "-", "--format", "json"], &document);
        let last = run.pointer("/nonlinear/levels/3").unwrap().as_array().unwrap().len() - 1;
        let last = format!("/nonlinear/levels/3/{last}");
        let costs =
            costs.map(|(name, pointer)| (name, if pointer.ends_with("LAST") { last.as_str() } else { pointer }));
        assert_agree(&document, &run, &costs);
    }
}

#[test]
fn quantities_of_other_benches_are_those_of_their_reports() {
    let level = stdout(&run(&["cases", "andreis-sine-l"]));
    let pairs = [
        ("assess.variance_level", "/figures/level/variance"),
        ("assess.variance_outflow", "/figures/outflow/variance"),
        ("run.iae", "/figures/iae"),
        ("run.valve_travel", "/travel/total"),
        ("margins.gain", "/closed_loop/gain_margin"),
        ("assess.index_level", "/indices/level/quality"),
    ];
    assert_agree(&level, &report(&["simulate", "-", "--format", "json"], &level), &pairs);
    let hidden = stdout(&run(&["cases", "junqueira-b-s3"]));
    let pairs = [("level1.iae", "/figures/0/iae"), ("level1.lost_at", "/figures/0/lost_at_s")];
    assert_agree(&hidden, &report(&["simulate", "-", "--format", "json"], &hidden), &pairs);
    let column = stdout(&run(&["cases", "table-6-row-1"]));
    let pairs = [("rga.lambda11", "/rga_11"), ("gain.g12", "/dc_gain/0/1")];
    assert_agree(&column, &report(&["analyse", "-"], &column), &pairs);
}

#[test]
fn a_quantity_that_does_not_exist_is_null() {
    let document = preset(PresetId::JohanssonMinimumPhase);
    let output = pipe(&["analyse", "-", "--only", "interpolation.area"], document.as_bytes());
    assert_eq!(parsed(&stdout(&output)), serde_json::json!({ "interpolation.area": null }));
}

#[test]
fn an_unknown_name_is_refused_with_names_that_are_like_it() {
    let document = preset(PresetId::JohanssonMinimumPhase);
    let refused = |name: &str| {
        let output = pipe(&["analyse", "-", "--only", name], document.as_bytes());
        assert_eq!(output.status.code(), Some(2));
        assert!(output.stdout.is_empty());
        stderr(&output)
    };
    let near = refused("zero.rightmots");
    assert!(near.contains("the bench quadruple-tank has no quantity `zero.rightmots`"), "{near}");
    assert!(near.contains("`zero.rightmost`"), "{near}");
    assert!(refused("relay.period").contains("no quantity `relay.period`"));
    let none = refused("xyz");
    assert!(none.contains("`quadtank quantities` lists them"), "{none}");
}

/// When this fails: `quadtank quantities > docs/quantities.md`.
#[test]
fn the_page_of_quantities_is_what_the_command_prints() {
    let page = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/quantities.md")).unwrap();
    assert_eq!(stdout(&run(&["quantities"])), page);
    let one = stdout(&run(&["quantities", "--version", "4"]));
    assert!(one.contains("## level-loop, version 4") && !one.contains("quadruple-tank"));
    assert!(page.ends_with(one.split("## ").nth(1).unwrap()));
    assert_eq!(run(&["quantities", "--version", "5"]).status.code(), Some(2));
}
