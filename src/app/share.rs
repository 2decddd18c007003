//! Links and files: how an experiment leaves the page and comes back.

use leptos::prelude::*;

use super::download::{copy, download_text};
use super::lab::{Lab, Notice};
use crate::scenario::{Scenario, ScenarioError, from_json, from_link, to_json, to_link};

/// What stands before the link text in the fragment of an address.
const PREFIX: &str = "lab=";

/// The scenario in the fragment of the address, if there is one.
pub fn from_address() -> Option<Result<Scenario, ScenarioError>> {
    let fragment = window().location().hash().ok()?;
    fragment.trim_start_matches('#').strip_prefix(PREFIX).map(from_link)
}

/// The address that restores everything. Start flags stay; a page without an address of its own (`srcdoc`) has only the
/// fragment to give.
fn address_of(scenario: &Scenario) -> Result<String, ScenarioError> {
    let link = to_link(scenario)?;
    let here = window().location().href().unwrap_or_default();
    let page = here.split('#').next().unwrap_or_default();
    Ok(format!("{page}#{PREFIX}{link}"))
}

/// The fragment that restores everything, for a link to another page.
pub fn fragment(lab: Lab) -> Option<String> {
    lab.scenario.with_untracked(to_link).ok().map(|link| format!("#{PREFIX}{link}"))
}

/// Puts the link on the clipboard and into the address bar, so that a reload restores the bench as well.
pub fn share(lab: Lab) {
    match lab.scenario.with_untracked(address_of) {
        Err(error) => lab.notice.set(Some(Notice::Refused(error))),
        Ok(address) => {
            // A sandboxed page may not touch its address; the link is then on the clipboard only.
            if let Ok(history) = window().history() {
                let fragment = address.split_once('#').map_or("", |(_, fragment)| fragment);
                let _ = history.replace_state_with_url(
                    &leptos::wasm_bindgen::JsValue::NULL,
                    "",
                    Some(&format!("#{fragment}")),
                );
            }
            copy(&address.clone(), move |copied| {
                lab.notice.set(Some(if copied { Notice::Copied } else { Notice::CopyByHand(address) }));
            });
        }
    }
}

/// Hands the experiment over as a file, as the command line reads it.
pub fn save(lab: Lab) {
    match lab.scenario.with_untracked(to_json) {
        Ok(text) => download_text("quadtank-experiment.json", "application/json", &text),
        Err(error) => lab.notice.set(Some(Notice::Refused(error))),
    }
}

/// Opens an experiment from a file.
pub fn open_file(lab: Lab, file: &web_sys::File) {
    let text = wasm_bindgen_futures::JsFuture::from(file.text());
    leptos::task::spawn_local(async move {
        let text = text.await.ok().and_then(|t| t.as_string()).unwrap_or_default();
        lab.open(from_json(&text));
    });
}
