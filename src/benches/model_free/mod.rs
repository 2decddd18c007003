//! The model-free bench: cases with still and moving valves, and what perfect outputs hide (Junqueira, Neves and Angelico).

mod claims;
mod course;
mod experiment;
mod explore;
mod flags;
mod law;
mod mends;
mod moment;
mod pictures;
mod plane;
mod process;
mod sentences;
mod session;

use leptos::prelude::*;

use crate::depth::Depth;
use flags::panels;
pub use session::ModelFree;
use session::Session;

/// What is shown at the chosen depth.
fn cards(session: Session) -> impl IntoView {
    let is_first = Memo::new(move |_| session.lab.shown_depth() == Depth::Explore);
    move || if is_first.get() { view! { <explore::Explore /> }.into_any() } else { all_cards(session).into_any() }
}

/// The cards that the start flags ask for.
fn all_cards(session: Session) -> impl IntoView {
    let lab = session.lab;
    view! {
        <div class="side left">
            {lab.shows(panels::PROCESS).then(|| view! { <process::ProcessCard /> })}
            {lab.shows(panels::VALVES).then(|| view! { <plane::ValvePlaneCard /> })}
            {lab.shows(panels::ZEROS).then(|| view! { <plane::ZerosCard /> })}
        </div>
        {lab.shows(panels::RESPONSES).then(|| view! { <course::CourseCard folded=false /> })}
        <div class="side right">
            {lab.shows(panels::EXPERIMENT).then(|| view! { <experiment::CaseCard /> })}
            {lab.shows(panels::CONTROLLER).then(|| view! { <law::LawCard /> })}
        </div>
        {lab.shows(panels::CLAIMS).then(|| view! { <claims::ClaimsCard /> })}
    }
}
