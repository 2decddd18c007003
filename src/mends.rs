//! Buttons after warnings that apply a correction, as one step to undo.

use leptos::prelude::*;
use quadtank_scenario::BenchDocument;

use super::session::{Bench, Lock, Session, SetupOf};

/// A correction that a bench offers with a warning.
pub trait MendFor<B: Bench>: Copy + PartialEq + Send + Sync + 'static {
    /// Label of the button.
    fn name(self, session: Session<B>) -> String;

    /// Lock groups of the controls that it changes.
    fn locks(self) -> &'static [Lock];

    /// The corrected setup; `None` where it would change nothing.
    fn mended(self, setup: &SetupOf<B>) -> Option<SetupOf<B>>;
}

/// The button, shown while a correction is offered. Lessons have none: there the student is to find out.
#[component]
pub fn MendButton<B: Bench, M: MendFor<B>>(
    /// The bench.
    session: Session<B>,
    /// Name for tests.
    id: &'static str,
    /// The correction that is offered now.
    offer: fn(Session<B>) -> Option<M>,
) -> impl IntoView {
    let lab = session.lab;
    let offered = Memo::new(move |_| offer(session).filter(|_| lab.stage.with(Option::is_none)));
    let button = move |mend: M| {
        let is_locked = mend.locks().iter().any(|&lock| lab.locks(lock));
        view! {
            <button type="button" class="button small" data-testid=id disabled=is_locked on:click=move |_| take(session, mend)>
                {move || mend.name(session)}
            </button>
        }
    };
    view! {
        <div class="toolbar mends" hidden=move || offered.with(Option::is_none)>{move || offered.get().map(button)}</div>
    }
}

fn take<B: Bench>(session: Session<B>, mend: impl MendFor<B>) {
    if let Some(mended) = session.document.with_untracked(|document| mend.mended(document.setup())) {
        session.edit(|setup| *setup = mended);
    }
}
