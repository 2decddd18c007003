//! Rigs and experiments from outside that the laboratory once could not take. What is expected is theirs, or follows by hand.

use quadtank::study::quadruple_tank::{Setup, run};
use quadtank_scenario::report::tuning::TuningAnalysisReport;
use quadtank_scenario::{Document, document_from_json, run_to_csv};

fn setup(json: &str) -> Setup {
    match document_from_json(json).unwrap() {
        Document::Quadruple(scenario) => scenario.setup,
        other => panic!("{other:?}"),
    }
}

/// A modified four-tank system with constant inflow of 100 and 150 cm³/s into tanks 3 and 4. Levels at rest as its case prints them.
#[test]
fn constant_inflow_into_the_upper_tanks() {
    let setup = setup(include_str!("../data/inflow-into-upper-tanks.json"));
    let rest = setup.operating_point().unwrap();
    for (level, printed_cm) in rest.levels.iter().zip([46.331_221_7, 77.974_532_3, 12.217_363_8, 24.671_629_4]) {
        assert!((100.0 * level - printed_cm).abs() < 6e-8, "{level} {printed_cm}");
    }
    // The same levels ask for the same voltages, and nothing moves.
    let plant = setup.plant();
    let back = plant.inputs_for_levels([rest.levels[0], rest.levels[1]]).unwrap();
    assert!(back.pump_voltage.iter().all(|voltage| (voltage - 300.0).abs() < 1e-9), "{back:?}");
    let run = run(&setup).unwrap();
    for (tank, column) in run.nonlinear.levels.iter().enumerate() {
        assert!(column.iter().all(|level| (level - rest.levels[tank]).abs() < 1e-12));
    }
}

/// A run from 2, 1, 8 and 3 cm: the first row, and the balance of tank 1 over the first second.
#[test]
fn a_run_begins_at_levels_of_its_own() {
    let setup = setup(include_str!("../data/initial-levels.json"));
    let run = run(&setup).unwrap();
    let first = |run: &quadtank::sim::Trajectory| run.levels.each_ref().map(|column| column[0]);
    assert_eq!(first(&run.nonlinear), [0.02, 0.01, 0.08, 0.03]);
    for (level, expected) in first(&run.linear).into_iter().zip([0.02, 0.01, 0.08, 0.03]) {
        assert!((level - expected).abs() < 1e-15);
    }
    // Both pumps are at their limit of 0.6 V in the first second: a small level asks for all they have.
    let (a, section, k) = (3e-7, 4.9e-4, 1.6e-6);
    let speed = |level: f64| (2.0 * 9.81 * level).sqrt();
    let slope = (0.2 * k * 0.6 + a * (speed(0.08) - speed(0.02))) / section;
    let risen = run.nonlinear.levels[0][1] - 0.02;
    assert!((risen / slope - 1.0).abs() < 1e-2, "{risen} {slope}");
    assert!(run_to_csv(&run).lines().nth(1).unwrap().starts_with("0,0.02,0.01,0.08,0.03,"));
}

/// Pump 1 follows a given sequence between 5 and 6 V, pump 2 its controller.
#[test]
fn a_pump_follows_a_given_sequence() {
    let setup = setup(include_str!("../data/pump-sequence.json"));
    let run = run(&setup).unwrap().nonlinear;
    let voltage = |time_s: f64| run.pump_voltage[0][run.row_at(time_s).unwrap()];
    let expected = [(0.0, 5.0), (3.2, 5.0), (3.3, 6.0), (9.2, 6.0), (9.3, 5.0), (15.3, 6.0), (24.3, 5.0), (59.9, 6.0)];
    for (time_s, volts) in expected {
        assert_eq!(voltage(time_s + 1e-9), volts, "{time_s}");
    }
    // While it stands at its voltage at rest the water stands still.
    let row = run.row_at(3.2).unwrap();
    assert!((run.levels[0][row] - run.levels[0][0]).abs() < 1e-12);
    assert!(run.levels[0][run.row_at(9.2).unwrap()] > run.levels[0][0] + 1e-4);
}

/// Four elements of a rig that was identified at KTH: poles and zeros as its case prints them, and its relative gain.
#[test]
fn elements_have_poles_and_zeros() {
    let document = document_from_json(include_str!("../data/elements-with-zeros.json")).unwrap();
    let Document::Tuning(scenario) = document else { panic!("{document:?}") };
    let report = TuningAnalysisReport::of(&scenario.tuning).unwrap();
    let json = serde_json::to_value(&report).unwrap();
    for (name, printed) in [("poles", &[-0.09089, -0.08582, -0.05106, -0.04692][..]), ("zeros", &[-0.23559, 0.05887])] {
        let found: Vec<f64> = json[name].as_array().unwrap().iter().map(|root| root["re"].as_f64().unwrap()).collect();
        assert_eq!(found.len(), printed.len(), "{name}: {found:?}");
        assert!(found.iter().zip(printed).all(|(found, printed)| (found - printed).abs() < 5e-6), "{name}: {found:?}");
    }
    assert!((json["rga_11"].as_f64().unwrap() + 0.5625).abs() < 5e-5, "{}", json["rga_11"]);
}
