//! The text and the tasks of a step, beside the bench.

use std::sync::Arc;
use std::time::Duration;

use leptos::context::Provider;
use leptos::html::H2;
use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;
use quadtank_lesson::{Answer, Lesson, Step, Task, TaskKind};

use super::catalogue::KeepProgress;
use super::changed::WhatWasSet;
use super::classroom::{Classroom, tongue, use_classroom};
use super::finish::Finish;
use super::prose::{Prose, Still};
use super::task::TaskView;
use super::{course, kept};
use crate::lab::{Lab, use_lab};
use crate::texts::{say, tr};

/// The lesson that is taken; nothing without one.
#[component]
pub fn LessonPanel() -> impl IntoView {
    let room = use_classroom();
    let at = Memo::new(move |_| {
        let step = room.progress.with(|progress| progress.as_ref().map(|progress| progress.step));
        let id = room.lesson.with(|lesson| lesson.as_ref().map(|lesson| lesson.id.clone()));
        (id, step, room.at_end.get())
    });
    move || {
        let (_, step, at_end) = at.get();
        let lesson = room.lesson.get_untracked()?;
        let index = step?;
        Some(if at_end {
            view! { <Finish lesson /> }.into_any()
        } else {
            view! { <StepPanel step=lesson.steps.get(index)?.clone() index lesson /> }.into_any()
        })
    }
}

/// A text of a lesson in the language of the page.
pub fn shown(lab: Lab, lesson: &Arc<Lesson>, text: quadtank_lesson::Text) -> Signal<String> {
    let lesson = Arc::clone(lesson);
    Signal::derive(move || text.shown(tongue(lab, &lesson)).to_owned())
}

/// Whoever goes on by keyboard or screen reader begins at a title.
pub fn focus_at_first(heading: NodeRef<H2>) {
    Effect::new(move || {
        if let Some(heading) = heading.get() {
            let _ = heading.focus();
        }
    });
}

/// On a phone the bench has a window of its own below the text, which the step before may have left scrolled: what a step is about stands
/// at its top.
fn show_bench_from_its_top() {
    if let Ok(windows) = document().query_selector_all(".desk > div") {
        for window in (0..windows.length()).filter_map(|index| windows.item(index)) {
            window.unchecked_into::<web_sys::Element>().set_scroll_top(0);
        }
    }
}

#[component]
fn StepPanel(lesson: Arc<Lesson>, step: Step, index: usize) -> impl IntoView {
    let (lab, room) = (use_lab(), use_classroom());
    let heading = NodeRef::<H2>::new();
    if room.turned() {
        focus_at_first(heading);
        show_bench_from_its_top();
    }
    let count = lesson.steps.len();
    let is_kept = kept::is_agreed() || course::is_there();
    let is_done = Memo::new({
        let lesson = Arc::clone(&lesson);
        move |_| room.progress.with(|progress| progress.as_ref().is_some_and(|p| p.is_step_done(&lesson, index)))
    });
    let title = shown(lab, &lesson, step.title.clone());
    let lesson_title = shown(lab, &lesson, lesson.title.clone());
    let text = shown(lab, &lesson, step.text.clone());
    let after = step.after.clone().map(|after| {
        let after = shown(lab, &lesson, after);
        let predicted = step.tasks.iter().filter_map(|task| predicted(lab, &lesson, task)).collect_view();
        let still = stands_still(is_done);
        view! {
            <div class="after" hidden=move || !is_done.get() data-testid="after">
                {predicted}
                <Provider value=still><Prose text=after /></Provider>
            </div>
        }
    });
    let tasks = step.tasks.iter().cloned().map(|task| {
        let lesson = Arc::clone(&lesson);
        view! { <TaskView lesson task index /> }
    });
    view! {
        <aside class="lesson" aria-label=lesson_title data-testid="lesson">
            <div class="lesson-text" tabindex="0">
                <Dots lesson=Arc::clone(&lesson) index />
                <h1 class="lesson-title">{lesson_title}</h1>
                <h2 tabindex="-1" node_ref=heading data-testid="step-title">
                    {move || tr!(lab, lesson.step, number = index + 1, title = title.get())}
                </h2>
                <WhatWasSet />
                <Prose text />
                {tasks.collect_view()}
                {after}
                // A reload would begin anew, unless the browser keeps what was done; a course keeps it itself.
                {(!is_kept).then(|| view! { <KeepProgress /> })}
            </div>
            <Turn room lab index count is_done=is_done.into() />
        </aside>
    }
}

/// What is said about a solved step keeps the numbers of then, whatever the student tries afterwards.
fn stands_still(is_done: Memo<bool>) -> Still {
    /// By then the results have followed a solution that was shown (ms).
    const FOLLOWED_MS: u64 = 600;
    let still = RwSignal::new(false);
    Effect::new(move || {
        if is_done.get() {
            set_timeout(
                move || {
                    still.try_set(true);
                },
                Duration::from_millis(FOLLOWED_MS),
            );
        }
    });
    Still(still)
}

/// What the student predicted, beside what is said once the step is done.
fn predicted(lab: Lab, lesson: &Arc<Lesson>, task: &Task) -> Option<impl IntoView + use<>> {
    let TaskKind::Predict(predict) = &task.kind else { return None };
    let options: Vec<_> = predict.options.iter().map(|text| shown(lab, lesson, text.clone())).collect();
    let (room, id) = (use_classroom(), task.id.clone());
    let chosen = move || match room.followed_record(&id).answer {
        Some(Answer::Choice(index)) => options.get(index).map(Signal::get),
        _ => None,
    };
    Some(view! { <p class="remark">{move || chosen().map(|option| tr!(lab, lesson.predicted, option = option))}</p> })
}

/// How far the lesson is, a mark for each step.
#[component]
fn Dots(lesson: Arc<Lesson>, index: usize) -> impl IntoView {
    let (lab, room) = (use_lab(), use_classroom());
    let count = lesson.steps.len();
    let dots = (0..count).map(|step| {
        let lesson = Arc::clone(&lesson);
        let class = move || {
            let done = room.progress.with(|progress| progress.as_ref().is_some_and(|p| p.is_step_done(&lesson, step)));
            match (step == index, done) {
                (true, _) => "here",
                (false, true) => "done",
                (false, false) => "",
            }
        };
        view! { <i class=class></i> }
    });
    let name = move || tr!(lab, lesson.progress, number = index + 1, count = count);
    view! { <div class="dots" role="img" aria-label=name>{dots.collect_view()}</div> }
}

/// Brings the first task of a step that is not done into sight.
fn show_open_task(room: Classroom, index: usize) {
    let open = room.lesson.with_untracked(|lesson| {
        let tasks = lesson.as_ref().and_then(|lesson| lesson.steps.get(index)).map(|step| &step.tasks)?;
        let is_open =
            |task: &&Task| room.progress.with_untracked(|p| p.as_ref().is_some_and(|p| !p.record(&task.id).is_done()));
        Some(format!("[data-testid=\"task-{}\"]", tasks.iter().find(is_open)?.id))
    });
    if let Some(task) = open.and_then(|selector| document().query_selector(&selector).ok().flatten()) {
        task.scroll_into_view();
    }
}

/// Back, start over, and on.
#[component]
fn Turn(room: Classroom, lab: Lab, index: usize, count: usize, is_done: Signal<bool>) -> impl IntoView {
    let is_last = index + 1 == count;
    let is_blocked = RwSignal::new(false);
    let on = move |_| {
        if !is_done.get_untracked() {
            is_blocked.set(true);
            show_open_task(room, index);
        } else if is_last {
            room.at_end.set(true);
        } else {
            room.turn_to(index + 1);
        }
    };
    let name = if is_last { say!(lab, lesson.finish) } else { say!(lab, lesson.next) };
    view! {
        <div class="turn">
            <p class="blocked" role="status" data-testid="lesson-blocked">
                {move || (is_blocked.get() && !is_done.get()).then(|| tr!(lab, lesson.answer_first))}
            </p>
            <button type="button" class="button" data-testid="lesson-back" disabled={index == 0} on:click=move |_| room.turn_to(index - 1)>
                {say!(lab, lesson.back)}
            </button>
            <button type="button" class="button" data-testid="lesson-restart" on:click=move |_| room.start_over()>
                {say!(lab, lesson.start_over)}
            </button>
            <span class="spacer"></span>
            <button
                type="button"
                class="button strong"
                data-testid="lesson-next"
                aria-disabled=move || (!is_done.get()).then_some("true")
                title=move || if is_done.get() { String::new() } else { tr!(lab, lesson.answer_first) }
                on:click=on
            >
                {name}
            </button>
        </div>
    }
}
