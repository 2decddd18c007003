//! Tables as spreadsheets of other countries read them.

use std::borrow::Cow;

use serde::Deserialize;
use thiserror::Error;

/// What stands between the columns of a table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Separator {
    /// `,`
    #[default]
    Comma,
    /// `;`
    Semicolon,
    /// A tab.
    Tab,
}

impl Separator {
    /// The character.
    pub const fn sign(self) -> char {
        match self {
            Self::Comma => ',',
            Self::Semicolon => ';',
            Self::Tab => '\t',
        }
    }
}

/// What stands between the whole part of a number and its fraction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DecimalSign {
    /// `.`
    #[default]
    Point,
    /// `,`
    Comma,
}

impl DecimalSign {
    /// The character.
    pub const fn sign(self) -> char {
        match self {
            Self::Point => '.',
            Self::Comma => ',',
        }
    }
}

/// A comma cannot be both signs of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error(
    "a comma cannot separate columns and be the decimal sign too; with a decimal comma the separator is semicolon or tab"
)]
pub struct TwoCommas;

/// Separator and decimal sign of a table. Never a comma for both.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct CsvStyle {
    separator: Separator,
    decimal: DecimalSign,
}

impl CsvStyle {
    /// All of them; the first is what programs read.
    pub const ALL: [Self; 5] = [
        Self { separator: Separator::Comma, decimal: DecimalSign::Point },
        Self { separator: Separator::Semicolon, decimal: DecimalSign::Comma },
        Self { separator: Separator::Semicolon, decimal: DecimalSign::Point },
        Self { separator: Separator::Tab, decimal: DecimalSign::Point },
        Self { separator: Separator::Tab, decimal: DecimalSign::Comma },
    ];

    /// A style by its signs.
    ///
    /// # Errors
    /// [`TwoCommas`].
    pub fn new(separator: Separator, decimal: DecimalSign) -> Result<Self, TwoCommas> {
        let style = Self { separator, decimal };
        if Self::ALL.contains(&style) { Ok(style) } else { Err(TwoCommas) }
    }

    /// The usual style where numbers have this decimal sign: with a comma, semicolons stand between columns.
    pub const fn usual(decimal: DecimalSign) -> Self {
        match decimal {
            DecimalSign::Point => Self::ALL[0],
            DecimalSign::Comma => Self::ALL[1],
        }
    }

    /// What stands between columns.
    pub const fn separator(self) -> Separator {
        self.separator
    }

    /// The decimal sign.
    pub const fn decimal(self) -> DecimalSign {
        self.decimal
    }

    /// A table of this crate, which has commas between columns and decimal points, in this style. Names of columns and words stay as
    /// they are; no cell of such a table contains a comma.
    ///
    /// # Examples
    /// ```
    /// use quadtank_scenario::{CsvStyle, DecimalSign};
    ///
    /// let style = CsvStyle::usual(DecimalSign::Comma);
    /// assert_eq!(style.apply("time_s,level_1_m\n0.5,0.124\n"), "time_s;level_1_m\n0,5;0,124\n");
    /// ```
    pub fn apply(self, table: &str) -> Cow<'_, str> {
        if self == Self::default() {
            return Cow::Borrowed(table);
        }
        let lines = table.split_inclusive('\n');
        Cow::Owned(lines.fold(String::with_capacity(table.len()), |mut text, line| {
            let (cells, end) = line.strip_suffix('\n').map_or((line, ""), |cells| (cells, "\n"));
            for (index, cell) in cells.split(',').enumerate() {
                if index > 0 {
                    text.push(self.separator.sign());
                }
                self.push_cell(&mut text, cell);
            }
            text + end
        }))
    }

    fn push_cell(self, text: &mut String, cell: &str) {
        match (self.decimal, cell.split_once('.')) {
            (DecimalSign::Comma, Some((whole, fraction))) if cell.parse::<f64>().is_ok() => {
                text.extend([whole, ",", fraction]);
            }
            _ => text.push_str(cell),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = "kind,real_per_s\npole,-0.5\nzero,3\nnone,\nv1.5,1e-7\n";

    #[test]
    fn only_numbers_get_another_decimal_sign() {
        let written = CsvStyle::ALL.map(|style| style.apply(TABLE).into_owned());
        assert_eq!(written[0], TABLE);
        assert_eq!(written[1], "kind;real_per_s\npole;-0,5\nzero;3\nnone;\nv1.5;1e-7\n");
        assert_eq!(written[2], TABLE.replace(',', ";"));
        assert_eq!(written[3], TABLE.replace(',', "\t"));
        assert_eq!(written[4], written[1].replace(';', "\t"));
        assert_eq!(CsvStyle::ALL[1].apply("a,b\n1.5,2.5"), "a;b\n1,5;2,5");
        assert_eq!(CsvStyle::ALL[1].apply(""), "");
    }

    #[test]
    fn a_comma_is_one_sign_alone() {
        assert_eq!(CsvStyle::new(Separator::Comma, DecimalSign::Comma), Err(TwoCommas));
        for style in CsvStyle::ALL {
            assert_eq!(CsvStyle::new(style.separator(), style.decimal()), Ok(style));
        }
    }
}
