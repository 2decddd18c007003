//! The numbers of documents: what each is, in which unit, and between which limits.
//!
//! There is one [row](PARAMS) for each number, whatever the version of the document. Reading and writing check every number of a
//! document against its row, the JSON Schema describes it by its row, and so can a number field, a slider or `--set`.

mod rows;

use std::collections::HashMap;
use std::fmt::{self, Write as _};

use serde::Serialize;
use serde_json::Value;

pub use rows::{LISTS, PARAMS};

use super::ScenarioError;
use super::codec::KINDS;
use super::error::{malformed, out_of_range};
use super::limits::Limits;

/// How the values of a number are spread, as on a slider.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Evenly.
    Linear,
    /// By their magnitude, whatever their sign; 0 may be allowed beside.
    Logarithmic,
}

/// A number of a document.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Param {
    /// Where it stands in a setup, with `[]` for any index, such as `plant.parameters.rig.tanks[].height`; with `level_loop.` before
    /// it where it stands there in a level loop alone and something else in other documents.
    pub path: &'static str,
    /// Its unit; empty for a number without one.
    pub unit: &'static str,
    /// The values that are allowed whatever the other numbers are.
    pub limits: Limits,
    /// How its values are spread.
    pub scale: Scale,
    /// What it is, in plain words, without unit and limits.
    pub description: &'static str,
}

impl Param {
    /// The number at a path of a document of any version, such as `pinned[0].plant.parameters.rig.tanks[2].height`.
    pub fn at(path: &str) -> Option<&'static Self> {
        row_at(path, PARAMS, |param| param.path)
    }
}

/// A list of a document whose length is limited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct List {
    /// As of a [`Param`].
    pub path: &'static str,
    /// Most entries.
    pub max: usize,
}

impl List {
    /// The list at a path of a document of any version.
    pub fn at(path: &str) -> Option<&'static Self> {
        row_at(path, LISTS, |list| list.path)
    }
}

/// The row of the value at a path of a document. In a level loop its own rows come before those that it shares with other documents.
fn row_at<T>(path: &str, rows: &'static [T], path_of: fn(&T) -> &'static str) -> Option<&'static T> {
    let place = any_index(path);
    let find = |place: &str| rows.iter().find(|row| path_of(row) == place);
    let own = ["level_loop.", "pinned_loops[]."].iter().find_map(|root| place.strip_prefix(root));
    own.and_then(|inside| find(&format!("level_loop.{inside}"))).or_else(|| find(&place_in_setup(&place)))
}

/// A path with `[]` for any index.
fn any_index(path: &str) -> String {
    let mut pieces = path.split('[');
    let first = pieces.next().unwrap_or_default().to_owned();
    pieces.fold(first, |place, piece| place + "[" + piece.trim_start_matches(|c: char| c.is_ascii_digit()))
}

/// Where a path of a document, without indices, leads within a setup. The setup that is worked on and the pinned ones are alike, and
/// so are the PI loops that a model-free run is compared with and those of a setup of the tank.
fn place_in_setup(place: &str) -> String {
    let mut roots = KINDS.iter().map(|kind| kind.root).chain(["pinned[]", "pinned_loops[]"]);
    let inside = roots.find_map(|root| place.strip_prefix(root)?.strip_prefix('.'));
    match inside.map(|inside| (inside, inside.strip_prefix("compare."))) {
        Some((_, Some(compared))) => format!("controller.{compared}"),
        Some((inside, None)) => inside.to_owned(),
        None => place.to_owned(),
    }
}

/// The only number that a document may have as `null`.
const MAY_BE_NULL: &str = "view.cursor_s";

/// Checks every number of a document against its row, and the lengths of its lists.
///
/// # Errors
/// [`ScenarioError::OutOfRange`] or [`ScenarioError::TooMany`] for the first one that is not allowed.
pub(super) fn check(document: &impl Serialize) -> Result<(), ScenarioError> {
    let document = serde_json::to_value(document).map_err(|error| malformed(String::new(), error.to_string()))?;
    Walk::default().check(&document)
}

/// A way through a document. The row of a number is found once for all entries of a list: a record as an experiment has 80,000
/// numbers, which took 160 ms when each was looked up by itself.
#[derive(Default)]
struct Walk {
    /// Path of the present field.
    path: String,
    /// The path with `[]` for every index, which names the row of the parameter.
    place: String,
    rows: HashMap<String, Option<&'static Param>>,
}

impl Walk {
    fn check(&mut self, value: &Value) -> Result<(), ScenarioError> {
        match value {
            Value::Object(fields) => fields.iter().try_for_each(|(name, value)| {
                let dot = if self.path.is_empty() { "" } else { "." };
                self.check_part(value, format_args!("{dot}{name}"), format_args!("{dot}{name}"))
            }),
            Value::Array(items) => {
                check_length(items.len(), &self.path)?;
                items
                    .iter()
                    .enumerate()
                    .try_for_each(|(index, item)| self.check_part(item, format_args!("[{index}]"), format_args!("[]")))
            }
            Value::Number(number) => self.check_number(number.as_f64().unwrap_or(f64::NAN)),
            // What is not finite is null in JSON.
            Value::Null if self.path != MAY_BE_NULL => self.check_number(f64::NAN),
            _ => Ok(()),
        }
    }

    fn check_part(&mut self, part: &Value, step: fmt::Arguments, any: fmt::Arguments) -> Result<(), ScenarioError> {
        let ends = [self.path.len(), self.place.len()];
        // Writing to a String cannot fail.
        let _ = (self.path.write_fmt(step), self.place.write_fmt(any));
        self.check(part)?;
        self.path.truncate(ends[0]);
        self.place.truncate(ends[1]);
        Ok(())
    }

    fn check_number(&mut self, value: f64) -> Result<(), ScenarioError> {
        let row = match self.rows.get(&self.place) {
            Some(row) => *row,
            None => *self.rows.entry(self.place.clone()).or_insert(Param::at(&self.path)),
        };
        row.map_or(Ok(()), |param| param.limits.check(&self.path, value))
    }
}

fn check_length(count: usize, path: &str) -> Result<(), ScenarioError> {
    match List::at(path) {
        Some(&List { max, .. }) if count > max => Err(ScenarioError::TooMany { field: path.to_owned(), count, max }),
        _ => Ok(()),
    }
}

/// The path of a field of the value at a path.
pub(super) fn field_of(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") }
}

impl Limits {
    /// Whether the number at a path is allowed.
    ///
    /// # Errors
    /// [`ScenarioError::OutOfRange`] if it is not.
    pub(super) fn check(self, path: &str, value: f64) -> Result<(), ScenarioError> {
        if self.contains(value) { Ok(()) } else { Err(out_of_range(path, value, self)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_leads_to_the_same_row_from_every_document() {
        for path in [
            "setup.plant.parameters.rig.tanks[2].height",
            "pinned[1].plant.parameters.rig.tanks[0].height",
            "model_free.plant.parameters.rig.tanks[3].height",
        ] {
            assert_eq!(Param::at(path).map(|param| param.path), Some("plant.parameters.rig.tanks[].height"), "{path}");
        }
        let compared = Param::at("model_free.compare.loops[1].gain");
        assert_eq!(
            (compared, compared),
            (Param::at("setup.controller.loops[0].gain"), Param::at("controller.loops[].gain"))
        );
        let row = |path: &str| Param::at(path).map(|param| param.path);
        let own = Some("level_loop.experiment.duration_s");
        assert_eq!((row("level_loop.experiment.duration_s"), row("pinned_loops[3].experiment.duration_s")), (own, own));
        assert_eq!(row("setup.experiment.duration_s"), Some("experiment.duration_s"));
        assert_eq!(row("level_loop.experiment.set_point_steps[1].time_s"), Some("experiment.set_point_steps[].time_s"));
        assert_eq!(Param::at("setup.plant.preset"), None);
        assert_eq!(Param::at(""), None);
    }

    #[test]
    fn every_row_has_its_own_place_and_can_be_shown() {
        for (index, param) in PARAMS.iter().enumerate() {
            let Param { path, limits, scale, description, .. } = param;
            assert!(PARAMS[..index].iter().all(|other| other.path != *path), "{path}");
            assert!(!description.is_empty() && !description.ends_with('.'), "{path}");
            assert!(limits.min < limits.max && limits.min.is_finite() && limits.max.is_finite(), "{path}");
            let has_magnitude = limits.min >= 0.0 || limits.min == -limits.max;
            assert!(*scale == Scale::Linear || has_magnitude, "{path}: no logarithm");
        }
    }
}
