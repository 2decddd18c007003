//! The card with the drawing of the rig, the valves, and one sentence about where the zero is.

use crate::app::widgets::handler;
use leptos::prelude::*;

use super::moment::use_moment;
use super::published::PublishedFigures;
use super::rig::Rig;
use super::sentences;
use crate::app::lab::use_lab;
use crate::app::preset::{PresetChoice, PresetRemark};
use crate::app::start::Control;
use crate::app::texts::{say, tr};
use crate::app::widgets::html::{element, rich};
use crate::app::widgets::{NumberField, Scale, SliderField};
use crate::scenario::{OperatingPointSpec, Setup};

const GAMMA_IDS: [(&str, &str); 2] = [("gamma1", "gamma1-number"), ("gamma2", "gamma2-number")];
const VOLTAGE_IDS: [&str; 2] = ["voltage1", "voltage2"];

/// The drawing of the rig, the valve sliders and the sentence under them.
#[component]
pub fn ProcessCard() -> impl IntoView {
    let lab = use_lab();
    let moment = use_moment();
    let remark = move || match moment.get().and_then(|m| m.time_s) {
        Some(time) => tr!(lab, process.at_time, time = lab.number_style().fixed(time, 0)).to_string(),
        None => tr!(lab, process.at_rest).to_string(),
    };
    let open = RwSignal::new(false);
    let sentence = move || sentences::of_zero(lab);
    let paragraphs = Signal::derive(move || {
        let all = std::iter::once(sentence().0).chain(sentences::of_equilibrium(lab));
        all.map(|text| element("p", "", &rich(&text))).collect::<String>()
    });
    view! {
        <section class="card process" aria-labelledby="process-title">
            <header>
                <h2 id="process-title">{say!(lab, process.title)}</h2>
                <PresetChoice />
            </header>
            <p class="remark moment">{Signal::derive(remark)}</p>
            <Rig />
            <div>
                <ValveSlider valve=0 />
                <ValveSlider valve=1 />
            </div>
            <div
                class=move || if sentence().1 { "verdict warm" } else { "verdict" }.to_owned()
                role="status"
                data-testid="process-sentence"
                inner_html=paragraphs
            ></div>
            <details class="more" on:toggle=handler(move |_| open.update(|o| *o = !*o))>
                <summary>{say!(lab, process.operating_point)}</summary>
                <PresetRemark />
                <div class="fields">
                    <VoltageField pump=0 />
                    <VoltageField pump=1 />
                </div>
                {move || open.get().then(|| view! { <PublishedFigures /> }.into_any())}
            </details>
        </section>
    }
}

#[component]
fn ValveSlider(valve: usize) -> impl IntoView {
    let lab = use_lab();
    view! {
        <SliderField
            id=GAMMA_IDS[valve]
            label=Signal::derive(move || format!("γ{}", ["₁", "₂"][valve]))
            name=say!(lab, process.gamma, pump = valve + 1)
            value=lab.part(move |s| s.valves[valve])
            on_change=move |v| lab.edit(|s| s.valves[valve] = v)
            travel=(0.0, 1.0)
            scale=Scale::Linear(0.01)
            digits=Some(2)
            unit=String::new()
            class=if valve == 0 { "loop1-row" } else { "loop2-row" }
            disabled=lab.locks(Control::Valves)
        />
    }
}

/// The voltage of a pump at rest. Editing it makes the voltages, not the levels, what the operating point is given by.
#[component]
fn VoltageField(pump: usize) -> impl IntoView {
    let lab = use_lab();
    let voltages =
        move || lab.words.analysis.with(|a| a.as_ref().as_ref().ok().map(|a| a.operating_point.pump_voltage));
    let value = Signal::derive(move || voltages().map_or(0.0, |v| v[pump]));
    let on_change = move |v: f64| {
        let mut both = untrack(voltages).unwrap_or_default();
        both[pump] = v;
        lab.edit(|s| s.operating_point = OperatingPointSpec::PumpVoltage(both));
    };
    let range = lab.part(move |s: &Setup| {
        let pump = s.plant().pumps[pump];
        (pump.voltage_min, pump.voltage_max)
    });
    view! {
        <div class="field-row">
            <span>{format!("v{}", ["₁", "₂"][pump])}</span>
            <NumberField
                id=VOLTAGE_IDS[pump]
                name=say!(lab, process.voltage, pump = pump + 1)
                value
                on_change
                limits=range
                scale=Scale::Linear(0.05)
                digits=Some(2)
                disabled=lab.locks(Control::Voltages)
            />
            <span class="unit">"V"</span>
        </div>
    }
}
