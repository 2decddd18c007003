use crate::FormulaFault;
use crate::quotient::Quotient;

/// What an expression is worth.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    Quotient(Quotient),
    /// Rows of a list. A list of Python has one row; nested ones are lists within that.
    List(Vec<Vec<Value>>),
    Text(String),
}

/// Entries of a plant with two inputs and two outputs, row by output.
pub type Square<T> = [[T; 2]; 2];

impl Value {
    /// A list of one row for each output.
    pub fn square(rows: Square<Quotient>) -> Self {
        Self::List(rows.map(|row| row.map(Self::Quotient).to_vec()).to_vec())
    }

    pub fn quotient(&self) -> Result<&Quotient, FormulaFault> {
        match self {
            Self::Quotient(quotient) => Ok(quotient),
            Self::List(_) | Self::Text(_) => Err(FormulaFault::NoElement),
        }
    }

    pub fn number(&self) -> Result<f64, FormulaFault> {
        self.quotient()?.as_number().ok_or(FormulaFault::NoCoefficients)
    }

    /// The entries of two rows with two entries, as MATLAB (`[a, b; c, d]`) or Python (`[[a, b], [c, d]]`) writes them.
    pub fn entries_of_square(&self) -> Option<Square<&Self>> {
        let [first, second] = match self {
            Self::List(rows) => match &rows[..] {
                [first, second] => [&first[..], &second[..]],
                [row] => match &row[..] {
                    [first, second] => [first.entries()?, second.entries()?],
                    _ => return None,
                },
                _ => return None,
            },
            _ => return None,
        };
        match (first, second) {
            ([a, b], [c, d]) => Some([[a, b], [c, d]]),
            _ => None,
        }
    }

    /// The entries of a list with one row.
    fn entries(&self) -> Option<&[Self]> {
        match self {
            Self::List(rows) => match &rows[..] {
                [row] => Some(row),
                _ => None,
            },
            _ => None,
        }
    }

    /// The elements of a plant, where it is one.
    pub fn as_plant(&self) -> Option<Square<Quotient>> {
        let [[a, b], [c, d]] = self.entries_of_square()?.map(|row| row.map(|entry| entry.quotient().ok().cloned()));
        Some([[a?, b?], [c?, d?]])
    }

    /// The numbers of a row or a column, or a single number.
    pub fn numbers(&self) -> Result<Vec<f64>, FormulaFault> {
        match self {
            Self::List(rows) => match &rows[..] {
                [row] if !row.is_empty() => row.iter().map(Self::number).collect(),
                column if column.len() > 1 && column.iter().all(|row| row.len() == 1) => {
                    column.iter().flatten().map(Self::number).collect()
                }
                _ => Err(FormulaFault::NoCoefficients),
            },
            _ => Ok(vec![self.number()?]),
        }
    }

    /// The polynomial with these roots, highest coefficient 1; 1 for an empty list.
    pub fn roots(&self) -> Result<Quotient, FormulaFault> {
        let is_empty = matches!(self, Self::List(rows) if rows.is_empty());
        let roots = if is_empty { Vec::new() } else { self.numbers()? };
        roots.into_iter().try_fold(Quotient::number(1.0), |product, root| {
            product.times(&Quotient::s().plus(&Quotient::number(-root))?)
        })
    }

    /// A polynomial whose coefficients are written from the highest power down, by rising powers.
    pub fn polynomial(&self) -> Result<Vec<f64>, FormulaFault> {
        self.numbers().map(|mut coefficients| {
            coefficients.reverse();
            coefficients
        })
    }
}
