//! Lessons beside the benches: their list, their steps, and what is handed in. What is right is decided by `quadtank_lesson`.

mod answers;
mod catalogue;
mod classroom;
mod course;
mod finish;
mod kept;
mod load;
mod panel;
mod place;
mod prose;
mod task;
mod teachers;

use leptos::prelude::*;
use quadtank_lesson::{LESSON_IDS, read_lesson};
use wasm_bindgen_futures::spawn_local;

pub use catalogue::Catalogue;
pub use classroom::{Classroom, use_classroom};
pub use load::LoadError;
pub use panel::LessonPanel;
pub use place::{SidePage, lesson_address};
pub use teachers::Teachers;

use crate::lab::{Lab, Notice, use_lab};
use crate::texts::say;

/// Loads a lesson of the laboratory and begins it.
pub fn begin(lab: Lab, room: Classroom, id: String, step: Option<usize>) {
    spawn_local(async move {
        match load::load(&id).await {
            Ok(lesson) => {
                lab.side.set(None);
                room.begin(lesson, step);
            }
            Err(error) => lab.notice.set(Some(Notice::NoLesson(error))),
        }
    });
}

/// Begins the lesson of a file; one that is not a lesson is refused with its place, and nothing is lost.
pub fn begin_file(lab: Lab, room: Classroom, bytes: &[u8]) {
    match read_lesson(bytes) {
        Ok(lesson) => {
            lab.side.set(None);
            room.begin(lesson, Some(0));
        }
        Err(error) => lab.notice.set(Some(Notice::NoLesson(LoadError::Refused(error)))),
    }
}

/// Begins what the address or the page itself asks for.
pub fn begin_asked(lab: Lab, room: Classroom) {
    // A package for a course has its lesson inside.
    if let Some(text) = load::inside("lesson") {
        course::begin();
        return begin_file(lab, room, text.as_bytes());
    }
    let (id, step) = lab.flags.with_value(|flags| (flags.lesson.clone(), flags.step));
    if let Some(id) = id {
        course::begin();
        begin(lab, room, id, step);
    }
}

/// The way from a first visit to the first lesson, and to the page for teachers.
#[component]
pub fn FirstLesson() -> impl IntoView {
    /// About how long the first lesson takes (min); its file says the same.
    const MINUTES: u32 = 8;
    let (lab, room) = (use_lab(), use_classroom());
    let go = move |event: leptos::ev::MouseEvent| {
        if !(event.ctrl_key() || event.meta_key() || event.shift_key()) {
            event.prevent_default();
            begin(lab, room, LESSON_IDS[0].to_owned(), None);
        }
    };
    let to_teachers = move |event: leptos::ev::MouseEvent| {
        event.prevent_default();
        crate::share::go_to_page(lab, SidePage::Teachers);
    };
    let is_embed = lab.flags.with_value(|flags| flags.embed);
    view! {
        <p class="ways" hidden=is_embed>
            <a class="button strong" href=lesson_address(LESSON_IDS[0]) data-testid="first-lesson" on:click=go>
                {say!(lab, lesson.first, number = 1, minutes = MINUTES)}
            </a>
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
