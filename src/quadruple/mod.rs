//! The home bench: from two valves to the step response.

mod controller;
mod cursor;
mod experiment;
mod metrics;
mod moment;
mod pictures;
mod poles;
mod process;
mod published;
mod responses;
mod rga;
mod rig;
mod sentences;
mod set_points;
mod valves;
mod why;

use leptos::prelude::*;

use super::lab::use_lab;
use super::start::{Bench, Panel};
pub use moment::Moment;
use moment::provide_moment;
pub use rig::{drawing, summary};

/// The home bench, or those of its cards that the start flags ask for.
#[component]
pub fn QuadrupleTankBench() -> impl IntoView {
    let lab = use_lab();
    provide_moment(lab);
    let shows = move |panel| lab.flags.with_value(|f| f.shows(panel));
    let chosen = lab.flags.with_value(|f| !f.panels.is_empty());
    view! {
        <main class=if chosen { "bench chosen" } else { "bench" } id=move || lab.id_of(Bench::QuadrupleTank)>
            <div class="side left">
                {shows(Panel::Process).then(|| view! { <process::ProcessCard /> })}
                {shows(Panel::Why).then(|| view! { <why::WhyCard /> })}
            </div>
            {shows(Panel::Valves).then(|| view! { <valves::ValvePlaneCard /> })}
            {shows(Panel::Zeros).then(|| view! { <poles::PolesAndZerosCard /> })}
            {shows(Panel::Rga).then(|| view! { <rga::RelativeGainCard /> })}
            <div class="side right">
                {shows(Panel::Controller).then(|| view! { <controller::ControllerCard /> })}
                {shows(Panel::Experiment).then(|| view! { <experiment::ExperimentCard /> })}
            </div>
            {shows(Panel::Responses).then(|| view! { <responses::ResponsesCard /> })}
        </main>
    }
}
