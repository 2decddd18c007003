//! The texts for people: keys from `assets/locales`, checked when the crate is compiled (see `build/`).

use leptos::prelude::*;

use super::format::NumberStyle;

#[allow(missing_docs, non_camel_case_types, clippy::all, clippy::pedantic, reason = "generated")]
pub(super) mod generated {
    include!(concat!(env!("OUT_DIR"), "/texts.rs"));
}

pub use generated::{Language, terms};

impl Language {
    /// The language of a tag such as `pt-BR` or `en_GB`, if need be of another region; the first one where it is not spoken here.
    pub fn of_tag(tag: &str) -> Self {
        Self::spoken(tag).unwrap_or_default()
    }

    /// The language of a tag such as `pt-BR` or `pt`, if it is spoken here.
    pub fn spoken(tag: &str) -> Option<Self> {
        let tag = tag.replace('_', "-").to_ascii_lowercase();
        let primary = |tag: &str| tag.split('-').next().map(str::to_ascii_lowercase);
        let known = Self::ALL.into_iter();
        let same = known.clone().find(|language| language.tag().eq_ignore_ascii_case(&tag));
        same.or_else(|| known.clone().find(|language| primary(language.tag()) == primary(&tag)))
    }

    /// How the language writes numbers.
    pub fn number_style(self) -> NumberStyle {
        NumberStyle { decimal: self.decimal() }
    }
}

/// A text in the language of the laboratory, with its values filled in; follows a change of language.
macro_rules! tr {
    ($lab:expr, $group:ident . $key:ident) => {
        $crate::texts::generated::$group::$key(leptos::prelude::Get::get(&$lab.language))
    };
    ($lab:expr, $group:ident . $key:ident, $($name:ident = $value:expr),+ $(,)?) => {
        $crate::texts::generated::$group::$key(
            leptos::prelude::Get::get(&$lab.language),
            $crate::texts::generated::$group::$key { $($name: $value),+ },
        )
    };
}
pub(crate) use tr;

/// A text without values, following the language.
pub fn follow(language: RwSignal<Language>, text: fn(Language) -> String) -> Signal<String> {
    Signal::derive(move || text(language.get()))
}

/// A text that is the same in all languages.
pub fn symbol(text: &'static str) -> Signal<String> {
    Signal::stored(text.to_owned())
}

/// The same as a signal, which is what the parts of the page take.
macro_rules! say {
    ($lab:expr, $group:ident . $key:ident) => {
        $crate::texts::follow($lab.language, $crate::texts::generated::$group::$key)
    };
    ($lab:expr, $($key_and_values:tt)+) => {
        leptos::prelude::Signal::derive(move || $crate::texts::tr!($lab, $($key_and_values)+))
    };
}
pub(crate) use say;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_has_its_values_filled_in_in_the_language() {
        use generated::field::allowed;
        assert_eq!(generated::process::title(Language::PtBr), "Processo");
        assert_eq!(allowed(Language::En, allowed { min: 0, max: "1" }), "0 to 1");
        assert_eq!(allowed(Language::PtBr, allowed { min: 0, max: "1" }), "de 0 a 1");
    }

    #[test]
    fn a_count_chooses_the_plural_form_of_the_language() {
        use generated::experiment::further;
        let steps = |language, count| further(language, further { count });
        assert_eq!(
            steps(Language::En, 0),
            "0 further steps or loads act as well: see the list of all steps, or the file."
        );
        assert_eq!(
            steps(Language::En, 1),
            "1 further step or load acts as well: see the list of all steps, or the file."
        );
        assert_eq!(
            steps(Language::PtBr, 0),
            "Há mais 0 degrau ou carga: veja a lista de todos os degraus, ou o arquivo."
        );
        assert_eq!(
            steps(Language::PtBr, 2),
            "Há mais 2 degraus ou cargas: veja a lista de todos os degraus, ou o arquivo."
        );
    }

    #[test]
    fn a_language_is_found_by_its_tag() {
        assert!(Language::ALL.into_iter().all(|language| Language::of_tag(language.tag()) == language));
        assert_eq!(Language::of_tag("pt"), Language::PtBr);
        assert_eq!(Language::of_tag("PT_pt"), Language::PtBr);
        assert_eq!(Language::of_tag(""), Language::En);
    }
}
