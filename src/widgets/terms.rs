use leptos::html::Div;
use leptos::prelude::*;

use super::marked::marked;
use super::read_on::ReadOn;
use super::table::is_open;
use crate::glossary::section_of;
use crate::lab::use_lab;
use crate::texts::{Language, tr};

/// A text of the locale files.
pub type Text = fn(Language) -> String;

/// The words of a card and what they mean, behind a question mark: each in one or two plain sentences.
#[component]
pub fn Terms(
    /// Name for tests.
    id: String,
    /// Title of the card, for screen readers.
    #[prop(into)]
    title: Signal<String>,
    /// The explanations, each with its word in bold in front.
    terms: &'static [Text],
) -> impl IntoView {
    let lab = use_lab();
    let name = Signal::derive(move || format!("{}: {}", tr!(lab, terms.title), title.get()));
    let open = RwSignal::new(false);
    let panel = NodeRef::<Div>::new();
    let on_toggle = move |event| {
        open.set(is_open(&event));
        if !open.get_untracked() {
            return;
        }
        // Near the lower edge of the screen it would open out of sight.
        request_animation_frame(move || {
            // The card may be gone by then.
            if let Some(panel) = panel.try_get_untracked().flatten() {
                let nearest = web_sys::ScrollIntoViewOptions::new();
                nearest.set_block(web_sys::ScrollLogicalPosition::Nearest);
                panel.scroll_into_view_with_scroll_into_view_options(&nearest);
            }
        });
    };
    let list = move || {
        let language = lab.language.get();
        terms.iter().map(|text| view! { <p>{marked(&text(language))}</p> }).collect_view()
    };
    view! {
        <details class="menu small terms" data-testid=id on:toggle=on_toggle>
            <summary aria-label=name title=name>"?"</summary>
            <div node_ref=panel>{move || open.get().then(list)} {move || open.get().then(|| view! { <ReadOn section=section_of(lab.language.get_untracked(), terms) /> })}</div>
        </details>
    }
}
