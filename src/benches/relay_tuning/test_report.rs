//! What a relay test says: its verdict in words and its figures.

use leptos::prelude::*;

use super::errors;
use super::session::{Session, time_unit};
use crate::texts::tr;
use crate::widgets::{Cells, Headings, Row, TableContent};
use quadtank::control::IsaPid;
use quadtank::study::relay_tuning::{TestKind, Tested};
use quadtank::tuning::{CurveDistance, RelayReading, RelayVerdict, TestAndSettings};

/// The readings of a test with the settings that follow, in the order of the experiments.
fn readings(test: &Tested) -> Vec<(String, RelayReading, Option<IsaPid>)> {
    match test {
        Tested::Single(test, _) | Tested::Simultaneous(test, _) => vec![(String::new(), test.reading, None)],
        Tested::Independent(loops) => {
            let row = |(k, (test, settings)): (usize, &TestAndSettings)| ((k + 1).to_string(), test.reading, *settings);
            loops.iter().enumerate().map(row).collect()
        }
        Tested::Sequential(steps) => steps
            .iter()
            .map(|step| (format!("{}·{}", step.pass, step.index + 1), step.test.reading, step.settings))
            .collect(),
    }
}

/// The verdict in words, and whether all is well.
pub fn sentence(session: Session) -> (bool, String) {
    let lab = session.lab;
    let style = lab.number_style();
    let unit = session.throttled.setup.with(|s| time_unit(&s.plant));
    session.throttled.test.with(|outcome| {
        let test = match outcome.as_ref() {
            Ok(test) => test,
            Err(error) => return (false, errors::sentence(lab, error)),
        };
        let all = readings(test);
        let shown = all.iter().find(|(_, reading, _)| reading.oscillation.is_none()).or(all.last());
        let Some(shown @ (_, reading, _)) = shown else { return (false, String::new()) };
        // Independent tests have a period each.
        let read = if matches!(test, Tested::Independent(_)) { &all[..] } else { std::slice::from_ref(shown) };
        let periods: Vec<String> =
            read.iter().filter_map(|(_, reading, _)| Some(style.significant(reading.oscillation?.period, 4))).collect();
        let period = periods.join(" / ");
        let (good, mut text) = match reading.verdict {
            RelayVerdict::Unimodal => (true, tr!(lab, relay.unimodal, period = period, unit = unit)),
            RelayVerdict::Multimodal { switches: [one, two] } => {
                (false, tr!(lab, relay.multimodal, period = period, unit = unit, one = one, two = two))
            }
            RelayVerdict::NotPeriodic => (false, tr!(lab, relay.not_periodic)),
            RelayVerdict::Chattering { relay } => {
                let why = jump(session, reading.verdict, relay).map_or_else(String::new, |why| " ".to_owned() + &why);
                (false, tr!(lab, relay.chattering, number = relay + 1) + &why)
            }
            RelayVerdict::NoOscillation => (false, tr!(lab, relay.no_oscillation)),
            RelayVerdict::Diverged => (false, tr!(lab, relay.diverged)),
            RelayVerdict::Unfinished { time } => {
                (false, tr!(lab, relay.unfinished, time = style.significant(time, 3), unit = unit))
            }
        };
        let good = good
            && match test {
                Tested::Simultaneous(test, [_, by_harmonic]) => {
                    let proportional = test.reading.oscillation.is_none_or(|o| o.is_proportional());
                    let same = by_harmonic.is_none_or(|distance| distance.same_branch);
                    let limited = test.trace.limited.contains(&true);
                    if limited {
                        text = text + " " + &tr!(lab, relay.pump_limit);
                    } else if !same {
                        text = text + " " + &tr!(lab, relay.other_branch);
                    } else if !proportional {
                        text = text + " " + &tr!(lab, relay.not_proportional);
                    }
                    same && proportional && !limited
                }
                Tested::Single(_, Some(found)) => {
                    let modulus = style.significant(found.modulus, 3);
                    let norm = style.significant(found.response.norm(), 3);
                    let degrees = style.fixed(found.phase.to_degrees(), 0);
                    text = text + " " + &tr!(lab, relay.found_point, modulus = modulus, norm = norm, degrees = degrees);
                    true
                }
                _ => true,
            };
        (good, text)
    })
}

/// Why a relay on an element with direct feedthrough switches at once.
fn jump(session: Session, verdict: RelayVerdict, relay: usize) -> Option<String> {
    let lab = session.lab;
    let study = session.throttled.study.get();
    let jump = session.throttled.setup.with(|setup| study.as_ref().as_ref().ok()?.jump_with_relay(setup, verdict))?;
    let place = ["₁₁", "₂₂"][relay];
    Some(tr!(lab, relay.switches_itself, place = place, jump = lab.number_style().significant(jump, 3)))
}

/// Amplitudes and gains of every experiment, how far they are from the curve, and the settings that follow.
pub fn table(session: Session) -> Option<impl IntoView> {
    let lab = session.lab;
    let outcome = session.throttled.test.get();
    let test = outcome.as_ref().as_ref().ok()?;
    let unit = session.throttled.setup.with(|s| time_unit(&s.plant));
    let columns = vec![
        tr!(lab, relay.col_loop),
        tr!(lab, relay.col_period, unit = unit),
        "a".to_owned(),
        tr!(lab, relay.col_peak),
        tr!(lab, relay.col_harmonic),
    ];
    let (mut rows, rules) = rows(session, test);
    if let Tested::Simultaneous(_, distances) = test {
        // A test that shows nothing keeps its rows, so that what stands below stays where it is while the ratio is dragged.
        if rows.is_empty() {
            let empty =
                |name: &str| view! { <Row class="" name=name.to_owned() figures=["–"; 4].map(str::to_owned) /> };
            rows.extend(["1", "2"].map(|name| empty(name).into_any()));
        }
        rows.push(distance_row(session, distances));
    }
    if !rules.is_empty() {
        let heads = [&*tr!(lab, relay.col_loop), "K", "Ti", "Td"].map(str::to_owned).to_vec();
        rows.push(view! { <Headings texts=heads /> }.into_any());
        rows.extend(rules);
    }
    Some(view! { <TableContent caption=tr!(lab, relay.test_caption) columns rows /> })
}

/// A row for each loop of each experiment, and those of the settings that follow.
fn rows(session: Session, test: &Tested) -> (Vec<AnyView>, Vec<AnyView>) {
    let style = session.lab.number_style();
    let number = |v: Option<f64>| v.map_or_else(|| "–".to_owned(), |v| style.significant(v, 4));
    let second = session.throttled.setup.with(|s| s.test.kind == TestKind::Single && s.test.number == 2);
    let (mut rows, mut rules) = (Vec::new(), Vec::new());
    for (name, reading, settings) in readings(test) {
        let Some(oscillation) = reading.oscillation else { continue };
        for (k, of) in oscillation.loops.iter().enumerate().filter(|(_, of)| of.gain_by_peak.is_some()) {
            let which = if second { 2 } else { k + 1 };
            let label = if name.is_empty() { which.to_string() } else { name.clone() };
            let class = if label.ends_with('2') { "loop2" } else { "loop1" };
            let figures = [Some(oscillation.period), Some(of.amplitude), of.gain_by_peak, of.gain_by_harmonic];
            rows.push(view! { <Row class name=label.clone() figures=figures.map(number) /> }.into_any());
            if let Some(settings) = settings {
                let settings = [settings.gain, settings.integral_time, settings.derivative_time];
                let figures = settings.map(|v| number(Some(v).filter(|v| v.is_finite())));
                rules.push(view! { <Row class name=label figures /> }.into_any());
            }
        }
    }
    (rows, rules)
}

fn distance_row(session: Session, distances: &[Option<CurveDistance>; 2]) -> AnyView {
    let lab = session.lab;
    let percent = |distance: &Option<CurveDistance>| match distance {
        Some(distance) => format!("{}\u{a0}%", lab.number_style().fixed(100.0 * distance.excess, 1)),
        None => "–".to_owned(),
    };
    let texts = distances.iter().map(percent).collect();
    view! { <tr><th scope="row" colspan="3">{tr!(lab, relay.distance)}</th><Cells texts /></tr> }.into_any()
}
