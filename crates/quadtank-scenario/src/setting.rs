//! Setting single values of a document by their paths.

use serde_json::Value;

use super::codec::document_from_json;
use super::error::{malformed, quoted};
use super::{Document, ScenarioError};

impl Document {
    /// The same document with other values at some paths, such as `setup.plant.parameters.rig.tanks[2].height`. All of them are set
    /// before the document is checked, so that they may depend on each other.
    ///
    /// # Errors
    /// [`ScenarioError::Malformed`] for a path that leads nowhere, and what reading the document finds.
    pub fn with_values<'a>(
        &self,
        values: impl IntoIterator<Item = &'a (String, Value)>,
    ) -> Result<Self, ScenarioError> {
        let unreadable = |error: serde_json::Error| malformed(String::new(), error.to_string());
        let mut document: Value = serde_json::from_str(&self.to_json()?).map_err(unreadable)?;
        for (path, value) in values {
            set(&mut document, path, value.clone())?;
        }
        document_from_json(&document.to_string())
    }

    /// The same for settings as they are written on the command line, such as `setup.valves[0]=0.4`. A value that is not JSON is the
    /// name of a choice.
    ///
    /// # Errors
    /// As [`with_values`](Self::with_values); [`ScenarioError::Malformed`] for a setting without `=`.
    pub fn with_settings<'a>(&self, settings: impl IntoIterator<Item = &'a str>) -> Result<Self, ScenarioError> {
        let setting = |text: &str| {
            let (path, value) = text
                .split_once('=')
                .ok_or_else(|| malformed(quoted(text), "a setting is a path, `=` and a value".to_owned()))?;
            let value = serde_json::from_str(value).unwrap_or_else(|_| Value::from(value));
            Ok((path.to_owned(), value))
        };
        let values = settings.into_iter().map(setting).collect::<Result<Vec<_>, _>>()?;
        if values.is_empty() { Ok(self.clone()) } else { self.with_values(&values) }
    }
}

/// Sets the value at a path. A field that is not there is added, for it may be one that a document may be without.
fn set(document: &mut Value, path: &str, value: Value) -> Result<(), ScenarioError> {
    let pointer = format!("/{}", path.replace('[', ".").replace(']', "").replace('.', "/"));
    if let Some(place) = document.pointer_mut(&pointer) {
        *place = value;
        return Ok(());
    }
    let (parent, name) = pointer.rsplit_once('/').unwrap_or_default();
    match document.pointer_mut(parent) {
        Some(Value::Object(fields)) => {
            fields.insert(name.to_owned(), value);
            Ok(())
        }
        _ => Err(malformed(quoted(path), "no such value in the document".to_owned())),
    }
}
