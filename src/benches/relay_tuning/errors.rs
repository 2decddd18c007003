//! Why there is no result, in the language of the reader.

use crate::lab::Lab;
use crate::texts::tr;
use quadtank::linear::LinearError;
use quadtank::tuning::TuningError;

/// One sentence.
pub fn sentence(lab: Lab, error: &TuningError) -> String {
    let number = |v: f64| lab.number_style().significant(v, 3);
    match *error {
        TuningError::OutOfRange { field: "target", .. } => tr!(lab, relay.error_target),
        TuningError::OutOfRange { field: "amplitude", .. } => tr!(lab, relay.error_amplitude),
        TuningError::OutOfRange { field: "dead_time", value } => {
            tr!(lab, relay.error_dead_time, value = number(value))
        }
        TuningError::OutOfRange { field, value } => {
            tr!(lab, relay.error_range, field = field, value = number(value))
        }
        TuningError::UnstablePlant { real_part } => {
            tr!(lab, relay.error_unstable, real = number(real_part))
        }
        TuningError::NoOwnGain { number, other_pairing } => {
            let lead = tr!(lab, relay.error_no_gain, number = number);
            if other_pairing { format!("{lead} {}", tr!(lab, relay.error_other_pairing)) } else { lead }
        }
        TuningError::Linear(error) => of_plant(lab, error),
    }
}

/// Error of the plant model.
fn of_plant(lab: Lab, error: LinearError) -> String {
    let number = |v: f64| lab.number_style().significant(v, 3);
    match error {
        LinearError::SingularGain { .. } => tr!(lab, relay.error_singular),
        LinearError::DegenerateRank { .. } => tr!(lab, zeros.degenerate),
        LinearError::NoConvergence { .. } => tr!(lab, relay.error_no_convergence),
        LinearError::OutOfRange { field: "order", value } => tr!(lab, relay.error_order, value = number(value)),
        LinearError::OutOfRange { field: "relative_degree", .. } => tr!(lab, relay.error_improper),
        LinearError::OutOfRange { field, value } => tr!(lab, relay.error_range, field = field, value = number(value)),
        LinearError::Dimension { .. } | LinearError::NotSquare { .. } => tr!(lab, relay.error_plant),
    }
}
