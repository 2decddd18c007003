//! What the build script says of files of texts with faults, and what it writes for sound ones.

#[path = "../../build/code.rs"]
mod code;
#[path = "../../build/languages.rs"]
mod languages;
#[path = "../../build/locales.rs"]
mod locales;

use languages::{LANGUAGES, Language};
use locales::Locale;

/// A language with a category that neither of the first two has.
static CZECH: Language =
    Language { tag: "cs", name: "Čeština", decimal: ',', plural: &[("one", "1"), ("few", "2..=4")] };

const STEPS: [&str; 2] = [
    r#"{ "test": { "steps": { "one": "one step", "other": "{{ count }} steps" } } }"#,
    r#"{ "test": { "steps": { "one": "{{ count }} degrau", "other": "{{ count }} degraus" } } }"#,
];

/// The problems of files in English, Portuguese and, where there is a third one, Czech.
fn problems(files: &[&str]) -> Vec<String> {
    let languages = LANGUAGES[..2].iter().chain([&CZECH]);
    let locales =
        languages.zip(files).map(|(language, json)| Locale::read(language, json)).collect::<Result<Vec<_>, _>>();
    locales.map_or_else(|problem| vec![problem], |locales| locales::problems(&locales))
}

#[test]
fn a_text_that_a_language_lacks_is_named() {
    assert_eq!(problems(&[r#"{ "a": { "b": "x" } }"#, r#"{ "a": { "b": "y" } }"#]), [""; 0]);
    assert_eq!(problems(&[r#"{ "a": { "b": "x" } }"#, r#"{ "a": {} }"#]), ["pt-BR.json lacks a.b"]);
    assert_eq!(problems(&["{}", r#"{ "a": { "b": "x" } }"#]), ["en.json lacks a.b"]);
}

#[test]
fn other_values_are_named_with_the_text() {
    assert_eq!(
        problems(&[r#"{ "a": { "b": "{{ min }} to {{ max }}" } }"#, r#"{ "a": { "b": "de {{min}}" } }"#]),
        [r#"pt-BR.json: a.b has the values {"min"}, but {"max", "min"} in en.json: de {{min}}"#]
    );
    let form = r#"{ "test": { "steps": { "one": "um", "other": "{{ count }} em {{ time }} s" } } }"#;
    assert_eq!(
        problems(&[STEPS[0], form]),
        [
            r#"pt-BR.json: test.steps has the values {"count", "time"}, but {"count"} in en.json: {{ count }} em {{ time }} s"#
        ]
    );
}

#[test]
fn each_language_has_the_plural_forms_of_its_rule() {
    assert_eq!(problems(&STEPS), [""; 0]);
    assert_eq!(
        problems(&[STEPS[0], r#"{ "test": { "steps": { "few": "?", "other": "{{ count }} degraus" } } }"#]),
        [
            r#"pt-BR.json: test.steps lacks the plural form "one""#,
            r#"pt-BR.json: test.steps has a plural form "few", unlike its language"#
        ]
    );
    assert_eq!(problems(&[STEPS[0], STEPS[1], STEPS[0]]), [r#"cs.json: test.steps lacks the plural form "few""#]);
    assert_eq!(
        problems(&[STEPS[0], r#"{ "test": { "steps": "{{ count }} degraus" } }"#]),
        ["pt-BR.json: test.steps has no plural forms, unlike in en.json"]
    );
}

#[test]
fn what_cannot_be_read_is_named() {
    let problem = |json| problems(&[json]).concat();
    assert_eq!(problem(r#"{ "a": { "b": "{{ c" } }"#), "en.json: a.b has {{ without }}");
    assert_eq!(
        problem(r#"{ "a": { "b": "{{ the c }}" } }"#),
        "en.json: a.b has {{ the c }}, which is no name: a-z, 0-9 and _"
    );
    assert_eq!(problem(r#"{ "a": { "b c": "" } }"#), "en.json: a.b c is no name: a-z, 0-9 and _");
    assert_eq!(problem(r#"{ "a": { "b": 1 } }"#), "en.json: a.b is neither a text nor an object of plural forms");
    assert!(problem("{").starts_with("en.json: EOF"));
}

#[test]
fn a_text_becomes_a_function_with_an_arm_for_each_language() {
    let files = [
        STEPS[0],
        STEPS[1],
        r#"{ "test": { "steps": { "one": "krok", "few": "{} kroky", "other": "{{count}} kroků" } } }"#,
    ];
    let locales =
        LANGUAGES[..2].iter().chain([&CZECH]).zip(files).map(|(language, json)| Locale::read(language, json).unwrap());
    let mut code = String::new();
    code::write(&mut code, &locales.collect::<Vec<_>>()).unwrap();
    let function = r#"pub fn steps(language: Language, steps { count }: steps<>) -> String {
match language {
Language::En =>
match count {
1 => format!("one step"),
_ => format!("{count} steps"),
},
Language::PtBr =>
match count {
0 | 1 => format!("{count} degrau"),
_ => format!("{count} degraus"),
},
Language::Cs =>
match count {
1 => format!("krok"),
2..=4 => format!("{{}} kroky"),
_ => format!("{count} kroků"),
},
}
}"#;
    assert!(code.contains(function), "{code}");
}
