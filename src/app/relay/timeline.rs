//! The time axis of a picture over time, which remembers what of it is shown while the bench is open.

use leptos::prelude::*;

use crate::app::widgets::TimeAxis;

/// Share of all time that is the shortest stretch to be shown.
const SHORTEST: f64 = 0.005;

/// A time axis from 0 to `end`.
pub fn timeline(end: Signal<f64>) -> TimeAxis {
    let shown = RwSignal::new(None::<(f64, f64)>);
    let cursor = RwSignal::new(None::<f64>);
    let whole = Signal::derive(move || (0.0, end.get()));
    // What was shown of a longer record may lie beyond the end of this one.
    let window = Signal::derive(move || shown.get().filter(|(_, to)| *to <= end.get()).unwrap_or((0.0, end.get())));
    TimeAxis {
        whole,
        window,
        cursor: Signal::derive(move || cursor.get().filter(|time| *time <= end.get())),
        on_cursor: Callback::new(move |time| cursor.set(time)),
        on_show: Callback::new(move |stretch| shown.set(stretch)),
        about: Signal::stored(None),
        shortest: SHORTEST * end.get_untracked(),
    }
}
