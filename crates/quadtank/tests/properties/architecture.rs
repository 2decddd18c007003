//! The floors of the crate: a module imports only from modules below its own, so no circle can arise. Unit tests may use what is
//! above, such as the published rigs.

use std::fs;
use std::path::Path;

/// Modules from the ground up. Those of one floor do not know each other.
const FLOORS: [&[&str]; 7] = [
    &["numeric"],
    &["plant", "linear"],
    &["interaction", "control"],
    &["sim"],
    &["tuning", "assess"],
    &["literature"],
    &["study"],
];

fn floor_of(module: &str) -> usize {
    FLOORS.iter().position(|floor| floor.contains(&module)).unwrap_or_else(|| panic!("`{module}` stands on no floor"))
}

/// Text of every source file at or below a path, without its unit tests, which are at the end or in a file of their own.
fn sources(path: &Path) -> Vec<String> {
    if path.file_name().is_some_and(|name| name == "tests.rs") {
        return Vec::new();
    }
    if path.is_file() {
        let text = fs::read_to_string(path).expect("a source file is readable");
        let end = ["#[cfg(test)]", "#[cfg(all(test"].iter().filter_map(|mark| text.find(mark)).min();
        return vec![text[..end.unwrap_or(text.len())].to_owned()];
    }
    let entries = fs::read_dir(path).expect("a source folder is readable");
    entries.flat_map(|entry| sources(&entry.expect("an entry is readable").path())).collect()
}

/// Modules that a source names as `crate::module`.
fn imports(source: &str) -> impl Iterator<Item = &str> {
    source.split("crate::").skip(1).filter_map(|rest| rest.split(|c: char| !(c.is_alphanumeric() || c == '_')).next())
}

#[test]
fn modules_import_only_from_the_floors_below() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for entry in fs::read_dir(&root).expect("the source folder is readable") {
        let path = entry.expect("an entry is readable").path();
        let module = path.file_stem().and_then(|name| name.to_str()).expect("module names are plain text").to_owned();
        if module == "lib" {
            continue;
        }
        for source in sources(&path) {
            assert!(!source.contains("crate::{"), "`{module}` groups imports of several modules");
            for imported in imports(&source).filter(|&name| name != module && !name.is_empty()) {
                let (above, below) = (floor_of(&module), floor_of(imported));
                assert!(below < above, "`{module}` (floor {above}) imports `{imported}` (floor {below})");
            }
        }
    }
}
