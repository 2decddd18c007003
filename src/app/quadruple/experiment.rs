//! What is done to the loop: steps, a load, noise, how long, and the run played on the drawing.

use crate::app::widgets::handler;
use leptos::prelude::*;

use super::cursor::PlayControls;
use crate::app::lab::{Lab, use_lab};
use crate::app::shown::{CM3_PER_M3, MM2_PER_M2, to_metres, to_shown, unit_name};
use crate::app::start::Control;
use crate::app::texts::{say, tr};
use crate::app::widgets::html::option;
use crate::app::widgets::{NumberField, Scale, SliderField};
use crate::scenario::limits;
use crate::sim::{Experiment, Load, LoadStep, SetPointStep};

/// Time of a step that the student adds (s).
const FIRST_STEP_AT_S: f64 = 100.0;
/// When a load that the student adds begins, as a share of the experiment: after the steps of the published ones.
const FIRST_LOAD_AT: f64 = 0.8;
/// Extra pump flow of a load that the student adds (m³/s): about 5 % of a pump's flow on Johansson's rig.
const FIRST_LOAD_FLOW: f64 = 0.5e-6;
/// Hole of a leak that the student adds (m²): about a fifth of an outlet of Johansson's rig.
const FIRST_LEAK_AREA: f64 = 1.5e-6;
/// Travel of the reference sliders as a share of the lowest wall.
const REFERENCE_TRAVEL: f64 = 0.25;

const REFERENCE_IDS: [(&str, &str); 2] = [("step1", "step1-number"), ("step2", "step2-number")];
const TIME_IDS: [&str; 2] = ["step1-time", "step2-time"];

/// The experiment.
#[component]
pub fn ExperimentCard() -> impl IntoView {
    let lab = use_lab();
    let locked = lab.locks(Control::Experiment);
    let unit = lab.unit;
    let noise = lab.part(|s| s.experiment.measurement.noise_std);
    let further = move || lab.scenario.with(|s| further_steps(&s.setup.experiment));
    view! {
        <section class="card experiment" aria-labelledby="experiment-title">
            <header>
                <h2 id="experiment-title">{say!(lab, experiment.title)}</h2>
                <span class="remark">{say!(lab, experiment.remark)}</span>
            </header>
            <ReferenceStep level=0 />
            <ReferenceStep level=1 />
            <LoadControls />
            <SliderField
                id=("noise", "noise-number")
                label=say!(lab, experiment.noise)
                name=say!(lab, experiment.noise_name)
                value=Signal::derive(move || to_shown(noise.get(), unit.get()))
                on_change=move |v| { let m = to_metres(v, unit.get_untracked()); lab.edit(|s| s.experiment.measurement.noise_std = m) }
                travel=Signal::derive(move || (0.0, to_shown(0.005, unit.get())))
                scale=Scale::Linear(0.01)
                digits=Some(2)
                unit=Signal::derive(move || unit_name(unit.get()).to_owned())
                class="wide"
                disabled=locked
            />
            <SliderField
                id=("duration", "duration-number")
                label=say!(lab, experiment.duration)
                name=say!(lab, experiment.duration_name)
                value=lab.part(|s| s.experiment.duration_s)
                on_change=move |t| lab.edit(|s| s.experiment.duration_s = t)
                travel=(100.0, 20_000.0)
                limits=lab.part(|s| { let l = limits::duration_s(s.controller.sampling_time_s); (l.min, l.max) })
                scale=Scale::Logarithmic
                digits=Some(0)
                unit="s".to_owned()
                class="wide"
                disabled=locked
            />
            <label class="check">
                <input
                    type="checkbox"
                    data-testid="quantised"
                    prop:checked=lab.part(|s| s.experiment.measurement.quantised)
                    disabled=locked
                    on:change=handler(move |event| { let on = event_target_checked(&event); lab.edit(|s| s.experiment.measurement.quantised = on) })
                />
                {say!(lab, experiment.quantised)}
            </label>
            <p class="remark" hidden=move || further() == 0>{say!(lab, experiment.further, count = further())}</p>
            <PlayControls />
        </section>
    }
}

/// Steps beyond the first of each level and the first load: a file may hold them, the card does not show them.
fn further_steps(experiment: &Experiment) -> usize {
    let shown_levels = (0..2).filter(|&level| experiment.set_point_steps.iter().any(|s| s.level == level)).count();
    experiment.set_point_steps.len() - shown_levels + experiment.load_steps.len().saturating_sub(1)
}

fn first_step(experiment: &Experiment, level: usize) -> Option<SetPointStep> {
    experiment.set_point_steps.iter().copied().find(|s| s.level == level)
}

fn first_load(experiment: &Experiment) -> Option<Load> {
    experiment.load_steps.first().map(|step| step.load)
}

/// Size of the first step of a reference (m).
pub fn step_size(lab: Lab, level: usize) -> Signal<f64> {
    lab.part(move |s| first_step(&s.experiment, level).map_or(0.0, |s| s.size))
}

/// Time of the first step of a reference (s).
pub fn step_time(lab: Lab, level: usize) -> Signal<f64> {
    lab.part(move |s| first_step(&s.experiment, level).map_or(FIRST_STEP_AT_S, |s| s.time_s))
}

/// Changes the first step of a reference, which is added where there is none.
pub fn edit_step(lab: Lab, level: usize, change: impl Fn(&mut SetPointStep)) {
    lab.edit(|s| {
        let steps = &mut s.experiment.set_point_steps;
        let place = steps.iter().position(|step| step.level == level).unwrap_or_else(|| {
            steps.push(SetPointStep { level, time_s: FIRST_STEP_AT_S, size: 0.0 });
            steps.len() - 1
        });
        change(&mut steps[place]);
    });
}

/// Size and time of the first step of a reference.
#[component]
fn ReferenceStep(level: usize) -> impl IntoView {
    let lab = use_lab();
    let unit = lab.unit;
    let (size, time) = (step_size(lab, level), step_time(lab, level));
    let reach = lab.part(|s| {
        let plant = s.plant();
        plant.tanks[0].height.min(plant.tanks[1].height)
    });
    let locked = lab.locks(Control::Experiment);
    let travel = Signal::derive(move || {
        let reach = to_shown(reach.get(), unit.get()) * REFERENCE_TRAVEL;
        (-reach, reach)
    });
    let limits = Signal::derive(move || {
        let reach = to_shown(reach.get(), unit.get());
        (-reach, reach)
    });
    view! {
        <div class="timed">
            <SliderField
                id=REFERENCE_IDS[level]
                label=format!("r{}", ["₁", "₂"][level])
                name=say!(lab, experiment.reference, level = level + 1)
                value=Signal::derive(move || to_shown(size.get(), unit.get()))
                on_change=move |v| { let size = to_metres(v, unit.get_untracked()); edit_step(lab, level, move |s| s.size = size) }
                travel
                limits
                scale=Scale::Linear(0.01)
                digits=Some(2)
                unit=Signal::derive(move || unit_name(unit.get()).to_owned())
                class=if level == 0 { "loop1-row" } else { "loop2-row" }
                disabled=locked
            />
            <TimeField
                id=TIME_IDS[level]
                name=say!(lab, experiment.reference_time, level = level + 1)
                value=time
                on_change=move |t| edit_step(lab, level, move |s| s.time_s = t)
            />
        </div>
    }
}

/// "at … s".
#[component]
fn TimeField(
    id: &'static str,
    #[prop(into)] name: Signal<String>,
    #[prop(into)] value: Signal<f64>,
    #[prop(into)] on_change: Callback<f64>,
) -> impl IntoView {
    let lab = use_lab();
    view! {
        <div class="at">
            <span class="unit">{say!(lab, experiment.at)}</span>
            <NumberField
                id
                name
                value
                on_change
                limits=lab.part(|s| (limits::TIME_S.min, s.experiment.duration_s))
                scale=Scale::Linear(10.0)
                digits=Some(0)
                disabled=lab.locks(Control::Experiment)
            />
            <span class="unit">"s"</span>
        </div>
    }
}

/// Kind, size and time of the first load.
#[component]
fn LoadControls() -> impl IntoView {
    let lab = use_lab();
    let locked = lab.locks(Control::Experiment);
    let present = lab.part(|s| !s.experiment.load_steps.is_empty());
    let time = lab.part(|s| s.experiment.load_steps.first().map_or(0.0, |step| step.time_s));
    let is_leak = lab.part(|s| matches!(first_load(&s.experiment), Some(Load::Leak { .. })));
    let size = lab.part(|s| match first_load(&s.experiment) {
        Some(Load::PumpFlow { flow, .. }) => flow * CM3_PER_M3,
        Some(Load::Leak { area, .. }) => area * MM2_PER_M2,
        None => 0.0,
    });
    let kind = lab.part(|s| match first_load(&s.experiment) {
        None => "none".to_owned(),
        Some(Load::PumpFlow { pump, .. }) => format!("pump{pump}"),
        Some(Load::Leak { tank, .. }) => format!("leak{tank}"),
    });
    let choose = move |event| {
        let load = load_named(&event_target_value(&event));
        lab.edit(|s| {
            let begin = (FIRST_LOAD_AT * s.experiment.duration_s).round();
            let steps = &mut s.experiment.load_steps;
            match (load, steps.is_empty()) {
                (None, false) => drop(steps.remove(0)),
                (None, true) => {}
                (Some(load), true) => steps.push(LoadStep { time_s: begin, load }),
                (Some(load), false) => steps[0].load = load,
            }
        });
    };
    let edit = move |change: &dyn Fn(&mut LoadStep)| {
        lab.edit(|s| {
            if let Some(step) = s.experiment.load_steps.first_mut() {
                change(step);
            }
        });
    };
    let set_size = move |v: f64| {
        edit(&move |s| match &mut s.load {
            Load::PumpFlow { flow, .. } => *flow = v / CM3_PER_M3,
            Load::Leak { area, .. } => *area = v / MM2_PER_M2,
        });
    };
    let options = Signal::derive(move || {
        let kind = kind.get();
        let pump = |k: usize| (format!("pump{k}"), tr!(lab, experiment.load_pump, pump = k + 1));
        let leak = |k: usize| (format!("leak{k}"), tr!(lab, experiment.load_leak, tank = k + 1));
        std::iter::once(("none".to_owned(), tr!(lab, experiment.load_none).to_owned()))
            .chain((0..2).map(pump))
            .chain((0..4).map(leak))
            .map(|(value, text)| option(&value, &text, value == kind))
            .collect::<String>()
    });
    view! {
        <div class="row load">
            <label for="load-kind">{say!(lab, experiment.load)}</label>
            <select id="load-kind" data-testid="load-kind" disabled=locked on:change=handler(choose) inner_html=options></select>
        </div>
        {move || present.get().then(|| view! { <div class="timed">
            <SliderField
                id=("load-size", "load-size-number")
                label=String::new()
                name=say!(lab, experiment.load_size)
                value=size
                on_change=set_size
                travel=Signal::derive(move || if is_leak.get() { (0.0, 10.0) } else { (-5.0, 5.0) })
                limits=Signal::derive(move || if is_leak.get() {
                    (0.0, limits::LEAK_AREA.max * MM2_PER_M2)
                } else {
                    (limits::LOAD_FLOW.min * CM3_PER_M3, limits::LOAD_FLOW.max * CM3_PER_M3)
                })
                scale=Scale::Linear(0.1)
                digits=Some(2)
                unit=Signal::derive(move || if is_leak.get() { "mm²" } else { "cm³/s" }.to_owned())
                disabled=locked
            />
            <TimeField
                id="load-time"
                name=say!(lab, experiment.load_time)
                value=time
                on_change=move |t| edit(&move |s| s.time_s = t)
            />
        </div> }.into_any())}
    }
}

fn load_named(name: &str) -> Option<Load> {
    let index = |prefix: &str, count: usize| {
        name.strip_prefix(prefix).and_then(|k| k.parse::<usize>().ok()).filter(|&k| k < count)
    };
    index("pump", 2)
        .map(|pump| Load::PumpFlow { pump, flow: FIRST_LOAD_FLOW })
        .or_else(|| index("leak", 4).map(|tank| Load::Leak { tank, area: FIRST_LEAK_AREA }))
}
