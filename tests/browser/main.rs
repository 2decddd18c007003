//! What needs a browser, headless and without the built site: the core as WebAssembly, and each bench mounted into a page.
#![cfg(target_arch = "wasm32")]

mod benches;
mod core;
mod new_bench;
mod page;
#[path = "../../crates/quadtank-scenario/tests/seeded/mod.rs"]
mod seeded;

wasm_bindgen_test::wasm_bindgen_test_configure!(run_in_browser);
