use std::iter;

use super::scale::{self, Scale};

/// Largest magnitude an axis shows; keeps every later product finite.
pub(super) const LARGEST: f64 = 1e100;
/// Smallest span of an axis relative to its values; below it, neighbouring ticks would not differ as `f64`.
pub(super) const SMALLEST_RELATIVE_SPAN: f64 = 1e-9;
/// Whole numbers with more digits than this, and fractions with more decimals, are written with a power of ten.
const MAX_DIGITS: i32 = 6;

/// One axis: what is said beside it, and the range it shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Name and unit, as shown; empty for none.
    pub label: String,
    /// First and last value shown. Any numbers are allowed; see [`Axis::span`].
    pub range: (f64, f64),
    /// Whether the ticks carry numbers; off where the chart below shows the same axis.
    pub numbered: bool,
    /// How values are spread between its ends.
    pub scale: Scale,
}

impl Axis {
    /// An axis with exactly this range.
    pub fn new(label: impl Into<String>, range: (f64, f64)) -> Self {
        Self { label: label.into(), range, numbered: true, scale: Scale::Linear }
    }

    /// A logarithmic axis with exactly this range.
    pub fn logarithmic(label: impl Into<String>, range: (f64, f64)) -> Self {
        Self { scale: Scale::Logarithmic, ..Self::new(label, range) }
    }

    /// An axis whose range is widened to whole ticks, about `ticks` of them.
    pub fn rounded(label: impl Into<String>, range: (f64, f64), ticks: usize) -> Self {
        let (min, max) = sane(range);
        let step = Step::for_span(max - min, ticks);
        Self::new(label, (step.value(step.floor(min)), step.value(step.ceil(max))))
    }

    /// The range, made usable: rising, finite, wide enough to tell values apart, and positive on a logarithmic axis.
    pub fn span(&self) -> (f64, f64) {
        match self.scale {
            Scale::Linear => sane(self.range),
            Scale::Logarithmic => scale::sane(self.range),
        }
    }

    /// At most `most` + 1 ticks inside the range: at equal distances of 1, 2 or 5 times a power of ten, or on a logarithmic axis at 1, 2 and 5
    /// times powers of ten.
    pub fn ticks(&self, most: usize) -> Vec<Tick> {
        match self.scale {
            Scale::Linear => linear_ticks(self.span(), most),
            Scale::Logarithmic => scale::ticks(self.span(), most),
        }
    }
}

/// The ticks of a linear axis with a usable range.
pub(super) fn linear_ticks((min, max): (f64, f64), most: usize) -> Vec<Tick> {
    let step = Step::for_span(max - min, most);
    let (first, last) = (step.ceil(min), step.floor(max));
    let mut count = first;
    iter::from_fn(|| {
        let tick = (count <= last).then(|| Tick {
            value: step.value(count),
            digits: count * step.mantissa,
            exponent: step.exponent,
            most_digits: MAX_DIGITS,
        });
        count += 1;
        tick
    })
    .take(most + 1)
    .collect()
}

/// A tick: its value, and the same as `digits × 10^exponent`, so that it is written without rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tick {
    /// Where on the axis.
    pub value: f64,
    digits: i64,
    exponent: i32,
    most_digits: i32,
}

impl Tick {
    /// The tick at `mantissa × 10^exponent`, written with a power of ten if it has more digits or decimals than `most_digits`.
    pub(super) fn new(mantissa: i64, exponent: i32, most_digits: i32) -> Self {
        Self { value: Step { mantissa, exponent }.value(1), digits: mantissa, exponent, most_digits }
    }

    /// The number as shown, with the decimal separator of the reader's language and a true minus sign.
    pub fn text(&self, decimal: char) -> String {
        let sign = if self.digits < 0 { "−" } else { "" };
        let magnitude = self.digits.unsigned_abs().to_string();
        let whole_digits = i32::try_from(magnitude.len()).unwrap_or(i32::MAX).saturating_add(self.exponent);
        let body = if self.digits == 0 {
            magnitude
        } else if self.exponent < -self.most_digits || whole_digits > self.most_digits {
            powered(&magnitude, whole_digits - 1, decimal)
        } else if let Ok(zeros) = usize::try_from(self.exponent) {
            magnitude + &"0".repeat(zeros)
        } else {
            pointed(&magnitude, self.exponent.unsigned_abs() as usize, decimal)
        };
        format!("{sign}{body}")
    }
}

/// `digits` with the last `decimals` of them behind the separator.
fn pointed(digits: &str, decimals: usize, decimal: char) -> String {
    let missing = (decimals + 1).saturating_sub(digits.len());
    let padded = "0".repeat(missing) + digits;
    let (whole, fraction) = padded.split_at(padded.len() - decimals);
    format!("{whole}{decimal}{fraction}")
}

/// `d.ddd × 10^exponent` in the short form of programs, `1.5e−7`.
fn powered(digits: &str, exponent: i32, decimal: char) -> String {
    let (first, rest) = digits.split_at(1);
    let rest = rest.trim_end_matches('0');
    let point = if rest.is_empty() { String::new() } else { format!("{decimal}{rest}") };
    let sign = if exponent < 0 { "−" } else { "" };
    format!("{first}{point}e{sign}{}", exponent.unsigned_abs())
}

/// The distance of two ticks, `mantissa × 10^exponent`.
#[derive(Clone, Copy)]
struct Step {
    mantissa: i64,
    exponent: i32,
}

impl Step {
    /// The smallest step of the series 1, 2, 5 that puts at most `most` steps into `span`.
    #[expect(clippy::cast_possible_truncation, reason = "the exponent of a finite f64 fits i32")]
    fn for_span(span: f64, most: usize) -> Self {
        let rough = span / most.max(1) as f64;
        let exponent = rough.log10().floor() as i32;
        let power = power_of_ten(exponent);
        let mantissa = [1, 2, 5].into_iter().find(|&m| m as f64 * power >= rough * (1.0 - 1e-9));
        mantissa.map_or(Self { mantissa: 1, exponent: exponent + 1 }, |mantissa| Self { mantissa, exponent })
    }

    fn value(self, count: i64) -> f64 {
        let digits = (count * self.mantissa) as f64;
        if self.exponent < 0 { digits / power_of_ten(-self.exponent) } else { digits * power_of_ten(self.exponent) }
    }

    fn floor(self, value: f64) -> i64 {
        self.count(value, f64::floor, 1e-9)
    }

    fn ceil(self, value: f64) -> i64 {
        self.count(value, f64::ceil, -1e-9)
    }

    /// `value` in steps. A value within rounding of a whole number of them counts as that number.
    #[expect(clippy::cast_possible_truncation, reason = "a sane range has fewer than 1e12 steps to the origin")]
    fn count(self, value: f64, round: fn(f64) -> f64, slack: f64) -> i64 {
        let steps = value / self.value(1);
        round(steps + slack * steps.abs().clamp(1.0, 1e3)) as i64
    }
}

fn power_of_ten(exponent: i32) -> f64 {
    10f64.powi(exponent)
}

/// See [`Axis::span`].
fn sane((from, to): (f64, f64)) -> (f64, f64) {
    if !(from.is_finite() && to.is_finite()) {
        return (0.0, 1.0);
    }
    let (from, to) = (from.clamp(-LARGEST, LARGEST), to.clamp(-LARGEST, LARGEST));
    let (min, max) = (from.min(to), from.max(to));
    let magnitude = min.abs().max(max.abs());
    if max - min > magnitude * SMALLEST_RELATIVE_SPAN && max - min > 1.0 / LARGEST {
        return (min, max);
    }
    let half = if magnitude > 1.0 / LARGEST { magnitude * 0.1 } else { 0.5 };
    (min - half, max + half)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(range: (f64, f64), most: usize) -> Vec<String> {
        Axis::new("", range).ticks(most).iter().map(|tick| tick.text('.')).collect()
    }

    #[test]
    fn ticks_are_at_one_two_or_five() {
        assert_eq!(
            texts((0.0, 1.0), 5),
            ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"].map(|t| if t == "0.0" { "0" } else { t })
        );
        assert_eq!(texts((0.0, 3000.0), 6), ["0", "500", "1000", "1500", "2000", "2500", "3000"]);
        assert_eq!(texts((11.2, 13.9), 6), ["11.5", "12.0", "12.5", "13.0", "13.5"]);
        assert_eq!(texts((-0.06, 0.02), 4), ["−0.06", "−0.04", "−0.02", "0", "0.02"]);
    }

    #[test]
    fn tick_values_are_the_nearest_floats_of_their_text() {
        for tick in Axis::new("", (-0.7, 0.7)).ticks(14) {
            assert_eq!(tick.text('.').replace('−', "-").parse::<f64>().ok(), Some(tick.value));
        }
    }

    #[test]
    fn the_decimal_separator_is_the_readers() {
        assert_eq!(Axis::new("", (0.0, 1.0)).ticks(2)[1].text(','), "0,5");
    }

    #[test]
    fn very_small_and_very_large_numbers_use_a_power_of_ten() {
        assert_eq!(texts((0.0, 3e-9), 3), ["0", "1e−9", "2e−9", "3e−9"]);
        assert_eq!(texts((0.0, 3e7), 2), ["0", "2e7"]);
        assert_eq!(texts((1.5e20, 3.0e20), 3), ["1.5e20", "2e20", "2.5e20", "3e20"]);
    }

    #[test]
    fn a_rounded_range_ends_on_ticks() {
        assert_eq!(Axis::rounded("", (11.3, 15.7), 5).range, (11.0, 16.0));
        assert_eq!(Axis::rounded("", (11.0, 16.0), 5).range, (11.0, 16.0));
    }

    #[test]
    fn a_range_without_sense_is_replaced() {
        assert_eq!(Axis::new("", (f64::NAN, 1.0)).span(), (0.0, 1.0));
        assert_eq!(Axis::new("", (2.0, -1.0)).span(), (-1.0, 2.0));
        assert_eq!(Axis::new("", (0.0, 0.0)).span(), (-0.5, 0.5));
        let (min, max) = Axis::new("", (10.0, 10.0)).span();
        assert!(min < 10.0 && max > 10.0);
        let (min, max) = Axis::new("", (f64::MIN, f64::MAX)).span();
        assert!((max - min).is_finite());
    }
}
