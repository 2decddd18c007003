//! The way of one change from an event to pixels, the same on every bench.
//!
//! A control edits a document. That asks for one animation frame; in it, what the change touched is computed once (however
//! many events came in between), the results are set, and the charts that show them repaint, all before the browser shows
//! the frame. Words, numbers and drawings follow as soon as that frame is on the screen: they cost the browser more than
//! the charts do, and nobody reads while dragging. Reading, computing, painting and telling never mix.

use std::rc::Rc;

use gloo_timers::callback::Timeout;
use leptos::prelude::*;

use super::timing::Stopwatch;

/// Computes what changed and returns what hands it to the panels; nothing once the document is gone.
type Compute = Rc<dyn Fn() -> Option<Box<dyn FnOnce()>>>;

/// Follows a document. A handle: copying it copies nothing.
#[derive(Clone, Copy)]
pub struct FrameScheduler {
    backstage: StoredValue<Backstage, LocalStorage>,
}

struct Backstage {
    stopwatch: Stopwatch,
    compute: Compute,
    tell: Rc<dyn Fn()>,
    /// What comes after the frame. Kept, not forgotten: a forgotten timer is never freed.
    next: Option<Timeout>,
    /// What comes after the words.
    told: Option<Timeout>,
}

impl FrameScheduler {
    /// From now on every change of `document` is computed and told.
    pub fn follow<T: Send + Sync + 'static>(
        document: RwSignal<T>,
        compute: impl Fn() -> Option<Box<dyn FnOnce()>> + 'static,
        tell: impl Fn() + 'static,
    ) {
        let (stopwatch, compute, tell) = (Stopwatch::default(), Rc::new(compute), Rc::new(tell));
        let backstage = StoredValue::new_local(Backstage { stopwatch, compute, tell, next: None, told: None });
        let scheduler = Self { backstage };
        // The document as it stands is computed already.
        let mut known = false;
        Effect::new(move || {
            document.track();
            if known {
                scheduler.request_frame();
            }
            known = true;
        });
    }

    fn request_frame(self) {
        if self.backstage.try_update_value(|b| b.stopwatch.begin()) == Some(true) {
            request_animation_frame(move || self.frame());
        }
    }

    /// One frame: compute what changed since the last one, hand it to the panels, and note how long it took.
    fn frame(self) {
        let Some(compute) = self.backstage.try_update_value(|b| {
            b.stopwatch.start_computing();
            b.compute.clone()
        }) else {
            return;
        };
        let publish = compute();
        self.backstage.try_update_value(|b| b.stopwatch.stop_computing());
        if let Some(publish) = publish {
            publish();
        }
        // A task after this frame: by then the charts are painted.
        self.after(0, Self::painted);
    }

    /// The charts are on the screen: the words follow, at once if it is time for them.
    fn painted(self) {
        let due = self.backstage.try_update_value(|b| {
            b.stopwatch.end();
            (b.stopwatch.are_words_due(), b.stopwatch.pause_ms())
        });
        match due {
            Some((true, _)) => self.tell(),
            // The next frame replaces this timer and decides anew.
            Some((false, pause_ms)) => self.after(pause_ms, Self::tell),
            None => {}
        }
    }

    fn after(self, delay_ms: u32, next: fn(Self)) {
        let timer = Timeout::new(delay_ms, move || next(self));
        self.backstage.try_update_value(|b| b.next = Some(timer));
    }

    fn tell(self) {
        let Some(tell) = self.backstage.try_update_value(|b| {
            b.stopwatch.tell();
            b.tell.clone()
        }) else {
            return;
        };
        tell();
        let told = Timeout::new(0, move || self.told());
        self.backstage.try_update_value(|b| b.told = Some(told));
    }

    fn told(self) {
        // Asking for a height lays the new words out now, not within the next frame of the charts.
        if let Some(page) = document().body() {
            page.offset_height();
        }
        self.backstage.try_update_value(|b| b.stopwatch.told());
    }
}
