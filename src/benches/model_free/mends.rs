//! What mends a run that is lost: a button at the end of its sentence, which is one step to undo.

use leptos::prelude::*;

use super::flags::locks;
use super::session::{Session, use_session};
use crate::texts::tr;
use quadtank::study::model_free::{ModelFreeMend, mend_model_free};

/// The button; nothing where the run is not lost, or nothing mends it. In a lesson the student is to find out.
#[component]
pub fn MendButton(
    /// Whether the run is lost.
    #[prop(into)]
    is_lost: Signal<bool>,
) -> impl IntoView {
    let session = use_session();
    let offered = Memo::new(move |_| {
        let is_asked = is_lost.get() && session.lab.stage.with(Option::is_none);
        is_asked.then(|| session.throttled.setup.with(|setup| mend_model_free(setup))).flatten()
    });
    let button = move |mend: ModelFreeMend| {
        view! {
            <button type="button" class="button small" data-testid="mend-free" disabled=is_locked(session, mend) on:click=move |_| take(session, mend)>
                {move || name(session, mend)}
            </button>
        }
    };
    view! {
        <div class="toolbar mends" hidden=move || offered.with(Option::is_none)>{move || offered.get().map(button)}</div>
    }
}

fn take(session: Session, mend: ModelFreeMend) {
    let mended = session.document.with_untracked(|document| mend.applied(&document.model_free));
    if let Some(mended) = mended {
        session.edit(|setup| *setup = mended);
    }
}

/// What the mend does.
fn name(session: Session, mend: ModelFreeMend) -> String {
    let lab = session.lab;
    match mend {
        ModelFreeMend::OtherPairing => tr!(lab, mend.other_pairing),
        ModelFreeMend::EasySide => tr!(lab, mend.easy_side),
    }
}

fn is_locked(session: Session, mend: ModelFreeMend) -> bool {
    let needed = match mend {
        ModelFreeMend::OtherPairing => &[locks::PAIRING][..],
        ModelFreeMend::EasySide => &[locks::VALVES, locks::PAIRING],
    };
    needed.iter().any(|&lock| session.lab.locks(lock))
}
