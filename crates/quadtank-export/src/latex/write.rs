//! Numbers, lists and matrices in LaTeX.

use quadtank::linear::Complex;

/// Digits of every number behind its first one: six are significant.
const FURTHER_DIGITS: u8 = 5;
/// Powers of ten that are written as a plain number.
const PLAIN: std::ops::Range<i32> = -3..6;
/// A part of a complex number below this share of the other one is rounding.
const ROUNDING: f64 = 1e-9;

/// A number in mathematical mode: `0.0625`, `-1.4`, `3.14 \times 10^{-6}`.
pub fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let text = format!("{value:.*e}", usize::from(FURTHER_DIGITS));
    let (mantissa, power) = text.split_once('e').unwrap_or((&text, "0"));
    let power: i32 = power.parse().unwrap_or_default();
    if PLAIN.contains(&power) {
        let decimals = usize::try_from(i32::from(FURTHER_DIGITS) - power).unwrap_or_default();
        return trimmed(&format!("{value:.decimals$}")).to_owned();
    }
    format!("{} \\times 10^{{{power}}}", trimmed(mantissa))
}

/// Without zeros at the end of a fraction.
fn trimmed(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}

/// A complex number: `-0.5`, `0.1 + 0.2\,\mathrm{j}`.
pub fn complex(value: Complex) -> String {
    let size = value.norm();
    let part = |part: f64| if part.abs() <= ROUNDING * size { 0.0 } else { part };
    match (part(value.re), part(value.im)) {
        (re, 0.0) => number(re),
        (0.0, im) => format!("{}\\,\\mathrm{{j}}", number(im)),
        (re, im) => {
            let sign = if im < 0.0 { '-' } else { '+' };
            format!("{} {sign} {}\\,\\mathrm{{j}}", number(re), number(im.abs()))
        }
    }
}

/// Numbers in a sentence: `$-0.5$, $-0.2$ and $-0.1$`.
pub fn list(numbers: &[Complex]) -> String {
    let numbers: Vec<String> = numbers.iter().map(|&value| format!("${}$", complex(value))).collect();
    match numbers.split_last() {
        Some((last, others)) if !others.is_empty() => format!("{} and {last}", others.join(", ")),
        Some((last, _)) => last.clone(),
        None => "none".to_owned(),
    }
}

/// A row of numbers as a matrix.
pub fn row(numbers: &[f64]) -> String {
    matrix([numbers.iter().map(|&value| number(value)).collect::<Vec<_>>()])
}

/// A matrix by rows of entries.
pub fn matrix<R: AsRef<[String]>>(rows: impl IntoIterator<Item = R>) -> String {
    let rows: Vec<String> = rows.into_iter().map(|row| row.as_ref().join(" & ")).collect();
    format!("\\begin{{bmatrix}} {} \\end{{bmatrix}}", rows.join(" \\\\ "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_six_significant_digits() {
        for (value, text) in [
            (0.0, "0"),
            (-0.0, "0"),
            (3.0, "3"),
            (-1.4, "-1.4"),
            (100.0, "100"),
            (1.0 / 3.0, "0.333333"),
            (123_456.7, "123457"),
            (999_999.9, "1 \\times 10^{6}"),
            (0.001_234_567_8, "0.00123457"),
            (-3.14e-6, "-3.14 \\times 10^{-6}"),
            (6.02e23, "6.02 \\times 10^{23}"),
        ] {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn rounding_is_no_imaginary_part() {
        assert_eq!(complex(Complex::new(-0.5, 1e-15)), "-0.5");
        assert_eq!(complex(Complex::new(0.1, -0.2)), "0.1 - 0.2\\,\\mathrm{j}");
        assert_eq!(complex(Complex::new(0.0, 2.0)), "2\\,\\mathrm{j}");
        assert_eq!(complex(Complex::new(0.0, 0.0)), "0");
    }

    #[test]
    fn lists_are_sentences() {
        let numbers = [1.0, 2.0, 3.0].map(|re| Complex::new(re, 0.0));
        assert_eq!(list(&numbers), "$1$, $2$ and $3$");
        assert_eq!(list(&numbers[..1]), "$1$");
        assert_eq!(list(&[]), "none");
    }
}
