//! How tables are written.

use clap::{Args, ValueEnum};
use quadtank_scenario::{CsvStyle, DecimalSign, Separator, TwoCommas};

/// Signs of a table.
#[derive(Clone, Copy, Args)]
pub struct TableOptions {
    /// What stands between the columns of CSV; with a decimal comma, if nothing is said, a semicolon
    #[arg(long, value_enum, value_name = "SIGN")]
    separator: Option<Between>,
    /// The decimal sign of CSV
    #[arg(long, value_enum, value_name = "SIGN", default_value_t = Decimal::Point)]
    decimal: Decimal,
}

/// What stands between columns.
#[derive(Clone, Copy, ValueEnum)]
enum Between {
    Comma,
    Semicolon,
    Tab,
}

/// A decimal sign.
#[derive(Clone, Copy, ValueEnum)]
enum Decimal {
    Point,
    Comma,
}

impl TableOptions {
    /// The style that these options ask for.
    ///
    /// # Errors
    /// [`TwoCommas`].
    pub fn style(self) -> Result<CsvStyle, TwoCommas> {
        let decimal = match self.decimal {
            Decimal::Point => DecimalSign::Point,
            Decimal::Comma => DecimalSign::Comma,
        };
        match self.separator {
            None => Ok(CsvStyle::usual(decimal)),
            Some(Between::Comma) => CsvStyle::new(Separator::Comma, decimal),
            Some(Between::Semicolon) => CsvStyle::new(Separator::Semicolon, decimal),
            Some(Between::Tab) => CsvStyle::new(Separator::Tab, decimal),
        }
    }
}
