//! The decentralised PI controller.

use crate::app::widgets::handler;
use leptos::prelude::*;

use super::sentences::{self};
use crate::app::lab::use_lab;
use crate::app::start::Control;
use crate::app::texts::{say, tr};
use crate::app::widgets::html::rich;
use crate::app::widgets::{NumberField, Scale, Segmented, SliderField};
use crate::control::{AntiWindup, LoopMode, Pairing, PiSettings};
use crate::interaction::PairingVerdict;
use crate::scenario::{Setup, limits};

/// Travel of the gain sliders (V/V); the number field takes more.
const GAIN_TRAVEL: (f64, f64) = (0.05, 50.0);
/// Travel of the integral-time sliders (s); the number field takes more.
const INTEGRAL_TRAVEL_S: (f64, f64) = (3.0, 3000.0);
/// Tt/Ti when anti-windup is switched on (Cocota 2009, ch. 4).
const TRACKING_RATIO: f64 = 0.5;
/// When a loop that is put into manual goes back to automatic, unless the student says otherwise (s).
const MANUAL_UNTIL_S: f64 = 500.0;

const GAIN_IDS: [(&str, &str); 2] = [("gain1", "gain1-number"), ("gain2", "gain2-number")];
const INTEGRAL_IDS: [(&str, &str); 2] = [("integral1", "integral1-number"), ("integral2", "integral2-number")];
const SIGN_IDS: [&str; 2] = ["sign1", "sign2"];
const MANUAL_IDS: [(&str, &str, &str); 2] =
    [("manual1", "manual1-until", "manual1-output"), ("manual2", "manual2-until", "manual2-output")];

/// Pairing, gains and the fine print of the two loops.
#[component]
pub fn ControllerCard() -> impl IntoView {
    let lab = use_lab();
    let windup = lab.part(|s| s.controller.loops.iter().any(|l| l.anti_windup != AntiWindup::Off));
    let remark = move || {
        let windup = if windup.get() { tr!(lab, pi.windup_on) } else { tr!(lab, pi.windup_off) };
        tr!(lab, pi.remark, windup = windup).to_string()
    };
    let stability = move || sentences::of_stability(lab);
    view! {
        <section class="card pi" aria-labelledby="pi-title">
            <header>
                <h2 id="pi-title">{say!(lab, pi.title)}</h2>
                <span class="remark">{Signal::derive(remark)}</span>
            </header>
            <PairingSwitch />
            <LoopControls index=0 />
            <LoopControls index=1 />
            <details class="more">
                <summary data-testid="pi-more">{say!(lab, pi.more)}</summary>
                <FinePrint />
            </details>
            <p class=move || if stability().1 { "sentence warm" } else { "sentence" }.to_owned() role="status" data-testid="stability" inner_html=Signal::derive(move || rich(&stability().0))></p>
        </section>
    }
}

/// Shows the suggestion, obeys the student.
#[component]
fn PairingSwitch() -> impl IntoView {
    let lab = use_lab();
    let swapped = lab.part(|s| s.controller.pairing == Pairing::Swapped);
    let suggested = move || {
        lab.words
            .with_analysis(|a| match a.verdict {
                PairingVerdict::Diagonal(_) => Some(Pairing::Diagonal),
                PairingVerdict::Swapped(_) => Some(Pairing::Swapped),
                PairingVerdict::None(_) => None,
            })
            .flatten()
    };
    let text = move |choice: Pairing| {
        Signal::derive(move || {
            let name = match choice {
                Pairing::Diagonal => tr!(lab, pi.diagonal),
                Pairing::Swapped => tr!(lab, pi.swapped),
            };
            if suggested() == Some(choice) { format!("{name} ✓") } else { name.to_owned() }
        })
    };
    let against = move || suggested().is_some_and(|s| (s == Pairing::Swapped) != swapped.get());
    view! {
        <Segmented
            label=say!(lab, pi.pairing)
            choices=vec![
                (false, "pairing-diagonal", text(Pairing::Diagonal)),
                (true, "pairing-swapped", text(Pairing::Swapped)),
            ]
            value=swapped
            on_choose=move |swapped| {
                lab.edit(|s| s.controller.pairing = if swapped { Pairing::Swapped } else { Pairing::Diagonal });
            }
            disabled=lab.locks(Control::Pairing)
        />
        <p class="remark warm" hidden=move || !against()>{say!(lab, pi.against)}</p>
    }
}

#[component]
fn LoopControls(index: usize) -> impl IntoView {
    let lab = use_lab();
    let class = if index == 0 { "loop1-row" } else { "loop2-row" };
    let heading = move || {
        let pump = lab.scenario.with(|s| s.setup.controller.pairing.pump_of(index)) + 1;
        tr!(lab, pi.heading, level = index + 1, pump = pump).to_string()
    };
    let gain = lab.part(move |s| s.controller.loops[index].gain);
    let edit = move |change: &dyn Fn(&mut PiSettings)| lab.edit(|s| change(&mut s.controller.loops[index]));
    let most = limits::GAIN_MAGNITUDE.max;
    let locked = lab.locks(Control::Gains);
    view! {
        <h3 class=if index == 0 { "loop1" } else { "loop2" }>{Signal::derive(heading)}</h3>
        <SliderField
            id=GAIN_IDS[index]
            label=format!("K{}", ["₁", "₂"][index])
            name=say!(lab, pi.gain, level = index + 1)
            value=gain
            on_change=move |k| edit(&move |l| l.gain = k)
            travel=GAIN_TRAVEL
            limits=Signal::from((-most, most))
            smallest=limits::GAIN_MAGNITUDE.min
            scale=Scale::Logarithmic
            digits=None
            unit="V/V".to_owned()
            class
            disabled=locked
        />
        <SliderField
            id=INTEGRAL_IDS[index]
            label=format!("Ti{}", ["₁", "₂"][index])
            name=say!(lab, pi.integral, level = index + 1)
            value=lab.part(move |s| s.controller.loops[index].integral_time_s)
            on_change=move |t| edit(&move |l| l.integral_time_s = t)
            travel=INTEGRAL_TRAVEL_S
            limits=Signal::from((limits::INTEGRAL_TIME_S.min, limits::INTEGRAL_TIME_S.max))
            scale=Scale::Logarithmic
            digits=None
            unit="s".to_owned()
            class
            disabled=locked
        />
    }
}

/// What most students leave alone: set-point weight, anti-windup, sampling time, sign and manual mode.
#[component]
fn FinePrint() -> impl IntoView {
    let lab = use_lab();
    let locked = lab.locks(Control::Sampling);
    let both = move |change: &dyn Fn(&mut PiSettings)| lab.edit(|s| s.controller.loops.iter_mut().for_each(change));
    let guarded = lab.part(|s| s.controller.loops[0].anti_windup != AntiWindup::Off);
    let tracking = lab.part(|s| match s.controller.loops[0].anti_windup {
        AntiWindup::BackCalculation { tracking_ratio } => tracking_ratio,
        AntiWindup::Off => TRACKING_RATIO,
    });
    let switch_windup = move |event| {
        let on = event_target_checked(&event);
        let choice = if on { AntiWindup::BackCalculation { tracking_ratio: TRACKING_RATIO } } else { AntiWindup::Off };
        both(&move |l| l.anti_windup = choice);
    };
    view! {
        <SliderField
            id=("weight", "weight-number")
            label=say!(lab, pi.weight_label)
            name=say!(lab, pi.weight)
            value=lab.part(|s| s.controller.loops[0].set_point_weight)
            on_change=move |b| both(&move |l| l.set_point_weight = b)
            travel=(limits::SET_POINT_WEIGHT.min, limits::SET_POINT_WEIGHT.max)
            scale=Scale::Linear(0.05)
            digits=Some(2)
            unit=String::new()
            class="wide"
            disabled=locked
        />
        <SliderField
            id=("sampling", "sampling-number")
            label=say!(lab, pi.sampling_label)
            name=say!(lab, pi.sampling)
            value=lab.part(|s| s.controller.sampling_time_s)
            on_change=move |t| lab.edit(|s| s.controller.sampling_time_s = t)
            travel=lab.part(|s| { let l = limits::sampling_time_s(s.experiment.duration_s); (l.min, l.max) })
            scale=Scale::Logarithmic
            digits=None
            unit="s".to_owned()
            class="wide"
            disabled=locked
        />
        <label class="check">
            <input
                type="checkbox"
                data-testid="antiwindup"
                prop:checked=guarded
                disabled=locked
                on:change=handler(switch_windup)
            />
            {say!(lab, pi.antiwindup)}
        </label>
        <SliderField
            id=("tracking", "tracking-number")
            label=say!(lab, pi.tracking_label)
            name=say!(lab, pi.tracking)
            value=tracking
            on_change=move |ratio| both(&move |l| l.anti_windup = AntiWindup::BackCalculation { tracking_ratio: ratio })
            travel=(0.02, 20.0)
            scale=Scale::Logarithmic
            digits=None
            unit=String::new()
            class="wide"
            disabled=Signal::derive(move || locked || !guarded.get())
        />
        <ManualMode index=0 />
        <ManualMode index=1 />
    }
}

/// A loop in manual until a time, then handed over without a bump; and the sign of its gain.
#[component]
fn ManualMode(index: usize) -> impl IntoView {
    let lab = use_lab();
    let locked = lab.locks(Control::Sampling);
    let (check_id, until_id, output_id) = MANUAL_IDS[index];
    let manual = move |s: &Setup| match s.controller.loops[index].mode {
        LoopMode::Automatic => None,
        LoopMode::Manual { output, until_s } => Some((output, until_s)),
    };
    let by_hand = lab.part(move |s| manual(s).is_some());
    let output = lab.part(move |s| manual(s).map_or(0.0, |m| m.0));
    let until_s = lab.part(move |s| manual(s).map_or(0.0, |m| m.1));
    let set = move |mode: LoopMode| lab.edit(|s| s.controller.loops[index].mode = mode);
    let rest = move || {
        let pump = lab.scenario.with(|s| s.setup.controller.pairing.pump_of(index));
        let power = lab.scenario.with(|s| s.setup.plant().power_gain);
        lab.words.with_analysis(|a| a.operating_point.pump_voltage[pump] / power).unwrap_or_default()
    };
    let range = lab.part(move |s| s.plant().controller_limits()[s.controller.pairing.pump_of(index)]);
    let switch = move |event| {
        set(if event_target_checked(&event) {
            LoopMode::Manual { output: untrack(rest), until_s: MANUAL_UNTIL_S }
        } else {
            LoopMode::Automatic
        });
    };
    view! {
        <div class="toolbar">
            <label class="check">
                <input type="checkbox" data-testid=check_id prop:checked=by_hand disabled=locked on:change=handler(switch) />
                {say!(lab, pi.manual, level = index + 1)}
            </label>
            <button
                type="button"
                class="button small"
                data-testid=SIGN_IDS[index]
                disabled=lab.locks(Control::Gains)
                aria-label=say!(lab, pi.sign, level = index + 1)
                on:click=handler(move |_| lab.edit(|s| s.controller.loops[index].gain *= -1.0))
            >
                "±K"{["₁", "₂"][index]}
            </button>
        </div>
        {move || by_hand.get().then(|| view! {
            <div class="fields">
                <div class="field-row">
                    <NumberField
                        id=until_id
                        name=say!(lab, pi.manual_until, level = index + 1)
                        value=until_s
                        on_change=move |until_s| set(LoopMode::Manual { output: output.get_untracked(), until_s })
                        limits=(limits::TIME_S.min, limits::TIME_S.max)
                        scale=Scale::Linear(10.0)
                        digits=Some(0)
                        disabled=locked
                    />
                    <span class="unit">"s"</span>
                </div>
                <div class="field-row">
                    <NumberField
                        id=output_id
                        name=say!(lab, pi.manual_output, level = index + 1)
                        value=output
                        on_change=move |output| set(LoopMode::Manual { output, until_s: until_s.get_untracked() })
                        limits=range
                        scale=Scale::Linear(0.1)
                        digits=Some(2)
                        disabled=locked
                    />
                    <span class="unit">"V"</span>
                </div>
            </div>
        }.into_any())}
    }
}
