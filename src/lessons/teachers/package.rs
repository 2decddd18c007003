//! A lesson as files: the package for a learning management system, and the lesson itself to start a new one from.

use std::sync::Arc;

use leptos::prelude::*;
use quadtank_lesson::{Lesson, scorm_package};
use wasm_bindgen_futures::spawn_local;

use crate::download::{download_bytes, download_text};
use crate::lab::{Lab, Notice, use_lab};
use crate::lessons::load::{LoadError, fetched};
use crate::texts::say;

/// The laboratory as one file, which a package holds.
const SINGLE_FILE: &str = "quadtank.html";

/// The files of a lesson to download.
#[component]
pub fn LessonFiles(
    /// The lesson.
    lesson: Arc<Lesson>,
) -> impl IntoView {
    let lab = use_lab();
    let package = {
        let lesson = Arc::clone(&lesson);
        move |_| spawn_local(save_package(lab, Arc::clone(&lesson)))
    };
    let [package_id, save_id] = ["scorm", "save"].map(|name| format!("{name}-{}", lesson.id));
    let save = move |_| {
        let text = serde_json::to_string_pretty(&*lesson).unwrap_or_default();
        download_text(&format!("{}.json", lesson.id), "application/json", &text);
    };
    view! {
        <button type="button" class="button" data-testid=package_id on:click=package>{say!(lab, lesson.scorm)}</button>
        <button type="button" class="button" data-testid=save_id on:click=save>{say!(lab, lesson.save_lesson)}</button>
    }
}

async fn save_package(lab: Lab, lesson: Arc<Lesson>) {
    let package = fetched(SINGLE_FILE).await.and_then(|page| scorm_package(&page, &lesson).ok());
    match package {
        Some(package) => download_bytes(&format!("quadtank-{}.zip", lesson.id), "application/zip", &package),
        None => lab.notice.set(Some(Notice::NoLesson(LoadError::NotArrived(SINGLE_FILE.to_owned())))),
    }
}
