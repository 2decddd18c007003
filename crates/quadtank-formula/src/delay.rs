use crate::FormulaFault;
use crate::quotient::Quotient;
use crate::value::{Square, Value};

/// Which paths of a plant a delay of MATLAB is in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum DelayedPaths {
    /// One for each input.
    Input,
    /// One for each output.
    Output,
    /// One for each path.
    InputOutput,
}

impl DelayedPaths {
    fn from_name(name: &str) -> Result<Self, FormulaFault> {
        match name.to_ascii_lowercase().as_str() {
            "inputdelay" => Ok(Self::Input),
            "outputdelay" => Ok(Self::Output),
            "iodelay" => Ok(Self::InputOutput),
            _ => Err(FormulaFault::UnknownOption { name: name.to_owned() }),
        }
    }

    /// The delay of every path.
    fn of_paths(self, delay: &Value) -> Result<Square<f64>, FormulaFault> {
        if let Ok(number) = delay.number() {
            return Ok([[number; 2]; 2]);
        }
        if self == Self::InputOutput {
            let entries = delay.entries_of_square().ok_or(FormulaFault::Shape)?;
            let [[a, b], [c, d]] = entries.map(|row| row.map(Value::number));
            return Ok([[a?, b?], [c?, d?]]);
        }
        match (self, &delay.numbers()?[..]) {
            (Self::Input, &[first, second]) => Ok([[first, second]; 2]),
            (_, &[first, second]) => Ok([[first; 2], [second; 2]]),
            _ => Err(FormulaFault::Shape),
        }
    }
}

/// An element or a plant with a delay that is called by a property of MATLAB.
pub fn delayed(value: &Value, property: &str, delay: &Value) -> Result<Value, FormulaFault> {
    let paths = DelayedPaths::from_name(property)?;
    if let Value::Quotient(element) = value {
        return element.delayed(delay.number()?).map(Value::Quotient);
    }
    let plant = value.as_plant().ok_or(FormulaFault::Shape)?;
    let delays = paths.of_paths(delay)?;
    let path = |row: usize, column: usize| plant[row][column].delayed(delays[row][column]);
    Ok(Value::square([[path(0, 0)?, path(0, 1)?], [path(1, 0)?, path(1, 1)?]]))
}

/// Elements from the coefficients of numerators and denominators, highest power first.
pub fn transfer_function(numerator: &Value, denominator: &Value) -> Result<Value, FormulaFault> {
    let element = |b: &Value, a: &Value| Quotient::new(b.polynomial()?, a.polynomial()?, 0.0);
    match (numerator.entries_of_square(), denominator.entries_of_square()) {
        (Some([[b11, b12], [b21, b22]]), Some([[a11, a12], [a21, a22]])) => {
            Ok(Value::square([[element(b11, a11)?, element(b12, a12)?], [element(b21, a21)?, element(b22, a22)?]]))
        }
        (None, None) => element(numerator, denominator).map(Value::Quotient),
        _ => Err(FormulaFault::Shape),
    }
}
