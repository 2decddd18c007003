/// A number with its sign (a true minus) and so many significant digits, with the reader's decimal separator.
///
/// Zero is `0`; what is not finite is `+∞`, `−∞` or `–`.
pub fn signed(value: f64, digits: usize, decimal: char) -> String {
    if !value.is_finite() {
        return if value.is_nan() {
            "–"
        } else if value > 0.0 {
            "+∞"
        } else {
            "−∞"
        }
        .into();
    }
    if value == 0.0 {
        return "0".into();
    }
    // Rounding first: 0.09996 has its first digit elsewhere once it is 0.100.
    let scientific = format!("{:.*e}", digits.max(1) - 1, value.abs());
    let exponent = scientific.split_once('e').and_then(|(_, exponent)| exponent.parse::<i32>().ok()).unwrap_or(0);
    let body = if (-5..6).contains(&exponent) {
        let decimals = usize::try_from(i32::try_from(digits).unwrap_or(1) - 1 - exponent).unwrap_or(0);
        format!("{:.*}", decimals, value.abs())
    } else {
        scientific.replace('-', "−")
    };
    let sign = if value > 0.0 { "+" } else { "−" };
    format!("{sign}{}", body.replace('.', decimal.encode_utf8(&mut [0; 4])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_a_reader_expects() {
        assert_eq!(signed(0.0128, 3, '.'), "+0.0128");
        assert_eq!(signed(-0.056_24, 3, ','), "−0,0562");
        assert_eq!(signed(0.099_96, 3, '.'), "+0.100");
        assert_eq!(signed(123.4, 3, '.'), "+123");
        assert_eq!(signed(-1.5e-9, 2, ','), "−1,5e−9");
        assert_eq!(signed(-0.0, 3, '.'), "0");
    }

    #[test]
    fn numbers_that_are_none_are_marked() {
        assert_eq!(signed(f64::NAN, 3, '.'), "–");
        assert_eq!(signed(f64::NEG_INFINITY, 3, '.'), "−∞");
    }
}
