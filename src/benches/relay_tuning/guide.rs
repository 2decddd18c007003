//! The way through the four steps: on a first visit the relays are off, and each step opens when the one before it is seen.

use leptos::prelude::*;

use super::session::{Session, use_session};
use super::timeline::first_stretch;
use crate::depth::Depth;
use crate::texts::{say, tr};
use crate::widgets::{Playback, marked, prefers_less_motion};

/// The last step.
const LAST: u8 = 4;

/// How far the steps are open, and how far the relay test has been shown.
#[derive(Clone, Copy)]
pub struct Guide {
    /// The last open step; 0 while the relays are off.
    reached: RwSignal<u8>,
    /// The moment of the relay test that is shown; all of it where there is none.
    playback: RwSignal<Option<f64>>,
}

impl Guide {
    /// With the relays off.
    pub fn new() -> Self {
        Self { reached: RwSignal::new(0), playback: RwSignal::new(None) }
    }
}

/// Whether a step is closed. With all cards shown, none is.
pub fn is_closed(session: Session, step: u8) -> Signal<bool> {
    Signal::derive(move || session.lab.shown_depth() == Depth::Explore && session.own.guide.reached.get() < step)
}

/// Up to when the relay test is drawn: not at all while the relays are off.
pub fn drawn_until(session: Session) -> Signal<Option<f64>> {
    let off = is_closed(session, 1);
    Signal::derive(move || if off.get() { Some(-1.0) } else { session.own.guide.playback.get() })
}

/// Shows the relay test as time passes.
pub fn playback(session: Session) -> Playback {
    let position = session.own.guide.playback;
    let on_move = Callback::new(move |time| position.set(time));
    let span = session.part(|s| first_stretch(s.test.duration));
    Playback::new(position.into(), on_move, span)
}

/// What stands over the empty chart while the relays are off.
#[component]
pub fn SwitchOn(playback: Playback) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let switch_on = move |_| {
        session.own.guide.reached.set(1);
        if !prefers_less_motion() {
            playback.start();
        }
    };
    view! {
        <div class="switch-on" hidden=move || !is_closed(session, 1).get()>
            <button type="button" class="button strong" data-testid="switch-on" on:click=switch_on>
                {say!(lab, guide.switch_on)}
            </button>
        </div>
    }
}

/// The next step: the question that leads to it, and the button that opens it.
#[component]
pub fn NextStep() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let next = Memo::new(move |_| session.own.guide.reached.get() + 1);
    let is_idle = move || !(2..=LAST).contains(&next.get()) || lab.shown_depth() != Depth::Explore;
    let texts = move || match next.get() {
        2 => (tr!(lab, guide.to_curve), tr!(lab, guide.show_curve)),
        3 => (tr!(lab, guide.to_placement), tr!(lab, guide.show_placement)),
        _ => (tr!(lab, guide.to_response), tr!(lab, guide.show_response)),
    };
    view! {
        <section class="card next" aria-label=say!(lab, guide.next) hidden=is_idle>
            <p>{move || marked(&texts().0)}</p>
            <button
                type="button"
                class="button strong"
                data-testid="next-step"
                on:click=move |_| session.own.guide.reached.update(|reached| *reached = (*reached + 1).min(LAST))
            >
                {move || texts().1}
            </button>
        </section>
    }
}
