use quadtank::study::relay_tuning::Element;

/// An element as [`element_from_formula`](crate::element_from_formula) reads it, with all digits:
/// `12.8 exp(-s)/(16.7 s + 1)`.
pub fn formula_of(element: &Element) -> String {
    let numerator = polynomial(&element.numerator);
    let denominator = polynomial(&element.denominator);
    let mut formula = match (element.dead_time == 0.0, &numerator[..]) {
        (true, _) => grouped(&numerator),
        (false, "1") => delay(element.dead_time),
        (false, _) => format!("{} {}", grouped(&numerator), delay(element.dead_time)),
    };
    if denominator != "1" {
        formula = format!("{formula}/{}", grouped(&denominator));
    }
    formula
}

fn delay(dead_time: f64) -> String {
    if dead_time == 1.0 { "exp(-s)".to_owned() } else { format!("exp(-{} s)", number(dead_time)) }
}

/// In parentheses, unless it is a single number or power.
fn grouped(polynomial: &str) -> String {
    if polynomial.contains(' ') { format!("({polynomial})") } else { polynomial.to_owned() }
}

/// A polynomial of coefficients by rising powers, written from the highest power down.
fn polynomial(coefficients: &[f64]) -> String {
    let mut written = String::new();
    for (power, &coefficient) in coefficients.iter().enumerate().rev().filter(|(_, c)| **c != 0.0) {
        let sign = match (written.is_empty(), coefficient < 0.0) {
            (true, true) => "-",
            (true, false) => "",
            (false, true) => " - ",
            (false, false) => " + ",
        };
        let magnitude = number(coefficient.abs());
        let variable = match power {
            0 => String::new(),
            1 => "s".to_owned(),
            _ => format!("s^{power}"),
        };
        let term = match (power, &magnitude[..]) {
            (0, _) => magnitude,
            (_, "1") => variable,
            _ => format!("{magnitude} {variable}"),
        };
        written = format!("{written}{sign}{term}");
    }
    if written.is_empty() { "0".to_owned() } else { written }
}

/// The shortest number that is read as the same value.
fn number(value: f64) -> String {
    let moderate = value == 0.0 || (1e-5..1e15).contains(&value.abs());
    if moderate { value.to_string() } else { format!("{value:e}") }
}
