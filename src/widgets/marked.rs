//! Texts with markup from the locale files as views.

use leptos::prelude::*;

/// A text in which the parts between `**` are bold: the only markup that the texts know.
pub fn marked(text: &str) -> Vec<AnyView> {
    parts(text).map(|(part, bold)| if bold { view! { <b>{part}</b> }.into_any() } else { part.into_any() }).collect()
}

/// The same without its markup, for a label.
pub fn unmarked(text: &str) -> String {
    text.replace("**", "")
}

/// The parts of a text, and whether each is bold.
fn parts(text: &str) -> impl Iterator<Item = (String, bool)> {
    text.split("**").enumerate().map(|(k, part)| (part.to_owned(), k % 2 == 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_parts_between_stars_are_bold() {
        let found: Vec<(String, bool)> = parts("a **b** < c").collect();
        assert_eq!(found, [("a ".to_owned(), false), ("b".to_owned(), true), (" < c".to_owned(), false)]);
        assert_eq!(unmarked("a **b** < c"), "a b < c");
    }
}
