//! How long a change takes, told to the browser as User Timing entries (`quadtank:compute`, `quadtank:paint`,
//! `quadtank:words`).
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
    /// When the change came in that is being painted, and how long that took (ms).
    begun_ms: f64,
    frame_ms: f64,
    /// When words were told last (ms).
    told_ms: f64,
    entries: u32,
}

const EVENT_MARKS: [&str; 2] = ["quadtank:event-a", "quadtank:event-b"];
const COMPUTE_MARK: &str = "quadtank:computing";
const WORDS_MARK: &str = "quadtank:untold";

/// A frame of a screen of 60 Hz (ms).
const IN_TIME_MS: f64 = 1000.0 / 60.0;
/// Between two changes of the words while the hand moves on (ms): where frames are in time, and where they are late.
/// Telling costs a frame or so; nobody reads numbers that change more often.
const BETWEEN_WORDS_MS: [f64; 2] = [50.0, 500.0];

/// How many entries are kept before they are dropped, so that a long lecture does not fill the memory.
const KEPT: u32 = 4000;

impl Stopwatch {
    /// A change came in; true when a frame has to be asked for.
    pub fn begin(&mut self) -> bool {
        let first = !self.waiting;
        if first {
            self.waiting = true;
            mark(EVENT_MARKS[usize::from(!self.frame)]);
            self.begun_ms = now_ms();
            mark(WORDS_MARK);
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

    /// The charts are painted.
    pub fn end(&mut self) {
        self.measure("quadtank:paint", EVENT_MARKS[usize::from(self.frame)]);
        self.frame_ms = now_ms() - self.begun_ms;
    }

    /// Whether words may follow the charts at once.
    pub fn are_words_due(&self) -> bool {
        let late = usize::from(self.frame_ms > IN_TIME_MS);
        now_ms() - self.told_ms >= BETWEEN_WORDS_MS[late]
    }

    /// The words are about to follow.
    pub fn tell(&mut self) {
        self.told_ms = now_ms();
    }

    /// The words are on the page.
    pub fn told(&mut self) {
        self.measure("quadtank:words", WORDS_MARK);
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

fn now_ms() -> f64 {
    window().performance().map_or(0.0, |clock| clock.now())
}

fn mark(name: &str) {
    if let Some(clock) = window().performance() {
        let _ = clock.mark(name);
    }
}
