//! Three things to try, which tick themselves off, each with one sentence of what was just discovered.

use leptos::prelude::*;

use super::super::sentences::situation;
use super::super::session::{Session, use_session};
use crate::texts::{say, tr};
use crate::widgets::marked;
use quadtank::control::Pairing;
use quadtank::linear::Stability;
use quadtank::study::quadruple_tank::{Setup, ZeroSituation};

/// What can be tried, in the order in which it is best tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Prompt {
    /// Ask a level for more or less water.
    Water,
    /// Turn the valves across the line.
    Valves,
    /// Swap who controls whom.
    Swap,
}

const PROMPTS: [(Prompt, &str); 3] =
    [(Prompt::Water, "prompt-water"), (Prompt::Valves, "prompt-valves"), (Prompt::Swap, "prompt-swap")];

/// What a visit began with, and what tells that something was tried.
#[derive(Clone, Debug, PartialEq)]
struct Start {
    references: [f64; 2],
    is_limited: bool,
    pairing: Pairing,
}

impl Start {
    fn of(session: Session) -> Self {
        let is_limited = situation(session).is_some_and(ZeroSituation::limits_control);
        session.throttled.setup.with(|s| Self { references: references(s), is_limited, pairing: s.controller.pairing })
    }

    fn is_done(&self, prompt: Prompt, now: &Self) -> bool {
        match prompt {
            Prompt::Water => self.references != now.references,
            Prompt::Valves => self.is_limited != now.is_limited,
            Prompt::Swap => self.pairing != now.pairing,
        }
    }
}

/// What both levels are asked to change by in all (m).
fn references(setup: &Setup) -> [f64; 2] {
    let sum = |level| setup.experiment.set_point_steps.iter().filter(|s| s.level == level).map(|s| s.size).sum();
    [sum(0), sum(1)]
}

/// The strip with the three prompts.
#[component]
pub fn Prompts() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let start = untrack(|| Start::of(session));
    // What was done stays done.
    let done = RwSignal::new([false; 3]);
    let last = RwSignal::new(None::<Prompt>);
    Effect::new(move || {
        let now = Start::of(session);
        for (k, (prompt, _)) in PROMPTS.into_iter().enumerate() {
            if start.is_done(prompt, &now) && !done.with_untracked(|done| done[k]) {
                done.update(|done| done[k] = true);
                last.set(Some(prompt));
            }
        }
    });
    let next = move || done.with(|done| done.iter().position(|done| !done));
    let item = move |k: usize, (prompt, id): (Prompt, &'static str)| {
        let is_done = move || done.with(|done| done[k]);
        let class = move || match (is_done(), next() == Some(k)) {
            (true, _) => "done",
            (false, true) => "next",
            (false, false) => "",
        };
        let sign = move || if is_done() { "✓".to_owned() } else { format!("{}", k + 1) };
        view! {
            <li class=class data-testid=id>
                <span class="sign" aria-hidden="true">{sign}</span>
                {move || task(session, prompt)}
                <span class="visually-hidden">{move || is_done().then(|| tr!(lab, explore.done))}</span>
            </li>
        }
    };
    view! {
        <section class="card prompts" aria-label=say!(lab, explore.try_this)>
            <b class="heading">{say!(lab, explore.try_this)}</b>
            <ol>{PROMPTS.into_iter().enumerate().map(|(k, prompt)| item(k, prompt)).collect_view()}</ol>
            <p role="status" data-testid="discovery">
                {move || marked(&last.get().map_or_else(|| tr!(lab, explore.safe), |prompt| discovery(session, prompt)))}
            </p>
        </section>
    }
}

fn task(session: Session, prompt: Prompt) -> String {
    let lab = session.lab;
    match prompt {
        Prompt::Water => tr!(lab, explore.task_water),
        Prompt::Valves => tr!(lab, explore.task_valves),
        Prompt::Swap => tr!(lab, explore.task_swap),
    }
}

/// What was just discovered. It follows what happens now, so that it stays true when more is changed.
fn discovery(session: Session, prompt: Prompt) -> String {
    let lab = session.lab;
    let is_limited = situation(session).is_some_and(ZeroSituation::limits_control);
    let is_stable = session.throttled.with_analysis(|a| a.closed_loop.stability == Stability::Stable) == Some(true);
    match (prompt, is_limited, is_stable) {
        (Prompt::Water, _, true) => tr!(lab, explore.found_water),
        (Prompt::Water, _, false) => tr!(lab, explore.found_water_not),
        (Prompt::Valves, true, true) => tr!(lab, explore.found_hard),
        (Prompt::Valves, true, false) => tr!(lab, explore.found_fight),
        (Prompt::Valves, false, _) => tr!(lab, explore.found_easy),
        (Prompt::Swap, true, true) => tr!(lab, explore.found_swap),
        (Prompt::Swap, _, false) => tr!(lab, explore.found_swap_not),
        (Prompt::Swap, false, true) => tr!(lab, explore.found_swap_easy),
    }
}
