//! Turns the texts in `assets/locales` into Rust, so that a text or a value that is missing stops the compiler.

mod code;
mod languages;
mod locales;

use std::error::Error;
use std::path::Path;
use std::{env, fs};

use languages::LANGUAGES;
use locales::Locale;

const FOLDER: &str = "assets/locales";

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=build");
    println!("cargo::rerun-if-changed={FOLDER}");
    match locales() {
        Ok(locales) => {
            let mut code = String::new();
            code::write(&mut code, &locales)?;
            let folder = env::var_os("OUT_DIR").ok_or("cargo sets OUT_DIR")?;
            fs::write(Path::new(&folder).join("texts.rs"), code)?;
        }
        // Cargo fails at these, and shows each as an error of its own.
        Err(problems) => problems.iter().for_each(|problem| println!("cargo::error={FOLDER}/{problem}")),
    }
    Ok(())
}

/// All languages, or all that is wrong with their files.
fn locales() -> Result<Vec<Locale>, Vec<String>> {
    let mut problems = files_without_row();
    let mut locales = Vec::new();
    for language in LANGUAGES {
        let file = locales::file(language);
        let json = fs::read_to_string(format!("{FOLDER}/{file}")).map_err(|error| format!("{file}: {error}"));
        match json.and_then(|json| Locale::read(language, &json)) {
            Ok(locale) => locales.push(locale),
            Err(problem) => problems.push(problem),
        }
    }
    problems.extend(locales::problems(&locales));
    if problems.is_empty() { Ok(locales) } else { Err(problems) }
}

fn files_without_row() -> Vec<String> {
    let files = fs::read_dir(FOLDER).into_iter().flatten().flatten();
    let names = files.map(|file| file.file_name().to_string_lossy().into_owned());
    let unknown = names.filter(|name| !LANGUAGES.iter().any(|language| locales::file(language) == *name));
    unknown.map(|name| format!("{name} has no row in LANGUAGES of build/languages.rs")).collect()
}
