//! Links and files: how an experiment leaves the page and comes back.

use leptos::prelude::*;

use super::benches::BenchEntry;
use super::download::{copy, download_text};
use super::lab::{Lab, Notice};
use super::lessons::SidePage;
use super::naming::file_name;
use super::scenes;
use super::start::StartFlags;
use quadtank_scenario::{DOCUMENT_LIMIT, Opened, ScenarioError, Scenes, document_from_link, opened_from_bytes};

/// What stands before the link text in the fragment of an address.
const PREFIX: &str = "lab=";
/// The same before the link text of scenes.
const SCENES_PREFIX: &str = "scenes=";
/// Flags of what is shown in place of the benches, which an address of a bench has not.
const ELSEWHERE: [&str; 3] = ["page", "lesson", "step"];
/// A reference to this page without its query.
pub const BARE: &str = "?";

/// Shows a page beside the benches, which Back leaves.
pub fn go_to_page(lab: Lab, page: SidePage) {
    let bench = lab.bench.get_untracked().id;
    go_on_to(lab, &query_with(&bench_flags(), &[("page", page.name()), ("bench", bench)]));
    lab.side.set(Some(page));
}

/// The document or the scenes in the fragment of the address, if there are any.
pub fn from_address() -> Option<Result<Opened, ScenarioError>> {
    let fragment = window().location().hash().ok()?;
    let fragment = fragment.trim_start_matches('#');
    let document =
        fragment.strip_prefix(PREFIX).map(|link| document_from_link(link).map(Box::new).map(Opened::Document));
    let scenes = || fragment.strip_prefix(SCENES_PREFIX).map(|link| Scenes::from_link(link).map(Opened::Scenes));
    document.or_else(scenes)
}

/// Shows what a link or a file holds.
pub fn open(lab: Lab, outcome: Result<Opened, ScenarioError>) {
    match outcome {
        Ok(Opened::Scenes(scenes)) => scenes::open(lab, scenes),
        Ok(Opened::Document(document)) => lab.open(Ok(*document)),
        Err(error) => lab.open(Err(error)),
    }
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
    let page = here.split(['?', '#']).next().unwrap_or_default();
    let query = query_with(&bench_flags(), &shown(lab, lab.bench.get_untracked()));
    Ok(format!("{page}{query}#{PREFIX}{link}"))
}

/// A reference to this page that restores everything: of its start flags only language and theme, as they are chosen now, and how
/// much is shown. It names no path: one that begins with two slashes would be read as a host.
pub fn bare_reference(lab: Lab) -> Result<String, ScenarioError> {
    let language = ("lang", lab.language.get_untracked().tag());
    let theme = ("theme", if lab.dark.get_untracked() { "dark" } else { "light" });
    let mut pairs = vec![language, theme];
    pairs.extend(shown(lab, lab.bench.get_untracked()));
    Ok(format!("{}#{PREFIX}{}", query_with("", &pairs), link_of(lab)?))
}

/// The reference that brings a bench back as it is. One that is as it begins needs no document in its address, and what does not
/// fit into one is left to the browser's memory and to files.
pub fn kept_reference(lab: Lab, bench: &BenchEntry) -> String {
    reference_with(lab, bench, link_to_keep(lab, bench).as_deref())
}

/// Link of the document of a bench; `None` for the initial document, and for one that is too long for a link.
pub fn link_to_keep(lab: Lab, bench: &BenchEntry) -> Option<String> {
    (bench.is_changed)(lab).then(|| (bench.link)(lab).ok()).flatten()
}

/// [`kept_reference`] for a link that is already computed.
pub fn reference_with(lab: Lab, bench: &BenchEntry, link: Option<&str>) -> String {
    let mut pairs = vec![("bench", bench.id)];
    if link.is_some() || asked(lab).view.is_some() {
        pairs.extend(shown(lab, bench));
    }
    let query = query_with(&bench_flags(), &pairs);
    // An empty reference would be the present address with its fragment.
    let fragment = link.map(|link| format!("#{PREFIX}{link}")).unwrap_or_default();
    format!("{query}{fragment}")
}

/// How much of a bench is shown, for an address; nothing for a bench that has no choice.
fn shown(lab: Lab, bench: &BenchEntry) -> Vec<(&'static str, &'static str)> {
    let has_choice = bench.depths.len() > 1;
    has_choice.then(|| ("view", bench.depth(lab.depth.get_untracked()).name())).into_iter().collect()
}

/// Reference to this page that opens the experiment of a link.
pub fn state_reference(link: &str) -> String {
    format!("{BARE}#{PREFIX}{link}")
}

/// The reference of a step of a lesson, counted from 0.
pub fn lesson_reference(name: &str, step: usize) -> String {
    query_with(&bench_flags(), &[("lesson", name), ("step", &(step + 1).to_string())])
}

fn search() -> String {
    window().location().search().unwrap_or_default()
}

/// The flags of the address that hold for a bench.
fn bench_flags() -> String {
    query_without(&search(), &ELSEWHERE)
}

/// A query without these flags.
pub fn query_without(query: &str, names: &[&str]) -> String {
    let is_kept = |pair: &&str| !pair.is_empty() && pair.split('=').next().is_none_or(|name| !names.contains(&name));
    query.trim_start_matches('?').split('&').filter(is_kept).collect::<Vec<_>>().join("&")
}

/// A query with these values; its other ones stay.
pub fn query_with(query: &str, pairs: &[(&str, &str)]) -> String {
    let names: Vec<&str> = pairs.iter().map(|(name, _)| *name).collect();
    let others = query_without(query, &names);
    let all = (!others.is_empty()).then_some(others);
    let all = all.into_iter().chain(pairs.iter().map(|(name, value)| format!("{name}={value}")));
    format!("?{}", all.collect::<Vec<_>>().join("&"))
}

/// Puts the link on the clipboard and into the address bar, so that a reload restores the bench as well.
pub fn share(lab: Lab) {
    match address_of(lab) {
        Err(error) => lab.notice.set(Some(Notice::NotWritten(error))),
        Ok(address) => {
            let fragment = address.split_once('#').map_or("", |(_, fragment)| fragment);
            show_address(&format!("#{fragment}"));
            hand_over(lab, address);
        }
    }
}

/// Puts an address on the clipboard; where there is none, shows it.
pub fn hand_over(lab: Lab, address: String) {
    copy(&address.clone(), move |copied| {
        lab.notice.set(Some(match copied {
            false => Notice::CopyByHand(address),
            true if address.starts_with("file:") => Notice::CopiedFileLink,
            true => Notice::Copied,
        }));
    });
}

/// A reference to this page that brings all scenes along.
pub fn reference_of_scenes(lab: Lab) -> Result<String, ScenarioError> {
    Ok(format!("{BARE}#{SCENES_PREFIX}{}", lab.scenes.with_untracked(Scenes::to_link)?))
}

/// Shows an address without loading it, and says whether it could: a sandboxed page may not touch its address, and goes on
/// without.
pub fn show_address(address: &str) -> bool {
    let nothing = leptos::wasm_bindgen::JsValue::NULL;
    window().history().is_ok_and(|history| history.replace_state_with_url(&nothing, "", Some(address)).is_ok())
}

/// Goes on to another address, so that Back comes back to what is shown now.
pub fn go_on_to(lab: Lab, reference: &str) {
    // Pages and lessons have their address already.
    if lab.side.get_untracked().is_none() && lab.stage.with_untracked(Option::is_none) {
        show_address(&kept_reference(lab, lab.bench.get_untracked()));
    }
    add_address(reference);
}

/// Goes on to another address. A sandboxed page may not touch its address, and goes on without.
fn add_address(reference: &str) {
    if let Ok(history) = window().history() {
        let _ = history.push_state_with_url(&leptos::wasm_bindgen::JsValue::NULL, "", Some(reference));
    }
}

/// Shows another bench. It is a step of the browser's history, so that Back comes back to this one.
pub fn go_to(lab: Lab, bench: &'static BenchEntry) {
    if lab.bench.get_untracked() == bench && lab.side.get_untracked().is_none() {
        return;
    }
    go_on_to(lab, &kept_reference(lab, bench));
    lab.side.set(None);
    lab.bench.set(bench);
}

/// What the address asks for now.
pub fn asked(lab: Lab) -> StartFlags {
    StartFlags::parse(&search(), lab.benches)
}

/// Shows the bench or page that the address asks for after a step in the browser's history.
pub fn follow_address(lab: Lab) {
    let flags = asked(lab);
    lab.side.set(flags.page);
    if let Some(depth) = flags.view {
        lab.depth.set(depth);
    }
    match from_address() {
        Some(outcome) => open(lab, outcome),
        None => lab.bench.set(flags.bench.unwrap_or(&lab.benches[0])),
    }
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
        Ok(text) => download_text(&file_name(lab, FILE), "application/json", &text),
        Err(error) => lab.notice.set(Some(Notice::NotWritten(error))),
    }
}

/// Opens an experiment or scenes from a file. One that is too long is refused by its size. One of another bench is a step of the
/// browser's history, so that Back comes back to this one.
pub fn open_file(lab: Lab, file: &web_sys::File) {
    read_file(lab, file, DOCUMENT_LIMIT, move |bytes| {
        let left = lab.bench.get_untracked();
        open(lab, opened_from_bytes(&bytes));
        let shown = lab.bench.get_untracked();
        if shown != left {
            add_address(&kept_reference(lab, shown));
        }
    });
}

/// Reads a file of at most `limit` bytes, and hands them to `then`.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a number of bytes")]
pub fn read_file(lab: Lab, file: &web_sys::File, limit: usize, then: impl FnOnce(Vec<u8>) + 'static) {
    let length = file.size() as usize;
    if length > limit {
        return lab.notice.set(Some(Notice::Refused(ScenarioError::TooLong { length, max: limit })));
    }
    let bytes = wasm_bindgen_futures::JsFuture::from(file.array_buffer());
    leptos::task::spawn_local(async move {
        match bytes.await {
            Ok(buffer) => then(js_sys::Uint8Array::new(&buffer).to_vec()),
            Err(_) => lab.notice.set(Some(Notice::NotRead)),
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_of_a_query_are_replaced_and_others_stay() {
        assert_eq!(query_with("", &[("bench", "relay-tuning")]), "?bench=relay-tuning");
        assert_eq!(query_with("?lang=en&bench=a&x", &[("bench", "b"), ("view", "lab")]), "?lang=en&x&bench=b&view=lab");
        assert_eq!(query_with(&query_without("?page=x&lang=en&lesson=a&step=2", &ELSEWHERE), &[]), "?lang=en");
        assert_eq!(query_with("", &[]), "?");
        assert_eq!(query_with("?benches=a", &[("bench", "b")]), "?benches=a&bench=b");
    }
}
