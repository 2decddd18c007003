//! Plays a lesson with its own solutions, mistakes and attempts.

use std::collections::BTreeSet;

use quadtank_scenario::{Document, Quantities};

use super::{Audit, FaultKind, Instead, place_of};
use crate::start::variant;
use crate::{
    Achieve, Answer, Condition, Feedback, NumberTask, Of, StartError, Task, TaskKind, check, conditions_met, start_of,
    with_settings,
};

/// How many students are tried where numbers differ from student to student, each with other numbers than those before.
const MOST_VARIANTS: usize = 24;

/// Among so many students such are sought.
const STUDENTS: u32 = 240;

impl Audit<'_> {
    pub fn play(&mut self) {
        let lesson = self.lesson;
        let is_varied = lesson.steps.iter().any(|step| !step.vary.is_empty());
        let mut played = BTreeSet::new();
        let before = self.faults.len();
        for seed in 0..STUDENTS {
            if played.len() < MOST_VARIANTS && played.insert(variant(lesson, seed)) {
                self.seed = is_varied.then_some(seed);
                self.play_as(seed);
            }
            // What is wrong for one student is wrong for others too.
            if self.faults.len() > before {
                break;
            }
        }
        self.seed = None;
    }

    fn play_as(&mut self, seed: u32) {
        let lesson = self.lesson;
        let mut present = None;
        for (index, step) in lesson.steps.iter().enumerate() {
            let begins = start_of(lesson, step, seed).and_then(|start| start.or(present).ok_or(StartError::NoState));
            let start = match begins {
                Ok(start) => start,
                Err(error) => return self.add(&format!("steps[{index}].start"), FaultKind::State(error.to_string())),
            };
            let mut now = start.clone();
            for task in &step.tasks {
                let place = place_of(index, task);
                match &task.kind {
                    TaskKind::Number(number) => self.play_number(&place, task, number, [&start, &now]),
                    TaskKind::Achieve(goal) => now = self.play_goal(&place, task, goal, &now).unwrap_or(now),
                    _ => {}
                }
            }
            present = Some(now);
        }
    }

    /// A document with settings of the lesson, if it can be made.
    fn made(&mut self, place: &str, state: &Document, settings: &[String]) -> Option<Document> {
        with_settings(state, settings)
            .map_err(|error| self.add(place, FaultKind::State(format!("this setting is refused: {error}"))))
            .ok()
    }

    fn play_number(&mut self, place: &str, task: &Task, number: &NumberTask, [start, present]: [&Document; 2]) {
        let place = format!("{place}.kind.number");
        let is_known = |name: &String| self.is_measured(name, &number.unit);
        if !number.quantity.as_ref().is_none_or(is_known) {
            return;
        }
        let state = if number.of == Of::Start { start } else { present };
        let Some(state) = self.made(&format!("{place}.set"), state, &number.set) else { return };
        let values = Quantities::of(&state);
        let Some(answer) = number.answer(&values) else { return self.add(&place, FaultKind::NoValue) };
        for (index, mistake) in number.mistakes.iter().enumerate() {
            let instead = match number.mistaken(mistake, Some(answer), &values) {
                None => Some(Instead::NoNumber),
                Some(found) => match check(task, &Answer::Number(found), &values).feedback {
                    Some(Feedback::Mistake(known)) if known == index => None,
                    Some(Feedback::Mistake(known)) => Some(Instead::Earlier(known)),
                    _ => Some(Instead::Right),
                },
            };
            if let Some(instead) = instead {
                self.add(&format!("{place}.mistakes[{index}]"), FaultKind::NoFeedback(instead));
            }
        }
    }

    /// Tries a goal; the state that its solution leads to.
    fn play_goal(&mut self, place: &str, task: &Task, goal: &Achieve, before: &Document) -> Option<Document> {
        let place = format!("{place}.kind.achieve");
        let conditions = goal.conditions.iter().chain(goal.attempts.iter().flat_map(|attempt| &attempt.when));
        let is_measured =
            conditions.into_iter().all(|condition| self.is_measured(&condition.quantity, &condition.unit));
        let solved = self.made(&format!("{place}.solution"), before, &goal.solution);
        if !is_measured || goal.conditions.is_empty() {
            return solved;
        }
        if check(task, &Answer::Bench, &Quantities::of(before)).is_right {
            self.add(&place, FaultKind::AlreadyReached);
        }
        for (index, attempt) in goal.attempts.iter().enumerate() {
            let place = format!("{place}.attempts[{index}]");
            let Some(state) = self.made(&format!("{place}.set"), before, &attempt.set) else { continue };
            let values = Quantities::of(&state);
            let verdict = check(task, &Answer::Bench, &values);
            let instead = match verdict.feedback {
                _ if verdict.is_right => Some(Instead::Right),
                Some(Feedback::Attempt(known)) if known == index => None,
                Some(Feedback::Attempt(known)) => Some(Instead::Earlier(known)),
                _ => Some(Instead::NotRecognised(failing(&attempt.when, &values))),
            };
            if let Some(instead) = instead {
                self.add(&place, FaultKind::NoFeedback(instead));
            }
        }
        if let Some(state) = &solved {
            let failing = failing(&goal.conditions, &Quantities::of(state));
            if !failing.is_empty() {
                self.add(&format!("{place}.solution"), FaultKind::NotReached(failing));
            }
        }
        solved
    }
}

/// The conditions that do not hold, with the values that there are.
fn failing(conditions: &[Condition], values: &Quantities) -> String {
    let goals = conditions_met(conditions, values);
    let failing = conditions.iter().zip(goals).filter(|(_, goal)| !goal.is_met);
    let told = failing.map(|(Condition { quantity, unit, .. }, goal)| match goal.value {
        Some(value) => format!("{quantity} is {value:.5} {unit}"),
        None => format!("{quantity} does not exist"),
    });
    told.collect::<Vec<_>>().join(", ")
}
