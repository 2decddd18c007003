//! The charts as they reach a backend and an SVG file.

mod fixture;
mod level_loop;
mod painting;
mod properties;
mod recorder;
mod svg;
