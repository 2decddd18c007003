use std::collections::BTreeMap;

use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use serde::{Deserialize, Serialize};

use super::{Answer, Lesson, Task, Verdict, fingerprint};

/// Longest text that a learning management system keeps for a lesson (SCORM 1.2, `cmi.suspend_data`; characters).
pub const SUSPEND_LIMIT: usize = 4096;

/// After so many wrong answers the solution is shown.
const MAX_WRONG: u32 = 3;

/// What a student has done with a task.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// The last answer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub answer: Option<Answer>,
    /// Link of the experiment at the time of the answer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub state: Option<String>,
    /// How many answers were wrong.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub wrong: u32,
    /// How many hints were asked for.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub hints: u32,
    /// Whether it is answered rightly, or at all where it is not marked.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub solved: bool,
    /// Whether the solution was shown.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub shown: bool,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde calls it with a reference")]
fn is_zero(count: &u32) -> bool {
    *count == 0
}

impl Record {
    /// Whether there is nothing left to do.
    pub fn is_done(&self) -> bool {
        self.solved || self.shown
    }

    /// Takes an answer up. One that comes after the task is done changes nothing.
    pub fn take(&mut self, task: &Task, answer: Answer, verdict: Verdict) {
        if self.is_done() {
            return;
        }
        // What is no number has no JSON.
        self.answer = Some(answer).filter(|answer| !matches!(answer, Answer::Number(number) if !number.is_finite()));
        self.solved = verdict.is_right;
        if !verdict.is_right && task.kind.counts_attempts() {
            self.wrong += 1;
            self.shown = self.wrong >= MAX_WRONG;
        }
    }
}

/// The points of a task: a wrong answer and a hint cost one each.
pub fn points_of(task: &Task, record: &Record) -> u32 {
    if record.solved { task.points.saturating_sub(record.wrong.saturating_add(record.hints)) } else { 0 }
}

/// What a student has done in a lesson.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    /// Id of the lesson.
    pub lesson: String,
    /// The [`fingerprint`] of the lesson.
    pub fingerprint: String,
    /// What the numbers of this student follow from.
    pub seed: u32,
    /// The step that is open, from 0.
    #[serde(default)]
    pub step: usize,
    /// Time spent (s).
    #[serde(default)]
    pub seconds: f64,
    /// What was done, by ids of tasks.
    #[serde(default)]
    pub records: BTreeMap<String, Record>,
}

impl Progress {
    /// Nothing done yet.
    pub fn new(lesson: &Lesson, seed: u32) -> Self {
        let (lesson, fingerprint) = (lesson.id.clone(), fingerprint(lesson));
        Self { lesson, fingerprint, seed, step: 0, seconds: 0.0, records: BTreeMap::new() }
    }

    /// Whether it is of exactly this lesson.
    pub fn is_of(&self, lesson: &Lesson) -> bool {
        self.lesson == lesson.id && self.fingerprint == fingerprint(lesson) && self.step < lesson.steps.len()
    }

    /// What was done with a task.
    pub fn record(&self, task: &str) -> Record {
        self.records.get(task).cloned().unwrap_or_default()
    }

    /// Points so far.
    pub fn points(&self, lesson: &Lesson) -> u32 {
        lesson.tasks().map(|(_, task)| points_of(task, &self.record(&task.id))).sum()
    }

    /// Points so far, of 100.
    pub fn score(&self, lesson: &Lesson) -> u32 {
        let (points, of) = (self.points(lesson), lesson.points());
        (100 * points + of / 2).checked_div(of).unwrap_or(100)
    }

    /// Whether all tasks of a step are done.
    pub fn is_step_done(&self, lesson: &Lesson, step: usize) -> bool {
        lesson.steps.get(step).is_some_and(|step| step.tasks.iter().all(|task| self.record(&task.id).is_done()))
    }

    /// Whether all tasks are done.
    pub fn is_complete(&self, lesson: &Lesson) -> bool {
        (0..lesson.steps.len()).all(|step| self.is_step_done(lesson, step))
    }

    /// What was done as a text of at most [`SUSPEND_LIMIT`] characters, for a learning management system. There is no place for states of the
    /// bench. Free texts are cut, evenly, where they do not fit, and where even that is too much no answers are kept; the report has
    /// them whole.
    pub fn to_suspend_data(&self) -> String {
        let mut cut = self.clone();
        cut.records.values_mut().for_each(|record| record.state = None);
        let mut longest = SUSPEND_LIMIT;
        loop {
            let text = serde_json::to_string(&cut).map(|json| URL_SAFE_NO_PAD.encode(json)).unwrap_or_default();
            if text.len() <= SUSPEND_LIMIT || cut.records.values().all(|record| record.answer.is_none()) {
                return text;
            }
            longest /= 2;
            for record in cut.records.values_mut() {
                match &mut record.answer {
                    answer if longest == 0 => *answer = None,
                    Some(Answer::Text(text)) => *text = text.chars().take(longest).collect(),
                    _ => {}
                }
            }
        }
    }

    /// Reads what [`to_suspend_data`](Self::to_suspend_data) wrote for this lesson; `None` for anything else.
    pub fn from_suspend_data(text: &str, lesson: &Lesson) -> Option<Self> {
        let json = URL_SAFE_NO_PAD.decode(text.trim()).ok()?;
        serde_json::from_slice::<Self>(&json).ok().filter(|progress| progress.is_of(lesson))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use serde_json::json;

    use super::*;
    use crate::lesson::{LONGEST_TASK_ID, MAX_TASKS};
    use crate::read_lesson;
    use crate::sample::{SMALL, changed, lesson, task};

    const RIGHT: Verdict = Verdict { is_right: true, feedback: None };
    const WRONG: Verdict = Verdict { is_right: false, feedback: None };

    /// What is left of a task after some verdicts and hints.
    fn played(id: &str, hints: u32, verdicts: &[Verdict]) -> Record {
        let mut record = Record { hints, ..Record::default() };
        for verdict in verdicts {
            record.take(&task(id), Answer::Number(1.0), *verdict);
        }
        record
    }

    fn points(id: &str, hints: u32, verdicts: &[Verdict]) -> u32 {
        points_of(&task(id), &played(id, hints, verdicts))
    }

    #[test]
    fn a_wrong_answer_and_a_hint_cost_one_point_each() {
        assert_eq!(points("zero", 0, &[RIGHT]), 3);
        assert_eq!(points("zero", 0, &[WRONG, RIGHT]), 2);
        assert_eq!(points("zero", 1, &[RIGHT]), 2);
        assert_eq!(points("zero", 1, &[WRONG, RIGHT]), 1);
        assert_eq!(points("zero", 0, &[]), 0);
        assert_eq!(points("zero", 0, &[WRONG]), 0);
    }

    #[test]
    fn a_task_never_gives_less_than_nothing() {
        assert_eq!(points("zero", 2, &[WRONG, WRONG, RIGHT]), 0);
        assert_eq!(points("sum", 0, &[WRONG, RIGHT]), 0);
        assert_eq!(points("sum", 0, &[WRONG, WRONG, RIGHT]), 0);
        let record = Record { wrong: u32::MAX, hints: u32::MAX, solved: true, ..Record::default() };
        assert_eq!(points_of(&task("zero"), &record), 0);
    }

    #[test]
    fn three_wrong_answers_show_the_solution_and_end_the_task() {
        let two = played("zero", 0, &[WRONG, WRONG]);
        assert!(!two.is_done());
        let three = played("zero", 0, &[WRONG, WRONG, WRONG]);
        assert!(three.shown && three.is_done() && !three.solved);
        assert_eq!(played("zero", 0, &[WRONG, WRONG, WRONG, RIGHT]), three);
        assert_eq!(points("zero", 0, &[WRONG, WRONG, WRONG, RIGHT]), 0);
    }

    #[test]
    fn what_comes_after_a_right_answer_changes_nothing() {
        assert_eq!(played("zero", 0, &[RIGHT, WRONG, WRONG, WRONG]), played("zero", 0, &[RIGHT]));
    }

    #[test]
    fn attempts_at_a_goal_cost_nothing_but_hints_do() {
        assert_eq!(points("left", 0, &[WRONG; 20]), 0);
        assert!(!played("left", 0, &[WRONG; 20]).is_done());
        assert_eq!(points("left", 0, &[WRONG, WRONG, WRONG, WRONG, RIGHT]), 4);
        assert_eq!(points("left", 1, &[WRONG, RIGHT]), 3);
    }

    #[test]
    fn what_is_not_marked_gives_no_points() {
        for id in ["guess", "words"] {
            assert!(played(id, 0, &[RIGHT]).is_done());
            assert_eq!(points(id, 0, &[RIGHT]), 0);
        }
    }

    #[test]
    fn what_is_no_number_is_wrong_and_not_kept() {
        let mut record = Record::default();
        record.take(&task("zero"), Answer::Number(f64::NAN), WRONG);
        assert_eq!((record.answer, record.wrong), (None, 1));
    }

    /// A lesson played to the end by right answers.
    fn complete() -> (Lesson, Progress) {
        let lesson = lesson();
        let mut progress = Progress::new(&lesson, 7);
        for (_, task) in lesson.tasks() {
            progress.records.entry(task.id.clone()).or_default().take(task, Answer::Choice(0), RIGHT);
        }
        (lesson, progress)
    }

    #[test]
    fn right_answers_without_hints_give_all_points() {
        let (lesson, progress) = complete();
        assert_eq!((progress.points(&lesson), progress.score(&lesson)), (lesson.points(), 100));
        assert!(progress.is_complete(&lesson));
        let none = Progress::new(&lesson, 7);
        assert_eq!((none.points(&lesson), none.score(&lesson)), (0, 0));
        assert!(!none.is_step_done(&lesson, 0) && !none.is_step_done(&lesson, 9));
    }

    #[test]
    fn the_score_is_rounded_and_a_lesson_without_marks_is_passed() {
        let (lesson, mut progress) = complete();
        progress.records.get_mut("zero").unwrap().hints = 1;
        assert_eq!(progress.score(&lesson), 90);
        let steps = json!([{ "title": {}, "panels": [], "text": {}, "tasks": [] }]);
        let lesson = read_lesson(changed(&[("/steps", steps)]).as_bytes()).unwrap();
        assert_eq!(Progress::new(&lesson, 1).score(&lesson), 100);
        assert!(Progress::new(&lesson, 1).is_complete(&lesson));
    }

    #[test]
    fn suspend_data_comes_back() {
        let (lesson, mut progress) = complete();
        progress.step = 1;
        progress.seconds = 61.5;
        progress.records.get_mut("words").unwrap().answer = Some(Answer::Text("Água “γ₁”, \t\n🙂".to_owned()));
        let text = progress.to_suspend_data();
        assert!(text.chars().all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_'));
        assert_eq!(Progress::from_suspend_data(&format!(" {text}\n"), &lesson), Some(progress));
    }

    #[test]
    fn suspend_data_of_another_lesson_or_edition_is_refused() {
        let (lesson, progress) = complete();
        let text = progress.to_suspend_data();
        for change in [("/id", json!("another")), ("/steps/0/tasks/1/points", json!(2)), ("/title/en", json!("Other"))]
        {
            let other = read_lesson(changed(std::slice::from_ref(&change)).as_bytes()).unwrap();
            assert_eq!(Progress::from_suspend_data(&text, &other), None, "{change:?}");
        }
        let beyond = Progress { step: lesson.steps.len(), ..progress };
        assert_eq!(Progress::from_suspend_data(&beyond.to_suspend_data(), &lesson), None);
        for damaged in ["", "????", &text[1..], &text[..text.len() - 2]] {
            assert_eq!(Progress::from_suspend_data(damaged, &lesson), None, "{damaged}");
        }
    }

    #[test]
    fn long_texts_are_cut_until_they_fit_and_the_marks_stay() {
        let (lesson, mut progress) = complete();
        for (id, text) in
            [("words", "ç".repeat(50_000)), ("why", "\u{1}\"".repeat(3000)), ("order", "short".to_owned())]
        {
            progress.records.get_mut(id).unwrap().answer = Some(Answer::Text(text));
        }
        let text = progress.to_suspend_data();
        assert!(text.len() <= SUSPEND_LIMIT, "{}", text.len());
        assert!(text.len() > SUSPEND_LIMIT / 2, "{} is cut more than it has to be", text.len());
        let back = Progress::from_suspend_data(&text, &lesson).unwrap();
        assert_eq!(back.score(&lesson), 100);
        assert_eq!(back.record("order").answer, Some(Answer::Text("short".to_owned())));
        assert!(matches!(back.record("words").answer, Some(Answer::Text(text)) if text.starts_with("çççç")));
    }

    #[test]
    fn the_largest_lesson_fits() {
        let id = |number: usize| format!("{number:0LONGEST_TASK_ID$}");
        let tasks: Vec<_> = (0..MAX_TASKS)
            .map(
                |number| json!({ "id": id(number), "question": {}, "points": 9, "kind": { "order": { "items": [] } } }),
            )
            .collect();
        let steps: Vec<_> =
            tasks.chunks(11).map(|tasks| json!({ "title": {}, "panels": [], "text": {}, "tasks": tasks })).collect();
        let file = changed(&[("/steps", json!(steps)), ("/id", json!("l".repeat(60)))]);
        let lesson = read_lesson(file.as_bytes()).unwrap();
        let mut progress = Progress { seconds: 123_456.789_012_345_6, ..Progress::new(&lesson, u32::MAX) };
        for (_, task) in lesson.tasks() {
            let (answer, state) = (Some(Answer::Order((0..12).collect())), Some("x".repeat(2000)));
            let record = Record { answer, state, wrong: 2, hints: 12, solved: true, shown: true };
            progress.records.insert(task.id.clone(), record);
        }
        let text = progress.to_suspend_data();
        assert!(text.len() <= SUSPEND_LIMIT, "{}", text.len());
        assert_eq!(Progress::from_suspend_data(&text, &lesson).unwrap().records.len(), MAX_TASKS);
    }

    #[test]
    fn what_an_older_edition_of_the_program_kept_is_read() {
        let record: Record =
            serde_json::from_value(json!({ "answer": null, "wrong": 0, "hints": 0, "solved": false, "shown": false }))
                .unwrap();
        assert_eq!(record, Record::default());
        assert_eq!(serde_json::to_string(&record).unwrap(), "{}");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn points_are_within_those_of_the_task(
            hints in 0..5_u32, verdicts in prop::collection::vec(any::<bool>(), 0..8)
        ) {
            let verdicts: Vec<_> = verdicts.into_iter().map(|is_right| if is_right { RIGHT } else { WRONG }).collect();
            for id in ["zero", "left", "sum", "why", "order", "guess", "words"] {
                prop_assert!(points(id, hints, &verdicts) <= task(id).points);
            }
        }

        #[test]
        fn any_texts_fit(texts in prop::collection::vec(".{0,3000}", 1..6)) {
            let (lesson, mut progress) = complete();
            for (record, text) in progress.records.values_mut().zip(texts) {
                record.answer = Some(Answer::Text(text));
            }
            let text = progress.to_suspend_data();
            prop_assert!(text.len() <= SUSPEND_LIMIT);
            prop_assert_eq!(Progress::from_suspend_data(&text, &lesson).map(|back| back.score(&lesson)), Some(100));
        }

        #[test]
        fn any_text_is_read_or_refused(text in ".{0,200}") {
            let _ = Progress::from_suspend_data(&text, &read_lesson(SMALL.as_bytes()).unwrap());
        }
    }
}
