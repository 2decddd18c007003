//! How long a change takes, reported to the browser as User Timing entries (`quadtank:compute`, `quadtank:paint`,
//! `quadtank:words`).
//!
//! Always on: an entry costs a microsecond, and anybody can read them in the developer tools. `make bench` does.

use leptos::prelude::window;

/// The change that is under way. Times live in the marks of the browser; this only knows which mark is whose.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stopwatch {
    /// What waits for its frame.
    frame: Turn,
    /// What waits for its texts.
    texts: Turn,
    /// When the first change came in that waits for its frame, and when that which is being painted (ms).
    waiting_since_ms: f64,
    painting_since_ms: f64,
    /// How long the last frame took (ms).
    frame_ms: f64,
    /// When texts were updated last (ms).
    texts_ms: f64,
    entries: u32,
}

/// A batch of changes that waits for a frame or for the texts. Changes that arrive while a batch is being processed use
/// the second of two marks.
#[derive(Clone, Copy, Debug, Default)]
struct Turn {
    waiting: bool,
    taken: usize,
}

impl Turn {
    /// A change waits from now on; true if it is the first to do so.
    fn wait(&mut self, marks: [&str; 2]) -> bool {
        let first = !self.waiting;
        if first {
            self.waiting = true;
            mark(marks[1 - self.taken]);
        }
        first
    }

    /// What waits is taken up.
    fn take(&mut self) {
        self.waiting = false;
        self.taken = 1 - self.taken;
    }
}

const EVENT_MARKS: [&str; 2] = ["quadtank:event-a", "quadtank:event-b"];
const COMPUTE_MARK: &str = "quadtank:computing";
const TEXTS_MARKS: [&str; 2] = ["quadtank:untold-a", "quadtank:untold-b"];

/// A frame of a screen of 60 Hz (ms).
const IN_TIME_MS: f64 = 1000.0 / 60.0;
/// Between two updates of the texts while the hand moves on (ms): where frames are in time, and where they are late.
/// Updating them costs a frame or so; nobody reads numbers that change more often.
const BETWEEN_TEXTS_MS: [f64; 2] = [50.0, 1000.0];
/// How long nothing must change for a pause of the hand (ms): two frames, within these limits.
const PAUSE_MS: (f64, f64) = (40.0, 200.0);

/// How many entries are kept before they are dropped, so that a long lecture does not fill the memory.
const KEPT: u32 = 4000;

impl Stopwatch {
    /// A change came in; true when a frame has to be asked for.
    pub fn begin(&mut self) -> bool {
        let first = self.frame.wait(EVENT_MARKS);
        if first {
            self.waiting_since_ms = now_ms();
            self.texts.wait(TEXTS_MARKS);
        }
        first
    }

    /// A frame takes up what came in, and computes.
    pub fn start_computing(&mut self) {
        self.frame.take();
        self.painting_since_ms = self.waiting_since_ms;
        mark(COMPUTE_MARK);
    }

    /// The computation is done.
    pub fn stop_computing(&mut self) {
        self.measure("quadtank:compute", COMPUTE_MARK);
    }

    /// The charts are painted.
    pub fn end(&mut self) {
        self.measure("quadtank:paint", EVENT_MARKS[self.frame.taken]);
        self.frame_ms = now_ms() - self.painting_since_ms;
    }

    /// Words that have to wait come when nothing has changed for so long (ms).
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a short time")]
    pub fn pause_ms(&self) -> u32 {
        (2.0 * self.frame_ms).clamp(PAUSE_MS.0, PAUSE_MS.1) as u32
    }

    /// Whether texts may follow the charts at once.
    pub fn are_texts_due(&self) -> bool {
        let late = usize::from(self.frame_ms > IN_TIME_MS);
        now_ms() - self.texts_ms >= BETWEEN_TEXTS_MS[late]
    }

    /// The texts are about to follow. Those of a change that still waits for its frame come later.
    pub fn begin_texts(&mut self) {
        self.texts_ms = now_ms();
        self.texts.take();
        if self.frame.waiting {
            self.texts.wait(TEXTS_MARKS);
        }
    }

    /// The texts are on the page.
    pub fn end_texts(&mut self) {
        self.measure("quadtank:words", TEXTS_MARKS[self.texts.taken]);
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

/// Time since the page began (ms).
pub fn now_ms() -> f64 {
    window().performance().map_or(0.0, |clock| clock.now())
}

fn mark(name: &str) {
    if let Some(clock) = window().performance() {
        let _ = clock.mark(name);
    }
}
