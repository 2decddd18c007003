use serde::{Deserialize, Serialize};

use super::Text;

/// What a student is asked.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Task {
    /// Name in reports, unique in the lesson.
    #[cfg_attr(feature = "schema", schemars(regex(pattern = "^[a-z0-9-]{1,40}$")))]
    pub id: String,
    /// The question.
    pub question: Text,
    /// What a right answer at once, without hints, is worth.
    #[serde(default)]
    #[cfg_attr(feature = "schema", schemars(range(max = 100)))]
    pub points: u32,
    /// Hints, each of which costs a point.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub hints: Vec<Text>,
    /// How it is answered.
    pub kind: TaskKind,
}

/// How a task is answered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum TaskKind {
    /// By committing to an option; recorded, not marked.
    Predict(Predict),
    /// By an option.
    Choose(Choose),
    /// By a number.
    Number(NumberTask),
    /// By bringing the bench into a state.
    Achieve(Achieve),
    /// By putting items in order.
    Order(Order),
    /// By free text; recorded, not marked.
    Explain(Explain),
}

/// A prediction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Predict {
    /// What can be predicted.
    pub options: Vec<Text>,
}

/// A choice between options.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Choose {
    /// The options, of which one is chosen.
    pub options: Vec<Choice>,
}

/// An option of a choice.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Choice {
    /// What it says.
    pub text: Text,
    /// Whether it is right.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub correct: bool,
    /// What is said to who chooses it.
    pub feedback: Text,
}

/// A number to read or to calculate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct NumberTask {
    /// The quantity that is asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub quantity: Option<String>,
    /// The number that is asked for, in `unit`, where it follows from no state.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// Of which state the quantity is.
    #[serde(default)]
    pub of: Of,
    /// Settings that this state gets before.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub set: Vec<String>,
    /// The unit beside the field.
    pub unit: String,
    /// How far the answer may be off.
    pub tolerance: Tolerance,
    /// Wrong answers that are known.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub mistakes: Vec<Mistake>,
}

/// A state of the bench.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Of {
    /// That with which the step begins.
    #[default]
    Start,
    /// The present one.
    Present,
}

/// How far a number may be off.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Tolerance {
    /// By this part of the answer.
    Relative(f64),
    /// By this much, in the unit of the task.
    Absolute(f64),
}

impl Tolerance {
    /// Whether `found` is close enough to `expected`.
    pub fn allows(self, found: f64, expected: f64) -> bool {
        if !expected.is_finite() {
            return false;
        }
        // The last digit of a decimal fraction is rounded, so that a number at the very edge is inside.
        let rounding = 1e-9 * expected.abs();
        (found - expected).abs()
            <= rounding
                + match self {
                    Self::Relative(part) => part * expected.abs(),
                    Self::Absolute(most) => most,
                }
    }
}

/// A wrong number that is known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Mistake {
    /// Which number it is.
    pub is: MistakeKind,
    /// What is said to who answers so.
    pub feedback: Text,
}

/// How a wrong number comes about.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum MistakeKind {
    /// The answer times this: a sign, 2π, a unit.
    Times(f64),
    /// This, divided by the answer.
    Inverse(f64),
    /// This, minus the answer.
    MinusFrom(f64),
    /// This number, in the unit of the task.
    Value(f64),
    /// Another quantity: in the unit of the task where that fits it, else in its own.
    Quantity(String),
}

/// A goal to reach on the bench.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Achieve {
    /// What has to hold, all at once.
    pub conditions: Vec<Condition>,
    /// Settings that reach it from the state in which the task begins.
    pub solution: Vec<String>,
    /// Typical attempts that do not.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub attempts: Vec<Attempt>,
}

/// What has to hold for a quantity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Condition {
    /// What it is called; an attempt needs none.
    #[serde(default)]
    pub label: Text,
    /// The quantity.
    pub quantity: String,
    /// The unit in which it is shown.
    pub unit: String,
    /// Least value, in `unit`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_least: Option<f64>,
    /// Largest value, in `unit`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_most: Option<f64>,
}

/// A typical attempt that does not reach the goal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Attempt {
    /// Its settings.
    pub set: Vec<String>,
    /// By what it is recognised, all at once.
    pub when: Vec<Condition>,
    /// What is said to who tries so.
    pub feedback: Text,
}

/// Items to put in order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Order {
    /// The items in the right order.
    pub items: Vec<Text>,
}

/// A question that is answered in the student's own words.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Explain {
    /// An answer of the teacher, shown after that of the student.
    pub model: Text,
}

impl TaskKind {
    /// Whether answers are marked.
    pub fn is_marked(&self) -> bool {
        !matches!(self, Self::Predict(_) | Self::Explain(_))
    }

    /// Its lists with their lengths.
    pub(super) fn counts(&self) -> impl Iterator<Item = (&'static str, usize)> {
        let counts = match self {
            Self::Predict(predict) => vec![("predict.options", predict.options.len())],
            Self::Choose(choose) => vec![("choose.options", choose.options.len())],
            Self::Number(number) => vec![("number.mistakes", number.mistakes.len())],
            Self::Achieve(goal) => vec![
                ("achieve.conditions", goal.conditions.len()),
                ("achieve.attempts", goal.attempts.len()),
                ("achieve.attempts.when", goal.attempts.iter().map(|attempt| attempt.when.len()).max().unwrap_or(0)),
            ],
            Self::Order(order) => vec![("order.items", order.items.len())],
            Self::Explain(_) => Vec::new(),
        };
        counts.into_iter()
    }

    /// Whether a wrong answer costs a point.
    pub fn counts_attempts(&self) -> bool {
        matches!(self, Self::Choose(_) | Self::Number(_) | Self::Order(_))
    }
}
