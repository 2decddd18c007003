//! Turns the texts in `assets/locales` into Rust, so that a key or a value that is missing stops the compiler.
//!
//! Each key becomes a type: a unit struct whose `text` is a `&'static str`, or a struct with a field for each `{{ value }}`
//! of the text, whose `text` is a `String`. All languages must have the same keys and values. The core has no texts; without
//! the feature `app` there is nothing to do.

use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs};

/// The languages, in the order of `Language` in `src/app/texts.rs`.
const LANGUAGES: [&str; 2] = ["en", "pt-BR"];
const FOLDER: &str = "assets/locales";

/// Texts of a language: group → key → text.
type Texts = BTreeMap<String, BTreeMap<String, String>>;

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed={FOLDER}");
    if env::var_os("CARGO_FEATURE_APP").is_none() {
        return Ok(());
    }
    let [english, portuguese] = LANGUAGES.map(read);
    let (english, portuguese) = (english?, portuguese?);
    let mut code = String::new();
    for (group, keys) in &english {
        writeln!(code, "pub mod {group} {{")?;
        for (key, text) in keys {
            let other = portuguese.get(group).and_then(|keys| keys.get(key));
            let other = other.ok_or_else(|| format!("pt-BR.json lacks {group}.{key}"))?;
            if values(text) != values(other) {
                return Err(format!("{group}.{key} has other values in pt-BR.json than in en.json").into());
            }
            write_text(&mut code, key, [text, other])?;
        }
        writeln!(code, "}}")?;
    }
    for (group, keys) in &portuguese {
        if let Some(key) = keys.keys().find(|&key| !english.get(group).is_some_and(|keys| keys.contains_key(key))) {
            return Err(format!("en.json lacks {group}.{key}").into());
        }
    }
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

fn write_text(code: &mut String, key: &str, texts: [&str; 2]) -> std::fmt::Result {
    let names = values(texts[0]);
    let (mut fields, mut pairs) = (String::new(), String::new());
    for name in &names {
        write!(fields, "pub {name}: &'a dyn std::fmt::Display, ")?;
        write!(pairs, "({name:?}, self.{name}), ")?;
    }
    if names.is_empty() {
        writeln!(code, "pub struct {key};\nimpl {key} {{")?;
        writeln!(code, "pub const TEXTS: &'static [&'static str; 2] = &{texts:?};")?;
        writeln!(code, "pub fn text(self, in_language: crate::app::texts::Language) -> &'static str {{")?;
        writeln!(code, "Self::TEXTS[in_language as usize] }} }}")
    } else {
        writeln!(code, "pub struct {key}<'a> {{ {fields} }}\nimpl {key}<'_> {{")?;
        writeln!(code, "pub fn text(&self, in_language: crate::app::texts::Language) -> String {{")?;
        writeln!(code, "crate::app::texts::fill({texts:?}[in_language as usize], &[{pairs}]) }} }}")
    }
}
