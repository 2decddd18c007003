use leptos::ev::KeyboardEvent;
use leptos::prelude::*;

use super::first_frame;
use quadtank_figure::Frame;

/// A point of a chart that can be taken up by a click or a key. It stands inside an `svg` over the chart.
#[component]
pub fn PointButton(
    /// Name for tests.
    #[prop(into)]
    id: String,
    /// What taking it up does, for screen readers and the pointer.
    #[prop(into)]
    label: Signal<String>,
    /// What stands beside it, where the chart does not name it.
    #[prop(optional, into)]
    text: String,
    /// Where it is, in the units of the axes.
    #[prop(into)]
    at: Signal<(f64, f64)>,
    /// Called when it is taken up.
    #[prop(into)]
    on_choose: Callback<()>,
    /// Where the chart stands.
    frames: RwSignal<Vec<Frame>>,
) -> impl IntoView {
    let place = move || {
        let (x, y) = first_frame(frames).to_px(at.get());
        format!("translate({x} {y})")
    };
    let on_key = move |event: KeyboardEvent| {
        if matches!(event.key().as_str(), "Enter" | " ") {
            event.prevent_default();
            on_choose.run(());
        }
    };
    view! {
        <g
            class="published"
            role="button"
            tabindex="0"
            aria-label=label
            data-testid=id
            transform=place
            on:click=move |_| on_choose.run(())
            on:keydown=on_key
        >
            <title>{label}</title>
            <circle class="hit" r="14" />
            <circle class="mark" r="4.5" />
            <text x="13" y="18">{text}</text>
        </g>
    }
}
