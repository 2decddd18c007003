//! How each language writes the block of numbers.

use crate::data::{Item, Section, Value};

/// A language in which an experiment can be exported.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Language {
    /// Python with `numpy`, `scipy` and `control` (python-control).
    Python,
    /// MATLAB with the Control System Toolbox, or GNU Octave with the package `control`.
    Octave,
    /// Julia with `ControlSystems`. Unlike the others, its scripts are not run by any check.
    Julia,
}

use Language::{Julia, Octave, Python};

impl Language {
    /// All of them.
    pub const ALL: [Self; 3] = [Python, Octave, Julia];

    /// Its name, for people.
    pub const fn name(self) -> &'static str {
        match self {
            Python => "Python",
            Octave => "MATLAB/Octave",
            Julia => "Julia",
        }
    }

    /// The extension of a script, without a point.
    pub const fn extension(self) -> &'static str {
        match self {
            Python => "py",
            Octave => "m",
            Julia => "jl",
        }
    }

    /// What a script should be called. MATLAB and Octave find a function by the name of its file, so theirs has to be this.
    pub const fn file_name(self) -> &'static str {
        match self {
            Python => "quadtank_experiment.py",
            Octave => "quadtank_experiment.m",
            Julia => "quadtank_experiment.jl",
        }
    }

    /// The media type of a script.
    pub const fn media_type(self) -> &'static str {
        match self {
            Python => "text/x-python",
            Octave => "text/x-matlab",
            Julia => "text/x-julia",
        }
    }

    /// Whether `make check-exports` runs scripts of this language.
    pub const fn is_checked(self) -> bool {
        !matches!(self, Julia)
    }

    /// What is the same in every script.
    pub(crate) const fn template(self) -> &'static str {
        match self {
            Python => include_str!("../templates/experiment.py"),
            Octave => include_str!("../templates/experiment.m"),
            Julia => include_str!("../templates/experiment.jl"),
        }
    }

    /// What begins a comment that ends with its line.
    pub(crate) const fn comment_mark(self) -> &'static str {
        match self {
            Python | Julia => "#",
            Octave => "%",
        }
    }

    /// What stands before each line of the block, which is inside a function in some languages.
    pub(crate) const fn indent(self) -> &'static str {
        match self {
            Python | Julia => "",
            Octave => "  ",
        }
    }

    /// Index of the first entry of a list.
    const fn first_index(self) -> usize {
        match self {
            Python => 0,
            Octave | Julia => 1,
        }
    }

    /// A section of the block: a title, and an assignment for each number, vector or matrix.
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
            Python => format!("{} = {value}", name.to_uppercase()),
            Octave => format!("p.{name} = {value};"),
            Julia => format!("const {} = {value}", name.to_uppercase()),
        };
        // The comment of a matrix or of a long line stands on the line before it: at its end a reader would miss it.
        if value.contains('\n') || value.len() > LONG {
            format!("{mark} {comment}\n{assignment}\n")
        } else {
            format!("{assignment}  {mark} {comment}\n")
        }
    }

    fn value(self, value: &Value) -> String {
        let index = |index: usize| (index + self.first_index()).to_string();
        match value {
            Value::Number(value) => number(*value),
            Value::Numbers(numbers) => self.vector(&each(numbers, |&value| number(value))),
            Value::Matrix { rows, columns } => {
                self.matrix(&each(rows, |row| each(row, |&value| number(value))), *columns)
            }
            Value::Indices(indices) => self.vector(&each(indices, |&i| index(i))),
            Value::Changes(changes) => {
                self.matrix(&each(changes, |&(time, i, size)| vec![number(time), index(i), number(size)]), 3)
            }
            Value::Flags(flags) => self.vector(&each(flags, |&flag| self.flag(flag).to_owned())),
            Value::Flag(flag) => self.flag(*flag).to_owned(),
            Value::Missing => self.missing().to_owned(),
        }
    }

    fn vector(self, entries: &[String]) -> String {
        match self {
            Python => format!("np.array([{}])", entries.join(", ")),
            Julia if entries.is_empty() => "Float64[]".to_owned(),
            Octave | Julia => format!("[{}]", entries.join(", ")),
        }
    }

    fn matrix(self, rows: &[Vec<String>], columns: usize) -> String {
        let lines = |row: &dyn Fn(&[String]) -> String| rows.iter().map(|entries| row(entries)).collect::<String>();
        match self {
            Python if rows.is_empty() => format!("np.zeros((0, {columns}))"),
            Octave | Julia if rows.is_empty() => format!("zeros(0, {columns})"),
            Python => format!("np.array([\n{}])", lines(&|row| format!("    [{}],\n", row.join(", ")))),
            Octave => format!("[\n{}]", lines(&|row| format!("  {};\n", row.join(", ")))),
            Julia => format!("[\n{}]", lines(&|row| format!("    {};\n", row.join(" ")))),
        }
    }

    const fn flag(self, flag: bool) -> &'static str {
        match (self, flag) {
            (Python, true) => "True",
            (Python, false) => "False",
            (Octave | Julia, true) => "true",
            (Octave | Julia, false) => "false",
        }
    }

    const fn missing(self) -> &'static str {
        match self {
            Python => "None",
            Octave => "[]",
            Julia => "nothing",
        }
    }
}

/// A value that is longer (characters) has its remark on the line before.
const LONG: usize = 80;

/// A number with all its digits, as Rust, Python, MATLAB, Octave and Julia read it alike.
fn number(value: f64) -> String {
    format!("{value:?}")
}

fn each<T, R>(items: &[T], of: impl Fn(&T) -> R) -> Vec<R> {
    items.iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_all_their_digits() {
        let expected = ["0.30000000000000004", "1.0", "-1e-300", "5e-324", "0.3333333333333333", "1e22", "-0.0"];
        for (value, text) in [0.1 + 0.2, 1.0, -1e-300, 5e-324, 1.0 / 3.0, 1e22, -0.0].into_iter().zip(expected) {
            assert_eq!(number(value), text);
            assert_eq!(text.parse(), Ok(value));
        }
    }

    #[test]
    fn changes_are_a_matrix_also_where_there_are_none() {
        let written = |changes: &[(f64, usize, f64)]| {
            Language::ALL.map(|language| language.value(&Value::Changes(changes.to_vec())))
        };
        assert_eq!(written(&[]), ["np.zeros((0, 3))", "zeros(0, 3)", "zeros(0, 3)"]);
        let one = ["np.array([\n    [30.5, 1, -1e-6],\n])", "[\n  30.5, 2, -1e-6;\n]", "[\n    30.5 2 -1e-6;\n]"];
        assert_eq!(written(&[(30.5, 1, -1e-6)]), one);
    }

    #[test]
    fn an_empty_vector_is_one_of_numbers() {
        let written = Language::ALL.map(|language| language.value(&Value::Numbers(Vec::new())));
        assert_eq!(written, ["np.array([])", "[]", "Float64[]"]);
    }
}
