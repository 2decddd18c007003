use quadtank::study::relay_tuning::Element;

use crate::delay::delayed;
use crate::expression::{Blanks, Reader, Written};
use crate::token::{DecimalComma, TokenKind, tokens};
use crate::value::{Square, Value};
use crate::{FormulaError, FormulaFault, MAX_BYTES};

/// Commands of MATLAB and Python that have nothing to do with the plant.
const NO_PART_OF_A_PLANT: [&str; 5] = ["import", "from", "clear", "clc", "close"];

/// Reads one element. A comma between digits is a decimal sign.
///
/// # Errors
/// [`FormulaError`] for a text that is no element with one dead time, with the place.
///
/// ```
/// let element = quadtank_formula::element_from_formula("12.8 exp(-s)/(16.7 s + 1)")?;
/// assert_eq!((element.numerator, element.denominator, element.dead_time), (vec![12.8], vec![1.0, 16.7], 1.0));
/// # Ok::<(), quadtank_formula::FormulaError>(())
/// ```
pub fn element_from_formula(text: &str) -> Result<Element, FormulaError> {
    check_length(text)?;
    let tokens = tokens(text, DecimalComma::OutsideLists)?;
    let mut reader = Reader::new(&tokens, text.len());
    reader.check_calls()?;
    reader.skip_newlines();
    let Written { value, span } = reader.sum(Blanks::MeanNothing)?;
    reader.skip_newlines();
    match (reader.peek(), value) {
        (Some(_), _) => Err(reader.unexpected()),
        (None, Value::Quotient(quotient)) => Ok(quotient.into_element()),
        (None, Value::List(_) | Value::Text(_)) => Err(FormulaError::new(FormulaFault::NoElement, span)),
    }
}

/// Reads the elements of a plant with two inputs and two outputs, row by output, from the lines of a script of MATLAB or
/// python-control. The last such plant counts; where there is none, variables g11, g12, g21 and g22 are one.
///
/// # Errors
/// [`FormulaError`] for a line that is not understood, with the place, and for a script without a plant.
///
/// ```
/// let plant = quadtank_formula::elements_from_script("
///     s = tf('s');
///     G = [12.8*exp(-s)/(16.7*s + 1), -18.9*exp(-3*s)/(21*s + 1);
///          6.6*exp(-7*s)/(10.9*s + 1), -19.4*exp(-3*s)/(14.4*s + 1)];
/// ")?;
/// assert_eq!(plant[1][0].dead_time, 7.0);
/// # Ok::<(), quadtank_formula::FormulaError>(())
/// ```
pub fn elements_from_script(text: &str) -> Result<[[Element; 2]; 2], FormulaError> {
    check_length(text)?;
    let tokens = tokens(text, DecimalComma::Nowhere)?;
    let mut reader = Reader::new(&tokens, text.len());
    reader.check_calls()?;
    let mut plant = None;
    while let Some(token) = reader.peek() {
        if matches!(token.kind, TokenKind::Newline | TokenKind::Symbol(';' | ',')) {
            reader.advance();
            continue;
        }
        if let Some(found) = reader.statement()?.as_plant() {
            plant = Some(found);
        }
        if !matches!(
            reader.peek().map(|token| &token.kind),
            None | Some(TokenKind::Newline | TokenKind::Symbol(';' | ','))
        ) {
            return Err(reader.unexpected());
        }
    }
    let plant = plant.or_else(|| reader.elements_by_name());
    let missing = || FormulaError::new(FormulaFault::NoPlant, text.trim_end().len()..text.trim_end().len());
    Ok(plant.ok_or_else(missing)?.map(|row| row.map(crate::quotient::Quotient::into_element)))
}

fn check_length(text: &str) -> Result<(), FormulaError> {
    let fault = FormulaFault::TooLong { length: text.len(), max: MAX_BYTES };
    if text.len() > MAX_BYTES { Err(FormulaError::new(fault, 0..0)) } else { Ok(()) }
}

impl Reader<'_> {
    /// One statement: an assignment, an expression, or a command without effect on a plant. Returns its value.
    fn statement(&mut self) -> Result<Value, FormulaError> {
        let first = self.peek().map(|token| &token.kind);
        let second = self.second().map(|token| &token.kind);
        match (first, second) {
            (Some(TokenKind::Name(name)), _) if NO_PART_OF_A_PLANT.contains(&name.as_str()) => {
                while self
                    .peek()
                    .is_some_and(|token| !matches!(token.kind, TokenKind::Newline | TokenKind::Symbol(';')))
                {
                    self.advance();
                }
                Ok(Value::List(Vec::new()))
            }
            (Some(TokenKind::Name(name)), Some(TokenKind::Symbol('='))) => {
                let name = name.clone();
                self.assignment(&name)
            }
            _ => match self.place()? {
                Some((name, place)) => self.element(&name, place),
                None => Ok(self.sum(Blanks::MeanNothing)?.value),
            },
        }
    }

    /// The plant and the place of an element in `G(1,2) = …`, row and column from 0; `None` for another statement.
    fn place(&mut self) -> Result<Option<(String, [usize; 2])>, FormulaError> {
        let [name, open, row, comma, column, close, equals, ..] = self.rest() else { return Ok(None) };
        let (TokenKind::Name(of), TokenKind::Number(i), TokenKind::Number(j)) = (&name.kind, &row.kind, &column.kind)
        else {
            return Ok(None);
        };
        let symbols = [(open, '('), (comma, ','), (close, ')'), (equals, '=')];
        if !symbols.iter().all(|(token, symbol)| token.kind == TokenKind::Symbol(*symbol)) {
            return Ok(None);
        }
        let index = |number: f64| [1.0, 2.0].iter().position(|&known| known == number);
        let (Some(row), Some(column)) = (index(*i), index(*j)) else {
            return Err(FormulaError::new(FormulaFault::Shape, row.span.start..column.span.end));
        };
        Ok(Some((of.clone(), [row, column])))
    }

    /// Assigns an element of a plant. As in MATLAB, elements that nothing is assigned to are zero, and a plant has two rows and columns
    /// as soon as something stands in its second ones.
    fn element(&mut self, name: &str, [row, column]: [usize; 2]) -> Result<Value, FormulaError> {
        // The name, two numbers and four signs.
        (0..7).for_each(|_| self.advance());
        let Written { value, span } = self.sum(Blanks::MeanNothing)?;
        let quotient = value.quotient().map_err(|fault| FormulaError::new(fault, span))?.clone();
        let known = self.variables.get(name).and_then(Value::as_plant).map(|rows| rows.map(|row| row.map(Some)));
        let mut elements = known.or_else(|| self.placed.get(name).cloned()).unwrap_or_default();
        elements[row][column] = Some(quotient);
        self.placed.insert(name.to_owned(), elements.clone());
        let has_second_row = elements[1].iter().any(Option::is_some);
        let has_second_column = elements.iter().any(|row| row[1].is_some());
        if !(has_second_row && has_second_column) {
            return Ok(value);
        }
        let zero = || crate::quotient::Quotient::number(0.0);
        let plant = Value::square(elements.map(|row| row.map(|element| element.unwrap_or_else(zero))));
        self.variables.insert(name.to_owned(), plant.clone());
        Ok(plant)
    }

    /// `G = …`, or `G.InputDelay = …` with the plant that G is.
    fn assignment(&mut self, name: &str) -> Result<Value, FormulaError> {
        self.advance();
        self.advance();
        let Written { value, span } = self.sum(Blanks::MeanNothing)?;
        let of_property = name.rsplit_once('.').and_then(|(owner, property)| {
            let owned = self.variables.get(owner)?.clone();
            Some((owner, property, owned))
        });
        let (name, value) = match of_property {
            Some((owner, property, owned)) => {
                let changed = delayed(&owned, property, &value).map_err(|fault| FormulaError::new(fault, span))?;
                (owner, changed)
            }
            None => (name, value),
        };
        self.variables.insert(name.to_owned(), value.clone());
        Ok(value)
    }

    /// The plant of variables that are called g11, g12, g21 and g22.
    fn elements_by_name(&self) -> Option<Square<crate::quotient::Quotient>> {
        let element = |place: &str| {
            let is_it = |name: &str| name.to_ascii_lowercase().replace('_', "") == format!("g{place}");
            let (_, value) = self.variables.iter().find(|(name, _)| is_it(name))?;
            value.quotient().ok().cloned()
        };
        Some([[element("11")?, element("12")?], [element("21")?, element("22")?]])
    }
}
