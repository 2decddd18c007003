/// The power of two nearest to a positive number on a logarithmic scale. A matrix that is scaled by it keeps all its digits.
#[expect(clippy::cast_possible_truncation, reason = "the exponent of a float is small, and the cast saturates")]
pub fn nearest_power_of_two(size: f64) -> f64 {
    2.0_f64.powi(size.log2().round() as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_is_meant_on_a_logarithmic_scale() {
        assert_eq!([3.0, 0.7, 1e-3].map(nearest_power_of_two), [4.0, 0.5, 1.0 / 1024.0]);
    }
}
