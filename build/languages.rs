//! The languages of the laboratory.

/// What the laboratory has to know of a language beside its texts.
pub struct Language {
    /// The tag for the `lang` attribute. The texts are in `assets/locales/<tag>.json` and `assets/glossary/<tag>.json`.
    pub tag: &'static str,
    /// What the language calls itself.
    pub name: &'static str,
    /// Sign between the whole part of a number and its fraction.
    pub decimal: char,
    /// The plural categories of CLDR but for `other`, each with the pattern of the counts that it holds for: the arms of a `match`
    /// on a whole number, of which the first that fits is taken.
    pub plural: &'static [(&'static str, &'static str)],
}

/// The languages of the page, in the order of its menu. The first is the default.
///
/// A further language is a row here and its files in `assets/locales` and `assets/glossary`; what either lacks stops the compiler. Three things are for
/// people to see to: `index.html` and `assets/start.js` speak before a language is chosen and say each sentence in all of them; the
/// README names the tags of `lang=`; the end-to-end tests go through the languages for layout and accessibility.
///
/// Portuguese also has `many` for whole millions ("1 milhão de"), which no count here reaches.
pub const LANGUAGES: &[Language] = &[
    Language { tag: "en", name: "English", decimal: '.', plural: &[("one", "1")] },
    Language { tag: "pt-BR", name: "Português", decimal: ',', plural: &[("one", "0 | 1")] },
    Language { tag: "es", name: "Español", decimal: ',', plural: &[("one", "1")] },
];
