//! Three things to try, which tick themselves off, each with one sentence of what was just discovered.

use leptos::prelude::*;

use super::super::sentences::situation;
use super::super::session::{Session, use_session};
use crate::texts::{say, tr};
use crate::widgets::marked;
use quadtank::control::Pairing;
use quadtank::linear::Stability;
use quadtank::sim::{EventKind, Settling};
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

/// A side of the line γ1 + γ2 = 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Easy,
    Hard,
}

impl Side {
    /// Where the valves stand; on the line it is neither.
    fn of(session: Session) -> Option<Self> {
        match situation(session)? {
            ZeroSituation::Origin | ZeroSituation::Degenerate => None,
            situation if situation.limits_control() => Some(Self::Hard),
            _ => Some(Self::Easy),
        }
    }
}

/// State at the start of a visit, with which the present one is compared to detect what was tried.
#[derive(Clone, Debug, PartialEq)]
struct Start {
    references: [f64; 2],
    side: Option<Side>,
    pairing: Pairing,
}

impl Start {
    fn of(session: Session) -> Self {
        let side = Side::of(session);
        session.throttled.setup.with(|s| Self { references: references(s), side, pairing: s.controller.pairing })
    }

    fn is_done(&self, prompt: Prompt, now: &Self) -> bool {
        match prompt {
            Prompt::Water => self.references != now.references,
            Prompt::Valves => now.side.is_some() && self.side != now.side,
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
    // What a lesson sets on the bench was not tried by the student: a visit starts anew after it.
    let start = StoredValue::new(None::<Start>);
    // What was done stays done.
    let done = RwSignal::new([false; 3]);
    let last = RwSignal::new(None::<Prompt>);
    Effect::new(move || {
        let now = Start::of(session);
        if lab.stage.with(Option::is_some) {
            return start.set_value(None);
        }
        let Some(start) = start.get_value() else {
            // After a lesson the bench has its own document back before the results are those of it.
            let is_own = |setup: &Setup| session.document.with_untracked(|document| document.setup == *setup);
            if session.throttled.setup.with(|setup| is_own(setup)) {
                start.set_value(Some(now));
            }
            return;
        };
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
    let is_stable = session.throttled.with_analysis(|a| a.closed_loop.stability == Stability::Stable) == Some(true);
    match (Side::of(session), prompt, is_stable) {
        (None, ..) => tr!(lab, explore.found_line),
        (_, Prompt::Water, true) if reaches_references(session) => tr!(lab, explore.found_water),
        (_, Prompt::Water, true) => tr!(lab, explore.found_water_slow),
        (_, Prompt::Water, false) => tr!(lab, explore.found_water_not),
        (Some(Side::Hard), Prompt::Valves, false) => tr!(lab, explore.found_fight),
        (Some(Side::Easy), Prompt::Valves, _) => tr!(lab, explore.found_easy),
        (_, Prompt::Swap, false) => tr!(lab, explore.found_swap_not),
        (Some(Side::Hard), Prompt::Swap, true) if reaches_references(session) => tr!(lab, explore.found_swap),
        (Some(Side::Hard), _, true) => tr!(lab, explore.found_hard),
        (Some(Side::Easy), Prompt::Swap, true) => tr!(lab, explore.found_swap_easy),
    }
}

/// Whether each level whose reference steps settles at it in a run in which no tank overflows or runs dry. A pump may
/// be at a limit for a time.
fn reaches_references(session: Session) -> bool {
    session.throttled.run.with(|outcome| {
        outcome.as_ref().as_ref().is_ok_and(|run| {
            let stepped = run.metrics.iter().filter(|m| m.step_time_s.is_some());
            let has_settled = |settling| matches!(settling, Some(Settling::After { .. }));
            let overflows_or_dry = |kind| matches!(kind, EventKind::Overflow { .. } | EventKind::Empty { .. });
            stepped.clone().all(|m| m.no_response.is_none() && has_settled(m.settling_2_percent))
                && !run.nonlinear.events.iter().any(|event| overflows_or_dry(event.kind))
        })
    })
}
