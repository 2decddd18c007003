use leptos::prelude::*;

/// A box to tick.
#[component]
pub fn Tick(
    /// Name for tests.
    id: &'static str,
    /// What it switches.
    #[prop(into)]
    text: Signal<String>,
    /// Whether it is ticked.
    #[prop(into)]
    ticked: Signal<bool>,
    /// Whether it is locked.
    disabled: bool,
    /// Called when it is ticked or not any more.
    #[prop(into)]
    on_tick: Callback<bool>,
) -> impl IntoView {
    view! {
        <label class="check">
            <input
                type="checkbox"
                data-testid=id
                prop:checked=ticked
                disabled=disabled
                on:change=move |event| on_tick.run(event_target_checked(&event))
            />
            {text}
        </label>
    }
}
