//! Broken fields: each is named, with what is wrong about it.

use quadtank::control::LoopMode;
use quadtank::literature::PresetId;
use quadtank::plant::{OperatingPoint, Pump};
use quadtank::sim::{InflowStep, Load, PumpVoltageStep};
use quadtank::study::quadruple_tank::{OperatingPointSpec, PlantSpec, setup_of};
use quadtank_scenario::{DOCUMENT_LIMIT, Scenario, ScenarioError, View, from_json, limits, to_json, to_link};
use serde_json::{Value, json};

use super::largest_setup;

/// A document in which every kind of field occurs.
pub fn full() -> Value {
    let mut scenario = Scenario::from(largest_setup(0));
    let setup = &mut scenario.setup;
    setup.controller.loops[0].mode = LoopMode::Manual { output: 5.0, until_s: 60.0 };
    setup.experiment.load_steps[1].load = Load::Leak { tank: 3, area: 1e-6 };
    setup.experiment.load_steps[3].load = Load::TankFlow { tank: 2, flow: 1e-6 };
    setup.experiment.load_steps[4].load = Load::PumpGain { pump: 0, change: -0.25 };
    setup.experiment.load_steps[5].load = Load::Valve { valve: 1, change: 0.125 };
    setup.experiment.load_steps[6].load = Load::Outlet { tank: 2, change: -0.5 };
    setup.experiment.pump_flow_noise_std = 1e-7;
    setup.experiment.initial_levels = Some([0.02, 0.01, 0.08, 0.03]);
    setup.experiment.pump_voltage_steps =
        [0, 1].map(|pump| PumpVoltageStep { pump, time_s: 100.0, voltage: 3.0 }).to_vec();
    setup.experiment.inflow_steps = vec![InflowStep { tank: 3, time_s: 60.0, flow: 1e-6 }];
    if let PlantSpec::Parameters { rig, .. } = &mut setup.plant {
        rig.inflow = [0.0, 0.0, 1e-6, 2e-6];
        rig.pumps[0] = Pump { offset: -1e-6, start_voltage: 0.5, flow_max: Some(1e-3), delay_s: 2.5, ..rig.pumps[0] };
    }
    let mut pinned = setup_of(PresetId::JohanssonMinimumPhase);
    pinned.operating_point = OperatingPointSpec::Levels([0.1, 0.12]);
    let mut at_a_state = pinned.clone();
    at_a_state.operating_point =
        OperatingPointSpec::State(OperatingPoint { levels: [0.124, 0.127, 0.018, 0.014], pump_voltage: [3.0, 3.0] });
    scenario.pinned = vec![pinned, at_a_state];
    scenario.view = View { cursor_s: Some(10.0), zoom_s: Some([0.0, 100.0]), hide_linear: false };
    serde_json::from_str(&to_json(&scenario).unwrap()).unwrap()
}

/// Fields (by the path that an error gives, and by JSON pointer) and a number that is out of their range.
pub const LEAVES: [(&str, &str, f64); 58] = [
    (
        "setup.plant.parameters.rig.tanks[2].section.area_at_empty",
        "/setup/plant/parameters/rig/tanks/2/section/area_at_empty",
        0.0,
    ),
    (
        "setup.plant.parameters.rig.tanks[1].section.area_slope",
        "/setup/plant/parameters/rig/tanks/1/section/area_slope",
        -1.0,
    ),
    ("setup.plant.parameters.rig.tanks[0].outlet.area", "/setup/plant/parameters/rig/tanks/0/outlet/area", 0.0),
    ("setup.plant.parameters.rig.tanks[0].outlet.area", "/setup/plant/parameters/rig/tanks/0/outlet/area", 0.009),
    (
        "setup.plant.parameters.rig.tanks[3].outlet.loss_coefficient",
        "/setup/plant/parameters/rig/tanks/3/outlet/loss_coefficient",
        1.5,
    ),
    ("setup.plant.parameters.rig.tanks[3].height", "/setup/plant/parameters/rig/tanks/3/height", -0.2),
    ("setup.plant.parameters.rig.pumps[0].gain", "/setup/plant/parameters/rig/pumps/0/gain", -4e-6),
    ("setup.plant.parameters.rig.pumps[0].voltage_min", "/setup/plant/parameters/rig/pumps/0/voltage_min", -1.0),
    ("setup.plant.parameters.rig.pumps[1].voltage_max", "/setup/plant/parameters/rig/pumps/1/voltage_max", -1.0),
    ("setup.plant.parameters.rig.pumps[0].offset", "/setup/plant/parameters/rig/pumps/0/offset", 2.0),
    ("setup.plant.parameters.rig.pumps[0].start_voltage", "/setup/plant/parameters/rig/pumps/0/start_voltage", 999.0),
    ("setup.plant.parameters.rig.pumps[0].flow_max", "/setup/plant/parameters/rig/pumps/0/flow_max", 0.0),
    ("setup.plant.parameters.rig.pumps[0].delay_s", "/setup/plant/parameters/rig/pumps/0/delay_s", 601.0),
    ("setup.plant.parameters.rig.valves[0]", "/setup/plant/parameters/rig/valves/0", 1.1),
    ("setup.plant.parameters.rig.power_gain", "/setup/plant/parameters/rig/power_gain", 0.0),
    ("setup.plant.parameters.rig.sensor.gain", "/setup/plant/parameters/rig/sensor/gain", 0.0),
    ("setup.plant.parameters.rig.sensor.range", "/setup/plant/parameters/rig/sensor/range", 0.0),
    ("setup.plant.parameters.rig.sensor.resolution", "/setup/plant/parameters/rig/sensor/resolution", -1.0),
    ("setup.plant.parameters.rig.sensor.resolution", "/setup/plant/parameters/rig/sensor/resolution", 5e-324),
    ("setup.plant.parameters.rig.sensor.resolution", "/setup/plant/parameters/rig/sensor/resolution", 0.9e-9),
    ("setup.plant.parameters.rig.gravity", "/setup/plant/parameters/rig/gravity", 0.0),
    ("setup.plant.parameters.rig.inflow[2]", "/setup/plant/parameters/rig/inflow/2", -1e-6),
    ("setup.valves[1]", "/setup/valves/1", -0.1),
    ("setup.operating_point.pump_voltage[0]", "/setup/operating_point/pump_voltage/0", -3.0),
    ("setup.controller.loops[0].gain", "/setup/controller/loops/0/gain", 1e-4),
    ("setup.controller.loops[1].gain", "/setup/controller/loops/1/gain", -1e4),
    ("setup.controller.loops[0].integral_time_s", "/setup/controller/loops/0/integral_time_s", 0.0),
    ("setup.controller.loops[0].set_point_weight", "/setup/controller/loops/0/set_point_weight", 2.0),
    (
        "setup.controller.loops[1].anti_windup.back_calculation.tracking_ratio",
        "/setup/controller/loops/1/anti_windup/back_calculation/tracking_ratio",
        0.0,
    ),
    ("setup.controller.loops[0].mode.manual.output", "/setup/controller/loops/0/mode/manual/output", -1.0),
    ("setup.controller.loops[0].mode.manual.until_s", "/setup/controller/loops/0/mode/manual/until_s", -1.0),
    ("setup.controller.sampling_time_s", "/setup/controller/sampling_time_s", 0.0),
    ("setup.experiment.duration_s", "/setup/experiment/duration_s", 1.0),
    ("setup.experiment.set_point_steps[0].time_s", "/setup/experiment/set_point_steps/0/time_s", -1.0),
    ("setup.experiment.set_point_steps[3].size", "/setup/experiment/set_point_steps/3/size", 11.0),
    ("setup.experiment.load_steps[1].time_s", "/setup/experiment/load_steps/1/time_s", 1e6),
    ("setup.experiment.load_steps[1].load.leak.area", "/setup/experiment/load_steps/1/load/leak/area", 1.0),
    ("setup.experiment.load_steps[2].load.pump_flow.flow", "/setup/experiment/load_steps/2/load/pump_flow/flow", 1.0),
    ("setup.experiment.load_steps[3].load.tank_flow.flow", "/setup/experiment/load_steps/3/load/tank_flow/flow", 1.0),
    (
        "setup.experiment.load_steps[4].load.pump_gain.change",
        "/setup/experiment/load_steps/4/load/pump_gain/change",
        -1.5,
    ),
    ("setup.experiment.load_steps[5].load.valve.change", "/setup/experiment/load_steps/5/load/valve/change", 1.5),
    ("setup.experiment.load_steps[6].load.outlet.change", "/setup/experiment/load_steps/6/load/outlet/change", -1.5),
    ("setup.experiment.pump_flow_noise_std", "/setup/experiment/pump_flow_noise_std", -1e-9),
    // Less than the pump gives where its dead zone ends.
    ("setup.plant.parameters.rig.pumps[0].flow_max", "/setup/plant/parameters/rig/pumps/0/flow_max", 1.1e-9),
    // No tank of the full document is that high.
    ("setup.experiment.initial_levels[3]", "/setup/experiment/initial_levels/3", 0.95),
    ("setup.experiment.initial_levels[0]", "/setup/experiment/initial_levels/0", -0.01),
    ("setup.experiment.pump_voltage_steps[1].time_s", "/setup/experiment/pump_voltage_steps/1/time_s", -1.0),
    ("setup.experiment.pump_voltage_steps[0].voltage", "/setup/experiment/pump_voltage_steps/0/voltage", -1.0),
    ("setup.experiment.inflow_steps[0].time_s", "/setup/experiment/inflow_steps/0/time_s", -1.0),
    ("setup.experiment.inflow_steps[0].flow", "/setup/experiment/inflow_steps/0/flow", -1e-6),
    ("setup.experiment.measurement.noise_std", "/setup/experiment/measurement/noise_std", -0.1),
    ("pinned[0].valves[0]", "/pinned/0/valves/0", 7.0),
    ("pinned[0].operating_point.levels[1]", "/pinned/0/operating_point/levels/1", 70.0),
    ("pinned[0].controller.sampling_time_s", "/pinned/0/controller/sampling_time_s", 100.0),
    ("view.cursor_s", "/view/cursor_s", -1.0),
    ("view.zoom_s[0]", "/view/zoom_s/0", -1.0),
    ("view.zoom_s[1]", "/view/zoom_s/1", -1.0),
    ("setup.experiment.duration_s", "/setup/experiment/duration_s", 1e9),
];

#[test]
fn a_full_document_is_allowed() {
    assert!(from_json(&full().to_string()).is_ok());
}

#[test]
fn a_sensor_is_ideal_or_has_at_least_the_least_resolution() {
    for resolution in [0.0, limits::MIN_SENSOR_RESOLUTION, limits::SENSOR_RESOLUTION.max] {
        let mut document = full();
        *document.pointer_mut("/setup/plant/parameters/rig/sensor/resolution").unwrap() = json!(resolution);
        assert!(from_json(&document.to_string()).is_ok(), "{resolution}");
    }
}

#[test]
fn every_number_out_of_range_names_itself_and_its_limits() {
    for (path, pointer, wrong) in LEAVES {
        let mut document = full();
        *document.pointer_mut(pointer).unwrap() = json!(wrong);
        match from_json(&document.to_string()) {
            Err(ScenarioError::OutOfRange { field, value, min, max }) => {
                assert_eq!(field, path);
                assert!(value < min || value > max, "{path}: {value} in {min} to {max}");
            }
            other => panic!("{path}: {other:?}"),
        }
    }
}

#[test]
fn more_samples_than_a_run_may_have_name_both_times() {
    let mut document = full();
    // The experiment lasts 1750 s.
    document["setup"]["controller"]["sampling_time_s"] = json!(0.001);
    let error = from_json(&document.to_string()).unwrap_err();
    let field = "setup.experiment.duration_s".to_owned();
    let expected = ScenarioError::TooManySamples { field, duration_s: 1750.0, sampling_time_s: 0.001, max: 20_000.0 };
    assert_eq!(error, expected);
    assert!(error.to_string().contains("controller.sampling_time_s"), "{error}");
    document["setup"]["experiment"]["duration_s"] = json!(20.0);
    assert!(from_json(&document.to_string()).is_ok());
}

#[test]
fn gravity_in_centimetres_is_told() {
    let mut document = full();
    document["setup"]["plant"]["parameters"]["rig"]["gravity"] = json!(981.0);
    let error = from_json(&document.to_string()).unwrap_err().to_string();
    assert!(error.ends_with("is outside 0.1 to 100; gravity is in m/s², and 981 cm/s² are 9.81 m/s²"), "{error}");
}

#[test]
fn an_index_beyond_its_list_names_itself() {
    for (path, pointer) in [
        ("setup.experiment.set_point_steps[0].level", "/setup/experiment/set_point_steps/0/level"),
        ("setup.experiment.load_steps[0].load.pump_flow.pump", "/setup/experiment/load_steps/0/load/pump_flow/pump"),
        ("setup.experiment.load_steps[1].load.leak.tank", "/setup/experiment/load_steps/1/load/leak/tank"),
        ("setup.experiment.load_steps[3].load.tank_flow.tank", "/setup/experiment/load_steps/3/load/tank_flow/tank"),
        ("setup.experiment.load_steps[4].load.pump_gain.pump", "/setup/experiment/load_steps/4/load/pump_gain/pump"),
        ("setup.experiment.load_steps[5].load.valve.valve", "/setup/experiment/load_steps/5/load/valve/valve"),
        ("setup.experiment.load_steps[6].load.outlet.tank", "/setup/experiment/load_steps/6/load/outlet/tank"),
        ("setup.experiment.pump_voltage_steps[1].pump", "/setup/experiment/pump_voltage_steps/1/pump"),
        ("setup.experiment.inflow_steps[0].tank", "/setup/experiment/inflow_steps/0/tank"),
    ] {
        let mut document = full();
        *document.pointer_mut(pointer).unwrap() = json!(4);
        let error = from_json(&document.to_string()).unwrap_err();
        assert!(matches!(&error, ScenarioError::OutOfRange { field, value: 4.0, .. } if field == path), "{error}");
    }
}

#[test]
fn too_many_entries_are_counted() {
    for (path, pointer, count, max) in [
        ("setup.experiment.set_point_steps", "/setup/experiment/set_point_steps", 101, limits::MAX_SET_POINT_STEPS),
        ("setup.experiment.load_steps", "/setup/experiment/load_steps", 30, limits::MAX_STEPS),
        ("setup.experiment.pump_voltage_steps", "/setup/experiment/pump_voltage_steps", 40_001, limits::MAX_PUMP_STEPS),
        ("setup.experiment.inflow_steps", "/setup/experiment/inflow_steps", 40_001, limits::MAX_PUMP_STEPS),
        ("pinned", "/pinned", Scenario::MAX_PINNED + 1, Scenario::MAX_PINNED),
    ] {
        let mut document = full();
        let list = document.pointer_mut(pointer).unwrap();
        *list = json!(vec![list[0].clone(); count]);
        let expected = ScenarioError::TooMany { field: path.to_owned(), count, max };
        assert_eq!(from_json(&document.to_string()), Err(expected));
    }
}

#[test]
fn every_field_of_the_wrong_kind_names_itself() {
    for (path, pointer, _) in LEAVES {
        let mut document = full();
        *document.pointer_mut(pointer).unwrap() = json!("much");
        let error = from_json(&document.to_string()).unwrap_err();
        let ScenarioError::Malformed { path: found, reason } = &error else { panic!("{path}: {error}") };
        assert_eq!(format!("/{}", found.replace('[', ".").replace(']', "").replace('.', "/")), pointer);
        assert!(reason.contains("much"), "{path}: {reason}");
    }
}

#[test]
fn numbers_that_are_none_are_refused() {
    let text = full().to_string();
    for none in ["NaN", "1e999", "-1e999", "Infinity", "null", "\"1\"", "[]", "{}", "--1", "0x10", ""] {
        let broken = text.replace("\"sampling_time_s\":1.0", &format!("\"sampling_time_s\":{none}"));
        assert_ne!(broken, text);
        let error = from_json(&broken).unwrap_err();
        assert!(matches!(error, ScenarioError::Malformed { .. }), "{none}: {error}");
    }
    let mut scenario = Scenario::default();
    scenario.setup.valves[0] = f64::NAN;
    assert!(matches!(to_json(&scenario), Err(ScenarioError::OutOfRange { field, .. }) if field == "setup.valves[0]"));
    assert!(matches!(to_link(&scenario), Err(ScenarioError::OutOfRange { .. })));
}

#[test]
fn unknown_missing_and_double_fields_are_refused_by_name() {
    let mut unknown = full();
    unknown["setup"]["controller"]["loops"][0]["derivative_time_s"] = json!(1.0);
    let error = from_json(&unknown.to_string()).unwrap_err().to_string();
    assert!(error.starts_with("setup.controller.loops[0].derivative_time_s: unknown field"), "{error}");

    let mut missing = full();
    missing["setup"]["experiment"].as_object_mut().unwrap().remove("duration_s");
    let error = from_json(&missing.to_string()).unwrap_err().to_string();
    assert!(error.starts_with("setup.experiment: missing field `duration_s`"), "{error}");

    let double = to_json(&Scenario::default()).unwrap().replacen("\"valves\"", "\"valves\": [0, 0], \"valves\"", 1);
    let error = from_json(&double).unwrap_err().to_string();
    assert!(error.starts_with("setup.valves: duplicate field `valves`"), "{error}");

    let more = format!("{} {{}}", full());
    let error = from_json(&more).unwrap_err().to_string();
    assert!(error.starts_with("document: trailing characters"), "{error}");

    let shorter = {
        let mut shorter = full();
        shorter["setup"]["valves"] = json!([0.5]);
        shorter.to_string()
    };
    let error = from_json(&shorter).unwrap_err().to_string();
    assert!(error.starts_with("setup.valves: invalid length 1, expected 2 elements"), "{error}");

    let mode = |mode: Value| {
        let mut document = full();
        document["setup"]["controller"]["loops"][0]["mode"] = mode;
        from_json(&document.to_string()).unwrap_err().to_string()
    };
    let path = "setup.controller.loops[0].mode";
    for (value, error) in [
        (json!("manual"), ".manual: a choice that needs a value"),
        (json!({ "automatic": {} }), ".automatic: invalid type: map, expected a choice without a value"),
        (json!({ "automatic": null }), ".automatic: invalid type: null, expected a choice without a value"),
        (json!({}), ": invalid length 0, expected one choice"),
        (json!({ "manual": {}, "automatic": {} }), ": invalid length 2, expected one choice"),
        (json!({ "manual": [] }), ".manual: invalid type: list, expected a map"),
        (json!({ "slow": 1 }), ": unknown variant `slow`, expected one of `automatic`, `manual`"),
        (json!(1), ": invalid type: integer `1`, expected a choice"),
    ] {
        assert_eq!(mode(value), format!("{path}{error}"));
    }

    let mut other_rig = full();
    other_rig["pinned"][0]["plant"] = json!({ "preset": "johansson-1999" });
    let error = from_json(&other_rig.to_string()).unwrap_err().to_string();
    assert!(error.starts_with("pinned[0].plant.preset: unknown variant `johansson-1999`"), "{error}");
}

#[test]
fn what_may_be_absent_is_as_if_it_were_not_used() {
    let mut document = full();
    let fields = document.as_object_mut().unwrap();
    fields.remove("view");
    fields.remove("pinned");
    let scenario = from_json(&document.to_string()).unwrap();
    assert_eq!((scenario.pinned, scenario.view), (Vec::new(), View::default()));
    document["view"] = json!({ "cursor_s": 7 });
    let scenario = from_json(&document.to_string()).unwrap();
    assert_eq!(scenario.view, View { cursor_s: Some(7.0), ..View::default() });
}

#[test]
fn deep_nesting_ends_in_an_error() {
    let text = format!("{{\"version\":1,\"setup\":{}", "[".repeat(DOCUMENT_LIMIT / 2));
    assert!(matches!(from_json(&text), Err(ScenarioError::Malformed { .. })));
}
