//! The controls of the bench as data: what they read and write of the session.

use leptos::prelude::*;

/// A text that is the same in all languages.
pub fn symbol(text: &'static str) -> Signal<String> {
    Signal::stored(text.to_owned())
}
