//! What the browser keeps of lessons, if the student agrees; else it is remembered until the page is closed.

use std::cell::RefCell;
use std::collections::HashMap;

use leptos::prelude::window;
use quadtank_lesson::{Lesson, Progress};

use crate::storage::LESSONS_KEPT;

/// What the names of kept lessons begin with.
const PREFIX: &str = "quadtank-lesson-";

thread_local! {
    /// What was done since the page was opened, by lesson.
    static MEMORY: RefCell<HashMap<String, Progress>> = RefCell::new(HashMap::new());
}

/// Whether the student agreed that the browser keeps progress.
pub fn is_agreed() -> bool {
    LESSONS_KEPT.read().as_deref() == Some("yes")
}

/// Agrees, or withdraws: then what was kept is deleted.
pub fn agree(agrees: bool) {
    LESSONS_KEPT.write(if agrees { "yes" } else { "no" });
    MEMORY.with_borrow(|memory| {
        for progress in memory.values() {
            if agrees {
                write(progress);
            } else {
                remove(&progress.lesson);
            }
        }
    });
    if !agrees {
        for id in quadtank_lesson::LESSON_IDS {
            remove(id);
        }
    }
}

/// What was done in a lesson.
pub fn read(lesson: &Lesson) -> Option<Progress> {
    known(&lesson.id).filter(|progress| progress.is_of(lesson))
}

/// What was done in the lesson with an id, of whatever edition.
pub fn known(id: &str) -> Option<Progress> {
    let memory = MEMORY.with_borrow(|memory| memory.get(id).cloned());
    memory.or_else(|| {
        let text = window().local_storage().ok()??.get_item(&format!("{PREFIX}{id}")).ok()??;
        serde_json::from_str(&text).ok()
    })
}

/// Keeps what was done.
pub fn write(progress: &Progress) {
    if is_agreed()
        && let (Ok(Some(storage)), Ok(text)) = (window().local_storage(), serde_json::to_string(progress))
    {
        let _ = storage.set_item(&format!("{PREFIX}{}", progress.lesson), &text);
    }
    // Borrowed already while the student agrees, and then it is there.
    MEMORY.with(|memory| {
        if let Ok(mut memory) = memory.try_borrow_mut() {
            memory.insert(progress.lesson.clone(), progress.clone());
        }
    });
}

/// Forgets what was done in a lesson.
pub fn forget(id: &str) {
    MEMORY.with_borrow_mut(|memory| memory.remove(id));
    remove(id);
}

fn remove(id: &str) {
    if let Ok(Some(storage)) = window().local_storage() {
        let _ = storage.remove_item(&format!("{PREFIX}{id}"));
    }
}

/// A number from which the numbers of a new student follow.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it lies between 0 and a million")]
pub fn new_seed() -> u32 {
    (js_sys::Math::random() * 1e6) as u32
}
