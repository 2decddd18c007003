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

/// Elements from zeros, poles and gains, `k Π (s − z)/Π (s − p)`.
pub fn zeros_poles_gain(zeros: &Value, poles: &Value, gain: &Value) -> Result<Value, FormulaFault> {
    let element = |z: &Value, p: &Value, k: &Value| {
        let numerator = z.roots()?.times(&Quotient::number(k.number()?))?;
        numerator.over(&p.roots()?)
    };
    let entries = [zeros, poles, gain].map(Value::entries_of_square);
    match entries {
        [Some([[z11, z12], [z21, z22]]), Some([[p11, p12], [p21, p22]]), Some([[k11, k12], [k21, k22]])] => {
            Ok(Value::square([
                [element(z11, p11, k11)?, element(z12, p12, k12)?],
                [element(z21, p21, k21)?, element(z22, p22, k22)?],
            ]))
        }
        [None, None, None] => element(zeros, poles, gain).map(Value::Quotient),
        _ => Err(FormulaFault::Shape),
    }
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
