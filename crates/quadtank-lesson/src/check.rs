use quadtank_scenario::Quantities;
use serde::{Deserialize, Serialize};

use super::{Achieve, Condition, Mistake, MistakeKind, NumberTask, Task, TaskKind, Text, in_unit};

/// What a student answers. A goal on the bench is answered by the state of the bench, which [`Values`] tell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Answer {
    /// An option, from 0.
    Choice(usize),
    /// A number in the unit of the task.
    Number(f64),
    /// The items in the order of the student.
    Order(Vec<usize>),
    /// Free text.
    Text(String),
    /// The bench as it stands.
    Bench,
}

/// Reads quantities of a state: value and SI unit.
pub trait Values {
    /// The value of a quantity and its unit; no value where the state has none.
    fn value(&self, name: &str) -> Option<(f64, &'static str)>;

    /// The value in another unit.
    fn shown(&self, name: &str, unit: &str) -> Option<f64> {
        let (value, si) = self.value(name)?;
        in_unit(value, si, unit).ok()
    }
}

impl Values for Quantities {
    fn value(&self, name: &str) -> Option<(f64, &'static str)> {
        let unit = self.rows().into_iter().find(|row| row.name == name)?.unit;
        Some((Quantities::value(self, name).ok()??, unit))
    }
}

/// Which text is said about an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Feedback {
    /// That of the chosen option.
    Option(usize),
    /// That of a known mistake.
    Mistake(usize),
    /// That of a typical attempt.
    Attempt(usize),
    /// The model answer.
    Model,
}

/// What an answer is worth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Verdict {
    /// Whether it is right; an answer that is not marked always is.
    pub is_right: bool,
    /// What is said about it, if the lesson says something.
    pub feedback: Option<Feedback>,
}

/// A condition of a goal in a state.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Goal {
    /// Whether it holds.
    pub is_met: bool,
    /// The value in the unit of the condition, if there is one.
    pub value: Option<f64>,
}

/// Marks an answer to a task.
///
/// `values` are those of the state that the task is about: of an `achieve` the bench as it stands, of a `number` the state that it
/// names (`of`, `set`). An answer of the wrong kind is wrong.
pub fn check(task: &Task, answer: &Answer, values: &impl Values) -> Verdict {
    let said = |is_right, feedback| Verdict { is_right, feedback };
    match (&task.kind, answer) {
        (TaskKind::Predict(predict), Answer::Choice(index)) => said(*index < predict.options.len(), None),
        (TaskKind::Choose(choose), Answer::Choice(index)) => match choose.options.get(*index) {
            Some(option) => said(option.correct, Some(Feedback::Option(*index))),
            None => said(false, None),
        },
        (TaskKind::Number(number), Answer::Number(found)) => number.check(*found, values),
        (TaskKind::Achieve(achieve), Answer::Bench) => achieve.check(values),
        (TaskKind::Order(order), Answer::Order(found)) => said(found.iter().copied().eq(0..order.items.len()), None),
        (TaskKind::Explain(_), Answer::Text(text)) => said(!text.trim().is_empty(), Some(Feedback::Model)),
        _ => said(false, None),
    }
}

/// How far each condition of a goal is met.
pub fn goals(achieve: &Achieve, values: &impl Values) -> Vec<Goal> {
    conditions_met(&achieve.conditions, values)
}

/// How far each of some conditions is met.
pub fn conditions_met(conditions: &[Condition], values: &impl Values) -> Vec<Goal> {
    conditions.iter().map(|condition| condition.goal(values)).collect()
}

/// The text of a feedback.
pub fn feedback_text(task: &Task, feedback: Feedback) -> Option<&Text> {
    match (&task.kind, feedback) {
        (TaskKind::Choose(choose), Feedback::Option(index)) => choose.options.get(index).map(|option| &option.feedback),
        (TaskKind::Number(number), Feedback::Mistake(index)) => number.mistakes.get(index).map(|known| &known.feedback),
        (TaskKind::Achieve(goal), Feedback::Attempt(index)) => goal.attempts.get(index).map(|known| &known.feedback),
        (TaskKind::Explain(explain), Feedback::Model) => Some(&explain.model),
        _ => None,
    }
}

impl NumberTask {
    /// The right number in the unit of the task; none where the state has none.
    pub fn answer(&self, values: &impl Values) -> Option<f64> {
        match &self.quantity {
            Some(name) => values.shown(name, &self.unit),
            None => self.value,
        }
    }

    fn check(&self, found: f64, values: &impl Values) -> Verdict {
        let answer = self.answer(values);
        if answer.is_some_and(|answer| self.tolerance.allows(found, answer)) {
            return Verdict { is_right: true, feedback: None };
        }
        let is_this = |mistake: &Mistake| {
            self.mistaken(mistake, answer, values).is_some_and(|wrong| self.tolerance.allows(found, wrong))
        };
        Verdict { is_right: false, feedback: self.mistakes.iter().position(is_this).map(Feedback::Mistake) }
    }

    /// The wrong number that a mistake leads to, in the unit of the task; none where there is no such number.
    pub fn mistaken(&self, mistake: &Mistake, answer: Option<f64>, values: &impl Values) -> Option<f64> {
        let wrong = match &mistake.is {
            MistakeKind::Times(factor) => answer? * factor,
            MistakeKind::Inverse(dividend) => dividend / answer?,
            MistakeKind::MinusFrom(whole) => whole - answer?,
            MistakeKind::Value(value) => *value,
            // What is read from the wrong line often has another unit.
            MistakeKind::Quantity(name) => values.shown(name, &self.unit).or_else(|| Some(values.value(name)?.0))?,
        };
        // There is no inverse of 0.
        wrong.is_finite().then_some(wrong)
    }
}

impl Achieve {
    fn check(&self, values: &impl Values) -> Verdict {
        if self.conditions.iter().all(|condition| condition.goal(values).is_met) {
            return Verdict { is_right: true, feedback: None };
        }
        let is_this = |attempt: &super::Attempt| attempt.when.iter().all(|condition| condition.goal(values).is_met);
        Verdict { is_right: false, feedback: self.attempts.iter().position(is_this).map(Feedback::Attempt) }
    }
}

impl Condition {
    fn goal(&self, values: &impl Values) -> Goal {
        let value = values.shown(&self.quantity, &self.unit);
        let is_met = value.is_some_and(|value| {
            self.at_least.is_none_or(|least| value >= least) && self.at_most.is_none_or(|most| value <= most)
        });
        Goal { is_met, value }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use serde_json::json;

    use super::*;
    use crate::sample::{Given, task};
    use crate::{Tolerance, Tongue};

    const ZEROS: Given = Given(&[("zero.rightmost", 0.02, "1/s"), ("zero.leftmost", -0.04, "1/s")]);

    fn number(value: f64) -> Verdict {
        check(&task("zero"), &Answer::Number(value), &ZEROS)
    }

    fn said(is_right: bool, feedback: Option<Feedback>) -> Verdict {
        Verdict { is_right, feedback }
    }

    fn kind(task: &mut Task) -> &mut NumberTask {
        let TaskKind::Number(number) = &mut task.kind else { panic!("{} asks for no number", task.id) };
        number
    }

    #[test]
    fn a_prediction_is_right_whatever_it_is() {
        for (choice, is_right) in [(0, true), (1, true), (2, false)] {
            assert_eq!(check(&task("guess"), &Answer::Choice(choice), &ZEROS), said(is_right, None));
        }
    }

    #[test]
    fn an_option_gets_its_feedback_right_or_wrong() {
        let why = task("why");
        assert_eq!(check(&why, &Answer::Choice(0), &ZEROS), said(false, Some(Feedback::Option(0))));
        assert_eq!(check(&why, &Answer::Choice(1), &ZEROS), said(true, Some(Feedback::Option(1))));
        assert_eq!(check(&why, &Answer::Choice(2), &ZEROS), said(false, None));
        let text = feedback_text(&why, Feedback::Option(1)).unwrap();
        assert_eq!((text.shown(Tongue::En), text.shown(Tongue::Es)), ("Yes.", "Sí."));
        assert_eq!(feedback_text(&why, Feedback::Option(2)), None);
        assert_eq!(feedback_text(&why, Feedback::Mistake(0)), None);
    }

    #[test]
    fn a_number_is_right_within_its_tolerance_and_at_its_edge() {
        for right in [0.02, 0.0194, 0.0206] {
            assert_eq!(number(right), said(true, None), "{right}");
        }
        for wrong in [0.0193, 0.0207, 0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(!number(wrong).is_right, "{wrong}");
        }
    }

    #[test]
    fn each_mistake_gets_its_feedback() {
        assert_eq!(number(-0.02), said(false, Some(Feedback::Mistake(0))));
        assert_eq!(number(-0.0405), said(false, Some(Feedback::Mistake(1))));
        assert_eq!(number(50.0), said(false, Some(Feedback::Mistake(2))));
        assert_eq!(number(0.1), said(false, None));
        assert_eq!(feedback_text(&task("zero"), Feedback::Mistake(2)).unwrap().shown(Tongue::En), "That is a time.");
    }

    #[test]
    fn every_kind_of_mistake_is_a_number_in_the_unit_of_the_task() {
        let values = Given(&[("a", 0.125, "m"), ("b", 0.2, "m"), ("time", 60.0, "s")]);
        let mut asked = task("zero");
        kind(&mut asked).quantity = Some("a".to_owned());
        kind(&mut asked).unit = "cm".to_owned();
        let mistaken = |is: serde_json::Value| {
            let mistake: Mistake = serde_json::from_value(json!({ "is": is, "feedback": {} })).unwrap();
            let TaskKind::Number(number) = &asked.kind else { unreachable!() };
            number.mistaken(&mistake, number.answer(&values), &values)
        };
        assert_eq!(mistaken(json!({ "times": -1 })), Some(-12.5));
        assert_eq!(mistaken(json!({ "inverse": 100 })), Some(8.0));
        assert_eq!(mistaken(json!({ "minus_from": 20 })), Some(7.5));
        assert_eq!(mistaken(json!({ "value": 3 })), Some(3.0));
        assert_eq!(mistaken(json!({ "quantity": "b" })), Some(20.0));
        assert_eq!(
            mistaken(json!({ "quantity": "time" })),
            Some(60.0),
            "in its own unit where that of the task fits not"
        );
        assert_eq!(mistaken(json!({ "quantity": "c" })), None);
    }

    #[test]
    fn the_inverse_of_zero_is_no_mistake_that_anything_is() {
        let values = Given(&[("zero.rightmost", 0.0, "1/s")]);
        assert_eq!(check(&task("zero"), &Answer::Number(7.0), &values), said(false, None));
    }

    #[test]
    fn a_number_is_asked_for_in_its_unit() {
        let mut asked = task("zero");
        kind(&mut asked).unit = "1/min".to_owned();
        assert!(check(&asked, &Answer::Number(1.2), &ZEROS).is_right);
        assert!(!check(&asked, &Answer::Number(0.02), &ZEROS).is_right);
    }

    #[test]
    fn a_number_that_the_state_does_not_have_is_never_right_and_a_given_one_needs_no_state() {
        let none = Given(&[]);
        assert_eq!(check(&task("zero"), &Answer::Number(0.02), &none), said(false, None));
        let mut asked = task("zero");
        (kind(&mut asked).quantity, kind(&mut asked).value) = (None, Some(0.5));
        kind(&mut asked).tolerance = Tolerance::Absolute(0.1);
        assert!(check(&asked, &Answer::Number(0.6), &none).is_right);
        assert!(!check(&asked, &Answer::Number(0.61), &none).is_right);
    }

    #[test]
    fn a_goal_is_reached_when_all_conditions_hold_in_their_units() {
        let left = task("left");
        let at = |zero: f64, gamma: f64, sum: f64| {
            let values = [("zero.rightmost", zero, "1/s"), ("valves.gamma1", gamma, "1"), ("valves.sum", sum, "1")];
            check(&left, &Answer::Bench, &Given(&values))
        };
        assert_eq!(at(-0.01 / 60.0, 0.9, 1.2), said(true, None));
        assert_eq!(at(-0.01, 0.91, 1.2), said(false, None));
        assert_eq!(at(0.001, 0.5, 0.95), said(false, Some(Feedback::Attempt(0))));
        assert_eq!(at(0.001, 0.3, 0.5), said(false, None));
        assert_eq!(feedback_text(&left, Feedback::Attempt(0)).unwrap().shown(Tongue::Es), "Casi.");
    }

    #[test]
    fn a_goal_shows_how_far_each_condition_is_met_and_a_missing_quantity_meets_none() {
        let TaskKind::Achieve(goal) = task("left").kind else { panic!() };
        let found = goals(&goal, &Given(&[("valves.gamma1", 0.25, "1")]));
        assert_eq!(found, [Goal { is_met: false, value: None }, Goal { is_met: true, value: Some(25.0) }]);
    }

    #[test]
    fn items_are_right_in_one_order_only() {
        let order = task("order");
        for (found, is_right) in [
            (vec![0, 1, 2], true),
            (vec![0, 2, 1], false),
            (vec![0, 1], false),
            (vec![0, 1, 2, 3], false),
            (vec![], false),
        ] {
            assert_eq!(check(&order, &Answer::Order(found.clone()), &ZEROS), said(is_right, None), "{found:?}");
        }
    }

    #[test]
    fn own_words_are_taken_and_answered_by_the_model() {
        let words = |text: &str| check(&task("words"), &Answer::Text(text.to_owned()), &ZEROS);
        assert_eq!(words("Because."), said(true, Some(Feedback::Model)));
        assert!(!words(" \n").is_right);
        let task = task("words");
        let model = feedback_text(&task, Feedback::Model).unwrap();
        assert_eq!(model.shown(Tongue::En), "Water takes the detour.");
    }

    #[test]
    fn an_answer_of_another_kind_is_wrong() {
        let answers = [
            (Answer::Choice(0), ["guess", "why"].as_slice()),
            (Answer::Number(0.02), &["zero", "sum"]),
            (Answer::Order(vec![0, 1, 2]), &["order"]),
            (Answer::Text("x".to_owned()), &["words"]),
            (Answer::Bench, &["left"]),
        ];
        for (_, task) in crate::sample::lesson().tasks() {
            for (answer, suited) in &answers {
                if !suited.contains(&task.id.as_str()) {
                    assert_eq!(check(task, answer, &ZEROS), said(false, None), "{} {answer:?}", task.id);
                }
            }
        }
    }

    #[test]
    fn answers_are_written_as_the_command_line_reads_them() {
        for (answer, json) in [
            (Answer::Choice(1), json!({ "choice": 1 })),
            (Answer::Number(0.5), json!({ "number": 0.5 })),
            (Answer::Order(vec![1, 0]), json!({ "order": [1, 0] })),
            (Answer::Text("ü".to_owned()), json!({ "text": "ü" })),
        ] {
            assert_eq!(serde_json::to_value(&answer).unwrap(), json);
            assert_eq!(serde_json::from_value::<Answer>(json).unwrap(), answer);
        }
    }

    proptest! {
        #[test]
        fn no_number_is_right_and_a_mistake_at_once(found in any::<f64>(), zero in any::<f64>()) {
            let values = [("zero.rightmost", zero, "1/s"), ("zero.leftmost", -0.04, "1/s")];
            let verdict = check(&task("zero"), &Answer::Number(found), &Given(&values));
            prop_assert!(!verdict.is_right || verdict.feedback.is_none());
            prop_assert!(!verdict.is_right || (found.is_finite() && zero.is_finite()));
        }
    }
}
