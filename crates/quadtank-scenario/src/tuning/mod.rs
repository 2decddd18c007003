//! The document of a relay-tuning session, version 2, and what follows from it.

mod answer;
mod csv;
mod designed;
mod details;
mod document;
mod element;
mod plant;
mod printed;
mod published;
mod rig;
mod start;
mod steady_state;
mod validate;
mod warnings;

pub use answer::{FoundPoint, Study, Tested, Tuning, tune};
pub use csv::{curve_to_csv, loci_to_csv, record_to_csv, response_to_csv};
pub use designed::{Comparison, DesignRoot, Designed, StepResponse};
pub use details::Recovered;
pub use document::{
    Behind, CompareSpec, CriticalSpec, DecouplerSpec, DesignSpec, ResponseSpec, TestKind, TestSpec, TuningScenario,
    TuningSetup,
};
pub use element::{Element, ElementFault};
pub use plant::TuningPlant;
pub use printed::{PrintedFigure, PrintedRemark, rule_targets};
pub use published::PublishedCase;
pub use steady_state::SteadyState;
pub use warnings::TuningWarning;
