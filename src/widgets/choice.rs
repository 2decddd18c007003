use leptos::prelude::*;

use super::handler;

/// A choice of one among many.
#[component]
pub fn Choice(
    /// Name for tests.
    id: &'static str,
    /// What is chosen, for screen readers.
    #[prop(into)]
    name: Signal<String>,
    /// The options, from [`option`](super::html::option).
    #[prop(into)]
    options: Signal<String>,
    /// Called with the value of the new choice.
    #[prop(into)]
    on_choose: Callback<String>,
    /// Whether the choice is locked.
    disabled: bool,
) -> impl IntoView {
    view! {
        <select
            data-testid=id
            aria-label=name
            disabled=disabled
            on:change=handler(move |event| on_choose.run(event_target_value(&event)))
            inner_html=options
        ></select>
    }
}
