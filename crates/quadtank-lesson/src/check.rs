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
            MistakeKind::Quantity(name) => values.shown(name, &self.unit)?,
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
