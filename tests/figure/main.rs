//! The charts as they reach a backend and an SVG file.
#![cfg(not(target_arch = "wasm32"))]

mod fixture;
mod painting;
mod properties;
mod recorder;
mod svg;
