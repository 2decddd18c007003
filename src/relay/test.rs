//! Step 1: the relay test, its record and what it says.

use leptos::prelude::*;

use super::card::{Step, card, hideable};
use super::controls::{TIME, choice};
use super::details;
use super::errors;
use super::pictures::{self, record_of, short_name};
use super::readout::{readout, surface};
use super::session::{Session, time_unit, use_session};
use super::timeline::timeline;
use crate::controls::{Knob, knob, segmented};
use crate::start::Control;
use crate::texts::{say, tr};
use crate::widgets::html::{cells, element, escape, option};
use crate::widgets::{DataTable, Scale, ZoomButtons, figures, handler, html};
use quadtank::control::IsaPid;
use quadtank::tuning::{CurveDistance, RelayReading, RelayVerdict, TestAndSettings, TuningRule};
use quadtank_figure::Frame;
use quadtank_scenario::tuning::{Behind, CriticalSpec, TestKind, Tested, TuningSetup};

const KINDS: [TestKind; 4] = [TestKind::Single, TestKind::Independent, TestKind::Sequential, TestKind::Simultaneous];
/// Ratios of the amplitudes that the slider covers.
const RATIOS: (f64, f64) = (0.02, 20.0);
/// Modulus that the estimator of a point begins with.
const FIRST_MODULUS: f64 = 0.2;
/// Share of a record that is shown to begin with: enough to see it settle, little enough to see its switches.
const BEGINNING: f64 = 0.25;
const SIZES: (f64, f64) = (1e-6, 1e6);

const RATIO: Knob<TuningSetup> = Knob {
    ids: [("ratio", "ratio-number"); 2],
    label: |_, _| "d₂/d₁",
    name: |lab, _| tr!(lab, relay.ratio).to_owned(),
    read: |s, _| ratio_of(s),
    write: |s, _, ratio| s.test.amplitudes[1] = ratio * s.test.amplitudes[0],
    limits: |_, _| RATIOS,
    travel: Some(|_| RATIOS),
    scale: Scale::Logarithmic,
    ..OF_TEST
};
/// Of relay 1, with the ratio kept; of relay 2 where that one is alone.
const AMPLITUDE: Knob<TuningSetup> = Knob {
    ids: [("", "test-amplitude"), ("", "test-amplitude2")],
    label: |_, k| ["d₁", "d₂"][k],
    name: |lab, k| tr!(lab, relay.amplitude, number = k + 1),
    read: |s, k| s.test.amplitudes[k],
    write: |s, k, d| s.test.amplitudes = if k == 0 { [d, d * ratio_of(s)] } else { [s.test.amplitudes[0], d] },
    limits: |_, _| (0.001, 1e4),
    ..OF_TEST
};
const DURATION: Knob<TuningSetup> = Knob {
    ids: [("", "test-duration"); 2],
    label: |_, _| "t",
    name: |lab, _| tr!(lab, relay.duration).to_owned(),
    read: |s, _| s.test.duration,
    write: |s, _, duration| set_duration(s, duration),
    limits: |_, _| (1.0, 1e5),
    unit: TIME.unit,
    ..OF_TEST
};
const MODULUS: Knob<TuningSetup> = Knob {
    ids: [("", "test-modulus"); 2],
    label: |_, _| "r",
    name: |lab, _| tr!(lab, relay.modulus).to_owned(),
    read: |s, _| if let Behind::Modulus(r) = s.test.behind { r } else { FIRST_MODULUS },
    write: |s, _, r| s.test.behind = Behind::Modulus(r),
    limits: |_, _| SIZES,
    ..OF_TEST
};
const HYSTERESIS: Knob<TuningSetup> = Knob {
    ids: [("", "test-hysteresis1"), ("", "test-hysteresis2")],
    label: |_, k| ["ε₁", "ε₂"][k],
    name: |lab, k| tr!(lab, relay.hysteresis, number = k + 1),
    read: |s, k| s.test.hysteresis[k],
    write: |s, k, hysteresis| s.test.hysteresis[k] = hysteresis,
    limits: |_, _| (0.0, 1e6),
    ..OF_LOOP
};
const BIAS: Knob<TuningSetup> = Knob {
    ids: [("", "test-bias1"), ("", "test-bias2")],
    label: |_, k| ["b₁", "b₂"][k],
    name: |lab, k| tr!(lab, relay.bias, number = k + 1),
    read: |s, k| s.test.bias[k],
    write: |s, k, bias| s.test.bias[k] = bias,
    limits: |_, _| (-1e6, 1e6),
    ..OF_LOOP
};
/// The factors by which independent tests are made weaker.
const DETUNING: Knob<TuningSetup> = Knob {
    ids: [("", "test-detuning1"), ("", "test-detuning2")],
    label: |_, k| ["f₁", "f₂"][k],
    name: |lab, k| tr!(lab, relay.detuning, number = k + 1),
    read: |s, k| s.test.detuning[k],
    write: |s, k, factor| s.test.detuning[k] = factor,
    limits: |_, _| (0.1, 100.0),
    ..OF_LOOP
};
const PASSES: Knob<TuningSetup> = Knob {
    ids: [("", "test-passes"); 2],
    label: |_, _| "n",
    name: |lab, _| tr!(lab, relay.passes).to_owned(),
    read: |s, _| s.test.passes as f64,
    write: |s, _, passes| set_passes(s, passes),
    limits: |_, _| (1.0, 8.0),
    scale: Scale::Linear(1.0),
    digits: Some(0),
    ..OF_TEST
};
const OF_TEST: Knob<TuningSetup> = Knob { scale: Scale::Linear(0.05), lock: Control::Test, ..Knob::PLAIN };
const OF_LOOP: Knob<TuningSetup> = Knob { class: ["loop1", "loop2"], ..OF_TEST };

/// The relay test.
pub fn test_card() -> AnyView {
    let session = use_session();
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    let axis = timeline(session.part(|s| s.test.duration), BEGINNING);
    let picture = pictures::test(session, axis.window);
    let verdict = Signal::derive(move || sentence(session));
    let values = readout(session, axis.cursor, move |show| {
        session.words.test.with(|outcome| {
            if let Some(trace) = outcome.as_ref().as_ref().ok().and_then(record_of) {
                show(trace);
            }
        });
    });
    let ids = ["test-zoom-in", "test-zoom-out", "test-zoom-reset"];
    let label = say!(lab, relay.test_cursor);
    card(Step {
        name: "test",
        number: 1,
        title: say!(lab, relay.test),
        toolbar: view! { <div class="toolbar"><TakeOver /><ZoomButtons axis ids /></div> }.into_any(),
        frames,
        place: "chart",
        overlay: surface("test-surface", axis, frames, label, values),
        settings: settings(session),
        verdict,
        below: vec![
            view! { <DataTable picture=picture.clone() id="test-table" /> }.into_any(),
            details::of_test(session),
        ],
        picture,
    })
}

/// Hands the point that the test found to the placement.
#[component]
fn TakeOver() -> impl IntoView {
    let session = use_session();
    let take = move |_| {
        let found = session.words.test.with_untracked(|outcome| outcome.as_ref().as_ref().ok().and_then(found_point));
        if let Some(point) = found {
            session.edit(|s| s.design.critical = point);
        }
    };
    let nothing = Signal::derive(move || {
        session.words.test.with(|outcome| outcome.as_ref().as_ref().ok().and_then(found_point).is_none())
    });
    let disabled = session.locks(Control::Point);
    view! {
        <button type="button" class="button small" data-testid="test-take" hidden=nothing disabled=disabled on:click=handler(take)>{say!(session.lab, relay.take_over)}</button>
    }
}

/// The critical point by first harmonics, from a simultaneous test.
fn found_point(test: &Tested) -> Option<CriticalSpec> {
    let Tested::Simultaneous(test, _) = test else { return None };
    let oscillation = test.reading.oscillation?;
    Some(CriticalSpec::Point { gains: oscillation.gains_by_harmonic()?, period: oscillation.period })
}

fn settings(session: Session) -> AnyView {
    let lab = session.lab;
    let kinds = vec![
        ("test-single", say!(lab, relay.single)),
        ("test-independent", say!(lab, relay.independent)),
        ("test-sequential", say!(lab, relay.sequential)),
        ("test-simultaneous", say!(lab, relay.simultaneous)),
    ];
    let kind = |s: &TuningSetup| KINDS.iter().position(|&k| k == s.test.kind).unwrap_or(3);
    let table = Signal::derive(move || table(session));
    let detuning = vec![knob(session, &DETUNING, 0), knob(session, &DETUNING, 1)];
    vec![
        segmented(session, say!(lab, relay.kind), kinds, kind, |s, k| s.test.kind = KINDS[k], Control::Test),
        hideable("", session.flag(|s| s.test.kind != TestKind::Single), single(session)),
        hideable("", session.flag(|s| s.test.kind == TestKind::Single), vec![knob(session, &RATIO, 0)]),
        hideable("pairs", Signal::stored(false), sizes(session)),
        hideable("pairs four", Signal::stored(false), relays(session)),
        hideable("", session.flag(|s| !is_tuned(s.test.kind)), vec![rule(session)]),
        hideable("pairs", session.flag(|s| s.test.kind != TestKind::Independent), detuning),
        hideable("pairs", session.flag(|s| s.test.kind != TestKind::Sequential), vec![knob(session, &PASSES, 0)]),
        figures("test-figures", say!(lab, relay.test_caption), table),
    ]
    .into_any()
}

/// Amplitude of relay 1, or of relay 2 where that one is alone, and duration.
fn sizes(session: Session) -> Vec<AnyView> {
    vec![
        hideable("", session.flag(|s| is_idle(s, 1)), vec![knob(session, &AMPLITUDE, 0)]),
        hideable("", session.flag(|s| !is_idle(s, 1)), vec![knob(session, &AMPLITUDE, 1)]),
        knob(session, &DURATION, 0),
    ]
}

/// Whether a loop has no relay because the other one is tested alone.
fn is_idle(setup: &TuningSetup, number: usize) -> bool {
    setup.test.kind == TestKind::Single && setup.test.number != number
}

/// What a test of a single element has besides.
fn single(session: Session) -> Vec<AnyView> {
    let lab = session.lab;
    let loops = vec![
        ("test-loop1", say!(lab, relay.loop_name, number = 1)),
        ("test-loop2", say!(lab, relay.loop_name, number = 2)),
    ];
    let which = |s: &TuningSetup| s.test.number - 1;
    let set_which = |s: &mut TuningSetup, k: usize| s.test.number = k + 1;
    let choose = move |name: String| session.edit(|s| s.test.behind = behind_named(&name));
    vec![
        segmented(session, say!(lab, relay.which_loop), loops, which, set_which, Control::Test),
        choice("test-behind", say!(lab, relay.behind), behind_options(session), choose, Control::Test),
        hideable("", session.flag(|s| behind_index(s) != 2), vec![knob(session, &MODULUS, 0)]),
    ]
}

/// Hysteresis and bias of both relays.
fn relays(session: Session) -> Vec<AnyView> {
    let one = |knob: AnyView, idle: Signal<bool>| hideable("", idle, vec![knob]);
    let idle = [session.flag(|s| is_idle(s, 1)), session.flag(|s| is_idle(s, 2))];
    vec![
        one(knob(session, &HYSTERESIS, 0), idle[0]),
        one(knob(session, &HYSTERESIS, 1), idle[1]),
        one(knob(session, &BIAS, 0), idle[0]),
        one(knob(session, &BIAS, 1), idle[1]),
    ]
}

fn rule(session: Session) -> AnyView {
    let choose = move |name: String| choose_rule(session, &name);
    choice("test-rule", say!(session.lab, relay.rule), rule_options(session), choose, Control::Test)
}

/// Whether the test ends in controller settings.
fn is_tuned(kind: TestKind) -> bool {
    matches!(kind, TestKind::Independent | TestKind::Sequential)
}

fn ratio_of(setup: &TuningSetup) -> f64 {
    setup.test.amplitudes[1] / setup.test.amplitudes[0]
}

/// The record keeps its number of rows.
fn set_duration(setup: &mut TuningSetup, duration: f64) {
    let factor = duration / setup.test.duration;
    setup.test.duration = duration;
    setup.test.step *= factor;
    setup.test.release = setup.test.release.min(duration);
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the field allows 1 to 8")]
fn set_passes(setup: &mut TuningSetup, passes: f64) {
    setup.test.passes = passes.round() as usize;
}

const BEHINDS: [&str; 3] = ["nothing", "integrator", "modulus"];

fn behind_options(session: Session) -> Signal<String> {
    let lab = session.lab;
    Signal::derive(move || {
        let chosen = session.words.setup.with(|s| behind_index(s));
        let texts = [tr!(lab, relay.behind_nothing), tr!(lab, relay.behind_integrator), tr!(lab, relay.behind_modulus)];
        (0..3).map(|k| option(BEHINDS[k], texts[k], chosen == k)).collect()
    })
}

fn behind_index(setup: &TuningSetup) -> usize {
    match setup.test.behind {
        Behind::Nothing => 0,
        Behind::Integrator => 1,
        Behind::Modulus(_) => 2,
    }
}

fn behind_named(name: &str) -> Behind {
    match BEHINDS.iter().position(|&known| known == name) {
        Some(1) => Behind::Integrator,
        Some(2) => Behind::Modulus(FIRST_MODULUS),
        _ => Behind::Nothing,
    }
}

fn rule_options(session: Session) -> Signal<String> {
    Signal::derive(move || {
        let chosen = session.words.setup.with(|s| s.test.rule);
        TuningRule::ALL.iter().map(|&rule| option(short_name(rule), short_name(rule), rule == chosen)).collect()
    })
}

fn choose_rule(session: Session, name: &str) {
    if let Some(rule) = TuningRule::ALL.into_iter().find(|&rule| short_name(rule) == name) {
        session.edit(|s| s.test.rule = rule);
    }
}

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
fn sentence(session: Session) -> (bool, String) {
    let lab = session.lab;
    let style = lab.number_style();
    let unit = session.words.setup.with(|s| time_unit(&s.plant));
    session.words.test.with(|outcome| {
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
            RelayVerdict::Unimodal => (true, tr!(lab, relay.unimodal, period = period, unit = unit).to_string()),
            RelayVerdict::Multimodal { switches: [one, two] } => {
                (false, tr!(lab, relay.multimodal, period = period, unit = unit, one = one, two = two).to_string())
            }
            RelayVerdict::NotPeriodic => (false, tr!(lab, relay.not_periodic).to_owned()),
            RelayVerdict::Chattering { relay } => (false, tr!(lab, relay.chattering, number = relay + 1).to_string()),
            RelayVerdict::NoOscillation => (false, tr!(lab, relay.no_oscillation).to_owned()),
            RelayVerdict::Diverged => (false, tr!(lab, relay.diverged).to_owned()),
            RelayVerdict::Unfinished { time } => {
                (false, tr!(lab, relay.unfinished, time = style.significant(time, 3), unit = unit).to_string())
            }
        };
        let good = good
            && match test {
                Tested::Simultaneous(test, [_, by_harmonic]) => {
                    let proportional = test.reading.oscillation.is_none_or(|o| o.is_proportional());
                    let same = by_harmonic.is_none_or(|distance| distance.same_branch);
                    let limited = test.trace.limited.contains(&true);
                    if limited {
                        text = text + " " + tr!(lab, relay.pump_limit);
                    } else if !same {
                        text = text + " " + tr!(lab, relay.other_branch);
                    } else if !proportional {
                        text = text + " " + tr!(lab, relay.not_proportional);
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

/// Amplitudes and gains of every experiment, and how far they are from the curve.
fn table(session: Session) -> String {
    let lab = session.lab;
    let style = lab.number_style();
    let number = |v: Option<f64>| v.map_or_else(|| "–".to_owned(), |v| style.significant(v, 4));
    session.words.test.with(|outcome| {
        let Ok(test) = outcome.as_ref() else { return String::new() };
        let distances = if let Tested::Simultaneous(_, distances) = test { *distances } else { [None; 2] };
        let unit = session.words.setup.with(|s| time_unit(&s.plant));
        let names = [
            tr!(lab, relay.col_loop).to_owned(),
            tr!(lab, relay.col_period, unit = unit).to_string(),
            "a".to_owned(),
            tr!(lab, relay.col_peak).to_owned(),
            tr!(lab, relay.col_harmonic).to_owned(),
        ];
        let second = session.words.setup.with(|s| s.test.kind == TestKind::Single && s.test.number == 2);
        let (mut rows, mut rules) = (String::new(), String::new());
        for (name, reading, settings) in readings(test) {
            let Some(oscillation) = reading.oscillation else { continue };
            for (k, of) in oscillation.loops.iter().enumerate().filter(|(_, of)| of.gain_by_peak.is_some()) {
                let which = if second { 2 } else { k + 1 };
                let label = if name.is_empty() { which.to_string() } else { name.clone() };
                let is_second = label.ends_with('2');
                let figures = [Some(oscillation.period), Some(of.amplitude), of.gain_by_peak, of.gain_by_harmonic];
                let class = ["loop1", "loop2"][usize::from(is_second)];
                rows += &html::row(class, &label, &figures.map(number));
                if let Some(settings) = settings {
                    let settings = [settings.gain, settings.integral_time, settings.derivative_time];
                    rules += &html::row(class, &label, &settings.map(|v| number(Some(v).filter(|v| v.is_finite()))));
                }
            }
        }
        let percent = |distance: Option<CurveDistance>| {
            distance.map_or_else(|| "–".to_owned(), |d| format!("{}\u{a0}%", style.fixed(100.0 * d.excess, 1)))
        };
        if distances.iter().any(Option::is_some) {
            let name = element("th", "scope=\"row\" colspan=\"3\"", &escape(tr!(lab, relay.distance)));
            rows += &element("tr", "", &(name + &cells(&distances.map(percent))));
        }
        if !rules.is_empty() {
            let heads = [&names[0], "K", "Ti", "Td"].map(|head| element("th", "scope=\"col\"", &escape(head)));
            rows += &(element("tr", "", &heads.concat()) + &rules);
        }
        html::table(tr!(lab, relay.test_caption), &names, &rows)
    })
}
