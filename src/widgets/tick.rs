use leptos::prelude::*;

use super::handler;

/// A box to tick.
pub fn tick(
    id: &'static str,
    text: Signal<String>,
    ticked: Signal<bool>,
    disabled: bool,
    on_tick: impl Fn(bool) + 'static,
) -> AnyView {
    view! {
        <label class="check">
            <input
                type="checkbox"
                data-testid=id
                prop:checked=ticked
                disabled=disabled
                on:change=handler(move |event| on_tick(event_target_checked(&event)))
            />
            {text}
        </label>
    }
    .into_any()
}
