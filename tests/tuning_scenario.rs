//! Relay-tuning documents: published cases, versions, bad input.
#![cfg(not(target_arch = "wasm32"))]

use quadtank::linear::LoopStability;
use quadtank::scenario::tuning::{PublishedCase, tune};
use quadtank::scenario::{Document, ScenarioError, document_from_json, from_json, tuning_to_json};

/// kp1, ki1, kd1, kp2, ki2, kd2 as printed.
fn printed(case: PublishedCase) -> [f64; 6] {
    match (case.table, case.row) {
        (5, _) => [0.178, 0.017, 0.0, -0.118, -0.011, 0.0],
        (6, 1) => [0.567, 0.336, 0.239, -0.102, -0.018, -0.144],
        (6, _) => [0.155, 0.085, 0.070, -0.400, -0.076, -0.530],
        (8, 1) => [0.162, 0.004, 0.0, -0.107, -0.003, 0.0],
        (8, _) => [0.138, 0.016, 0.0, -0.091, -0.011, 0.0],
        // ki2 is a slip of the thesis: −0.026.
        (9, _) => [0.250, 0.037, 0.420, -0.165, -0.0245, -0.277],
        (10, 1) => [0.025, 0.029, 0.0, -0.128, -0.009, 0.0],
        (10, _) => [0.013, 0.026, 0.0, -0.114, -0.015, 0.0],
        (11, 1) => [0.582, 0.223, 0.379, -0.087, -0.014, -0.136],
        (11, _) => [0.143, 0.063, 0.082, -0.312, -0.043, -0.559],
        (12, 1) => [0.106, 0.032, 0.087, -0.144, -0.014, -0.382],
        (12, 2) => [0.093, 0.031, 0.069, -0.151, -0.016, -0.365],
        (12, 3) => [0.098, 0.032, 0.076, -0.149, -0.015, -0.372],
        (12, _) => [0.101, 0.032, 0.080, -0.148, -0.014, -0.376],
        (14, 1) => [0.812, 1.723, 0.0, 0.169, 0.359, 0.0],
        (14, 2) => [0.931, 1.537, 0.0, 0.194, 0.320, 0.0],
        (14, 4) => [1.573, 1.347, 0.0, 0.328, 0.281, 0.0],
        (14, _) => [1.171, 0.765, 0.0, 0.244, 0.159, 0.0],
        (15, 1) => [-0.101, 0.630, 0.0, 0.721, 0.385, 0.0],
        (15, _) => [-0.096, 0.741, 0.0, 0.850, -0.035, 0.0],
        (_, 1) => [0.087, 1.600, 0.001, 1.165, 1.148, 0.296],
        _ => [0.114, 1.792, 0.002, 1.196, 1.058, 0.338],
    }
}

#[test]
fn every_published_case_gives_its_printed_controllers() {
    for case in PublishedCase::ALL {
        let scenario = case.scenario();
        let tuning = tune(&scenario.tuning).unwrap();
        let design = tuning.design.unwrap();
        let root = &design.roots[scenario.tuning.design.root - 1];
        let found = root.controllers.iter().flat_map(|c| [c.proportional, c.integral, c.derivative]);
        for (found, printed) in found.zip(printed(case)) {
            // Half a unit of the last digit (Table 5 cuts), and 0.05 % for the digits of the printed periods.
            assert!(
                (found - printed).abs() <= 6e-4 + 5e-4 * printed.abs(),
                "{}: {found} is not {printed}",
                case.name()
            );
        }
        let stable = root.stability == LoopStability::Stable;
        assert_eq!(stable, case != PublishedCase { table: 15, row: 2 }, "{}", case.name());
    }
}

#[test]
fn documents_of_both_versions_come_back() {
    for case in PublishedCase::ALL {
        assert_eq!(PublishedCase::from_name(&case.name()), Some(case));
        let text = tuning_to_json(&case.scenario()).unwrap();
        assert_eq!(document_from_json(&text), Ok(Document::Tuning(case.scenario())));
        // Who reads only the first version says so.
        assert!(matches!(from_json(&text), Err(ScenarioError::UnknownVersion { found: 2, newest: 1 })));
    }
    let text = include_str!("data/scenario-v1-johansson.json");
    assert_eq!(document_from_json(text), from_json(text).map(Document::Quadruple));
    let unknown = document_from_json(r#"{"version": 3}"#);
    assert_eq!(unknown, Err(ScenarioError::UnknownVersion { found: 3, newest: 2 }));
}

#[test]
fn a_wrong_field_is_named() {
    let text = tuning_to_json(&PublishedCase::ALL[0].scenario()).unwrap();
    let refused = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        document_from_json(&text.replacen(from, to, 1)).unwrap_err().to_string()
    };
    assert!(refused("\"root\": 2", "\"root\": 3").starts_with("tuning.design.root: 3"));
    assert!(refused("\"step\": 0.05", "\"step\": 0.0").starts_with("tuning.test.step: 0"));
    assert!(refused("\"period\": 12.9", "\"period\": -1").starts_with("tuning.design.critical.point.period: -1"));
    assert!(refused("\"wood-berry\"", "\"wood\"").starts_with("tuning.plant.published"));
}
