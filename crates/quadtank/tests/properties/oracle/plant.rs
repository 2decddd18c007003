//! The plant against the independent reference values in `data/quadruple-tank.json`.

use approx::assert_relative_eq;
use quadtank::literature::PresetId;
use serde::Deserialize;

use super::reference::Parameters;

/// Two implementations of the same closed formulas: only rounding is between them.
const RELATIVE: f64 = 1e-9;

#[derive(Deserialize)]
struct Reference {
    cases: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    name: String,
    plant: Parameters,
    pump_voltage: [f64; 2],
    levels: [f64; 4],
    time_constants: [f64; 4],
    a: [[f64; 4]; 4],
    b: [[f64; 2]; 4],
    c: [[f64; 4]; 2],
}

fn cases() -> Vec<Case> {
    let reference: Reference = serde_json::from_str(include_str!("../../data/quadruple-tank.json")).unwrap();
    assert_eq!(reference.cases.len(), 14);
    reference.cases
}

#[test]
fn equilibrium_levels() {
    for case in cases() {
        let point = case.plant.rig().equilibrium(case.pump_voltage).unwrap();
        for (level, expected) in point.levels.into_iter().zip(case.levels) {
            assert_relative_eq!(level, expected, max_relative = RELATIVE);
        }
    }
}

#[test]
fn inputs_that_hold_the_levels() {
    for case in cases() {
        let point = case.plant.rig().inputs_for_levels([case.levels[0], case.levels[1]]).unwrap();
        for (voltage, expected) in point.pump_voltage.into_iter().zip(case.pump_voltage) {
            assert_relative_eq!(voltage, expected, max_relative = RELATIVE);
        }
        for (level, expected) in point.levels.into_iter().zip(case.levels) {
            assert_relative_eq!(level, expected, max_relative = RELATIVE);
        }
    }
}

#[test]
fn time_constants() {
    for case in cases() {
        let plant = case.plant.rig();
        let found = plant.time_constants_s(&plant.free_equilibrium(case.pump_voltage));
        for (time_constant, expected) in found.into_iter().zip(case.time_constants) {
            assert_relative_eq!(time_constant.unwrap(), expected, max_relative = RELATIVE);
        }
    }
}

#[test]
fn linear_model() {
    for case in cases() {
        let plant = case.plant.rig();
        let model = plant.linearise(&plant.free_equilibrium(case.pump_voltage));
        for i in 0..4 {
            for j in 0..4 {
                assert_relative_eq!(model.a[(i, j)], case.a[i][j], max_relative = RELATIVE);
            }
            for j in 0..2 {
                assert_relative_eq!(model.b[(i, j)], case.b[i][j], max_relative = RELATIVE);
                assert_relative_eq!(model.c[(j, i)], case.c[j][i], max_relative = RELATIVE);
            }
        }
        let (a, b, c) = model.reduced();
        assert_eq!(
            (a.as_slice(), b.as_slice(), c.as_slice()),
            (model.a.as_slice(), model.b.as_slice(), model.c.as_slice())
        );
    }
}

/// The presets are the plants of the reference: their parameters, not only what follows from them.
#[test]
fn presets_are_the_published_plants() {
    for case in cases() {
        let Some(preset) = PresetId::from_name(&case.name).map(PresetId::preset) else {
            assert!(case.name.starts_with("random-"));
            continue;
        };
        let (plant, expected) = (preset.plant, &case.plant);
        assert_relative_eq!(plant.gravity, expected.gravity, max_relative = RELATIVE);
        assert_relative_eq!(plant.sensor.gain, expected.sensor_gain, max_relative = RELATIVE);
        for i in 0..2 {
            assert_relative_eq!(plant.valves[i], expected.gamma[i], max_relative = RELATIVE);
            assert_relative_eq!(plant.pumps[i].gain, expected.pump_gain[i], max_relative = RELATIVE);
            assert_relative_eq!(preset.pump_voltage[i], case.pump_voltage[i], max_relative = RELATIVE);
        }
        for (j, tank) in plant.tanks.iter().enumerate() {
            assert_relative_eq!(tank.outlet.effective_area(), expected.outlet_area[j], max_relative = RELATIVE);
            assert_relative_eq!(tank.section.area_at_empty, expected.area_at_empty[j], max_relative = RELATIVE);
            assert_relative_eq!(tank.section.area_slope, expected.area_slope[j], max_relative = RELATIVE);
        }
        let levels = plant.equilibrium(preset.pump_voltage).unwrap().levels;
        for (level, expected) in levels.into_iter().zip(case.levels) {
            assert_relative_eq!(level, expected, max_relative = RELATIVE);
        }
    }
}
