//! Lessons: audits, marks, reports, packages.

use std::fs;
use std::io::{Cursor, Read};
use std::path::Path;

use quadtank_lesson::{LESSON_IDS, Progress, Report, read_lesson};
use serde_json::{Value, json};
use zip::ZipArchive;

use super::{assert_described, folder, pipe, run, stderr, stdout};

/// A lesson with every kind of task.
const SMALL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../quadtank-lesson/tests/data/small.json");

/// A copy of the small lesson with one text in place of another.
fn copy(test: &str, from: &str, to: &str) -> String {
    let small = fs::read_to_string(SMALL).unwrap();
    assert!(small.contains(from), "{from}");
    let file = folder(test).join("lesson.json");
    fs::write(&file, small.replacen(from, to, 1)).unwrap();
    file.to_str().unwrap().to_owned()
}

/// What is said about an answer to a task of a lesson.
fn mark(lesson: &str, options: &[&str], answer: &Value) -> Value {
    let arguments = [&["check", lesson], options].concat();
    serde_json::from_str(&stdout(&pipe(&arguments, answer.to_string().as_bytes()))).unwrap()
}

/// The one line with which a command is refused.
fn refusal(arguments: &[&str], input: &str) -> String {
    let output = pipe(arguments, input.as_bytes());
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(output.stdout.is_empty());
    let told = stderr(&output);
    assert_eq!(told.lines().count(), 1, "{told}");
    told.trim_end().to_owned()
}

#[test]
fn the_lessons_of_the_laboratory_have_no_fault() {
    let output = run(&["check", "--all"]);
    let lines = stdout(&output);
    assert_eq!(stderr(&output), "");
    let ids: Vec<_> = lines.lines().map(|line| line.split_once(": ").unwrap().0).collect();
    assert_eq!(ids, LESSON_IDS);
    assert!(lines.starts_with("two-valves-one-zero: 7 steps, 10 points, en, pt-BR, es\n"), "{lines}");
}

#[test]
fn a_lesson_of_a_file_is_audited() {
    let output = run(&["check", "--all", SMALL]);
    assert_eq!(stdout(&output), format!("{SMALL}: 2 steps, 10 points, en, es\n"));
    let output = pipe(&["check", "--all", "-"], &fs::read(SMALL).unwrap());
    assert_eq!(stdout(&output), "standard input: 2 steps, 10 points, en, es\n");
}

#[test]
fn a_fault_is_a_line_with_file_place_and_problem() {
    let file = copy("audit_fault", "(glossary:zero)", "(glossary:zeros)");
    let output = run(&["check", "--all", SMALL, &file]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(
        stderr(&output),
        format!("{file}: steps[0].text.en: unknown word of the glossary `zeros`; near: `zero`\n")
    );
    let out = String::from_utf8(output.stdout).unwrap();
    assert_eq!(out, format!("{SMALL}: 2 steps, 10 points, en, es\n"));
}

#[test]
fn names_that_are_alike_are_suggested() {
    for (from, to, told) in [
        ("\"zero.leftmost\"", "\"zero.leftmots\"", "unknown quantity `zero.leftmots`; near: `zero.leftmost`"),
        ("\"zero.leftmost\"", "\"q\"", "unknown quantity `q`; `quadtank quantities` lists them"),
        ("{formula:zero-line}", "{formula:zero-lines}", "unknown formula `zero-lines`; near: `zero-line`"),
        ("{formula:zero-line}", "{formula:q}", "unknown formula `q`; there are zero-line, zeros, "),
        ("\"two-valves-one-zero\"", "\"two-valves\"", "unknown lesson `two-valves`; near: `two-valves-one-zero`"),
        ("\"preset\"]", "\"presets\"]", "unknown group of controls `presets`; there are preset, valves, "),
    ] {
        let file = copy("audit_names", from, to);
        let output = run(&["check", "--all", &file]);
        assert!(stderr(&output).lines().next().unwrap().contains(told), "{}", stderr(&output));
    }
}

#[test]
fn a_file_that_cannot_be_read_as_a_lesson_is_a_fault_among_others() {
    let file = copy("audit_broken", "\"minutes\"", "\"minute\"");
    let output = run(&["check", "--all", &file, SMALL]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).starts_with(&format!("{file}: minute: ")), "{}", stderr(&output));
    assert_eq!(stderr(&output).lines().count(), 1);
    assert!(!output.stdout.is_empty());
}

#[test]
fn a_file_that_is_not_there_ends_with_1() {
    let output = run(&["check", "--all", "no-such-lesson.json"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(stderr(&output).starts_with("quadtank: no-such-lesson.json: "), "{}", stderr(&output));
}

#[test]
fn links_may_lead_to_lessons_that_are_audited_together() {
    let other = copy("audit_together", "\"small-lesson\"", "\"other-lesson\"");
    let file = folder("audit_together").join("first.json");
    let small = fs::read_to_string(SMALL).unwrap();
    fs::write(&file, small.replacen("two-valves-one-zero", "other-lesson", 1)).unwrap();
    let file = file.to_str().unwrap();
    assert_eq!(run(&["check", "--all", file]).status.code(), Some(2));
    assert_eq!(run(&["check", "--all", file, &other]).status.code(), Some(0));
}

#[test]
fn an_option_is_marked_with_its_feedback_in_a_language() {
    let wrong = mark(SMALL, &["--task", "why", "--lang", "es"], &json!({ "choice": 0 }));
    let expected = json!({
        "task": "why", "is_right": false, "feedback": { "option": 0 }, "text": "No cambiaron.", "points": 0, "of": 1
    });
    assert_eq!(wrong, expected);
    let right = mark(SMALL, &["--task", "why", "--lang", "pt-BR"], &json!({ "choice": 1 }));
    assert_eq!((&right["is_right"], &right["points"], &right["text"]), (&json!(true), &json!(1), &json!("Yes.")));
}

#[test]
fn a_number_is_marked_with_that_of_the_student() {
    // The valves of the small lesson vary with the seed, and the zero with them.
    let zero = |seed: &str, number: f64| {
        let options = ["--step", "1", "--task", "zero", "--seed", seed];
        mark(SMALL, &options, &json!({ "number": number }))
    };
    let rig = |valve: &str| {
        let document = stdout(&run(&["presets", "johansson-2000-minimum-phase"]));
        let arguments = ["analyse", "-", "--only", "zero.rightmost", "--set", "setup.valves[1]=0.4", "--set", valve];
        let answer: Value = serde_json::from_str(&stdout(&pipe(&arguments, document.as_bytes()))).unwrap();
        answer["zero.rightmost"].as_f64().unwrap()
    };
    let zeros = ["setup.valves[0]=0.3", "setup.valves[0]=0.35", "setup.valves[0]=0.4"].map(rig);
    for seed in ["0", "1", "2", "3"] {
        let right: Vec<_> = zeros.into_iter().filter(|&number| zero(seed, number)["is_right"] == json!(true)).collect();
        let [right] = right[..] else { panic!("one of {zeros:?} for each student, not {right:?}") };
        assert_eq!(zero(seed, right)["points"], json!(3));
        assert_eq!(zero(seed, -right)["feedback"], json!({ "mistake": 0 }));
        assert_eq!(zero(seed, 1.0 / right)["text"], json!("That is a time."));
        assert_eq!(zero(seed, 1.0)["text"], json!(null));
    }
}

#[test]
fn a_number_of_the_present_state_is_that_of_the_solution_or_of_a_document() {
    let sum = |options: &[&str], number: f64| {
        mark(SMALL, &[&["--task", "sum"], options].concat(), &json!({ "number": number }))["is_right"].clone()
    };
    assert_eq!((sum(&[], 1.3), sum(&[], 0.6)), (json!(true), json!(false)));
    let document = folder("mark_present").join("rig.json");
    fs::write(&document, stdout(&run(&["presets", "johansson-2000-non-minimum-phase"]))).unwrap();
    let document = ["--document", document.to_str().unwrap()];
    assert_eq!((sum(&document, 0.77), sum(&document, 1.3)), (json!(true), json!(false)));
}

#[test]
fn a_goal_is_marked_by_a_document_of_the_bench() {
    let left = |preset: &str| {
        let document = serde_json::from_str(&stdout(&run(&["presets", preset]))).unwrap();
        mark(SMALL, &["--step", "2", "--task", "left"], &document)
    };
    let reached = left("johansson-2000-minimum-phase");
    assert_eq!((&reached["is_right"], &reached["points"]), (&json!(true), &json!(4)));
    assert!(reached["goals"].as_array().unwrap().iter().all(|goal| goal["is_met"] == json!(true)));
    assert_eq!(reached["goals"][1]["value"], json!(70.0));
    let not = left("johansson-2000-non-minimum-phase");
    assert_eq!((&not["is_right"], &not["points"]), (&json!(false), &json!(0)));
    assert_eq!(not["goals"][0]["is_met"], json!(false));
}

#[test]
fn order_and_words_are_marked_too() {
    let order = |found: Value| mark(SMALL, &["--task", "order"], &json!({ "order": found }))["is_right"].clone();
    assert_eq!((order(json!([0, 1, 2])), order(json!([1, 0, 2]))), (json!(true), json!(false)));
    let words = mark(SMALL, &["--task", "words"], &json!({ "text": "A detour." }));
    assert_eq!((&words["feedback"], &words["text"]), (&json!("model"), &json!("Water takes the detour.")));
}

#[test]
fn the_solutions_of_a_student_are_right_for_that_student() {
    for seed in ["0", "7"] {
        let printed = stdout(&run(&["check", SMALL, "--solutions", "--seed", seed]));
        let solutions: Vec<Value> = serde_json::from_str(&printed).unwrap();
        assert_eq!(solutions[0]["answer"], json!(null), "a prediction is not marked");
        let settings: Vec<&Value> = solutions.iter().map(|found| &found["settings"]).filter(|s| s.is_array()).collect();
        assert!(!settings.is_empty());
        for found in solutions.iter().filter(|found| found["answer"].is_object()) {
            let task = found["task"].as_str().unwrap();
            let verdict = mark(SMALL, &["--task", task, "--seed", seed], &found["answer"]);
            assert_eq!(verdict["is_right"], json!(true), "{task}");
        }
    }
}

#[test]
fn a_lesson_of_the_laboratory_is_marked_by_its_id() {
    let prediction = mark("two-valves-one-zero", &["--step", "1"], &json!({ "choice": 0 }));
    assert_eq!((&prediction["is_right"], &prediction["of"]), (&json!(true), &json!(0)));
}

#[test]
fn what_cannot_be_marked_says_why() {
    let check = |options: &[&str], input: &str| refusal(&[&["check", SMALL], options].concat(), input);
    let told = check(&[], "{}");
    assert_eq!(told, "quadtank: say which: --task ID marks an answer to it, --all audits the lesson");
    let told = check(&["--task", "no"], "{}");
    assert_eq!(told, "quadtank: there is no task `no`; the lesson has guess, zero, left, sum, why, order, words");
    let told = check(&["--step", "1", "--task", "why"], "{}");
    assert_eq!(told, "quadtank: step 1 has no task `why`; it has guess, zero");
    let told = check(&["--step", "1"], "{}");
    assert_eq!(told, "quadtank: step 1 has several tasks or none: name one with --task; it has guess, zero");
    assert_eq!(check(&["--step", "3"], "{}"), "quadtank: there is no step 3; the lesson has 2");
    let told = check(&["--task", "zero"], r#"{"choice": 0}"#);
    assert_eq!(told, r#"quadtank: the answer to task `zero` is a number in the unit of the task: {"number": 0.5}"#);
    for input in ["", "{", "[]", r#"{"number": "x"}"#, r#"{"number": 1, "choice": 1}"#, r#"{"numbers": 1}"#] {
        let told = check(&["--task", "zero"], input);
        assert!(told.starts_with("quadtank: standard input: "), "{told}");
    }
    let tuning = stdout(&run(&["cases", "table-6-row-1"]));
    let told = check(&["--task", "left"], &tuning);
    assert_eq!(told, "quadtank: this is a document of the bench relay-tuning; the lesson is about quadruple-tank");
    let told = check(&["--task", "left"], r#"{"number": 1}"#);
    assert!(told.starts_with("quadtank: standard input: "), "{told}");
    let told = refusal(&["check", SMALL, SMALL, "--task", "zero"], "{}");
    assert_eq!(told, "quadtank: one lesson is marked at a time; --all audits several");
    assert!(refusal(&["check"], "").contains("required"));
    assert!(refusal(&["check", SMALL, "--step", "0"], "").contains("--step"));
    assert!(refusal(&["check", SMALL, "--task", "zero", "--lang", "de"], "").contains("pt-BR"));
}

#[test]
fn a_report_is_read_from_its_code() {
    let lesson = read_lesson(&fs::read(SMALL).unwrap()).unwrap();
    let report = Report::of(&lesson, &Progress::new(&lesson, 7), "Jörg");
    let code = report.to_code();
    for code in [code.clone(), code.replace("QL1-", "QL1-\n ")] {
        let output = run(&["check", "--report", &code]);
        let printed: Value = serde_json::from_str(&stdout(&output)).unwrap();
        assert_eq!(printed, serde_json::to_value(&report).unwrap());
        assert!(stderr(&output).contains("proves nothing"), "{}", stderr(&output));
    }
    let damaged = refusal(&["check", "--report", &code[..code.len() - 4]], "");
    assert_eq!(damaged, "quadtank: --report: the code is damaged: characters are missing or changed");
    assert!(refusal(&["check", "--report", "abc"], "").contains("does not begin with QL1-"));
}

#[test]
fn the_schema_describes_every_field_of_a_lesson() {
    let schema: Value = serde_json::from_str(&stdout(&run(&["schema", "--lesson"]))).unwrap();
    assert_described(&schema, &schema, &serde_json::from_slice(&fs::read(SMALL).unwrap()).unwrap());
    assert!(refusal(&["schema", "--lesson", "--version", "2"], "").contains("--lesson"));
}

/// A page as `make single` builds it, but small.
fn site(test: &str) -> String {
    let file = folder(test).join("quadtank.html");
    fs::write(&file, "<!doctype html><html data-single><head><title>x</title></head><body>γ</body></html>").unwrap();
    file.to_str().unwrap().to_owned()
}

#[test]
fn a_package_has_the_page_with_the_lesson_and_a_manifest() {
    let site = site("scorm");
    let package = folder("scorm").join("lesson.zip");
    let output = run(&["scorm", SMALL, "-o", package.to_str().unwrap(), "--site", &site]);
    assert_eq!((stdout(&output), stderr(&output)), (String::new(), String::new()));
    let bytes = fs::read(&package).unwrap();
    let mut archive = ZipArchive::new(Cursor::new(&bytes)).unwrap();
    let names: Vec<_> = archive.file_names().map(|name| name.unwrap().into_owned()).collect();
    assert_eq!(names, ["imsmanifest.xml", "index.html"]);
    let mut text = |name: &str| {
        let mut text = String::new();
        archive.by_name(name).unwrap().read_to_string(&mut text).unwrap();
        text
    };
    let (manifest, page) = (text("imsmanifest.xml"), text("index.html"));
    let xml = roxmltree::Document::parse(&manifest).unwrap();
    let titles: Vec<_> = xml.descendants().filter(|node| node.tag_name().name() == "title").collect();
    assert!(titles.iter().all(|title| title.text() == Some("Small & <short>")) && titles.len() == 2);
    let hrefs: Vec<_> = xml.descendants().filter_map(|node| node.attribute("href")).collect();
    assert_eq!(hrefs, ["index.html", "index.html"]);
    let inside =
        page.split_once("id=\"lesson\" data-scorm=\"1\">").unwrap().1.split_once("</script></head>").unwrap().0;
    assert_eq!(read_lesson(inside.as_bytes()), read_lesson(&fs::read(SMALL).unwrap()));
    let printed = run(&["scorm", SMALL, "-o", "-", "--site", &site]);
    assert_eq!(printed.stdout, bytes, "the same lesson gives the same package");
}

#[test]
fn a_lesson_of_the_laboratory_is_packed_by_its_id() {
    let site = site("scorm_id");
    let output = run(&["scorm", "windup", "-o", "-", "--site", &site]);
    assert!(output.status.success());
    let mut archive = ZipArchive::new(Cursor::new(output.stdout)).unwrap();
    assert!(archive.by_name("index.html").unwrap().size() > 10_000);
}

#[test]
fn no_package_is_written_of_what_is_no_lesson_or_no_page() {
    let site = site("scorm_wrong");
    let out = folder("scorm_wrong").join("out.zip");
    let package = |lesson: &str, site: &str| {
        let output = run(&["scorm", lesson, "-o", out.to_str().unwrap(), "--site", site]);
        assert!(!output.status.success() && !Path::new(&out).exists());
        (output.status.code(), stderr(&output))
    };
    let (code, told) = package(SMALL, SMALL);
    assert_eq!(code, Some(2));
    assert!(told.contains("make single"), "{told}");
    assert_eq!(package(&site, &site).0, Some(2));
    assert_eq!(package(SMALL, "none.html").0, Some(1));
}

#[test]
fn a_lesson_with_faults_is_packed_with_a_warning() {
    let file = copy("scorm_faults", "(glossary:zero)", "(glossary:zeros)");
    let site = site("scorm_faults");
    let output = run(&["scorm", &file, "-o", "-", "--site", &site]);
    assert!(output.status.success());
    assert!(stderr(&output).contains("warning: the lesson has faults"), "{}", stderr(&output));
}
