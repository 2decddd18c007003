//! The study of the relay-tuning bench: relay test, critical curve, placement of the critical point, response (Campestrini 2006).

mod critical_reading;
mod design;
mod details;
mod element;
mod mend;
mod plant;
mod plant_study;
mod printed;
mod quantities;
mod results;
mod rig;
mod setup;
mod start;
mod steady_state;

pub use critical_reading::CriticalReading;
pub use design::{Comparison, ControllerForms, DesignRoot, Designed, StepResponse};
pub use details::{PlacedLoci, Recovered};
pub use element::{Element, ElementFault};
pub use mend::Mend;
pub use plant::TuningPlant;
pub use plant_study::{FoundPoint, PlantStudy, Tested, Tuning, tune};
pub use printed::{PrintedFigure, printed_figures, rule_targets};
pub use results::{DesignOutcome, RelayTuningStudy, Results};
pub use setup::{
    CompareSpec, CriticalSpec, DecouplerSpec, DesignSpec, ResponseSpec, SeriesElement, TestKind, TestSpec, TuningSetup,
};
pub use steady_state::SteadyState;
