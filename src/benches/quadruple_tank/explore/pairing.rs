//! Who controls whom: which pump each level is given, whether that is the right one, and what to do if it does not work.

use leptos::prelude::*;

use super::super::flags::locks;
use super::super::session::{Session, use_session};
use crate::texts::{say, terms, tr};
use crate::widgets::{Card, Text, marked};
use quadtank::control::Pairing;
use quadtank::linear::Stability;
use quadtank::study::quadruple_tank::detuned;

/// Height of the rows of levels and pumps.
const ROWS: [f64; 2] = [22.0, 66.0];

/// What the pairing does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Finding {
    /// The advised pairing, and it works.
    Right,
    /// The advised pairing with gains that are too high for it.
    TooEager,
    /// The other pairing.
    Wrong,
    /// Neither is better.
    Neither,
}

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[terms::pairing, terms::relative_gain];

/// The card with the two lines that swap.
#[component]
pub fn PairingCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let pairing = session.part(|s| s.controller.pairing);
    let swap = move |_| session.edit(|s| s.controller.pairing = s.controller.pairing.other());
    let finding = Memo::new(move |_| finding(session));
    let beside = move || {
        view! {
            <button type="button" class="button small" data-testid="swap" disabled=lab.locks(locks::PAIRING) on:click=swap>
                "⇅ " {say!(lab, explore.swap)}
            </button>
        }
    };
    let is_bad = move || finding.get() != Some(Finding::Right);
    view! {
        <Card name="whom" title=say!(lab, explore.whom) terms=TERMS beside>
            <div class="pairing">
                <svg viewBox="0 0 200 88" role="img" aria-label=move || in_words(session, pairing.get())>
                    {move || lines(session, pairing.get())}
                </svg>
                <p class=move || if is_bad() { "warm" } else { "good" } data-testid="whom">
                    {move || marked(&sentence(session, finding.get()))}
                </p>
            </div>
            <p class="remark">{move || marked(&relative_gain(session))}</p>
            <button
                type="button"
                class="button"
                data-testid="calm"
                hidden=move || finding.get() != Some(Finding::TooEager)
                disabled=lab.locks(locks::GAINS)
                on:click=move |_| detune(session)
            >
                {say!(lab, explore.calm)}
            </button>
        </Card>
    }
}

fn finding(session: Session) -> Option<Finding> {
    let pairing = session.throttled.setup.with(|s| s.controller.pairing);
    session.throttled.with_analysis(|a| {
        let Some(advised) = a.linear.advised_pairing() else { return Finding::Neither };
        match (advised == pairing, a.closed_loop.stability) {
            (false, _) => Finding::Wrong,
            (true, Stability::Stable) => Finding::Right,
            (true, _) => Finding::TooEager,
        }
    })
}

/// Lower gains where there are some that work.
fn detune(session: Session) {
    if let Some(setup) = session.document.with_untracked(|document| detuned(&document.setup)) {
        session.edit(|s| s.controller = setup.controller);
    }
}

fn sentence(session: Session, finding: Option<Finding>) -> String {
    let lab = session.lab;
    let pump = session.throttled.setup.with(|s| s.controller.pairing.pump_of(0)) + 1;
    match finding {
        Some(Finding::Right) => tr!(lab, explore.right, pump = pump),
        Some(Finding::TooEager) => tr!(lab, explore.too_eager),
        Some(Finding::Wrong) => tr!(lab, explore.wrong, pump = pump),
        Some(Finding::Neither) => tr!(lab, explore.neither),
        None => tr!(lab, process.no_equilibrium),
    }
}

/// The relative gain λ11 and how to read it, or that there is none where G(0) is singular.
fn relative_gain(session: Session) -> String {
    let lab = session.lab;
    match session.throttled.with_analysis(|a| a.linear.rga_11.ok()).flatten() {
        Some(gain) => tr!(lab, explore.relative_gain, gain = lab.number_style().at_least(gain, 2)),
        None => tr!(lab, explore.no_relative_gain),
    }
}

fn in_words(session: Session, pairing: Pairing) -> String {
    let [one, two] = [0, 1].map(|level| pairing.pump_of(level) + 1);
    tr!(session.lab, explore.pairs, one = one, two = two)
}

/// Two levels, two pumps, and which pump each level commands.
fn lines(session: Session, pairing: Pairing) -> impl IntoView {
    let lab = session.lab;
    let ends = [0, 1].map(|level| (level, ROWS[level], ROWS[pairing.pump_of(level)]));
    let name = |x: f64, y: f64, text: String, class: &'static str| {
        view! {
            <rect class=class x=x y=y - 14.0 width="68" height="28" rx="6" />
            <text x=x + 34.0 y=y + 4.0 text-anchor="middle">{text}</text>
        }
    };
    view! {
        {ends.map(|(level, from, to)| view! {
            <path class=["one", "two"][level] d=format!("M70 {from} C100 {from} 100 {to} 130 {to}") />
        })}
        {[0, 1].map(|k| name(2.0, ROWS[k], tr!(lab, explore.level, number = k + 1), ["one", "two"][k]))}
        {[0, 1].map(|k| name(130.0, ROWS[k], tr!(lab, explore.pump, number = k + 1), "pump"))}
    }
}
