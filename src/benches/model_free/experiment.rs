//! Which case is run, and what is asked of it.

use leptos::prelude::*;

use super::flags::{locks, panels};
use super::session::use_session;
use crate::controls::{ParamControl, ParamRow, Switch};
use crate::shown::ShownUnit;
use crate::texts::{say, tr};
use crate::widgets::{Card, Scale};
use quadtank::literature::DisplayUnit;
use quadtank::literature::junqueira::{PublishedExperiment, PublishedValves};
use quadtank::study::model_free::{LONG_RUN_S, ModelFreeSetup};
use quadtank_scenario::{Limits, limits};

const VALVE: ParamControl<ModelFreeSetup> = ParamControl {
    ids: [("", "free-gamma1"), ("", "free-gamma2")],
    label: |_, k| ["γ₁", "γ₂"][k].to_owned(),
    name: |lab, k| tr!(lab, free.gamma, valve = k + 1),
    read: |s, k| s.valves[k].midpoint(),
    write: |s, k, middle| s.valves[k] = s.valves[k].around(middle),
    // The middle of a valve that moves keeps away from both ends.
    path: |_, _| "valves[].constant.gamma",
    within: |s, k| Limits::new(s.valves[k].amplitude(), 1.0 - s.valves[k].amplitude()),
    digits: Some(2),
    ..ParamControl::locked_by(locks::VALVES)
};
const STEP: ParamControl<ModelFreeSetup> = ParamControl {
    ids: [("", "free-step1"), ("", "free-step2")],
    label: |_, k| ["Δr₁", "Δr₂"][k].to_owned(),
    name: |lab, k| tr!(lab, free.step, level = k + 1),
    path: |_, _| "experiment.set_point_steps[].size",
    read: |s, k| s.set_point_step(k),
    write: |s, k, size| s.set_set_point_step(k, size),
    // From the bottom of the tank to its brim.
    within: |s, k| {
        let (least, most) = s.set_point_steps(k);
        Limits::new(least, most)
    },
    scale: Some(Scale::Linear(0.1)),
    digits: Some(2),
    shown_unit: Some(|_| ShownUnit::length(DisplayUnit::Cm)),
    ..ParamControl::locked_by(locks::EXPERIMENT)
};
const NOISE: ParamControl<ModelFreeSetup> = ParamControl {
    ids: [("", "free-noise"); 2],
    label: |_, _| "σ".to_owned(),
    name: |lab, _| tr!(lab, experiment.noise_name),
    path: |_, _| "experiment.measurement.noise_std",
    read: |s, _| s.experiment.measurement.noise_std,
    write: |s, _, noise| s.experiment.measurement.noise_std = noise,
    within: |_, _| Limits::NONE,
    ..STEP
};
const DURATION: ParamControl<ModelFreeSetup> = ParamControl {
    ids: [("", "free-end"); 2],
    label: |_, _| "t".to_owned(),
    name: |lab, _| tr!(lab, experiment.duration_name),
    read: |s, _| s.experiment.duration_s,
    write: |s, _, duration_s| s.experiment.duration_s = duration_s,
    path: |_, _| "experiment.duration_s",
    // So long that each reference steps.
    within: |s, _| Limits { min: s.shortest_s(), ..limits::model_free_duration_s(s) },
    shown_unit: None,
    scale: Some(Scale::Linear(10.0)),
    digits: Some(0),
    ..STEP
};

/// The case, the experiment, and their numbers.
#[component]
pub fn CaseCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let cases = vec![
        (Some(PublishedValves::A), "free-a", say!(lab, free.case_a)),
        (Some(PublishedValves::B), "free-b", say!(lab, free.case_b)),
        (Some(PublishedValves::C), "free-c", say!(lab, free.case_c)),
    ];
    let experiments = vec![
        (Some(PublishedExperiment::S1), "free-s1", say!(lab, free.s1)),
        (Some(PublishedExperiment::S2), "free-s2", say!(lab, free.s2)),
        (Some(PublishedExperiment::S3), "free-s3", say!(lab, free.s3)),
    ];
    let source = move || view! { <span class="remark">{say!(lab, free.source)}</span> };
    view! {
        <Card name="case" panel=panels::EXPERIMENT title=say!(lab, free.case) beside=source>
            <Switch
                session
                label=say!(lab, free.case)
                choices=cases
                read=case_of
                write=set_case
                lock=locks::VALVES
            />
            <Switch
                session
                label=say!(lab, experiment.title)
                choices=experiments
                read=experiment_of
                write=set_experiment
                lock=locks::EXPERIMENT
            />
            <div class="pairs">
                <ParamRow session control=&VALVE index=0 />
                <ParamRow session control=&VALVE index=1 />
                <ParamRow session control=&STEP index=0 />
                <ParamRow session control=&STEP index=1 />
                <ParamRow session control=&NOISE />
                <ParamRow session control=&DURATION />
            </div>
            <div class="toolbar">
                <Pressed
                    id="free-long"
                    text=say!(lab, free.long)
                    value=session.throttled_part(|s| s.experiment.duration_s == LONG_RUN_S)
                    press=|s| s.experiment.duration_s = LONG_RUN_S
                />
                <Pressed
                    id="free-pi"
                    text=say!(lab, free.compare)
                    value=session.throttled_part(|s| s.compare.is_some())
                    press=compare
                />
            </div>
        </Card>
    }
}

/// A button that stays pressed while something is so.
#[component]
fn Pressed(
    id: &'static str,
    text: Signal<String>,
    value: Signal<bool>,
    press: fn(&mut ModelFreeSetup),
) -> impl IntoView {
    let session = use_session();
    view! {
        <button
            type="button"
            class="button small"
            data-testid=id
            aria-pressed=move || value.get().to_string()
            disabled=session.lab.locks(locks::EXPERIMENT)
            on:click=move |_| session.edit(press)
        >
            {text}
        </button>
    }
}

/// The published case whose valves these are, if it is one.
fn case_of(setup: &ModelFreeSetup) -> Option<PublishedValves> {
    PublishedValves::ALL.into_iter().find(|case| case.schedules() == setup.valves)
}

fn set_case(setup: &mut ModelFreeSetup, case: Option<PublishedValves>) {
    let Some(case) = case else { return };
    setup.valves = case.schedules();
    if setup.compare.is_some() {
        setup.compare = Some(setup.usual_pi());
    }
}

/// The published experiment that this is, whatever its duration; none for others.
fn experiment_of(setup: &ModelFreeSetup) -> Option<PublishedExperiment> {
    let is_same = |experiment: &PublishedExperiment| {
        let published = ModelFreeSetup::published(PublishedValves::A, *experiment);
        published.start == setup.start && published.experiment.set_point_steps == setup.experiment.set_point_steps
    };
    PublishedExperiment::ALL.into_iter().find(is_same)
}

/// The law, the noise and the valves stay.
fn set_experiment(setup: &mut ModelFreeSetup, experiment: Option<PublishedExperiment>) {
    let Some(experiment) = experiment else { return };
    let published = ModelFreeSetup::published(PublishedValves::A, experiment);
    let measurement = setup.experiment.measurement;
    setup.start = published.start;
    setup.experiment = published.experiment;
    setup.experiment.measurement = measurement;
}

fn compare(setup: &mut ModelFreeSetup) {
    setup.compare = if setup.compare.is_some() { None } else { Some(setup.usual_pi()) };
}
