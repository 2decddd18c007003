//! Small operations on numbers, written so that WebAssembly does them well.
//!
//! On wasm32 `f64::max` and `f64::min` are calls into the mathematics library; a comparison is one instruction. Where the
//! first number is NaN, so is the comparison false and the second number the result.

use std::cmp::Ordering;

/// The larger of two numbers.
#[inline]
pub fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The smaller of two numbers.
#[inline]
pub fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// How far two shares that add up to 1 in decimals may miss that in binary: half a unit in the last place of a share in
/// [½, 1) and of one in [¼, ½).
const SHARE_ROUNDING: f64 = 0.375 * f64::EPSILON;

/// 1 − a and 1 − b of two shares in [0, 1]. Where a + b is 1 to the rounding of the shares, each is the other exactly: beside
/// 1e-6 stands 0.999999, whose complement in binary equals 1e-6 to ten digits only. Shares of 0 and 1 are exact.
#[inline]
pub fn complements([a, b]: [f64; 2]) -> [f64; 2] {
    let (smaller, larger) = if a < b { (a, b) } else { (b, a) };
    let is_inexact = smaller > 0.0 && larger < 1.0;
    if is_inexact && (1.0 - larger - smaller).abs() <= SHARE_ROUNDING { [b, a] } else { [1.0 - a, 1.0 - b] }
}

/// a + b − 1 of two shares, exactly 0 where it is 0 to their rounding (see [`complements`]).
#[inline]
pub fn excess_over_one([a, b]: [f64; 2]) -> f64 {
    let [without_a, without_b] = complements([a, b]);
    // The complement of the larger share is exact.
    if a < b { a - without_b } else { b - without_a }
}

/// Sorts a handful of values by insertion; equal ones keep their order. The sort of the standard library is quicker from
/// about twenty values on, and 3 KB more for each type.
pub fn sort_few<T>(values: &mut [T], order: impl Fn(&T, &T) -> Ordering) {
    for end in 1..values.len() {
        let mut at = end;
        while at > 0 && order(&values[at], &values[at - 1]) == Ordering::Less {
            values.swap(at, at - 1);
            at -= 1;
        }
    }
}

/// Steps of a golden-section search: the interval shrinks to some 1e-8 of itself, and the minimum to its square.
const GOLDEN_STEPS: u32 = 40;

/// Where a function with one minimum between two points has it.
pub fn golden_section(function: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let share = (5.0_f64.sqrt() - 1.0) / 2.0;
    let (mut a, mut b) = (high - share * (high - low), low + share * (high - low));
    let (mut at_a, mut at_b) = (function(a), function(b));
    for _ in 0..GOLDEN_STEPS {
        if at_a < at_b {
            (high, b, at_b) = (b, a, at_a);
            a = high - share * (high - low);
            at_a = function(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = low + share * (high - low);
            at_b = function(b);
        }
    }
    f64::midpoint(low, high)
}

/// Steps of a root search; each adds about half as many digits again.
const ROOT_STEPS: u32 = 60;
/// Share of the interval below which it is a point.
const ROOT_SHARE: f64 = 1e-16;

/// Where a smooth function changes its sign, given at both ends of an interval: regula falsi with the correction of Illinois.
pub fn root(function: impl Fn(f64) -> f64, (start, at_start): (f64, f64), (end, at_end): (f64, f64)) -> f64 {
    let (mut low, mut at_low, mut high, mut at_high) = (start, at_start, end, at_end);
    let sign = at_start.signum();
    let mut side = 0;
    let mut last = end;
    for _ in 0..ROOT_STEPS {
        let middle = (low * at_high - high * at_low) / (at_high - at_low);
        if !(middle > low && middle < high) || high - low <= ROOT_SHARE * (end - start) {
            break;
        }
        let at_middle = function(middle);
        last = middle;
        if at_middle == 0.0 {
            break;
        }
        if at_middle.signum() == sign {
            (low, at_low) = (middle, at_middle);
            if side == 1 {
                at_high *= 0.5;
            }
            side = 1;
        } else {
            (high, at_high) = (middle, at_middle);
            if side == -1 {
                at_low *= 0.5;
            }
            side = -1;
        }
    }
    last
}

/// `2^exponent`, exact. A general power of two brings a table of 4 KB along.
pub fn power_of_two(exponent: i32) -> f64 {
    2.0_f64.powi(exponent)
}

/// `base^exponent` of a positive base, to some digits less than a float has: relative error about 1e-16 times the logarithm of
/// the result. The power of the standard library, which is exact to the last digit, is 2 KB of code and tables.
pub fn power(base: f64, exponent: f64) -> f64 {
    (exponent * base.ln()).exp()
}

/// π/2 in three pieces: whole multiples of the first two are exact up to 2^20 quarter turns.
const QUARTER: [f64; 3] = [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];
/// sin x = x + x³ (S₁ + S₂ x² + …) and cos x = 1 − x²/2 + x⁴ (C₁ + C₂ x² + …) for |x| ≤ π/4, the polynomials of least error that
/// all mathematics libraries have from Sun's fdlibm.
const SINE: [f64; 6] = [
    -1.666_666_666_666_663_2e-1,
    8.333_333_333_322_49e-3,
    -1.984_126_982_985_795e-4,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];
const COSINE: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// Sine and cosine of an angle (rad), to about 1e-16 up to a million, less exact beyond. Those of the standard library bring a
/// reduction for angles up to 1e308 along, 4 KB of code and tables.
#[expect(clippy::cast_possible_truncation, reason = "only the last two bits count")]
pub fn sine_cosine(angle: f64) -> (f64, f64) {
    let quarters = (angle * std::f64::consts::FRAC_2_PI + 0.5).floor();
    let x = angle - quarters * QUARTER[0] - quarters * QUARTER[1] - quarters * QUARTER[2];
    let square = x * x;
    let polynomial = |terms: [f64; 6]| terms.iter().rev().fold(0.0, |sum, term| sum * square + term);
    let sine = x + x * square * polynomial(SINE);
    let cosine = 1.0 - (0.5 * square - square * square * polynomial(COSINE));
    match quarters as i64 & 3 {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}

/// The power of two nearest to a positive number on a logarithmic scale.
#[expect(clippy::cast_possible_truncation, reason = "the exponent of a float is small, and the cast saturates")]
pub fn nearest_power_of_two(size: f64) -> f64 {
    power_of_two((size.ln() / std::f64::consts::LN_2).round() as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn not_a_number_gives_way_to_the_second() {
        assert_eq!((larger(1.0, 2.0), larger(2.0, 1.0), larger(f64::NAN, 0.0)), (2.0, 2.0, 0.0));
        assert_eq!((smaller(1.0, 2.0), smaller(2.0, 1.0), smaller(f64::NAN, 0.0)), (1.0, 1.0, 0.0));
    }

    #[test]
    fn shares_that_add_up_to_one_in_decimals_are_complements() {
        let two = |digits: usize, share: u64| {
            let of = |share: u64| format!("0.{share:0digits$}").parse::<f64>().unwrap();
            [of(share), of(10_u64.pow(u32::try_from(digits).unwrap()) - share)]
        };
        for digits in 1..=16 {
            for share in [1, 2, 3, 7, 9].into_iter().chain((1..40).map(|k| 10_u64.pow(digits) * k / 81)) {
                let [a, b] = two(digits as usize, share.max(1));
                assert_eq!(complements([a, b]), [b, a]);
                assert_eq!((excess_over_one([a, b]), excess_over_one([b, a])), (0.0, 0.0), "{a} {b}");
            }
        }
        // Two units in the last place further they are not.
        for [a, b] in [[0.999_999, 1e-6], [0.7, 0.3], [1.0 - 1e-15, 1e-15]] {
            for b in [b - 2.3e-16, b + 2.3e-16] {
                assert_eq!(complements([a, b])[0], 1.0 - a);
                assert!(excess_over_one([a, b]).abs() > 1e-16);
            }
        }
        assert_eq!(
            (complements([1.0, 1e-17]), complements([0.0, 1.0 - 1e-16])),
            ([0.0, 1.0], [1.0, 1.0 - (1.0 - 1e-16)])
        );
        assert_eq!((excess_over_one([1.0, 1e-17]), excess_over_one([0.0, 0.0])), (1e-17, -1.0));
    }

    #[test]
    fn a_few_values_are_sorted_and_equal_ones_keep_their_order() {
        let mut values = [(3, 'a'), (1, 'b'), (3, 'c'), (2, 'd'), (1, 'e')];
        sort_few(&mut values, |x, y| x.0.cmp(&y.0));
        assert_eq!(values, [(1, 'b'), (1, 'e'), (2, 'd'), (3, 'a'), (3, 'c')]);
        sort_few(&mut [0.0; 0], f64::total_cmp);
    }

    #[test]
    fn a_root_is_found_to_the_last_digits() {
        let cosine = root(f64::cos, (1.0, 1.0_f64.cos()), (3.0, 3.0_f64.cos()));
        assert!((cosine - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
        // Falling or rising, and one that is flat on one side.
        let cube = root(|x| x * x * x - 1e-3, (-1.0, -1.001), (4.0, 64.0));
        assert!((cube - 0.1).abs() < 1e-14);
    }

    #[test]
    fn the_golden_section_finds_a_minimum() {
        let found = golden_section(|x| (x - 0.3) * (x - 0.3), -1.0, 2.0);
        assert!((found - 0.3).abs() < 1e-7);
    }

    #[test]
    fn powers_are_good_to_fourteen_digits() {
        for (base, exponent) in [(10.0, 0.125), (1e-3, -2.5), (0.8, 200.0), (3000.0, 1.0), (7.0, 0.0)] {
            let (found, exact) = (power(base, exponent), f64::powf(base, exponent));
            assert!((found - exact).abs() < 1e-14 * exact, "{base}^{exponent}: {found} is not {exact}");
        }
    }

    #[test]
    fn sines_and_cosines_are_those_of_the_standard_library() {
        let angles = (-4000..4000).map(|k| f64::from(k) * 0.012_345).chain([1e-9, 1e3, -5e4, 1e6, 31_415.926_535, 0.0]);
        for angle in angles {
            let (sine, cosine) = sine_cosine(angle);
            let (exact_sine, exact_cosine) = angle.sin_cos();
            assert!((sine - exact_sine).abs() < 2.3e-16 && (cosine - exact_cosine).abs() < 2.3e-16, "{angle}");
        }
        let (sine, cosine) = sine_cosine(f64::NAN);
        assert!(sine.is_nan() && cosine.is_nan() && sine_cosine(f64::INFINITY).0.is_nan());
        assert!(sine_cosine(1e300).0.abs() <= 1.0 || sine_cosine(1e300).0.is_nan());
    }

    #[test]
    fn powers_of_two_are_exact() {
        assert_eq!((power_of_two(10), power_of_two(-3), power_of_two(1023)), (1024.0, 0.125, 2.0_f64.powi(1023)));
        assert_eq!(
            (nearest_power_of_two(3.0), nearest_power_of_two(0.7), nearest_power_of_two(1e-3)),
            (4.0, 0.5, 1.0 / 1024.0)
        );
    }
}
