//! Where values stand along an axis, and the ticks of a logarithmic one.

use super::Tick;
use super::axis::{LARGEST, SMALLEST_RELATIVE_SPAN, linear_ticks};

/// How values are spread along an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// Evenly.
    #[default]
    Linear,
    /// Evenly in the logarithm. What is not positive is infinitely far down.
    Logarithmic,
}

impl Scale {
    /// Where a value stands in a usable range: 0 at its beginning, 1 at its end.
    pub(super) fn share(self, (from, to): (f64, f64), value: f64) -> f64 {
        match self {
            Self::Linear => (value - from) / (to - from),
            Self::Logarithmic if value <= 0.0 => f64::NEG_INFINITY,
            Self::Logarithmic => (value / from).ln() / (to / from).ln(),
        }
    }

    /// The value that stands there.
    pub(super) fn value(self, (from, to): (f64, f64), share: f64) -> f64 {
        match self {
            Self::Linear => from + share * (to - from),
            Self::Logarithmic => from * (to / from).powf(share),
        }
    }
}

/// What is shown of a logarithmic axis that would begin at or below zero: so many times its end.
const DEPTH: f64 = 1e-3;

/// A range for a logarithmic axis, made usable as [`Axis::span`](super::Axis::span) says: rising, positive, and wide enough.
pub(super) fn sane((from, to): (f64, f64)) -> (f64, f64) {
    let max = from.max(to).min(LARGEST);
    if !(from.is_finite() && to.is_finite() && max > 0.0) {
        return (1.0, 10.0);
    }
    let max = max.max(1.0 / LARGEST);
    let min = if from.min(to) > 0.0 { from.min(to).clamp(1.0 / LARGEST, LARGEST) } else { DEPTH * max };
    if max / min > 1.0 + SMALLEST_RELATIVE_SPAN { (min, max) } else { (min / 1.1, max * 1.1) }
}

/// Whole numbers with more digits than this, and fractions with more decimals, are written with a power of ten: numbers of many
/// magnitudes stand beside each other.
const MAX_DIGITS: i32 = 4;

/// At most `most` + 1 ticks inside a usable range: at powers of ten, and at 2 and 5 times these where there is room. A range in which these
/// are fewer than two has those of a linear axis, as far as there is room.
pub(super) fn ticks((min, max): (f64, f64), most: usize) -> Vec<Tick> {
    let decades = (max / min).log10();
    let gap = decades / most.max(1) as f64 * (1.0 - 1e-9);
    let mut ticks = spaced(powers((min, max), gap), gap);
    if ticks.len() < 2 {
        let linear = spaced(linear_ticks((min, max), most).into_iter().filter(|tick| tick.value > 0.0), gap);
        ticks = if linear.len() > ticks.len() { linear } else { ticks };
    }
    ticks.truncate(most + 1);
    ticks.sort_by(|a, b| a.value.total_cmp(&b.value));
    ticks
}

/// Powers of ten in a range, then 2 and 5 times these. With less than a decade for each `gap`, every n-th power alone.
#[expect(clippy::cast_possible_truncation, reason = "exponents of a usable range are small")]
fn powers((min, max): (f64, f64), gap: f64) -> impl Iterator<Item = Tick> {
    let exponents = min.log10().floor() as i32..=max.log10().ceil() as i32;
    let stride = gap.ceil().max(1.0) as i32;
    let mantissas: &[i64] = if stride == 1 { &[1, 2, 5] } else { &[1] };
    let ticks = mantissas.iter().flat_map(move |&mantissa| {
        let exponents = exponents.clone().filter(move |exponent| exponent.rem_euclid(stride) == 0);
        exponents.map(move |exponent| Tick::new(mantissa, exponent, MAX_DIGITS))
    });
    let slack = 1e-9;
    ticks.filter(move |tick| min * (1.0 - slack) <= tick.value && tick.value <= max * (1.0 + slack))
}

/// Those of the ticks that are at least `gap` decades from all before them.
fn spaced(ticks: impl Iterator<Item = Tick>, gap: f64) -> Vec<Tick> {
    ticks.fold(Vec::new(), |mut chosen, tick| {
        if chosen.iter().all(|other: &Tick| (other.value / tick.value).log10().abs() >= gap) {
            chosen.push(tick);
        }
        chosen
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Axis;

    fn texts(range: (f64, f64), most: usize) -> Vec<String> {
        Axis::logarithmic("", range).ticks(most).iter().map(|tick| tick.text('.')).collect()
    }

    #[test]
    fn ticks_are_at_powers_of_ten_with_two_and_five_where_there_is_room() {
        assert_eq!(texts((1.0, 100.0), 8), ["1", "2", "5", "10", "20", "50", "100"]);
        assert_eq!(texts((1.0, 100.0), 5), ["1", "10", "100"]);
        assert_eq!(texts((1e-8, 1e-2), 6), ["1e−8", "1e−7", "1e−6", "1e−5", "0.0001", "0.001", "0.01"]);
        assert_eq!(texts((1e-8, 1e-2), 3), ["1e−8", "1e−6", "0.0001", "0.01"]);
        assert_eq!(texts((100.0, 1e5), 4), ["100", "1000", "1e4", "1e5"]);
        assert_eq!(texts((0.15, 80.0), 4), ["0.2", "1", "10", "50"], "at the ends there is room");
    }

    #[test]
    fn a_short_range_has_the_ticks_of_a_linear_axis() {
        assert_eq!(texts((1.1, 1.4), 4), ["1.1", "1.2", "1.3", "1.4"]);
        assert_eq!(texts((2.1, 4.9), 3), ["3", "4"]);
    }

    #[test]
    fn tick_values_are_the_nearest_floats_of_their_text() {
        for tick in Axis::logarithmic("", (1e-9, 1e9)).ticks(100) {
            assert_eq!(tick.text('.').replace('−', "-").parse::<f64>().ok(), Some(tick.value));
        }
    }

    #[test]
    fn a_range_without_sense_is_replaced() {
        let span = |range| Axis::logarithmic("", range).span();
        for range in [(f64::NAN, 1.0), (1.0, f64::INFINITY), (0.0, 0.0), (-2.0, -1.0)] {
            assert_eq!(span(range), (1.0, 10.0));
        }
        assert_eq!(span((5.0, 0.1)), (0.1, 5.0));
        assert_eq!(span((0.0, 10.0)), (0.01, 10.0));
        let (min, max) = span((3.0, 3.0));
        assert!(min < 3.0 && 3.0 < max);
        for range in [(f64::MIN_POSITIVE, f64::MAX), (f64::MAX, f64::MAX), (1e-320, 1e-319)] {
            let (min, max) = span(range);
            assert!(0.0 < min && min < max && (max / min).is_finite(), "{min} {max}");
        }
    }

    #[test]
    fn a_share_leads_back_to_its_value() {
        for value in [1e-3, 0.02, 7.0, 1e4, 1e9] {
            let share = Scale::Logarithmic.share((1e-2, 1e4), value);
            assert!((Scale::Logarithmic.value((1e-2, 1e4), share) / value - 1.0).abs() < 1e-9);
        }
        assert!((Scale::Logarithmic.share((1.0, 100.0), 10.0) - 0.5).abs() < 1e-12);
        assert_eq!(Scale::Logarithmic.share((1.0, 100.0), 0.0), f64::NEG_INFINITY);
        assert!(Scale::Logarithmic.share((1.0, 100.0), f64::NAN).is_nan());
    }
}
