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
use session::use_session;

/// The bench, or those of its cards that the start flags ask for.
#[component]
pub fn ModelFreeBench() -> impl IntoView {
    let lab = use_lab();
    let session = use_session();
    let shows = move |panel| lab.flags.with_value(|f| f.shows(panel));
    let chosen = lab.flags.with_value(|f| !f.panels.is_empty());
    view! {
        <main class=if chosen { "bench free chosen" } else { "bench free" } id=move || lab.id_of(Bench::ModelFree)>
            <div class="side left">
                {shows(Panel::Process).then(|| process::card(session))}
                {shows(Panel::Valves).then(|| plane::card(session))}
                {shows(Panel::Zeros).then(|| plane::zeros(session))}
            </div>
            {shows(Panel::Responses).then(|| course::card(session))}
            <div class="side right">
                {shows(Panel::Experiment).then(|| experiment::card(session))}
                {shows(Panel::Controller).then(|| law::card(session))}
            </div>
            {shows(Panel::Claims).then(|| claims::card(session))}
        </main>
    }
}
