//! What lies over charts that share a time axis: the cursor with its values, and whatever mouse, finger and keyboard do to
//! them.

use leptos::ev::{KeyboardEvent, PointerEvent, WheelEvent};
use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;

use super::readout::{BesideCursor, Readout};
use crate::lab::use_lab;
use crate::texts::say;
use quadtank_figure::Frame;

/// Share of the shown time that an arrow key moves the cursor, and with Shift.
const CURSOR_STEPS: (f64, f64) = (0.005, 0.05);
/// How much of the shown time remains after zooming in once.
const ZOOM: f64 = 0.6;
/// A stretch that leaves out less than this share of the whole time is the whole time.
const WHOLE: f64 = 0.999;
/// A drag shorter than this (CSS px) moves the cursor; a longer one selects what to zoom into.
const DRAG_PX: f64 = 6.0;

/// A stretch of time (s).
type Stretch = (f64, f64);

/// The time axis that charts share: what of it is shown, and where the cursor stands. A handle: copying it copies nothing.
#[derive(Clone, Copy)]
pub struct TimeAxis {
    /// All of the time (s).
    pub whole: Signal<Stretch>,
    /// What of it is shown (s).
    pub window: Signal<Stretch>,
    /// Where the cursor stands, if there is one (s).
    pub cursor: Signal<Option<f64>>,
    /// Called with a new place for the cursor, inside the whole time, or none.
    pub on_cursor: Callback<Option<f64>>,
    /// Called with what to show, inside the whole time; nothing is all of it.
    pub on_show: Callback<Option<Stretch>>,
    /// What to zoom about when no cursor is in sight (s); the middle where this is not in sight either.
    pub about: Signal<Option<f64>>,
    /// The shortest stretch that can be shown (s).
    pub shortest: Signal<f64>,
}

impl TimeAxis {
    /// The time of a run from 0 to `end` (s), all of which is shown until the reader zooms. Nothing of the zoom is kept in the document.
    pub fn of_run(
        end: Signal<f64>,
        cursor: Signal<Option<f64>>,
        on_cursor: Callback<Option<f64>>,
        shortest: Signal<f64>,
    ) -> Self {
        let shown = RwSignal::new(None::<Stretch>);
        // A stretch of a longer run may lie beyond the end of this one.
        let window = move || shown.get().filter(|(_, to)| *to <= end.get()).unwrap_or((0.0, end.get()));
        Self {
            whole: Signal::derive(move || (0.0, end.get())),
            window: Signal::derive(window),
            cursor,
            on_cursor,
            on_show: Callback::new(move |stretch| shown.set(stretch)),
            about: Signal::stored(None),
            shortest,
        }
    }

    fn show(self, (from, to): Stretch) {
        let (begin, end) = self.whole.get_untracked();
        let all = end - begin;
        let length = (to - from).clamp(self.shortest.get_untracked().min(all), all);
        let from = from.clamp(begin, end - length);
        self.on_show.run((length < all * WHOLE).then_some((from, from + length)));
    }

    /// Shows `factor` times as much.
    fn zoom(self, factor: f64) {
        let (from, to) = self.window.get_untracked();
        let in_sight = |time: Signal<Option<f64>>| time.get_untracked().filter(|t| (from..=to).contains(t));
        let centre = in_sight(self.cursor).or_else(|| in_sight(self.about)).unwrap_or(f64::midpoint(from, to));
        self.show((centre - (centre - from) * factor, centre + (to - centre) * factor));
    }

    fn set_cursor(self, time: Option<f64>) {
        let (begin, end) = self.whole.get_untracked();
        self.on_cursor.run(time.map(|t| t.clamp(begin, end)));
    }

    /// The cursor for assistive technology: the beginning where there is none, the end where it is beyond that.
    fn shown_cursor(self) -> f64 {
        let (begin, end) = self.whole.get();
        self.cursor.get().map_or(begin, |time| time.clamp(begin, end))
    }

    /// Moves the cursor by so many steps, big ones with Shift.
    fn step(self, steps: f64, big: bool) {
        let (from, to) = self.window.get_untracked();
        let step = (to - from) * if big { CURSOR_STEPS.1 } else { CURSOR_STEPS.0 };
        self.set_cursor(Some(self.cursor.get_untracked().unwrap_or(from) + steps * step));
    }

    fn on_key(self, event: &KeyboardEvent) {
        let (from, to) = self.window.get_untracked();
        match event.key().as_str() {
            "ArrowLeft" => self.step(-1.0, event.shift_key()),
            "ArrowRight" => self.step(1.0, event.shift_key()),
            "Home" => self.set_cursor(Some(from)),
            "End" => self.set_cursor(Some(to)),
            "+" | "=" => self.zoom(ZOOM),
            "-" => self.zoom(1.0 / ZOOM),
            "0" => self.on_show.run(None),
            "Escape" if self.cursor.get_untracked().is_some() => {
                // It is the cursor that goes, not what the page shows.
                event.stop_propagation();
                self.set_cursor(None);
            }
            _ => return,
        }
        event.prevent_default();
    }

    fn on_wheel(self, event: &WheelEvent) {
        if event.ctrl_key() {
            event.prevent_default();
            self.zoom(if event.delta_y() < 0.0 { ZOOM } else { 1.0 / ZOOM });
        }
    }
}

/// The transparent surface over charts: a press or the mouse moves the cursor, a drag of the mouse selects what to zoom
/// into, keys do both, and the values at the cursor stand beside it.
#[component]
pub fn TimeSurface(
    /// The time axis of the charts.
    axis: TimeAxis,
    /// Where the charts stand.
    frames: RwSignal<Vec<Frame>>,
    /// What it is and which keys it knows, for screen readers.
    #[prop(into)]
    label: Signal<String>,
    /// The values at the cursor in words; empty where there is none.
    #[prop(into)]
    spoken: Signal<String>,
    /// The same for the box beside the cursor.
    #[prop(into)]
    readout: Signal<Option<Readout>>,
    /// Name for tests.
    id: &'static str,
) -> impl IntoView {
    let drag = RwSignal::new(None::<Stretch>);
    let time_at = move |x: f64| frames.with_untracked(|f| f.first().map(|f| f.to_data((x, 0.0)).0));
    let on_down = move |event: PointerEvent| {
        let Some((surface, x)) = place_of(&event) else { return };
        let _ = surface.set_pointer_capture(event.pointer_id());
        drag.set(Some((x, x)));
        axis.set_cursor(time_at(x));
    };
    let on_move = move |event: PointerEvent| {
        let Some((_, x)) = place_of(&event) else { return };
        match drag.get_untracked() {
            Some((from, _)) => drag.set(Some((from, x))),
            None if is_mouse(&event) => axis.set_cursor(time_at(x)),
            None => {}
        }
    };
    let on_up = move |event: PointerEvent| {
        if let Some((from, to)) = drag.try_update(Option::take).flatten()
            && (to - from).abs() > DRAG_PX
            && is_mouse(&event)
            && let (Some(from), Some(to)) = (time_at(from.min(to)), time_at(from.max(to)))
        {
            axis.show((from, to));
        }
    };
    let on_leave = move |event: PointerEvent| {
        if is_mouse(&event) && drag.get_untracked().is_none() {
            axis.set_cursor(None);
        }
    };
    view! {
        <svg
            class="over surface"
            tabindex="0"
            role="slider"
            data-testid=id
            aria-label=label
            aria-valuemin=move || axis.whole.get().0.to_string()
            aria-valuemax=move || axis.whole.get().1.to_string()
            aria-valuenow=move || axis.shown_cursor().to_string()
            aria-valuetext=move || Some(spoken.get()).filter(|text| !text.is_empty())
            on:pointerdown=on_down
            on:pointermove=on_move
            on:pointerup=on_up
            on:pointercancel=move |_| drag.set(None)
            on:pointerleave=on_leave
            on:wheel=move |event| axis.on_wheel(&event)
            on:keydown=move |event| axis.on_key(&event)
        >
            {move || drag.get().and_then(|drag| frames.with(|frames| band(frames, drag)))}
            {move || axis.cursor.get().and_then(|time| frames.with(|frames| line(frames, time)))}
        </svg>
        <BesideCursor axis frames readout />
    }
}

/// The buttons that show less, more, or all of the time.
#[component]
pub fn ZoomButtons(
    /// The time axis of the charts.
    axis: TimeAxis,
    /// Names for tests: in, out, whole.
    ids: [&'static str; 3],
) -> impl IntoView {
    let lab = use_lab();
    let [zoom_in, zoom_out, whole] = ids;
    view! {
        <button
            type="button"
            class="button small"
            data-testid=zoom_in
            aria-label=say!(lab, chart.zoom_in)
            on:click=move |_| axis.zoom(ZOOM)
        >
            "+"
        </button>
        <button
            type="button"
            class="button small"
            data-testid=zoom_out
            aria-label=say!(lab, chart.zoom_out)
            on:click=move |_| axis.zoom(1.0 / ZOOM)
        >
            "−"
        </button>
        <button type="button" class="button small" data-testid=whole on:click=move |_| axis.on_show.run(None)>
            {say!(lab, chart.zoom_reset)}
        </button>
    }
}

fn is_mouse(event: &PointerEvent) -> bool {
    event.pointer_type() == "mouse"
}

/// The surface, and how far from its left edge an event happened (CSS px).
fn place_of(event: &PointerEvent) -> Option<(web_sys::Element, f64)> {
    let surface: web_sys::Element = event.current_target()?.dyn_into().ok()?;
    let left = surface.get_bounding_client_rect().left();
    Some((surface, f64::from(event.client_x()) - left))
}

/// Upper and lower edge of all plots (CSS px).
fn edges(frames: &[Frame]) -> Option<(f64, f64)> {
    Some((frames.first()?.plot.top, frames.last()?.plot.bottom()))
}

fn line(frames: &[Frame], time: f64) -> Option<impl IntoView + use<>> {
    let (plot, (top, bottom)) = (frames.first()?.plot, edges(frames)?);
    let x = frames.first()?.x_px(time);
    (plot.left..=plot.right()).contains(&x).then(|| view! { <line class="cursor-line" x1=x x2=x y1=top y2=bottom /> })
}

fn band(frames: &[Frame], (from, to): Stretch) -> Option<impl IntoView + use<>> {
    let ((top, bottom), left, width) = (edges(frames)?, from.min(to), (to - from).abs());
    (width > DRAG_PX).then(|| view! { <rect class="zoom-band" x=left width=width y=top height=bottom - top /> })
}
