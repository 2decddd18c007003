//! What the browser keeps of lessons, if the student agrees; else it is remembered until the page is closed.

use std::cell::RefCell;
use std::collections::HashMap;

use leptos::prelude::window;
use quadtank_lesson::{Lesson, Progress};
use web_sys::Storage;

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

/// Agrees, or withdraws: then what was kept is deleted, of whatever lesson and visit.
pub fn agree(agrees: bool) {
    LESSONS_KEPT.write(if agrees { "yes" } else { "no" });
    if agrees {
        MEMORY.with_borrow(|memory| memory.values().for_each(store));
    } else if let Some(storage) = storage() {
        for name in kept_names(&storage) {
            let _ = storage.remove_item(&name);
        }
    }
}

/// The names of all lessons that are kept, those of an instructor's own files among them.
fn kept_names(storage: &Storage) -> Vec<String> {
    let count = storage.length().unwrap_or_default();
    let names = (0..count).filter_map(|index| storage.key(index).ok().flatten());
    names.filter(|name| name.starts_with(PREFIX)).collect()
}

/// What was done in a lesson.
pub fn read(lesson: &Lesson) -> Option<Progress> {
    known(&lesson.id).filter(|progress| progress.is_of(lesson))
}

/// What was done in the lesson with an id, of whatever edition.
pub fn known(id: &str) -> Option<Progress> {
    let memory = MEMORY.with_borrow(|memory| memory.get(id).cloned());
    memory.or_else(|| {
        let text = storage()?.get_item(&name_of(id)).ok()??;
        serde_json::from_str(&text).ok()
    })
}

/// Keeps what was done.
pub fn write(progress: &Progress) {
    if is_agreed() {
        store(progress);
    }
    MEMORY.with_borrow_mut(|memory| memory.insert(progress.lesson.clone(), progress.clone()));
}

/// Puts what was done into the storage of the browser, if there is one.
fn store(progress: &Progress) {
    if let (Some(storage), Ok(text)) = (storage(), serde_json::to_string(progress)) {
        let _ = storage.set_item(&name_of(&progress.lesson), &text);
    }
}

/// Forgets what was done in a lesson.
pub fn forget(id: &str) {
    MEMORY.with_borrow_mut(|memory| memory.remove(id));
    if let Some(storage) = storage() {
        let _ = storage.remove_item(&name_of(id));
    }
}

fn storage() -> Option<Storage> {
    window().local_storage().ok()?
}

fn name_of(id: &str) -> String {
    format!("{PREFIX}{id}")
}

/// A number from which the numbers of a new student follow.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it lies between 0 and a million")]
pub fn new_seed() -> u32 {
    (js_sys::Math::random() * 1e6) as u32
}
