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

use super::lab::use_lab;
use super::start::{Bench, Panel};

/// The bench, or those of its cards that the start flags ask for.
#[component]
pub fn ModelFreeBench() -> impl IntoView {
    let lab = use_lab();
    let shows = move |panel| lab.flags.with_value(|f| f.shows(panel));
    let chosen = lab.flags.with_value(|f| !f.panels.is_empty());
    view! {
        <main class=if chosen { "bench free chosen" } else { "bench free" } id=move || lab.id_of(Bench::ModelFree)>
            <div class="side left">
                {shows(Panel::Process).then(|| view! { <process::ProcessCard /> })}
                {shows(Panel::Valves).then(|| view! { <plane::ValvePlaneCard /> })}
                {shows(Panel::Zeros).then(|| view! { <plane::ZerosCard /> })}
            </div>
            {shows(Panel::Responses).then(|| view! { <course::CourseCard /> })}
            <div class="side right">
                {shows(Panel::Experiment).then(|| view! { <experiment::CaseCard /> })}
                {shows(Panel::Controller).then(|| view! { <law::LawCard /> })}
            </div>
            {shows(Panel::Claims).then(|| view! { <claims::ClaimsCard /> })}
        </main>
    }
}
