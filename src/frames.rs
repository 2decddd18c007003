//! One change from an event to pixels, the same on every bench.
//!
//! A control edits a document. That asks for one animation frame; in it, what the change touched is computed once (however
//! many events came in between), the results are set, and the charts that show them repaint, all before the browser shows
//! the frame. Texts (sentences, tables, values of controls, drawings) follow once that frame is on the screen, at most about twenty
//! times a second: laying them out costs the browser more than the charts do, and nobody reads while dragging.

use std::rc::Rc;

use gloo_timers::callback::Timeout;
use leptos::prelude::*;

use super::timing::Stopwatch;

/// Computes the results of the changed document and returns a closure that publishes them to the views; `None` once the
/// document has been disposed of.
type Compute = Rc<dyn Fn() -> Option<Box<dyn FnOnce()>>>;

/// Follows a document. A handle: copying it copies nothing.
#[derive(Clone, Copy)]
pub struct FrameScheduler {
    state: StoredValue<SchedulerState, LocalStorage>,
}

struct SchedulerState {
    stopwatch: Stopwatch,
    compute: Compute,
    update_texts: Rc<dyn Fn()>,
    /// What comes after the frame. Kept, not forgotten: a forgotten timer is never freed.
    next: Option<Timeout>,
    /// What comes after the texts.
    after_texts: Option<Timeout>,
}

impl FrameScheduler {
    /// Computes the results after every change of `document`, whose present state is computed already, and updates the
    /// texts after each frame.
    pub fn follow<T: Clone + PartialEq + Send + Sync + 'static>(
        document: RwSignal<T>,
        compute: impl Fn() -> Option<Box<dyn FnOnce()>> + 'static,
        update_texts: impl Fn() + 'static,
    ) {
        let (stopwatch, compute, update_texts) = (Stopwatch::default(), Rc::new(compute), Rc::new(update_texts));
        let state =
            StoredValue::new_local(SchedulerState { stopwatch, compute, update_texts, next: None, after_texts: None });
        let scheduler = Self { state };
        // The effect below runs for the first time after this function has returned. A lesson or a link that has set another document
        // by then needs a frame, or the page keeps showing the results of the first one.
        let mut computed = Some(document.get_untracked());
        Effect::new(move || {
            document.track();
            let is_computed = computed.take().is_some_and(|first| document.with_untracked(|now| *now == first));
            if !is_computed {
                scheduler.request_frame();
            }
        });
    }

    fn request_frame(self) {
        if self.state.try_update_value(|b| b.stopwatch.begin()) == Some(true) {
            request_animation_frame(move || self.frame());
        }
    }

    /// One animation frame: computes the changes since the last one, publishes the results and records the time.
    fn frame(self) {
        let Some(compute) = self.state.try_update_value(|b| {
            b.stopwatch.start_computing();
            b.compute.clone()
        }) else {
            return;
        };
        let publish = compute();
        self.state.try_update_value(|b| b.stopwatch.stop_computing());
        if let Some(publish) = publish {
            publish();
        }
        // A task after this frame: by then the charts are painted.
        self.after(0, Self::painted);
    }

    /// The charts are on the screen: the texts follow, at once if it is time for them.
    fn painted(self) {
        let due = self.state.try_update_value(|b| {
            b.stopwatch.end();
            (b.stopwatch.are_texts_due(), b.stopwatch.pause_ms())
        });
        match due {
            Some((true, _)) => self.update_texts(),
            // The next frame replaces this timer and decides anew.
            Some((false, pause_ms)) => self.after(pause_ms, Self::update_texts),
            None => {}
        }
    }

    fn after(self, delay_ms: u32, next: fn(Self)) {
        let timer = Timeout::new(delay_ms, move || next(self));
        self.state.try_update_value(|b| b.next = Some(timer));
    }

    fn update_texts(self) {
        let Some(update_texts) = self.state.try_update_value(|b| {
            b.stopwatch.begin_texts();
            b.update_texts.clone()
        }) else {
            return;
        };
        update_texts();
        let after = Timeout::new(0, move || self.texts_updated());
        self.state.try_update_value(|b| b.after_texts = Some(after));
    }

    fn texts_updated(self) {
        // Asking for a height lays the new texts out now, not within the next frame of the charts.
        if let Some(page) = document().body() {
            page.offset_height();
        }
        self.state.try_update_value(|b| b.stopwatch.end_texts());
    }
}
