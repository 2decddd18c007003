use crate::ScenarioError;
use crate::limits::Limits;

/// One way through a document. Every method is told where in the document it is.
pub trait Visitor {
    /// Whether the values are made by the visitor: then lists begin empty, and choices and options blank.
    fn makes(&self) -> bool {
        false
    }

    /// Whether the values are those of a whole document, and are to be checked.
    fn checks(&self) -> bool {
        false
    }

    /// Goes on to a value inside the present one; `false` passes it by.
    fn enter(&mut self, at: &Path, step: Step) -> Result<bool, ScenarioError>;

    /// Comes back from the present value.
    fn leave(&mut self, at: &Path) -> Result<(), ScenarioError>;

    /// The present value is a number.
    fn number(&mut self, at: &Path, value: &mut f64, limits: Limits) -> Result<(), ScenarioError>;

    /// The present value is a whole number.
    fn whole(&mut self, at: &Path, value: &mut u32, limits: Limits) -> Result<(), ScenarioError>;

    /// The present value is true or false.
    fn flag(&mut self, at: &Path, value: &mut bool) -> Result<(), ScenarioError>;

    /// The present value is a list of `least` to `most` entries and has `count`; how many it should have.
    fn length(&mut self, at: &Path, count: usize, least: usize, most: usize) -> Result<usize, ScenarioError>;

    /// The present value may be `null`; whether there is more to it.
    fn option(&mut self, at: &Path, is_some: bool) -> Result<bool, ScenarioError>;
}

/// How a field may be missing.
#[derive(Clone, Copy, Default, PartialEq)]
pub enum Presence {
    /// It may not.
    #[default]
    Required,
    /// It may; then the value stays as it is.
    Spare,
    /// It may, and is not written.
    Hidden,
}

/// The way from a value to one inside it.
#[derive(Clone, Copy)]
pub enum Step {
    /// A field of a map.
    Field(&'static str, Presence),
    /// The content of a choice, and whether it is the one that is made.
    Choice(&'static str, bool),
    /// An entry of a list.
    Item(usize),
}

/// The way from the root to a value.
#[derive(Default)]
pub struct Path(pub Vec<Step>);

impl Path {
    /// The path to what is called `name` there, such as `setup.controller.loops[0].gain`.
    #[inline(never)]
    pub fn to(&self, name: &str) -> String {
        let mut text = String::new();
        let mut add = |name: &str| {
            if !text.is_empty() && name.starts_with(|c: char| c.is_ascii_lowercase()) {
                text.push('.');
            }
            text.push_str(name);
        };
        for step in &self.0 {
            match step {
                Step::Field(name, _) | Step::Choice(name, _) => add(name),
                Step::Item(index) => add(&format!("[{index}]")),
            }
        }
        add(name);
        text
    }
}
