//! Roots and minima of functions of one variable.

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

/// Where a smooth function changes its sign, given at both ends of an interval, or an end where it is zero: regula falsi with the
/// correction of Illinois.
pub fn root(function: impl Fn(f64) -> f64, (start, at_start): (f64, f64), (end, at_end): (f64, f64)) -> f64 {
    if at_start == 0.0 {
        return start;
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_root_is_found_to_the_last_digits() {
        let cosine = root(f64::cos, (1.0, 1.0_f64.cos()), (3.0, 3.0_f64.cos()));
        assert!((cosine - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
        // Falling or rising, and one that is flat on one side.
        let cube = root(|x| x * x * x - 1e-3, (-1.0, -1.001), (4.0, 64.0));
        assert!((cube - 0.1).abs() < 1e-14);
        // At an end.
        assert_eq!(root(|x| x, (0.0, 0.0), (1.0, 1.0)), 0.0);
        assert_eq!(root(|x| x - 1.0, (0.0, -1.0), (1.0, 0.0)), 1.0);
    }

    #[test]
    fn the_golden_section_finds_a_minimum() {
        let found = golden_section(|x| (x - 0.3) * (x - 0.3), -1.0, 2.0);
        assert!((found - 0.3).abs() < 1e-7);
    }
}
