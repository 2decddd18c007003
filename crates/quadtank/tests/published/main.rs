//! Printed numbers of the sources, one test per table.
//!
//! They run on the host and, by `wasm_bindgen_test` in the place of `test`, in a browser.

#[cfg(target_arch = "wasm32")]
wasm_bindgen_test::wasm_bindgen_test_configure!(run_in_browser);

mod campestrini_loops;
mod campestrini_placement;
mod campestrini_relay;
mod campestrini_tables;
mod closed_loop;
mod junqueira;
mod tables;
