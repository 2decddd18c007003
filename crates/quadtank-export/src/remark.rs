//! What a script says about its experiment in comments. Name and note of a document come from outside: whatever they contain,
//! they stay within their comments.

use quadtank::study::quadruple_tank::PlantSpec;
use quadtank_scenario::Scenario;

use crate::Language;

/// Longest line of a comment (characters), apart from its mark.
const WIDTH: usize = 110;

/// What the experiment is called, its rig, and what is not in the script.
pub fn head(scenario: &Scenario, language: Language) -> String {
    let mut text = lines_about(scenario);
    let noise = scenario.setup.experiment.measurement.noise_std;
    if noise > 0.0 {
        text.push(format!(
            "Noise with a standard deviation {noise:?} m is left out: its generator is not that of this language, so the figures \
             are those of the same experiment without noise."
        ));
    }
    let flow_noise = scenario.setup.experiment.pump_flow_noise_std;
    if flow_noise > 0.0 {
        text.push(format!("So is the noise of the flow of the pumps with a standard deviation {flow_noise:?} m^3/s."));
    }
    comment(&text.join("\n"), language.comment_mark())
}

/// What the experiment is called, and its rig, behind this mark of a comment.
pub fn about(scenario: &Scenario, mark: &str) -> String {
    comment(&lines_about(scenario).join("\n"), mark)
}

fn lines_about(scenario: &Scenario) -> Vec<String> {
    let label = &scenario.label;
    let mut text = Vec::new();
    if !label.name.trim().is_empty() {
        text.push(format!("Experiment: {}", label.name));
    }
    if !label.note.trim().is_empty() {
        text.push(format!("Note: {}", label.note));
    }
    text.push(match scenario.setup.plant {
        PlantSpec::Preset(id) => format!("Rig: {}, valves and controller as set in the experiment.", id.name()),
        PlantSpec::Parameters { .. } => "Rig: one's own.".to_owned(),
    });
    text
}

/// A text from anywhere as lines of comment.
///
/// Every line begins with the mark and a space, which no language takes for the beginning of a block or of a pragma. What some
/// language or editor takes for the end of a line ends one here too; what else is not printable is written as an escape.
fn comment(text: &str, mark: &str) -> String {
    let lines = text.split(is_line_break).map(printable).flat_map(|line| wrapped(&line));
    lines.map(|line| format!("{mark} {line}").trim_end().to_owned() + "\n").collect()
}

/// What Unicode, and so Python's `str.splitlines`, calls the end of a line.
fn is_line_break(character: char) -> bool {
    matches!(character, '\n'..='\r' | '\u{1c}'..='\u{1e}' | '\u{85}' | '\u{2028}' | '\u{2029}')
}

/// Control characters, marks of direction and characters without width as escapes.
fn printable(line: &str) -> String {
    let mut text = String::new();
    for character in line.chars() {
        match character {
            '"' | '\'' | '\\' => text.push(character),
            _ => text.extend(character.escape_debug()),
        }
    }
    text
}

/// A line in pieces of at most [`WIDTH`] characters, cut between words where there are any.
fn wrapped(line: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in line.split_whitespace() {
        let characters: Vec<char> = word.chars().collect();
        for piece in characters.chunks(WIDTH) {
            let last = lines.last_mut().expect("it never becomes empty");
            if last.is_empty() {
                last.extend(piece);
            } else if last.chars().count() + 1 + piece.len() <= WIDTH {
                last.push(' ');
                last.extend(piece);
            } else {
                lines.push(piece.iter().collect());
            }
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export;

    /// Texts that would end a comment, a string or a script, or change how one is read.
    const HOSTILE: [&str; 12] = [
        "first\nimport os",
        "one\r\ntwo\rthree\u{b}four\u{c}five\u{85}six\u{2028}seven\u{2029}eight",
        "\"\"\" ''' \" ' `",
        "*/ /* %} %{ =# #= #{ #}",
        "ends with a backslash \\",
        "\\n \\u000a \\x0a",
        "... line continuation ...",
        "{{ data }}",
        "-*- coding: utf-7 -*-",
        "$(touch x) ${HOME} `touch x`",
        "\0 \u{1b}[31m \u{202e}reversed \u{200b}",
        "%{\n#{\n#=",
    ];

    #[test]
    fn no_label_leaves_its_comment() {
        for language in Language::ALL {
            let plain = export(&Scenario::default(), language).unwrap();
            for text in HOSTILE {
                let mut scenario = Scenario::default();
                (scenario.label.name, scenario.label.note) = (text.to_owned(), text.repeat(3));
                let script = export(&scenario, language).unwrap();
                let added = added_lines(&plain, &script);
                assert!(!added.is_empty());
                for line in added {
                    let is_comment = line
                        .strip_prefix(language.indent())
                        .and_then(|line| line.strip_prefix(language.comment_mark()))
                        .is_some_and(|rest| rest.is_empty() || rest.starts_with(' '));
                    assert!(is_comment, "{}: {line:?}", language.name());
                    assert!(!line.chars().any(|c| c.is_control() || is_line_break(c) || c == '\u{202e}'), "{line:?}");
                }
            }
        }
    }

    /// The lines of a script that another one with the same rest does not have.
    fn added_lines<'a>(plain: &str, script: &'a str) -> Vec<&'a str> {
        let place = plain.lines().zip(script.lines()).take_while(|(one, other)| one == other).count();
        let more = script.split('\n').count() - plain.split('\n').count();
        let lines: Vec<&str> = script.split('\n').collect();
        let rest: Vec<&str> = plain.split('\n').skip(place).collect();
        assert_eq!(lines[place + more..], rest);
        lines[place..place + more].to_vec()
    }

    #[test]
    fn a_label_is_never_where_python_looks_for_an_encoding() {
        let mut scenario = Scenario::default();
        scenario.label.name = "coding: utf-7".to_owned();
        let script = export(&scenario, Language::Python).unwrap();
        assert!(script.lines().position(|line| line.contains("utf-7")).is_some_and(|line| line > 5));
    }

    #[test]
    fn long_texts_are_wrapped() {
        let lines = wrapped(&format!("{} {}", "word ".repeat(60), "x".repeat(300)));
        assert!(lines.len() > 5 && lines.iter().all(|line| line.chars().count() <= WIDTH), "{lines:?}");
        assert_eq!(wrapped(""), [""]);
    }
}
