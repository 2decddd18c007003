//! What the command line says on standard error.

use std::fmt::Display;
use std::io::{self, Write as _};

/// Longest message (characters).
const LONGEST: usize = 300;

/// What stands in the place of what is left out.
const GAP: &str = " … ";

/// Writes one line to standard error: `quadtank: ` and the message, see [`one_line`].
pub fn tell(message: impl Display) {
    // Nobody is left to be told when standard error is closed too.
    let _ = writeln!(io::stderr(), "{}", one_line(&format!("quadtank: {message}")));
}

/// Writes one line to standard error that is an item of a list: without `quadtank: `, so that it begins with a file.
pub fn list(item: impl Display) {
    let _ = writeln!(io::stderr(), "{}", one_line(&item.to_string()));
}

/// A text as one line of at most 300 characters without control characters, so that nothing of a document or of a file name
/// acts on the terminal: what is not printable (line breaks, escape sequences, marks of direction, characters without width)
/// is written as an escape such as `\u{1b}`. Of a longer text the middle is left out: it begins with the field and ends with
/// the reason.
pub fn one_line(text: &str) -> String {
    let mut line = Vec::new();
    for character in text.chars() {
        match character {
            '"' | '\'' | '\\' => line.push(character),
            _ => line.extend(character.escape_debug()),
        }
    }
    if line.len() <= LONGEST {
        return line.into_iter().collect();
    }
    let kept = LONGEST - GAP.chars().count();
    let (head, tail) = (&line[..kept.div_ceil(2)], &line[line.len() - kept / 2..]);
    head.iter().copied().chain(GAP.chars()).chain(tail.iter().copied()).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Acts on a terminal, or hides or reorders what stands there.
    fn is_harmful(character: char) -> bool {
        character.is_control()
            || matches!(character, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}')
            || matches!(character, '\u{61c}' | '\u{ad}' | '\u{feff}' | '\u{e0000}'..='\u{e0fff}')
    }

    proptest! {
        #[test]
        fn any_text_becomes_one_short_harmless_line(text in prop::collection::vec(any::<char>(), 0..1000)) {
            let line = one_line(&text.into_iter().collect::<String>());
            prop_assert!(line.chars().count() <= LONGEST);
            prop_assert!(!line.chars().any(is_harmful), "{:?}", line);
        }

        #[test]
        fn a_plain_text_stays_as_it_is(text in "[ -~äçγ→“]{0,300}") {
            prop_assert_eq!(one_line(&text), text);
        }
    }

    #[test]
    fn escapes_are_written_out() {
        assert_eq!(one_line("a\u{1b}[31m\n\u{202e}b"), r"a\u{1b}[31m\n\u{202e}b");
    }

    #[test]
    fn a_long_text_keeps_its_ends() {
        let line = one_line(&format!("setup.{}: unknown field", "x".repeat(10_000)));
        assert!(line.starts_with("setup.xxx") && line.ends_with("xxx: unknown field"), "{line}");
        assert_eq!(line.chars().count(), LONGEST);
    }
}
