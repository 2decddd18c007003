//! Numbers as a reader of the chosen language expects them.

/// How a language writes numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NumberStyle {
    /// Sign between whole part and fraction.
    pub decimal: char,
}

impl NumberStyle {
    /// `value` with `digits` decimals, a true minus sign and no "−0".
    pub fn fixed(self, value: f64, digits: usize) -> String {
        if !value.is_finite() {
            return "–".to_owned();
        }
        // Halves go away from zero, as people round: 1.125 is 1.13. Formatting alone takes the even neighbour.
        let text = format!("{:.digits$}", value * (1.0 + f64::EPSILON));
        let zero = text.chars().all(|c| matches!(c, '-' | '0' | '.'));
        text.chars()
            .filter(|&c| !(zero && c == '-'))
            .map(|c| match c {
                '-' => '−',
                '.' => self.decimal,
                c => c,
            })
            .collect()
    }

    /// `value` with `digits` decimals, more where it is so small that these would not tell it from zero.
    pub fn at_least(self, value: f64, digits: usize) -> String {
        if value.abs() < 0.095 { self.significant(value, digits) } else { self.fixed(value, digits) }
    }

    /// `value` with about `digits` significant digits, never in scientific notation for ordinary sizes.
    pub fn significant(self, value: f64, digits: usize) -> String {
        if value == 0.0 || !value.is_finite() {
            return self.fixed(value, 0);
        }
        let magnitude = value.abs().log10().floor();
        if !(-6.0..7.0).contains(&magnitude) {
            return format!("{value:.*e}", digits.saturating_sub(1))
                .replace('-', "−")
                .replace('.', &self.decimal.to_string());
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between -6 and 13")]
        let decimals = (digits as f64 - 1.0 - magnitude).clamp(0.0, 12.0) as usize;
        self.fixed(value, decimals)
    }

    /// What a person typed, with point or comma and a minus sign of whatever length; a fraction such as 1/3 too.
    pub fn parse(text: &str) -> Option<f64> {
        match text.split_once('/') {
            Some((above, below)) => {
                Some(Self::decimal(above)? / Self::decimal(below)?).filter(|value| value.is_finite())
            }
            None => Self::decimal(text),
        }
    }

    fn decimal(text: &str) -> Option<f64> {
        let text = text.trim().replace(',', ".").replace(['−', '–'], "-");
        let (sign, magnitude) = match text.strip_prefix('-') {
            Some(magnitude) => (-1.0, magnitude),
            None => (1.0, text.strip_prefix('+').unwrap_or(&text)),
        };
        magnitude_of(magnitude).map(|v| sign * v)
    }
}

/// Reads a number without sign. Unlike [`str::parse`] it takes digits only, neither `inf` nor a second sign.
fn magnitude_of(text: &str) -> Option<f64> {
    let starts = text.starts_with(|c: char| c.is_ascii_digit() || c == '.');
    text.parse().ok().filter(|value: &f64| starts && value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    const EN: NumberStyle = NumberStyle { decimal: '.' };
    const PT: NumberStyle = NumberStyle { decimal: ',' };

    #[test]
    fn a_negative_number_has_a_true_minus_and_zero_has_none() {
        assert_eq!(EN.fixed(-0.636, 2), "−0.64");
        assert_eq!(EN.fixed(-0.001, 2), "0.00");
        assert_eq!([1.125, -1.125, 0.285].map(|half| EN.fixed(half, 2)), ["1.13", "−1.13", "0.29"]);
        assert_eq!(PT.fixed(1.5, 1), "1,5");
    }

    #[test]
    fn significant_digits_follow_the_size_of_the_number() {
        assert_eq!(EN.significant(0.012_758_9, 3), "0.0128");
        assert_eq!(EN.significant(1430.4, 3), "1430");
        assert_eq!(EN.significant(0.0, 3), "0");
        assert_eq!(EN.significant(1.0e-9, 3), "1.00e−9");
    }

    #[test]
    fn point_and_comma_are_both_read() {
        assert_eq!(NumberStyle::parse(" 0,43 "), Some(0.43));
        assert_eq!(NumberStyle::parse("−1.5"), Some(-1.5));
        assert_eq!(NumberStyle::parse("inf"), None);
        assert_eq!(NumberStyle::parse("1.2.3"), None);
    }

    #[test]
    fn a_number_is_read_in_every_way_that_people_write_it() {
        for (text, value) in
            [("0", 0.0), ("007", 7.0), (".5", 0.5), ("5.", 5.0), ("+00,25", 0.25), ("-.5e1", -5.0), ("1E-3", 0.001)]
        {
            assert_eq!(NumberStyle::parse(text), Some(value), "{text}");
        }
        assert_eq!(NumberStyle::parse(" –0,0104\u{a0}"), Some(-0.0104));
        assert_eq!(NumberStyle::parse(&PT.significant(-2.5e-9, 3)), Some(-2.5e-9));
        for text in ["", "-", ".", "--1", "-+1", "e5", "1e", "1e999", "0x10", "1 2", "NaN", "[1]", "−−1"] {
            assert_eq!(NumberStyle::parse(text), None, "{text}");
        }
    }

    #[test]
    fn a_fraction_is_a_number_unless_it_is_divided_by_nothing() {
        assert_eq!(NumberStyle::parse("1/3"), Some(1.0 / 3.0));
        assert_eq!(NumberStyle::parse(" −2,5 / 5 "), Some(-0.5));
        for text in ["1/0", "1/", "/3", "1/2/3", "0/0"] {
            assert_eq!(NumberStyle::parse(text), None, "{text}");
        }
    }
}
