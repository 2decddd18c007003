//! Relay-tuning documents are read as meant: the order of coefficients, elements that are not supported, settings without effect.

use quadtank::control::Pairing;
use quadtank::linear::LinearError;
use quadtank::literature::PresetId;
use quadtank::literature::campestrini::PublishedCase;
use quadtank::study::relay_tuning::{
    CompareSpec, DecouplerSpec, Element, ElementError, PlantStudy, SeriesElement, SteadyState, TestKind, TuningPlant,
    TuningSetup, tune,
};
use quadtank_scenario::tuning::{TuningScenario, TuningWarning, warnings};
use quadtank_scenario::{BenchDocument, ScenarioError, document_from_json, to_json};

/// A change of a session.
type Change = fn(&mut TuningSetup);

/// A gain, the time constants of its lags, and a dead time.
type Lags = (f64, &'static [f64], f64);

/// Columns of Wood and Berry (1973), Vinante and Luyben (1972), and Wardle and Wood (1969), as in Luyben (1986).
const COLUMNS: [[Lags; 4]; 3] = [
    [(12.8, &[16.7], 1.0), (-18.9, &[21.0], 3.0), (6.6, &[10.9], 7.0), (-19.4, &[14.4], 3.0)],
    [(-2.2, &[7.0], 1.0), (1.3, &[7.0], 0.3), (-2.8, &[9.5], 1.8), (4.3, &[9.2], 0.35)],
    [(0.126, &[60.0], 6.0), (-0.101, &[48.0, 45.0], 12.0), (0.094, &[38.0], 8.0), (-0.12, &[35.0], 8.0)],
];

/// `gain e^(−θ s)/((T1 s + 1)(T2 s + 1)…)` by rising powers of s.
fn element((gain, lags, dead_time): Lags) -> Element {
    let times = |so_far: Vec<f64>, t: &f64| {
        let mut product = [so_far.clone(), vec![0.0]].concat();
        so_far.iter().enumerate().for_each(|(k, a)| product[k + 1] += a * t);
        product
    };
    Element { numerator: vec![gain], denominator: lags.iter().fold(vec![1.0], times), dead_time }
}

/// A session with the times of the published ones of Wood and Berry.
fn session(elements: [Element; 4]) -> TuningSetup {
    let [a, b, c, d] = elements;
    TuningSetup { plant: TuningPlant::Elements([[a, b], [c, d]]), ..TuningScenario::default().tuning }
}

fn reversed(mut element: Element) -> Element {
    element.numerator.reverse();
    element.denominator.reverse();
    element
}

/// The same element with 1 as the coefficient of the highest power of its denominator.
fn monic(element: &Element) -> Element {
    let leading = *element.denominator.last().unwrap();
    let scaled = |of: &[f64]| of.iter().map(|c| c / leading).collect();
    Element { numerator: scaled(&element.numerator), denominator: scaled(&element.denominator), ..*element }
}

#[test]
fn elements_written_highest_power_first_are_told() {
    for (column, with_dead_time) in COLUMNS.into_iter().flat_map(|column| [(column, true), (column, false)]) {
        let meant =
            column.map(element).map(|of| Element { dead_time: if with_dead_time { of.dead_time } else { 0.0 }, ..of });
        assert_eq!(warnings(&session(meant.clone())), []);
        // Another usual way to write, which is read as meant.
        assert_eq!(warnings(&session(meant.each_ref().map(monic))), []);
        let warnings = warnings(&session(meant.map(reversed)));
        let [TuningWarning::CoefficientOrder { field, read_as, reversed }] = &warnings[..] else {
            panic!("{column:?}: {warnings:?}")
        };
        let time = column[0].1[0];
        assert_eq!(field, "tuning.plant.elements[0][0].denominator");
        assert_eq!((read_as, reversed), (&format!("{time} + 1 s"), &format!("1 + {time} s")));
    }
    let warning = warnings(&session(COLUMNS[0].map(element).map(reversed))).swap_remove(0).to_string();
    let expected = "tuning.plant.elements[0][0].denominator: read by rising powers of s, as 16.7 + 1 s; \
        if 1 + 16.7 s is meant, turn the coefficients round";
    assert_eq!(warning, expected);
    // s (10 s + 1), of which the integrator would be lost.
    let mut elements = COLUMNS[0].map(element);
    elements[3].denominator = vec![10.0, 1.0, 0.0];
    let warnings = warnings(&session(elements));
    assert!(matches!(&warnings[..], [TuningWarning::CoefficientOrder { field, .. }] if field.contains("[1][1]")));
}

#[test]
fn elements_that_are_plausible_as_they_stand_are_not_doubted() {
    let lag =
        |denominator: &[f64], dead_time| Element { numerator: vec![1.0], denominator: denominator.to_vec(), dead_time };
    let alike = |element: Element| session([element.clone(), element.clone(), element.clone(), element]);
    for element in [
        // Quick poles with the highest power 1; two lags of 1; short dead times; zeros at the end of a list of equal length.
        lag(&[5.0, 1.0], 0.0),
        lag(&[2.0, 1.0], 0.5),
        lag(&[1.0, 2.0, 1.0], 3.0),
        lag(&[0.05, 1.0], 3.0),
        lag(&[6.0, 5.0, 1.0], 1.0),
        lag(&[1.0, 16.7, 0.0], 1.0),
        // A lag that is short beside everything, but written as one.
        lag(&[1.0, 0.01], 3.0),
    ] {
        assert_eq!(warnings(&alike(element.clone())), [], "{element:?}");
    }
    for case in PublishedCase::all() {
        assert_eq!(warnings(&TuningSetup::published(case)), [], "{}", case.name());
    }
    for preset in PresetId::ALL {
        assert_eq!(warnings(&TuningSetup::on(TuningPlant::rig(preset))), [], "{preset:?}");
    }
}

#[test]
fn the_relative_gain_of_the_meant_column_is_the_published_one() {
    let rga =
        |elements: [Element; 4]| SteadyState::of(&session(elements).plant.transfer_matrix().unwrap()).rga_11.unwrap();
    // 2.0094 is g11 g22/det G(0) with the printed gains, recomputed.
    assert!((rga(COLUMNS[0].map(element)) - 2.0094).abs() < 5e-5);
    assert!((rga(COLUMNS[0].map(element).map(reversed)) - 2.1175).abs() < 5e-5);
}

#[test]
fn an_element_that_is_not_supported_is_named_with_the_reason() {
    let with = |numerator: &[f64], denominator: &[f64]| {
        let mut elements = COLUMNS[0].map(element);
        elements[1] = Element { numerator: numerator.to_vec(), denominator: denominator.to_vec(), dead_time: 0.0 };
        let tuning = session(elements);
        let scenario = TuningScenario { tuning: tuning.clone(), ..TuningScenario::default() };
        let pinned = TuningScenario { pinned: vec![tuning], ..TuningScenario::default() };
        assert!(
            matches!(pinned.validate(), Err(ScenarioError::Element { field, .. }) if field.starts_with("pinned[0].plant"))
        );
        scenario.validate().unwrap_err()
    };
    let refused = |fault| ScenarioError::Element { field: "tuning.plant.elements[0][1]".to_owned(), fault };
    assert_eq!(with(&[1.0, 2.0, 3.0], &[1.0, 1.0]), refused(ElementError::Improper { numerator: 2, denominator: 1 }));
    assert_eq!(with(&[1.0], &[0.0, 0.0]), refused(ElementError::NoDenominator));
    assert_eq!(with(&[1.0], &[-2.0, 1.0]), refused(ElementError::Unstable { real_part: 2.0 }));
    let said = with(&[1.0, 1.0, 1.0], &[5.0, 1.0]).to_string();
    let expected = "tuning.plant.elements[0][1]: an improper element (degree 2 over 1) is not supported: it would answer a step \
        with an impulse; its coefficients are read by rising powers of s: [1, 10] is 1 + 10 s";
    assert_eq!(said, expected);
}

#[test]
fn a_singular_gain_leaves_everything_else_known() {
    let setup = session([(); 4].map(|()| element((1.0, &[1.0], 0.0))));
    let steady_state = SteadyState::of(&setup.plant.transfer_matrix().unwrap());
    assert!(matches!(steady_state.rga_11, Err(LinearError::SingularGain { .. })), "{steady_state:?}");
    assert_eq!((steady_state.dc_gain.sum(), steady_state.niederlinski_diagonal), (4.0, None));
    let study = PlantStudy::of(&setup.plant).unwrap();
    assert_eq!((study.rga_11, study.curve.points.len()), (None, 200));
    // Rounding does not hide it: a row three times the other one.
    let rows = [(0.1, 3.0), (0.7, 2.0), (0.3, 1.0), (2.1, 4.0)];
    let setup = session(rows.map(|(gain, dead_time)| element((gain, &[2.0], dead_time))));
    let steady_state = SteadyState::of(&setup.plant.transfer_matrix().unwrap());
    assert!(steady_state.rga_11.is_err() && steady_state.niederlinski_diagonal.is_none(), "{steady_state:?}");
}

#[test]
fn a_setting_without_effect_is_told() {
    let cases: [(Change, &str); 9] = [
        (|s| s.test.number = 2, "tuning.test.number"),
        (|s| s.test.behind = SeriesElement::Integrator, "tuning.test.behind"),
        (|s| s.test.detuning = [1.0, 2.0], "tuning.test.detuning"),
        (|s| s.test.passes = 3, "tuning.test.passes"),
        (
            |s| {
                s.test.kind = TestKind::Single;
                s.test.bias = [0.1, 0.2];
            },
            "tuning.test.bias[1]",
        ),
        (
            |s| {
                s.test.kind = TestKind::Single;
                s.test.number = 2;
                s.test.hysteresis = [0.1, 0.2];
            },
            "tuning.test.hysteresis[0]",
        ),
        (
            |s| {
                s.plant = nonlinear_rig();
                s.test.kind = TestKind::Sequential;
            },
            "tuning.plant.quadruple_tank.nonlinear",
        ),
        (
            |s| {
                s.plant = nonlinear_rig();
                s.design.decoupler = DecouplerSpec::Dynamic;
            },
            "tuning.plant.quadruple_tank.nonlinear",
        ),
        (
            |s| {
                s.plant = nonlinear_rig();
                s.response.compare = CompareSpec::Full;
            },
            "tuning.response.compare",
        ),
    ];
    for (change, expected) in cases {
        let mut setup = TuningScenario::default().tuning;
        change(&mut setup);
        let warnings = warnings(&setup);
        assert!(matches!(&warnings[..], [TuningWarning::NoEffect { field, .. }] if *field == expected), "{warnings:?}");
    }
}

/// What `warnings` calls without effect changes nothing, and what it does not, does.
#[test]
fn a_setting_has_an_effect_where_no_warning_says_otherwise() {
    let found = |setup: &TuningSetup| format!("{:?}", tune(setup).unwrap().test);
    let changes: [Change; 6] = [
        |s| s.test.number = 2,
        |s| s.test.behind = SeriesElement::Integrator,
        |s| s.test.detuning = [2.0, 3.0],
        |s| s.test.passes = 2,
        |s| s.test.bias = [0.0, 0.2],
        |s| s.test.hysteresis = [0.0, 0.01],
    ];
    for kind in [TestKind::Single, TestKind::Independent, TestKind::Sequential, TestKind::Simultaneous] {
        let mut plain = session(COLUMNS[0].map(element));
        plain.test.kind = kind;
        plain.test.duration = 150.0;
        let before = found(&plain);
        for change in changes {
            let mut setup = plain.clone();
            change(&mut setup);
            let warnings = warnings(&setup);
            assert_eq!(found(&setup) == before, !warnings.is_empty(), "{kind:?}: {warnings:?}");
        }
    }
}

fn nonlinear_rig() -> TuningPlant {
    TuningPlant::QuadrupleTank {
        preset: PresetId::JohanssonMinimumPhase,
        valves: None,
        pairing: Pairing::Diagonal,
        dead_time_s: 0.0,
        lag_s: 0.0,
        nonlinear: true,
    }
}

#[test]
fn a_session_with_warnings_is_written_and_read_again() {
    let scenario =
        TuningScenario { tuning: session(COLUMNS[0].map(element).map(reversed)), ..TuningScenario::default() };
    assert!(document_from_json(&to_json(&scenario).unwrap()).is_ok());
}
