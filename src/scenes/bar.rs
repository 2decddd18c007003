//! Where a lecture stands, with the way to the next scene.

use leptos::prelude::*;

use super::{end, step, title_of};
use crate::lab::use_lab;
use crate::texts::{say, tr};

/// Which scene is shown, and buttons to go on and back; nothing where no lecture is going on.
#[component]
pub fn SceneBar() -> impl IntoView {
    let lab = use_lab();
    let count = move || lab.scenes.with(|scenes| scenes.documents.len());
    let place = move || {
        let index = lab.scene.get()?;
        let title = lab.scenes.with(|scenes| Some(title_of(lab, scenes.documents.get(index)?)))?;
        Some(tr!(lab, scenes.place, number = index + 1, count = count(), title = title))
    };
    let is_first = move || lab.scene.get() == Some(0);
    let is_last = move || lab.scene.get().is_some_and(|index| index + 1 == count());
    view! {
        <nav
            class="scene-bar"
            aria-label=say!(lab, scenes.scenes)
            data-testid="scene-bar"
            hidden=move || lab.scene.get().is_none() || lab.side.get().is_some()
        >
            <button
                type="button"
                class="button small"
                data-testid="scene-back"
                aria-label=say!(lab, scenes.back)
                title=say!(lab, scenes.back)
                disabled=is_first
                on:click=move |_| step(lab, false)
            >
                "‹"
            </button>
            <span aria-live="polite" data-testid="scene-place">{place}</span>
            <button
                type="button"
                class="button small"
                data-testid="scene-next"
                aria-label=say!(lab, scenes.next)
                title=say!(lab, scenes.next)
                disabled=is_last
                on:click=move |_| step(lab, true)
            >
                "›"
            </button>
            <button type="button" class="button small" data-testid="scene-end" on:click=move |_| end(lab)>{say!(lab, scenes.end)}</button>
        </nav>
    }
}
