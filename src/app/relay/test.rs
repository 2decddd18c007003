//! Step 1: the relay test, its record and what it says.

use leptos::prelude::*;

use super::controls::{Knob, knob, segmented};
use super::errors;
use super::pictures::{self, record_of, short_name};
use super::readout::{plain, readout};
use super::session::{Session, time_unit, use_session};
use super::timeline::timeline;
use crate::app::start::Control;
use crate::app::texts::{say, tr};
use crate::app::widgets::html::{cells, element, escape, headings};
use crate::app::widgets::{ChartCanvas, ChartMenu, Choice, DataTable, Scale, TimeSurface, ZoomButtons, option, rich};
use crate::control::IsaPid;
use crate::figure::Frame;
use crate::scenario::tuning::{Behind, TestKind, Tested, TuningSetup};
use crate::tuning::{CurveDistance, RelayReading, RelayVerdict, TestAndSettings, TuningRule};

const KINDS: [TestKind; 4] = [TestKind::Single, TestKind::Independent, TestKind::Sequential, TestKind::Simultaneous];
/// Ratios of the amplitudes that the slider covers.
const RATIOS: (f64, f64) = (0.02, 20.0);
/// Modulus that the estimator of a point begins with.
const FIRST_MODULUS: f64 = 0.2;
const SIZES: (f64, f64) = (1e-6, 1e6);

/// The relay test.
#[component]
pub fn TestCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    let axis = timeline(session.part(|s| s.test.duration));
    let picture = pictures::test(session, axis.window);
    let title = say!(lab, relay.test);
    let verdict = Memo::new(move |_| sentence(session));
    let table = Signal::derive(move || table(session));
    let values = readout(session, axis.cursor, move |show| {
        session.words.test.with(|outcome| {
            if let Some(trace) = outcome.as_ref().as_ref().ok().and_then(record_of) {
                show(trace);
            }
        });
    });
    view! {
        <section class="card test" aria-labelledby="test-title">
            <header>
                <h2 id="test-title">"1 · "{title}</h2>
                <div class="toolbar"><ZoomButtons axis ids=["test-zoom-in", "test-zoom-out", "test-zoom-reset"] /></div>
                <ChartMenu picture=picture.clone() file="relay-test" title />
            </header>
            <div class="step">
                <div class="chart">
                    <ChartCanvas picture=picture.clone() frames summary=Signal::derive(move || verdict.get().1.replace("**", "")) name="test" />
                    <TimeSurface axis frames label=say!(lab, relay.test_cursor) spoken=Signal::derive(move || plain(&values.get())) readout=values id="test-surface" />
                </div>
                <div class="settings">
                    <Settings />
                    <div class="scroll" tabindex="0" role="region" aria-label=say!(lab, relay.test_caption)>
                        <table class="plain" data-testid="test-figures" inner_html=table></table>
                    </div>
                </div>
            </div>
            <div class=move || if verdict.get().0 { "verdict" } else { "verdict warm" }.to_owned() role="status" data-testid="test-verdict">
                <p>{move || rich(&verdict.get().1)}</p>
            </div>
            <DataTable picture id="test-table" />
        </section>
    }
}

#[component]
fn Settings() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let kind = session.part(|s| s.test.kind);
    let unless = move |kinds: &'static [TestKind]| Signal::derive(move || !kinds.contains(&kind.get()));
    let no_modulus = session.part(|s| !matches!(s.test.behind, Behind::Modulus(_)));
    let free = |id, label, name, read, write, limits| Knob {
        id,
        label,
        name,
        read,
        write,
        limits,
        travel: None,
        scale: Scale::Linear(0.05),
        is_time: false,
        class: "",
        lock: Control::Test,
    };
    let kinds = vec![
        ("test-single", say!(lab, relay.single)),
        ("test-independent", say!(lab, relay.independent)),
        ("test-sequential", say!(lab, relay.sequential)),
        ("test-simultaneous", say!(lab, relay.simultaneous)),
    ];
    view! {
        {segmented(session, say!(lab, relay.kind), kinds, |s| KINDS.iter().position(|&k| k == s.test.kind).unwrap_or(3), |s, k| s.test.kind = KINDS[k], Control::Test)}
        <div hidden=unless(&[TestKind::Single])>
            {segmented(session, say!(lab, relay.which_loop), vec![("test-loop1", say!(lab, relay.loop_name, number = 1)), ("test-loop2", say!(lab, relay.loop_name, number = 2))], |s| s.test.number - 1, |s, k| s.test.number = k + 1, Control::Test)}
            <Choice id="test-behind" name=say!(lab, relay.behind) options=behind_options(session) on_choose=move |name: String| session.edit(|s| s.test.behind = behind_named(&name)) disabled=lab.locks(Control::Test) />
            <div hidden=move || no_modulus.get()>
                {knob(session, &free(("test-modulus", ""), "r", say!(lab, relay.modulus), |s| if let Behind::Modulus(r) = s.test.behind { r } else { FIRST_MODULUS }, |s, v| s.test.behind = Behind::Modulus(v), SIZES))}
            </div>
        </div>
        {knob(session, &Knob { id: ("ratio", "ratio-number"), label: "d₂/d₁", travel: Some(RATIOS), scale: Scale::Logarithmic, ..free(("", ""), "", say!(lab, relay.ratio), |s| s.test.amplitudes[1] / s.test.amplitudes[0], |s, v| s.test.amplitudes[1] = v * s.test.amplitudes[0], RATIOS) })}
        <div class="pairs">
            {knob(session, &free(("test-amplitude", ""), "d₁", say!(lab, relay.amplitude), |s| s.test.amplitudes[0], set_amplitude, (0.001, 1e4)))}
            {knob(session, &Knob { is_time: true, ..free(("test-duration", ""), "t", say!(lab, relay.duration), |s| s.test.duration, set_duration, (1.0, 1e5)) })}
        </div>
        <div class="pairs" hidden=unless(&[TestKind::Single, TestKind::Simultaneous])>
            {knob(session, &Knob { class: "loop1", ..free(("test-hysteresis1", ""), "ε₁", say!(lab, relay.hysteresis, number = 1), |s| s.test.hysteresis[0], |s, v| s.test.hysteresis[0] = v, (0.0, 1e6)) })}
            {knob(session, &Knob { class: "loop2", ..free(("test-hysteresis2", ""), "ε₂", say!(lab, relay.hysteresis, number = 2), |s| s.test.hysteresis[1], |s, v| s.test.hysteresis[1] = v, (0.0, 1e6)) })}
            {knob(session, &Knob { class: "loop1", ..free(("test-bias1", ""), "b₁", say!(lab, relay.bias, number = 1), |s| s.test.bias[0], |s, v| s.test.bias[0] = v, (-1e6, 1e6)) })}
            {knob(session, &Knob { class: "loop2", ..free(("test-bias2", ""), "b₂", say!(lab, relay.bias, number = 2), |s| s.test.bias[1], |s, v| s.test.bias[1] = v, (-1e6, 1e6)) })}
        </div>
        <div hidden=unless(&[TestKind::Independent, TestKind::Sequential])>
            <Choice id="test-rule" name=say!(lab, relay.rule) options=rule_options(session) on_choose=move |name: String| choose_rule(session, &name) disabled=lab.locks(Control::Test) />
        </div>
        <div class="pairs" hidden=unless(&[TestKind::Independent])>
            {knob(session, &Knob { class: "loop1", ..free(("test-detuning1", ""), "f₁", say!(lab, relay.detuning, number = 1), |s| s.test.detuning[0], |s, v| s.test.detuning[0] = v, (0.1, 100.0)) })}
            {knob(session, &Knob { class: "loop2", ..free(("test-detuning2", ""), "f₂", say!(lab, relay.detuning, number = 2), |s| s.test.detuning[1], |s, v| s.test.detuning[1] = v, (0.1, 100.0)) })}
        </div>
        <div class="pairs" hidden=unless(&[TestKind::Sequential])>
            {knob(session, &Knob { scale: Scale::Linear(1.0), ..free(("test-passes", ""), "n", say!(lab, relay.passes), |s| s.test.passes as f64, set_passes, (1.0, 8.0)) })}
        </div>
    }
}

/// Both amplitudes, so that the ratio stays.
fn set_amplitude(setup: &mut TuningSetup, d1: f64) {
    let ratio = setup.test.amplitudes[1] / setup.test.amplitudes[0];
    setup.test.amplitudes = [d1, d1 * ratio];
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
    let chosen = session.part(|s| match s.test.behind {
        Behind::Nothing => 0,
        Behind::Integrator => 1,
        Behind::Modulus(_) => 2,
    });
    Signal::derive(move || {
        let texts = [tr!(lab, relay.behind_nothing), tr!(lab, relay.behind_integrator), tr!(lab, relay.behind_modulus)];
        (0..3).map(|k| option(BEHINDS[k], texts[k], chosen.get() == k)).collect()
    })
}

fn behind_named(name: &str) -> Behind {
    match BEHINDS.iter().position(|&known| known == name) {
        Some(1) => Behind::Integrator,
        Some(2) => Behind::Modulus(FIRST_MODULUS),
        _ => Behind::Nothing,
    }
}

fn rule_options(session: Session) -> Signal<String> {
    let chosen = session.part(|s| s.test.rule);
    Signal::derive(move || {
        TuningRule::ALL.iter().map(|&rule| option(short_name(rule), short_name(rule), rule == chosen.get())).collect()
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
        let Some((_, reading, _)) = all.iter().find(|(_, reading, _)| reading.oscillation.is_none()).or(all.last())
        else {
            return (false, String::new());
        };
        let period = reading.oscillation.map_or_else(String::new, |o| style.significant(o.period, 4));
        let (good, mut text) = match reading.verdict {
            RelayVerdict::Unimodal => (true, tr!(lab, relay.unimodal, period = period, unit = unit).to_string()),
            RelayVerdict::Multimodal { switches: [one, two] } => {
                (false, tr!(lab, relay.multimodal, period = period, unit = unit, one = one, two = two).to_string())
            }
            RelayVerdict::NotPeriodic => (false, tr!(lab, relay.not_periodic).to_owned()),
            RelayVerdict::Chattering { relay } => (false, tr!(lab, relay.chattering, number = relay + 1).to_string()),
            RelayVerdict::NoOscillation => (false, tr!(lab, relay.no_oscillation).to_owned()),
            RelayVerdict::Diverged => (false, tr!(lab, relay.diverged).to_owned()),
        };
        let good = good
            && match test {
                Tested::Simultaneous(test, [_, by_harmonic]) => {
                    let proportional = test.reading.oscillation.is_none_or(|o| o.is_proportional());
                    let same = by_harmonic.is_none_or(|distance| distance.same_branch);
                    if !same {
                        text = text + " " + tr!(lab, relay.other_branch);
                    } else if !proportional {
                        text = text + " " + tr!(lab, relay.not_proportional);
                    }
                    same && proportional
                }
                Tested::Single(_, Some(found)) => {
                    let (modulus, exact) = (style.significant(found.modulus, 3), found.response);
                    let (norm, degrees) = (exact.norm(), exact.arg().to_degrees());
                    let (norm, degrees) = (style.significant(norm, 3), style.fixed(degrees, 0));
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
        let has_settings = matches!(test, Tested::Independent(_) | Tested::Sequential(_));
        let mut names = vec![
            tr!(lab, relay.col_loop).to_owned(),
            tr!(lab, relay.col_period).to_owned(),
            "a".to_owned(),
            tr!(lab, relay.col_peak).to_owned(),
            tr!(lab, relay.col_harmonic).to_owned(),
        ];
        if has_settings {
            names.extend(["K", "Ti", "Td"].map(str::to_owned));
        }
        let second = session.words.setup.with(|s| s.test.kind == TestKind::Single && s.test.number == 2);
        let mut rows = String::new();
        for (name, reading, settings) in readings(test) {
            let Some(oscillation) = reading.oscillation else { continue };
            for (k, of) in oscillation.loops.iter().enumerate().filter(|(_, of)| of.gain_by_peak.is_some()) {
                let label = if name.is_empty() { (k + 1).to_string() } else { name.clone() };
                let class = ["class=\"loop1\" scope=\"row\"", "class=\"loop2\" scope=\"row\""];
                let is_second = label.ends_with('2') || second;
                let figures = [Some(oscillation.period), Some(of.amplitude), of.gain_by_peak, of.gain_by_harmonic];
                let mut row =
                    element("th", class[usize::from(is_second)], &escape(&label)) + &cells(figures.map(number));
                if has_settings {
                    let finite = |v: f64| Some(v).filter(|v| v.is_finite());
                    let settings = settings
                        .map_or([None; 3], |s| [finite(s.gain), finite(s.integral_time), finite(s.derivative_time)]);
                    row += &cells(settings.map(number));
                }
                rows += &element("tr", "", &row);
            }
        }
        let percent = |distance: Option<CurveDistance>| {
            distance.map_or_else(|| "–".to_owned(), |d| format!("{}\u{a0}%", style.fixed(100.0 * d.excess, 1)))
        };
        if distances.iter().any(Option::is_some) {
            let name = element("th", "scope=\"row\" colspan=\"3\"", &escape(tr!(lab, relay.distance)));
            rows += &element("tr", "", &(name + &cells(distances.map(percent))));
        }
        let caption = element("caption", "class=\"visually-hidden\"", &escape(tr!(lab, relay.test_caption)));
        caption + &element("thead", "", &headings(names)) + &element("tbody", "", &rows)
    })
}
