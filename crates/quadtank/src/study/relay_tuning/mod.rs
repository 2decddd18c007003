//! The study of the relay-tuning bench: relay test, critical curve, placement of the critical point, response (Campestrini 2006).

mod compared;
mod critical_reading;
mod design;
mod design_spec;
mod details;
mod element;
mod given_pid;
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
mod step_response;

pub use compared::{ComparedControllers, ControllerAssessment, RuleControllers};
pub use critical_reading::CriticalReading;
pub use design::{ControllerForms, CriticalResponse, DesignRoot, Designed};
pub use design_spec::{CriticalSpec, DecouplerSpec, DesignSpec};
pub use details::{LoopPeaks, PlacedLoci, RecoveredResponse};
pub use element::{Element, ElementError};
pub use given_pid::{FormError, GivenPid, PidForm};
pub use mend::{Mend, mend_pairing};
pub use plant::{TunedTank, TunedTankMut, TuningPlant};
pub use plant_study::{FoundPoint, PlantStudy, Tested, Tuning, tune};
pub use printed::{PrintedFigure, printed_figures, rule_targets};
pub use results::{DesignOutcome, RelayTuningStudy, Results};
pub use setup::{CompareSpec, ResponseSpec, SeriesElement, TestKind, TestSpec, TuningSetup};
pub use steady_state::SteadyState;
pub use step_response::{Comparison, StepResponse};
