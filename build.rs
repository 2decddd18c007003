//! Turns the texts in `assets/locales` into Rust, so that a key or a value that is missing stops the compiler.
//!
//! Each key becomes a type: a unit struct whose `text` is a `&'static str`, or a struct with a field for each `{{ value }}`
//! of the text, whose `text` is a `String`. All texts of a language are one string, which is split at the first use. All languages
//! must have the same keys and values.

use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs};

/// The languages, in the order of `Language` in `src/texts.rs`.
const LANGUAGES: [&str; 2] = ["en", "pt-BR"];
const FOLDER: &str = "assets/locales";

/// Texts of a language: group → key → text.
type Texts = BTreeMap<String, BTreeMap<String, String>>;

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed={FOLDER}");
    let [english, portuguese] = LANGUAGES.map(read);
    let (english, portuguese) = (english?, portuguese?);
    let mut code = String::new();
    let mut joined = [const { Vec::new() }; 2];
    for (group, keys) in &english {
        writeln!(code, "pub mod {group} {{")?;
        for (key, text) in keys {
            let other = portuguese.get(group).and_then(|keys| keys.get(key));
            let other = other.ok_or_else(|| format!("pt-BR.json lacks {group}.{key}"))?;
            let names = values(text);
            if names != values(other) {
                return Err(format!("{group}.{key} has other values in pt-BR.json than in en.json").into());
            }
            write_key(&mut code, key, joined[0].len(), &names)?;
            joined[0].push(with_places(text, &names));
            joined[1].push(with_places(other, &names));
        }
        writeln!(code, "}}")?;
    }
    for (group, keys) in &portuguese {
        if let Some(key) = keys.keys().find(|&key| !english.get(group).is_some_and(|keys| keys.contains_key(key))) {
            return Err(format!("en.json lacks {group}.{key}").into());
        }
    }
    writeln!(code, "pub const TEXTS: [&str; 2] = {:?};", joined.map(|texts| texts.join("\u{1f}")))?;
    let folder = env::var_os("OUT_DIR").ok_or("cargo sets OUT_DIR")?;
    fs::write(Path::new(&folder).join("texts.rs"), code)?;
    Ok(())
}

fn read(language: &str) -> Result<Texts, Box<dyn Error>> {
    let path = format!("{FOLDER}/{language}.json");
    let text = fs::read_to_string(&path).map_err(|error| format!("{path}: {error}"))?;
    Ok(serde_json::from_str(&text).map_err(|error| format!("{path}: {error}"))?)
}

/// Names of the `{{ value }}`s of a text.
fn values(text: &str) -> BTreeSet<&str> {
    text.split("{{").skip(1).filter_map(|rest| rest.split_once("}}")).map(|(name, _)| name.trim()).collect()
}

/// The text with the number of each value, counted from 1, as a character in its place.
fn with_places(text: &str, names: &BTreeSet<&str>) -> String {
    let mut parts = text.split("{{");
    let mut placed = parts.next().unwrap_or_default().to_owned();
    for (name, rest) in parts.filter_map(|part| part.split_once("}}")) {
        let place = names.iter().zip('\u{1}'..).find(|&(&known, _)| known == name.trim());
        placed.extend(place.map(|(_, character)| character));
        placed.push_str(rest);
    }
    placed
}

fn write_key(code: &mut String, key: &str, number: usize, names: &BTreeSet<&str>) -> std::fmt::Result {
    if names.is_empty() {
        writeln!(code, "pub struct {key};\nimpl {key} {{\npub const NUMBER: usize = {number};")?;
        writeln!(code, "pub fn text(self, in_language: crate::texts::Language) -> &'static str {{")?;
        return writeln!(code, "crate::texts::text({number}, in_language) }} }}");
    }
    let (mut fields, mut values) = (String::new(), String::new());
    for name in names {
        write!(fields, "pub {name}: &'a dyn std::fmt::Display, ")?;
        write!(values, "self.{name}, ")?;
    }
    writeln!(code, "pub struct {key}<'a> {{ {fields} }}\nimpl {key}<'_> {{")?;
    writeln!(code, "pub fn text(&self, in_language: crate::texts::Language) -> String {{")?;
    writeln!(code, "crate::texts::fill(crate::texts::text({number}, in_language), &[{values}]) }} }}")
}
