use serde::{Deserialize, Serialize};

use super::ScenarioError;

/// What an experiment is called, and a note on it. Both are for people: nothing is computed from them.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Label {
    /// Name, of at most 80 characters.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Note, of at most 500 characters.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub note: String,
}

impl Label {
    /// Most characters of a name.
    pub const MAX_NAME: usize = 80;
    /// Most characters of a note.
    pub const MAX_NOTE: usize = 500;

    /// Whether there is neither name nor note.
    pub const fn is_empty(&self) -> bool {
        self.name.is_empty() && self.note.is_empty()
    }

    /// Checks the lengths.
    ///
    /// # Errors
    /// [`ScenarioError::TextTooLong`] for the first text that is longer than allowed.
    pub(crate) fn check(&self) -> Result<(), ScenarioError> {
        check_length("label.name", &self.name, Self::MAX_NAME)?;
        check_length("label.note", &self.note, Self::MAX_NOTE)
    }
}

/// Checks that a text has at most `max` characters.
///
/// # Errors
/// [`ScenarioError::TextTooLong`] with the field and the length.
pub(crate) fn check_length(field: &str, text: &str, max: usize) -> Result<(), ScenarioError> {
    let length = text.chars().count();
    if length > max {
        return Err(ScenarioError::TextTooLong { field: field.to_owned(), length, max });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        BenchDocument, Scenario, document_from_link, from_json, level_loop, model_free, to_json, to_link, tuning,
    };

    fn comes_back<D: BenchDocument + std::fmt::Debug>() {
        let mut document = D::default();
        assert!(!to_json(&document).unwrap().contains("label"), "a document without a name is what it always was");
        document.label_mut().name = "Ensaio nº 3: γ₁ = 0,7 <b>".to_owned();
        document.label_mut().note = "Two\nlines".to_owned();
        let read = crate::document_from_json(&to_json(&document).unwrap()).unwrap();
        assert_eq!(D::try_from(read).unwrap(), document);
        assert_eq!(D::try_from(document_from_link(&to_link(&document).unwrap()).unwrap()).unwrap(), document);
    }

    #[test]
    fn a_name_and_a_note_come_back_from_files_and_links_of_every_bench() {
        comes_back::<Scenario>();
        comes_back::<tuning::TuningScenario>();
        comes_back::<model_free::ModelFreeScenario>();
        comes_back::<level_loop::LevelLoopScenario>();
    }

    #[test]
    fn a_text_that_is_too_long_is_refused_with_its_length() {
        let mut document = Scenario::default();
        document.label.name = "é".repeat(Label::MAX_NAME);
        assert_eq!(from_json(&to_json(&document).unwrap()), Ok(document.clone()));
        document.label.name.push('x');
        let text = serde_json::to_string(&document).unwrap();
        let expected = ScenarioError::TextTooLong { field: "label.name".to_owned(), length: 81, max: 80 };
        assert_eq!(from_json(&text), Err(expected));
        let named = Scenario { rig_name: "é".repeat(Label::MAX_NAME + 1), ..Scenario::default() };
        let expected = ScenarioError::TextTooLong { field: "rig_name".to_owned(), length: 81, max: 80 };
        assert_eq!(from_json(&serde_json::to_string(&named).unwrap()), Err(expected));
    }
}
