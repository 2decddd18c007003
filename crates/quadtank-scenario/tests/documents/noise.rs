use crate::seeded;

#[test]
fn a_seed_gives_the_same_run_as_in_the_browser() {
    let found = seeded::total_variation();
    assert!((found - seeded::TOTAL_VARIATION).abs() <= seeded::TOLERANCE, "{found}");
}
