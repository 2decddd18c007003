//! Setups that are pinned to compare with, on any bench whose document keeps some.

use leptos::prelude::*;
use quadtank_scenario::BenchDocument;

use super::session::{Bench, Session, SetupOf};
use super::texts::{say, tr};
use super::widgets::Pins;

/// Pins the present setup, as long as there is room, and removes all of them.
#[component]
pub fn PinButtons<B: Bench>(
    /// The bench.
    session: Session<B>,
    /// Names for tests: to pin, to remove all.
    ids: (&'static str, &'static str),
    /// How many setups the document holds.
    max: usize,
) -> impl IntoView {
    let lab = session.lab;
    let count = count(session);
    let is_full = move || count.get() >= max;
    let why = move || is_full().then(|| tr!(lab, pins.full, count = max));
    let pin = move |_| {
        session.document.update(|document| {
            let setup = document.setup().clone();
            if let Some(pinned) = document.pinned_mut() {
                pinned.push(setup);
            }
        });
    };
    let clear = move |_| session.document.update(|document| document.pinned_mut().into_iter().for_each(Vec::clear));
    view! {
        <button type="button" class="button small" data-testid=ids.0 disabled=is_full title=why on:click=pin>
            {say!(lab, responses.pin)}
        </button>
        <button
            type="button"
            class="button small"
            data-testid=ids.1
            hidden=move || count.get() == 0
            on:click=clear
        >
            {say!(lab, responses.unpin)}
        </button>
    }
}

/// The pinned setups as chips.
#[component]
pub fn PinnedSetups<B: Bench>(
    /// The bench.
    session: Session<B>,
    /// Beginning of the names for tests.
    id: &'static str,
    /// What a pinned setup has of its own.
    text: fn(Session<B>, &SetupOf<B>) -> String,
    /// Takes a pinned setup up in the experiment of the present one.
    restore: fn(&mut SetupOf<B>, &SetupOf<B>),
) -> impl IntoView {
    let at = move |place: usize| session.document.with(|document| document.pinned().get(place).cloned());
    let on_restore = move |place| {
        if let Some(pinned) = untrack(|| at(place)) {
            session.edit(|setup| restore(setup, &pinned));
        }
    };
    let on_remove = move |place| {
        session.document.update(|document| {
            if let Some(pinned) = document.pinned_mut().filter(|pinned| place < pinned.len()) {
                pinned.remove(place);
            }
        });
    };
    view! {
        <Pins
            lab=session.lab
            id
            count=count(session)
            text=Callback::new(move |place| at(place).map(|pinned| text(session, &pinned)).unwrap_or_default())
            on_restore=Callback::new(on_restore)
            on_remove=Callback::new(on_remove)
        />
    }
}

/// How many setups are pinned.
fn count<B: Bench>(session: Session<B>) -> Memo<usize> {
    Memo::new(move |_| session.document.with(|document| document.pinned().len()))
}
