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
                self.known_quantity(&format!("{place}.mistakes[{index}].is"), name);
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
        self.known_quantity(place, name);
        if let Some(Err(error)) = self.unit_of(name).map(|si| in_unit(1.0, si, unit)) {
            self.add(place, FaultKind::Unit(error));
        }
    }

    /// Of a bench that is unknown all names are.
    fn known_quantity(&mut self, place: &str, name: &str) {
        if bench_names(&self.lesson.bench).is_some() && self.unit_of(name).is_none() {
            self.unknown(place, Named::Quantity, name, &[]);
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

    #[test]
    fn the_small_lesson_has_no_fault() {
        assert_eq!(faults(&[]), [""; 0]);
    }

    #[test]
    fn names_that_lead_nowhere_are_told_with_those_that_there_are() {
        let of = |pointer: &str, name: &str| fault(pointer, json!([name]));
        assert_eq!(of("/prerequisites", "none"), "prerequisites[0]: unknown lesson `none`");
        let cards = "there are process, valves, zeros, rga, controller, experiment, why, responses";
        assert_eq!(of("/steps/1/panels", "valve"), format!("steps[1].panels: unknown card `valve`; {cards}"));
        assert_eq!(of("/steps/0/reveal", "none"), format!("steps[0].reveal: unknown card `none`; {cards}"));
        let controls = "there are preset, valves, voltages, pairing, gains, sampling, experiment";
        assert_eq!(
            of("/steps/0/lock", "zeros"),
            format!("steps[0].lock: unknown group of controls `zeros`; {controls}")
        );
    }

    #[test]
    fn what_is_there_twice_is_told() {
        let task = json!({ "id": "guess", "question": { "en": "?", "es": "?" }, "kind": { "explain": { "model": { "en": "x", "es": "x" } } } });
        let twice = faults(&[("/steps/1/tasks/-", task)]);
        assert_eq!(
            twice,
            ["steps[0].tasks[guess]: `guess` is there twice", "steps[1].tasks[guess]: `guess` is there twice"]
        );
        assert_eq!(fault("/languages", json!(["en", "en"])), "languages: `en` is there twice");
        assert_eq!(fault("/steps/1/panels", json!(["zeros", "zeros"])), "steps[1].panels: `zeros` is there twice");
    }

    #[test]
    fn only_cards_that_are_shown_are_revealed() {
        let fault = fault("/steps/0/reveal", json!(["why"]));
        assert_eq!(fault, "steps[0].reveal: `why` is revealed, but is not among the panels of the step");
    }

    #[test]
    fn numbers_vary_in_a_step_with_a_start_and_among_some() {
        let vary = json!([{ "path": "setup.valves[0]", "among": [0.3] }]);
        assert_eq!(fault("/steps/1/vary", vary), "steps[1].vary: only a step with a `start` can vary a number");
        let among = faults(&[("/steps/0/vary/0/among", json!([]))]);
        assert_eq!(among[0], "steps[0].vary[0].among: 0 entries, at least 1 are needed");
    }

    #[test]
    fn marked_tasks_and_they_alone_have_points() {
        let points = "`choose`, `number`, `order` and `achieve` have points; `predict` and `explain` have 0";
        assert_eq!(fault("/steps/0/tasks/0/points", json!(1)), format!("steps[0].tasks[guess].points: {points}"));
        assert_eq!(fault("/steps/1/tasks/0/points", json!(0)), format!("steps[1].tasks[left].points: {points}"));
    }

    #[test]
    fn a_choice_has_right_and_wrong_options() {
        for correct in [json!([false, false]), json!([true, true])] {
            let faults = faults(&[
                ("/steps/1/tasks/2/kind/choose/options/0/correct", correct[0].clone()),
                ("/steps/1/tasks/2/kind/choose/options/1/correct", correct[1].clone()),
            ]);
            assert_eq!(faults, ["steps[1].tasks[why].kind.choose.options: there must be right and wrong options"]);
        }
    }

    #[test]
    fn there_is_something_to_predict_to_order_and_to_reach() {
        let text = json!({ "en": "x", "es": "x" });
        let options = fault("/steps/0/tasks/0/kind/predict/options", json!([text]));
        assert_eq!(options, "steps[0].tasks[guess].kind.predict.options: 1 entries, at least 2 are needed");
        let items = fault("/steps/1/tasks/3/kind/order/items", json!([text]));
        assert_eq!(items, "steps[1].tasks[order].kind.order.items: 1 entries, at least 2 are needed");
        let conditions = fault("/steps/1/tasks/0/kind/achieve/conditions", json!([]));
        assert_eq!(conditions, "steps[1].tasks[left].kind.achieve.conditions: 0 entries, at least 1 are needed");
    }

    #[test]
    fn a_number_is_a_quantity_or_a_value_with_a_tolerance() {
        let number = "steps[0].tasks[zero].kind.number";
        let both = fault("/steps/0/tasks/1/kind/number/value", json!(0.1));
        assert_eq!(both, format!("{number}: a number has either a `quantity` or a `value`"));
        let none = faults(&[("/steps/0/tasks/1/kind/number/quantity", json!(null))]);
        assert_eq!(none[0], both);
        for tolerance in [json!({ "relative": 0 }), json!({ "absolute": -1 })] {
            let faults = faults(&[("/steps/0/tasks/1/kind/number/tolerance", tolerance)]);
            assert_eq!(faults[0], format!("{number}.tolerance: the tolerance must be more than 0"));
        }
    }

    #[test]
    fn quantities_and_their_units_are_known() {
        let number = "steps[0].tasks[zero].kind.number";
        let quantity = fault("/steps/0/tasks/1/kind/number/quantity", json!("zero.right"));
        assert_eq!(quantity, format!("{number}.quantity: unknown quantity `zero.right`"));
        let unit = fault("/steps/0/tasks/1/kind/number/unit", json!("cm"));
        assert_eq!(
            unit,
            format!("{number}.quantity: the unit `cm` does not fit a quantity in `1/s`, but `1/s`, `1/min`")
        );
        let mistake = faults(&[("/steps/0/tasks/1/kind/number/mistakes/1/is/quantity", json!("zero.left"))]);
        assert_eq!(mistake[0], format!("{number}.mistakes[1].is: unknown quantity `zero.left`"));
        let goal = "steps[1].tasks[left].kind.achieve";
        let condition = fault("/steps/1/tasks/0/kind/achieve/conditions/1/quantity", json!("none"));
        assert_eq!(condition, format!("{goal}.conditions[1]: unknown quantity `none`"));
        let when = fault("/steps/1/tasks/0/kind/achieve/attempts/0/when/0/unit", json!("s"));
        assert_eq!(
            when,
            format!("{goal}.attempts[0].when[0]: the unit `s` does not fit a quantity in `1`, but `1`, `%`")
        );
    }

    #[test]
    fn conditions_have_bounds_between_which_something_is() {
        let goal = "steps[1].tasks[left].kind.achieve";
        let none = fault("/steps/1/tasks/0/kind/achieve/conditions/1/at_most", json!(null));
        assert_eq!(none, format!("{goal}.conditions[1]: a condition needs `at_least`, `at_most` or both"));
        let nothing = faults(&[("/steps/1/tasks/0/kind/achieve/conditions/1/at_least", json!(91))]);
        assert_eq!(nothing[0], format!("{goal}.conditions[1]: `at_least` is more than `at_most`"));
    }
}
