use leptos::html::Details;
use leptos::prelude::*;

/// Cards that are folded away under a title, and made when they are opened first.
#[component]
pub fn Drawer(
    /// Name for tests.
    id: &'static str,
    /// What it holds.
    #[prop(into)]
    title: Signal<String>,
    /// Its content.
    #[prop(into)]
    content: ViewFn,
) -> impl IntoView {
    let details = NodeRef::<Details>::new();
    let seen = RwSignal::new(false);
    let open = move |_| {
        // The event comes after the click, when the drawer may be gone.
        if details.try_get_untracked().flatten().is_some_and(|details| details.open()) {
            seen.set(true);
        }
    };
    view! {
        <details class="drawer" node_ref=details on:toggle=open>
            <summary class="button" data-testid=id>{title}</summary>
            <div class="content">{move || seen.get().then(|| content.run())}</div>
        </details>
    }
}
