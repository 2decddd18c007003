//! How gains are found: ultimate points, the critical curve of a plant with two loops, and the rules that start there.
//!
//! The unit of time is that of the plant; periods are in that unit, frequencies in rad per that unit.

mod critical;
mod curve;
mod design;
mod error;
mod experiment;
mod identification;
mod limit_cycle;
mod placement;
mod proposal;
mod relay_reading;
mod rules;
mod tank_elements;

pub use critical::{CriticalPoint, CriticalSearch, GainLimit, frequency_range, importance, importance_direction};
pub use curve::{Corner, CriticalCurve, CurvePoint};
pub use design::Design;
pub use error::TuningError;
pub use experiment::{
    RelayTest, SequentialStep, TestAndSettings, TestTime, check_stable, independent_test, independent_tuning,
    modulus_estimator, relay_test, sequential_tuning, simultaneous_test, single_loop_test, ultimate_point,
    with_integrator,
};
pub use identification::{complete_response, sine_test};
pub use limit_cycle::{LimitCycle, limit_cycles};
pub use placement::{ControllerPair, integral_action_may_be_stable, place_both_loci, place_one_locus};
pub use proposal::{Action, PlacementMethod, PlacementWarning, Proposal, dynamic_relative_gain, propose, response_at};
pub use relay_reading::{
    CurveDistance, Exciter, LoopMeasurement, Oscillation, RelayReading, RelayVerdict, distance_from_curve,
    read_relay_test,
};
pub use rules::{TuningRule, UltimatePoint};
pub use tank_elements::tank_transfer_matrix;
