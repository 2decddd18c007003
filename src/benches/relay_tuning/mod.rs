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

use crate::start::Panel;
pub use session::RelayTuning;
use session::Session;

/// The cards that the start flags ask for.
fn cards(session: Session) -> impl IntoView {
    let lab = session.lab;
    view! {
        {lab.shows(Panel::Plant).then(|| view! { <plant::PlantCard /> })}
        {lab.shows(Panel::Test).then(|| view! { <test::TestCard /> })}
        {lab.shows(Panel::Curve).then(|| view! { <curve::CurveCard /> })}
        {lab.shows(Panel::Placement).then(|| view! { <placement::PlacementCard /> })}
        {lab.shows(Panel::Responses).then(|| view! { <response::ResponseCard /> })}
    }
}
