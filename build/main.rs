//! Turns the texts in `assets/locales` and `assets/glossary` into Rust, so that a text or a value that is missing stops the compiler.

mod code;
mod languages;
mod locales;

use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;
use std::{env, fs};

use languages::LANGUAGES;
use locales::Locale;

/// Where the texts are: what the page says, and the words of the field. Each folder has a file for each language.
const FOLDERS: [&str; 2] = ["assets/locales", "assets/glossary"];

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=build");
    for folder in FOLDERS {
        println!("cargo::rerun-if-changed={folder}");
    }
    match locales() {
        Ok(locales) => {
            let mut code = String::new();
            code::write(&mut code, &locales)?;
            let folder = env::var_os("OUT_DIR").ok_or("cargo sets OUT_DIR")?;
            fs::write(Path::new(&folder).join("texts.rs"), code)?;
        }
        // Cargo fails at these, and shows each as an error of its own.
        Err(problems) => problems.iter().for_each(|problem| println!("cargo::error={problem}")),
    }
    Ok(())
}

/// All languages, or all that is wrong with their files.
fn locales() -> Result<Vec<Locale>, Vec<String>> {
    let mut problems: Vec<String> = FOLDERS.into_iter().flat_map(files_without_row).collect();
    let mut locales = Vec::new();
    for language in LANGUAGES {
        let mut locale = Locale { language, texts: BTreeMap::new() };
        for folder in FOLDERS {
            let file = locales::file(language);
            let json = fs::read_to_string(format!("{folder}/{file}")).map_err(|error| format!("{file}: {error}"));
            match json.and_then(|json| Locale::read(language, &json)) {
                Ok(read) => locale.texts.extend(read.texts),
                Err(problem) => problems.push(format!("{folder}/{problem}")),
            }
        }
        locales.push(locale);
    }
    // A file that cannot be read would lack all its texts.
    if problems.is_empty() {
        problems.extend(locales::problems(&locales));
    }
    if problems.is_empty() { Ok(locales) } else { Err(problems) }
}

fn files_without_row(folder: &str) -> Vec<String> {
    let files = fs::read_dir(folder).into_iter().flatten().flatten();
    let names = files.map(|file| file.file_name().to_string_lossy().into_owned());
    let unknown = names.filter(|name| !LANGUAGES.iter().any(|language| locales::file(language) == *name));
    unknown.map(|name| format!("{folder}/{name} has no row in LANGUAGES of build/languages.rs")).collect()
}
