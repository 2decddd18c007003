use quadtank::literature::PresetId;
use quadtank::plant::OperatingPoint;
use quadtank::study::quadruple_tank::{OperatingPointSpec, setup_of};
use quadtank_scenario::from_json;

use super::*;
use crate::sample;

/// A rig at levels that are not at rest.
fn at_a_state() -> Scenario {
    let mut scenario = Scenario::default();
    scenario.setup.operating_point =
        OperatingPointSpec::State(OperatingPoint { levels: [0.124, 0.127, 0.018, 0.014], pump_voltage: [3.0, 3.0] });
    scenario
}

/// A rig whose valve fractions depend on the flow.
fn with_flow_dependent_valves() -> Scenario {
    from_json(include_str!("../../../quadtank-scenario/tests/data/flow-dependent-valves.json")).unwrap()
}

/// Documents of every shape: each preset, everything at once, singular plants, dry tanks, a state that is not at rest.
fn scenarios() -> Vec<Scenario> {
    let presets = PresetId::ALL.map(|id| Scenario::from(setup_of(id)));
    let valves = [[0.4, 0.6], [1.0, 0.0], [0.0, 0.0], [1.0, 1.0], [0.0, 0.5]].map(|valves| {
        let mut scenario = Scenario::default();
        scenario.setup.valves = valves;
        scenario
    });
    presets
        .into_iter()
        .chain(valves)
        .chain([sample::everything_acts(), at_a_state(), with_flow_dependent_valves()])
        .collect()
}

/// What stands outside of comments.
fn code(text: &str) -> String {
    text.lines().filter(|line| !line.starts_with('%')).map(|line| line.to_owned() + "\n").collect()
}

#[test]
fn braces_and_environments_are_closed_in_order() {
    for scenario in scenarios() {
        let text = code(&latex(&scenario).unwrap());
        assert!(!text.contains("{{ ") && !text.contains("NaN") && !text.contains("inf}"), "{text}");
        let mut depth = 0_i32;
        for character in text.chars() {
            depth += match character {
                '{' => 1,
                '}' => -1,
                _ => 0,
            };
            assert!(depth >= 0, "{text}");
        }
        assert_eq!(depth, 0);
        let mut open = Vec::new();
        for mark in text.split('\\').skip(1) {
            if let Some(name) = mark.strip_prefix("begin{").and_then(|rest| rest.split('}').next()) {
                open.push(name);
            } else if let Some(name) = mark.strip_prefix("end{").and_then(|rest| rest.split('}').next()) {
                assert_eq!(open.pop(), Some(name), "{text}");
            }
        }
        assert_eq!(open, Vec::<&str>::new());
        assert_eq!(text.matches('$').count() % 2, 0);
        assert_eq!(text.matches("\\left").count(), text.matches("\\right").count());
        // A paragraph ends no displayed equation, and nothing but comments has characters that LaTeX may not know.
        for display in ["align*", "equation*"] {
            for part in text.split(&format!("\\begin{{{display}}}")).skip(1) {
                assert!(!part.split(&format!("\\end{{{display}}}")).next().unwrap().contains("\n\n"), "{text}");
            }
        }
        assert!(text.is_ascii(), "{text}");
    }
}

#[test]
fn a_model_away_from_rest_has_its_drift() {
    let rest = latex(&Scenario::default()).unwrap();
    assert!(rest.contains("(V) at rest,") && !rest.contains("d + A x"), "{rest}");
    let state = latex(&at_a_state()).unwrap();
    assert!(state.contains("not at rest,") && state.contains(r"\dot{x} &= d + A x + B u"), "{state}");
    let drift = analyse(&at_a_state().setup).unwrap().drift.unwrap();
    for rate in drift {
        assert!(state.contains(&number(rate)), "{rate}: {state}");
    }
}

#[test]
fn fractions_that_depend_on_the_flow_are_told() {
    assert!(!latex(&Scenario::default()).unwrap().contains("small flows"));
    let scenario = with_flow_dependent_valves();
    let text = latex(&scenario).unwrap();
    let fractions = analyse(&scenario.setup).unwrap().flow_fractions.unwrap();
    for pair in [[1e4, -6e3], fractions.of_flow, fractions.incremental] {
        assert!(text.contains(&row(&pair)), "{pair:?}: {text}");
    }
}

#[test]
fn the_numbers_are_those_of_the_analysis() {
    for scenario in scenarios() {
        let (text, setup) = (latex(&scenario).unwrap(), &scenario.setup);
        let analysis = analyse(setup).unwrap();
        let of_matrices = [&analysis.linear.model.a, &analysis.linear.model.b, &analysis.linear.model.c];
        let gains = analysis.linear.dc_gain.iter().flatten().copied();
        let zeros = analysis.linear.zeros.iter().flatten().map(|zero| zero.value.re);
        let controller = setup.controller.loops.iter().flat_map(|pi| [pi.gain, pi.integral_time_s]);
        let numbers = of_matrices.into_iter().flatten().copied().chain(gains).chain(zeros).chain(controller);
        let numbers =
            numbers.chain(analysis.operating_point.levels).chain(analysis.time_constants_s.into_iter().flatten());
        for value in numbers.chain(analysis.linear.rga_11) {
            assert!(text.contains(&number(value)), "{value}: {text}");
        }
    }
}

#[test]
fn the_matrix_of_the_minimum_phase_setting_is_that_of_the_source() {
    let text = latex(&Scenario::default()).unwrap();
    // Two lags across, one on the diagonal (Johansson 2000, eq. 2 with Table 1).
    let row = text.split("G(s) = ").nth(1).unwrap().split('\n').next().unwrap();
    assert_eq!(row.matches("\\dfrac").count(), 4);
    assert_eq!(row.matches("s + 1").count(), 6);
    assert_eq!(text.matches("u_1(t) &= 3 \\left(").count(), 1);
    assert_eq!(text.matches("\\frac{1}{30}").count(), 1);
}

#[test]
fn what_does_not_exist_is_said() {
    let mut scenario = Scenario::default();
    scenario.setup.valves = [0.4, 0.6];
    assert!(latex(&scenario).unwrap().contains("the relative gain array does not exist"));
    scenario.setup.valves = [1.0, 0.0];
    assert!(latex(&scenario).unwrap().contains("$\\det G(s) = 0$ for every $s$"));
}

#[test]
fn a_label_stays_in_its_comment() {
    let plain = latex(&Scenario::default()).unwrap();
    let mut scenario = Scenario::default();
    scenario.label.name = "\\end{document} {{ a }} } \u{2028}\\input{x}\r^^M\\x".to_owned();
    let text = latex(&scenario).unwrap();
    assert_eq!(code(&text), code(&plain));
    assert!(text.contains("% Experiment: \\end{document} {{ a }} }\n"));
}
