//! Printed numbers of the sources, one test per table.
//!
//! They run on the host and, by `wasm_bindgen_test` in the place of `test`, in a browser.

#[cfg(target_arch = "wasm32")]
wasm_bindgen_test::wasm_bindgen_test_configure!(run_in_browser);

mod andreis_indices;
mod andreis_plant;
mod andreis_summaries;
mod andreis_tuning;
mod andreis_variances;
mod campestrini_loops;
mod campestrini_placement;
mod campestrini_relay;
mod campestrini_tables;
mod closed_loop;
mod junqueira;
mod level_loop_study;
mod level_slides;
mod other_rigs;
mod tables;
mod wood_berry;

/// Whether a figure is within a distance of a printed one, or at that distance but for rounding.
fn within(found: f64, printed: f64, distance: f64, what: &str) {
    assert!((found - printed).abs() <= distance * 1.000_001, "{what}: {found}, printed {printed}");
}
