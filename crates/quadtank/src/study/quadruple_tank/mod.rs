//! The study of the home bench: a quadruple tank with two PI loops, from two valves to the step response.

mod analysis;
mod first_steps;
mod frequency_curves;
mod guaranteed_margins;
mod identification;
mod mends;
mod prepared;
mod published;
mod quantities;
mod results;
mod run;
mod setup;
mod valve_map;
mod zero_situation;

pub use analysis::{Analysis, analyse};
pub use first_steps::{
    Direction, detuned, direction_steps, first_experiment, fitted_duration_s, held_operating_point, shown_until_s,
};
pub use frequency_curves::{ClosedCurves, FrequencyCurves};
pub use guaranteed_margins::GuaranteedMargins;
pub use mends::{Mend, mend_loop, mend_rest, mend_run};
pub use prepared::Prepared;
pub use published::setup_of;
pub use results::{QuadrupleTankStudy, Results};
pub use run::{Run, nonlinear_run, run};
pub use setup::{OperatingPointSpec, PlantSpec, Setup};
pub use valve_map::ValveMap;
pub use zero_situation::{ZeroEffect, ZeroSituation};
