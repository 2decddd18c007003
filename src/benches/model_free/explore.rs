//! The first visit: the rig, its run, and three things to try. All else is folded.

use leptos::prelude::*;

use super::claims::ClaimsCard;
use super::course::CourseCard;
use super::experiment::CaseCard;
use super::flags::locks;
use super::law::LawCard;
use super::plane::{ValvePlaneCard, ZerosCard};
use super::process::ProcessCard;
use super::session::{load, use_session};
use crate::texts::{say, tr};
use crate::widgets::{Drawer, marked};
use quadtank::literature::junqueira::{PublishedExperiment, PublishedValves};
use quadtank::study::model_free::{LONG_RUN_S, ModelFreeSetup};

/// Everything that a first visit sees.
#[component]
pub fn Explore() -> impl IntoView {
    let lab = use_session().lab;
    view! {
        <div class="explore of-run">
            <p class="lead">{move || marked(&tr!(lab, free.lead))}</p>
            <ProcessCard />
            <CourseCard folded=true />
            <Tries />
            <div class="drawers">
                <Drawer id="drawer-case" title=say!(lab, free.case) content=|| view! { <CaseCard /> } />
                <Drawer id="drawer-law" title=say!(lab, free.law) content=|| view! { <LawCard /> } />
                <Drawer
                    id="drawer-zeros"
                    title=say!(lab, free.drawer_zeros)
                    content=|| view! { <ValvePlaneCard /> <ZerosCard /> }
                />
                <Drawer id="drawer-claims" title=say!(lab, free.claims) content=|| view! { <ClaimsCard /> } />
            </div>
        </div>
    }
}

/// Something to try: its name for tests, and the run that it shows.
type Try = (&'static str, fn() -> ModelFreeSetup);

const TRIES: [Try; 3] = [
    ("try-easy", || ModelFreeSetup::published(PublishedValves::A, PublishedExperiment::S2)),
    ("try-hard", || ModelFreeSetup::published(PublishedValves::B, PublishedExperiment::S2)),
    ("try-wait", || {
        let mut setup = ModelFreeSetup::published(PublishedValves::B, PublishedExperiment::S2);
        setup.experiment.duration_s = LONG_RUN_S;
        setup
    }),
];

/// The three things to try, in the order in which they surprise most.
#[component]
fn Tries() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let item = move |(k, (id, setup)): (usize, Try)| {
        let text = move || match k {
            0 => tr!(lab, free.try_easy),
            1 => tr!(lab, free.try_hard),
            _ => tr!(lab, free.try_wait),
        };
        let is_shown = session.part(move |s| *s == setup());
        view! {
            <li>
                <button
                    type="button"
                    class="button"
                    data-testid=id
                    aria-pressed=move || is_shown.get().to_string()
                    disabled=lab.locks(locks::EXPERIMENT) || lab.locks(locks::VALVES)
                    on:click=move |_| load(session, setup())
                >
                    {format!("{} · ", k + 1)}{text}
                </button>
            </li>
        }
    };
    view! {
        <section class="card prompts" aria-label=say!(lab, explore.try_this)>
            <b class="heading">{say!(lab, explore.try_this)}</b>
            <ol>{TRIES.into_iter().enumerate().map(item).collect_view()}</ol>
            <p>{say!(lab, free.tries)}</p>
        </section>
    }
}
