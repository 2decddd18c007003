//! Links and files: how an experiment leaves the page and comes back.

use leptos::prelude::*;

use super::benches::BenchEntry;
use super::download::{copy, download_text};
use super::lab::{Lab, Notice};
use quadtank_scenario::{Document, ScenarioError, check_length, document_from_bytes, document_from_link};

/// What stands before the link text in the fragment of an address.
const PREFIX: &str = "lab=";
/// A reference to this page without its query.
pub const BARE: &str = "?";

/// The document in the fragment of the address, if there is one.
pub fn from_address() -> Option<Result<Document, ScenarioError>> {
    let fragment = window().location().hash().ok()?;
    fragment.trim_start_matches('#').strip_prefix(PREFIX).map(document_from_link)
}

/// The link of the bench that is shown.
fn link_of(lab: Lab) -> Result<String, ScenarioError> {
    (lab.bench.get_untracked().link)(lab)
}

/// The address that restores everything. Start flags stay; a page without an address of its own (`srcdoc`) has only the
/// fragment to give.
pub fn address_of(lab: Lab) -> Result<String, ScenarioError> {
    let link = link_of(lab)?;
    let here = window().location().href().unwrap_or_default();
    let page = here.split('#').next().unwrap_or_default();
    Ok(format!("{page}#{PREFIX}{link}"))
}

/// A reference to this page without its start flags that restores everything. It names no path: one that begins with two
/// slashes would be read as a host.
pub fn bare_reference(lab: Lab) -> Result<String, ScenarioError> {
    Ok(format!("{BARE}#{PREFIX}{}", link_of(lab)?))
}

/// Puts the link on the clipboard and into the address bar, so that a reload restores the bench as well.
pub fn share(lab: Lab) {
    match address_of(lab) {
        Err(error) => lab.notice.set(Some(Notice::Refused(error))),
        Ok(address) => {
            let fragment = address.split_once('#').map_or("", |(_, fragment)| fragment);
            show_address(&format!("#{fragment}"));
            copy(&address.clone(), move |copied| {
                lab.notice.set(Some(if copied { Notice::Copied } else { Notice::CopyByHand(address) }));
            });
        }
    }
}

/// Shows an address without loading it. A sandboxed page may not touch its address, and goes on without.
fn show_address(address: &str) {
    if let Ok(history) = window().history() {
        let _ = history.replace_state_with_url(&leptos::wasm_bindgen::JsValue::NULL, "", Some(address));
    }
}

/// Shows another bench, also in the address, so that a reload comes back to it. A link in the address was of the last one.
pub fn go_to(lab: Lab, bench: &'static BenchEntry) {
    lab.bench.set(bench);
    let query = window().location().search().unwrap_or_default();
    let others =
        query.trim_start_matches('?').split('&').filter(|pair| !pair.is_empty() && !pair.starts_with("bench="));
    let query: Vec<String> = others.map(str::to_owned).chain([format!("bench={}", bench.id)]).collect();
    show_address(&format!("?{}", query.join("&")));
}

/// Name of the file of an experiment.
pub const FILE: &str = "quadtank-experiment.json";

/// The document of the bench that is shown, as a file and the command line have it.
pub fn json_of(lab: Lab) -> Result<String, ScenarioError> {
    (lab.bench.get_untracked().json)(lab)
}

/// Hands the experiment over as a file.
pub fn save(lab: Lab) {
    match json_of(lab) {
        Ok(text) => download_text(FILE, "application/json", &text),
        Err(error) => lab.notice.set(Some(Notice::Refused(error))),
    }
}

/// Opens an experiment from a file. One that is too long is refused by its size.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a number of bytes")]
pub fn open_file(lab: Lab, file: &web_sys::File) {
    if let Err(error) = check_length(file.size() as usize) {
        return lab.notice.set(Some(Notice::Refused(error)));
    }
    let bytes = wasm_bindgen_futures::JsFuture::from(file.array_buffer());
    leptos::task::spawn_local(async move {
        match bytes.await {
            Ok(buffer) => lab.open(document_from_bytes(&js_sys::Uint8Array::new(&buffer).to_vec())),
            Err(_) => lab.notice.set(Some(Notice::NotRead)),
        }
    });
}
