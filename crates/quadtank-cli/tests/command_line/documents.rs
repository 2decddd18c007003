//! How files are read, and what is said of those that cannot be.

use std::fs;

use proptest::prelude::*;
use quadtank::literature::PresetId;
use quadtank::study::quadruple_tank::setup_of;
use quadtank_scenario::{Document, Scenario, ScenarioError, document_from_bytes, from_json};

use super::{folder, pipe, preset, run, stderr, stdout};

/// A document with its marks in UTF-8 and in UTF-16 of both byte orders, as Windows writes it.
fn encodings(text: &str) -> [Vec<u8>; 3] {
    let text = format!("\u{feff}{}", text.replace('\n', "\r\n"));
    let utf_16 = |bytes: fn(u16) -> [u8; 2]| text.encode_utf16().flat_map(bytes).collect();
    [text.clone().into_bytes(), utf_16(u16::to_le_bytes), utf_16(u16::to_be_bytes)]
}

#[test]
fn a_byte_order_mark_changes_nothing() {
    let text = preset(PresetId::JohanssonMinimumPhase);
    let expected = stdout(&pipe(&["analyse", "-"], text.as_bytes()));
    let file = folder("encodings").join("rig.json");
    for bytes in encodings(&text) {
        assert_eq!(stdout(&pipe(&["analyse", "-"], &bytes)), expected);
        fs::write(&file, &bytes).unwrap();
        assert_eq!(stdout(&run(&["analyse", file.to_str().unwrap()])), expected);
        let read = document_from_bytes(&bytes);
        assert_eq!(read, Ok(Document::Quadruple(Scenario::from(setup_of(PresetId::JohanssonMinimumPhase)))));
    }
}

#[test]
fn a_decimal_comma_is_pointed_at() {
    let good = preset(PresetId::JohanssonMinimumPhase);
    let broken = |from: &str, to: &str| {
        assert!(good.contains(from), "{from}");
        from_json(&good.replacen(from, to, 1)).unwrap_err()
    };
    let said = broken("\"gain\": 3.0", "\"gain\": 3,0").to_string();
    let expected =
        "setup.controller.loops[0].gain: `3,0` has a decimal comma (line 21, column 20); a number has a decimal point";
    assert_eq!(said, expected);
    // The last field of an object, exponents, signs, zeros in a list, and a thousands separator before it.
    for (from, to, number) in [
        ("\"tracking_ratio\": 0.5", "\"tracking_ratio\": 0,5", "0,5"),
        ("\"duration_s\": 3000.0", "\"duration_s\": 3,0e3", "3,0e3"),
        ("\"duration_s\": 3000.0", "\"duration_s\": 3.000,0", "3.000,0"),
        ("\"noise_std\": 0.0", "\"noise_std\": -0,001", "-0,001"),
        ("0.6\n", "0,06\n", "0,06"),
    ] {
        let error = broken(from, to);
        assert!(
            matches!(&error, ScenarioError::DecimalComma { number: found, .. } if found == number),
            "{to}: {error}"
        );
    }
    // More numbers than a pair has, as 0,7 and 0,6 make.
    let said = broken("0.7,", "0,7,").to_string();
    assert_eq!(said, "setup.valves: invalid length 3, expected 2 elements; a number has a decimal point");
    // An error before the decimal comma has priority, and a comma inside a name is text.
    assert!(matches!(broken("\"gain\": 3.0", "\"gain\" 1, \"x\": 3,0"), ScenarioError::Malformed { .. }));
    assert!(matches!(broken("\"gain\": 3.0", "\"gain\": 3.0, \"1,5\": 1"), ScenarioError::Malformed { .. }));
}

#[test]
fn a_file_that_is_too_long_is_refused_by_its_size() {
    let file = folder("sizes").join("sparse.json");
    // A terabyte that takes no room on the disk: reading it would take minutes.
    fs::File::create(&file).unwrap().set_len(1 << 40).unwrap();
    let output = run(&["analyse", file.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).ends_with("the document is longer than 8388608 bytes\n"), "{}", stderr(&output));
    fs::remove_file(&file).unwrap();
    let directory = run(&["analyse", folder("sizes").to_str().unwrap()]);
    assert_eq!(directory.status.code(), Some(1));
}

/// One line of at most 300 characters, in which nothing acts on a terminal.
fn is_one_plain_line(said: &str) -> bool {
    let acts = |c: char| {
        c.is_control() || matches!(c, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    let line = said.strip_suffix('\n');
    line.is_some_and(|line| line.starts_with("quadtank: ") && line.chars().count() <= 300 && !line.contains(acts))
}

#[test]
fn nothing_of_a_document_or_a_name_acts_on_the_terminal() {
    let nasty = "\u{1b}[2J\u{7}\n\r\u{202e}\u{2028}\u{85}";
    let long = "x".repeat(10_000);
    for text in [nasty, &long] {
        let quoted = serde_json::to_string(text).unwrap();
        let good = preset(PresetId::JohanssonMinimumPhase);
        for (broken, reason) in [
            (good.replacen("\"gain\"", &quoted, 1), "unknown field"),
            (good.replacen("3.0,", &format!("{quoted},"), 1), "invalid type: string"),
            (good.replacen("\"diagonal\"", &quoted, 1), "unknown variant"),
            (good.replacen("3.0,", &format!("{{{quoted}: ]"), 1), "expected value"),
        ] {
            let output = pipe(&["analyse", "-"], broken.as_bytes());
            let said = stderr(&output);
            assert_eq!(output.status.code(), Some(2), "{said}");
            assert!(is_one_plain_line(&said) && said.contains(reason), "{said}");
        }
        for arguments in
            [&["analyse", text][..], &[text], &["analyse", "x", text], &["presets", text], &["cases", text]]
        {
            let output = run(arguments);
            assert!(!output.status.success());
            assert!(is_one_plain_line(&stderr(&output)), "{}", stderr(&output));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_bytes_are_answered_with_one_plain_line(bytes in prop::collection::vec(any::<u8>(), 0..400), quoted in any::<String>()) {
        let name = serde_json::to_string(&quoted).unwrap();
        for document in [bytes, format!("{{\"version\": 1, {name}: {name}}}").into_bytes()] {
            let output = pipe(&["analyse", "-"], &document);
            let said = String::from_utf8(output.stderr.clone()).unwrap();
            prop_assert_eq!(output.status.code(), Some(2));
            prop_assert!(is_one_plain_line(&said), "{:?}", said);
        }
    }
}
