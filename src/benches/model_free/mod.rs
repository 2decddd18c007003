//! The model-free bench: cases with still and moving valves, and what perfect outputs hide (Junqueira, Neves and Angelico).

mod claims;
mod course;
mod experiment;
mod law;
mod moment;
mod pictures;
mod plane;
mod process;
mod sentences;
mod session;

use leptos::prelude::*;

use crate::start::Panel;
pub use session::ModelFree;
use session::Session;

/// The cards that the start flags ask for.
fn cards(session: Session) -> impl IntoView {
    let lab = session.lab;
    view! {
        <div class="side left">
            {lab.shows(Panel::Process).then(|| view! { <process::ProcessCard /> })}
            {lab.shows(Panel::Valves).then(|| view! { <plane::ValvePlaneCard /> })}
            {lab.shows(Panel::Zeros).then(|| view! { <plane::ZerosCard /> })}
        </div>
        {lab.shows(Panel::Responses).then(|| view! { <course::CourseCard /> })}
        <div class="side right">
            {lab.shows(Panel::Experiment).then(|| view! { <experiment::CaseCard /> })}
            {lab.shows(Panel::Controller).then(|| view! { <law::LawCard /> })}
        </div>
        {lab.shows(Panel::Claims).then(|| view! { <claims::ClaimsCard /> })}
    }
}
