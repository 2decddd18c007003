//! Tables as programs read them: commas between cells, a point as decimal separator.

use std::fmt::Write as _;

/// Columns under their names, as long as the first one; a shorter one ends in empty cells.
pub fn table<N: AsRef<str>>(columns: &[(N, &[f64])]) -> String {
    let names: Vec<&str> = columns.iter().map(|(name, _)| name.as_ref()).collect();
    let mut text = names.join(",") + "\n";
    for row in 0..columns.first().map_or(0, |(_, values)| values.len()) {
        line(&mut text, columns.iter().map(|(_, values)| values.get(row).copied()));
    }
    text
}

/// A line of numbers; one that is missing is an empty cell.
pub fn line(text: &mut String, numbers: impl IntoIterator<Item = Option<f64>>) {
    for (index, number) in numbers.into_iter().enumerate() {
        let separator = if index == 0 { "" } else { "," };
        // Writing to a String cannot fail.
        let _ = match number {
            Some(number) => write!(text, "{separator}{number}"),
            None => write!(text, "{separator}"),
        };
    }
    text.push('\n');
}
