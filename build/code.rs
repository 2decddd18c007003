//! Writes a function for each text.
//!
//! The key `allowed` of the group `field` becomes
//!
//! ```ignore
//! pub mod field {
//!     pub struct allowed<MAX, MIN> { pub max: MAX, pub min: MIN }
//!
//!     pub fn allowed(language: Language, allowed { max, min }: allowed<impl Display, impl Display>) -> String {
//!         match language {
//!             Language::En => format!("{min} to {max}"),
//!             Language::PtBr => format!("de {min} a {max}"),
//!         }
//!     }
//! }
//! ```
//!
//! The values are the fields of a struct because Rust has no named arguments: at the call every value stands beside its name. A plural
//! text has the field `count: usize`, and its function a `match` on it in each language. Every function returns a `String`, the type
//! that signals and views take, also for a text without values.

use std::collections::BTreeSet;
use std::fmt::{Result, Write};

use super::languages::Language;
use super::locales::{COUNT, Form, Locale, OTHER, Text};

/// The Rust of all texts, which are the same in all languages.
///
/// # Errors
///
/// None: writing to a `String` does not fail.
pub fn write(code: &mut String, locales: &[Locale]) -> Result {
    let languages: Vec<_> = locales.iter().map(|locale| locale.language).collect();
    write_languages(code, &languages)?;
    let keys: Vec<_> = locales.iter().take(1).flat_map(|locale| locale.texts.keys()).collect();
    let groups: BTreeSet<_> = keys.iter().map(|(group, _)| group).collect();
    for group in groups {
        writeln!(code, "pub mod {group} {{\nuse super::Language;")?;
        for &key in keys.iter().filter(|(of, _)| of == group) {
            let texts = locales.iter().filter_map(|locale| Some((locale.language, locale.texts.get(key)?)));
            write_function(code, &key.1, &texts.collect::<Vec<_>>())?;
        }
        writeln!(code, "}}")?;
    }
    Ok(())
}

/// The enum of the languages, with what their rows say.
fn write_languages(code: &mut String, languages: &[&Language]) -> Result {
    writeln!(code, "/// A language of the laboratory.\n#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]")?;
    writeln!(code, "pub enum Language {{\n#[default]")?;
    for language in languages {
        writeln!(code, "/// {}.\n{},", language.name, variant(language))?;
    }
    writeln!(code, "}}\nimpl Language {{\n/// All, in the order of their choice.")?;
    writeln!(code, "pub const ALL: [Self; {}] = [", languages.len())?;
    for language in languages {
        writeln!(code, "Self::{},", variant(language))?;
    }
    writeln!(code, "];")?;
    write_method(code, "The tag for the `lang` attribute.", "tag(self) -> &'static str", languages, |row| {
        format!("{:?}", row.tag)
    })?;
    write_method(code, "What it calls itself.", "name(self) -> &'static str", languages, |row| {
        format!("{:?}", row.name)
    })?;
    write_method(code, "Sign between whole part and fraction.", "decimal(self) -> char", languages, |row| {
        format!("{:?}", row.decimal)
    })?;
    writeln!(code, "}}")
}

/// A method that gives a value for each language.
fn write_method(
    code: &mut String,
    doc: &str,
    signature: &str,
    languages: &[&Language],
    value: fn(&Language) -> String,
) -> Result {
    writeln!(code, "/// {doc}\npub fn {signature} {{\nmatch self {{")?;
    for language in languages {
        writeln!(code, "Self::{} => {},", variant(language), value(language))?;
    }
    writeln!(code, "}}\n}}")
}

/// The name of a language as a variant: `PtBr` for `pt-BR`.
fn variant(language: &Language) -> String {
    let capitalised = |part: &str| part[..1].to_uppercase() + &part[1..].to_lowercase();
    language.tag.split('-').map(capitalised).collect()
}

/// The function of a key, and the struct of its values if it has any.
fn write_function(code: &mut String, key: &str, texts: &[(&Language, &Text)]) -> Result {
    let Some((_, first)) = texts.first() else { return Ok(()) };
    let values = first.values();
    if values.is_empty() {
        writeln!(code, "pub fn {key}(language: Language) -> String {{")?;
        write_choice(code, texts)?;
        return writeln!(code, ".to_owned()\n}}");
    }
    let is_count = |value: &str| first.is_plural && value == COUNT;
    let displayed = values.iter().filter(|value| !is_count(value));
    let types = displayed.clone().map(|value| value.to_uppercase()).collect::<Vec<_>>().join(", ");
    let any = displayed.map(|_| "impl std::fmt::Display").collect::<Vec<_>>().join(", ");
    writeln!(code, "pub struct {key}<{types}> {{")?;
    for value in &values {
        let of = if is_count(value) { "usize" } else { &value.to_uppercase() };
        writeln!(code, "pub {value}: {of},")?;
    }
    let names = values.into_iter().collect::<Vec<_>>().join(", ");
    writeln!(code, "}}\npub fn {key}(language: Language, {key} {{ {names} }}: {key}<{any}>) -> String {{")?;
    write_choice(code, texts)?;
    writeln!(code, "}}")
}

/// The text of the language, by the count if it is plural.
fn write_choice(code: &mut String, texts: &[(&Language, &Text)]) -> Result {
    writeln!(code, "match language {{")?;
    for (language, text) in texts {
        let form = |category| text.forms.get(category).map(expression).unwrap_or_default();
        writeln!(code, "Language::{} =>", variant(language))?;
        if text.is_plural {
            writeln!(code, "match count {{")?;
            for &(category, pattern) in language.plural {
                writeln!(code, "{pattern} => {},", form(category))?;
            }
            writeln!(code, "_ => {},\n}},", form(OTHER))?;
        } else {
            writeln!(code, "{},", form(OTHER))?;
        }
    }
    writeln!(code, "}}")
}

/// A literal if there are no values, otherwise a string that they are written into.
fn expression(form: &Form) -> String {
    if form.values.is_empty() {
        return format!("{:?}", form.text);
    }
    let escaped = |text: &str| text.replace('{', "{{").replace('}', "}}");
    let template = form.text.split("{{").map(|part| match part.split_once("}}") {
        Some((name, rest)) => format!("{{{}}}{}", name.trim(), escaped(rest)),
        None => escaped(part),
    });
    format!("format!({:?})", template.collect::<String>())
}
