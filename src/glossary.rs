//! The words of the field, each in one or two plain sentences, with the lesson in which it is discovered.

use leptos::ev;
use leptos::prelude::*;
use quadtank_lesson::LESSON_IDS;

use super::lab::{Lab, use_lab};
use super::lessons::LessonLink;
use super::texts::{Language, say, terms, tr};
use super::widgets::{ReadOn, Text, marked, unmarked};

/// A word of the glossary.
pub struct Term {
    /// Its name in links of lessons.
    pub key: &'static str,
    /// The word in bold, and what it means.
    pub text: Text,
    /// The number of its lesson.
    pub lesson: usize,
}

/// All words, in the order of the benches.
pub const TERMS: [Term; 74] = [
    Term { key: "gamma", text: terms::gamma, lesson: 1 },
    Term { key: "minimum_phase", text: terms::minimum_phase, lesson: 1 },
    Term { key: "zero", text: terms::zero, lesson: 1 },
    Term { key: "right_half_plane", text: terms::right_half_plane, lesson: 1 },
    Term { key: "pole", text: terms::pole, lesson: 1 },
    Term { key: "closed_loop", text: terms::closed_loop, lesson: 3 },
    Term { key: "direction", text: terms::direction, lesson: 5 },
    Term { key: "relative_gain", text: terms::relative_gain, lesson: 2 },
    Term { key: "pairing", text: terms::pairing, lesson: 3 },
    Term { key: "niederlinski", text: terms::niederlinski, lesson: 3 },
    Term { key: "gain", text: terms::gain, lesson: 4 },
    Term { key: "integral_time", text: terms::integral_time, lesson: 4 },
    Term { key: "peak", text: terms::peak, lesson: 4 },
    Term { key: "singular_value", text: terms::singular_value, lesson: 5 },
    Term { key: "sensitivity", text: terms::sensitivity, lesson: 4 },
    Term { key: "complementary", text: terms::complementary, lesson: 4 },
    Term { key: "bandwidth", text: terms::bandwidth, lesson: 4 },
    Term { key: "windup", text: terms::windup, lesson: 7 },
    Term { key: "weight", text: terms::weight, lesson: 7 },
    Term { key: "reference", text: terms::reference, lesson: 4 },
    Term { key: "rise", text: terms::rise, lesson: 4 },
    Term { key: "overshoot", text: terms::overshoot, lesson: 4 },
    Term { key: "costs", text: terms::costs, lesson: 4 },
    Term { key: "linear", text: terms::linear, lesson: 6 },
    Term { key: "load", text: terms::load, lesson: 6 },
    Term { key: "noise", text: terms::noise, lesson: 6 },
    Term { key: "relay", text: terms::relay, lesson: 8 },
    Term { key: "ultimate", text: terms::ultimate, lesson: 8 },
    Term { key: "describing", text: terms::describing, lesson: 8 },
    Term { key: "hysteresis", text: terms::hysteresis, lesson: 8 },
    Term { key: "critical_curve", text: terms::critical_curve, lesson: 9 },
    Term { key: "importance", text: terms::importance, lesson: 9 },
    Term { key: "locus", text: terms::locus, lesson: 9 },
    Term { key: "target", text: terms::target, lesson: 9 },
    Term { key: "margins", text: terms::margins, lesson: 4 },
    Term { key: "log_modulus", text: terms::log_modulus, lesson: 4 },
    Term { key: "decoupler", text: terms::decoupler, lesson: 5 },
    Term { key: "local_model", text: terms::local_model, lesson: 10 },
    Term { key: "estimate", text: terms::estimate, lesson: 10 },
    Term { key: "alpha", text: terms::alpha, lesson: 10 },
    Term { key: "lost", text: terms::lost, lesson: 10 },
    Term { key: "transmitter", text: terms::transmitter, lesson: 12 },
    Term { key: "converter", text: terms::converter, lesson: 12 },
    Term { key: "actuator", text: terms::actuator, lesson: 12 },
    Term { key: "characteristic", text: terms::characteristic, lesson: 12 },
    Term { key: "resistance", text: terms::resistance, lesson: 12 },
    Term { key: "tight", text: terms::tight, lesson: 11 },
    Term { key: "averaging", text: terms::averaging, lesson: 11 },
    Term { key: "variance", text: terms::variance, lesson: 11 },
    Term { key: "disturbance", text: terms::disturbance, lesson: 11 },
    Term { key: "random", text: terms::random, lesson: 11 },
    Term { key: "self_regulating", text: terms::self_regulating, lesson: 12 },
    Term { key: "reaction_curve", text: terms::reaction_curve, lesson: 12 },
    Term { key: "process_gain", text: terms::process_gain, lesson: 12 },
    Term { key: "half_rule", text: terms::half_rule, lesson: 12 },
    Term { key: "gain_of_signals", text: terms::gain_of_signals, lesson: 12 },
    Term { key: "simc", text: terms::simc, lesson: 12 },
    Term { key: "lambda", text: terms::lambda, lesson: 12 },
    Term { key: "variance_index", text: terms::variance_index, lesson: 11 },
    Term { key: "harris", text: terms::harris, lesson: 11 },
    Term { key: "travel", text: terms::travel, lesson: 11 },
    Term { key: "cost_map", text: terms::cost_map, lesson: 11 },
    Term { key: "gradient", text: terms::gradient, lesson: 11 },
    Term { key: "simplex", text: terms::simplex, lesson: 11 },
    Term { key: "genetic", text: terms::genetic, lesson: 11 },
    Term { key: "pi_forms", text: terms::pi_forms, lesson: 12 },
    Term { key: "proportional_band", text: terms::proportional_band, lesson: 12 },
    Term { key: "step_size", text: terms::step_size, lesson: 12 },
    Term { key: "level_windup", text: terms::level_windup, lesson: 7 },
    Term { key: "level_costs", text: terms::level_costs, lesson: 11 },
    Term { key: "sine", text: terms::sine, lesson: 11 },
    Term { key: "search_box", text: terms::search_box, lesson: 12 },
    Term { key: "move_penalty", text: terms::move_penalty, lesson: 11 },
    Term { key: "amigo", text: terms::amigo, lesson: 12 },
];

impl Term {
    /// The word itself.
    pub fn word(&self, language: Language) -> String {
        let text = (self.text)(language);
        text.split("**").nth(1).unwrap_or(&text).to_owned()
    }

    fn lesson_id(&self) -> &'static str {
        LESSON_IDS[self.lesson - 1]
    }

    /// Its section in the document about the model.
    fn section(&self) -> &'static str {
        match self.key {
            "gamma" => "2-symbols-and-constants",
            "load" => "3-the-plant",
            "linear" => "4-the-linear-model",
            "pole" => "5-poles-and-steady-state-gain",
            "minimum_phase" | "zero" | "right_half_plane" | "direction" => "6-zeros-and-directions",
            "relative_gain" | "pairing" | "niederlinski" => "7-interaction-and-pairing",
            "closed_loop" | "gain" | "integral_time" | "windup" | "weight" | "peak" | "singular_value"
            | "sensitivity" | "complementary" | "bandwidth" => "8-the-controller",
            "reference" | "noise" => "9-the-run",
            "rise" | "overshoot" | "costs" => "10-metrics",
            "local_model" | "estimate" | "alpha" | "lost" => "14-model-free-control",
            _ if matches!(self.lesson, 4..=5 | 8..=9) => "13-relay-tuning",
            _ => "15-the-level-loop",
        }
    }
}

/// The section of the document about the model on the first of some explanations.
pub fn section_of(language: Language, texts: &[Text]) -> &'static str {
    let explained = texts.first().map(|text| text(language));
    let term = TERMS.iter().find(|term| Some((term.text)(language)) == explained);
    term.map_or("", Term::section)
}

/// The link from a word to its lesson.
fn lesson_link(lab: Lab, term: &'static Term) -> impl IntoView {
    view! {
        <LessonLink id=term.lesson_id() class="to-lesson" testid=format!("to-lesson-{}", term.key)>
            {move || tr!(lab, lesson.to_lesson, number = term.lesson)}
        </LessonLink>
    }
}

#[allow(clippy::needless_pass_by_value, reason = "properties of components are owned")]
/// A word in a text, which explains itself when it is pressed; `Esc` closes it.
#[component]
pub fn TermLink(
    /// The name of the word.
    key: String,
    /// How it is written in the text.
    text: String,
) -> impl IntoView {
    let lab = use_lab();
    let Some(term) = TERMS.iter().find(|term| term.key == key) else { return text.into_any() };
    let open = RwSignal::new(false);
    let on_key = move |event: ev::KeyboardEvent| {
        if event.key() == "Escape" && open.get_untracked() {
            event.stop_propagation();
            open.set(false);
        }
    };
    let explained = move || {
        open.get().then(|| {
            view! {
                <span class="term-note" role="note">
                    {move || marked(&(term.text)(lab.language.get()))} " "
                    {lesson_link(lab, term)} " "
                    <ReadOn section=term.section() />
                </span>
            }
        })
    };
    view! {
        <span class="term" on:keydown=on_key>
            <button type="button" aria-expanded=move || if open.get() { "true" } else { "false" } on:click=move |_| open.update(|open| *open = !*open)>
                {text}
            </button>
            {explained}
        </span>
    }
    .into_any()
}

/// All words with a search.
#[component]
pub fn Glossary() -> impl IntoView {
    let lab = use_lab();
    let sought = RwSignal::new(String::new());
    let found = Memo::new(move |_| {
        let (language, sought) = (lab.language.get(), plain(&sought.get()));
        let mut found: Vec<usize> = (0..TERMS.len())
            .filter(|&index| plain(&unmarked(&(TERMS[index].text)(language))).contains(&sought))
            .collect();
        found.sort_by_key(|&index| plain(&TERMS[index].word(language)));
        found
    });
    let entry = move |index: usize| {
        let term = &TERMS[index];
        view! {
            <li id=format!("term-{}", term.key)>
                <p>{marked(&(term.text)(lab.language.get()))}</p>
                {lesson_link(lab, term)} " "
                <ReadOn section=term.section() />
            </li>
        }
    };
    view! {
        <main class="side-page glossary" id="bench" tabindex="-1" data-testid="glossary">
            <h2>{say!(lab, lesson.glossary)}</h2>
            <label class="search">
                {say!(lab, lesson.search)}
                <input type="search" data-testid="glossary-search" on:input=move |event| sought.set(event_target_value(&event)) />
            </label>
            <p role="status" class="remark">{move || tr!(lab, lesson.found, count = found.with(Vec::len))}</p>
            <ul class="glossary-list">{move || found.get().into_iter().map(entry).collect_view()}</ul>
        </main>
    }
}

/// A text for comparison: lower case, without accents.
fn plain(text: &str) -> String {
    let without_accent = |c: char| match c {
        'á' | 'à' | 'â' | 'ã' | 'ä' => 'a',
        'é' | 'ê' | 'è' => 'e',
        'í' | 'ì' => 'i',
        'ó' | 'ô' | 'õ' | 'ò' => 'o',
        'ú' | 'ü' | 'ù' => 'u',
        'ç' => 'c',
        'ñ' => 'n',
        other => other,
    };
    text.trim().to_lowercase().chars().map(without_accent).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_stands_in_bold_in_its_explanation() {
        for (term, language) in TERMS.iter().flat_map(|term| Language::ALL.map(|language| (term, language))) {
            assert!((term.text)(language).contains("**"), "{} in {}", term.key, language.tag());
            assert!(!term.lesson_id().is_empty());
        }
    }

    #[test]
    fn every_word_has_its_section_in_the_document_about_the_model() {
        let document = include_str!("../docs/model.md");
        let anchors: Vec<String> = document
            .lines()
            .filter_map(|line| line.strip_prefix("## "))
            .map(|heading| heading.to_lowercase().replace('.', "").replace(' ', "-"))
            .collect();
        for term in &TERMS {
            assert!(anchors.iter().any(|anchor| anchor == term.section()), "{} {}", term.key, term.section());
        }
        let section = |key: &str| TERMS.iter().find(|term| term.key == key).map(Term::section);
        for (key, of) in [("locus", "13-relay-tuning"), ("margins", "13-relay-tuning"), ("simc", "15-the-level-loop")] {
            assert_eq!(section(key), Some(of));
        }
    }

    #[test]
    fn a_search_finds_words_without_their_accents() {
        assert_eq!(plain(" Período ÚLTIMO "), "periodo ultimo");
    }
}
