//! Where in a JSON text something stands: an error that names the field is worth more than one that names a column.

use super::error::quoted;

/// A place inside a container that the scan has entered.
enum Step {
    /// A key of an object; empty until its first key has been read.
    Key(String),
    /// An index of an array.
    Index(usize),
}

impl Step {
    fn lacks_key(&self) -> bool {
        matches!(self, Self::Key(key) if key.is_empty())
    }
}

/// A scan of a JSON text byte by byte. Never fails: where the text is no JSON, it follows as far as that makes sense.
#[derive(Default)]
struct Scan {
    steps: Vec<Step>,
    /// What has been read of a string that is not closed.
    string: Option<Vec<u8>>,
    escaped: bool,
}

impl Scan {
    fn take(&mut self, byte: u8) {
        if let Some(content) = &mut self.string {
            match byte {
                _ if self.escaped => {
                    content.push(byte);
                    self.escaped = false;
                }
                b'\\' => self.escaped = true,
                b'"' => {
                    let content = self.string.take().unwrap_or_default();
                    // The first string after `{` or `,` is the key; the next one is a value.
                    if let Some(Step::Key(key)) = self.steps.last_mut().filter(|step| step.lacks_key()) {
                        *key = String::from_utf8_lossy(&content).into_owned();
                    }
                }
                _ => content.push(byte),
            }
            return;
        }
        match (byte, self.steps.last_mut()) {
            (b'"', _) => self.string = Some(Vec::new()),
            (b'{', _) => self.steps.push(Step::Key(String::new())),
            (b'[', _) => self.steps.push(Step::Index(0)),
            (b'}' | b']', _) => drop(self.steps.pop()),
            (b',', Some(Step::Key(key))) => key.clear(),
            (b',', Some(Step::Index(index))) => *index += 1,
            _ => {}
        }
    }

    /// Whether a comma that comes next, before the bytes `after` it, separates digits where JSON has no such comma: in an object,
    /// and in a list before a zero that another digit follows. In a list, `[1,5, 2]` may as well be three numbers.
    fn at_decimal_comma(&self, before: Option<u8>, after: &[u8]) -> bool {
        let in_list = matches!(self.steps.last(), Some(Step::Index(_)));
        let follows = match after {
            [b'0', next, ..] if in_list => next.is_ascii_digit(),
            [next, ..] if !in_list => next.is_ascii_digit(),
            _ => false,
        };
        self.string.is_none() && before.is_some_and(|byte| byte.is_ascii_digit()) && follows
    }

    /// The path of the value that is being read.
    fn path(&self) -> String {
        let mut path = String::new();
        for step in &self.steps {
            match step {
                Step::Key(key) if key.is_empty() => {}
                Step::Key(key) if path.is_empty() => path.push_str(&quoted(key)),
                Step::Key(key) => path.extend([".", &quoted(key)]),
                Step::Index(index) => path.extend(["[", &index.to_string(), "]"]),
            }
        }
        path
    }
}

/// The byte at which a line and a column begin, both from 1 as parsers count them.
pub fn byte_at(text: &str, line: usize, column: usize) -> usize {
    let before: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    before.saturating_add(column).min(text.len())
}

/// The path of the value that ends at or contains the byte before `end` of a JSON text, such as
/// `setup.controller.loops[0].gain`. Empty for the whole document. Never fails: where the text is no JSON, the path leads as far
/// as it made sense.
pub fn path_before(text: &str, end: usize) -> String {
    let mut scan = Scan::default();
    text.as_bytes()[..end].iter().for_each(|&byte| scan.take(byte));
    scan.path()
}

/// Where a text that is JSON up to byte `end` has its first decimal comma up to there, and the path of that number.
///
/// In an object a comma between digits is one, and in a list one before a zero that another digit follows; `[1,5, 2]` may as well
/// be three numbers.
pub fn decimal_comma(text: &str, end: usize) -> Option<(usize, String)> {
    let (bytes, mut scan) = (text.as_bytes(), Scan::default());
    for (at, &byte) in bytes.iter().enumerate().take(end) {
        let before = at.checked_sub(1).map(|before| bytes[before]);
        if byte == b',' && scan.at_decimal_comma(before, &bytes[at + 1..]) {
            return Some((at, scan.path()));
        }
        scan.take(byte);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::{byte_at, decimal_comma, path_before};

    fn at(text: &str, marker: char) -> String {
        let place = text.find(marker).unwrap_or(text.len());
        let line = text[..place].matches('\n').count() + 1;
        let column = place - text[..place].rfind('\n').map_or(0, |n| n + 1);
        path_before(text, byte_at(text, line, column))
    }

    #[test]
    fn keys_and_indices_lead_to_the_value() {
        let text = "{\"a\": 1, \"setup\": {\"loops\": [{\"gain\": 2},\n {\"gain\": #}]}}";
        assert_eq!(at(text, '#'), "setup.loops[1].gain");
    }

    #[test]
    fn a_key_without_a_value_yet_counts() {
        assert_eq!(at("{\"a\": 1, \"b\"#", '#'), "b");
        assert_eq!(at("{\"a\": \"text\"#", '#'), "a");
    }

    #[test]
    fn what_is_closed_is_left() {
        assert_eq!(at("{\"a\": {\"b\": [1, 2]}#}", '#'), "a");
        assert_eq!(at("[[1], [2, #", '#'), "[1][1]");
    }

    #[test]
    fn brackets_and_quotes_inside_strings_do_not_count() {
        assert_eq!(at("{\"x{[\\\"\": {\"y\": #", '#'), "x{[\".y");
    }

    #[test]
    fn no_json_and_no_place_are_harmless() {
        assert_eq!(path_before("]]}{{:,", byte_at("]]}{{:,", 1, 99)), "");
        assert_eq!(path_before("", byte_at("", 7, 7)), "");
        assert_eq!(path_before("é\"é", byte_at("é\"é", 1, 2)), "");
    }

    #[test]
    fn a_decimal_comma_is_one_between_digits_where_no_number_follows() {
        let comma = |text: &str| decimal_comma(text, text.len());
        assert_eq!(comma(r#"{"a": {"x": 3,0}}"#), Some((13, "a.x".to_owned())));
        assert_eq!(comma(r#"{"x": -0,25e1, "y": 1}"#), Some((8, "x".to_owned())));
        assert_eq!(comma(r#"{"x": [1, 0,05]}"#), Some((11, "x[1]".to_owned())));
        assert_eq!(comma("1,5"), Some((1, String::new())));
        for clean in
            [r#"{"x": [1,5, 2], "y": 1,"z": 2}"#, r#"{"x": "1,5", "1,5": 1}"#, r#"{"x": [1,0,5]}"#, r#"{"x": 1, 5}"#]
        {
            assert_eq!(comma(clean), None, "{clean}");
        }
        assert_eq!(decimal_comma(r#"{"x": 3,0}"#, 7), None);
    }
}
