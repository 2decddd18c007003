//! Step 1: the relay test, its record and what it says.

use leptos::prelude::*;

use super::details::TestDetails;
use super::flags::{locks, panels};
use super::given::within_limits;
use super::guide::{self, SwitchOn};
use super::mends;
use super::pictures::{self, record_of, short_name};
use super::readout::{Surface, readout};
use super::session::{time_unit, use_session};
use super::step::Step;
use super::test_report::{sentence, table};
use super::timeline::{BEGINNING, timeline};
use crate::controls::{ParamControl, ParamRow, Switch};
use crate::session::Lock;
use crate::shown::ShownUnit;
use crate::texts::{say, terms, tr};
use crate::widgets::{Choice, DataTable, Figures, Scale, Select, Text, TimeBar, ZoomButtons};
use quadtank::control::Pairing;
use quadtank::study::relay_tuning::{CriticalSpec, GivenPid, SeriesElement, TestKind, Tested, TuningSetup};
use quadtank::tuning::TuningRule;
use quadtank_figure::Frame;
use quadtank_scenario::Limits;

/// Ratios of the amplitudes that the slider covers.
const RATIOS: (f64, f64) = (0.02, 20.0);
/// Modulus that the estimator of a point begins with.
const FIRST_MODULUS: f64 = 0.2;

const RATIO: ParamControl<TuningSetup> = ParamControl {
    ids: [("ratio", "ratio-number"); 2],
    label: |_, _| "d₂/d₁".to_owned(),
    name: |lab, _| tr!(lab, relay.ratio),
    read: |s, _| ratio_of(s),
    write: |s, _, ratio| s.test.amplitudes[1] = ratio * s.test.amplitudes[0],
    // The second amplitude is a number of the document.
    within: |s, _| {
        let Limits { min, max } = AMPLITUDE.limits(s, 1);
        Limits::new(min / s.test.amplitudes[0], max / s.test.amplitudes[0])
    },
    travel: Some(|_| RATIOS),
    scale: Some(Scale::Logarithmic),
    ..OF_TEST
};
/// Of relay 1, with the ratio kept; of relay 2 where that one is alone.
const AMPLITUDE: ParamControl<TuningSetup> = ParamControl {
    ids: [("", "test-amplitude"), ("", "test-amplitude2")],
    label: |_, k| ["d₁", "d₂"][k].to_owned(),
    name: |lab, k| tr!(lab, relay.amplitude, number = k + 1),
    read: |s, k| s.test.amplitudes[k],
    write: |s, k, d| s.test.amplitudes = if k == 0 { [d, d * ratio_of(s)] } else { [s.test.amplitudes[0], d] },
    path: |_, _| "test.amplitudes[]",
    ..OF_TEST
};
const DURATION: ParamControl<TuningSetup> = ParamControl {
    ids: [("", "test-duration"); 2],
    label: |_, _| "t".to_owned(),
    name: |lab, _| tr!(lab, relay.duration),
    read: |s, _| s.test.duration,
    write: |s, _, duration| set_duration(s, duration),
    path: |_, _| "test.duration",
    shown_unit: Some(|s| ShownUnit::called(time_unit(&s.plant))),
    ..OF_TEST
};
const MODULUS: ParamControl<TuningSetup> = ParamControl {
    ids: [("", "test-modulus"); 2],
    label: |_, _| "r".to_owned(),
    name: |lab, _| tr!(lab, relay.modulus),
    read: |s, _| if let SeriesElement::Modulus(r) = s.test.behind { r } else { FIRST_MODULUS },
    write: |s, _, r| s.test.behind = SeriesElement::Modulus(r),
    path: |_, _| "test.behind.modulus",
    ..OF_TEST
};
const HYSTERESIS: ParamControl<TuningSetup> = ParamControl {
    ids: [("", "test-hysteresis1"), ("", "test-hysteresis2")],
    label: |_, k| ["ε₁", "ε₂"][k].to_owned(),
    name: |lab, k| tr!(lab, relay.hysteresis, number = k + 1),
    read: |s, k| s.test.hysteresis[k],
    write: |s, k, hysteresis| s.test.hysteresis[k] = hysteresis,
    path: |_, _| "test.hysteresis[]",
    ..OF_LOOP
};
const BIAS: ParamControl<TuningSetup> = ParamControl {
    ids: [("", "test-bias1"), ("", "test-bias2")],
    label: |_, k| ["b₁", "b₂"][k].to_owned(),
    name: |lab, k| tr!(lab, relay.bias, number = k + 1),
    read: |s, k| s.test.bias[k],
    write: |s, k, bias| s.test.bias[k] = bias,
    path: |_, _| "test.bias[]",
    ..OF_LOOP
};
/// The factors by which independent tests are made weaker.
const DETUNING: ParamControl<TuningSetup> = ParamControl {
    ids: [("", "test-detuning1"), ("", "test-detuning2")],
    label: |_, k| ["f₁", "f₂"][k].to_owned(),
    name: |lab, k| tr!(lab, relay.detuning, number = k + 1),
    read: |s, k| s.test.detuning[k],
    write: |s, k, factor| s.test.detuning[k] = factor,
    path: |_, _| "test.detuning[]",
    ..OF_LOOP
};
const PASSES: ParamControl<TuningSetup> = ParamControl {
    ids: [("", "test-passes"); 2],
    label: |_, _| "n".to_owned(),
    name: |lab, _| tr!(lab, relay.passes),
    read: |s, _| s.test.passes as f64,
    write: |s, _, passes| set_passes(s, passes),
    path: |_, _| "test.passes",
    scale: Some(Scale::Linear(1.0)),
    digits: Some(0),
    ..OF_TEST
};
const OF_TEST: ParamControl<TuningSetup> = ParamControl {
    scale: Some(Scale::Linear(0.05)),
    shown_unit: Some(|_| ShownUnit::called("")),
    ..ParamControl::locked_by(locks::TEST)
};
const OF_LOOP: ParamControl<TuningSetup> = ParamControl { class: ["loop1", "loop2"], ..OF_TEST };

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[terms::relay, terms::ultimate, terms::describing, terms::hysteresis];

/// The relay test.
#[component]
pub fn TestCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    let axis = timeline(session.part(|s| s.test.duration), BEGINNING);
    let playback = guide::playback(session);
    let picture = pictures::test(session, axis.window, guide::drawn_until(session));
    let for_table = picture.clone();
    let values = readout(session, axis.cursor, move |show| {
        session.throttled.test.with(|outcome| {
            if let Some(trace) = outcome.as_ref().as_ref().ok().and_then(record_of) {
                show(trace);
            }
        });
    });
    let ids = ["test-zoom-in", "test-zoom-out", "test-zoom-reset"];
    let label = say!(lab, relay.test_cursor);
    let below = move || {
        view! {
            <TimeBar playback id="test-play" lab />
            <DataTable picture=for_table id="test-table" />
            <TestDetails />
        }
    };
    let is_off = guide::is_closed(session, 1);
    let verdict = move || if is_off.get() { (true, tr!(lab, guide.off)) } else { sentence(session) };
    view! {
        <Step
            name="test"
            panel=panels::TEST
            number=1
            terms=TERMS
            title=say!(lab, relay.test)
            toolbar=move || view! { <div class="toolbar"><TakeOver /><ZoomButtons axis ids /></div> }
            picture
            frames
            overlay=move || view! { <Surface id="test-surface" axis frames label readout=values /> <SwitchOn playback /> }
            verdict=Signal::derive(verdict)
            offers=Signal::derive(move || mends::of_test(session))
            below
        >
            <Settings />
        </Step>
    }
}

/// Result of a relay test that later steps can use.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Finding {
    /// A critical point, for the placement.
    Point(CriticalSpec),
    /// Settings of both loops, as given controllers.
    Controllers([GivenPid; 2]),
}

impl Finding {
    /// The critical point by first harmonics of a simultaneous test, or the settings that an independent or a sequential one ends in.
    fn of(test: &Tested) -> Option<Self> {
        if let Some(settings) = test.settings() {
            return Some(Self::Controllers(settings.map(|pid| within_limits(pid.into()))));
        }
        let Tested::Simultaneous(test, _) = test else { return None };
        let oscillation = test.reading.oscillation?;
        Some(Self::Point(CriticalSpec::Point { gains: oscillation.gains_by_harmonic()?, period: oscillation.period }))
    }

    fn lock(self) -> Lock {
        match self {
            Self::Point(_) => locks::POINT,
            Self::Controllers(_) => locks::TARGET,
        }
    }

    fn apply(self, setup: &mut TuningSetup) {
        match self {
            Self::Point(point) => setup.design.critical = point,
            Self::Controllers(both) => {
                (setup.design.controllers, setup.design.pairing) = (Some(both), Pairing::Diagonal);
            }
        }
    }
}

/// Passes the result of the test to placement or to the given controllers.
#[component]
fn TakeOver() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let found =
        Memo::new(move |_| session.throttled.test.with(|outcome| outcome.as_ref().as_ref().ok().and_then(Finding::of)));
    let take = move |_| {
        if let Some(found) = found.get_untracked() {
            session.edit(|s| found.apply(s));
        }
    };
    let text = move || match found.get() {
        Some(Finding::Controllers(_)) => tr!(lab, relay.take_settings),
        Some(Finding::Point(_)) | None => tr!(lab, relay.take_over),
    };
    view! {
        <button
            type="button"
            class="button small"
            data-testid="test-take"
            hidden=move || found.get().is_none()
            disabled=move || found.get().is_some_and(|found| lab.locks(found.lock()))
            on:click=take
        >
            {text}
        </button>
    }
}

#[component]
fn Settings() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let kinds = vec![
        (TestKind::Single, "test-single", say!(lab, relay.single)),
        (TestKind::Independent, "test-independent", say!(lab, relay.independent)),
        (TestKind::Sequential, "test-sequential", say!(lab, relay.sequential)),
        (TestKind::Simultaneous, "test-simultaneous", say!(lab, relay.simultaneous)),
    ];
    view! {
        <Switch
            session
            label=say!(lab, relay.kind)
            choices=kinds
            read=|s| s.test.kind
            write=|s, kind| s.test.kind = kind
            lock=locks::TEST
        />
        <div hidden=session.throttled_part(|s| s.test.kind != TestKind::Single)><SingleTest /></div>
        <div hidden=session.throttled_part(|s| s.test.kind == TestKind::Single)><ParamRow session control=&RATIO /></div>
        // Amplitude of relay 1, or of relay 2 where that one is alone, and duration.
        <div class="pairs">
            <div hidden=session.throttled_part(|s| is_idle(s, 1))><ParamRow session control=&AMPLITUDE index=0 /></div>
            <div hidden=session.throttled_part(|s| !is_idle(s, 1))><ParamRow session control=&AMPLITUDE index=1 /></div>
            <ParamRow session control=&DURATION />
        </div>
        <div class="pairs four">
            <div hidden=session.throttled_part(|s| is_idle(s, 1))><ParamRow session control=&HYSTERESIS index=0 /></div>
            <div hidden=session.throttled_part(|s| is_idle(s, 2))><ParamRow session control=&HYSTERESIS index=1 /></div>
            <div hidden=session.throttled_part(|s| is_idle(s, 1))><ParamRow session control=&BIAS index=0 /></div>
            <div hidden=session.throttled_part(|s| is_idle(s, 2))><ParamRow session control=&BIAS index=1 /></div>
        </div>
        <div hidden=session.throttled_part(|s| !is_tuned(s.test.kind))><RuleSelect /></div>
        <div class="pairs" hidden=session.throttled_part(|s| s.test.kind != TestKind::Independent)>
            <ParamRow session control=&DETUNING index=0 />
            <ParamRow session control=&DETUNING index=1 />
        </div>
        <div class="pairs" hidden=session.throttled_part(|s| s.test.kind != TestKind::Sequential)>
            <ParamRow session control=&PASSES />
        </div>
        <Figures name="test-figures" caption=say!(lab, relay.test_caption)>{move || table(session)}</Figures>
    }
}

/// Whether a loop has no relay because the other one is tested alone.
fn is_idle(setup: &TuningSetup, number: usize) -> bool {
    setup.test.kind == TestKind::Single && setup.test.number != number
}

/// What a test of a single element has besides.
#[component]
fn SingleTest() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let loops = vec![
        (1, "test-loop1", say!(lab, relay.loop_name, number = 1)),
        (2, "test-loop2", say!(lab, relay.loop_name, number = 2)),
    ];
    let behinds = Signal::derive(move || {
        vec![
            Choice::new(SeriesElement::Nothing, "nothing", tr!(lab, relay.behind_nothing)),
            Choice::new(SeriesElement::Integrator, "integrator", tr!(lab, relay.behind_integrator)),
            Choice::new(SeriesElement::Modulus(FIRST_MODULUS), "modulus", tr!(lab, relay.behind_modulus)),
        ]
    });
    // The modulus has a field of its own.
    let behind = Signal::derive(move || match session.throttled.setup.with(|s| s.test.behind) {
        SeriesElement::Modulus(_) => SeriesElement::Modulus(FIRST_MODULUS),
        other => other,
    });
    view! {
        <Switch
            session
            label=say!(lab, relay.which_loop)
            choices=loops
            read=|s| s.test.number
            write=|s, number| s.test.number = number
            lock=locks::TEST
        />
        <Select
            id="test-behind"
            name=say!(lab, relay.behind)
            choices=behinds
            chosen=behind
            on_choose=move |behind| session.edit(|s| s.test.behind = behind)
            disabled=lab.locks(locks::TEST)
        />
        <div hidden=session.throttled_part(|s| !matches!(s.test.behind, SeriesElement::Modulus(_)))>
            <ParamRow session control=&MODULUS />
        </div>
    }
}

/// The rule by which a test ends in controller settings.
#[component]
fn RuleSelect() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let choices = TuningRule::ALL.map(|rule| Choice::new(rule, short_name(rule), short_name(rule))).to_vec();
    view! {
        <Select
            id="test-rule"
            name=say!(lab, relay.rule)
            choices=Signal::stored(choices)
            chosen=Signal::derive(move || session.throttled.setup.with(|s| s.test.rule))
            on_choose=move |rule| session.edit(|s| s.test.rule = rule)
            disabled=lab.locks(locks::TEST)
        />
    }
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
