use leptos::prelude::*;

use super::marked::marked;
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
    let list = move || {
        let language = lab.language.get();
        terms.iter().map(|text| view! { <p>{marked(&text(language))}</p> }).collect_view()
    };
    view! {
        <details class="menu small terms" data-testid=id on:toggle=move |_| open.set(true)>
            <summary aria-label=name title=name>"?"</summary>
            <div>{move || open.get().then(list)}</div>
        </details>
    }
}
