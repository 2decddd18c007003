//! Numbers as laboratories write them.

/// What a cell of a table holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A number.
    Number(f64),
    /// Nothing, which is a hole.
    Missing,
    /// More than one decimal sign.
    TwoDecimalSigns,
    /// Anything else.
    Text,
}

/// Reads a cell. A comma is a decimal sign unless it separates columns, in which case it never gets here.
pub fn read(cell: &str) -> Cell {
    let cell = cell.trim().trim_matches('"').trim();
    if cell.is_empty() || ["nan", "na", "n/a", "-", "–"].contains(&cell.to_ascii_lowercase().as_str()) {
        return Cell::Missing;
    }
    let plain = cell.replace('\u{2212}', "-");
    let signs = plain.matches(['.', ',']).count();
    let is_numeric = plain.chars().all(|c| c.is_ascii_digit() || "+-.,eE".contains(c));
    match (is_numeric, signs) {
        (true, 0 | 1) => match plain.replace(',', ".").parse::<f64>() {
            Ok(number) if number.is_finite() => Cell::Number(number),
            _ => Cell::Text,
        },
        (true, _) => Cell::TwoDecimalSigns,
        (false, _) => Cell::Text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_all_countries() {
        for (cell, number) in [
            ("1.5", 1.5),
            (" 1,5 ", 1.5),
            ("\"-3e-2\"", -0.03),
            ("\u{2212}2", -2.0),
            ("+7", 7.0),
            (".5", 0.5),
            ("1,", 1.0),
        ] {
            assert_eq!(read(cell), Cell::Number(number), "{cell}");
        }
        for cell in ["", "  ", "NaN", "n/a", "–"] {
            assert_eq!(read(cell), Cell::Missing, "{cell}");
        }
        for cell in ["1.234,5", "1,234.5", "1.2.3"] {
            assert_eq!(read(cell), Cell::TwoDecimalSigns, "{cell}");
        }
        for cell in ["open", "12 V", "1e999", "--3", "inf"] {
            assert_eq!(read(cell), Cell::Text, "{cell}");
        }
    }
}
