//! The first visit: the rig, what its levels do, the valves, who controls whom, and three things to try. All else is folded.

mod drawers;
mod levels;
mod pairing;
mod prompts;

use leptos::prelude::*;

use super::replay::replay_changes;
use super::rig::Rig;
use super::session::{release_levels, use_session};
use super::valves::ValveMapCard;
use crate::lessons::FirstLesson;
use crate::texts::{say, tr};
use crate::widgets::{Card, marked};

/// Everything that a first visit sees.
#[component]
pub fn Explore() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let replay = replay_changes(session);
    // The cards know voltages.
    on_cleanup(move || release_levels(session));
    view! {
        <div class="explore">
            <div class="lead">
                <p>{move || marked(&tr!(lab, explore.lead))}</p>
                <FirstLesson />
            </div>
            <Card name="bigrig" title=say!(lab, explore.rig)>
                <Rig />
                <p class="hint">{say!(lab, explore.hint)}</p>
            </Card>
            <levels::LevelsCard replay />
            <ValveMapCard />
            <pairing::PairingCard />
            <prompts::Prompts />
            <drawers::Drawers />
        </div>
    }
}
