//! Reads the texts of the languages, and checks that all languages have the same.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

use super::languages::Language;

/// The plural category that every language has.
pub const OTHER: &str = "other";
/// The value that chooses the plural form.
pub const COUNT: &str = "count";

/// The texts of a language by group and key.
pub struct Locale {
    pub language: &'static Language,
    pub texts: BTreeMap<(String, String), Text>,
}

/// The forms of a text by plural category; the only one of a text without plural stands under `other`.
pub struct Text {
    pub is_plural: bool,
    pub forms: BTreeMap<String, Form>,
}

/// A string of a file, and the names of the values that it has to be given.
pub struct Form {
    pub text: String,
    pub values: BTreeSet<String>,
}

impl Locale {
    /// Reads a file.
    ///
    /// # Errors
    ///
    /// What cannot be read, with the file and the key.
    pub fn read(language: &'static Language, json: &str) -> Result<Self, String> {
        let file = file(language);
        let groups: BTreeMap<String, BTreeMap<String, Value>> =
            serde_json::from_str(json).map_err(|error| format!("{file}: {error}"))?;
        let mut texts = BTreeMap::new();
        for (group, keys) in groups {
            for (key, value) in keys {
                if !(is_name(&group) && is_name(&key)) {
                    return Err(format!("{file}: {group}.{key} is no name: a-z, 0-9 and _"));
                }
                let text = Text::read(&value).map_err(|problem| format!("{file}: {group}.{key} {problem}"))?;
                texts.insert((group.clone(), key), text);
            }
        }
        Ok(Self { language, texts })
    }
}

impl Text {
    fn read(value: &Value) -> Result<Self, String> {
        let form = |value: &Value| Form::read(value.as_str().ok_or("is neither a text nor an object of plural forms")?);
        let Value::Object(categories) = value else {
            return Ok(Self { is_plural: false, forms: BTreeMap::from([(OTHER.to_owned(), form(value)?)]) });
        };
        let mut forms = BTreeMap::new();
        for (category, value) in categories {
            let mut form = form(value)?;
            // "One step" may leave the count out.
            form.values.insert(COUNT.to_owned());
            forms.insert(category.clone(), form);
        }
        Ok(Self { is_plural: true, forms })
    }

    /// The values of the text, which are those of any form.
    pub fn values(&self) -> BTreeSet<String> {
        self.forms.values().next().map(|form| form.values.clone()).unwrap_or_default()
    }
}

impl Form {
    fn read(text: &str) -> Result<Self, String> {
        let mut values = BTreeSet::new();
        for part in text.split("{{").skip(1) {
            let (name, _) = part.split_once("}}").ok_or("has {{ without }}")?;
            if !is_name(name.trim()) {
                return Err(format!("has {{{{{name}}}}}, which is no name: a-z, 0-9 and _"));
            }
            values.insert(name.trim().to_owned());
        }
        Ok(Self { text: text.to_owned(), values })
    }
}

/// Whether Rust can call something by this name.
fn is_name(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_lowercase())
        && name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
}

/// The name of the file of a language.
pub fn file(language: &Language) -> String {
    format!("{}.json", language.tag)
}

/// What keeps the languages from having the same texts; nothing if all is well.
pub fn problems(locales: &[Locale]) -> Vec<String> {
    let keys: BTreeSet<_> = locales.iter().flat_map(|locale| locale.texts.keys()).collect();
    let mut problems = Vec::new();
    for key in keys {
        let name = format!("{}.{}", key.0, key.1);
        let known = locales.iter().filter_map(|locale| Some((locale.language, locale.texts.get(key)?)));
        let Some(first) = known.clone().next() else { continue };
        let lacking = locales.iter().filter(|locale| !locale.texts.contains_key(key));
        problems.extend(lacking.map(|locale| format!("{} lacks {name}", file(locale.language))));
        for (language, text) in known {
            let found = wrong_categories(language, text).into_iter().chain(difference(text, first));
            problems.extend(found.map(|problem| format!("{}: {name} {problem}", file(language))));
        }
    }
    problems
}

/// The plural forms that the language needs and the text lacks, or the other way round.
fn wrong_categories(language: &Language, text: &Text) -> Vec<String> {
    if !text.is_plural {
        return Vec::new();
    }
    let needed: BTreeSet<&str> = language.plural.iter().map(|&(category, _)| category).chain([OTHER]).collect();
    let given: BTreeSet<&str> = text.forms.keys().map(String::as_str).collect();
    let missing = needed.difference(&given).map(|category| format!("lacks the plural form {category:?}"));
    let unknown =
        given.difference(&needed).map(|category| format!("has a plural form {category:?}, unlike its language"));
    missing.chain(unknown).collect()
}

/// How a text disagrees with the same text of the first language: one of them alone has plural forms, or their values differ.
fn difference(text: &Text, (language, first): (&Language, &Text)) -> Option<String> {
    let other = file(language);
    if text.is_plural != first.is_plural {
        return Some(format!("has {}plural forms, unlike in {other}", if text.is_plural { "" } else { "no " }));
    }
    let expected = first.values();
    let form = text.forms.values().find(|form| form.values != expected)?;
    Some(format!("has the values {:?}, but {expected:?} in {other}: {}", form.values, form.text))
}
