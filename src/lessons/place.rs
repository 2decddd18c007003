//! Pages beside the benches: the list of lessons, the glossary, the page for teachers, the scenes of a lecture. Each has an address of its own.

use leptos::prelude::*;

/// A page beside the benches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SidePage {
    /// All lessons.
    Lessons,
    /// The words of the field.
    Glossary,
    /// For who teaches.
    Teachers,
    /// The scenes of a lecture.
    Scenes,
}

impl SidePage {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Lessons, Self::Glossary, Self::Teachers, Self::Scenes];

    /// Its name in an address.
    pub fn name(self) -> &'static str {
        match self {
            Self::Lessons => "lessons",
            Self::Glossary => "glossary",
            Self::Teachers => "teachers",
            Self::Scenes => "scenes",
        }
    }

    /// The page with a name.
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|page| page.name() == name)
    }

    /// Its address.
    pub fn address(self) -> String {
        format!("?page={}", self.name())
    }
}

/// The address of a lesson.
pub fn lesson_address(id: &str) -> String {
    format!("?lesson={id}")
}

/// The whole address of a reference to this page.
pub fn absolute(reference: &str) -> String {
    let here = window().location().href().unwrap_or_default();
    let page = here.split(['?', '#']).next().unwrap_or_default();
    format!("{page}{reference}")
}
