//! What the browser remembers: theme, language, depth, the last experiment, and scenes. Where there is no storage (a sandboxed frame),
//! nothing is.

use leptos::prelude::window;

/// A remembered choice, by its name in the storage of the browser.
#[derive(Clone, Copy)]
pub struct Preference(&'static str);

/// The theme that was chosen: `light` or `dark`.
pub const THEME: Preference = Preference("quadtank-theme");
/// The language that was chosen, by its tag.
pub const LANGUAGE: Preference = Preference("quadtank-language");
/// The depth that was chosen, by its name.
pub const DEPTH: Preference = Preference("quadtank-depth");
/// The style of CSV that was chosen, by its name in `tables.rs`; `usual` for that of the language.
pub const CSV: Preference = Preference("quadtank-csv");
/// The link of the last experiment.
pub const LAST: Preference = Preference("quadtank-last");

/// The scenes of a lecture, as their file; editions until 2026-11 wrote their link.
pub const SCENES: Preference = Preference("quadtank-scenes");

/// Whether the progress in lessons may be kept: `yes` or `no`.
pub const LESSONS_KEPT: Preference = Preference("quadtank-lessons-kept");

/// Whether the browser lets this page remember anything.
pub fn is_allowed() -> bool {
    matches!(window().local_storage(), Ok(Some(_)))
}

impl Preference {
    /// What was remembered, if anything.
    pub fn read(self) -> Option<String> {
        window().local_storage().ok()??.get_item(self.0).ok()?
    }

    /// Remembers, and says whether the browser allowed it and had room.
    pub fn write(self, value: &str) -> bool {
        let storage = window().local_storage().ok().flatten();
        storage.is_some_and(|storage| storage.set_item(self.0, value).is_ok())
    }
}
