//! The files of lessons: beside the page, inside it where it is a single file, or opened by their reader.
//!
//! An address names a lesson of the laboratory by its id, one of somebody else by the path of its file beside the page, and one that
//! was opened from a file by [`FROM_FILE`] and its id: the tab remembers that one, so that a reload and Back find it.

use std::path::Path;
use std::sync::Arc;

use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;
use quadtank_lesson::{LESSON_IDS, Lesson, read_lesson};
use quadtank_scenario::ScenarioError;
use wasm_bindgen_futures::{JsFuture, spawn_local};

/// Prefix of the id of a lesson that was opened from a file.
const FROM_FILE: &str = "file:";
/// Prefix of opened lessons in the session storage.
const PREFIX: &str = "quadtank-opened-";
/// Longest path of a file beside the page (characters).
const LONGEST_PATH: usize = 200;

/// Why a lesson cannot be shown.
#[derive(Clone, Debug, PartialEq)]
pub enum LoadError {
    /// No lesson of the laboratory has this id.
    Unknown(String),
    /// It was opened from a file, and this tab does not hold it: another tab does, or the browser has no session storage.
    NotAtHand(String),
    /// Its file did not arrive.
    NotArrived(String),
    /// Its file is not a lesson.
    Refused(ScenarioError),
}

/// The lesson that an address names.
///
/// # Errors
/// [`LoadError`].
pub async fn load(name: &str) -> Result<Lesson, LoadError> {
    let text = if let Some(id) = name.strip_prefix(FROM_FILE) {
        opened(id).ok_or_else(|| LoadError::NotAtHand(id.to_owned()))?
    } else if let Some(index) = LESSON_IDS.iter().position(|known| *known == name) {
        match inside(&format!("lesson-{name}")) {
            Some(text) => text,
            None => arrived(&format!("lessons/{:02}-{name}.json", index + 1)).await?,
        }
    } else if is_beside(name) {
        arrived(name).await?
    } else {
        return Err(LoadError::Unknown(name.to_owned()));
    };
    read_lesson(text.as_bytes()).map_err(LoadError::Refused)
}

async fn arrived(path: &str) -> Result<String, LoadError> {
    fetched(path).await.ok_or_else(|| LoadError::NotArrived(path.to_owned()))
}

/// Whether a path names a JSON file in or below the folder of the page. Nothing else is fetched, so that a link cannot load a lesson
/// from another site.
fn is_beside(path: &str) -> bool {
    let is_name = |name: &str| {
        let is_plain = name.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.'));
        is_plain && !name.is_empty() && !name.starts_with('.')
    };
    let is_json = Path::new(path).extension().is_some_and(|extension| extension == "json");
    is_json && path.len() <= LONGEST_PATH && path.split('/').all(is_name)
}

/// Remembers a lesson that was opened from a file, as long as the tab is there; its name in an address.
pub fn remember(lesson: &Lesson) -> String {
    if let (Some(storage), Ok(text)) = (storage(), serde_json::to_string(lesson)) {
        // A storage that is full or forbidden only costs the way back.
        let _ = storage.set_item(&format!("{PREFIX}{}", lesson.id), &text);
    }
    format!("{FROM_FILE}{}", lesson.id)
}

fn opened(id: &str) -> Option<String> {
    storage()?.get_item(&format!("{PREFIX}{id}")).ok()?
}

fn storage() -> Option<web_sys::Storage> {
    window().session_storage().ok()?
}

/// All lessons of the laboratory, each as soon as its file is there.
pub fn all() -> RwSignal<Vec<Option<Arc<Lesson>>>> {
    let lessons = RwSignal::new(vec![None; LESSON_IDS.len()]);
    for (index, id) in LESSON_IDS.into_iter().enumerate() {
        spawn_local(async move {
            if let Ok(lesson) = load(id).await {
                // The list may be closed by then.
                lessons.try_update(|lessons| lessons[index] = Some(Arc::new(lesson)));
            }
        });
    }
    lessons
}

/// The text of a block of data in the page.
pub fn inside(id: &str) -> Option<String> {
    document().get_element_by_id(id)?.text_content()
}

/// The text of a file beside the page.
pub async fn fetched(address: &str) -> Option<String> {
    let response = JsFuture::from(window().fetch_with_str(address)).await.ok()?;
    let response: web_sys::Response = response.dyn_into().ok()?;
    // A host that answers with its own page in place of a missing file sends no lesson.
    if !response.ok() {
        return None;
    }
    JsFuture::from(response.text().ok()?).await.ok()?.as_string()
}

#[cfg(test)]
mod tests {
    use super::is_beside;

    #[test]
    fn only_files_below_the_page_are_beside_it() {
        for path in ["my.json", "lessons/my-lesson.json", "course_1/week.2/A.json"] {
            assert!(is_beside(path), "{path}");
        }
        for path in [
            "",
            "my",
            ".json",
            "/my.json",
            "//evil.example/my.json",
            "https://evil.example/my.json",
            "../my.json",
            "a/../my.json",
            "a//my.json",
            "a\\my.json",
            "%2e%2e/my.json",
            "my.json?x",
            "x.html#my.json",
            &format!("{}.json", "x".repeat(200)),
        ] {
            assert!(!is_beside(path), "{path}");
        }
    }
}
