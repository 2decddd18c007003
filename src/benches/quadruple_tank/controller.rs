//! The decentralised PI controller.

use leptos::prelude::*;

use super::flags::{locks, panels};
use super::mends;
use super::sentences;
use super::session::{Session, use_session};
use crate::benches::handover::{self, HandOver};
use crate::controls::{ParamControl, ParamNumber, ParamRow};
use crate::mends::MendButton;
use crate::texts::{say, terms, tr};
use crate::widgets::{Card, Scale, Segmented, Sentence, Text, Tick};
use quadtank::control::{AntiWindup, LoopMode, Pairing, PiSettings};
use quadtank::study::quadruple_tank::{Setup, detuned};
use quadtank_scenario::{Limits, limits};

/// Tt/Ti when anti-windup is switched on (Cocota 2009, ch. 4).
const TRACKING_RATIO: f64 = 0.5;
/// When a loop that is put into manual goes back to automatic, unless the student says otherwise (s).
const MANUAL_UNTIL_S: f64 = 500.0;

const SIGN_IDS: [&str; 2] = ["sign1", "sign2"];
const OPEN_IDS: [&str; 2] = ["open1", "open2"];
const MANUAL_IDS: [&str; 2] = ["manual1", "manual2"];

const GAIN: ParamControl<Setup> = ParamControl {
    ids: [("gain1", "gain1-number"), ("gain2", "gain2-number")],
    label: |_, k| ["K₁", "K₂"][k].to_owned(),
    name: |lab, k| tr!(lab, pi.gain, level = k + 1),
    read: |s, k| s.controller.loops[k].gain,
    write: |s, k, gain| s.controller.loops[k].gain = gain,
    path: |_, _| "controller.loops[].gain",
    smallest: limits::GAIN_MAGNITUDE.min,
    travel: Some(|_| (0.05, 50.0)),
    ..OF_LOOP
};
const INTEGRAL_TIME: ParamControl<Setup> = ParamControl {
    ids: [("integral1", "integral1-number"), ("integral2", "integral2-number")],
    label: |_, k| ["Ti₁", "Ti₂"][k].to_owned(),
    name: |lab, k| tr!(lab, pi.integral, level = k + 1),
    read: |s, k| s.controller.loops[k].integral_time_s,
    write: |s, k, time_s| s.controller.loops[k].integral_time_s = time_s,
    path: |_, _| "controller.loops[].integral_time_s",
    travel: Some(|_| (3.0, 3000.0)),
    ..OF_LOOP
};
const OF_LOOP: ParamControl<Setup> =
    ParamControl { class: ["loop1-row", "loop2-row"], ..ParamControl::locked_by(locks::GAINS) };

const WEIGHT: ParamControl<Setup> = ParamControl {
    ids: [("weight", "weight-number"); 2],
    label: |lab, _| tr!(lab, pi.weight_label),
    name: |lab, _| tr!(lab, pi.weight),
    read: |s, _| s.controller.loops[0].set_point_weight,
    write: |s, _, weight| both(s, |l| l.set_point_weight = weight),
    path: |_, _| "controller.loops[].set_point_weight",
    travel: Some(|_| (limits::SET_POINT_WEIGHT.min, limits::SET_POINT_WEIGHT.max)),
    scale: Some(Scale::Linear(0.05)),
    digits: Some(2),
    ..FINE
};
/// The slider begins at this sampling time (s); what no rig needs can be typed.
const LEAST_SAMPLING_OF_SLIDER_S: f64 = 0.05;
const SAMPLING: ParamControl<Setup> = ParamControl {
    ids: [("sampling", "sampling-number"); 2],
    label: |lab, _| tr!(lab, pi.sampling_label),
    name: |lab, _| tr!(lab, pi.sampling),
    read: |s, _| s.controller.sampling_time_s,
    write: |s, _, time_s| s.controller.sampling_time_s = time_s,
    path: |_, _| "controller.sampling_time_s",
    within: |s, _| limits::sampling_time_s(s.experiment.duration_s),
    travel: Some(|s| {
        let limits = limits::sampling_time_s(s.experiment.duration_s);
        (limits.min.max(LEAST_SAMPLING_OF_SLIDER_S), limits.max)
    }),
    ..FINE
};
const TRACKING: ParamControl<Setup> = ParamControl {
    ids: [("tracking", "tracking-number"); 2],
    label: |lab, _| tr!(lab, pi.tracking_label),
    name: |lab, _| tr!(lab, pi.tracking),
    read: |s, _| match s.controller.loops[0].anti_windup {
        AntiWindup::BackCalculation { tracking_ratio } => tracking_ratio,
        AntiWindup::Off => TRACKING_RATIO,
    },
    write: |s, _, tracking_ratio| both(s, |l| l.anti_windup = AntiWindup::BackCalculation { tracking_ratio }),
    path: |_, _| "controller.loops[].anti_windup.back_calculation.tracking_ratio",
    travel: Some(|_| (0.02, 20.0)),
    matters: Some(is_guarded),
    ..FINE
};
const MANUAL_UNTIL: ParamControl<Setup> = ParamControl {
    ids: [("", "manual1-until"), ("", "manual2-until")],
    name: |lab, k| tr!(lab, pi.manual_until, level = k + 1),
    read: |s, k| manual(s, k).1,
    write: |s, k, until_s| s.controller.loops[k].mode = LoopMode::Manual { output: manual(s, k).0, until_s },
    path: |_, _| "controller.loops[].mode.manual.until_s",
    scale: Some(Scale::Linear(10.0)),
    digits: Some(0),
    ..FINE
};
const MANUAL_OUTPUT: ParamControl<Setup> = ParamControl {
    ids: [("", "manual1-output"), ("", "manual2-output")],
    name: |lab, k| tr!(lab, pi.manual_output, level = k + 1),
    read: |s, k| manual(s, k).0,
    write: |s, k, output| s.controller.loops[k].mode = LoopMode::Manual { output, until_s: manual(s, k).1 },
    path: |_, _| "controller.loops[].mode.manual.output",
    // Beyond its limits a pump does no more.
    within: |s, k| {
        let (min, max) = s.plant().controller_limits()[s.controller.pairing.pump_of(k)];
        Limits::new(min, max)
    },
    scale: Some(Scale::Linear(0.1)),
    digits: Some(2),
    ..FINE
};
const FINE: ParamControl<Setup> = ParamControl { class: ["wide"; 2], ..ParamControl::locked_by(locks::SAMPLING) };

fn both(setup: &mut Setup, change: impl Fn(&mut PiSettings)) {
    setup.controller.loops.iter_mut().for_each(change);
}

fn is_guarded(setup: &Setup) -> bool {
    setup.controller.loops[0].anti_windup != AntiWindup::Off
}

/// Output of a loop in manual, and until when; zeros for one that is not.
fn manual(setup: &Setup, index: usize) -> (f64, f64) {
    match setup.controller.loops[index].mode {
        LoopMode::Automatic => (0.0, 0.0),
        LoopMode::Manual { output, until_s } => (output, until_s),
    }
}

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[terms::pairing, terms::gain, terms::integral_time, terms::weight, terms::windup, terms::peak];

/// Pairing, gains and the fine print of the two loops.
#[component]
pub fn ControllerCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let windup = session.part(|s| s.controller.loops.iter().any(|l| l.anti_windup != AntiWindup::Off));
    let about = move || {
        let windup = if windup.get() { tr!(lab, pi.windup_on) } else { tr!(lab, pi.windup_off) };
        tr!(lab, pi.remark, windup = windup)
    };
    let stability = Memo::new(move |_| sentences::of_stability(session));
    view! {
        <Card name="pi" panel=panels::CONTROLLER title=say!(lab, pi.title) terms=TERMS beside=move || view! { <span class="remark">{about}</span> }>
            <PairingSwitch />
            <LoopControls index=0 />
            <LoopControls index=1 />
            <details class="more">
                <summary data-testid="pi-more">{say!(lab, pi.more)}</summary>
                <FinePrint />
            </details>
            <div class="toolbar">
                <HandOver
                    id="to-relays"
                    name=say!(lab, handover.relays)
                    is_possible=true
                    act=Callback::new(move |()| handover::to_relays(lab, &session.document.with_untracked(|s| s.setup.clone())))
                />
                <HandOver
                    id="to-model-free"
                    name=say!(lab, handover.model_free)
                    is_possible=true
                    act=Callback::new(move |()| handover::to_model_free(lab, &session.document.with_untracked(|s| s.setup.clone())))
                />
            </div>
            <Sentence
                id="stability"
                text=Signal::derive(move || stability.get().0)
                warm=Signal::derive(move || stability.get().1)
                status=true
            />
            <MendButton session id="mend-loop" offer=mends::of_gains />
        </Card>
    }
}

/// Shows the suggestion, obeys the student.
#[component]
fn PairingSwitch() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let chosen = session.part(|s| s.controller.pairing);
    let suggested = move || session.throttled.with_analysis(|a| a.linear.advised_pairing()).flatten();
    let choice = move |pairing: Pairing, id: &'static str| {
        let text = Signal::derive(move || match pairing {
            Pairing::Diagonal => tr!(lab, pi.diagonal),
            Pairing::Swapped => tr!(lab, pi.swapped),
        });
        (pairing, id, text)
    };
    // In a lesson the student is to find out.
    let advice = move || suggested().filter(|_| lab.stage.with(Option::is_none));
    let fits = move || advice().is_none_or(|s| s == chosen.get());
    view! {
        <Segmented
            label=say!(lab, pi.pairing)
            choices=vec![choice(Pairing::Diagonal, "pairing-diagonal"), choice(Pairing::Swapped, "pairing-swapped")]
            value=chosen
            tag=Signal::derive(move || advice().map(|pairing| (pairing, tr!(lab, pi.advised))))
            on_choose=move |pairing| session.edit(|s| s.controller.pairing = pairing)
            disabled=lab.locks(locks::PAIRING)
        />
        <div class="toolbar" hidden=fits>
            <p class="remark warm">{say!(lab, pi.against)}</p>
            <button
                type="button"
                class="button small"
                data-testid="try-advised"
                disabled=lab.locks(locks::PAIRING) || lab.locks(locks::GAINS)
                on:click=move |_| if let Some(pairing) = untrack(suggested) { take_advice(session, pairing) }
            >
                {say!(lab, mend.pairing)}
            </button>
        </div>
    }
}

/// Pairs as advised, with detuned loops where the present ones are not good for that.
fn take_advice(session: Session, pairing: Pairing) {
    session.edit(|s| {
        s.controller.pairing = pairing;
        if let Some(setup) = detuned(s) {
            *s = setup;
        }
    });
}

#[component]
fn LoopControls(index: usize) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let heading = move || {
        let pump = session.document.with(|s| s.setup.controller.pairing.pump_of(index)) + 1;
        tr!(lab, pi.heading, level = index + 1, pump = pump)
    };
    // A gain of 0 opens the loop: its pump keeps the voltage that it starts with.
    let is_open = session.part(move |s| s.controller.loops[index].gain == 0.0);
    view! {
        <h3 class=["loop1", "loop2"][index]>
            {heading}
            <span class="tag" data-testid=OPEN_IDS[index] hidden=move || !is_open.get()>" (" {say!(lab, pi.open)} ")"</span>
        </h3>
        <ParamRow session control=&GAIN index />
        <ParamRow session control=&INTEGRAL_TIME index />
    }
}

/// What most students leave alone: set-point weight, anti-windup, sampling time, sign and manual mode.
#[component]
fn FinePrint() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let switch_windup = move |on| {
        let choice = if on { AntiWindup::BackCalculation { tracking_ratio: TRACKING_RATIO } } else { AntiWindup::Off };
        session.edit(|s| both(s, |l| l.anti_windup = choice));
    };
    view! {
        <ParamRow session control=&WEIGHT />
        <ParamRow session control=&SAMPLING />
        <Tick
            id="antiwindup"
            text=say!(lab, pi.antiwindup)
            ticked=session.part(is_guarded)
            disabled=lab.locks(locks::SAMPLING)
            on_tick=switch_windup
        />
        <ParamRow session control=&TRACKING />
        <ManualMode index=0 />
        <ManualMode index=1 />
    }
}

/// A loop in manual until a time, then handed over without a bump; and the sign of its gain.
#[component]
fn ManualMode(index: usize) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let by_hand = session.part(move |s| s.controller.loops[index].mode != LoopMode::Automatic);
    let rest = move || {
        let pump = session.document.with(|s| s.setup.controller.pairing.pump_of(index));
        let power = session.document.with(|s| s.setup.plant().power_gain);
        session.throttled.with_analysis(|a| a.operating_point.pump_voltage[pump] / power).unwrap_or_default()
    };
    let switch = move |on| {
        let mode =
            if on { LoopMode::Manual { output: untrack(rest), until_s: MANUAL_UNTIL_S } } else { LoopMode::Automatic };
        session.edit(|s| s.controller.loops[index].mode = mode);
    };
    let fields = move || {
        view! {
            <div class="fields">
                <div class="field-row"><ParamNumber session control=&MANUAL_UNTIL index /><span class="unit">"s"</span></div>
                <div class="field-row"><ParamNumber session control=&MANUAL_OUTPUT index /><span class="unit">"V"</span></div>
            </div>
        }
    };
    view! {
        <div class="toolbar">
            <Tick
                id=MANUAL_IDS[index]
                text=say!(lab, pi.manual, level = index + 1)
                ticked=by_hand
                disabled=lab.locks(locks::SAMPLING)
                on_tick=switch
            />
            <button
                type="button"
                class="button small"
                data-testid=SIGN_IDS[index]
                disabled=lab.locks(locks::GAINS)
                aria-label=say!(lab, pi.sign, level = index + 1)
                on:click=move |_| session.edit(|s| s.controller.loops[index].gain *= -1.0)
            >
                {["±K₁", "±K₂"][index]}
            </button>
        </div>
        {move || by_hand.get().then(fields)}
    }
}
