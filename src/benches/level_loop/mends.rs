//! What mends a warning: a button at the end of its sentence, which is one step to undo.

use leptos::prelude::*;
use quadtank::study::level_loop::{Mend, mend_loop, mend_run, mend_start};

use super::flags::locks;
use super::session::{Session, use_session};
use crate::texts::tr;

/// What makes the loop calm.
pub fn of_loop(session: Session) -> Option<Mend> {
    let setup = session.throttled.setup.get();
    session.throttled.with_answer(|answer| mend_loop(&setup, answer)).flatten()
}

/// What lets the run go to its set-point: a calm loop first, then a level that can be held.
pub fn of_run(session: Session) -> Option<Mend> {
    let setup = session.throttled.setup.get();
    session.throttled.with_answer(|answer| mend_run(&setup, answer)).flatten()
}

/// What lets the loop rest where the experiment begins.
pub fn of_start(session: Session) -> Option<Mend> {
    session.throttled.setup.with(|setup| mend_start(setup))
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
            <button
                type="button"
                class="button small"
                data-testid=id
                disabled=is_locked(session, mend)
                on:click=move |_| session.edit(|setup| *setup = mend.applied(setup))
            >
                {move || name(session, mend)}
            </button>
        }
    };
    view! {
        <div class="toolbar mends" hidden=move || offered.with(Option::is_none)>{move || offered.get().map(button)}</div>
    }
}

/// What the mend does.
fn name(session: Session, mend: Mend) -> String {
    let lab = session.lab;
    let style = lab.number_style();
    let cm = |metres: f64| style.fixed(100.0 * metres, 1);
    match mend {
        Mend::AdvisedTuning(tuning) => {
            let (gain, time) = (style.significant(tuning.gain, 3), style.significant(tuning.integral_time_s, 3));
            tr!(lab, mend.advised_tuning, gain = gain, time = time)
        }
        Mend::SetPoint(level) => tr!(lab, mend.set_point, level = cm(level)),
        Mend::Start(level) => tr!(lab, mend.start, level = cm(level)),
    }
}

fn is_locked(session: Session, mend: Mend) -> bool {
    session.lab.locks(match mend {
        Mend::AdvisedTuning(_) => locks::GAINS,
        Mend::SetPoint(_) | Mend::Start(_) => locks::EXPERIMENT,
    })
}
