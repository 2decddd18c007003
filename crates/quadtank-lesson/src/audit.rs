//! What is wrong with a lesson that somebody wrote.

mod fault;
mod play;
mod texts;

pub use fault::{Fault, FaultKind, Instead, Named};

use quadtank_scenario::quantities_of;

use super::{
    Achieve, Choose, Condition, Lesson, MistakeKind, NumberTask, Step, Task, TaskKind, Tolerance, bench_ids,
    bench_names, in_unit,
};

/// Everything that is wrong with a lesson; nothing for one that can be given to students.
///
/// `terms` are the words of the glossary, `lessons` the ids of lessons that links may lead to.
pub fn audit(lesson: &Lesson, terms: &[&str], lessons: &[&str]) -> Vec<Fault> {
    let mut audit = Audit { lesson, terms, lessons, seed: None, faults: Vec::new() };
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
    /// The student who plays, where it matters which one.
    seed: Option<u32>,
    faults: Vec<Fault>,
}

/// Where a task is.
fn place_of(step: usize, task: &Task) -> String {
    format!("steps[{step}].tasks[{}]", task.id)
}

impl Audit<'_> {
    fn add(&mut self, place: &str, kind: FaultKind) {
        let fault = Fault { place: place.to_owned(), seed: self.seed, kind };
        // A name is wrong in every language of a text.
        if !self.faults.contains(&fault) {
            self.faults.push(fault);
        }
    }

    fn unknown(&mut self, place: &str, what: Named, name: &str, known: &[&'static str]) {
        self.add(place, FaultKind::Unknown { what, name: name.to_owned(), known: known.to_vec() });
    }

    /// Names, numbers and lists, as they stand.
    fn names(&mut self) {
        let lesson = self.lesson;
        if bench_names(&lesson.bench).is_none() {
            self.unknown("bench", Named::Bench, &lesson.bench, &bench_ids());
        }
        let languages: Vec<&str> = lesson.languages.iter().map(|tongue| tongue.tag()).collect();
        self.once("languages", &languages);
        for (index, id) in lesson.prerequisites.iter().enumerate() {
            if !self.lessons.contains(&id.as_str()) {
                self.unknown(&format!("prerequisites[{index}]"), Named::Lesson, id, &[]);
            }
        }
        for (index, step) in lesson.steps.iter().enumerate() {
            self.step(index, step);
        }
        let ids: Vec<&str> = lesson.tasks().map(|(_, task)| task.id.as_str()).collect();
        for (step, task) in lesson.tasks() {
            let place = place_of(step, task);
            if ids.iter().filter(|id| **id == task.id).count() > 1 {
                self.add(&place, FaultKind::Twice(task.id.clone()));
            }
            if (task.points > 0) != task.kind.is_marked() {
                self.add(&format!("{place}.points"), FaultKind::Points);
            }
            self.kind(&format!("{place}.kind"), &task.kind);
        }
    }

    fn step(&mut self, index: usize, step: &Step) {
        let Some(bench) = bench_names(&self.lesson.bench) else { return };
        for (field, what, names, known) in [
            ("panels", Named::Card, &step.panels, bench.panels),
            ("reveal", Named::Card, &step.reveal, bench.panels),
            ("lock", Named::Controls, &step.lock, bench.locks),
        ] {
            let place = format!("steps[{index}].{field}");
            self.once(&place, &names.iter().map(String::as_str).collect::<Vec<_>>());
            for name in names {
                if !known.contains(&name.as_str()) {
                    self.unknown(&place, what, name, known);
                } else if field == "reveal" && !step.panels.contains(name) {
                    self.add(&place, FaultKind::NotShown(name.clone()));
                }
            }
        }
        if !step.vary.is_empty() && step.start.is_none() {
            self.add(&format!("steps[{index}].vary"), FaultKind::NothingToVary);
        }
        for (number, variation) in step.vary.iter().enumerate() {
            self.at_least(&format!("steps[{index}].vary[{number}].among"), variation.among.len(), 1);
        }
    }

    fn once(&mut self, place: &str, names: &[&str]) {
        for (index, name) in names.iter().enumerate() {
            if names[..index].contains(name) {
                self.add(place, FaultKind::Twice((*name).to_owned()));
            }
        }
    }

    fn at_least(&mut self, place: &str, found: usize, least: usize) {
        if found < least {
            self.add(place, FaultKind::TooFew { found, least });
        }
    }

    fn kind(&mut self, place: &str, kind: &TaskKind) {
        match kind {
            TaskKind::Predict(predict) => self.at_least(&format!("{place}.predict.options"), predict.options.len(), 2),
            TaskKind::Choose(Choose { options }) => {
                if options.iter().all(|option| option.correct) || !options.iter().any(|option| option.correct) {
                    self.add(&format!("{place}.choose.options"), FaultKind::Options);
                }
            }
            TaskKind::Number(number) => self.number_kind(&format!("{place}.number"), number),
            TaskKind::Achieve(goal) => self.achieve_kind(&format!("{place}.achieve"), goal),
            TaskKind::Order(order) => self.at_least(&format!("{place}.order.items"), order.items.len(), 2),
            TaskKind::Explain(_) => {}
        }
    }

    fn number_kind(&mut self, place: &str, number: &NumberTask) {
        if number.quantity.is_some() == number.value.is_some() {
            self.add(place, FaultKind::QuantityOrValue);
        }
        if let Some(name) = &number.quantity {
            self.quantity(&format!("{place}.quantity"), name, &number.unit);
        }
        let (Tolerance::Relative(most) | Tolerance::Absolute(most)) = number.tolerance;
        if most <= 0.0 {
            self.add(&format!("{place}.tolerance"), FaultKind::Tolerance);
        }
        for (index, mistake) in number.mistakes.iter().enumerate() {
            if let MistakeKind::Quantity(name) = &mistake.is {
                self.quantity(&format!("{place}.mistakes[{index}].is"), name, &number.unit);
            }
        }
    }

    fn achieve_kind(&mut self, place: &str, goal: &Achieve) {
        self.at_least(&format!("{place}.conditions"), goal.conditions.len(), 1);
        self.conditions(&format!("{place}.conditions"), &goal.conditions);
        for (index, attempt) in goal.attempts.iter().enumerate() {
            self.conditions(&format!("{place}.attempts[{index}].when"), &attempt.when);
        }
    }

    fn conditions(&mut self, place: &str, conditions: &[Condition]) {
        for (index, condition) in conditions.iter().enumerate() {
            let place = format!("{place}[{index}]");
            self.quantity(&place, &condition.quantity, &condition.unit);
            match (condition.at_least, condition.at_most) {
                (None, None) => self.add(&place, FaultKind::NoBound),
                (Some(least), Some(most)) if least > most => self.add(&place, FaultKind::Bounds),
                _ => {}
            }
        }
    }

    fn quantity(&mut self, place: &str, name: &str, unit: &str) {
        match self.unit_of(name) {
            None if bench_names(&self.lesson.bench).is_some() => self.unknown(place, Named::Quantity, name, &[]),
            None => {}
            Some(si) => {
                if let Err(error) = in_unit(1.0, si, unit) {
                    self.add(place, FaultKind::Unit(error));
                }
            }
        }
    }

    /// The SI unit of a quantity of the bench.
    fn unit_of(&self, quantity: &str) -> Option<&'static str> {
        let bench = bench_names(&self.lesson.bench)?;
        quantities_of(bench.version).into_iter().find(|row| row.name == quantity).map(|row| row.unit)
    }

    /// Whether a quantity exists and is measured in a unit.
    fn is_measured(&self, quantity: &str, unit: &str) -> bool {
        self.unit_of(quantity).is_some_and(|si| in_unit(1.0, si, unit).is_ok())
    }
}
