//! The relay-tuning bench: relay test, critical curve, placement of the critical point, response (Campestrini 2006).

mod compared;
mod curve;
mod details;
mod errors;
mod flags;
mod formulas;
mod given;
mod guide;
mod mends;
mod pictures;
mod placement;
mod plant;
mod printed;
mod readout;
mod response;
mod roots;
mod session;
mod step;
mod test;
mod test_report;
mod timeline;

use leptos::prelude::*;

use flags::panels;
pub use session::RelayTuning;
use session::Session;

/// The cards that the start flags ask for.
fn cards(session: Session) -> impl IntoView {
    let lab = session.lab;
    view! {
        {lab.shows(panels::PLANT).then(|| view! { <plant::PlantCard /> })}
        {lab.shows(panels::TEST).then(|| view! { <test::TestCard /> })}
        {lab.shows(panels::CURVE).then(|| view! { <curve::CurveCard /> })}
        {lab.shows(panels::PLACEMENT).then(|| view! { <placement::PlacementCard /> })}
        {lab.shows(panels::RESPONSES).then(|| view! { <response::ResponseCard /> })}
        <guide::NextStep />
    }
}
