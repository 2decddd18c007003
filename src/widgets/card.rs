use leptos::prelude::*;

use super::marked::marked;
use super::terms::{Terms, Text};
use crate::lab::use_lab;
use crate::session::Panel;
use crate::texts::tr;

/// A card: its title with what stands beside it, and its content. Its class names it.
#[component]
pub fn Card(
    /// Class of the card.
    name: &'static str,
    /// Its name in an address, by which a lesson chooses its place.
    #[prop(optional)]
    panel: Option<Panel>,
    /// Its title.
    #[prop(into)]
    title: Signal<String>,
    /// What stands beside the title.
    #[prop(optional, into)]
    beside: ViewFnOnce,
    /// Explanations of the words in it.
    #[prop(optional)]
    terms: &'static [Text],
    /// Whether it is not shown for now.
    #[prop(optional, into)]
    hidden: Signal<bool>,
    /// Its content.
    children: Children,
) -> impl IntoView {
    let help = (!terms.is_empty()).then(|| view! { <Terms id=format!("{name}-terms") title terms /> });
    let heading = format!("{name}-title");
    let labelled_by = heading.clone();
    let lab = use_lab();
    let order = panel.and_then(|panel| lab.place_of(panel)).map(|place| place.to_string());
    let is_large = Signal::derive(move || lab.large.get() == Some(name));
    let size = Signal::derive(move || {
        let title = title.get();
        if is_large.get() { tr!(lab, card.reduce, title = title) } else { tr!(lab, card.enlarge, title = title) }
    });
    view! {
        <section
            class=format!("card {name}")
            class:large=is_large
            style:order=order
            aria-labelledby=labelled_by
            hidden=hidden
        >
            <header><div class="title"><h2 id=heading>{title}</h2>{help}</div>{beside.run()}</header>
            {children()}
            <button
                type="button"
                class="enlarge"
                data-testid=format!("{name}-enlarge")
                aria-label=size
                title=size
                on:click=move |_| lab.large.update(|large| *large = if *large == Some(name) { None } else { Some(name) })
            >
                {move || if is_large.get() { "⤡" } else { "⤢" }}
            </button>
        </section>
    }
}

/// A sentence under a picture.
#[component]
pub fn Sentence(
    /// Name for tests.
    id: &'static str,
    /// The sentence, with markup.
    #[prop(into)]
    text: Signal<String>,
    /// Whether it is a warning.
    #[prop(optional, into)]
    warm: Signal<bool>,
    /// Whether it is a result, whose changes screen readers tell.
    #[prop(optional)]
    status: bool,
) -> impl IntoView {
    view! {
        <p class=move || if warm.get() { "sentence warm" } else { "sentence" } data-result=status.then_some(id) data-testid=id>
            {move || marked(&text.get())}
        </p>
    }
}

/// What came out, and whether it is a warning.
#[component]
pub fn Verdict(
    /// Name for tests.
    #[prop(into)]
    id: String,
    /// Whether it is a warning.
    #[prop(into)]
    warm: Signal<bool>,
    /// What it says.
    children: Children,
) -> impl IntoView {
    view! {
        <div class=move || if warm.get() { "verdict warm" } else { "verdict" } data-result=id.clone() data-testid=id>
            {children()}
        </div>
    }
}
