use leptos::prelude::*;

use super::{Drag, Handle, Nudge};
use quadtank_figure::{Frame, Rect};

const NO_PLACE: Rect = Rect { left: 0.0, top: 0.0, width: 1.0, height: 1.0 };
/// The frame before the picture has been painted for the first time.
const NOWHERE: Frame = Frame::linear(NO_PLACE, NO_PLACE, (0.0, 1.0), (0.0, 1.0));

/// The frame of the first chart of a picture.
pub fn first_frame(frames: RwSignal<Vec<Frame>>) -> Frame {
    frames.with(|f| f.first().copied()).unwrap_or(NOWHERE)
}

/// A point of a chart that is dragged by mouse, pen or finger and moved by keys. It stands inside an `svg` over the chart.
#[component]
pub fn PointHandle(
    /// Name for tests.
    id: &'static str,
    /// What it moves, for screen readers.
    #[prop(into)]
    label: Signal<String>,
    /// Where it is, in the units of the axes.
    #[prop(into)]
    at: Signal<(f64, f64)>,
    /// The number that a screen reader tells, and its limits.
    #[prop(into)]
    value: Signal<f64>,
    /// Smallest and largest number.
    limits: (f64, f64),
    /// Where it is, in words.
    #[prop(into)]
    spoken: Signal<String>,
    /// Whether it is locked.
    locked: bool,
    /// Called with where it is dragged to, in the units of the axes.
    #[prop(into)]
    on_move: Callback<(f64, f64)>,
    /// Called for a key.
    #[prop(into)]
    on_nudge: Callback<Nudge>,
    /// Where the chart stands.
    frames: RwSignal<Vec<Frame>>,
) -> impl IntoView {
    view! {
        <Handle
            id
            label
            value
            limits
            spoken
            locked
            on_grab=|()| ()
            on_drag=move |drag: Drag| on_move.run(untrack(|| first_frame(frames)).to_data(drag.at))
            on_nudge
            at=Signal::derive(move || first_frame(frames).to_px(at.get()))
        >
            <circle class="halo" r="17" />
            <circle class="dot" r="8.5" />
        </Handle>
    }
}
