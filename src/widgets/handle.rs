use leptos::ev::{KeyboardEvent, PointerEvent, TouchEvent};
use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;
use web_sys::Element;

use crate::lab::use_lab;

/// Where a handle is dragged to (CSS px).
#[derive(Clone, Copy, Debug)]
pub struct Drag {
    /// From the corner of the drawing.
    pub at: (f64, f64),
    /// From where it was grabbed.
    pub moved: (f64, f64),
}

/// A press of a key on a handle, in steps: arrows are 1, with Shift [`BIG`].
#[derive(Clone, Copy, Debug, Default)]
pub struct Nudge {
    /// To the right.
    pub right: f64,
    /// Upwards.
    pub up: f64,
    /// Page Up and Page Down.
    pub page: f64,
}

/// Steps of an arrow key with Shift, and of Page Up and Page Down.
const BIG: f64 = 5.0;

impl Nudge {
    /// What a key does; Home and End go beyond any end.
    fn of(event: &KeyboardEvent) -> Option<Self> {
        let step = if event.shift_key() { BIG } else { 1.0 };
        let (right, up, page) = match event.key().as_str() {
            "ArrowLeft" => (-step, 0.0, 0.0),
            "ArrowRight" => (step, 0.0, 0.0),
            "ArrowDown" => (0.0, -step, 0.0),
            "ArrowUp" => (0.0, step, 0.0),
            "PageDown" => (0.0, 0.0, -BIG),
            "PageUp" => (0.0, 0.0, BIG),
            "Home" => (0.0, 0.0, f64::NEG_INFINITY),
            "End" => (0.0, 0.0, f64::INFINITY),
            _ => return None,
        };
        Some(Self { right, up, page })
    }

    /// All of it in one direction, for a handle that has only one.
    pub fn along(self) -> f64 {
        self.right + self.up + self.page
    }
}

/// A part of a drawing that is dragged by mouse, pen or finger and moved by keys. It stands inside an `svg`.
#[component]
pub fn Handle(
    /// Name for tests.
    id: &'static str,
    /// What it moves, for screen readers.
    #[prop(into)]
    label: Signal<String>,
    /// Where it is, as a finite number.
    #[prop(into)]
    value: Signal<f64>,
    /// Smallest and largest number that it can be moved to.
    #[prop(into)]
    limits: Signal<(f64, f64)>,
    /// Where it is, in words.
    #[prop(into)]
    spoken: Signal<String>,
    /// Whether it is locked.
    locked: bool,
    /// Called when it is grabbed.
    #[prop(into)]
    on_grab: Callback<()>,
    /// Called while it is dragged.
    #[prop(into)]
    on_drag: Callback<Drag>,
    /// Called for a key.
    #[prop(into)]
    on_nudge: Callback<Nudge>,
    /// Where it stands in the drawing.
    #[prop(into)]
    at: Signal<(f64, f64)>,
    /// What is seen of it, about the origin.
    children: Children,
) -> impl IntoView {
    let lab = use_lab();
    let (value, limits, spoken) = (lab.throttled(value), lab.throttled(limits), lab.throttled(spoken));
    let range = Signal::derive(move || range_with(limits.get(), value.get()));
    let grabbed_at = StoredValue::new(None::<(f64, f64)>);
    let position = |event: &PointerEvent| (f64::from(event.client_x()), f64::from(event.client_y()));
    let on_down = move |event: PointerEvent| {
        event.prevent_default();
        event.stop_propagation();
        if locked {
            return;
        }
        let Some(handle) = event.current_target().and_then(|t| t.dyn_into::<Element>().ok()) else { return };
        let _ = handle.set_pointer_capture(event.pointer_id());
        let _ = handle.unchecked_ref::<web_sys::HtmlElement>().focus();
        grabbed_at.set_value(Some(position(&event)));
        on_grab.run(());
    };
    let on_move = move |event: PointerEvent| {
        let Some((x, y)) = grabbed_at.get_value() else { return };
        let Some(drawing) = event_target::<Element>(&event).closest("svg").ok().flatten() else { return };
        let (corner, now) = (drawing.get_bounding_client_rect(), position(&event));
        on_drag.run(Drag { at: (now.0 - corner.left(), now.1 - corner.top()), moved: (now.0 - x, now.1 - y) });
    };
    let on_key = move |event: KeyboardEvent| {
        if let Some(nudge) = Nudge::of(&event) {
            event.prevent_default();
            event.stop_propagation();
            if !locked {
                on_nudge.run(nudge);
            }
        }
    };
    let release = move |_: PointerEvent| grabbed_at.set_value(None);
    view! {
        <g
            class="handle"
            role="slider"
            tabindex="0"
            data-testid=id
            transform=move || { let (x, y) = at.get(); format!("translate({x} {y})") }
            aria-label=label
            aria-valuemin=move || range.get().0.to_string()
            aria-valuemax=move || range.get().1.to_string()
            aria-valuenow=move || value.get().to_string()
            aria-valuetext=spoken
            aria-disabled=locked.then_some("true")
            on:pointerdown=on_down
            on:pointermove=on_move
            // A finger on the handle drags it; anywhere else on the drawing it scrolls the page.
            on:touchstart=|event: TouchEvent| event.prevent_default()
            on:pointerup=release
            on:pointercancel=release
            on:keydown=on_key
        >
            <circle class="touch" r="22" />
            {children()}
        </g>
    }
}

/// The range of a slider for assistive technology, which has to contain its value: a document may set a value that the
/// handle cannot be moved to.
fn range_with((min, max): (f64, f64), value: f64) -> (f64, f64) {
    (min.min(value), max.max(value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_range_contains_a_value_that_the_handle_cannot_reach() {
        assert_eq!(range_with((-10.0, 10.0), 3.0), (-10.0, 10.0));
        assert_eq!(range_with((-10.0, 10.0), 999_999.5), (-10.0, 999_999.5));
        assert_eq!(range_with((-10.0, 10.0), -458_281.0), (-458_281.0, 10.0));
    }
}
