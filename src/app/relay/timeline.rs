//! The time axis of a picture over time, which remembers what of it is shown while the bench is open.

use leptos::prelude::*;

use crate::app::widgets::TimeAxis;

/// Share of all time that is the shortest stretch to be shown.
const SHORTEST: f64 = 0.005;

/// What is shown of a record.
#[derive(Clone, Copy)]
enum Shown {
    /// As much of its beginning as shows what it is like.
    Beginning,
    Whole,
    Stretch(f64, f64),
}

/// A time axis from 0 to `end`, of which the first `share` is shown to begin with.
pub fn timeline(end: Signal<f64>, share: f64) -> TimeAxis {
    let shown = RwSignal::new(Shown::Beginning);
    let cursor = RwSignal::new(None::<f64>);
    let whole = Signal::derive(move || (0.0, end.get()));
    let window = Signal::derive(move || match (shown.get(), end.get()) {
        (Shown::Whole, end) => (0.0, end),
        (Shown::Stretch(from, to), end) if to <= end => (from, to),
        // A stretch of a longer record may lie beyond the end of this one.
        (Shown::Beginning | Shown::Stretch(..), end) => (0.0, share * end),
    });
    TimeAxis {
        whole,
        window,
        cursor: Signal::derive(move || cursor.get().filter(|time| *time <= end.get())),
        on_cursor: Callback::new(move |time| cursor.set(time)),
        on_show: Callback::new(move |stretch: Option<(f64, f64)>| {
            shown.set(stretch.map_or(Shown::Whole, |(from, to)| Shown::Stretch(from, to)));
        }),
        about: Signal::stored(None),
        shortest: SHORTEST * end.get_untracked(),
    }
}
