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
const MAX_VARIANTS: usize = 24;

/// Among so many students such are sought.
const STUDENTS: u32 = 240;

impl Audit<'_> {
    pub fn play(&mut self) {
        let lesson = self.lesson;
        let is_varied = lesson.steps.iter().any(|step| !step.vary.is_empty());
        let mut played = BTreeSet::new();
        let before = self.faults.len();
        for seed in 0..STUDENTS {
            if played.len() < MAX_VARIANTS && played.insert(variant(lesson, seed)) {
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

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use crate::sample::faults;

    /// The one thing that is wrong with a change.
    fn fault(pointer: &str, value: Value) -> String {
        let mut faults = faults(&[(pointer, value)]);
        assert_eq!(faults.len(), 1, "{faults:?}");
        faults.remove(0)
    }

    /// The same, which is wrong already for the first student.
    fn first(pointer: &str, value: Value) -> String {
        let fault = fault(pointer, value);
        fault.strip_suffix(" (for the student with seed 0)").unwrap_or_else(|| panic!("{fault}")).to_owned()
    }

    #[test]
    fn a_state_that_cannot_be_made_is_told() {
        let preset = first("/steps/0/start/preset", json!("none"));
        assert!(preset.starts_with("steps[0].start: unknown rig or case `none`;"), "{preset}");
        let other = first("/steps/0/start/preset", json!("table-6-row-1"));
        assert_eq!(other, "steps[0].start: the state is not one of the bench quadruple-tank");
        let link = first("/steps/0/start", json!({ "link": "https://example.org/#s=damaged" }));
        assert!(link.starts_with("steps[0].start: "), "{link}");
        let both = first("/steps/0/start/link", json!("#s=x"));
        assert_eq!(both, "steps[0].start: a start has either a `preset` or a `link`");
        let neither = first("/steps/0/start/preset", json!(null));
        assert_eq!(neither, "steps[0].start: a start has a `preset` or a `link`, which settings can change");
        let setting = first("/steps/0/start/set/0", json!("setup.valves[1]=4"));
        assert_eq!(setting, "steps[0].start: setup.valves[1]: 4 is outside 0 to 1");
        let path = first("/steps/0/vary/0/path", json!("setup.valve[0]"));
        assert!(path.starts_with("steps[0].start: setup.valve"), "{path}");
    }

    #[test]
    fn the_first_step_says_a_state() {
        let faults = faults(&[("/steps/0/start", json!(null)), ("/steps/0/vary", json!([]))]);
        assert_eq!(faults, ["steps[0].start: no step up to this one says a state of the bench"]);
    }

    #[test]
    fn settings_of_tasks_are_settings_of_the_bench() {
        for (pointer, place) in [
            ("/steps/0/tasks/1/kind/number/set", "steps[0].tasks[zero].kind.number.set"),
            ("/steps/1/tasks/0/kind/achieve/attempts/0/set", "steps[1].tasks[left].kind.achieve.attempts[0].set"),
        ] {
            let fault = first(pointer, json!(["setup.valves[0]=2"]));
            assert_eq!(fault, format!("{place}: this setting is refused: setup.valves[0]: 2 is outside 0 to 1"));
        }
        let solution = first("/steps/1/tasks/0/kind/achieve/solution", json!(["setup.none=2"]));
        assert!(
            solution.starts_with("steps[1].tasks[left].kind.achieve.solution: this setting is refused: setup.none: ")
        );
    }

    #[test]
    fn the_number_asked_for_exists() {
        let fault = faults(&[
            (
                "/steps/0/tasks/1/kind/number",
                json!({ "quantity": "rga.lambda11", "unit": "1", "tolerance": { "relative": 0.1 } }),
            ),
            ("/steps/0/tasks/1/kind/number/set", json!(["setup.valves[0]=0.5", "setup.valves[1]=0.5"])),
        ]);
        assert_eq!(
            fault,
            ["steps[0].tasks[zero].kind.number: the quantity has no value in this state (for the student with seed 0)"]
        );
    }

    #[test]
    fn a_mistake_that_does_not_get_its_feedback_is_told() {
        let mistakes = "steps[0].tasks[zero].kind.number.mistakes";
        let right = first("/steps/0/tasks/1/kind/number/mistakes/0/is", json!({ "times": 1.02 }));
        assert_eq!(right, format!("{mistakes}[0]: does not get its feedback: it is right"));
        let earlier = first("/steps/0/tasks/1/kind/number/mistakes/2/is", json!({ "times": -1.01 }));
        assert_eq!(
            earlier,
            format!(
                "{mistakes}[2]: does not get its feedback: entry 0 of the list, counted from 0, is recognised before"
            )
        );
        let none = faults(&[
            ("/steps/0/start/set/0", json!("setup.valves[1]=0.5")),
            ("/steps/0/vary", json!([])),
            ("/steps/0/start/set/-", json!("setup.valves[0]=0.5")),
        ]);
        assert!(
            none.contains(&format!("{mistakes}[2]: does not get its feedback: there is no such number in this state"))
        );
    }

    #[test]
    fn a_number_of_the_present_state_is_that_after_the_solution() {
        let mistake = json!([{ "is": { "value": 1.3 }, "feedback": { "en": "x", "es": "x" } }]);
        let fault = first("/steps/1/tasks/1/kind/number/mistakes", mistake);
        assert!(fault.ends_with("mistakes[0]: does not get its feedback: it is right"), "{fault}");
    }

    #[test]
    fn a_goal_is_not_reached_at_the_beginning() {
        let faults = faults(&[("/steps/1/tasks/0/kind/achieve/conditions/0/at_most", json!(10))]);
        let place = "steps[1].tasks[left].kind.achieve";
        let student = "(for the student with seed 0)";
        assert_eq!(faults[0], format!("{place}: the goal is reached before anything is done {student}"));
    }

    #[test]
    fn the_solution_reaches_the_goal() {
        let fault = first("/steps/1/tasks/0/kind/achieve/solution", json!(["setup.valves[0]=0.95"]));
        let place = "steps[1].tasks[left].kind.achieve.solution";
        assert_eq!(fault, format!("{place}: the solution does not reach the goal: valves.gamma1 is 95.00000 %"));
    }

    #[test]
    fn an_attempt_that_does_not_get_its_feedback_is_told() {
        let attempts = "steps[1].tasks[left].kind.achieve.attempts";
        let right = first(
            "/steps/1/tasks/0/kind/achieve/attempts/0/set",
            json!(["setup.valves[0]=0.7", "setup.valves[1]=0.6"]),
        );
        assert_eq!(right, format!("{attempts}[0]: does not get its feedback: it is right"));
        let unknown = first("/steps/1/tasks/0/kind/achieve/attempts/0/set", json!(["setup.valves[0]=0.2"]));
        assert_eq!(
            unknown,
            format!("{attempts}[0]: does not get its feedback: it is not recognised: valves.sum is 0.60000 1")
        );
        let second = json!({
            "set": ["setup.valves[0]=0.5", "setup.valves[1]=0.49"],
            "when": [{ "quantity": "valves.gamma1", "unit": "1", "at_least": 0.4 }],
            "feedback": { "en": "x", "es": "x" }
        });
        let earlier = first("/steps/1/tasks/0/kind/achieve/attempts/-", second);
        assert!(
            earlier.starts_with(&format!("{attempts}[1]: does not get its feedback: entry 0 of the list")),
            "{earlier}"
        );
    }

    #[test]
    fn every_value_that_varies_is_tried() {
        let fault = fault("/steps/0/vary/0/among", json!([0.3, 0.35, 0.4, 0.45, 0.85]));
        let (place, seed) = fault.split_once(" (for the student with seed ").unwrap_or_else(|| panic!("{fault}"));
        assert!(place.contains("steps[") && seed != "0)", "{fault}");
    }

    #[test]
    fn a_lesson_for_all_students_alike_names_none() {
        let faults = faults(&[("/steps/0/vary", json!([])), ("/steps/1/tasks/0/kind/achieve/solution", json!([]))]);
        assert_eq!(faults, ["steps[1].tasks[left].kind.achieve: the goal is reached before anything is done"]);
    }
}
