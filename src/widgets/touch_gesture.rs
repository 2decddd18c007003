use leptos::ev::PointerEvent;
use leptos::prelude::*;

/// How far a finger moves sideways until it means the slider and not the page (CSS px).
const SIDEWAYS_PX: f64 = 8.0;

/// What a finger on a slider means. It may be about to scroll the page, so nothing is taken over until it moves sideways or is
/// lifted; once the browser scrolls, it cancels the pointer. A mouse or a pen always means the slider. A handle: copying it
/// copies nothing.
#[derive(Clone, Copy)]
pub struct TouchGesture {
    undecided_from: StoredValue<Option<(f64, f64)>>,
}

impl TouchGesture {
    /// No finger yet.
    pub fn new() -> Self {
        Self { undecided_from: StoredValue::new(None) }
    }

    /// A pointer goes down.
    pub fn begin(self, event: &PointerEvent) {
        self.undecided_from.set_value((event.pointer_type() == "touch").then(|| place(event)));
    }

    /// Whether there is a finger that may still be about to scroll.
    pub fn is_undecided(self) -> bool {
        self.undecided_from.with_value(Option::is_some)
    }

    /// Whether a finger that was undecided has gone sideways: further than down or up.
    pub fn is_sideways(self, event: &PointerEvent) -> bool {
        let (x, y) = place(event);
        self.undecided_from.get_value().is_some_and(|from| {
            let (across, along) = ((x - from.0).abs(), (y - from.1).abs());
            across > SIDEWAYS_PX && across > along
        })
    }

    /// From now on it is decided; whether it was not.
    pub fn decide(self) -> bool {
        self.undecided_from.try_update_value(Option::take).flatten().is_some()
    }
}

fn place(event: &PointerEvent) -> (f64, f64) {
    (f64::from(event.client_x()), f64::from(event.client_y()))
}
