//! The document of a relay-tuning session, version 2, and what follows from it.

mod answer;
mod document;
mod published;

pub use answer::{DesignRoot, Designed, FoundPoint, Tested, Tuning, tune};
pub use document::{
    Behind, CriticalSpec, DecouplerSpec, DesignSpec, Element, ResponseSpec, TestKind, TestSpec, TuningPlant,
    TuningScenario, TuningSetup,
};
pub use published::PublishedCase;
