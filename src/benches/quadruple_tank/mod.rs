//! The home bench: from two valves to the step response.

mod controller;
mod experiment;
mod explore;
mod fit_bounds;
mod fit_found;
mod fit_view;
mod flags;
mod four_levels;
mod frequency;
mod marks;
mod mends;
mod metrics;
mod moment;
mod operating_point;
mod pictures;
mod pins;
mod poles;
mod preset;
mod process;
mod published;
mod pump_table;
mod record;
mod record_errors;
mod record_view;
mod replay;
mod responses;
mod rga;
mod rig;
mod rig_numbers;
mod sentences;
mod session;
mod set_points;
mod start;
mod steps;
mod valves;
mod why;

use leptos::prelude::*;

use crate::depth::Depth;
use flags::panels;
pub use moment::RigState;
use moment::provide_moment;
pub use pictures::name_of_boundary;
pub use preset::{load, name_of};
pub use rig::{drawing, ghosts, summary};
pub use session::QuadrupleTank;
use session::Session;

/// What is shown at the chosen depth.
fn cards(session: Session) -> impl IntoView {
    provide_moment(session);
    let is_first = Memo::new(move |_| session.lab.shown_depth() == Depth::Explore);
    move || if is_first.get() { view! { <explore::Explore /> }.into_any() } else { all_cards(session).into_any() }
}

/// The cards that the start flags ask for.
fn all_cards(session: Session) -> impl IntoView {
    let lab = session.lab;
    view! {
        <div class="side left">
            {lab.shows(panels::PROCESS).then(|| view! { <process::ProcessCard /> })}
            {lab.shows(panels::WHY).then(|| view! { <why::WhyCard /> })}
        </div>
        {lab.shows(panels::VALVES).then(|| view! { <valves::ValvePlaneCard /> })}
        {lab.shows(panels::ZEROS).then(|| view! { <poles::PolesAndZerosCard /> })}
        {lab.shows(panels::RGA).then(|| view! { <rga::RelativeGainCard /> })}
        <div class="side right">
            {lab.shows(panels::CONTROLLER).then(|| view! { <controller::ControllerCard /> })}
            {lab.shows(panels::EXPERIMENT).then(|| view! { <experiment::ExperimentCard /> })}
        </div>
        {lab.shows(panels::RESPONSES).then(|| view! { <responses::ResponsesCard /> })}
    }
}
