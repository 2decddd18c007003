use super::visitor::{Path, Presence, Step, Visitor};
use crate::ScenarioError;
use crate::limits::Limits;

/// Below this numbers are written with an exponent. None is so large that it would need one.
const SMALL: f64 = 1e-5;

/// Writes JSON with an indentation of two.
#[derive(Default)]
pub struct Writer {
    pub text: String,
    /// Of the values on the way to the present one.
    open: Vec<Open>,
    /// Of the present one.
    here: Open,
    /// Brackets that are open.
    depth: usize,
}

/// What of a value has been written.
#[derive(Default)]
struct Open {
    /// It is the content of this choice, and nothing of it is written yet.
    choice: Option<&'static str>,
    /// What closes the map around the content of a choice.
    is_wrapped: bool,
    /// What closes the value.
    bracket: Option<char>,
}

impl Writer {
    /// Begins the next entry of the present value.
    fn entry(&mut self, opening: char, closing: char) {
        if self.here.bracket.is_some() {
            self.text.push(',');
        } else {
            self.value(&opening.to_string());
            self.here.bracket = Some(closing);
            self.depth += 1;
        }
        self.line();
    }

    fn line(&mut self) {
        self.text.push('\n');
        for _ in 0..self.depth {
            self.text.push_str("  ");
        }
    }

    fn close(&mut self, bracket: char) {
        self.depth -= 1;
        self.line();
        self.text.push(bracket);
    }

    /// The present value, or what it begins with.
    fn value(&mut self, text: &str) {
        if let Some(name) = self.here.choice.take() {
            self.text.push('{');
            self.depth += 1;
            self.line();
            self.key(name);
            self.here.is_wrapped = true;
        }
        self.text.push_str(text);
    }

    fn key(&mut self, name: &str) {
        self.name(name);
        self.text.push_str(": ");
    }

    /// Names in documents are letters, digits, `-` and `_`.
    fn name(&mut self, name: &str) {
        self.text.push('"');
        self.text.push_str(name);
        self.text.push('"');
    }
}

impl Visitor for Writer {
    fn enter(&mut self, _: &Path, step: Step) -> Result<bool, ScenarioError> {
        let mut choice = None;
        match step {
            Step::Field(_, Presence::Hidden) | Step::Choice(_, false) => return Ok(false),
            Step::Field(name, _) => {
                self.entry('{', '}');
                self.key(name);
            }
            Step::Item(_) => self.entry('[', ']'),
            Step::Choice(name, true) => {
                self.value("");
                choice = Some(name);
            }
        }
        self.open.push(std::mem::take(&mut self.here));
        self.here.choice = choice;
        Ok(true)
    }

    fn leave(&mut self, _: &Path) -> Result<(), ScenarioError> {
        if let Some(bracket) = self.here.bracket {
            self.close(bracket);
        }
        if let Some(name) = self.here.choice {
            self.name(name);
        }
        if self.here.is_wrapped {
            self.close('}');
        }
        self.here = self.open.pop().unwrap_or_default();
        Ok(())
    }

    /// The fewest digits that bring the number back.
    fn number(&mut self, _: &Path, &mut value: &mut f64, _: Limits) -> Result<(), ScenarioError> {
        let is_plain = value == 0.0 || value.abs() >= SMALL;
        let mut text = if is_plain { value.to_string() } else { format!("{value:e}") };
        if is_plain && !text.contains('.') {
            text.push_str(".0");
        }
        self.value(&text);
        Ok(())
    }

    fn whole(&mut self, _: &Path, value: &mut u32, _: Limits) -> Result<(), ScenarioError> {
        self.value(&value.to_string());
        Ok(())
    }

    fn flag(&mut self, _: &Path, value: &mut bool) -> Result<(), ScenarioError> {
        self.value(if *value { "true" } else { "false" });
        Ok(())
    }

    fn length(&mut self, _: &Path, count: usize, _: usize, _: usize) -> Result<usize, ScenarioError> {
        if count == 0 {
            self.value("[]");
        }
        Ok(count)
    }

    fn option(&mut self, _: &Path, is_some: bool) -> Result<bool, ScenarioError> {
        if !is_some {
            self.value("null");
        }
        Ok(is_some)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::limits;

    fn written(mut value: f64) -> String {
        let mut writer = Writer::default();
        assert!(writer.number(&Path::default(), &mut value, limits::VALVE).is_ok());
        writer.text
    }

    #[test]
    fn numbers_are_those_of_any_json() {
        for value in [0.0, -0.0, 1.0, -2.5, 1e-5, 9.999_999_999_999_999e-6, 9_999_999_999_999_998.0, 1e-300] {
            assert_eq!(written(value), serde_json::to_string(&value).unwrap());
        }
        for power in -30..13 {
            for digits in (1..1000).step_by(7) {
                let value = f64::from(digits) * 10_f64.powi(power);
                assert_eq!(written(value), serde_json::to_string(&value).unwrap());
                // Where two numbers of the fewest digits are equally near, either will do.
                let odd = value / 0.7;
                let text = written(odd);
                assert_eq!(text.parse(), Ok(odd), "{text}");
                assert_eq!(text.len(), serde_json::to_string(&odd).unwrap().len(), "{text}");
            }
        }
    }
}
