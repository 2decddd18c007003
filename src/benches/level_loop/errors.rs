//! Why a loop has no rest, no run or no test, in the language of the reader.

use quadtank::assess::{HarrisError, IndexError};
use quadtank::sim::level::LevelRunError;
use quadtank::study::level_loop::{LevelLoopError, StepTestError};
use quadtank::tuning::{ReactionError, RegulationError, TuningError};

use crate::errors::{of_level_error, of_linear};
use crate::lab::Lab;
use crate::texts::tr;

/// Why a loop has no run.
pub fn of_run(lab: Lab, error: &LevelRunError) -> String {
    let style = lab.number_style();
    match error {
        LevelRunError::Plant(error) => of_level_error(lab, error),
        LevelRunError::OutOfRange { field, value } => {
            tr!(lab, level_error.out_of_range, field = *field, value = style.significant(*value, 4))
        }
        LevelRunError::EmptyLog { duration_s, log_step_s } => {
            let (duration, step) = (style.significant(*duration_s, 3), style.significant(*log_step_s, 3));
            tr!(lab, level_error.empty_log, duration = duration, step = step)
        }
        LevelRunError::NotFinite { time_s } => {
            tr!(lab, level_error.not_finite, time = style.significant(*time_s, 3))
        }
        LevelRunError::TooMuchWork { field: "period_s" | "sample_time_s", .. } => {
            tr!(lab, level_error.disturbance_too_quick)
        }
        LevelRunError::TooMuchWork { .. } => tr!(lab, level_error.too_much_work),
    }
}

/// The same with the part of the setup that allows no run.
pub fn of_loop(lab: Lab, fault: &LevelLoopError) -> String {
    of_run(lab, &fault.fault)
}

/// Why a step test has no record.
pub fn of_test(lab: Lab, fault: &StepTestError) -> String {
    match fault {
        StepTestError::Run(error) => of_run(lab, error),
        StepTestError::OutsideTest { value, .. } => {
            tr!(lab, level_error.outside_test, time = lab.number_style().significant(*value, 4))
        }
    }
}

/// Why a record has no model.
pub fn of_reaction(lab: Lab, error: &ReactionError) -> String {
    match error {
        ReactionError::NoStep { .. } => tr!(lab, level_error.no_step),
        ReactionError::EmptyRecord { .. } => tr!(lab, level_error.empty_record),
        ReactionError::NoRamp { .. } => tr!(lab, level_error.no_ramp),
        ReactionError::AtWall => tr!(lab, level_error.at_wall),
        ReactionError::NoResponse { .. } => tr!(lab, level_error.no_response),
        ReactionError::NotSettled { share } => {
            tr!(lab, level_error.not_settled, share = lab.number_style().significant(100.0 * share, 2))
        }
    }
}

/// Why a record does not tell what kind of process it is of.
pub fn of_record(lab: Lab, error: RegulationError) -> String {
    match error {
        RegulationError::TooFewRows { .. } => tr!(lab, level.too_few_rows),
        RegulationError::TooFewStretches { stretches } => {
            tr!(lab, level_error.too_few_stretches, stretches = stretches)
        }
    }
}

/// Why a rule has no settings.
pub fn of_rule(lab: Lab, error: TuningError) -> String {
    match error {
        TuningError::OutOfRange { field: "dead_time_s", .. } => tr!(lab, level_error.needs_dead_time),
        TuningError::OutOfRange { field, value } => {
            tr!(lab, level_error.out_of_range, field = field, value = lab.number_style().significant(value, 4))
        }
        TuningError::UnstablePlant { real_part } => {
            tr!(lab, relay.error_unstable, real = lab.number_style().significant(real_part, 3))
        }
        TuningError::NoOwnGain { number, .. } => tr!(lab, relay.error_no_gain, number = number),
        TuningError::Linear(error) => of_linear(lab, &error),
    }
}

/// Why there is no index.
pub fn of_index(lab: Lab, error: IndexError) -> String {
    match error {
        IndexError::ZeroVariance => tr!(lab, level_error.zero_variance),
        IndexError::NoVariance { value } => {
            tr!(lab, level_error.no_variance, value = lab.number_style().significant(value, 3))
        }
    }
}

/// Why there is no index of Harris.
pub fn of_harris(lab: Lab, error: &HarrisError) -> String {
    match *error {
        HarrisError::Index(error) => of_index(lab, error),
        HarrisError::TooFewSamples { samples, order } => {
            tr!(lab, level_error.too_few_samples, samples = samples, order = order)
        }
        HarrisError::NotDetermined { order } => tr!(lab, level_error.not_determined, order = order),
        HarrisError::DeadTimeTooLong { dead_time, samples } => {
            tr!(lab, level_error.dead_time_too_long, rows = dead_time, samples = samples)
        }
        HarrisError::TooMuchWork { samples, order } => {
            tr!(lab, level_error.too_many_samples, samples = samples, order = order)
        }
        HarrisError::OutOfRange { field, value } => {
            tr!(lab, level_error.out_of_range, field = field, value = value)
        }
    }
}
