//! The relay-tuning bench: relay test, critical curve, placement of the critical point, response (Campestrini 2006).

mod controls;
mod curve;
mod details;
mod errors;
mod pictures;
mod placement;
mod plant;
mod printed;
mod readout;
mod response;
mod session;
mod step;
mod test;
mod test_report;
mod timeline;

use leptos::prelude::*;

use super::lab::use_lab;
use super::start::{Bench, Panel};

/// The bench, or those of its cards that the start flags ask for.
#[component]
pub fn RelayTuningBench() -> impl IntoView {
    let lab = use_lab();
    let shows = move |panel| lab.flags.with_value(|f| f.shows(panel));
    let chosen = lab.flags.with_value(|f| !f.panels.is_empty());
    view! {
        <main class=if chosen { "bench relay chosen" } else { "bench relay" } id=move || lab.id_of(Bench::RelayTuning)>
            {shows(Panel::Plant).then(|| view! { <plant::PlantCard /> })}
            {shows(Panel::Test).then(|| view! { <test::TestCard /> })}
            {shows(Panel::Curve).then(|| view! { <curve::CurveCard /> })}
            {shows(Panel::Placement).then(|| view! { <placement::PlacementCard /> })}
            {shows(Panel::Responses).then(|| view! { <response::ResponseCard /> })}
        </main>
    }
}
