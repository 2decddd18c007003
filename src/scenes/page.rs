//! The page of scenes: their order and titles, and how they leave the browser.

use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;
use quadtank_scenario::{Document, Label, Scenes};

use super::{bench_of, change, show};
use crate::download::download_text;
use crate::lab::{Lab, Notice, use_lab};
use crate::lessons::absolute;
use crate::share;
use crate::texts::{say, tr};

/// Name of the file of scenes.
const FILE: &str = "quadtank-scenes.json";

/// All scenes.
#[component]
pub fn ScenesPage() -> impl IntoView {
    let lab = use_lab();
    let is_empty = move || lab.scenes.with(|scenes| scenes.documents.is_empty());
    // Titles are typed here: a list that is made anew at each would take the focus from its field.
    let count = Memo::new(move |_| lab.scenes.with(|scenes| scenes.documents.len()));
    let moved = RwSignal::new(0_u32);
    let rows = move || {
        moved.track();
        (0..count.get()).map(|index| view! { <SceneRow index moved /> }).collect_view()
    };
    let begin = move |_| {
        show(lab, 0);
        lab.present(true);
    };
    view! {
        <main class="side-page scenes" id="bench" tabindex="-1" data-testid="scenes">
            <h2>{say!(lab, scenes.scenes)}</h2>
            <p class="lead">{say!(lab, scenes.lead)}</p>
            <p data-testid="no-scenes" hidden=move || !is_empty()>{say!(lab, scenes.none)}</p>
            <ol class="scene-list">{rows}</ol>
            <p class="actions" hidden=is_empty>
                <button type="button" class="button" data-testid="scenes-begin" on:click=begin>{say!(lab, scenes.begin)}</button>
                <button type="button" class="button" data-testid="scenes-copy" on:click=move |_| copy_link(lab)>{say!(lab, scenes.copy)}</button>
                <button type="button" class="button" data-testid="scenes-save" on:click=move |_| save(lab)>{say!(lab, scenes.save)}</button>
            </p>
            <p class="hint">{say!(lab, scenes.keys)}</p>
        </main>
    }
}

/// A scene: its title, its bench, its place.
#[component]
fn SceneRow(index: usize, moved: RwSignal<u32>) -> impl IntoView {
    let lab = use_lab();
    let read = move |read: &dyn Fn(&Document) -> String| {
        lab.scenes.with(|scenes| scenes.documents.get(index).map(read).unwrap_or_default())
    };
    let bench = move || read(&|document| bench_of(lab, document).map(|bench| (bench.title)(lab)).unwrap_or_default());
    let rename = move |event| {
        let name: String = event_target_value(&event).chars().take(Label::MAX_NAME).collect();
        change(lab, |documents| {
            if let Some(document) = documents.get_mut(index) {
                document.label_mut().name = name;
            }
        });
    };
    let rearrange = move |rearrange: &dyn Fn(&mut Vec<Document>)| {
        leave_field();
        change(lab, rearrange);
        moved.update(|times| *times += 1);
    };
    let swap_with_next = move |first: usize| {
        rearrange(&|documents| {
            if first + 1 < documents.len() {
                documents.swap(first, first + 1);
            }
        });
    };
    let remove = move |_| {
        let former = lab.scenes.get_untracked();
        if index < former.documents.len() {
            rearrange(&|documents| drop(documents.remove(index)));
            lab.notice.set(Some(Notice::SceneRemoved(former)));
        }
    };
    let is_last = move || lab.scenes.with(|scenes| index + 1 >= scenes.documents.len());
    let number = index + 1;
    view! {
        <li data-testid=format!("scene-{number}")>
            <span class="number">{number}</span>
            <input
                type="text"
                class="text-field"
                maxlength=Label::MAX_NAME
                data-testid=format!("scene-title-{number}")
                aria-label=move || tr!(lab, scenes.title, number = number)
                placeholder=bench
                prop:value=move || read(&|document| document.label().name.clone())
                on:change=rename
            />
            <span class="remark">{bench}</span>
            <button type="button" class="button small" data-testid=format!("scene-show-{number}") on:click=move |_| show(lab, index)>
                {say!(lab, scenes.show)}
            </button>
            <button
                type="button"
                class="button small"
                data-testid=format!("scene-up-{number}")
                aria-label=move || tr!(lab, scenes.up, number = number)
                disabled=index == 0
                on:click=move |_| swap_with_next(index - 1)
            >
                "↑"
            </button>
            <button
                type="button"
                class="button small"
                data-testid=format!("scene-down-{number}")
                aria-label=move || tr!(lab, scenes.down, number = number)
                disabled=is_last
                on:click=move |_| swap_with_next(index)
            >
                "↓"
            </button>
            <button
                type="button"
                class="button small"
                data-testid=format!("scene-remove-{number}")
                aria-label=move || tr!(lab, scenes.remove, number = number)
                on:click=remove
            >
                "✕"
            </button>
        </li>
    }
}

/// Leaves the field that is typed into, which takes up its text. A field that went with its row would give it to the scene that
/// has the place by then.
fn leave_field() {
    if let Some(field) = document().active_element().and_then(|e| e.dyn_into::<web_sys::HtmlElement>().ok()) {
        let _ = field.blur();
    }
}

/// Puts the link of all scenes on the clipboard.
fn copy_link(lab: Lab) {
    match share::reference_of_scenes(lab) {
        Ok(reference) => share::hand_over(lab, absolute(&reference)),
        Err(error) => lab.notice.set(Some(Notice::NotWritten(error))),
    }
}

/// Hands all scenes over as a file.
fn save(lab: Lab) {
    match lab.scenes.with_untracked(Scenes::to_json) {
        Ok(text) => download_text(FILE, "application/json", &text),
        Err(error) => lab.notice.set(Some(Notice::NotWritten(error))),
    }
}
