use schemars::generate::SchemaSettings;
use serde_json::Value;

use super::Lesson;

/// The JSON Schema of a lesson, for editors that check a file while it is written. It has the shape and the descriptions;
/// [`audit`](super::audit) finds what a schema cannot say.
pub fn lesson_schema() -> Value {
    SchemaSettings::draft2020_12().into_generator().into_root_schema_for::<Lesson>().to_value()
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::lesson_schema;

    /// Every description in a schema, with its place; of what has none, the place alone.
    fn properties(schema: &Value, place: &str, found: &mut Vec<(String, Option<String>)>) {
        match schema {
            Value::Object(fields) => {
                for (name, property) in schema["properties"].as_object().into_iter().flatten() {
                    let description = property["description"].as_str().map(str::to_owned);
                    found.push((format!("{place}.{name}"), description));
                }
                for (name, part) in fields {
                    properties(part, &format!("{place}/{name}"), found);
                }
            }
            Value::Array(parts) => {
                for (index, part) in parts.iter().enumerate() {
                    properties(part, &format!("{place}/{index}"), found);
                }
            }
            _ => {}
        }
    }

    #[test]
    fn every_field_is_described_in_words_of_its_own() {
        let mut found = Vec::new();
        properties(&lesson_schema(), "", &mut found);
        assert!(found.len() > 50);
        for (place, description) in found {
            // A variant with content is a property of which the variant has the description.
            let is_variant = place.contains("/oneOf/");
            assert!(is_variant || description.is_some(), "{place}");
            assert!(!description.is_some_and(|words| words.contains("::") || words.contains("[`")), "{place}");
        }
    }

    #[test]
    fn version_ids_and_lists_have_their_limits() {
        let schema = lesson_schema();
        assert_eq!(schema["properties"]["lesson"]["maximum"], 1);
        assert_eq!(schema["properties"]["steps"]["maxItems"], 12);
        assert_eq!(schema["$defs"]["Task"]["properties"]["id"]["pattern"], "^[a-z0-9-]{1,40}$");
        assert_eq!(schema["additionalProperties"], false);
    }
}
