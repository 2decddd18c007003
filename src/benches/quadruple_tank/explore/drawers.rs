//! Everything else, folded: a drawer is made when it is opened first.

use leptos::html::Details;
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

#[component]
fn Drawer(
    /// Name for tests.
    id: &'static str,
    /// What it holds.
    #[prop(into)]
    title: Signal<String>,
    /// Its content.
    #[prop(into)]
    content: ViewFn,
) -> impl IntoView {
    let details = NodeRef::<Details>::new();
    let seen = RwSignal::new(false);
    let open = move |_| {
        // The event comes after the click, when the drawer may be gone.
        if details.try_get_untracked().flatten().is_some_and(|details| details.open()) {
            seen.set(true);
        }
    };
    view! {
        <details class="drawer" node_ref=details on:toggle=open>
            <summary class="button" data-testid=id>{title}</summary>
            <div class="content">{move || seen.get().then(|| content.run())}</div>
        </details>
    }
}
