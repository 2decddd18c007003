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

/// What a source names of a module of the core, such as `Complex` of `quadtank::linear`.
fn named<'a>(source: &'a str, module: &str) -> Vec<&'a str> {
    let root = format!("quadtank::{module}::");
    let lists = source.split(&root).skip(1).map(|rest| match rest.strip_prefix('{') {
        Some(list) => list.split('}').next().unwrap_or_default(),
        None => rest.split(|c: char| !(c.is_alphanumeric() || c == '_')).next().unwrap_or_default(),
    });
    lists.flat_map(|list| list.split(',')).map(str::trim).filter(|name| !name.is_empty()).collect()
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
}
