//! How long a change takes, told to the browser as User Timing entries (`quadtank:compute`, `quadtank:paint`).
//!
//! Always on: an entry costs a microsecond, and anybody can read them in the developer tools. `make bench` does.

use leptos::prelude::window;

/// The change that is under way. Times live in the marks of the browser; this only knows which mark is whose.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stopwatch {
    /// Whether a change has come in that no frame has taken up yet.
    waiting: bool,
    /// A change that comes in while a frame is being painted gets the other mark.
    frame: bool,
    entries: u32,
}

const EVENT_MARKS: [&str; 2] = ["quadtank:event-a", "quadtank:event-b"];
const COMPUTE_MARK: &str = "quadtank:computing";

/// How many entries are kept before they are dropped, so that a long lecture does not fill the memory.
const KEPT: u32 = 4000;

impl Stopwatch {
    /// A change came in; true when a frame has to be asked for.
    pub fn begin(&mut self) -> bool {
        let first = !self.waiting;
        if first {
            self.waiting = true;
            mark(EVENT_MARKS[usize::from(!self.frame)]);
        }
        first
    }

    /// A frame takes up what came in, and computes.
    pub fn start_computing(&mut self) {
        self.waiting = false;
        self.frame = !self.frame;
        mark(COMPUTE_MARK);
    }

    /// The computation is done.
    pub fn stop_computing(&mut self) {
        self.measure("quadtank:compute", COMPUTE_MARK);
    }

    /// The frame is painted.
    pub fn end(&mut self) {
        self.measure("quadtank:paint", EVENT_MARKS[usize::from(self.frame)]);
    }

    /// The time since a mark becomes an entry; the mark goes, so that none is counted twice.
    fn measure(&mut self, name: &str, since: &str) {
        let Some(clock) = window().performance() else { return };
        self.entries += 1;
        if self.entries > KEPT {
            self.entries = 0;
            clock.clear_measures();
        }
        // Fails only where the mark is gone already, and then there is nothing to measure.
        let _ = clock.measure_with_start_mark(name, since);
        clock.clear_marks_with_mark_name(since);
    }
}

fn mark(name: &str) {
    if let Some(clock) = window().performance() {
        let _ = clock.mark(name);
    }
}
