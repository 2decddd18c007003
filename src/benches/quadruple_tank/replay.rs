//! The run as it happens: after each change its curves are drawn and its water moves, one step of the experiment in a few seconds.

use gloo_timers::callback::{Interval, Timeout};
use leptos::prelude::*;

use super::session::Session;
use crate::texts::{say, tr};
use quadtank::sim::Experiment;

/// Between two pictures (ms): as often as texts are updated.
const TICK_MS: u32 = 50;
/// How long a change has to rest until the run is shown (ms).
const RESTED_MS: u32 = 500;
/// How long a run is shown (s).
const USUAL_S: u32 = 6;
/// The lengths to choose from (s).
const CHOICES_S: [u32; 4] = [3, USUAL_S, 12, 30];
/// The run is shown from so much before the first event on, as a share of all of it.
const BEFORE_FIRST_EVENT: f64 = 0.02;

/// A running or resting replay. A handle: copying it copies nothing.
#[derive(Clone, Copy)]
pub struct Replay {
    session: Session,
    length_s: RwSignal<u32>,
    is_running: RwSignal<bool>,
    timer: StoredValue<Option<Interval>, LocalStorage>,
    waiting: StoredValue<Option<Timeout>, LocalStorage>,
}

impl Replay {
    /// A replay that starts after each change of the setup; who prefers less motion sees the whole run at once.
    pub fn follow(session: Session) -> Self {
        let replay = Self {
            session,
            length_s: RwSignal::new(USUAL_S),
            is_running: RwSignal::new(false),
            timer: StoredValue::new_local(None),
            waiting: StoredValue::new_local(None),
        };
        let setup = session.part(Clone::clone);
        Effect::new(move || {
            // `track` alone does not compute the memo, and a memo that was never computed does not notify.
            setup.with(|_| ());
            replay.stop();
            session.own.playback.set(None);
            if !prefers_less_motion() {
                replay.waiting.set_value(Some(Timeout::new(RESTED_MS, move || replay.start())));
            }
        });
        on_cleanup(move || {
            replay.timer.dispose();
            replay.waiting.dispose();
            session.own.playback.set(None);
        });
        replay
    }

    /// Shows the run from just before its first event on.
    pub fn start(self) {
        let (from, _) = self.session.document.with_untracked(|s| shown_times(&s.setup.experiment));
        self.session.own.playback.set(Some(from));
        self.go_on();
    }

    fn go_on(self) {
        self.is_running.set(true);
        self.timer.set_value(Some(Interval::new(TICK_MS, move || self.tick())));
    }

    fn stop(self) {
        self.is_running.set(false);
        self.timer.set_value(None);
        self.waiting.set_value(None);
    }

    fn tick(self) {
        // The replay waits while the page is in a hidden tab.
        if document().hidden() {
            return;
        }
        let (from, to) = self.session.document.with_untracked(|s| shown_times(&s.setup.experiment));
        let step = (to - from) * f64::from(TICK_MS) / 1000.0 / f64::from(self.length_s.get_untracked());
        let next = self.session.own.playback.get_untracked().unwrap_or(from) + step;
        if next >= to {
            self.stop();
            self.session.own.playback.set(None);
        } else {
            self.session.own.playback.set(Some(next));
        }
    }
}

/// From just before the first event to the end (s).
fn shown_times(experiment: &Experiment) -> (f64, f64) {
    let steps = experiment.set_point_steps.iter().map(|step| step.time_s);
    let first = steps.chain(experiment.load_steps.iter().map(|step| step.time_s)).reduce(f64::min).unwrap_or(0.0);
    let end = experiment.duration_s;
    ((first - BEFORE_FIRST_EVENT * end).clamp(0.0, end), end)
}

fn prefers_less_motion() -> bool {
    let query = window().match_media("(prefers-reduced-motion: reduce)").ok().flatten();
    query.is_some_and(|query| query.matches())
}

/// Again, stop and go on, and how long it takes.
#[component]
pub fn ReplayControls(replay: Replay) -> impl IntoView {
    let lab = replay.session.lab;
    let playback = replay.session.own.playback;
    let press = move |_| match (replay.is_running.get_untracked(), playback.get_untracked()) {
        (true, _) => replay.stop(),
        (false, Some(_)) => replay.go_on(),
        (false, None) => replay.start(),
    };
    let text = move || match (replay.is_running.get(), playback.get()) {
        (true, _) => format!("❚❚ {}", tr!(lab, explore.pause)),
        (false, Some(_)) => format!("▶ {}", tr!(lab, explore.go_on)),
        (false, None) => format!("▶ {}", tr!(lab, explore.again)),
    };
    let choose = move |event| {
        if let Ok(length_s) = event_target_value(&event).parse() {
            replay.length_s.set(length_s);
        }
    };
    view! {
        <div class="toolbar play">
            <button type="button" class="button small" data-testid="replay" on:click=press>{text}</button>
            <select class="small" data-testid="replay-length" aria-label=say!(lab, explore.length) on:change=choose>
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
    use quadtank::literature::PresetId;
    use quadtank::sim::{Load, LoadStep};
    use quadtank::study::quadruple_tank::setup_of;

    #[test]
    fn a_replay_begins_just_before_whatever_happens_first() {
        let mut experiment = setup_of(PresetId::JohanssonMinimumPhase).experiment;
        experiment.duration_s = 1000.0;
        experiment.set_point_steps.truncate(1);
        experiment.set_point_steps[0].time_s = 300.0;
        assert_eq!(shown_times(&experiment), (280.0, 1000.0));
        experiment.load_steps.push(LoadStep { time_s: 5.0, load: Load::PumpFlow { pump: 0, flow: 1e-6 } });
        assert_eq!(shown_times(&experiment), (0.0, 1000.0));
    }
}
