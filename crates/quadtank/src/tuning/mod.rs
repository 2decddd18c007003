//! How gains are found: ultimate points, the critical curve of a plant with two loops, and the rules that start there.
//!
//! The unit of time is that of the plant; periods are in that unit, frequencies in rad per that unit.

mod critical;
mod curve;
mod design;
mod error;
mod experiment;
mod identification;
mod level_cost;
mod limit_cycle;
mod model_rules;
mod pair_rules;
mod pi_tuning;
mod placement;
mod process_model;
mod proposal;
mod reaction_curve;
mod regulation;
mod relay_reading;
mod rules;
pub mod search;
mod tank_elements;
mod ultimate;

pub use critical::{CriticalPoint, CriticalSearch, GainLimit, frequency_range, importance, importance_direction};
pub use curve::{Corner, CriticalCurve, CurvePoint};
pub use design::Design;
pub use error::TuningError;
pub use experiment::{
    RelayTest, SequentialStep, TestAndSettings, TestTime, check_stable, independent_test, independent_tuning,
    modulus_estimator, poles_off_the_origin, relay_test, sequential_tuning, simultaneous_test, single_loop_test,
    ultimate_point, with_integrator,
};
pub use identification::{complete_response, sine_test};
pub use level_cost::{CostMeasure, Evaluation, LevelCost, LevelProblem, VIOLATION, sensitivity_peak};
pub use limit_cycle::{LimitCycle, limit_cycles};
pub use model_rules::ModelRule;
pub use pair_rules::{PairRule, PairRuleError};
pub use pi_tuning::PiTuning;
pub use placement::{
    ControllerPair, dynamic_relative_gain, integral_action_may_be_stable, place_both_loci, place_one_locus,
};
pub use process_model::ProcessModel;
pub use proposal::{Action, PlacementMethod, PlacementWarning, Proposal, propose, response_at, warnings_of_gains};
pub use reaction_curve::{ReactionError, ReactionFit, ReactionMethod, StepRecord};
pub use regulation::{
    Regulation, RegulationError, RegulationReason, SetPointStretch, open_loop_regulation, proportional_regulation,
};
pub use relay_reading::{
    CurveDistance, LoopMeasurement, Oscillation, RelayReading, RelayVerdict, distance_from_curve, read_relay_test,
};
pub use rules::{TuningRule, UltimatePoint};
pub use tank_elements::tank_transfer_matrix;
pub use ultimate::ultimate_point_of;
