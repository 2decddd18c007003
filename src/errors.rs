//! Why a document was refused or has no result, in the language of the reader.

use super::lab::Lab;
use super::shown::{length_digits, to_shown, unit_name};
use super::texts::tr;
use quadtank::control::{EstimatorError, MAX_WINDOW_SAMPLES};
use quadtank::linear::LinearError;
use quadtank::literature::DisplayUnit;
use quadtank::plant::PlantError;
use quadtank::plant::level::LevelError;
use quadtank::sim::NoResponse;
use quadtank::study::relay_tuning::ElementError;
use quadtank::study::{StudyError, StudyErrorKind};
use quadtank_scenario::{ScenarioError, is_gravity_in_cm, runs_backwards};

/// One sentence; a field keeps its name from the document.
pub fn of_error(lab: Lab, unit: DisplayUnit, error: &ScenarioError) -> String {
    match error {
        ScenarioError::Malformed { path, reason } => {
            tr!(lab, refused.malformed, path = path, reason = reason)
        }
        ScenarioError::DecimalComma { path, number, line, column } => {
            tr!(lab, refused.decimal_comma, path = path, number = number, line = line, column = column)
        }
        ScenarioError::NotText => tr!(lab, refused.not_text),
        ScenarioError::OutOfRange { field, value, min, max } => out_of_range(lab, field, *value, *min, *max),
        ScenarioError::TooManySamples { field, duration_s, sampling_time_s, max } => {
            let number = |v: f64| lab.number_style().significant(v, 4);
            tr!(
                lab,
                refused.samples,
                field = field,
                duration = number(*duration_s),
                sampling = number(*sampling_time_s),
                max = number(*max)
            )
        }
        ScenarioError::TooMany { field, count, max } => {
            tr!(lab, refused.many, field = field, count = count, max = max)
        }
        ScenarioError::TextTooLong { field, length, max } => {
            tr!(lab, refused.text, field = field, length = length, max = max)
        }
        ScenarioError::UnknownVersion { found, newest } => {
            tr!(lab, refused.version, found = found, newest = newest)
        }
        ScenarioError::Scene { index, error } => {
            tr!(lab, refused.scene, number = index + 1, reason = of_error(lab, unit, error))
        }
        ScenarioError::TooLong { length, max } => tr!(lab, refused.long, length = length, max = max),
        ScenarioError::NoLink { max } => tr!(lab, refused.no_link, max = max),
        ScenarioError::DamagedLink => tr!(lab, refused.damaged),
        ScenarioError::Study { error, .. } => of_study_error(lab, unit, error),
        ScenarioError::Law { field, error } => of_law(lab, field, *error),
        ScenarioError::Level { field, error } => {
            tr!(lab, refused.level, field = field, reason = of_level_error(lab, error))
        }
        ScenarioError::Element { field, fault } => {
            tr!(lab, refused.element, field = field, reason = of_fault(lab, *fault))
        }
    }
}

/// Why a level (index) has no step-response figures, with lengths in the shown unit.
pub fn of_no_response(lab: Lab, unit: DisplayUnit, index: usize, reason: NoResponse) -> String {
    let style = lab.number_style();
    let level = index + 1;
    match reason {
        NoResponse::NoStep => tr!(lab, responses.no_step, level = level),
        NoResponse::StepTooSmall { .. } => tr!(lab, responses.step_too_small, level = level),
        NoResponse::StepAfterEnd { time_s } => {
            tr!(lab, responses.step_after_end, level = level, time = style.fixed(time_s, 0))
        }
        NoResponse::NotAtRest { distance } => {
            let distance = style.significant(to_shown(distance, unit), 2);
            tr!(lab, responses.level_moves, level = level, distance = distance, unit = unit_name(unit))
        }
        NoResponse::TankFull => tr!(lab, responses.tank_full, level = level),
        NoResponse::UnstableLoop => tr!(lab, responses.unstable),
        NoResponse::MarginalLoop => tr!(lab, responses.marginal),
        NoResponse::StartOverflows => tr!(lab, responses.not_at_rest),
        NoResponse::TooLongToJudge => tr!(lab, responses.too_long_to_judge),
    }
}

/// Why a setup has no results.
pub fn of_study_error(lab: Lab, unit: DisplayUnit, error: &StudyError) -> String {
    match error.fault {
        StudyErrorKind::TooMuchWork { time_s } => {
            tr!(lab, refused.too_much_work, time = lab.number_style().significant(time_s, 3))
        }
        StudyErrorKind::Plant(error) => of_plant_error(lab, unit, &error),
        StudyErrorKind::Law(fault) => of_law(lab, error.field, fault),
        StudyErrorKind::Linear(error) => of_linear(lab, &error),
    }
}

/// Why there is no answer about a linear model.
pub fn of_linear(lab: Lab, error: &LinearError) -> String {
    match *error {
        LinearError::Dimension { .. } => tr!(lab, linear_error.dimension),
        LinearError::NotSquare { inputs, outputs } => {
            tr!(lab, linear_error.not_square, inputs = inputs, outputs = outputs)
        }
        LinearError::DegenerateRank { .. } => tr!(lab, linear_error.degenerate_rank),
        LinearError::SingularGain { .. } => tr!(lab, linear_error.singular_gain),
        LinearError::NoConvergence { .. } => tr!(lab, linear_error.no_convergence),
        LinearError::OutOfRange { field, value } => {
            tr!(lab, linear_error.out_of_range, field = field, value = lab.number_style().significant(value, 4))
        }
    }
}

/// Why the model-free law cannot work with such settings.
fn of_law(lab: Lab, field: &str, error: EstimatorError) -> String {
    let number = |v: f64| lab.number_style().significant(v, 4);
    match error {
        EstimatorError::WindowTooShort { window_s, sampling_time_s }
        | EstimatorError::WindowTooLong { window_s, sampling_time_s }
        | EstimatorError::WindowNotWhole { window_s, sampling_time_s } => tr!(
            lab,
            refused.window,
            field = field,
            window = number(window_s),
            sampling = number(sampling_time_s),
            most = MAX_WINDOW_SAMPLES
        ),
        EstimatorError::ModelGain { value } => {
            tr!(lab, level_error.out_of_range, field = field, value = number(value))
        }
    }
}

/// Why relay tuning does not work with an element.
pub fn of_fault(lab: Lab, fault: ElementError) -> String {
    match fault {
        ElementError::NoDenominator => tr!(lab, refused.no_denominator),
        ElementError::Improper { .. } => tr!(lab, refused.improper),
        ElementError::Unstable { real_part } => {
            tr!(lab, refused.unstable, real = lab.number_style().significant(real_part, 3))
        }
    }
}

/// What walls and pumps do not allow.
pub fn of_plant_error(lab: Lab, unit: DisplayUnit, error: &PlantError) -> String {
    let style = lab.number_style();
    let length = |m: f64| style.fixed(to_shown(m, unit), length_digits(unit) - 1);
    match *error {
        PlantError::SingularPlant { .. } => tr!(lab, process.no_equilibrium),
        PlantError::LevelOutOfRange { tank, value, max } => tr!(
            lab,
            process.too_high,
            tank = tank + 1,
            level = length(value),
            height = length(max),
            unit = unit_name(unit)
        ),
        PlantError::VoltageOutOfRange { pump, value, min, max } => tr!(
            lab,
            process.voltage_limit,
            pump = pump + 1,
            voltage = style.fixed(value, 2),
            min = style.fixed(min, 1),
            max = style.fixed(max, 1)
        ),
        PlantError::OutOfRange { field, value, min, max } => out_of_range(lab, field, value, min, max),
    }
}

/// Why a level loop has no such rest.
pub fn of_level_error(lab: Lab, error: &LevelError) -> String {
    let style = lab.number_style();
    let cm = |metres: f64| style.fixed(100.0 * metres, 1);
    match *error {
        LevelError::LevelOutsideTank { value, height } => {
            tr!(lab, level_error.outside_tank, level = cm(value), height = cm(height))
        }
        LevelError::NegativeFlow { value } => {
            tr!(lab, level_error.negative_flow, flow = style.significant(1000.0 * value, 3))
        }
        LevelError::ValveOutOfReach { needed, .. } if !needed.is_finite() => tr!(lab, level_error.nothing_flows),
        LevelError::ValveOutOfReach { needed, min, .. } if needed < min => {
            let percent = |share: f64| style.significant(100.0 * share, 2);
            tr!(lab, level_error.valve_leaks, needed = percent(needed), least = percent(min))
        }
        LevelError::ValveOutOfReach { needed, .. } => {
            tr!(lab, level_error.valve_too_small, needed = style.significant(100.0 * needed, 3))
        }
        LevelError::OutputOutOfReach { needed, min, max } => {
            let number = |value: f64| style.fixed(value, 2);
            tr!(lab, level_error.output_out_of_reach, needed = number(needed), min = number(min), max = number(max))
        }
        LevelError::ActuatorCurve { index } => tr!(lab, level_error.actuator_curve, point = index + 1),
        LevelError::OutOfRange { field, value, min, max } => {
            let number = |value: f64| style.significant(value, 4);
            tr!(lab, refused.range, field = field, value = number(value), min = number(min), max = number(max))
        }
    }
}

fn out_of_range(lab: Lab, field: &str, value: f64, min: f64, max: f64) -> String {
    let number = |v: f64| lab.number_style().significant(v, 4);
    let told = tr!(lab, refused.range, field = field, value = number(value), min = number(min), max = number(max));
    if runs_backwards(field, value) {
        format!("{told} {}", tr!(lab, refused.backwards))
    } else if is_gravity_in_cm(field, value) {
        format!("{told} {}", tr!(lab, refused.gravity_cm))
    } else {
        told
    }
}
