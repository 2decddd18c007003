//! What is printed: one module per source, with its rigs, cases, printed numbers and what is to be known about the print.
//!
//! [`PresetId`] names the published rigs of all sources.

pub mod andreis;
pub mod campestrini;
mod cocota;
mod dtu;
mod johansson;
pub mod junqueira;
mod level_preset;
pub mod level_slides;
mod mpctools;
mod quanser;
mod rig;
mod seville;
mod units;
pub mod wood_berry;

pub use level_preset::LevelPresetId;
pub use rig::{DisplayUnit, PiExperiment, Preset, PresetId, Printed, ReferenceMoves};
