//! The card with the drawing of the rig, the valves, and one sentence about where the zero is.

use leptos::prelude::*;

use super::flags::{locks, panels};
use super::mends::{self, MendButton};
use super::moment::use_moment;
use super::preset::{PresetRemark, PresetSelect};
use super::published::PublishedFigures;
use super::replay::play_cursor;
use super::rig::Rig;
use super::rig_numbers::RigNumbers;
use super::sentences;
use super::session::{turn_valves, use_session};
use super::valves::HoldSwitch;
use crate::controls::{ParamControl, ParamRow};
use crate::depth::Depth;
use crate::texts::{say, terms, tr};
use crate::widgets::{Card, NumberField, Scale, Text, TimeBar, Verdict, is_open, marked};
use quadtank::study::quadruple_tank::{OperatingPointSpec, Setup};

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
const VOLTAGE_IDS: [&str; 2] = ["voltage1", "voltage2"];

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
        <OperatingPoint />
    }
}

/// Where the zero is, and what the rig does not allow.
#[component]
fn Situation() -> impl IntoView {
    let session = use_session();
    let sentence = Memo::new(move |_| sentences::of_zero(session));
    let paragraphs = move || {
        let all = std::iter::once(sentence.get().0).chain(sentences::of_equilibrium(session));
        all.map(|text| view! { <p>{marked(&text)}</p> }).collect_view()
    };
    view! {
        <Verdict id="process-sentence" warm=Signal::derive(move || sentence.get().1)>{paragraphs}</Verdict>
        <MendButton id="mend-rest" offer=mends::of_rest />
    }
}

/// The operating point and what was printed of it, folded.
#[component]
fn OperatingPoint() -> impl IntoView {
    let lab = use_session().lab;
    // Explore has the switch on its map.
    let has_switch = move || !lab.locks(locks::VALVES) && lab.shown_depth() != Depth::Explore;
    let open = RwSignal::new(false);
    view! {
        <details class="more" data-testid="operating-point-fold" on:toggle=move |event| open.set(is_open(&event))>
            <summary>{say!(lab, process.operating_point)}</summary>
            <PresetRemark />
            <div class="fields">
                <VoltageField pump=0 />
                <VoltageField pump=1 />
            </div>
            {move || has_switch().then(|| view! { <HoldSwitch /> })}
            {move || open.get().then(|| view! { <PublishedFigures /> })}
            <RigNumbers />
        </details>
    }
}

/// The voltage of a pump at rest. Editing it makes the voltages, not the levels, what the operating point is given by.
#[component]
fn VoltageField(pump: usize) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let computed =
        move || session.throttled.analysis.with(|a| a.as_ref().as_ref().ok().map(|a| a.operating_point.pump_voltage));
    let voltages = move || match session.document.with(|s| s.setup.operating_point) {
        OperatingPointSpec::PumpVoltage(given) => Some(given),
        OperatingPointSpec::Levels(_) => computed(),
    };
    let on_change = move |v: f64| {
        let mut both = untrack(voltages).unwrap_or_default();
        both[pump] = v;
        session.edit(|s| s.operating_point = OperatingPointSpec::PumpVoltage(both));
    };
    let range = session.part(move |s: &Setup| {
        let pump = s.plant().pumps[pump];
        (pump.voltage_min, pump.voltage_max)
    });
    view! {
        <div class="field-row">
            <span>{["v₁", "v₂"][pump]}</span>
            <NumberField
                id=VOLTAGE_IDS[pump]
                name=say!(lab, process.voltage, pump = pump + 1)
                value=Signal::derive(move || voltages().map_or(0.0, |v| v[pump]))
                on_change
                limits=range
                scale=Scale::Linear(0.05)
                digits=Some(2)
                disabled=lab.locks(locks::VOLTAGES)
            />
            <span class="unit">"V"</span>
        </div>
    }
}
