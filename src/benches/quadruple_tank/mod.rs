//! The home bench: from two valves to the step response.

mod controller;
mod cursor;
mod experiment;
mod explore;
mod marks;
mod metrics;
mod moment;
mod pictures;
mod poles;
mod preset;
mod process;
mod published;
mod replay;
mod responses;
mod rga;
mod rig;
mod sentences;
mod session;
mod set_points;
mod valves;
mod why;

use leptos::prelude::*;

use crate::depth::Depth;
use crate::start::Panel;
pub use moment::RigState;
use moment::provide_moment;
pub use preset::{load, name_of};
pub use rig::{drawing, summary};
pub use session::QuadrupleTank;
use session::Session;

/// What is shown at the chosen depth.
fn cards(session: Session) -> impl IntoView {
    provide_moment(session);
    let is_first = Memo::new(move |_| session.lab.depth.get() == Depth::Explore);
    move || if is_first.get() { view! { <explore::Explore /> }.into_any() } else { all_cards(session).into_any() }
}

/// The cards that the start flags ask for.
fn all_cards(session: Session) -> impl IntoView {
    let lab = session.lab;
    view! {
        <div class="side left">
            {lab.shows(Panel::Process).then(|| view! { <process::ProcessCard /> })}
            {lab.shows(Panel::Why).then(|| view! { <why::WhyCard /> })}
        </div>
        {lab.shows(Panel::Valves).then(|| view! { <valves::ValvePlaneCard /> })}
        {lab.shows(Panel::Zeros).then(|| view! { <poles::PolesAndZerosCard /> })}
        {lab.shows(Panel::Rga).then(|| view! { <rga::RelativeGainCard /> })}
        <div class="side right">
            {lab.shows(Panel::Controller).then(|| view! { <controller::ControllerCard /> })}
            {lab.shows(Panel::Experiment).then(|| view! { <experiment::ExperimentCard /> })}
        </div>
        {lab.shows(Panel::Responses).then(|| view! { <responses::ResponsesCard /> })}
    }
}
