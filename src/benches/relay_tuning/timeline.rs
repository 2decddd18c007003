//! The time axis of a picture over time, which remembers what of it is shown while the bench is open.

use leptos::prelude::*;

use crate::widgets::TimeAxis;

/// Share of all time that is the shortest stretch to be shown.
const SHORTEST: f64 = 0.005;

/// Asked for where all of a record is to be shown, however long it is.
const WHOLE: (f64, f64) = (0.0, f64::INFINITY);

/// Share of a record that is shown to begin with: enough to see it settle, little enough to see its switches.
pub const BEGINNING: f64 = 0.25;

/// The stretch of a record that is shown to begin with.
pub fn first_stretch(duration: f64) -> (f64, f64) {
    (0.0, BEGINNING * duration)
}

/// A time axis from 0 to `end`, of which the first `share` is shown to begin with.
pub fn timeline(end: Signal<f64>, share: f64) -> TimeAxis {
    let shown = RwSignal::new(None::<(f64, f64)>);
    let cursor = RwSignal::new(None::<f64>);
    let whole = Signal::derive(move || (0.0, end.get()));
    let window = Signal::derive(move || match (shown.get(), end.get()) {
        (Some(WHOLE), end) => (0.0, end),
        (Some((from, to)), end) if to <= end => (from, to),
        // A stretch of a longer record may lie beyond the end of this one.
        (_, end) => (0.0, share * end),
    });
    TimeAxis {
        whole,
        window,
        cursor: Signal::derive(move || cursor.get().filter(|time| *time <= end.get())),
        on_cursor: Callback::new(move |time| cursor.set(time)),
        on_show: Callback::new(move |stretch: Option<(f64, f64)>| shown.set(stretch.or(Some(WHOLE)))),
        about: Signal::stored(None),
        shortest: Signal::derive(move || SHORTEST * end.get()),
    }
}
