use std::mem::take;

use serde_json::{Map, Value, json};

use super::visitor::{Path, Presence, Step, Visitor};
use crate::ScenarioError;
use crate::limits::Limits;

/// Describes the documents of a type as a JSON Schema. Limits are those that depend on nothing else.
#[derive(Default)]
pub struct Schema {
    /// Of the values on the way to the present one, each with the way on from it.
    outer: Vec<(Description, Step)>,
    here: Description,
}

/// What is known of a value.
#[derive(Default)]
struct Description {
    /// Type and limits.
    words: Map<String, Value>,
    properties: Map<String, Value>,
    required: Vec<&'static str>,
    /// Choices without content.
    names: Vec<&'static str>,
    /// Choices with content.
    choices: Vec<Value>,
    may_be_null: bool,
}

fn map_of(properties: &Map<String, Value>, required: &[&str]) -> Value {
    json!({ "type": "object", "properties": properties, "required": required, "additionalProperties": false })
}

impl Description {
    fn schema(mut self) -> Value {
        let mut alternatives = self.choices;
        if !self.names.is_empty() {
            alternatives.insert(0, json!({ "type": "string", "enum": self.names }));
        }
        let schema = if !self.properties.is_empty() {
            map_of(&self.properties, &self.required)
        } else if alternatives.len() == 1 {
            alternatives.remove(0)
        } else if !alternatives.is_empty() {
            json!({ "oneOf": alternatives })
        } else {
            Value::Object(take(&mut self.words))
        };
        if self.may_be_null { json!({ "anyOf": [schema, { "type": "null" }] }) } else { schema }
    }
}

impl Schema {
    /// The schema of the whole document.
    pub fn titled(self, title: &str) -> Value {
        let mut schema = self.here.schema();
        schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
        schema["title"] = json!(title);
        schema
    }

    fn words(&mut self, words: Value) {
        if let Value::Object(words) = words {
            self.here.words.extend(words);
        }
    }
}

impl Visitor for Schema {
    fn makes(&self) -> bool {
        true
    }

    fn enter(&mut self, _: &Path, step: Step) -> Result<bool, ScenarioError> {
        // All entries of a list are alike.
        if matches!(step, Step::Item(1..)) {
            return Ok(false);
        }
        self.outer.push((take(&mut self.here), step));
        Ok(true)
    }

    fn leave(&mut self, _: &Path) -> Result<(), ScenarioError> {
        // The root is left too, and stays.
        let Some((outer, step)) = self.outer.pop() else { return Ok(()) };
        let schema = std::mem::replace(&mut self.here, outer).schema();
        let here = &mut self.here;
        match step {
            Step::Field(name, presence) => {
                here.properties.insert(name.to_owned(), schema);
                if presence == Presence::Required {
                    here.required.push(name);
                }
            }
            Step::Choice(name, _) if schema == json!({}) => here.names.push(name),
            Step::Choice(name, _) => {
                here.choices.push(map_of(&Map::from_iter([(name.to_owned(), schema)]), &[name]));
            }
            Step::Item(_) => drop(here.words.insert("items".to_owned(), schema)),
        }
        Ok(())
    }

    fn number(&mut self, _: &Path, _: &mut f64, limits: Limits) -> Result<(), ScenarioError> {
        self.words(json!({ "type": "number", "minimum": limits.min, "maximum": limits.max }));
        Ok(())
    }

    fn whole(&mut self, _: &Path, _: &mut u32, limits: Limits) -> Result<(), ScenarioError> {
        self.words(json!({ "type": "integer", "minimum": limits.min, "maximum": limits.max }));
        Ok(())
    }

    fn flag(&mut self, _: &Path, _: &mut bool) -> Result<(), ScenarioError> {
        self.words(json!({ "type": "boolean" }));
        Ok(())
    }

    fn length(&mut self, _: &Path, _: usize, least: usize, most: usize) -> Result<usize, ScenarioError> {
        self.words(json!({ "type": "array", "minItems": least, "maxItems": most }));
        Ok(1)
    }

    fn option(&mut self, _: &Path, _: bool) -> Result<bool, ScenarioError> {
        self.here.may_be_null = true;
        Ok(true)
    }
}
