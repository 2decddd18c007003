//! The list of all lessons.

use std::sync::Arc;

use leptos::prelude::*;
use quadtank_lesson::{LESSON_IDS, Lesson};

use super::classroom::{tongue, use_classroom};
use super::{LessonLink, kept, load};
use crate::lab::use_lab;
use crate::texts::{say, tr};
use crate::widgets::Tick;

/// All lessons with minutes, outcome and progress.
#[component]
pub fn Catalogue() -> impl IntoView {
    let lab = use_lab();
    let lessons = load::all();
    let rows = LESSON_IDS.iter().enumerate().map(|(index, id)| {
        let lesson = Signal::derive(move || lessons.with(|lessons| lessons.get(index).cloned().flatten()));
        view! { <LessonRow id number=index + 1 lesson /> }
    });
    view! {
        <main class="side-page lessons" id="bench" tabindex="-1" data-testid="lessons">
            <h2>{say!(lab, lesson.list)}</h2>
            <p class="lead">{say!(lab, lesson.list_lead)}</p>
            <KeepProgress />
            <ol class="lesson-list">{rows.collect_view()}</ol>
            <OwnFile />
        </main>
    }
}

/// Whether the browser keeps progress: the student decides.
#[component]
pub fn KeepProgress() -> impl IntoView {
    let lab = use_lab();
    let agreed = RwSignal::new(kept::is_agreed());
    let on_agree = Callback::new(move |agrees: bool| {
        kept::agree(agrees);
        agreed.set(agrees);
    });
    view! { <Tick id="keep-progress" text=say!(lab, lesson.keep) ticked=agreed disabled=false on_tick=on_agree /> }
}

#[component]
fn LessonRow(id: &'static str, number: usize, lesson: Signal<Option<Arc<Lesson>>>) -> impl IntoView {
    let lab = use_lab();
    let forgotten = Trigger::new();
    let known = Memo::new(move |_| {
        forgotten.track();
        kept::known(id)
    });
    let state = move || {
        let (lesson, progress) = (lesson.get()?, known.get()?);
        let points = progress.points(&lesson);
        Some(if progress.is_complete(&lesson) {
            tr!(lab, lesson.done, points = points, of = lesson.points())
        } else {
            tr!(lab, lesson.going_on, step = progress.step + 1, count = lesson.steps.len())
        })
    };
    let forget = move |_| {
        kept::forget(id);
        forgotten.notify();
    };
    let content = move || {
        let lesson = lesson.get()?;
        let language = tongue(lab, &lesson);
        let outcomes =
            lesson.outcomes.iter().map(|text| view! { <li>{text.shown(language).to_owned()}</li> }).collect_view();
        Some(view! {
            <p>{lesson.summary.shown(language).to_owned()}</p>
            <ul class="outcomes">{outcomes}</ul>
        })
    };
    let title = move || match lesson.get() {
        Some(lesson) => lesson.title.shown(tongue(lab, &lesson)).to_owned(),
        None => "…".to_owned(),
    };
    let minutes = move || lesson.get().map(|lesson| tr!(lab, lesson.minutes, minutes = lesson.minutes));
    let name = move || if known.get().is_some() { tr!(lab, lesson.resume) } else { tr!(lab, lesson.begin) };
    view! {
        <li data-testid=format!("lesson-{id}")>
            <header>
                <h3><span class="number">{number}</span> {title}</h3>
                <span class="remark">{minutes}</span>
            </header>
            {content}
            <p class="links">
                <LessonLink id class="button strong" testid=format!("begin-{id}")>{name}</LessonLink>
                <span class="remark">{state}</span>
                <button type="button" class="button small" hidden=move || known.get().is_none() on:click=forget>{say!(lab, lesson.forget)}</button>
            </p>
        </li>
    }
}

/// A lesson of one's own, from a file.
#[component]
pub fn OwnFile() -> impl IntoView {
    let (lab, room) = (use_lab(), use_classroom());
    let picker = NodeRef::<leptos::html::Input>::new();
    let on_file = move |_| {
        let Some(input) = picker.get_untracked() else { return };
        if let Some(file) = input.files().and_then(|files| files.get(0)) {
            crate::share::read_file(lab, &file, quadtank_lesson::LESSON_LIMIT, move |bytes| {
                super::begin_file(lab, room, &bytes);
            });
        }
        // The same file can then be opened again.
        input.set_value("");
    };
    view! {
        <p class="links">
            <button type="button" class="button" data-testid="open-lesson" on:click=move |_| if let Some(input) = picker.get_untracked() { input.click() }>
                {say!(lab, lesson.open_file)}
            </button>
            <span class="remark">{say!(lab, lesson.open_hint)}</span>
            <input type="file" accept=".json,application/json" hidden node_ref=picker data-testid="open-lesson-input" on:change=on_file />
        </p>
    }
}
