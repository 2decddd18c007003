//! What mends a warning: a button at the end of its sentence.

use leptos::prelude::*;

use super::flags::locks;
use super::pictures::short_name;
use super::session::{Session, use_session};
use crate::session::Lock;
use crate::texts::tr;
use quadtank::study::relay_tuning::{Mend, Tested, mend_pairing};

/// A change that is offered.
#[derive(Clone, Debug, PartialEq)]
pub struct Offer {
    /// Name for tests.
    id: &'static str,
    /// What it does.
    text: String,
    /// What keeps it from being taken.
    lock: Lock,
    change: Change,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Change {
    Known(Mend),
    /// The hysteresis is sought when it is asked for: that takes several tests.
    EndChattering,
}

impl Offer {
    fn take(&self, session: Session) {
        let mend = match self.change {
            Change::Known(mend) => Some(mend),
            Change::EndChattering => session.charts.study.with_untracked(|study| {
                session.document.with_untracked(|s| study.as_ref().as_ref().ok()?.mend_chattering(&s.tuning))
            }),
        };
        if let Some(mend) = mend {
            session.edit(|s| mend.apply(s));
        }
    }
}

/// What ends the chattering of a relay test.
pub fn of_test(session: Session) -> Vec<Offer> {
    let chatters = session.throttled.test.with(|test| test.as_ref().as_ref().is_ok_and(Tested::chatters));
    if !chatters {
        return Vec::new();
    }
    let is_linear = session.throttled.setup.with(|s| s.plant.tank().is_none_or(|tank| !tank.nonlinear));
    let hysteresis = Offer {
        id: "mend-hysteresis",
        text: tr!(session.lab, mend.hysteresis),
        lock: locks::TEST,
        change: Change::EndChattering,
    };
    is_linear.then_some(hysteresis).into_iter().chain(dead_time(session, "mend-test")).collect()
}

/// What gives a rig its ultimate points back.
pub fn of_curve(session: Session) -> Vec<Offer> {
    let has_point = session.throttled.with_design(|design| design.critical.is_some());
    let lacks_point = has_point != Some(true);
    let pairing = session.throttled.study.with(|study| study.as_ref().as_ref().err().and_then(mend_pairing));
    if let Some(mend) = pairing {
        let text = tr!(session.lab, mend.pairing);
        return vec![Offer { id: "mend-pairing", text, lock: locks::PLANT, change: Change::Known(mend) }];
    }
    lacks_point.then(|| dead_time(session, "mend-curve")).flatten().into_iter().collect()
}

/// What makes the chosen controllers stable, or gives the point back that they are found from.
pub fn of_design(session: Session, id: &'static str) -> Vec<Offer> {
    let mend = session.throttled.study.with(|study| {
        let study = study.as_ref().as_ref().ok()?;
        session
            .throttled
            .setup
            .with(|setup| session.throttled.with_design(|design| study.mend_placement(setup, design)).flatten())
    });
    match mend {
        Some(mend @ Mend::TargetOfRule(rule)) => {
            vec![Offer {
                id,
                text: tr!(session.lab, mend.target, rule = short_name(rule)),
                lock: locks::TARGET,
                change: Change::Known(mend),
            }]
        }
        _ => session
            .throttled
            .design
            .with(|design| matches!(design.as_ref(), Ok(None)))
            .then(|| dead_time(session, id))
            .flatten()
            .into_iter()
            .collect(),
    }
}

fn dead_time(session: Session, id: &'static str) -> Option<Offer> {
    let mend = session.throttled.setup.with(|s| s.missing_dead_time())?;
    let Mend::DeadTime(time_s) = mend else { return None };
    let time = session.lab.number_style().significant(time_s, 2);
    Some(Offer {
        id,
        text: tr!(session.lab, mend.dead_time, time = time),
        lock: locks::PLANT,
        change: Change::Known(mend),
    })
}

/// The offers as buttons.
#[component]
pub fn Offers(
    /// What is offered.
    offers: Signal<Vec<Offer>>,
) -> impl IntoView {
    let session = use_session();
    let offers = Memo::new(move |_| offers.get());
    let button = move |offer: Offer| {
        let (id, text) = (offer.id, offer.text.clone());
        view! {
            <button type="button" class="button small" data-testid=id disabled=session.lab.locks(offer.lock) on:click=move |_| offer.take(session)>
                {text}
            </button>
        }
    };
    view! {
        <div class="toolbar mends" hidden=move || offers.with(Vec::is_empty)>
            {move || offers.get().into_iter().map(button).collect_view()}
        </div>
    }
}
