//! The cursor in time: it says which moment the drawing shows, and it can run.

use leptos::prelude::*;

use super::session::use_session;
use crate::widgets::Player;

/// How much faster than life the run can be shown.
const SPEEDS: &[u32] = &[1, 5, 20, 100];
const USUAL_SPEED: u32 = 20;

/// Runs the cursor through the experiment; the drawing follows.
#[component]
pub fn PlayControls() -> impl IntoView {
    let session = use_session();
    view! {
        <Player
            cursor=Signal::derive(move || session.document.with(|s| s.view.cursor_s))
            on_cursor=Callback::new(move |time| session.document.update(|s| s.view.cursor_s = Some(time)))
            end=session.part(|s| s.experiment.duration_s)
            speeds=SPEEDS
            usual_speed=USUAL_SPEED
            ids=("play", "speed")
        />
    }
}
