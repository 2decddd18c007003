//! Everything else, folded.

use leptos::prelude::*;

use super::super::controller::ControllerCard;
use super::super::experiment::ExperimentCard;
use super::super::poles::PolesAndZerosCard;
use super::super::process::SettingsCard;
use super::super::responses::ResponsesCard;
use super::super::rga::RelativeGainCard;
use super::super::session::use_session;
use super::super::why::WhyCard;
use crate::texts::say;
use crate::widgets::Drawer;

/// All drawers.
#[component]
pub fn Drawers() -> impl IntoView {
    let lab = use_session().lab;
    view! {
        <div class="drawers">
            <Drawer id="drawer-why" title=say!(lab, explore.drawer_why) content=|| view! { <PolesAndZerosCard /> <WhyCard /> } />
            <Drawer id="drawer-gains" title=say!(lab, explore.drawer_gains) content=|| view! { <RelativeGainCard /> } />
            <Drawer id="drawer-controllers" title=say!(lab, explore.drawer_controllers) content=|| view! { <ControllerCard /> } />
            <Drawer id="drawer-disturb" title=say!(lab, explore.drawer_disturb) content=|| view! { <ExperimentCard /> } />
            <Drawer
                id="drawer-numbers"
                title=say!(lab, explore.drawer_numbers)
                content=|| view! { <SettingsCard /> <ResponsesCard /> }
            />
        </div>
    }
}
