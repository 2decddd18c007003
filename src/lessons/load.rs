//! The files of lessons: beside the page, or inside it where it is a single file.

use std::sync::Arc;

use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;
use quadtank_lesson::{LESSON_IDS, Lesson, read_lesson};
use quadtank_scenario::ScenarioError;
use wasm_bindgen_futures::{JsFuture, spawn_local};

/// Why a lesson cannot be shown.
#[derive(Clone, Debug, PartialEq)]
pub enum LoadError {
    /// No lesson of the laboratory has this id.
    Unknown(String),
    /// Its file did not arrive.
    NotArrived(String),
    /// Its file is not a lesson.
    Refused(ScenarioError),
}

/// The lesson of the laboratory with an id.
///
/// # Errors
/// [`LoadError`].
pub async fn load(id: &str) -> Result<Lesson, LoadError> {
    let index = LESSON_IDS.iter().position(|known| *known == id).ok_or_else(|| LoadError::Unknown(id.to_owned()))?;
    let name = format!("{:02}-{id}.json", index + 1);
    let text = match inside(&format!("lesson-{id}")) {
        Some(text) => text,
        None => fetched(&format!("lessons/{name}")).await.ok_or_else(|| LoadError::NotArrived(name.clone()))?,
    };
    read_lesson(text.as_bytes()).map_err(LoadError::Refused)
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
