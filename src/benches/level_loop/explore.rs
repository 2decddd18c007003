//! The first visit: one loop, two jobs that exclude each other, and three things to try. All else is folded.

use leptos::prelude::*;
use quadtank::sim::level::LevelController;
use quadtank::study::level_loop::{LevelLoopSetup, Objective};

use super::assess::AssessCard;
use super::course::CourseCard;
use super::experiment::ExperimentCard;
use super::flags::locks;
use super::forms::FormsCard;
use super::heated::HeatedCard;
use super::map::MapCard;
use super::process::ProcessCard;
use super::published::PublishedCard;
use super::session::use_session;
use super::test::TestCard;
use super::trade_off::TradeOffCard;
use super::tuning::TuningCard;
use crate::texts::{say, tr};
use crate::widgets::{Drawer, marked};

/// Everything that a first visit sees.
#[component]
pub fn Explore() -> impl IntoView {
    let lab = use_session().lab;
    view! {
        <div class="explore of-run">
            <p class="lead">{move || marked(&tr!(lab, level.lead))}</p>
            <ProcessCard with_start=false />
            <CourseCard />
            <Tries />
            <div class="drawers">
                <Drawer
                    id="drawer-tuning"
                    title=say!(lab, level.drawer_tuning)
                    content=|| view! { <TuningCard /> <AssessCard /> }
                />
                <Drawer id="drawer-trade" title=say!(lab, level.trade_off) content=|| view! { <TradeOffCard /> } />
                <Drawer
                    id="drawer-experiment"
                    title=say!(lab, level.experiment)
                    content=|| view! { <ExperimentCard /> }
                />
                <Drawer id="drawer-test" title=say!(lab, level.test_title) content=|| view! { <TestCard /> } />
                <Drawer id="drawer-map" title=say!(lab, level.map_title) content=|| view! { <MapCard /> } />
                <Drawer id="drawer-published" title=say!(lab, level.published) content=|| view! { <PublishedCard /> } />
                <Drawer id="drawer-forms" title=say!(lab, level.forms) content=|| view! { <FormsCard /> } />
                <Drawer id="drawer-heated" title=say!(lab, level.heated) content=|| view! { <HeatedCard /> } />
            </div>
        </div>
    }
}

/// Something to try: its name for tests, and what it makes of the setup.
type Try = (&'static str, fn(&LevelLoopSetup) -> LevelLoopSetup);

/// Tight and averaging control as Andreis (2017, Tables 5.1 and 5.2) found them best, and no control.
const TRIES: [Try; 3] = [
    ("try-tight", |setup| tuned(setup, false)),
    ("try-averaging", |setup| tuned(setup, true)),
    ("try-off", |setup| LevelLoopSetup { controller: LevelController::off(), ..tuned(setup, true) }),
];

fn tuned(setup: &LevelLoopSetup, averaging: bool) -> LevelLoopSetup {
    let mut setup = setup.clone();
    let objective = if averaging { Objective::Averaging { band: setup.usual_band() } } else { Objective::Tight };
    setup.set_objective(objective);
    let best = setup.best_known_tuning();
    setup.set_pi_tuning(best);
    setup
}

/// The three things to try, in the order in which they surprise most.
#[component]
fn Tries() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let item = move |(k, (id, make)): (usize, Try)| {
        let text = move || match k {
            0 => tr!(lab, level.try_tight),
            1 => tr!(lab, level.try_averaging),
            _ => tr!(lab, level.try_off),
        };
        let is_shown = session.part(move |s| *s == make(s));
        view! {
            <li>
                <button
                    type="button"
                    class="button"
                    data-testid=id
                    aria-pressed=move || is_shown.get().to_string()
                    disabled=lab.locks(locks::GAINS) || lab.locks(locks::OBJECTIVE)
                    on:click=move |_| session.edit(|s| *s = make(s))
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
            <p>{say!(lab, level.tries)}</p>
        </section>
    }
}
