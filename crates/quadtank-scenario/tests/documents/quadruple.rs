//! The scenario as a document: what goes out comes back, what is broken is named, and nothing that comes in panics.

mod fields;
use fields::{LEAVES, full};
use proptest::prelude::*;
use proptest::sample::Index;
use quadtank::control::{AntiWindup, LoopMode, Pairing};
use quadtank::literature::{DisplayUnit, PresetId};
use quadtank::plant::{CrossSection, Outlet, Sensor};
use quadtank::sim::{Load, LoadStep, Measurement, SetPointStep};
use quadtank::study::quadruple_tank::{OperatingPointSpec, PlantSpec, Setup, setup_of};
use quadtank_scenario::{
    DOCUMENT_LIMIT, Document, LINK_LIMIT, Scenario, ScenarioError, View, document_from_link, from_json, limits,
    to_json, to_link,
};
use serde_json::json;

/// The scenario of a link.
fn from_link(link: &str) -> Result<Scenario, ScenarioError> {
    document_from_link(link).map(|document| match document {
        Document::Quadruple(scenario) => scenario,
        other => panic!("{link} is {other:?}"),
    })
}

proptest! {
    #[test]
    fn json_brings_back_every_digit(scenario in crate::random::scenario(limits::MAX_STEPS, Scenario::MAX_PINNED)) {
        prop_assert_eq!(from_json(&to_json(&scenario).unwrap()), Ok(scenario));
    }

    /// Two steps of each kind, as an experiment has: then every number of the rig may be different.
    #[test]
    fn links_bring_back_every_digit(scenario in crate::random::scenario(2, 0)) {
        let link = to_link(&scenario).unwrap();
        prop_assert!(link.len() <= LINK_LIMIT);
        prop_assert!(link.bytes().all(|byte| byte.is_ascii_alphanumeric() || b".-_".contains(&byte)), "{}", link);
        prop_assert_eq!(from_link(&link), Ok(scenario));
    }

    #[test]
    fn a_link_that_is_cut_off_is_damaged(scenario in crate::random::scenario(1, 0), keep in any::<Index>()) {
        let link = to_link(&scenario).unwrap();
        let shorter = &link[..keep.index(link.len())];
        prop_assert_eq!(from_link(shorter), Err(ScenarioError::DamagedLink));
    }

    /// A bit that pads the last byte of the text may change and means nothing.
    #[test]
    fn a_link_with_one_wrong_character_never_brings_another_scenario(scenario in crate::random::scenario(1, 0), at in any::<Index>(), wrong in "[A-Za-z0-9_-]") {
        let link = to_link(&scenario).unwrap();
        let payload = "q1.".len();
        let at = payload + at.index(link.len() - payload);
        let changed = format!("{}{wrong}{}", &link[..at], &link[at + 1..]);
        let result = from_link(&changed);
        prop_assert!(result == Err(ScenarioError::DamagedLink) || result == Ok(scenario), "{:?}", result);
    }

    #[test]
    fn no_text_is_too_strange(text in any::<String>(), payload in "q1\\.[A-Za-z0-9_-]{0,300}") {
        prop_assert!(from_json(&text).is_err());
        prop_assert!(from_link(&text).is_err());
        prop_assert!(from_link(&payload).is_err());
    }

    /// Cuts and swaps in a good document, which get further than noise does.
    #[test]
    fn no_damaged_document_is_too_strange(at in 0..1500_usize, length in 0..40_usize, put in "[-0-9.eE\\[\\]{}\",:a-z]{0,6}") {
        let mut text = to_json(&Scenario::default()).unwrap();
        let start = at.min(text.len());
        let end = (start + length).min(text.len());
        text.replace_range(start..end, &put);
        let _ = from_json(&text);
    }

    /// Whatever is read can be written, and reads the same.
    #[test]
    fn what_is_read_can_be_written(value in any::<f64>(), field in 0..LEAVES.len()) {
        let mut document = full();
        *document.pointer_mut(LEAVES[field].1).unwrap() = json!(value);
        if let Ok(scenario) = from_json(&document.to_string()) {
            prop_assert_eq!(from_json(&to_json(&scenario).unwrap()), Ok(scenario));
        }
    }
}

// Length.

/// A rig of one's own with 17 digits everywhere and all steps that fit into an experiment; other digits for each series.
fn largest_setup(series: usize) -> Setup {
    let digits = |index: usize| 0.1 + 0.8 * ((100 * series + index) as f64 * std::f64::consts::SQRT_2).fract();
    let mut setup = setup_of(PresetId::CocotaMinimumPhase);
    let mut rig = setup.plant();
    for (index, tank) in rig.tanks.iter_mut().enumerate() {
        let index = 10 * index;
        tank.section = CrossSection { area_at_empty: 0.02 * digits(index), area_slope: digits(index + 1) };
        tank.outlet = Outlet { area: 1e-4 * digits(index + 2), loss_coefficient: digits(index + 3) };
        tank.height = digits(index + 4);
    }
    for (index, pump) in rig.pumps.iter_mut().enumerate() {
        pump.gain = 1e-5 * digits(50 + index);
        pump.voltage_max = 10.0 + digits(52 + index);
    }
    rig.valves = [digits(54), digits(55)];
    rig.power_gain = 1.0 + digits(56);
    rig.sensor = Sensor { gain: 40.0 * digits(57), range: digits(58), resolution: 0.01 * digits(59) };
    rig.gravity = 9.0 + digits(60);
    setup.plant = PlantSpec::Parameters { rig, display_unit: DisplayUnit::Mm };
    setup.valves = [digits(61), digits(62)];
    setup.operating_point = OperatingPointSpec::PumpVoltage([9.0 + digits(63), 9.0 + digits(64)]);
    for (index, settings) in setup.controller.loops.iter_mut().enumerate() {
        settings.gain = digits(65 + index);
        settings.integral_time_s = 100.0 * digits(67 + index);
        settings.set_point_weight = digits(69 + index);
    }
    setup.experiment.set_point_steps = (0..limits::MAX_STEPS)
        .map(|index| SetPointStep { level: index % 2, time_s: 200.0 * index as f64, size: 0.05 * digits(80 + index) })
        .collect();
    setup.experiment.load_steps = (0..limits::MAX_STEPS)
        .map(|index| LoadStep {
            time_s: 150.0 * index as f64,
            load: Load::PumpFlow { pump: index % 2, flow: 1e-5 * digits(90 + index) },
        })
        .collect();
    setup.experiment.measurement.noise_std = 0.01 * digits(99);
    setup
}

#[test]
fn the_largest_scenario_with_a_pinned_run_fits_into_a_link() {
    let setup = largest_setup(0);
    let mut pinned = setup.clone();
    pinned.valves = [0.123_456_789_012_345_6, 0.654_321_098_765_432_1];
    pinned.controller.loops[0].gain = 1.234_567_890_123_456_7;
    let scenario = Scenario { pinned: vec![pinned], ..Scenario::from(setup) };
    let link = to_link(&scenario).unwrap();
    assert!(link.len() <= LINK_LIMIT, "{} characters", link.len());
    assert_eq!(from_link(&link), Ok(scenario));
}

#[test]
fn a_published_setup_takes_a_short_link() {
    for id in PresetId::ALL {
        let link = to_link(&Scenario::from(setup_of(id))).unwrap();
        // The dictionary of the links knows the first six rigs, and never changes.
        let most = if id as usize <= PresetId::JunqueiraB as usize { 60 } else { 300 };
        assert!(link.len() <= most, "{id:?}: {} characters", link.len());
    }
}

#[test]
fn what_does_not_fit_into_a_link_says_so() {
    let scenario = Scenario { pinned: vec![largest_setup(1), largest_setup(2)], ..Scenario::from(largest_setup(0)) };
    assert_eq!(to_link(&scenario), Err(ScenarioError::NoLink { max: LINK_LIMIT }));
    let too_long = format!("q1.{}", "A".repeat(LINK_LIMIT));
    assert_eq!(from_link(&too_long), Err(ScenarioError::TooLong { length: LINK_LIMIT + 3, max: LINK_LIMIT }));
}

#[test]
fn a_document_longer_than_any_scenario_is_not_read() {
    let text = " ".repeat(DOCUMENT_LIMIT + 1);
    assert_eq!(from_json(&text), Err(ScenarioError::TooLong { length: DOCUMENT_LIMIT + 1, max: DOCUMENT_LIMIT }));
}

/// 20 characters that would unpack to 100 MB: one byte, and a copy of it into itself.
#[test]
fn a_bomb_does_not_go_off() {
    use base64::Engine;
    use base64::engine::general_purpose::URL_SAFE_NO_PAD;
    // x as a raw byte (E 78), a copy (D) from one byte back, and a length of nine octal digits.
    let packed = [0xE7, 0x8D, 0x10, 0xFF, 0xFF, 0xFF, 0xFF, 0x7F, 0x00];
    assert_eq!(from_link(&format!("q1.{}", URL_SAFE_NO_PAD.encode(packed))), Err(ScenarioError::DamagedLink));
}

#[test]
fn more_behind_the_end_of_a_link_is_damage() {
    let link = to_link(&Scenario::default()).unwrap();
    for more in ["A", "AA", "AAA", "AAAA", "=", ".", " ", "\0"] {
        assert_eq!(from_link(&format!("{link}{more}")), Err(ScenarioError::DamagedLink), "{more:?}");
    }
}

// Versions.

#[test]
fn an_unknown_version_is_refused_before_anything_else_is_read() {
    for found in [0, 2, 99, u64::MAX] {
        let text = json!({ "version": found, "whatever": [1, 2, 3] }).to_string();
        assert_eq!(from_json(&text), Err(ScenarioError::UnknownVersion { found, newest: 1 }));
    }
    assert_eq!(from_link("q5.AAAA"), Err(ScenarioError::UnknownVersion { found: 5, newest: 4 }));
    for text in ["{}", r#"{"version": "1"}"#, r#"{"version": -1}"#, "[]", "null", "", "{"] {
        assert!(matches!(from_json(text), Err(ScenarioError::Malformed { .. })), "{text}");
    }
    assert_eq!(from_link("q.AAAA"), Err(ScenarioError::DamagedLink));
    assert_eq!(from_link(""), Err(ScenarioError::DamagedLink));
}

// Documents and links that are out in the world: these files never change, nor does the dictionary of the links.

const GOLDEN: [(&str, &str); 2] = [
    (include_str!("../data/scenario-v1-johansson.json"), include_str!("../data/scenario-v1-johansson.link")),
    (include_str!("../data/scenario-v1-own-rig.json"), include_str!("../data/scenario-v1-own-rig.link")),
];

#[test]
fn version_1_is_read_for_ever() {
    for (document, link) in GOLDEN {
        let scenario = from_json(document).unwrap();
        assert_eq!(from_link(link.trim_end()).as_ref(), Ok(&scenario));
        assert_eq!(to_json(&scenario).unwrap(), document.trim_end());
    }
}

#[test]
fn version_1_means_what_it_meant() {
    let [johansson, own_rig] = GOLDEN.map(|(document, _)| from_json(document).unwrap());
    assert_eq!(johansson.setup.plant, PlantSpec::Preset(PresetId::JohanssonMinimumPhase));
    assert_eq!(
        johansson.setup.controller.loops.map(|settings| (settings.gain, settings.integral_time_s)),
        [(3.0, 30.0), (2.7, 40.0)]
    );
    assert_eq!(
        johansson.setup.experiment.set_point_steps[1],
        SetPointStep { level: 1, time_s: 1500.0, size: 0.006_391_579_201_504_485 }
    );
    let PlantSpec::Parameters { rig, display_unit } = own_rig.setup.plant else { panic!("{:?}", own_rig.setup.plant) };
    assert_eq!(display_unit, DisplayUnit::Mm);
    assert_eq!(rig.tanks[1].section.area_slope, 0.033_915_365_246_952_82);
    assert_eq!(rig.valves, [0.512_345_678_901_234_5, 0.598_765_432_109_876_5]);
    assert_eq!(own_rig.setup.valves, [0.1, 1.0 / 3.0]);
    assert_eq!(own_rig.setup.operating_point, OperatingPointSpec::Levels([0.15, 0.160_000_000_000_000_03]));
    assert_eq!(own_rig.setup.controller.pairing, Pairing::Swapped);
    assert_eq!(own_rig.setup.controller.loops[0].anti_windup, AntiWindup::Off);
    assert_eq!(own_rig.setup.controller.loops[1].mode, LoopMode::Manual { output: 5.0, until_s: 100.0 });
    let loads = own_rig.setup.experiment.load_steps;
    assert_eq!(loads[0].load, Load::PumpFlow { pump: 0, flow: -1e-5 });
    assert_eq!(loads[1].load, Load::Leak { tank: 3, area: 2.5e-6 });
    let expected = Measurement { noise_std: 0.001, seed: u32::MAX, quantised: true };
    assert_eq!(own_rig.setup.experiment.measurement, expected);
    assert_eq!(own_rig.pinned[0].plant, PlantSpec::Preset(PresetId::JunqueiraB));
    let expected = View { cursor_s: Some(123.0), zoom_s: Some([100.0, 900.0]), hide_linear: true };
    assert_eq!(own_rig.view, expected);
}
