//! A line of text in a document.

use leptos::prelude::*;

/// A line of text with its label above it. It takes at most `max` characters.
#[component]
pub fn TextField(
    /// Name for tests.
    id: &'static str,
    /// What the text is.
    #[prop(into)]
    label: Signal<String>,
    /// The text in force.
    #[prop(into)]
    value: Signal<String>,
    /// Most characters.
    max: usize,
    /// Called with a new text once the field is left.
    #[prop(into)]
    on_change: Callback<String>,
    /// Whether it is locked.
    #[prop(optional)]
    disabled: bool,
    /// Whether it is not shown for now.
    #[prop(optional, into)]
    hidden: Signal<bool>,
) -> impl IntoView {
    view! {
        <label class="text" hidden=hidden>
            {label}
            <input
                type="text"
                class="text-field"
                maxlength=max
                data-testid=id
                disabled=disabled
                prop:value=value
                on:change=move |event| on_change.run(limited(&event_target_value(&event), max))
            />
        </label>
    }
}

/// A text of at most `max` characters: a field counts units of UTF-16, a document characters.
pub fn limited(text: &str, max: usize) -> String {
    text.chars().take(max).collect()
}
