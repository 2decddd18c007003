//! Shares that add up to one, such as those of a three-way valve.

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

#[cfg(test)]
mod tests {
    use super::*;

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
}
