use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::fingerprint::checksum;
use super::{Answer, Lesson, Progress, points_of};

/// With what a code begins: its format.
const MARK: &str = "QL1-";

/// Longest name in a code (characters).
const LONGEST_NAME: usize = 80;

/// What a student hands in.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Id of the lesson.
    pub lesson: String,
    /// Fingerprint of the lesson.
    pub fingerprint: String,
    /// The name that the student typed.
    pub name: String,
    /// What the numbers of this student follow from.
    pub seed: u32,
    /// Time spent (s).
    pub seconds: u32,
    /// Points reached, of 100.
    pub score: u32,
    /// What was done with each task.
    pub tasks: Vec<TaskReport>,
}

/// What a student did with a task.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TaskReport {
    /// Id of the task.
    pub id: String,
    /// Points reached.
    pub points: u32,
    /// Points that there are.
    pub of: u32,
    /// Wrong answers.
    pub wrong: u32,
    /// Hints asked for.
    pub hints: u32,
    /// Whether it was solved.
    pub solved: bool,
    /// The last answer; a code has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub answer: Option<Answer>,
    /// The experiment at the time of the answer, as the text after `#lab=` in a link; absent in reports read from a code.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub state: Option<String>,
}

/// Why a code cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ReportError {
    /// It does not begin as codes do.
    #[error("this is no code of a report: it does not begin with {MARK}")]
    NoCode,
    /// Characters are missing or changed.
    #[error("the code is damaged: characters are missing or changed")]
    Damaged,
}

impl Report {
    /// The report on what was done.
    pub fn of(lesson: &Lesson, progress: &Progress, name: &str) -> Self {
        let tasks = lesson.tasks().map(|(_, task)| {
            let record = progress.record(&task.id);
            TaskReport {
                id: task.id.clone(),
                points: points_of(task, &record),
                of: task.points,
                wrong: record.wrong,
                hints: record.hints,
                solved: record.solved,
                answer: record.answer,
                state: record.state,
            }
        });
        Self {
            lesson: lesson.id.clone(),
            fingerprint: progress.fingerprint.clone(),
            name: name.trim().chars().take(LONGEST_NAME).collect(),
            seed: progress.seed,
            seconds: whole(progress.seconds),
            score: progress.score(lesson),
            tasks: tasks.collect(),
        }
    }

    /// A short code without the answers. It has a checksum against typing errors and proves nothing: who wants to cheat can.
    pub fn to_code(&self) -> String {
        let tasks: Vec<String> = self.tasks.iter().map(TaskReport::to_code).collect();
        let fields = [
            self.lesson.clone(),
            self.fingerprint.clone(),
            self.seed.to_string(),
            self.seconds.to_string(),
            self.score.to_string(),
            tasks.join(","),
            self.name.replace(['\t', '\n'], " "),
        ];
        let text = fields.join("\t");
        let payload = format!("{text}\t{:08x}", checksum(text.as_bytes()));
        format!("{MARK}{}", URL_SAFE_NO_PAD.encode(payload))
    }

    /// Reads a code. Spaces and line breaks, as mail programs add them, do not matter.
    ///
    /// # Errors
    /// [`ReportError`].
    pub fn from_code(code: &str) -> Result<Self, ReportError> {
        let code: String = code.chars().filter(|c| !c.is_whitespace()).collect();
        let payload = code.strip_prefix(MARK).ok_or(ReportError::NoCode)?;
        let bytes = URL_SAFE_NO_PAD.decode(payload).map_err(|_| ReportError::Damaged)?;
        let payload = String::from_utf8(bytes).map_err(|_| ReportError::Damaged)?;
        Self::from_payload(&payload).ok_or(ReportError::Damaged)
    }

    /// The reports of all codes in a text, in their order: names before them, quotes around them and lines that a mail has broken do
    /// not matter. A text without a code has none.
    pub fn all_in(text: &str) -> Vec<Result<Self, ReportError>> {
        /// Most pieces into which a code is broken.
        const MAX_PIECES: usize = 60;
        let is_of_code = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_');
        let report = |rest: &str| {
            let mut code = MARK.to_owned();
            let mut found = Err(ReportError::Damaged);
            for piece in rest.split(|c| !is_of_code(c)).filter(|piece| !piece.is_empty()).take(MAX_PIECES) {
                code.push_str(piece);
                found = Self::from_code(&code);
                if found.is_ok() {
                    break;
                }
            }
            found
        };
        text.split(MARK).skip(1).map(report).collect()
    }

    fn from_payload(payload: &str) -> Option<Self> {
        let (text, sum) = payload.rsplit_once('\t')?;
        if sum != format!("{:08x}", checksum(text.as_bytes())) {
            return None;
        }
        let mut fields = text.splitn(7, '\t');
        let mut next = || fields.next();
        Some(Self {
            lesson: next()?.to_owned(),
            fingerprint: next()?.to_owned(),
            seed: next()?.parse().ok()?,
            seconds: next()?.parse().ok()?,
            score: next()?.parse().ok()?,
            tasks: next()?
                .split(',')
                .filter(|task| !task.is_empty())
                .map(TaskReport::from_code)
                .collect::<Option<_>>()?,
            name: next()?.to_owned(),
        })
    }
}

/// A time in whole seconds.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a cast saturates, and makes 0 of NaN")]
fn whole(seconds: f64) -> u32 {
    seconds.round() as u32
}

impl TaskReport {
    fn to_code(&self) -> String {
        let Self { id, points, of, wrong, hints, solved, .. } = self;
        format!("{id}:{points}:{of}:{wrong}:{hints}:{}", u8::from(*solved))
    }

    fn from_code(code: &str) -> Option<Self> {
        let mut fields = code.split(':');
        let id = fields.next()?.to_owned();
        let numbers: Vec<u32> = fields.map(str::parse).collect::<Result<_, _>>().ok()?;
        let [points, of, wrong, hints, solved] = numbers[..] else { return None };
        Some(Self { id, points, of, wrong, hints, solved: solved == 1, answer: None, state: None })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::sample::lesson;
    use crate::{Record, Verdict};

    /// The report of a student who made one mistake and took one hint.
    fn report(name: &str) -> Report {
        let lesson = lesson();
        let mut progress = Progress::new(&lesson, 4_294_967_295);
        progress.seconds = 372.4;
        for (_, task) in lesson.tasks().filter(|(_, task)| task.id != "order") {
            let state = Some("a-link".to_owned());
            let mut record = Record { hints: u32::from(task.id == "zero"), state, ..Record::default() };
            for is_right in [task.id != "zero", true] {
                record.take(task, Answer::Number(0.5), Verdict { is_right, feedback: None });
            }
            progress.records.insert(task.id.clone(), record);
        }
        Report::of(&lesson, &progress, name)
    }

    /// What a code holds of a report.
    fn without_answers(report: &Report) -> Report {
        let tasks = report.tasks.iter().map(|task| TaskReport { answer: None, state: None, ..task.clone() });
        Report { tasks: tasks.collect(), ..report.clone() }
    }

    #[test]
    fn a_report_has_the_points_of_each_task_in_the_order_of_the_lesson() {
        let report = report("Ana");
        let points: Vec<_> = report.tasks.iter().map(|task| (task.id.as_str(), task.points, task.of)).collect();
        let expected = [("guess", 0, 0), ("zero", 1, 3), ("left", 4, 4), ("sum", 1, 1), ("why", 1, 1), ("order", 0, 1)];
        assert_eq!(points[..6], expected);
        assert_eq!((report.score, report.seconds), (70, 372));
        let [guess, zero, .., order, _] = &report.tasks[..] else { panic!() };
        assert_eq!((zero.wrong, zero.hints, zero.solved), (1, 1, true));
        assert_eq!((order.wrong, order.solved, &order.answer), (0, false, &None));
        assert_eq!(guess.answer, Some(Answer::Number(0.5)));
        assert_eq!((guess.state.as_deref(), &order.state), (Some("a-link"), &None));
    }

    #[test]
    fn a_time_that_is_none_is_nothing() {
        let lesson = lesson();
        for (seconds, whole) in [(f64::NAN, 0), (-3.0, 0), (0.5, 1), (1e300, u32::MAX)] {
            let progress = Progress { seconds, ..Progress::new(&lesson, 1) };
            assert_eq!(Report::of(&lesson, &progress, "").seconds, whole);
        }
    }

    #[test]
    fn a_code_comes_back_without_the_answers() {
        for name in ["", "Ana", "Jörg Müller-Lüdenscheidt", "João da Conceição", "李雷", "O'Neill: 100,5 %", "🙂"]
        {
            let report = report(name);
            assert_eq!(Report::from_code(&report.to_code()), Ok(without_answers(&report)), "{name}");
        }
    }

    #[test]
    fn tabs_and_line_breaks_of_a_name_become_spaces() {
        let code = report(" Ana\tMaria\nSilva ").to_code();
        assert_eq!(Report::from_code(&code).unwrap().name, "Ana Maria Silva");
    }

    #[test]
    fn a_long_name_is_cut() {
        let report = report(&"ü".repeat(500));
        assert_eq!(report.name.chars().count(), LONGEST_NAME);
        assert_eq!(Report::from_code(&report.to_code()), Ok(without_answers(&report)));
    }

    #[test]
    fn a_code_survives_mail() {
        let report = report("Ana");
        let code = report.to_code();
        let (lines, _) = code.as_bytes().as_chunks::<20>();
        let rest = &code[20 * lines.len()..];
        let lines: Vec<_> = lines.iter().map(|line| std::str::from_utf8(line).unwrap()).chain([rest]).collect();
        for mailed in [lines.join("\r\n"), format!("  {}\n\n", lines.join(" \n\t"))] {
            assert_eq!(Report::from_code(&mailed), Ok(without_answers(&report)), "{mailed}");
        }
    }

    #[test]
    fn what_is_no_code_is_told_from_a_damaged_one() {
        for other in ["", "QL", "QL2-abc", "https://example.org/", &report("Ana").to_code()[1..]] {
            assert_eq!(Report::from_code(other), Err(ReportError::NoCode), "{other}");
        }
        let code = report("Ana").to_code();
        for damaged in
            ["QL1-", "QL1-????", "QL1-YWJj", &code[..code.len() - 1], &format!("{code}A"), &code.to_uppercase()]
        {
            assert_eq!(Report::from_code(damaged), Err(ReportError::Damaged), "{damaged}");
        }
    }

    #[test]
    fn codes_are_found_among_names_quotes_and_broken_lines() {
        let [ana, rui] = ["Ana", "Rui"].map(|name| report(name).to_code());
        let text = format!("Ana: \"{}\n> {}\", Rui ({rui}) and QL1-broken", &ana[..30], &ana[30..]);
        let [ana, rui] = [ana, rui].map(|code| Report::from_code(&code));
        assert!(ana.is_ok() && rui.is_ok() && ana != rui);
        assert_eq!(Report::all_in(&text), [ana, rui, Err(ReportError::Damaged)]);
        assert_eq!(Report::all_in("no code"), []);
    }

    #[test]
    fn a_code_whose_sum_is_right_but_not_its_fields_is_damaged() {
        for text in ["", "a", "a\tb\t1\t2\t3\tx:1\tname", "a\tb\t-1\t2\t3\t\tname", "a\tb\t1\t2\t3"] {
            let payload = format!("{text}\t{:08x}", checksum(text.as_bytes()));
            let code = format!("{MARK}{}", URL_SAFE_NO_PAD.encode(payload));
            assert_eq!(Report::from_code(&code), Err(ReportError::Damaged), "{text:?}");
        }
    }

    proptest! {
        #[test]
        fn every_changed_character_is_noticed(place in 4..200_usize, to in "[A-Za-z0-9_-]") {
            let code = report("Ana").to_code();
            let mut changed = code.clone();
            changed.replace_range(place..=place, &to);
            prop_assert!(changed == code || Report::from_code(&changed) == Err(ReportError::Damaged));
        }

        #[test]
        fn any_name_comes_back(name in ".{0,100}") {
            let report = report(&name);
            let back = Report::from_code(&report.to_code()).unwrap();
            prop_assert_eq!(back.name, report.name.replace(['\t', '\n'], " "));
        }

        #[test]
        fn any_text_is_read_or_refused(code in "(QL1-)?.{0,200}") {
            let _ = (Report::from_code(&code), Report::all_in(&code));
        }
    }
}
