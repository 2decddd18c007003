//! The quantities of benches by their names.

use std::fmt::Write as _;

use quadtank_scenario::answers::report_json;
use quadtank_scenario::{Document, Quantities, bench_of, quantities_of};
use serde_json::{Map, Value};

use super::answers::Fault;

/// Most names that are suggested for one that is unknown.
const SUGGESTED: usize = 4;
/// Least likeness of a suggestion, by Jaro and Winkler.
const ALIKE: f64 = 0.8;

/// Some quantities of a document, as JSON.
pub fn only(document: &Document, names: &[String]) -> Result<String, Fault> {
    let quantities = Quantities::of(document);
    let value = |name: &String| match quantities.value(name) {
        Ok(value) => Ok((name.clone(), Value::from(value))),
        Err(error) => {
            Err(Fault::UnknownQuantity { near: near(name, quantities.rows().iter().map(|row| row.name)), error })
        }
    };
    Ok(report_json(&names.iter().map(value).collect::<Result<Map<_, _>, _>>()?)?)
}

/// The names that are most like one, best first.
pub fn near<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let likeness = |known: &'a str| (strsim::jaro_winkler(name, known), known);
    let mut near: Vec<_> = known.into_iter().map(likeness).collect();
    near.retain(|(likeness, _)| *likeness >= ALIKE);
    near.sort_by(|one, other| other.0.total_cmp(&one.0));
    near.into_iter().take(SUGGESTED).map(|(_, known)| known).collect()
}

/// What a message about an unknown name says of those that are like it, if there are any.
pub fn suggestion(near: &[&str]) -> Option<String> {
    let names: Vec<String> = near.iter().map(|name| format!("`{name}`")).collect();
    (!names.is_empty()).then(|| format!("; near: {}", names.join(", ")))
}

/// The same of a quantity, or where to find its name.
pub fn suggested_quantities(near: &[&str]) -> String {
    suggestion(near).unwrap_or_else(|| "; `quadtank quantities` lists them".to_owned())
}

/// The tables of the benches with documents of a version, or of all of them.
pub fn list(version: Option<u32>) -> String {
    let versions = version.map_or(1..=u32::MAX, |version| version..=version);
    let tables = versions.map_while(|version| Some(table(version, bench_of(version)?)));
    format!("{HEAD}{}", tables.collect::<String>())
}

const HEAD: &str = "\
# Quantities

The numbers of each bench by their names, in SI. `1` is the unit of a ratio; of `yes/no` yes is 1 and no is 0. `quadtank analyse FILE
--only NAME` prints one, null where it does not exist. This page is what `quadtank quantities` prints.
";

fn table(version: u32, bench: &str) -> String {
    let head = format!("\n## {bench}, version {version}\n\n| name | unit | what it is |\n|---|---|---|\n");
    quantities_of(version).iter().fold(head, |mut table, row| {
        // Writing to a String cannot fail.
        let _ = writeln!(table, "| `{}` | {} | {} |", row.name, row.unit, row.description.replace('|', "\\|"));
        table
    })
}
