use serde_json::Value;

use super::BenchDocument;
use super::params::{Param, field_of};

/// A number or a choice of a setup, as a list of them shows it.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Where it is within the setup, such as `controller.loops[0].gain`: the name by which files and the command line know it.
    pub path: String,
    /// What it is.
    pub value: EntryValue,
    /// Unit of a number, in SI; empty where it has none.
    pub unit: &'static str,
}

/// What an entry holds.
#[derive(Clone, Debug, PartialEq)]
pub enum EntryValue {
    /// A number.
    Number(f64),
    /// A choice by its name, or yes or no as `true` or `false`.
    Choice(String),
}

/// Longest list that is shown entry by entry: of the moves of a record, paper has how many they are.
const LONGEST_LIST: usize = 100;

/// All numbers and choices of the setup that a document works on, in the order of the file. Of a list of more than a hundred entries
/// there is their number.
pub fn entries<D: BenchDocument>(document: &D) -> Vec<Entry> {
    let mut found = Vec::new();
    if let Ok(value) = serde_json::to_value(document) {
        collect(D::ROOT, &value[D::ROOT], "", &mut found);
    }
    found
}

fn collect(root: &str, value: &Value, path: &str, found: &mut Vec<Entry>) {
    let mut push = |value: EntryValue, unit| found.push(Entry { path: path.to_owned(), value, unit });
    match value {
        Value::Object(fields) => {
            fields.iter().for_each(|(name, value)| collect(root, value, &field_of(path, name), found));
        }
        Value::Array(items) if items.len() > LONGEST_LIST => push(EntryValue::Number(items.len() as f64), "entries"),
        Value::Array(items) => {
            items.iter().enumerate().for_each(|(k, value)| collect(root, value, &format!("{path}[{k}]"), found));
        }
        Value::Number(number) => {
            let unit = Param::at(&field_of(root, path)).map_or("", |param| param.unit);
            push(EntryValue::Number(number.as_f64().unwrap_or(f64::NAN)), unit);
        }
        Value::String(text) => push(EntryValue::Choice(text.clone()), ""),
        Value::Bool(flag) => push(EntryValue::Choice(flag.to_string()), ""),
        Value::Null => {}
    }
}

#[cfg(test)]
mod tests {
    use quadtank::sim::PumpVoltageStep;

    use super::*;
    use crate::Scenario;
    use crate::level_loop::LevelLoopScenario;

    #[test]
    fn numbers_have_their_units_and_choices_their_names() {
        let all = entries(&Scenario::default());
        let entry =
            |path: &str| all.iter().find(|entry| entry.path == path).unwrap_or_else(|| panic!("{path}: {all:?}"));
        let gain = entry("controller.loops[0].gain");
        assert_eq!((&gain.value, gain.unit), (&EntryValue::Number(3.0), "V/V"));
        assert_eq!(entry("experiment.duration_s").unit, "s");
        assert_eq!(entry("controller.pairing").value, EntryValue::Choice("diagonal".to_owned()));
        let of_loop = entries(&LevelLoopScenario::default());
        let step = of_loop.iter().find(|entry| entry.path == "test.step").unwrap();
        assert_eq!(step.unit, "unit of the signal");
        let mut of_record = Scenario::default();
        let moved = PumpVoltageStep { pump: 0, time_s: 1.0, voltage: 3.0 };
        of_record.setup.experiment.pump_voltage_steps = vec![moved; 5000];
        let all_of_record = entries(&of_record);
        let moves = all_of_record.iter().find(|entry| entry.path == "experiment.pump_voltage_steps").unwrap();
        assert_eq!((&moves.value, moves.unit), (&EntryValue::Number(5000.0), "entries"));
        assert!(all_of_record.len() <= all.len() + 1);
        assert!(all.iter().all(|entry| !entry.path.contains("pinned") && !entry.path.starts_with("setup")));
    }
}
