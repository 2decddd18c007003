//! Scenes: experiments in the order in which a lecture shows them. They are collected from the benches, kept by the browser, and leave
//! it as a file or a link.

mod bar;
mod page;

pub use bar::SceneBar;
pub use page::ScenesPage;

use leptos::prelude::*;
use quadtank_scenario::{Document, Opened, Scenes, opened_from_bytes};

use super::benches::BenchEntry;
use super::lab::{Lab, Notice};
use super::storage::SCENES;

/// The scenes that the browser remembers. What it remembers of another edition and cannot be read any more is not offered.
pub fn remembered() -> Scenes {
    let Some(text) = SCENES.read() else { return Scenes::default() };
    match opened_from_bytes(text.as_bytes()) {
        Ok(Opened::Scenes(scenes)) => scenes,
        _ => Scenes::from_link(&text).unwrap_or_default(),
    }
}

/// Adds what is shown as the last scene.
pub fn add_shown(lab: Lab) {
    let document = (lab.bench.get_untracked().document)(lab);
    lab.notice.set(Some(Notice::SceneAdded(lab.scenes.with_untracked(|scenes| scenes.documents.len() + 1))));
    change(lab, |documents| documents.push(document));
}

/// Whether there can be one more.
pub fn is_full(lab: Lab) -> bool {
    lab.scenes.with(|scenes| scenes.documents.len() >= Scenes::MAX)
}

/// Changes the list, which the browser remembers from then on.
fn change(lab: Lab, change: impl FnOnce(&mut Vec<Document>)) {
    lab.scenes.update(|scenes| change(&mut scenes.documents));
    remember(lab);
}

fn remember(lab: Lab) {
    match lab.scenes.with_untracked(Scenes::to_json) {
        Ok(text) => _ = SCENES.write(&text),
        Err(error) => lab.notice.set(Some(Notice::NotWritten(error))),
    }
}

/// Takes up the scenes of a link or file and shows the first. Those that were there before can be brought back.
pub fn open(lab: Lab, scenes: Scenes) {
    let former = lab.scenes.try_update(|present| std::mem::replace(present, scenes)).unwrap_or_default();
    remember(lab);
    show(lab, 0);
    let is_lost = !former.documents.is_empty() && lab.scenes.with_untracked(|present| *present != former);
    lab.notice.set(is_lost.then_some(Notice::ScenesReplaced(former)));
}

/// Brings back the scenes that were there before.
pub fn bring_back(lab: Lab, former: Scenes) {
    lab.notice.set(None);
    lab.scene.set(None);
    lab.scenes.set(former);
    remember(lab);
}

/// Shows a scene as it was when it was added; nothing if there is no such scene.
fn show(lab: Lab, index: usize) {
    let Some(document) = lab.scenes.with_untracked(|scenes| scenes.documents.get(index).cloned()) else { return };
    lab.scene.set(Some(index));
    lab.side.set(None);
    lab.open(Ok(document));
}

/// Whether a scene is on the screen, and not a page or a lesson in its place.
pub fn is_in_sight(lab: Lab) -> bool {
    let is_covered = lab.side.get_untracked().is_some() || lab.stage.with_untracked(Option::is_some);
    lab.scene.get_untracked().is_some() && !is_covered
}

/// Shows the scene after the present one, or the one before.
pub fn step(lab: Lab, forward: bool) {
    let Some(index) = lab.scene.get_untracked() else { return };
    let next = if forward { index.checked_add(1) } else { index.checked_sub(1) };
    if let Some(next) = next {
        show(lab, next);
    }
}

/// Ends the lecture; what is shown stays.
pub fn end(lab: Lab) {
    lab.scene.set(None);
    lab.present(false);
}

/// The bench of a document.
pub fn bench_of(lab: Lab, document: &Document) -> Option<&'static BenchEntry> {
    lab.benches.iter().find(|bench| bench.id == document.bench())
}

/// What a scene is called: the name of its experiment, else its bench.
fn title_of(lab: Lab, document: &Document) -> String {
    match document.label().name.as_str() {
        "" => bench_of(lab, document).map(|bench| (bench.title)(lab)).unwrap_or_default(),
        name => name.to_owned(),
    }
}
