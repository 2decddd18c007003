//! What is wrong with a lesson that somebody wrote.

use std::fmt;

use quadtank_scenario::{Document, Quantities, quantities_of};

use super::{
    Achieve, Answer, Block, Formula, Lesson, LiveValue, NumberTask, Of, Place, Span, Task, TaskKind, Text, Tongue,
    Values, bench_names, check, in_unit, parse_markdown, start_of, with_settings,
};

/// Something wrong, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// Where in the lesson: `steps[2].tasks[0].kind.number`.
    pub place: String,
    /// What is wrong.
    pub kind: FaultKind,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.kind)
    }
}

/// What can be wrong.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FaultKind {
    /// A text is not there in a language of the lesson.
    #[error("no text in {}", .0.tag())]
    NoText(Tongue),
    /// A name leads nowhere.
    #[error("unknown {what} `{name}`")]
    Unknown {
        /// What it should be.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// An id is there twice.
    #[error("the id `{0}` is there twice")]
    Twice(String),
    /// A unit does not fit.
    #[error("{0}")]
    Unit(#[from] super::UnitError),
    /// A state cannot be made.
    #[error("{0}")]
    State(String),
    /// A choice without a right option, or with right ones only.
    #[error("there must be right and wrong options")]
    Options,
    /// The goal is reached before anything is done.
    #[error("the goal is reached before anything is done")]
    AlreadyReached,
    /// The solution does not reach the goal; the conditions that fail.
    #[error("the solution does not reach the goal: {0}")]
    NotReached(String),
    /// A listed wrong answer is right, or does not get its feedback.
    #[error("wrong answer {index}{seed} does not get its feedback")]
    NoFeedback {
        /// Which one, from 0.
        index: usize,
        /// For which student.
        seed: String,
    },
    /// There is no number to find.
    #[error("the quantity has no value in this state")]
    NoValue,
    /// A marked task without points, or points that are no marks.
    #[error("a marked task has points, and only that")]
    Points,
}

/// How many students are tried where numbers differ from student to student.
const STUDENTS: u32 = 12;

/// Everything that is wrong with a lesson; nothing for one that can be given to students.
///
/// `terms` are the words of the glossary, `lessons` the ids of lessons that links may lead to.
pub fn audit(lesson: &Lesson, terms: &[&str], lessons: &[&str]) -> Vec<Fault> {
    let mut audit = Audit { lesson, terms, lessons, faults: Vec::new() };
    audit.names();
    audit.texts();
    if bench_names(&lesson.bench).is_some() {
        audit.play();
    }
    audit.faults
}

struct Audit<'a> {
    lesson: &'a Lesson,
    terms: &'a [&'a str],
    lessons: &'a [&'a str],
    faults: Vec<Fault>,
}

impl Values for Quantities {
    fn value(&self, name: &str) -> Option<(f64, &'static str)> {
        let unit = self.rows().into_iter().find(|row| row.name == name)?.unit;
        Some((Quantities::value(self, name).ok()??, unit))
    }
}

impl Audit<'_> {
    fn add(&mut self, place: &str, kind: FaultKind) {
        let fault = Fault { place: place.to_owned(), kind };
        // The same name is wrong in every language, and for every student.
        if !self.faults.contains(&fault) {
            self.faults.push(fault);
        }
    }

    fn unknown(&mut self, place: &str, what: &'static str, name: &str) {
        self.add(place, FaultKind::Unknown { what, name: name.to_owned() });
    }

    fn names(&mut self) {
        let lesson = self.lesson;
        let Some(bench) = bench_names(&lesson.bench) else { return self.unknown("bench", "bench", &lesson.bench) };
        for id in lesson.prerequisites.iter().filter(|id| !self.lessons.contains(&id.as_str())) {
            self.unknown("prerequisites", "lesson", id);
        }
        for (index, step) in lesson.steps.iter().enumerate() {
            for (field, names, known) in [
                ("panels", &step.panels, bench.panels),
                ("reveal", &step.reveal, bench.panels),
                ("lock", &step.lock, bench.locks),
            ] {
                for name in names.iter().filter(|name| !known.contains(&name.as_str())) {
                    self.unknown(&format!("steps[{index}].{field}"), "card or group of controls", name);
                }
            }
        }
        for (step, task) in lesson.tasks() {
            let place = format!("steps[{step}].tasks `{}`", task.id);
            if lesson.tasks().filter(|(_, other)| other.id == task.id).count() > 1 {
                self.add(&place, FaultKind::Twice(task.id.clone()));
            }
            if (task.points > 0) != task.kind.is_marked() {
                self.add(&place, FaultKind::Points);
            }
            if let TaskKind::Choose(choose) = &task.kind {
                let right = choose.options.iter().filter(|option| option.correct).count();
                if right == 0 || right == choose.options.len() {
                    self.add(&place, FaultKind::Options);
                }
            }
        }
    }

    fn texts(&mut self) {
        for (place, text) in texts(self.lesson) {
            for &tongue in &self.lesson.languages {
                match text.get(tongue) {
                    None => self.add(&place, FaultKind::NoText(tongue)),
                    Some(text) => self.markup(&place, text),
                }
            }
        }
    }

    fn markup(&mut self, place: &str, text: &str) {
        for block in parse_markdown(text) {
            let spans = match block {
                Block::Paragraph(spans) => spans,
                Block::List { items, .. } => items.into_iter().flatten().collect(),
                Block::Formula(formula) => vec![Span::Formula(formula)],
            };
            for span in spans {
                match span {
                    Span::Link(_, Place::Glossary(name)) if !self.terms.contains(&name.as_str()) => {
                        self.unknown(place, "word of the glossary", &name);
                    }
                    Span::Link(_, Place::Bench(name)) if bench_names(&name).is_none() => {
                        self.unknown(place, "bench", &name)
                    }
                    Span::Link(_, Place::Lesson(name)) if !self.lessons.contains(&name.as_str()) => {
                        self.unknown(place, "lesson", &name);
                    }
                    Span::Value(LiveValue { quantity, unit, .. }) => self.quantity(place, &quantity, &unit),
                    Span::Formula(formula) => self.formula(place, &formula),
                    // What looks like markup and is none was meant to be some.
                    Span::Plain(text)
                        if ["{value:", "{formula:", "](", "$", "**"].iter().any(|mark| text.contains(mark)) =>
                    {
                        self.unknown(place, "markup", &text.chars().take(60).collect::<String>());
                    }
                    _ => {}
                }
            }
        }
    }

    fn formula(&mut self, place: &str, formula: &Formula) {
        match formula {
            Formula::Value(quantity, unit) => self.quantity(place, quantity, unit),
            Formula::Row(parts) => parts.iter().for_each(|part| self.formula(place, part)),
            Formula::Fraction(parts) => parts.iter().for_each(|part| self.formula(place, part)),
            Formula::Root(part) => self.formula(place, part),
            Formula::Scripts { base, below, above } => {
                [Some(base), below.as_ref(), above.as_ref()]
                    .into_iter()
                    .flatten()
                    .for_each(|part| self.formula(place, part));
            }
            _ => {}
        }
    }

    fn quantity(&mut self, place: &str, name: &str, unit: &str) {
        let Some(bench) = bench_names(&self.lesson.bench) else { return };
        match quantities_of(bench.version).into_iter().find(|row| row.name == name) {
            None => self.unknown(place, "quantity", name),
            Some(row) => {
                if let Err(error) = in_unit(1.0, row.unit, unit) {
                    self.add(place, FaultKind::Unit(error));
                }
            }
        }
    }

    /// Plays the lesson with its own solutions.
    fn play(&mut self) {
        let lesson = self.lesson;
        for seed in 0..STUDENTS {
            let mut present = None;
            for (index, step) in lesson.steps.iter().enumerate() {
                match start_of(lesson, step, seed) {
                    Ok(Some(start)) => present = Some(start),
                    Ok(None) => {}
                    Err(error) => self.add(&format!("steps[{index}].start"), FaultKind::State(error.to_string())),
                }
                let Some(start) = present.clone() else {
                    self.add(
                        &format!("steps[{index}].start"),
                        FaultKind::State(super::StartError::NoState.to_string()),
                    );
                    return;
                };
                for task in &step.tasks {
                    let place = format!("steps[{index}].tasks `{}`", task.id);
                    match &task.kind {
                        TaskKind::Number(number) => {
                            self.number(&place, task, number, [&start, present.as_ref().unwrap_or(&start)], seed)
                        }
                        TaskKind::Achieve(goal) => {
                            present = self.achieve(&place, task, goal, present.as_ref().unwrap_or(&start)).or(present)
                        }
                        _ => {}
                    }
                }
            }
            if lesson.steps.iter().all(|step| step.vary.is_empty()) {
                return;
            }
        }
    }

    fn number(&mut self, place: &str, task: &Task, number: &NumberTask, [start, present]: [&Document; 2], seed: u32) {
        if let Some(name) = &number.quantity {
            self.quantity(place, name, &number.unit);
        }
        let state = if number.of == Of::Start { start } else { present };
        let values = match with_settings(state, &number.set) {
            Ok(state) => Quantities::of(&state),
            Err(error) => return self.add(place, FaultKind::State(error.to_string())),
        };
        let Some(answer) = number.answer(&values) else { return self.add(place, FaultKind::NoValue) };
        for (index, mistake) in number.mistakes.iter().enumerate() {
            let found = number.mistaken(mistake, Some(answer), &values);
            let verdict = found.map(|found| check(task, &Answer::Number(found), &values));
            let expected = Some(super::Feedback::Mistake(index));
            if verdict.is_none_or(|verdict| verdict.is_right || verdict.feedback != expected) {
                self.add(
                    place,
                    FaultKind::NoFeedback {
                        index,
                        seed: if self.lesson.steps.iter().all(|step| step.vary.is_empty()) {
                            String::new()
                        } else {
                            format!(" (seed {seed})")
                        },
                    },
                );
            }
        }
    }

    /// Tries a goal; the state that its solution leads to.
    fn achieve(&mut self, place: &str, task: &Task, goal: &Achieve, before: &Document) -> Option<Document> {
        for condition in goal.conditions.iter().chain(goal.attempts.iter().flat_map(|attempt| &attempt.when)) {
            self.quantity(place, &condition.quantity, &condition.unit);
        }
        if check(task, &Answer::Bench, &Quantities::of(before)).is_right {
            self.add(place, FaultKind::AlreadyReached);
        }
        for (index, attempt) in goal.attempts.iter().enumerate() {
            match with_settings(before, &attempt.set) {
                Err(error) => self.add(place, FaultKind::State(error.to_string())),
                Ok(state) => {
                    let verdict = check(task, &Answer::Bench, &Quantities::of(&state));
                    if verdict.is_right || verdict.feedback != Some(super::Feedback::Attempt(index)) {
                        self.add(place, FaultKind::NoFeedback { index, seed: String::new() });
                    }
                }
            }
        }
        match with_settings(before, &goal.solution) {
            Err(error) => {
                self.add(place, FaultKind::State(error.to_string()));
                None
            }
            Ok(state) => {
                let reached = super::goals(goal, &Quantities::of(&state));
                let failing = goal.conditions.iter().zip(&reached).filter(|(_, goal)| !goal.is_met);
                let failing: Vec<String> =
                    failing.map(|(condition, goal)| format!("{} is {:?}", condition.quantity, goal.value)).collect();
                if !failing.is_empty() {
                    self.add(place, FaultKind::NotReached(failing.join(", ")));
                }
                Some(state)
            }
        }
    }
}

/// All texts of a lesson with their places.
fn texts(lesson: &Lesson) -> Vec<(String, &Text)> {
    let mut texts = vec![("title".to_owned(), &lesson.title), ("summary".to_owned(), &lesson.summary)];
    let numbered =
        |name: &str, list: &'_ [Text]| -> Vec<String> { (0..list.len()).map(|k| format!("{name}[{k}]")).collect() };
    texts.extend(numbered("outcomes", &lesson.outcomes).into_iter().zip(&lesson.outcomes));
    texts.extend(numbered("misconceptions", &lesson.misconceptions).into_iter().zip(&lesson.misconceptions));
    for (index, step) in lesson.steps.iter().enumerate() {
        let place = format!("steps[{index}]");
        texts.push((format!("{place}.title"), &step.title));
        texts.push((format!("{place}.text"), &step.text));
        texts.extend(step.after.iter().map(|text| (format!("{place}.after"), text)));
        for task in &step.tasks {
            let place = format!("{place}.tasks `{}`", task.id);
            texts.push((format!("{place}.question"), &task.question));
            texts.extend(numbered(&format!("{place}.hints"), &task.hints).into_iter().zip(&task.hints));
            texts.extend(kind_texts(&task.kind).into_iter().map(|(name, text)| (format!("{place}.{name}"), text)));
        }
    }
    texts
}

fn kind_texts(kind: &TaskKind) -> Vec<(&'static str, &Text)> {
    match kind {
        TaskKind::Predict(predict) => predict.options.iter().map(|text| ("options", text)).collect(),
        TaskKind::Choose(choose) => choose
            .options
            .iter()
            .flat_map(|option| [("options", &option.text), ("feedback", &option.feedback)])
            .collect(),
        TaskKind::Number(number) => number.mistakes.iter().map(|mistake| ("mistakes", &mistake.feedback)).collect(),
        TaskKind::Achieve(goal) => {
            let labels = goal.conditions.iter().map(|condition| ("conditions", &condition.label));
            labels.chain(goal.attempts.iter().map(|attempt| ("attempts", &attempt.feedback))).collect()
        }
        TaskKind::Order(order) => order.items.iter().map(|text| ("items", text)).collect(),
        TaskKind::Explain(explain) => vec![("model", &explain.model)],
    }
}
