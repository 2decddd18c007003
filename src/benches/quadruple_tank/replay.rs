//! The run as it happens: after each change its curves are drawn and its water moves.

use gloo_timers::callback::Timeout;
use leptos::prelude::*;

use super::session::Session;
use crate::widgets::{Playback, prefers_less_motion, shown_times};
use quadtank::sim::Experiment;

/// How long a change has to rest until the run is shown (ms).
const RESTED_MS: u32 = 500;

/// From just before the first event to the end (s).
fn span(experiment: &Experiment) -> (f64, f64) {
    let steps = experiment.set_point_steps.iter().map(|step| step.time_s);
    shown_times(steps.chain(experiment.load_steps.iter().map(|step| step.time_s)), experiment.duration_s)
}

/// A playback of the run that starts after each change of the setup; who prefers less motion sees the whole run at once.
pub fn replay_changes(session: Session) -> Playback {
    let position = session.own.playback;
    let on_move = Callback::new(move |time| position.set(time));
    let playback = Playback::new(position.into(), on_move, session.part(|s| span(&s.experiment)));
    let waiting = StoredValue::new_local(None);
    let setup = session.part(Clone::clone);
    Effect::new(move || {
        // `track` alone does not compute the memo, and a memo that was never computed does not notify.
        setup.with(|_| ());
        playback.stop();
        position.set(None);
        if !prefers_less_motion() {
            waiting.set_value(Some(Timeout::new(RESTED_MS, move || playback.start())));
        }
    });
    on_cleanup(move || {
        waiting.dispose();
        position.set(None);
    });
    playback
}

/// A playback that moves the cursor of the document through the run.
pub fn play_cursor(session: Session) -> Playback {
    let cursor = Signal::derive(move || session.document.with(|s| s.view.cursor_s));
    let on_move = Callback::new(move |time| session.document.update(|s| s.view.cursor_s = time));
    Playback::new(cursor, on_move, session.part(|s| span(&s.experiment)))
}
