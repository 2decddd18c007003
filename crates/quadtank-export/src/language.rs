//! How each language writes the block of numbers.

use crate::data::{Item, Section, Value};

/// A language in which an experiment can be exported.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Language {
    /// Python with `numpy`, `scipy` and `control` (python-control).
    Python,
}

impl Language {
    /// All of them.
    pub const ALL: [Self; 1] = [Self::Python];

    /// Its name, for people.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Python => "Python",
        }
    }

    /// The extension of a script, without a point.
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Python => "py",
        }
    }

    /// What a script of the language should be called.
    pub const fn file_name(self) -> &'static str {
        match self {
            Self::Python => "quadtank_experiment.py",
        }
    }

    /// The media type of a script.
    pub const fn media_type(self) -> &'static str {
        match self {
            Self::Python => "text/x-python",
        }
    }

    /// What is the same in every script.
    pub(crate) const fn template(self) -> &'static str {
        match self {
            Self::Python => include_str!("../templates/experiment.py"),
        }
    }

    /// What begins a comment that ends with its line.
    pub(crate) const fn comment_mark(self) -> &'static str {
        match self {
            Self::Python => "#",
        }
    }

    /// Index of the first entry of a list.
    const fn first_index(self) -> usize {
        match self {
            Self::Python => 0,
        }
    }

    /// A section of the block: a title, and an assignment on a line for each number, vector or matrix.
    pub(crate) fn section(self, section: &Section) -> String {
        let mark = self.comment_mark();
        let items = section.items.iter().map(|item| self.assignment(item));
        format!("\n{mark} {}\n{}", section.title, items.collect::<String>())
    }

    fn assignment(self, item: &Item) -> String {
        let mark = self.comment_mark();
        let Item { name, value, comment } = item;
        let value = self.value(value);
        let assignment = match self {
            Self::Python => format!("{} = {value}", name.to_uppercase()),
        };
        // A remark behind a matrix would stand at its last row, and behind a long line nobody sees it.
        if value.contains('\n') || value.len() > LONG {
            format!("{mark} {comment}\n{assignment}\n")
        } else {
            format!("{assignment}  {mark} {comment}\n")
        }
    }

    fn value(self, value: &Value) -> String {
        match value {
            Value::Number(number) => format!("{number:?}"),
            Value::Numbers(numbers) => self.vector(&joined(numbers)),
            Value::Matrix { rows, columns } => {
                self.matrix(&rows.iter().map(|row| joined(row)).collect::<Vec<_>>(), *columns)
            }
            Value::Indices(indices) => {
                let indices: Vec<_> = indices.iter().map(|index| (index + self.first_index()).to_string()).collect();
                self.vector(&indices.join(", "))
            }
            Value::Changes(changes) => {
                let row = |&(time, index, size): &(f64, usize, f64)| {
                    format!("{time:?}, {}, {size:?}", index + self.first_index())
                };
                self.matrix(&changes.iter().map(row).collect::<Vec<_>>(), 3)
            }
            Value::Flags(flags) => {
                let flags: Vec<_> = flags.iter().map(|&flag| self.flag(flag)).collect();
                self.vector(&flags.join(", "))
            }
            Value::Flag(flag) => self.flag(*flag).to_owned(),
            Value::Missing => self.missing().to_owned(),
        }
    }

    fn vector(self, entries: &str) -> String {
        match self {
            Self::Python => format!("np.array([{entries}])"),
        }
    }

    fn matrix(self, rows: &[String], columns: usize) -> String {
        match self {
            Self::Python if rows.is_empty() => format!("np.zeros((0, {columns}))"),
            Self::Python => {
                let rows = rows.iter().map(|row| format!("    [{row}],\n"));
                format!("np.array([\n{}])", rows.collect::<String>())
            }
        }
    }

    const fn flag(self, flag: bool) -> &'static str {
        match (self, flag) {
            (Self::Python, true) => "True",
            (Self::Python, false) => "False",
        }
    }

    const fn missing(self) -> &'static str {
        match self {
            Self::Python => "None",
        }
    }
}

/// A value that is longer (characters) has its remark on the line before.
const LONG: usize = 80;

/// Numbers with all their digits, as Rust, Python, MATLAB, Octave and Julia read them alike.
fn joined(numbers: &[f64]) -> String {
    numbers.iter().map(|number| format!("{number:?}")).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_all_their_digits() {
        let numbers = [0.1 + 0.2, 1.0, -1e-300, 5e-324, 1.0 / 3.0, 1e22];
        let text = joined(&numbers);
        assert_eq!(text, "0.30000000000000004, 1.0, -1e-300, 5e-324, 0.3333333333333333, 1e22");
        for (part, number) in text.split(", ").zip(numbers) {
            assert_eq!(part.parse(), Ok(number));
        }
    }

    #[test]
    fn an_empty_list_of_changes_is_a_matrix_without_rows() {
        assert_eq!(Language::Python.value(&Value::Changes(Vec::new())), "np.zeros((0, 3))");
        let one = Value::Changes(vec![(30.5, 1, -1e-6)]);
        assert_eq!(Language::Python.value(&one), "np.array([\n    [30.5, 1, -1e-6],\n])");
    }
}
