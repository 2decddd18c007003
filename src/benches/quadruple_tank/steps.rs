//! The steps of the references one by one, for experiments of more than one step of each.

use leptos::prelude::*;
use quadtank::sim::SetPointStep;
use quadtank_scenario::{Limits, limits};

use super::experiment::FIRST_STEP_AT_S;
use super::flags::locks;
use super::session::{Session, use_session};
use crate::shown::{finer_digits, per_metre, unit_name};
use crate::texts::{say, tr};
use crate::widgets::{Choice, NumberField, Scale, Select};

/// How many steps have a row: an experiment may hold more, such as those of a record.
const SHOWN: usize = 8;
/// Names of the fields of each step, for tests.
const IDS: [[&str; 3]; SHOWN] = [
    ["step-level-1", "step-time-1", "step-size-1"],
    ["step-level-2", "step-time-2", "step-size-2"],
    ["step-level-3", "step-time-3", "step-size-3"],
    ["step-level-4", "step-time-4", "step-size-4"],
    ["step-level-5", "step-time-5", "step-size-5"],
    ["step-level-6", "step-time-6", "step-size-6"],
    ["step-level-7", "step-time-7", "step-size-7"],
    ["step-level-8", "step-time-8", "step-size-8"],
];

/// All steps.
#[component]
pub fn AllSteps() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let count = session.part(|s| s.experiment.set_point_steps.len());
    let count = Memo::new(move |_| count.get());
    let is_locked = lab.locks(locks::EXPERIMENT);
    let add = move |_| {
        session.edit(|s| {
            let steps = &mut s.experiment.set_point_steps;
            // After the last one, at the other level, where there is one.
            let (level, time_s) =
                steps.last().map_or((0, FIRST_STEP_AT_S), |last| (1 - last.level.min(1), last.time_s));
            steps.push(SetPointStep { level, time_s, size: 0.0 });
        });
    };
    let rows = move || (0..count.get().min(SHOWN)).map(|index| view! { <StepRow index /> }).collect_view();
    view! {
        <div class="steps" role="group" aria-label=say!(lab, experiment.steps) data-testid="all-steps">
            <p class="remark">{say!(lab, experiment.steps)}</p>
            {rows}
            <p class="remark" hidden=move || count.get() <= SHOWN data-testid="steps-not-shown">
                {move || tr!(lab, experiment.steps_not_shown, count = count.get().saturating_sub(SHOWN))}
            </p>
            <button
                type="button"
                class="button small"
                data-testid="step-add"
                disabled=move || { is_locked || count.get() >= SHOWN }
                on:click=add
            >
                {say!(lab, experiment.step_add)}
            </button>
        </div>
    }
}

/// A step: which level, when, how far.
#[component]
fn StepRow(index: usize) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let number = index + 1;
    let [level_id, time_id, size_id] = IDS[index.min(SHOWN - 1)];
    let disabled = lab.locks(locks::EXPERIMENT);
    let step = move |session: Session| {
        session.read(|s| s.experiment.set_point_steps.get(index).copied()).unwrap_or(SetPointStep {
            level: 0,
            time_s: 0.0,
            size: 0.0,
        })
    };
    let change = move |change: &dyn Fn(&mut SetPointStep)| {
        session.edit(|s| {
            if let Some(step) = s.experiment.set_point_steps.get_mut(index) {
                change(step);
            }
        });
    };
    let scale = move || per_metre(session.own.unit.get());
    let finer = move || finer_digits(session.own.unit.get());
    let size_limits = move || {
        let Limits { min, max } = limits::SET_POINT_STEP;
        (min * scale(), max * scale())
    };
    let remove = move |_| {
        session.edit(|s| {
            if index < s.experiment.set_point_steps.len() {
                s.experiment.set_point_steps.remove(index);
            }
        });
    };
    let levels = Signal::derive(move || {
        [0, 1]
            .map(|level| {
                Choice::new(level, format!("level{}", level + 1), tr!(lab, experiment.step_of, level = level + 1))
            })
            .to_vec()
    });
    view! {
        <div class="reference-step" role="group">
            <Select
                id=level_id
                name=say!(lab, experiment.step_level, number = number)
                choices=levels
                chosen=Signal::derive(move || step(session).level)
                on_choose=move |level: usize| change(&|step| step.level = level)
                disabled
            />
            <NumberField
                id=size_id
                name=say!(lab, experiment.step_size, number = number)
                value=Signal::derive(move || step(session).size * scale())
                on_change=move |size: f64| change(&|step| step.size = size / untrack(scale))
                limits=Signal::derive(size_limits)
                scale=Signal::derive(move || Scale::Linear(0.1).finer(finer()))
                digits=Signal::derive(move || Some(2 + finer()))
                disabled
            />
            <span class="unit">{move || unit_name(session.own.unit.get())}</span>
            <button
                type="button"
                class="button small"
                aria-label=say!(lab, experiment.step_remove, number = number)
                data-testid=format!("step-remove-{number}")
                disabled=disabled
                on:click=remove
            >
                "×"
            </button>
            <span class="unit at-time">{say!(lab, experiment.at)}</span>
            <NumberField
                id=time_id
                name=say!(lab, experiment.step_time, number = number)
                value=Signal::derive(move || step(session).time_s)
                on_change=move |time_s: f64| change(&|step| step.time_s = time_s)
                limits=Signal::stored((limits::TIME_S.min, limits::TIME_S.max))
                scale=Scale::Linear(10.0)
                digits=Some(0)
                disabled
            />
            <span class="unit">"s"</span>
        </div>
    }
}
