//! Where in a JSON text something stands: an error that names the field is worth more than one that names a column.

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

/// The path of the value that ends at or contains a place in a JSON text (line and column from 1, as parsers count them),
/// such as `setup.controller.loops[0].gain`. Empty for the whole document. Never fails: where the text is no JSON, the path
/// leads as far as it made sense.
pub fn path_at(text: &str, line: usize, column: usize) -> String {
    let before: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    let end = before.saturating_add(column).min(text.len());
    let mut steps: Vec<Step> = Vec::new();
    let mut string: Option<Vec<u8>> = None;
    let mut escaped = false;
    for &byte in &text.as_bytes()[..end] {
        if let Some(content) = &mut string {
            match byte {
                _ if escaped => {
                    content.push(byte);
                    escaped = false;
                }
                b'\\' => escaped = true,
                b'"' => {
                    let content = string.take().unwrap_or_default();
                    // The first string after `{` or `,` is the key; the next one is a value.
                    if let Some(Step::Key(key)) = steps.last_mut().filter(|step| step.lacks_key()) {
                        *key = String::from_utf8_lossy(&content).into_owned();
                    }
                }
                _ => content.push(byte),
            }
            continue;
        }
        match (byte, steps.last_mut()) {
            (b'"', _) => string = Some(Vec::new()),
            (b'{', _) => steps.push(Step::Key(String::new())),
            (b'[', _) => steps.push(Step::Index(0)),
            (b'}' | b']', _) => drop(steps.pop()),
            (b',', Some(Step::Key(key))) => key.clear(),
            (b',', Some(Step::Index(index))) => *index += 1,
            _ => {}
        }
    }
    let mut path = String::new();
    for step in &steps {
        match step {
            Step::Key(key) if key.is_empty() => {}
            Step::Key(key) if path.is_empty() => path.push_str(key),
            Step::Key(key) => path.extend([".", key]),
            Step::Index(index) => path.extend(["[", &index.to_string(), "]"]),
        }
    }
    path
}

#[cfg(test)]
mod tests {
    use super::path_at;

    fn at(text: &str, marker: char) -> String {
        let place = text.find(marker).unwrap_or(text.len());
        let line = text[..place].matches('\n').count() + 1;
        let column = place - text[..place].rfind('\n').map_or(0, |n| n + 1);
        path_at(text, line, column)
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
        assert_eq!(path_at("]]}{{:,", 1, 99), "");
        assert_eq!(path_at("", 7, 7), "");
        assert_eq!(path_at("é\"é", 1, 2), "");
    }
}
