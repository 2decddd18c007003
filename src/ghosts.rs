//! How far a level moves in a run: marks on the walls that stay when the water has gone on.

/// Least difference of the two marks of a tank, as a share of its height.
const MIN_GHOST: f64 = 0.04;

/// The least and the highest level of a tank in a run (m), where it moves enough to tell them apart; its wall in m.
pub fn moved_between(levels: &[f64], height: f64) -> Option<[f64; 2]> {
    let levels = levels.iter().copied();
    let (low, high) = (levels.clone().reduce(f64::min)?, levels.reduce(f64::max)?);
    (high - low > MIN_GHOST * height).then_some([low, high])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_need_a_level_that_moves() {
        assert_eq!(moved_between(&[0.1, 0.12, 0.08, 0.1], 0.2), Some([0.08, 0.12]));
        assert_eq!(moved_between(&[0.1, 0.107], 0.2), None);
        assert_eq!(moved_between(&[], 0.2), None);
    }
}
