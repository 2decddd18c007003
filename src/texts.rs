//! The texts for people: keys from `assets/locales`, checked when the crate is compiled (see `build.rs`).

use std::fmt::{Display, Write as _};
use std::sync::OnceLock;

use leptos::prelude::*;

use super::format::NumberStyle;

#[allow(missing_docs, non_camel_case_types, clippy::pedantic, dead_code, reason = "generated")]
pub(super) mod generated {
    include!(concat!(env!("OUT_DIR"), "/texts.rs"));
}

/// A language of the laboratory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// English.
    English,
    /// Brazilian Portuguese.
    Portuguese,
}

impl Language {
    /// The language of a tag such as `pt-BR` or `en_GB`; English where it is not spoken here.
    pub fn of_tag(tag: &str) -> Self {
        if tag.to_ascii_lowercase().starts_with("pt") { Self::Portuguese } else { Self::English }
    }

    /// The tag for the `lang` attribute.
    pub fn tag(self) -> &'static str {
        match self {
            Self::English => "en",
            Self::Portuguese => "pt-BR",
        }
    }

    /// How the language writes numbers.
    pub fn number_style(self) -> NumberStyle {
        NumberStyle {
            decimal: match self {
                Self::English => '.',
                Self::Portuguese => ',',
            },
        }
    }
}

/// A text by its number.
fn text(number: usize, language: Language) -> &'static str {
    static TEXTS: OnceLock<[Vec<&str>; 2]> = OnceLock::new();
    TEXTS.get_or_init(|| generated::TEXTS.map(|texts| texts.split('\u{1f}').collect()))[language as usize][number]
}

/// A text with its values filled in: a control character stands where the value of this number belongs, counted from 1.
fn fill(text: &str, values: &[&dyn Display]) -> String {
    let mut filled = String::with_capacity(text.len() + 16);
    for character in text.chars() {
        match (character as usize).checked_sub(1).and_then(|place| values.get(place)) {
            Some(value) => {
                // Writing to a String cannot fail.
                let _ = write!(filled, "{value}");
            }
            None => filled.push(character),
        }
    }
    filled
}

/// A text in the language of the laboratory, with its values filled in; follows a change of language.
macro_rules! tr {
    ($lab:expr, $group:ident . $key:ident) => {
        $crate::texts::generated::$group::$key.text(leptos::prelude::Get::get(&$lab.language))
    };
    ($lab:expr, $group:ident . $key:ident, $($name:ident = $value:expr),+ $(,)?) => {
        $crate::texts::generated::$group::$key { $($name: &$value),+ }.text(leptos::prelude::Get::get(&$lab.language))
    };
}
pub(crate) use tr;

/// A text without values, following the language.
pub fn follow(language: RwSignal<Language>, number: usize) -> Signal<String> {
    Signal::derive(move || text(number, language.get()).to_owned())
}

/// The same as a signal, which is what the parts of the page take.
macro_rules! say {
    ($lab:expr, $group:ident . $key:ident) => {
        $crate::texts::follow($lab.language, $crate::texts::generated::$group::$key::NUMBER)
    };
    ($lab:expr, $($key_and_values:tt)+) => {
        leptos::prelude::Signal::derive(move || $crate::texts::tr!($lab, $($key_and_values)+).to_string())
    };
}
pub(crate) use say;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_filled_in_wherever_they_stand() {
        assert_eq!(fill("\u{1} to \u{2}, \u{1}", &[&1, &"x"]), "1 to x, 1");
        assert_eq!(fill("nothing", &[&1]), "nothing");
    }

    #[test]
    fn a_text_knows_both_languages() {
        assert_eq!(generated::process::title.text(Language::English), "Process");
        assert_eq!(generated::process::title.text(Language::Portuguese), "Processo");
        let allowed = generated::field::allowed { min: &0, max: &1 };
        assert_eq!(allowed.text(Language::Portuguese), "de 0 a 1");
    }

    #[test]
    fn a_language_is_found_by_its_tag() {
        assert_eq!(Language::of_tag("pt"), Language::Portuguese);
        assert_eq!(Language::of_tag("PT_br").tag(), "pt-BR");
        assert_eq!(Language::of_tag("de-CH"), Language::English);
    }
}
