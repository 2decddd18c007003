//! One table of fields per type, from which reading, writing, checking and the schema all follow.
//!
//! A type of a document is a [`Part`]: its one function names each field once, with its limits, in the order of the text. A
//! [`Visitor`] goes through these tables: the [`Reader`](reader::Reader) fills the fields from a [`Tree`], the
//! [`Writer`](writer::Writer) makes JSON of them, the [`Checker`](checker::Checker) holds them against their limits, and on
//! the host `Schema` describes them. What serde derives is compiled anew for each type and each direction; a table is
//! compiled once, and what it calls is there once.
//!
//! The first thing that is wrong ends the way: from then on nothing is entered any more, so tables need no `?`.

mod checker;
mod control;
mod experiment;
mod plant;
mod quadruple;
mod reader;
#[cfg(not(target_arch = "wasm32"))]
mod schema;
mod visitor;
mod writer;

use std::mem::{discriminant, take};

pub use experiment::check_duration;
pub use reader::malformed;

use super::limits::Limits;
use super::{ScenarioError, Tree};
use visitor::{Path, Presence, Step, Visitor};

/// The name of what is not in a field of its own: the content of a choice, or an entry of a list.
pub const ITSELF: &str = "";

/// A value of a document that consists of others.
pub trait Part {
    /// Names every field once. `self` is filled, or left as it is, field by field.
    fn fields(&mut self, f: &mut Fields<'_>);
}

/// The table of a choice between names.
macro_rules! names {
    ($type:ty: $($name:literal $value:ident),+ $(,)?) => {
        impl Part for $type {
            fn fields(&mut self, f: &mut Fields<'_>) {
                f.name(self, &[$(($name, Self::$value)),+]);
            }
        }
    };
}
pub(super) use names;

/// What a table of fields is told to.
pub struct Fields<'a> {
    visitor: &'a mut dyn Visitor,
    path: Path,
    /// Of the next field.
    presence: Presence,
    error: Option<ScenarioError>,
}

impl Fields<'_> {
    /// A number.
    pub fn number(&mut self, name: &'static str, value: &mut f64, limits: Limits) {
        if self.begin(name) {
            let result = self.visitor.number(&self.path, value, limits);
            self.end(name, result);
        }
    }

    /// Two numbers.
    pub fn pair(&mut self, name: &'static str, values: &mut [f64; 2], limits: Limits) {
        if self.begin(name) {
            self.length(2, 2, 2);
            for (index, value) in values.iter_mut().enumerate() {
                if self.enter(Step::Item(index)) {
                    self.number(ITSELF, value, limits);
                    self.leave();
                }
            }
            self.end(name, Ok(()));
        }
    }

    /// A whole number that is not negative.
    pub fn whole(&mut self, name: &'static str, value: &mut u32, limits: Limits) {
        if self.begin(name) {
            let result = self.visitor.whole(&self.path, value, limits);
            self.end(name, result);
        }
    }

    /// The version of the document.
    pub fn version(&mut self, value: &mut u32, version: u32) {
        self.whole("version", value, Limits::new(version.into(), version.into()));
    }

    /// A small whole number, such as an index, from `least` to `most`.
    pub fn index(&mut self, name: &'static str, value: &mut usize, least: u32, most: u32) {
        // What is too large for a document is too large for any limit.
        let mut whole = u32::try_from(*value).unwrap_or(u32::MAX);
        self.whole(name, &mut whole, Limits::new(least.into(), most.into()));
        *value = whole as usize;
    }

    /// True or false.
    pub fn flag(&mut self, name: &'static str, value: &mut bool) {
        if self.begin(name) {
            let result = self.visitor.flag(&self.path, value);
            self.end(name, result);
        }
    }

    /// A value with fields of its own.
    pub fn part(&mut self, name: &'static str, part: &mut dyn Part) {
        if self.begin(name) {
            part.fields(self);
            self.end(name, Ok(()));
        }
    }

    /// A list with at most so many entries, each of which begins as `blank`.
    pub fn list<T>(
        &mut self,
        name: &'static str,
        items: &mut Vec<T>,
        most: usize,
        blank: fn() -> T,
        content: fn(&mut T, &mut Fields<'_>),
    ) {
        if self.begin(name) {
            let count = self.length(items.len(), 0, most);
            if self.visitor.makes() {
                *items = (0..count).map(|_| blank()).collect();
            }
            for (index, item) in items.iter_mut().enumerate() {
                if self.enter(Step::Item(index)) {
                    content(item, self);
                    self.leave();
                }
            }
            self.end(name, Ok(()));
        }
    }

    /// A value that may be `null` or absent, for `None`, and else begins as `blank`.
    pub fn option<T>(
        &mut self,
        name: &'static str,
        value: &mut Option<T>,
        blank: fn() -> T,
        content: fn(&mut T, &mut Fields<'_>),
    ) {
        if self.spare().begin(name) {
            let is_some = self.is_some(value.is_some());
            if self.visitor.makes() {
                *value = is_some.then(blank);
            }
            if let Some(value) = value {
                content(value, self);
            }
            self.end(name, Ok(()));
        }
    }

    /// One of several choices: their names, with values to begin from, and the content that the one has which is made. A
    /// choice without content is written as its name alone.
    pub fn choice<T: Clone>(
        &mut self,
        value: &mut T,
        table: &[(&'static str, T)],
        content: fn(&mut T, &mut Fields<'_>),
    ) {
        let made = discriminant(value);
        for (name, blank) in table {
            if self.enter(Step::Choice(name, discriminant(blank) == made)) {
                if self.visitor.makes() {
                    value.clone_from(blank);
                }
                content(value, self);
                self.leave();
            }
        }
    }

    /// One of several names.
    pub fn name<T: Clone>(&mut self, value: &mut T, table: &[(&'static str, T)]) {
        self.choice(value, table, |_, _| {});
    }

    /// The next field may be absent; then its value stays as it is.
    pub fn spare(&mut self) -> &mut Self {
        if self.presence == Presence::Required {
            self.presence = Presence::Spare;
        }
        self
    }

    /// The next field may be absent, and is not written if `hidden`.
    pub fn hidden_if(&mut self, hidden: bool) -> &mut Self {
        self.presence = if hidden { Presence::Hidden } else { Presence::Spare };
        self
    }

    /// Whether the values are those of a whole document and have kept their limits so far: only then is it worth working on a
    /// check of one's own.
    pub fn is_checking(&self) -> bool {
        self.visitor.checks() && self.error.is_none()
    }

    /// Checks what depends on other fields: the value at the path `name` from here has to lie within `limits`.
    pub fn check(&mut self, name: &str, value: f64, limits: Limits) {
        if self.is_checking() && !limits.contains(value) {
            self.error = Some(checker::out_of_range(self.path.to(name), value, limits));
        }
    }

    /// Checks what depends on other fields: the reason why the value at the path `name` from here is refused, if it is.
    pub fn refuse(&mut self, name: &str, reason: impl FnOnce(String) -> ScenarioError) {
        if self.is_checking() {
            self.error = Some(reason(self.path.to(name)));
        }
    }

    fn begin(&mut self, name: &'static str) -> bool {
        let presence = take(&mut self.presence);
        if name.is_empty() { self.error.is_none() } else { self.enter(Step::Field(name, presence)) }
    }

    fn end(&mut self, name: &'static str, result: Result<(), ScenarioError>) {
        self.note(result);
        if !name.is_empty() {
            self.leave();
        }
    }

    #[inline(never)]
    fn enter(&mut self, step: Step) -> bool {
        if self.error.is_some() {
            return false;
        }
        match self.visitor.enter(&self.path, step) {
            Ok(enters) => {
                if enters {
                    self.path.0.push(step);
                }
                enters
            }
            Err(error) => {
                self.error = Some(error);
                false
            }
        }
    }

    #[inline(never)]
    fn leave(&mut self) {
        if self.error.is_none() {
            let result = self.visitor.leave(&self.path);
            self.note(result);
            self.path.0.pop();
        }
    }

    fn note(&mut self, result: Result<(), ScenarioError>) {
        if let Err(error) = result {
            self.error.get_or_insert(error);
        }
    }

    /// No entry is entered after a list that is too long or too short.
    fn length(&mut self, count: usize, least: usize, most: usize) -> usize {
        let result = self.visitor.length(&self.path, count, least, most);
        result.unwrap_or_else(|error| {
            self.error.get_or_insert(error);
            0
        })
    }

    fn is_some(&mut self, is_some: bool) -> bool {
        let result = self.visitor.option(&self.path, is_some);
        result.unwrap_or_else(|error| {
            self.error.get_or_insert(error);
            false
        })
    }
}

impl<T: Part, const N: usize> Part for [T; N] {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.length(N, N, N);
        for (index, item) in self.iter_mut().enumerate() {
            if f.enter(Step::Item(index)) {
                item.fields(f);
                f.leave();
            }
        }
    }
}

/// Sends a visitor through a document.
fn visit(part: &mut dyn Part, visitor: &mut dyn Visitor) -> Result<(), ScenarioError> {
    let mut fields = Fields { visitor, path: Path::default(), presence: Presence::default(), error: None };
    part.fields(&mut fields);
    fields.leave();
    fields.error.map_or(Ok(()), Err)
}

/// Reads a part from a tree, shape first, then every number. Fields that may be absent keep the values that they have.
///
/// # Errors
/// [`ScenarioError::Malformed`], which names the field, or what [`check`] finds.
pub fn read(part: &mut dyn Part, tree: &Tree) -> Result<(), ScenarioError> {
    visit(part, &mut reader::Reader::new(tree))?;
    check(part)
}

/// Checks every number and the lengths of all lists. Nothing is changed.
///
/// # Errors
/// [`ScenarioError::OutOfRange`], [`ScenarioError::TooMany`] or [`ScenarioError::Law`] for the first field that is not
/// allowed.
pub fn check(part: &mut dyn Part) -> Result<(), ScenarioError> {
    visit(part, &mut checker::Checker)
}

/// Writes a part as JSON, indented; all digits of all numbers are kept. Nothing is changed.
///
/// # Errors
/// What [`check`] finds: a document that could not be read again is not written.
pub fn write(part: &mut dyn Part) -> Result<String, ScenarioError> {
    check(part)?;
    let mut writer = writer::Writer::default();
    visit(part, &mut writer)?;
    Ok(writer.text)
}

/// The JSON Schema of the documents of a type, of which one is given.
#[cfg(not(target_arch = "wasm32"))]
pub fn schema(part: &mut dyn Part, title: &str) -> serde_json::Value {
    let mut schema = schema::Schema::default();
    // It refuses nothing.
    let _ = visit(part, &mut schema);
    schema.titled(title)
}
