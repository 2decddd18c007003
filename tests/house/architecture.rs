//! What the page imports: results of studies, documents, figures, and types of the core, but none of its functions. The page computes
//! no control theory.

use std::fs;
use std::path::Path;

/// Modules of the core from which the page takes types alone.
const TYPES_ONLY: [&str; 6] = ["plant", "linear", "interaction", "control", "sim", "tuning"];

/// Path and text of every source file of the page.
fn sources(folder: &Path) -> Vec<(String, String)> {
    let entries =
        fs::read_dir(folder).expect("a source folder is readable").map(|entry| entry.expect("an entry").path());
    entries
        .flat_map(|path| {
            if path.is_dir() {
                return sources(&path);
            }
            vec![(path.display().to_string(), fs::read_to_string(&path).expect("a source file is readable"))]
        })
        .collect()
}

/// What a source names of a module of the core or of a module in it, such as `Complex` of `quadtank::linear` and `LevelController` of
/// `quadtank::sim::level`.
fn named<'a>(source: &'a str, module: &str) -> Vec<&'a str> {
    let root = format!("quadtank::{module}::");
    let lists = source.split(&root).skip(1).map(in_module).map(|rest| match rest.strip_prefix('{') {
        Some(list) => list.split('}').next().unwrap_or_default(),
        None => rest.split(|c: char| !(c.is_alphanumeric() || c == '_')).next().unwrap_or_default(),
    });
    lists.flat_map(|list| list.split(',')).map(str::trim).filter(|name| !name.is_empty()).collect()
}

/// The rest of a path behind the modules that it begins with.
fn in_module(path: &str) -> &str {
    let inner = path.split_once("::").filter(|(module, _)| module.chars().all(|c| c.is_ascii_lowercase() || c == '_'));
    inner.map_or(path, |(_, rest)| in_module(rest))
}

#[test]
fn the_page_takes_types_of_the_core_but_computes_nothing_with_it() {
    let mut seen = 0;
    for (path, source) in sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src")) {
        for module in TYPES_ONLY {
            for name in named(&source, module) {
                assert!(name.starts_with(char::is_uppercase), "{path} calls quadtank::{module}::{name}");
                seen += 1;
            }
        }
        assert!(!source.contains("nalgebra"), "{path} computes with matrices");
    }
    assert!(seen > 20, "the imports are where this test looks for them: {seen}");
}

#[test]
fn a_function_would_be_seen() {
    let source = "use quadtank::linear::{Complex, transmission_zeros};\nquadtank::sim::simulate(plant)";
    assert_eq!(named(source, "linear"), ["Complex", "transmission_zeros"]);
    assert_eq!(named(source, "sim"), ["simulate"]);
    let nested = "use quadtank::sim::level::{LevelLog, heated_run};\nquadtank::sim::level::heated_run(tank); a::b";
    assert_eq!(named(nested, "sim"), ["LevelLog", "heated_run", "heated_run"]);
}
