//! What mends a warning: a button at the end of its sentence, which is one step to undo.

use leptos::prelude::*;

use super::flags::locks;
use super::session::{Session, use_session};
use crate::texts::tr;
use quadtank::study::quadruple_tank::{Mend, mend_loop, mend_rest, mend_run};

/// What makes the loop stable.
pub fn of_loop(session: Session) -> Option<Mend> {
    let setup = session.throttled.setup.get();
    session.throttled.analysis.with(|outcome| mend_loop(&setup, outcome.as_ref().as_ref().ok()))
}

/// The same on the card with the pairing, whose switch offers the advised one itself.
pub fn of_gains(session: Session) -> Option<Mend> {
    of_loop(session).filter(|mend| *mend != Mend::AdvisedPairing)
}

/// What brings the operating point within the rig.
pub fn of_rest(session: Session) -> Option<Mend> {
    session.throttled.setup.with(|setup| mend_rest(setup))
}

/// What lets the run answer its steps: a stable loop first, then an experiment within the rig.
pub fn of_run(session: Session) -> Option<Mend> {
    let setup = session.throttled.setup.get();
    of_loop(session).or_else(|| session.throttled.run.with(|outcome| mend_run(&setup, outcome.as_ref().as_ref().ok()?)))
}

/// The button; nothing where nothing mends it. In a lesson the student is to find out.
#[component]
pub fn MendButton(
    /// Name for tests.
    id: &'static str,
    /// What is offered.
    offer: fn(Session) -> Option<Mend>,
) -> impl IntoView {
    let session = use_session();
    let offered = Memo::new(move |_| offer(session).filter(|_| session.lab.stage.with(Option::is_none)));
    let button = move |mend: Mend| {
        view! {
            <button type="button" class="button small" data-testid=id disabled=is_locked(session, mend) on:click=move |_| take(session, mend)>
                {move || name(session, mend)}
            </button>
        }
    };
    view! {
        <div class="toolbar mends" hidden=move || offered.with(Option::is_none)>{move || offered.get().map(button)}</div>
    }
}

fn take(session: Session, mend: Mend) {
    let mended = session.document.with_untracked(|document| mend.applied(&document.setup));
    if let Some(mended) = mended {
        session.edit(|setup| *setup = mended);
    }
}

/// What the mend does.
fn name(session: Session, mend: Mend) -> String {
    let lab = session.lab;
    match mend {
        Mend::DetuneLoops => tr!(lab, mend.calm),
        Mend::AdvisedPairing => tr!(lab, mend.pairing),
        Mend::PublishedValves => tr!(lab, mend.valves),
        Mend::LowerRest => tr!(lab, mend.rest),
        Mend::HalvedSteps => tr!(lab, mend.steps),
    }
}

fn is_locked(session: Session, mend: Mend) -> bool {
    let needed = match mend {
        Mend::DetuneLoops => &[locks::GAINS][..],
        Mend::AdvisedPairing => &[locks::PAIRING, locks::GAINS],
        Mend::PublishedValves => &[locks::VALVES],
        Mend::LowerRest => &[locks::VOLTAGES],
        Mend::HalvedSteps => &[locks::EXPERIMENT],
    };
    needed.iter().any(|&lock| session.lab.locks(lock))
}
