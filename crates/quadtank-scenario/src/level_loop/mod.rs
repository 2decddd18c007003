//! The document of a level loop, version 4.

mod document;

pub use document::LevelLoopScenario;
