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

/// The scenes of a lecture, as their link.
pub const SCENES: Preference = Preference("quadtank-scenes");

/// Whether the progress in lessons may be kept: `yes` or `no`.
pub const LESSONS_KEPT: Preference = Preference("quadtank-lessons-kept");

impl Preference {
    /// What was remembered, if anything.
    pub fn read(self) -> Option<String> {
        window().local_storage().ok()??.get_item(self.0).ok()?
    }

    /// Remembers; silently does nothing where the browser does not allow it.
    pub fn write(self, value: &str) {
        if let Ok(Some(storage)) = window().local_storage() {
            let _ = storage.set_item(self.0, value);
        }
    }
}
