//! Runs that are pinned to compare with.

use leptos::prelude::*;

use super::session::{Session, use_session};
use crate::texts::{say, tr};
use crate::widgets::Pins;
use quadtank::control::Pairing;
use quadtank::study::quadruple_tank::Setup;
use quadtank_scenario::Scenario;

/// The pinned runs as chips.
#[component]
pub fn PinnedRuns() -> impl IntoView {
    let session = use_session();
    let pinned = move |place: usize| session.document.with(|s| s.pinned.get(place).cloned());
    let text = move |place| pinned(place).map(|setup| text(session, &setup)).unwrap_or_default();
    let restore = move |place| {
        if let Some(setup) = untrack(|| pinned(place)) {
            // The experiment is what all of them are compared in.
            session.edit(|s| *s = Setup { experiment: s.experiment.clone(), ..setup });
        }
    };
    let remove = move |place| {
        session.document.update(|s| {
            if place < s.pinned.len() {
                s.pinned.remove(place);
            }
        });
    };
    view! {
        <Pins
            lab=session.lab
            id="pinned"
            count=Memo::new(move |_| session.document.with(|s| s.pinned.len()))
            text=Callback::new(text)
            on_restore=Callback::new(restore)
            on_remove=Callback::new(remove)
        />
    }
}

/// Pins the present run, as long as there is room.
#[component]
pub fn PinButtons() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let pin = move |_| {
        session.document.update(|s| {
            let setup = s.setup.clone();
            s.pinned.push(setup);
        });
    };
    let count = Memo::new(move |_| session.document.with(|s| s.pinned.len()));
    let is_full = move || count.get() >= Scenario::MAX_PINNED;
    let why = move || is_full().then(|| tr!(lab, pins.full, count = Scenario::MAX_PINNED));
    view! {
        <button type="button" class="button small" data-testid="pin" disabled=is_full title=why on:click=pin>
            {say!(lab, responses.pin)}
        </button>
        <button
            type="button"
            class="button small"
            data-testid="unpin"
            hidden=move || count.get() == 0
            on:click=move |_| session.document.update(|s| s.pinned.clear())
        >
            {say!(lab, responses.unpin)}
        </button>
    }
}

/// The gains of a pinned run, and valves and pairing where they are not the present ones.
fn text(session: Session, pinned: &Setup) -> String {
    let lab = session.lab;
    let style = lab.number_style();
    let gains = [0, 1].map(|k| {
        let settings = pinned.controller.loops[k];
        let (gain, time) = (style.significant(settings.gain, 3), style.significant(settings.integral_time_s, 3));
        format!("{} {gain} · {time} s", ["K₁", "K₂"][k])
    });
    let mut parts = gains.to_vec();
    let (valves, pairing) = session.document.with(|s| (s.setup.valves, s.setup.controller.pairing));
    if pinned.valves != valves {
        let [one, two] = pinned.valves.map(|gamma| style.fixed(gamma, 2));
        parts.push(format!("γ {one}; {two}"));
    }
    if pinned.controller.pairing != pairing {
        let name = if pinned.controller.pairing == Pairing::Diagonal { "1–1 / 2–2" } else { "1–2 / 2–1" };
        parts.push(name.to_owned());
    }
    parts.join(" · ")
}
