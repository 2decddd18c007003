//! The ways in which a task is answered.

use std::sync::Arc;

use gloo_timers::callback::Timeout;
use leptos::prelude::*;
use quadtank_lesson::{Achieve, Answer, Feedback, NumberTask, Task, TaskKind, goals, shuffled};

use super::classroom::{Present, use_classroom};
use super::prose::{inline, unit_name, written};
use super::task::kept_answer;
use crate::format::NumberStyle;
use crate::lab::use_lab;
use crate::texts::{say, tr};

/// Whether a task needs no answer any more.
fn is_done(id: &str) -> Signal<bool> {
    let (room, id) = (use_classroom(), id.to_owned());
    Memo::new(move |_| room.followed_record(&id).is_done()).into()
}

/// The button that marks an answer.
#[component]
fn CheckButton(
    #[prop(into)] id: String,
    name: Signal<String>,
    disabled: Signal<bool>,
    on_check: Callback<()>,
) -> impl IntoView {
    view! {
        <button
            type="button"
            class="button strong small"
            data-testid=format!("check-{id}")
            disabled=disabled
            on:click=move |_| on_check.run(())
        >
            {name}
        </button>
    }
}

/// Options of which one is chosen: of a prediction or of a question.
#[component]
pub fn Choices(task: Arc<Task>, options: Vec<Signal<String>>) -> impl IntoView {
    let (lab, room) = (use_lab(), use_classroom());
    let done = is_done(&task.id);
    let chosen = RwSignal::new(match kept_answer(&task.id) {
        Some(Answer::Choice(index)) => Some(index),
        _ => None,
    });
    let right: Vec<bool> = match &task.kind {
        TaskKind::Choose(choose) => choose.options.iter().map(|option| option.correct).collect(),
        _ => vec![false; options.len()],
    };
    let group = format!("task-{}", task.id);
    let option = |(index, (text, is_right)): (usize, (Signal<String>, bool))| {
        let class = move || if done.get() && is_right { "option right" } else { "option" };
        view! {
            <label class=class>
                <input
                    type="radio"
                    name=group.clone()
                    value=index
                    data-testid=format!("{group}-{index}")
                    prop:checked=move || chosen.get() == Some(index)
                    disabled=done
                    on:change=move |_| chosen.set(Some(index))
                />
                <span>{move || inline(&text.get())}</span>
            </label>
        }
    };
    let list = options.into_iter().zip(right).enumerate().map(option).collect_view();
    let name = if task.kind.is_marked() { say!(lab, lesson.check) } else { say!(lab, lesson.commit) };
    let disabled = Signal::derive(move || done.get() || chosen.get().is_none());
    let id = task.id.clone();
    let on_check = Callback::new(move |()| {
        if let Some(index) = chosen.get_untracked() {
            room.answer(&task, Answer::Choice(index));
        }
    });
    view! { <div class="options">{list}</div> <CheckButton id name disabled on_check /> }
}

/// A number with its unit, read as in every other field.
#[component]
pub fn NumberAnswer(task: Arc<Task>, number: NumberTask) -> impl IntoView {
    let (lab, room) = (use_lab(), use_classroom());
    let done = is_done(&task.id);
    let kept = match kept_answer(&task.id) {
        Some(Answer::Number(value)) => untrack(|| lab.number_style().significant(value, 6)),
        _ => String::new(),
    };
    let text = RwSignal::new(kept);
    let bad = RwSignal::new(false);
    let id = task.id.clone();
    let check = Callback::new(move |()| match NumberStyle::parse(&text.get_untracked()) {
        Some(value) => {
            bad.set(false);
            room.answer(&task, Answer::Number(value));
        }
        None => bad.set(true),
    });
    let disabled = Signal::derive(move || done.get() || text.with(|text| text.trim().is_empty()));
    let unit = move || unit_name(lab, &number.unit);
    let described = format!("{id}-bad");
    view! {
        <div class="number-answer">
            <input
                type="text"
                inputmode="text"
                autocomplete="off"
                maxlength="24"
                data-testid=format!("number-{id}")
                aria-label=say!(lab, lesson.your_number)
                aria-invalid=move || bad.get().then_some("true")
                aria-describedby=described.clone()
                prop:value=move || text.get()
                disabled=done
                on:input=move |event| text.set(event_target_value(&event))
                on:keydown=move |event| if event.key() == "Enter" && !disabled.get_untracked() { check.run(()) }
            />
            <span class="unit">{unit}</span>
            <CheckButton id name=say!(lab, lesson.check) disabled on_check=check />
            <span class="bad" id=described role="status">{move || bad.get().then(|| tr!(lab, lesson.no_number))}</span>
        </div>
    }
}

/// How long a goal has to hold until it is reached (ms).
const HOLDS_MS: u32 = 400;

/// The conditions of a goal, ticked as they are met on the bench.
#[component]
pub fn GoalList(task: Arc<Task>, goal: Achieve, labels: Vec<Signal<String>>) -> impl IntoView {
    let (lab, room) = (use_lab(), use_classroom());
    let done = is_done(&task.id);
    let solved = {
        let id = task.id.clone();
        Memo::new(move |_| room.followed_record(&id).solved)
    };
    let now = {
        let goal = goal.clone();
        // What was reached stays as it was then, whatever the student tries afterwards.
        Memo::new(move |before: Option<&Vec<quadtank_lesson::Goal>>| match before.filter(|_| solved.get()) {
            Some(reached) => reached.clone(),
            None => goals(&goal, &Present(lab)),
        })
    };
    let verdict = {
        let task = Arc::clone(&task);
        Memo::new(move |_| room.marked(&task, &Answer::Bench))
    };
    // The goal needs no button: it is reached when it holds for a moment, not while a slider passes by. What a typical attempt shows
    // is said while it stands.
    let holding = StoredValue::new_local(None::<Timeout>);
    Effect::new(move || {
        let verdict = verdict.get();
        holding.set_value(None);
        if untrack(|| done.get()) {
            return;
        }
        if verdict.is_right {
            let task = Arc::clone(&task);
            holding.set_value(Some(Timeout::new(HOLDS_MS, move || {
                room.answer(&task, Answer::Bench);
            })));
        } else {
            let said =
                verdict.feedback.filter(|said| matches!(said, Feedback::Attempt(_)) && untrack(|| room.has_tried()));
            room.say_in_passing(&task.id, said);
        }
    });
    let row = |(index, (condition, label)): (usize, (quadtank_lesson::Condition, Signal<String>))| {
        let state = move || now.with(|goals| goals.get(index).copied());
        let met = move || state().is_some_and(|goal| goal.is_met);
        let is_truth = condition.unit == "yes/no";
        let value = move || {
            let value = written(lab, state().and_then(|goal| goal.value), &condition.unit, 3);
            let lead = if solved.get() { tr!(lab, lesson.was) } else { tr!(lab, lesson.now) };
            (!is_truth).then(|| view! { " — " {lead} " " <b>{value}</b> })
        };
        view! {
            <li class:met=met>
                <span class="tick" aria-hidden="true">{move || if met() { "✓" } else { "○" }}</span>
                <span class="visually-hidden">
                    {move || if met() { tr!(lab, lesson.met) } else { tr!(lab, lesson.not_met) }}
                </span>
                <span>{move || inline(&label.get())} {value}</span>
            </li>
        }
    };
    let rows = goal.conditions.into_iter().zip(labels).enumerate().map(row).collect_view();
    view! { <ul class="goals" data-testid="goals">{rows}</ul> }
}

/// Items that are put in order by buttons.
#[component]
pub fn Ordering(task: Arc<Task>, items: Vec<Signal<String>>) -> impl IntoView {
    let (lab, room) = (use_lab(), use_classroom());
    let done = is_done(&task.id);
    let count = items.len();
    let is_shown = untrack(|| room.followed_record(&task.id)).shown;
    let order = RwSignal::new(match kept_answer(&task.id) {
        _ if is_shown => (0..count).collect(),
        Some(Answer::Order(order)) => order,
        _ => first_order(count, &task.id),
    });
    let swap = move |place: usize| order.update(|order| order.swap(place, place + 1));
    let items = StoredValue::new(items);
    let row = move |place: usize| {
        let text = move || {
            let item = order.with(|order| order.get(place).copied()).unwrap_or_default();
            inline(&items.with_value(|items| items[item].get()))
        };
        view! {
            <li>
                <span>{text}</span>
                <button type="button" class="button small" aria-label=say!(lab, lesson.up) disabled=move || done.get() || place == 0
                    data-testid=format!("up-{place}") on:click=move |_| swap(place - 1)>"↑"</button>
                <button type="button" class="button small" aria-label=say!(lab, lesson.down)
                    disabled=move || done.get() || place + 1 == count
                    data-testid=format!("down-{place}") on:click=move |_| swap(place)>"↓"</button>
            </li>
        }
    };
    let id = task.id.clone();
    // A solution that is shown is the order itself.
    let on_check = Callback::new(move |()| {
        room.answer(&task, Answer::Order(order.get_untracked()));
        if untrack(|| room.followed_record(&task.id)).shown {
            order.set((0..count).collect());
        }
    });
    view! {
        <ol class="ordering">{(0..count).map(row).collect_view()}</ol>
        <CheckButton id name=say!(lab, lesson.check) disabled=done on_check />
    }
}

/// An order that is not the right one.
fn first_order(count: usize, id: &str) -> Vec<usize> {
    let room = use_classroom();
    let seed = room.progress.with_untracked(|progress| progress.as_ref().map_or(0, |progress| progress.seed));
    let mut order = shuffled(count, seed, id);
    if order.is_sorted() {
        order.reverse();
    }
    order
}

/// Free text.
#[component]
pub fn Words(task: Arc<Task>) -> impl IntoView {
    /// Longest answer (characters).
    const LONGEST: &str = "2000";
    let (lab, room) = (use_lab(), use_classroom());
    let done = is_done(&task.id);
    let text = RwSignal::new(match kept_answer(&task.id) {
        Some(Answer::Text(text)) => text,
        _ => String::new(),
    });
    let id = task.id.clone();
    let disabled = Signal::derive(move || done.get() || text.with(|text| text.trim().is_empty()));
    let on_check = Callback::new(move |()| {
        room.answer(&task, Answer::Text(text.get_untracked()));
    });
    view! {
        <textarea
            rows="3"
            maxlength=LONGEST
            data-testid=format!("words-{id}")
            aria-label=say!(lab, lesson.your_words)
            prop:value=move || text.get()
            disabled=done
            on:input=move |event| text.set(event_target_value(&event))
        ></textarea>
        <CheckButton id name=say!(lab, lesson.hand_in) disabled on_check />
    }
}
