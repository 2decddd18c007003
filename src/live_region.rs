//! The one place where screen readers hear what a change of the experiment has brought.

use std::collections::HashMap;

use gloo_timers::callback::Timeout;
use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;
use web_sys::HtmlElement;

use super::lab::use_lab;

/// Pause after the last change of any result before the changes are announced (ms). During a drag, results change twenty times a second.
const RESTED_MS: u32 = 1000;

/// Selects the elements whose changes are announced. The value of the attribute names the result.
const RESULTS: &str = "[data-result]";

/// Tells the results that have changed, once they have stayed as they are for a second. A result that comes into sight with its card
/// or a new language is not news.
#[component]
pub fn LiveRegion() -> impl IntoView {
    let lab = use_lab();
    let told = RwSignal::new(String::new());
    // What was shown last, and in which language.
    let known = StoredValue::new((lab.language.get_untracked(), HashMap::new()));
    let timer = StoredValue::new_local(None::<Timeout>);
    Effect::new(move || {
        lab.track_texts();
        let language = lab.language.get_untracked();
        if known.with_value(|(of, _)| *of != language) {
            told.set(String::new());
        }
        let rested = move || {
            let results = shown_results();
            let news =
                known.with_value(|(of, known)| if *of == language { changed(&results, known) } else { String::new() });
            known.set_value((language, results.into_iter().collect()));
            told.set(news);
        };
        timer.set_value(Some(Timeout::new(RESTED_MS, rested)));
    });
    on_cleanup(move || timer.dispose());
    view! { <p class="visually-hidden" role="status" data-testid="live-region">{told}</p> }
}

/// Names and texts of the results in sight, in the order of the page.
fn shown_results() -> Vec<(String, String)> {
    let Ok(found) = document().query_selector_all(RESULTS) else { return Vec::new() };
    let elements = (0..found.length()).filter_map(|k| found.item(k)?.dyn_into::<HtmlElement>().ok());
    let shown = elements.filter(|element| element.offset_parent().is_some());
    // Not its text content, which joins the last word of a paragraph to the first of the next.
    let words = |element: &HtmlElement| element.inner_text().split_whitespace().collect::<Vec<_>>().join(" ");
    shown.filter_map(|element| Some((element.get_attribute("data-result")?, words(&element)))).collect()
}

/// The texts of results that said something else before.
fn changed(results: &[(String, String)], known: &HashMap<String, String>) -> String {
    let is_news = |(name, text): &&(String, String)| known.get(name).is_some_and(|before| before != text);
    results.iter().filter(is_news).map(|(_, text)| text.as_str()).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_changed_is_told_and_what_comes_into_sight_is_not() {
        let results = |texts: &[(&str, &str)]| -> Vec<(String, String)> {
            texts.iter().map(|&(name, text)| (name.to_owned(), text.to_owned())).collect()
        };
        let known = results(&[("zero", "At −0.01 1/s."), ("pairing", "Pair 1–1.")]).into_iter().collect();
        let now = results(&[("zero", "At 0.02 1/s."), ("pairing", "Pair 1–1."), ("stability", "Stable.")]);
        assert_eq!(changed(&now, &known), "At 0.02 1/s.");
        assert_eq!(changed(&now, &HashMap::new()), "");
    }
}
