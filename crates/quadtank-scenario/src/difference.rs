//! What two documents have differently.

use serde_json::Value;

use super::Document;
use super::params::{Param, field_of};

/// A value that two documents have differently.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Where it stands, such as `setup.valves[0]`: a number of both, or the smallest part that only one of them has.
    pub path: String,
    /// What the one and the other has there; `None` where that is no number.
    pub values: [Option<f64>; 2],
}

impl Difference {
    /// The row of the number that changed; `None` where it is no number of a row.
    pub fn param(&self) -> Option<&'static Param> {
        self.values.iter().all(Option::is_some).then(|| Param::at(&self.path)).flatten()
    }
}

impl Document {
    /// What another document has differently from this one, in the order of the other; the view counts for nothing. Empty where one of
    /// them cannot be written.
    ///
    /// ```
    /// let rig = quadtank_scenario::published_document("johansson-2000-minimum-phase").expect("it is published");
    /// let other = rig.with_settings(["setup.valves[0]=0.5", "view.hide_linear=true"])?;
    /// let found = rig.differences(&other);
    /// assert_eq!((found.len(), &*found[0].path), (1, "setup.valves[0]"));
    /// assert_eq!(found[0].values, [Some(0.7), Some(0.5)]);
    /// # Ok::<(), quadtank_scenario::ScenarioError>(())
    /// ```
    pub fn differences(&self, other: &Self) -> Vec<Difference> {
        let tree = |document: &Self| document.to_json().ok().and_then(|text| serde_json::from_str(&text).ok());
        let mut found = Vec::new();
        if let (Some(before), Some(after)) = (tree(self), tree(other)) {
            compare(&before, &after, "", &mut found);
        }
        found.retain(|difference| !difference.path.starts_with("view"));
        found
    }
}

fn compare(before: &Value, after: &Value, path: &str, found: &mut Vec<Difference>) {
    match (before, after) {
        (Value::Object(before), Value::Object(after)) => {
            for (name, value) in after {
                compare(before.get(name).unwrap_or(&Value::Null), value, &field_of(path, name), found);
            }
            for (name, value) in before.iter().filter(|(name, _)| !after.contains_key(*name)) {
                compare(value, &Value::Null, &field_of(path, name), found);
            }
        }
        (Value::Array(before), Value::Array(after)) if before.len() == after.len() => {
            for (index, (before, after)) in before.iter().zip(after).enumerate() {
                compare(before, after, &format!("{path}[{index}]"), found);
            }
        }
        _ if before == after => {}
        _ => found.push(Difference { path: path.to_owned(), values: [before.as_f64(), after.as_f64()] }),
    }
}

#[cfg(test)]
mod tests {
    use crate::{Document, published_document};

    fn paths(before: &Document, after: &Document) -> Vec<String> {
        before.differences(after).into_iter().map(|difference| difference.path).collect()
    }

    #[test]
    fn numbers_lists_and_choices_that_differ_are_found_in_either_direction() {
        let rig = published_document("johansson-2000-minimum-phase").unwrap();
        assert_eq!(paths(&rig, &rig), [""; 0]);
        let other = rig
            .with_settings([
                "setup.valves[1]=0.34",
                "setup.controller.pairing=swapped",
                "setup.experiment.set_point_steps=[]",
                "view.cursor_s=0",
            ])
            .unwrap();
        let expected = ["setup.controller.pairing", "setup.experiment.set_point_steps", "setup.valves[1]"];
        for mut found in [paths(&rig, &other), paths(&other, &rig)] {
            found.sort_unstable();
            assert_eq!(found, expected);
        }
        let found = rig.differences(&other);
        let valve = found.iter().find(|difference| difference.path == "setup.valves[1]").unwrap();
        assert_eq!((valve.values, valve.param().unwrap().path), ([Some(0.6), Some(0.34)], "valves[]"));
        assert_eq!(found.iter().filter(|difference| difference.param().is_some()).count(), 1);
    }
}
