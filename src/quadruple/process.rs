//! The card with the drawing of the rig, the valves, and one sentence about where the zero is.

use leptos::prelude::*;

use super::moment::use_moment;
use super::published::published_figures;
use super::rig::rig;
use super::sentences;
use crate::controls::{Knob, knob};
use crate::lab::{Lab, use_lab};
use crate::preset::{preset_choice, preset_remark};
use crate::start::Control;
use crate::texts::{say, tr};
use crate::widgets::html::{element, rich};
use crate::widgets::{NumberField, Scale, card, handler, verdict};
use quadtank_scenario::{OperatingPointSpec, Setup};

const GAMMA: Knob<Setup> = Knob {
    ids: [("gamma1", "gamma1-number"), ("gamma2", "gamma2-number")],
    label: |_, k| ["γ₁", "γ₂"][k],
    name: |lab, k| tr!(lab, process.gamma, pump = k + 1),
    read: |s, k| s.valves[k],
    write: |s, k, gamma| s.valves[k] = gamma,
    travel: Some(|_| (0.0, 1.0)),
    digits: Some(2),
    class: ["loop1-row", "loop2-row"],
    lock: Control::Valves,
    ..Knob::PLAIN
};
const VOLTAGE_IDS: [&str; 2] = ["voltage1", "voltage2"];

/// The drawing of the rig, the valve sliders and the sentence under them.
pub fn process_card() -> AnyView {
    let lab = use_lab();
    let moment = use_moment();
    let remark = Signal::derive(move || match moment.get().and_then(|m| m.time_s) {
        Some(time) => tr!(lab, process.at_time, time = lab.number_style().fixed(time, 0)),
        None if lab.locks(Control::Valves) => tr!(lab, process.at_rest).to_owned(),
        None => tr!(lab, process.drag_valves).to_owned(),
    });
    let open = RwSignal::new(false);
    let sentence = move || sentences::of_zero(lab);
    let paragraphs = Signal::derive(move || {
        let all = std::iter::once(sentence().0).chain(sentences::of_equilibrium(lab));
        all.map(|text| element("p", "", &rich(&text))).collect::<String>()
    });
    let content = view! {
        <p class="remark moment">{remark}</p>
        {rig(lab)}
        <div>
            {knob(lab, &GAMMA, 0)}
            {knob(lab, &GAMMA, 1)}
        </div>
        {verdict("process-sentence".to_owned(), Signal::derive(move || sentence().1), paragraphs)}
        <details class="more" on:toggle=handler(move |_| open.update(|o| *o = !*o))>
            <summary>{say!(lab, process.operating_point)}</summary>
            {preset_remark(lab)}
            <div class="fields">
                {voltage_field(lab, 0)}
                {voltage_field(lab, 1)}
            </div>
            {move || open.get().then(|| published_figures(lab))}
        </details>
    };
    card("process", say!(lab, process.title), vec![preset_choice(lab)], vec![content.into_any()])
}

/// The voltage of a pump at rest. Editing it makes the voltages, not the levels, what the operating point is given by.
fn voltage_field(lab: Lab, pump: usize) -> AnyView {
    let computed =
        move || lab.words.analysis.with(|a| a.as_ref().as_ref().ok().map(|a| a.operating_point.pump_voltage));
    let voltages = move || match lab.scenario.with(|s| s.setup.operating_point) {
        OperatingPointSpec::PumpVoltage(given) => Some(given),
        OperatingPointSpec::Levels(_) => computed(),
    };
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
            <span>{["v₁", "v₂"][pump]}</span>
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
    .into_any()
}
