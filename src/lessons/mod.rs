//! Lessons beside the benches: their list, their steps, and what is handed in. What is right is decided by `quadtank_lesson`.

mod answers;
mod catalogue;
mod changed;
mod classroom;
mod course;
mod finish;
mod kept;
mod load;
mod panel;
mod place;
mod prose;
mod remarks;
mod task;
mod teachers;

use std::cell::Cell;

use leptos::prelude::*;
use quadtank_lesson::{LESSON_IDS, Lesson, read_lesson};
use wasm_bindgen_futures::spawn_local;

pub use catalogue::Catalogue;
pub use classroom::{Classroom, use_classroom};
pub use load::LoadError;
pub use panel::LessonPanel;
use place::lesson_address;
pub use place::{SidePage, absolute};
pub use teachers::{LessonFiles, Teachers};

use crate::lab::{Lab, Notice, use_lab};
use crate::share;
use crate::texts::say;

/// Loads a lesson of the laboratory and begins it as a step of the browser's history, so that Back leaves it.
pub fn begin(lab: Lab, room: Classroom, id: &str) {
    load_and(lab, id.to_owned(), move |name, lesson| go_on_with(lab, room, name, lesson));
}

/// Begins a lesson at an address that is there already.
fn begin_here(lab: Lab, room: Classroom, name: String, step: Option<usize>) {
    load_and(lab, name, move |name, lesson| {
        lab.side.set(None);
        room.begin(name, lesson, step);
    });
}

fn go_on_with(lab: Lab, room: Classroom, name: String, lesson: Lesson) {
    share::go_on_to(lab, &share::lesson_reference(&name, 0));
    lab.side.set(None);
    room.begin(name, lesson, None);
}

thread_local! {
    /// Counts requests for lessons and steps in the browser's history, so that a late lesson can be recognised.
    static TURNS: Cell<u32> = const { Cell::new(0) };
}

/// Loads a lesson. One that arrives when the reader has gone elsewhere is let go.
fn load_and(lab: Lab, name: String, then: impl FnOnce(String, Lesson) + 'static) {
    let place = move || (TURNS.get(), lab.bench.get_untracked().id, lab.side.get_untracked());
    TURNS.set(TURNS.get().wrapping_add(1));
    let asked_at = place();
    spawn_local(async move {
        let outcome = load::load(&name).await;
        if place() != asked_at {
            return;
        }
        match outcome {
            Ok(lesson) => then(name, lesson),
            Err(error) => lab.notice.set(Some(Notice::NoLesson(error))),
        }
    });
}

/// Begins the lesson of a file; one that is not a lesson is refused with its place, and nothing is lost.
pub fn begin_file(lab: Lab, room: Classroom, bytes: &[u8]) {
    match read_lesson(bytes) {
        Ok(lesson) => go_on_with(lab, room, load::remember(&lesson), lesson),
        Err(error) => lab.notice.set(Some(Notice::NoLesson(LoadError::Refused(error)))),
    }
}

/// Begins what the address or the page itself asks for.
pub fn begin_asked(lab: Lab, room: Classroom) {
    // A package for a course has its lesson inside.
    if let Some(text) = load::inside("lesson") {
        course::begin();
        return match read_lesson(text.as_bytes()) {
            Ok(lesson) => room.begin(lesson.id.clone(), lesson, None),
            Err(error) => lab.notice.set(Some(Notice::NoLesson(LoadError::Refused(error)))),
        };
    }
    let (name, step) = lab.flags.with_value(|flags| (flags.lesson.clone(), flags.step));
    if let Some(name) = name {
        course::begin();
        begin_here(lab, room, name, step);
    }
}

/// Shows what the address asks for after a step in the browser's history: a lesson, or what there is without one.
pub fn follow_address(lab: Lab, room: Classroom) {
    TURNS.set(TURNS.get().wrapping_add(1));
    let flags = share::asked(lab);
    match flags.lesson {
        Some(name) if room.is_in(&name) => room.open(flags.step.unwrap_or_default()),
        Some(name) => begin_here(lab, room, name, flags.step),
        None => {
            room.end();
            share::follow_address(lab);
        }
    }
}

/// Whether a click is for this page, not for another tab or window; then the browser leaves it alone.
pub fn is_for_here(event: &leptos::ev::MouseEvent) -> bool {
    let is_here = !(event.ctrl_key() || event.meta_key() || event.shift_key());
    if is_here {
        event.prevent_default();
    }
    is_here
}

/// The link to a lesson, which begins in this page.
#[component]
pub fn LessonLink(
    /// The lesson.
    id: &'static str,
    /// Class of the link.
    class: &'static str,
    /// Name for tests.
    #[prop(into)]
    testid: String,
    /// What it says.
    children: Children,
) -> impl IntoView {
    let (lab, room) = (use_lab(), use_classroom());
    let go = move |event| {
        if is_for_here(&event) {
            begin(lab, room, id);
        }
    };
    view! { <a class=class href=lesson_address(id) data-testid=testid on:click=go>{children()}</a> }
}

/// The way from a first visit to the first lesson, and to the page for teachers.
#[component]
pub fn FirstLesson() -> impl IntoView {
    /// About how long the first lesson takes (min); its file says the same.
    const MINUTES: u32 = 8;
    let lab = use_lab();
    let to_teachers = move |event| {
        if is_for_here(&event) {
            share::go_to_page(lab, SidePage::Teachers);
        }
    };
    let is_embed = lab.flags.with_value(|flags| flags.embed);
    view! {
        <p class="ways" hidden=is_embed>
            <LessonLink id=LESSON_IDS[0] class="button strong" testid="first-lesson">
                {say!(lab, lesson.first, number = 1, minutes = MINUTES)}
            </LessonLink>
            <a class="button" href=SidePage::Teachers.address() data-testid="first-teachers" on:click=to_teachers>
                {say!(lab, lesson.teachers)}
            </a>
        </p>
    }
}

/// The lesson after one.
pub fn next_of(id: &str) -> Option<&'static str> {
    let place = LESSON_IDS.iter().position(|known| *known == id)?;
    LESSON_IDS.get(place + 1).copied()
}
