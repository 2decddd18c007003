//! The card with the drawing of the rig, the valves, and one sentence about where the zero is.

use leptos::prelude::*;

use super::flags::{locks, panels};
use super::mends;
use super::moment::use_moment;
use super::operating_point::OperatingPointFold;
use super::preset::PresetSelect;
use super::replay::play_cursor;
use super::rig::Rig;
use super::sentences;
use super::session::{turn_valves, use_session};
use crate::controls::{ParamControl, ParamRow};
use crate::mends::MendButton;
use crate::texts::{say, terms, tr};
use crate::widgets::{Card, Text, TimeBar, Verdict, marked};
use quadtank::study::quadruple_tank::Setup;

const GAMMA: ParamControl<Setup> = ParamControl {
    ids: [("gamma1", "gamma1-number"), ("gamma2", "gamma2-number")],
    label: |_, k| ["γ₁", "γ₂"][k].to_owned(),
    name: |lab, k| tr!(lab, process.gamma, pump = k + 1),
    path: |_, _| "valves[]",
    read: |s, k| s.valves[k],
    write: |s, k, gamma| s.valves[k] = gamma,
    travel: Some(|_| (0.0, 1.0)),
    digits: Some(2),
    class: ["loop1-row", "loop2-row"],
    ..ParamControl::locked_by(locks::VALVES)
};

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[terms::gamma, terms::minimum_phase, terms::zero, terms::right_half_plane];

/// The drawing of the rig, the valve sliders and the sentence under them.
#[component]
pub fn ProcessCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let moment = use_moment();
    let remark = move || match moment.get().and_then(|m| m.time_s) {
        Some(time) => tr!(lab, process.at_time, time = lab.number_style().fixed(time, 0)),
        None if lab.locks(locks::VALVES) => tr!(lab, process.at_rest),
        None => tr!(lab, process.drag_valves),
    };
    view! {
        <Card name="process" panel=panels::PROCESS title=say!(lab, process.title) terms=TERMS beside=|| view! { <PresetSelect /> }>
            <p class="remark moment">{remark}</p>
            <Rig />
            <TimeBar playback=play_cursor(session) id="play" lab />
            <Settings />
        </Card>
    }
}

/// Valves and operating point without the drawing, beside a drawing of another size.
#[component]
pub fn SettingsCard() -> impl IntoView {
    let session = use_session();
    view! {
        <Card name="process" panel=panels::PROCESS title=say!(session.lab, process.title) beside=|| view! { <PresetSelect /> }>
            <Settings />
        </Card>
    }
}

/// Valve sliders, the sentence under them, and the operating point.
#[component]
fn Settings() -> impl IntoView {
    let session = use_session();
    let turn = |valve: usize| {
        Callback::new(move |gamma: f64| {
            let mut valves = session.document.with_untracked(|document| document.setup.valves);
            valves[valve] = gamma.clamp(0.0, 1.0);
            turn_valves(session, valves);
        })
    };
    view! {
        <div>
            <ParamRow session control=&GAMMA index=0 act=turn(0) />
            <ParamRow session control=&GAMMA index=1 act=turn(1) />
        </div>
        <Situation />
        <OperatingPointFold />
    }
}

/// Where the zero is, how the valves divide flows where that depends on the flow, and what the rig does not allow.
#[component]
fn Situation() -> impl IntoView {
    let session = use_session();
    let sentence = Memo::new(move |_| sentences::of_zero(session));
    let paragraphs = move || {
        let all = std::iter::once(sentence.get().0)
            .chain(sentences::of_flow_fractions(session))
            .chain(sentences::of_equilibrium(session));
        all.map(|text| view! { <p>{marked(&text)}</p> }).collect_view()
    };
    view! {
        <Verdict id="process-sentence" warm=Signal::derive(move || sentence.get().1)>{paragraphs}</Verdict>
        <MendButton session id="mend-rest" offer=mends::of_rest />
    }
}
