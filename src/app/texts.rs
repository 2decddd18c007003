//! The texts for people: keys from `assets/locales`, checked when the crate is compiled.

#[allow(missing_docs, clippy::all, clippy::pedantic, unused, reason = "generated")]
mod generated {
    include!(concat!(env!("OUT_DIR"), "/i18n/mod.rs"));
}

pub use generated::i18n::Locale;

use super::format::NumberStyle;

/// A text in the language of the laboratory, with its values filled in; follows a change of language.
macro_rules! tr {
    ($lab:expr, $($key_and_values:tt)+) => {
        leptos_i18n::td_string!(leptos::prelude::Get::get(&$lab.language), $($key_and_values)+)
    };
}
pub(crate) use tr;

/// The same as a signal. Views take this rather than a closure: they are then compiled once, not once for each text.
macro_rules! say {
    ($lab:expr, $($key_and_values:tt)+) => {
        leptos::prelude::Signal::derive(move || $crate::app::texts::tr!($lab, $($key_and_values)+).to_string())
    };
}
pub(crate) use say;

/// The language of a tag such as `pt-BR` or `en_GB`; English where it is not spoken here.
pub fn language_of(tag: &str) -> Locale {
    if tag.to_ascii_lowercase().starts_with("pt") { Locale::pt_BR } else { Locale::en }
}

/// The tag of a language for the `lang` attribute.
pub fn tag_of(language: Locale) -> &'static str {
    match language {
        Locale::en => "en",
        Locale::pt_BR => "pt-BR",
    }
}

/// How a language writes numbers.
pub fn number_style(language: Locale) -> NumberStyle {
    NumberStyle {
        decimal: match language {
            Locale::en => '.',
            Locale::pt_BR => ',',
        },
    }
}
