//! Work that cannot be lost: once a change has settled it becomes a step that can be undone, stands in the address, and is
//! remembered by the browser.

use gloo_timers::callback::Timeout;
use leptos::ev;
use leptos::prelude::*;
use quadtank_scenario::document_from_link;

use super::events::is_at;
use super::lab::{Lab, Notice};
use super::share::{self, show_address};
use super::storage::{self, LAST};

/// How long a document has to stay as it is until it is kept (ms): many changes in a row are one step, and browsers allow an address
/// to be replaced only so often (Safari: 100 times in 30 s).
const SETTLED_MS: u32 = 400;

/// From now on everything that is done in the laboratory is kept.
pub fn keep(lab: Lab) {
    offer_last(lab);
    let timer = StoredValue::new_local(None::<Timeout>);
    // A drag is one step however long the hand rests on its way: what has settled by then waits until it lets go.
    let is_due = StoredValue::new(false);
    let settled = move || if lab.is_dragging.get_untracked() { is_due.set_value(true) } else { settle(lab) };
    let start_timer = move || timer.set_value(Some(Timeout::new(SETTLED_MS, settled)));
    Effect::new(move |is_known: Option<()>| {
        (lab.bench.get().track)(lab);
        lab.depth.track();
        // What the page begins with stands in its address.
        if is_known.is_some() {
            start_timer();
        }
    });
    let drag = move |is_dragging| {
        if lab.is_dragging.get_untracked() != is_dragging {
            lab.is_dragging.set(is_dragging);
        }
    };
    let let_go = move || {
        drag(false);
        if is_due.get_value() {
            is_due.set_value(false);
            start_timer();
        }
    };
    let listeners = [
        window_event_listener(ev::keydown, move |event| undo_by_key(lab, &event)),
        // A handle keeps the press to itself, and a release may be lost outside of the window: every move says how it is.
        window_event_listener(ev::pointermove, move |event| if event.buttons() == 0 { let_go() } else { drag(true) }),
        window_event_listener(ev::pointerup, move |_| let_go()),
        window_event_listener(ev::pointercancel, move |_| let_go()),
        window_event_listener(ev::blur, move |_| let_go()),
    ];
    on_cleanup(move || {
        for listener in listeners {
            listener.remove();
        }
        timer.dispose();
    });
}

/// Keeps what is shown: as a step, in the address, in the browser.
fn settle(lab: Lab) {
    // What is done in a lesson belongs to the lesson: its address and its progress.
    if lab.stage.with_untracked(Option::is_some) {
        return;
    }
    let bench = lab.bench.get_untracked();
    (bench.record)(lab);
    let link = share::link_to_keep(lab, bench);
    let is_in_address = show_address(&share::reference_with(lab, bench, link.as_deref()));
    // The pages of a course show many embedded benches; the last one of them is not what its reader looks for next time.
    let is_embedded = lab.flags.with_value(|flags| flags.embed);
    if let Some(link) = link.filter(|_| !is_embedded) {
        LAST.write(&link);
    }
    let is_kept = is_in_address || (!is_embedded && storage::is_allowed());
    if !is_kept && !lab.told_not_kept.get_value() {
        lab.told_not_kept.set_value(true);
        lab.notice.set(Some(Notice::NotKept { is_embedded }));
    }
}

/// Offers to go on with the last experiment, where the address asks for nothing else.
fn offer_last(lab: Lab) {
    let asks_for_something = lab.flags.with_value(|f| f.embed || f.preset.is_some() || !f.panels.is_empty());
    // What was said about the address matters more.
    let is_told = lab.notice.with_untracked(Option::is_some);
    if asks_for_something || is_told || share::from_address().is_some() {
        return;
    }
    if let Some(link) = LAST.read().filter(|link| document_from_link(link).is_ok()) {
        lab.notice.set(Some(Notice::Continue(link)));
    }
}

/// Undoes the last step of the bench that is shown, also one that has not settled yet. What is done in a lesson is no step.
pub fn undo(lab: Lab) {
    if lab.stage.with_untracked(Option::is_some) {
        return;
    }
    let bench = lab.bench.get_untracked();
    (bench.record)(lab);
    (bench.undo)(lab);
}

/// Does again what was undone last.
pub fn redo(lab: Lab) {
    if lab.stage.with_untracked(Option::is_some) {
        return;
    }
    let bench = lab.bench.get_untracked();
    (bench.record)(lab);
    (bench.redo)(lab);
}

/// Ctrl+Z, Ctrl+Shift+Z and Ctrl+Y. In a text they are those of the browser.
fn undo_by_key(lab: Lab, event: &ev::KeyboardEvent) {
    if !(event.ctrl_key() || event.meta_key()) || event.alt_key() || is_text(event) {
        return;
    }
    match (event.key().to_ascii_lowercase().as_str(), event.shift_key()) {
        ("z", false) => undo(lab),
        ("z", true) | ("y", false) => redo(lab),
        _ => return,
    }
    event.prevent_default();
}

fn is_text(event: &ev::KeyboardEvent) -> bool {
    is_at(event, "textarea, input:not([type=range], [type=checkbox])")
}
