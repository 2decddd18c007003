//! The end of a lesson: points, and the report that is handed in.

use std::sync::Arc;

use leptos::html::H2;
use leptos::prelude::*;
use quadtank_lesson::{Answer, Lesson, Report, Task, TaskKind, points_of, start_of};

use super::classroom::{Classroom, tongue, use_classroom};
use super::panel::{focus_at_first, shown};
use super::place::absolute;
use super::{LessonLink, course, next_of};
use crate::download::{copy, download_text};
use crate::lab::{Lab, use_lab};
use crate::share::state_reference;
use crate::texts::{say, tr};

#[allow(clippy::needless_pass_by_value, reason = "properties of components are owned")]
/// What a student sees when the last step is done.
#[component]
pub fn Finish(lesson: Arc<Lesson>) -> impl IntoView {
    let (lab, room) = (use_lab(), use_classroom());
    let name = RwSignal::new(course::student().unwrap_or_default());
    let heading = NodeRef::<H2>::new();
    focus_at_first(heading);
    let title = shown(lab, &lesson, lesson.title.clone());
    let report = {
        let lesson = Arc::clone(&lesson);
        Memo::new(move |_| {
            room.progress.with(|progress| progress.as_ref().map(|p| Report::of(&lesson, p, &name.get())))
        })
    };
    let sum = {
        let lesson = Arc::clone(&lesson);
        move || {
            let points = room.progress.with(|progress| progress.as_ref().map_or(0, |p| p.points(&lesson)));
            let minutes = report.with(|report| report.as_ref().map_or(0, |report| report.seconds.div_ceil(60)));
            tr!(lab, lesson.sum, points = points, of = lesson.points(), minutes = minutes)
        }
    };
    let code = Signal::derive(move || report.with(|report| report.as_ref().map(Report::to_code).unwrap_or_default()));
    let save = {
        let id = lesson.id.clone();
        move |_| {
            let json = report.with_untracked(|report| serde_json::to_string_pretty(report).unwrap_or_default());
            download_text(&format!("quadtank-{id}.json"), "application/json", &json);
        }
    };
    let copied = RwSignal::new(false);
    let take = move |_| {
        let code = code.get_untracked();
        copy(&code, move |done| copied.set(done));
    };
    let next = next_of(&lesson.id).map(|id| {
        view! { <LessonLink id class="button strong" testid="lesson-on">{say!(lab, lesson.next_lesson)}</LessonLink> }
    });
    let rows =
        lesson.tasks().map(|(step, task)| view! { <TaskLine lesson=Arc::clone(&lesson) task=task.clone() step /> });
    let rows = rows.collect_view();
    view! {
        <aside class="lesson report" aria-label=title data-testid="report">
            <div class="lesson-text" tabindex="0">
                <h1 class="lesson-title">{title}</h1>
                <h2 tabindex="-1" node_ref=heading>{say!(lab, lesson.report)}</h2>
                <p class="sum">{sum}</p>
                <p class="remark" data-testid="report-seed">{say!(lab, lesson.seed, seed = seed(room))}</p>
                <label class="name">
                    {say!(lab, lesson.name)}
                    <input type="text" maxlength="80" autocomplete="name" data-testid="report-name" prop:value=move || name.get()
                        on:input=move |event| name.set(event_target_value(&event)) />
                </label>
                <ol class="report-lines">{rows}</ol>
                <p>{say!(lab, lesson.code_hint)}</p>
                <output class="code" data-testid="report-code">{move || code.get()}</output>
                <p class="links">
                    <button type="button" class="button" data-testid="copy-code" on:click=take>
                        {move || if copied.get() { tr!(lab, lesson.copied) } else { tr!(lab, lesson.copy_code) }}
                    </button>
                    <button type="button" class="button" data-testid="report-json" on:click=save>{say!(lab, lesson.save_json)}</button>
                    <button type="button" class="button" data-testid="report-print" on:click=|_| { let _ = window().print(); }>
                        {say!(lab, lesson.print)}
                    </button>
                </p>
            </div>
            <div class="turn">
                <button type="button" class="button" data-testid="lesson-back" on:click=move |_| room.at_end.set(false)>
                    {say!(lab, lesson.back)}
                </button>
                <span class="spacer"></span>
                {next}
                <button type="button" class="button" data-testid="report-leave" on:click=move |_| room.leave()>{say!(lab, lesson.leave)}</button>
            </div>
        </aside>
    }
}

/// A task in the report: what was asked, answered and reached.
#[component]
fn TaskLine(lesson: Arc<Lesson>, task: Task, step: usize) -> impl IntoView {
    let (lab, room) = (use_lab(), use_classroom());
    let record = untrack(|| room.followed_record(&task.id));
    let question = shown(lab, &lesson, task.question.clone());
    let is_answered = record.answer.is_some() || record.is_done();
    let state = record.state.clone().or_else(|| start_link(&lesson, step, seed(room)));
    let link = state.filter(|_| is_answered).map(|link| {
        view! { <a href=absolute(&state_reference(&link)) target="_blank" rel="noopener">{say!(lab, lesson.state)}</a> }
    });
    let points = (task.points > 0).then(|| {
        let reached = points_of(&task, &record);
        view! { <b>{format!("{reached}/{}", task.points)}</b> }
    });
    let tries = (record.wrong + record.hints > 0)
        .then(|| view! { <span class="remark">{move || tr!(lab, lesson.tries, wrong = record.wrong, hints = record.hints)}</span> });
    let answer = move || match &record.answer {
        Some(answer) => answer_words(lab, &lesson, &task, answer),
        None => tr!(lab, lesson.not_answered),
    };
    view! {
        <li>
            <p>{move || super::prose::inline(&question.get())}</p>
            <p class="answer">{answer} " " {points} " " {tries} " " {link}</p>
        </li>
    }
}

/// Seed from which the numbers of the student are drawn.
fn seed(room: Classroom) -> u32 {
    room.progress.with_untracked(|progress| progress.as_ref().map_or(0, |progress| progress.seed))
}

/// The link of the state with which a step begins, if it says one.
pub fn start_link(lesson: &Lesson, step: usize, seed: u32) -> Option<String> {
    start_of(lesson, lesson.steps.get(step)?, seed).ok()??.to_link().ok()
}

/// An answer in words.
fn answer_words(lab: Lab, lesson: &Lesson, task: &Task, answer: &Answer) -> String {
    let tongue = tongue(lab, lesson);
    match (&task.kind, answer) {
        (TaskKind::Predict(predict), Answer::Choice(index)) => {
            predict.options.get(*index).map(|text| text.shown(tongue).to_owned()).unwrap_or_default()
        }
        (TaskKind::Choose(choose), Answer::Choice(index)) => {
            choose.options.get(*index).map(|option| option.text.shown(tongue).to_owned()).unwrap_or_default()
        }
        (TaskKind::Number(number), Answer::Number(value)) => {
            // As it was typed, without digits of ours.
            let typed = value.to_string().replace('.', &lab.number_style().decimal.to_string());
            format!("{typed}\u{a0}{}", super::prose::unit_name(lab, &number.unit))
        }
        (TaskKind::Order(_), Answer::Order(order)) => {
            order.iter().map(|index| (index + 1).to_string()).collect::<Vec<_>>().join(" – ")
        }
        (_, Answer::Text(text)) => text.clone(),
        (_, Answer::Bench) => tr!(lab, lesson.reached_on_bench),
        _ => String::new(),
    }
}
