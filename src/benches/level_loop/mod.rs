//! The level-loop bench: one tank with real instruments; test, model, objective, tuning, assessment (Andreis 2017; lecture slides).

mod assess;
mod course;
mod drawing;
mod element;
mod errors;
mod experiment;
mod exploration;
mod explore;
mod flags;
mod forms;
mod heated;
mod map;
mod mends;
mod pictures;
mod process;
mod published;
mod rules;
mod sentences;
mod session;
mod summary_table;
mod test;
mod trade_off;
mod tuning;

use leptos::prelude::*;

use crate::depth::Depth;
use flags::panels;
pub use session::LevelLoop;
use session::Session;

/// What is shown at the chosen depth.
fn cards(session: Session) -> impl IntoView {
    let is_first = Memo::new(move |_| session.lab.shown_depth() == Depth::Explore);
    move || if is_first.get() { view! { <explore::Explore /> }.into_any() } else { all_cards(session).into_any() }
}

/// The cards that the start flags ask for: the five steps around the run, and what is looked up below them.
fn all_cards(session: Session) -> impl IntoView {
    let lab = session.lab;
    view! {
        <div class="side left">
            {lab.shows(panels::PROCESS).then(|| view! { <process::ProcessCard with_start=true /> })}
            {lab.shows(panels::EXPERIMENT).then(|| view! { <experiment::ExperimentCard /> })}
        </div>
        <div class="side middle">
            {lab.shows(panels::RESPONSES).then(|| view! { <course::CourseCard /> })}
            {lab.shows(panels::TEST).then(|| view! { <test::TestCard /> })}
            {lab.shows(panels::TRADE_OFF).then(|| view! { <trade_off::TradeOffCard /> })}
        </div>
        <div class="side right">
            {lab.shows(panels::CONTROLLER).then(|| view! { <tuning::TuningCard /> })}
            {lab.shows(panels::ASSESSMENT).then(|| view! { <assess::AssessCard /> })}
        </div>
        <div class="side below">
            <div class="side">
                {lab.shows(panels::MAP).then(|| view! { <map::MapCard /> })}
                {lab.shows(panels::FORMS).then(|| view! { <forms::FormsCard /> })}
            </div>
            <div class="side">
                {lab.shows(panels::PUBLISHED).then(|| view! { <published::PublishedCard /> })}
                {lab.shows(panels::HEATED).then(|| view! { <heated::HeatedCard /> })}
            </div>
        </div>
    }
}
