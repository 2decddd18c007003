//! A small lesson with every kind of task, for tests.

use serde_json::Value;

use super::{LESSON_IDS, Lesson, TERMS, Task, Values, audit, read_lesson};

/// Its file.
pub const SMALL: &str = include_str!("../tests/data/small.json");

/// The lesson.
pub fn lesson() -> Lesson {
    read_lesson(SMALL.as_bytes()).unwrap()
}

/// The file with changes: JSON pointers with what comes there, in objects also under a new key.
pub fn changed(changes: &[(&str, Value)]) -> String {
    let mut lesson: Value = serde_json::from_str(SMALL).unwrap();
    for (pointer, value) in changes {
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        match lesson.pointer_mut(parent).unwrap() {
            Value::Object(fields) => drop(fields.insert(key.to_owned(), value.clone())),
            Value::Array(items) if key == "-" => items.push(value.clone()),
            Value::Array(items) => items[key.parse::<usize>().unwrap()] = value.clone(),
            other => panic!("{pointer}: {other} has no parts"),
        }
    }
    lesson.to_string()
}

/// A task of the lesson.
pub fn task(id: &str) -> Task {
    lesson().task(id).unwrap().1.clone()
}

/// Quantities with given values.
pub struct Given<'a>(pub &'a [(&'a str, f64, &'static str)]);

impl Values for Given<'_> {
    fn value(&self, name: &str) -> Option<(f64, &'static str)> {
        self.0.iter().find(|(known, ..)| *known == name).map(|&(_, value, unit)| (value, unit))
    }
}

/// What an audit says about the file with changes.
pub fn faults(changes: &[(&str, Value)]) -> Vec<String> {
    let lesson = read_lesson(changed(changes).as_bytes()).unwrap();
    audit(&lesson, &TERMS, &LESSON_IDS).iter().map(ToString::to_string).collect()
}
