use leptos::prelude::*;
use quadtank_figure::Pen;

use crate::lab::Lab;
use crate::texts::{say, tr};

/// What is pinned: each with the dashes of its curves, what it has of its own, and buttons to take it up again and to remove it.
#[component]
pub fn Pins(
    /// What all benches share.
    lab: Lab,
    /// Beginning of the names for tests.
    id: &'static str,
    /// How many are pinned.
    #[prop(into)]
    count: Signal<usize>,
    /// What one (its place, from 0 on) has of its own.
    text: Callback<usize, String>,
    /// Called with the place of the one to take up again.
    on_restore: Callback<usize>,
    /// Called with the place of the one to remove.
    on_remove: Callback<usize>,
) -> impl IntoView {
    let chip = move |place: usize| {
        let number = place + 1;
        view! {
            <li>
                <Dashes place />
                <span data-testid=format!("{id}-{number}")>
                    <b>{number}</b>
                    " "
                    {move || text.run(place)}
                </span>
                <button
                    type="button"
                    class="button small"
                    data-testid=format!("{id}-{number}-restore")
                    on:click=move |_| on_restore.run(place)
                >
                    {say!(lab, pins.restore)}
                    <span class="visually-hidden">" " {number}</span>
                </button>
                <button
                    type="button"
                    class="button small"
                    data-testid=format!("{id}-{number}-remove")
                    aria-label=move || tr!(lab, pins.remove, number = number)
                    on:click=move |_| on_remove.run(place)
                >
                    "×"
                </button>
            </li>
        }
    };
    view! {
        <ul class="pins" aria-label=say!(lab, pins.title) hidden=move || count.get() == 0>
            {move || (0..count.get()).map(chip).collect_view()}
        </ul>
    }
}

/// A sample of the line of a pinned run.
#[component]
fn Dashes(place: usize) -> impl IntoView {
    let pen = u8::try_from(place).map_or(Pen::Faded, Pen::Pinned);
    let dashes = pen.dash().map(|(drawn, left_out)| format!("{drawn} {left_out}"));
    view! {
        <svg viewBox="0 0 36 8" aria-hidden="true">
            <line x1="0" y1="4" x2="36" y2="4" stroke-dasharray=dashes />
        </svg>
    }
}
