//! The time bar: an experiment as it happens, all of it in a few seconds, with a slider to any moment of it.

use gloo_timers::callback::Interval;
use leptos::prelude::*;

use crate::lab::Lab;
use crate::texts::{say, tr};

/// Between two pictures (ms): as often as texts are updated.
const TICK_MS: u32 = 50;
/// How long all of it takes (s).
const USUAL_S: u32 = 6;
/// The lengths to choose from (s).
const CHOICES_S: [u32; 4] = [3, USUAL_S, 12, 30];
/// The stretch begins so much before the first event, as a share of the whole.
const BEFORE_FIRST_EVENT: f64 = 0.02;
/// Steps of the slider from one end to the other.
const SLIDER_STEPS: f64 = 500.0;

/// A moment of an experiment that can run through it. A handle: copying it copies nothing.
#[derive(Clone, Copy)]
pub struct Playback {
    /// The shown moment (s); none at the end of the experiment.
    at: Signal<Option<f64>>,
    on_move: Callback<Option<f64>>,
    /// From where to where it runs (s).
    span: Signal<(f64, f64)>,
    length_s: RwSignal<u32>,
    is_running: RwSignal<bool>,
    timer: StoredValue<Option<Interval>, LocalStorage>,
}

impl Playback {
    /// A resting one; `on_move` is called with the next moment, and with none where the end is reached.
    pub fn new(at: Signal<Option<f64>>, on_move: Callback<Option<f64>>, span: Signal<(f64, f64)>) -> Self {
        let timer = StoredValue::new_local(None);
        on_cleanup(move || timer.dispose());
        Self { at, on_move, span, length_s: RwSignal::new(USUAL_S), is_running: RwSignal::new(false), timer }
    }

    /// Runs from the beginning.
    pub fn start(self) {
        self.on_move.run(Some(self.span.get_untracked().0));
        self.go_on();
    }

    fn go_on(self) {
        self.is_running.set(true);
        self.timer.set_value(Some(Interval::new(TICK_MS, move || self.tick())));
    }

    /// Stays where it is.
    pub fn stop(self) {
        self.is_running.set(false);
        self.timer.set_value(None);
    }

    fn tick(self) {
        // It waits while the page is in a hidden tab.
        if document().hidden() {
            return;
        }
        let (from, to) = self.span.get_untracked();
        let step = (to - from) * f64::from(TICK_MS) / 1000.0 / f64::from(self.length_s.get_untracked());
        let next = self.at.get_untracked().unwrap_or(from) + step;
        if next >= to {
            self.stop();
            self.on_move.run(None);
        } else {
            self.on_move.run(Some(next));
        }
    }

    fn press(self) {
        match (self.is_running.get_untracked(), self.at.get_untracked()) {
            (true, _) => self.stop(),
            (false, Some(time_s)) if time_s < self.span.get_untracked().1 => self.go_on(),
            (false, _) => self.start(),
        }
    }

    /// Shows the moment at a share of the whole, and stays there.
    fn scrub(self, share: f64) {
        self.stop();
        let (from, to) = self.span.get_untracked();
        self.on_move.run((share < 1.0).then_some(from + share * (to - from)));
    }

    fn share(self) -> f64 {
        let (from, to) = self.span.get();
        self.at.get().map_or(1.0, |time_s| ((time_s - from) / (to - from)).clamp(0.0, 1.0))
    }
}

/// From just before the first of `events` to `end` (s).
pub fn shown_times(events: impl Iterator<Item = f64>, end: f64) -> (f64, f64) {
    let first = events.reduce(f64::min).unwrap_or(0.0);
    ((first - BEFORE_FIRST_EVENT * end).clamp(0.0, end), end)
}

/// Whether the visitor asks for less motion.
pub fn prefers_less_motion() -> bool {
    let query = window().match_media("(prefers-reduced-motion: reduce)").ok().flatten();
    query.is_some_and(|query| query.matches())
}

/// Play and pause, the moment, and how long all of it takes.
#[component]
pub fn TimeBar(
    /// What it moves.
    playback: Playback,
    /// Beginning of its names for tests.
    id: &'static str,
    /// What all benches share.
    lab: Lab,
    /// Whether it has a slider to any moment; where one of the bench stands beside it, it need not.
    #[prop(default = true)]
    slider: bool,
) -> impl IntoView {
    let text = move || {
        if playback.is_running.get() {
            format!("❚❚ {}", tr!(lab, time.pause))
        } else {
            format!("▶ {}", tr!(lab, time.play))
        }
    };
    let choose = move |event| {
        if let Ok(length_s) = event_target_value(&event).parse() {
            playback.length_s.set(length_s);
        }
    };
    let scrub = move |event| {
        if let Ok(step) = event_target_value(&event).parse::<f64>() {
            playback.scrub(step / SLIDER_STEPS);
        }
    };
    let spoken = move || {
        let time_s = playback.at.get().unwrap_or_else(|| playback.span.get().1);
        format!("{} s", lab.number_style().fixed(time_s, 0))
    };
    view! {
        <div class="time-bar">
            <button
                type="button"
                class="button small"
                data-testid=id
                title=say!(lab, time.play_name)
                on:click=move |_| playback.press()
            >
                {text}
            </button>
            {slider.then(|| view! {
                <input
                    type="range"
                    min="0"
                    max=SLIDER_STEPS.to_string()
                    step="1"
                    aria-label=say!(lab, time.moment)
                    aria-valuetext=spoken
                    data-testid=format!("{id}-time")
                    prop:value=move || (SLIDER_STEPS * playback.share()).round().to_string()
                    on:input=scrub
                />
            })}
            <select class="small" data-testid=format!("{id}-length") aria-label=say!(lab, time.length) on:change=choose>
                {CHOICES_S.map(|length_s| view! {
                    <option value=length_s.to_string() selected=length_s == USUAL_S>{length_s} " s"</option>
                })}
            </select>
        </div>
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_begins_just_before_whatever_happens_first() {
        assert_eq!(shown_times([1500.0, 300.0].into_iter(), 1000.0), (280.0, 1000.0));
        assert_eq!(shown_times([5.0].into_iter(), 1000.0), (0.0, 1000.0));
        assert_eq!(shown_times(std::iter::empty(), 1000.0), (0.0, 1000.0));
        assert_eq!(shown_times([2000.0].into_iter(), 1000.0), (1000.0, 1000.0));
    }
}
