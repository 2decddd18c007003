use std::fmt::Display;

use crate::control::{AntiWindup, DecentralisedPi, LoopMode, PiSettings};
use crate::plant::{Pump, QuadrupleTank, Sensor, Tank};
use crate::sim::{Experiment, Load, LoadStep, Measurement, SetPointStep};

use super::limits::{self, Limits};
use super::{OperatingPointSpec, PlantSpec, Scenario, ScenarioError, Setup, View};

/// The outcome of a check; the error names the field by its path in the document.
pub(super) type Checked = Result<(), ScenarioError>;

impl Scenario {
    /// Checks every number against [`limits`], and the lengths of all lists.
    ///
    /// # Errors
    /// [`ScenarioError::OutOfRange`] or [`ScenarioError::TooMany`] for the first field that is not allowed.
    pub fn validate(&self) -> Checked {
        at_most(Self::MAX_PINNED, self.pinned.len(), "pinned")?;
        check_setup(&self.setup, "setup")?;
        each(&self.pinned, "pinned", check_setup)?;
        check_view(&self.view, "view")
    }
}

fn check_setup(setup: &Setup, path: &str) -> Checked {
    check_plant(&setup.plant, &format!("{path}.plant"))?;
    pair(setup.valves, limits::VALVE, format_args!("{path}.valves"))?;
    match setup.operating_point {
        OperatingPointSpec::PumpVoltage(voltage) => {
            pair(voltage, limits::PUMP_VOLTAGE, format_args!("{path}.operating_point.pump_voltage"))?;
        }
        OperatingPointSpec::Levels(levels) => {
            pair(levels, limits::LEVEL, format_args!("{path}.operating_point.levels"))?;
        }
    }
    check_controller(&setup.controller, &format!("{path}.controller"))?;
    check_experiment(&setup.experiment, setup.controller.sampling_time_s, &format!("{path}.experiment"))
}

pub(super) fn check_plant(plant: &PlantSpec, path: &str) -> Checked {
    match plant {
        PlantSpec::Preset(_) => Ok(()),
        PlantSpec::Parameters { rig, .. } => check_rig(rig, &format!("{path}.parameters.rig")),
    }
}

fn check_rig(rig: &QuadrupleTank, path: &str) -> Checked {
    each(&rig.tanks, format_args!("{path}.tanks"), check_tank)?;
    each(&rig.pumps, format_args!("{path}.pumps"), check_pump)?;
    pair(rig.valves, limits::VALVE, format_args!("{path}.valves"))?;
    within(rig.power_gain, limits::POWER_GAIN, format_args!("{path}.power_gain"))?;
    let Sensor { gain, range, resolution } = rig.sensor;
    within(gain, limits::SENSOR_GAIN, format_args!("{path}.sensor.gain"))?;
    within(range, limits::SENSOR_RANGE, format_args!("{path}.sensor.range"))?;
    within(resolution, limits::SENSOR_RESOLUTION, format_args!("{path}.sensor.resolution"))?;
    within(rig.gravity, limits::GRAVITY, format_args!("{path}.gravity"))
}

/// A tank must not close above its bottom, nor be all outlet.
fn check_tank(tank: &Tank, path: &str) -> Checked {
    let area = tank.section.area_at_empty;
    within(tank.height, limits::TANK_HEIGHT, format_args!("{path}.height"))?;
    within(area, limits::TANK_AREA, format_args!("{path}.section.area_at_empty"))?;
    let narrowest = Limits { min: (limits::TANK_AREA.min - area) / tank.height, ..limits::TANK_AREA_SLOPE };
    let slope = tank.section.area_slope;
    within(slope, limits::TANK_AREA_SLOPE, format_args!("{path}.section.area_slope"))?;
    within(slope, narrowest, format_args!("{path}.section.area_slope"))?;
    let smallest_area = area.min(area + slope * tank.height);
    let outlet =
        Limits { max: limits::OUTLET_AREA.max.min(limits::OUTLET_SHARE * smallest_area), ..limits::OUTLET_AREA };
    within(tank.outlet.area, outlet, format_args!("{path}.outlet.area"))?;
    within(tank.outlet.loss_coefficient, limits::LOSS_COEFFICIENT, format_args!("{path}.outlet.loss_coefficient"))
}

fn check_pump(pump: &Pump, path: &str) -> Checked {
    within(pump.gain, limits::PUMP_GAIN, format_args!("{path}.gain"))?;
    within(pump.voltage_min, limits::PUMP_VOLTAGE, format_args!("{path}.voltage_min"))?;
    let above_min = Limits { min: pump.voltage_min, ..limits::PUMP_VOLTAGE };
    within(pump.voltage_max, above_min, format_args!("{path}.voltage_max"))
}

pub(super) fn check_controller(controller: &DecentralisedPi, path: &str) -> Checked {
    each(&controller.loops, format_args!("{path}.loops"), check_loop)?;
    within(controller.sampling_time_s, limits::SAMPLING_TIME_S, format_args!("{path}.sampling_time_s"))
}

fn check_loop(settings: &PiSettings, path: &str) -> Checked {
    within(settings.gain, limits::gain_like(settings.gain), format_args!("{path}.gain"))?;
    within(settings.integral_time_s, limits::INTEGRAL_TIME_S, format_args!("{path}.integral_time_s"))?;
    within(settings.set_point_weight, limits::SET_POINT_WEIGHT, format_args!("{path}.set_point_weight"))?;
    match settings.anti_windup {
        AntiWindup::Off => {}
        AntiWindup::BackCalculation { tracking_ratio } => {
            within(
                tracking_ratio,
                limits::TRACKING_RATIO,
                format_args!("{path}.anti_windup.back_calculation.tracking_ratio"),
            )?;
        }
    }
    match settings.mode {
        LoopMode::Automatic => Ok(()),
        LoopMode::Manual { output, until_s } => {
            within(output, limits::MANUAL_OUTPUT, format_args!("{path}.mode.manual.output"))?;
            within(until_s, limits::TIME_S, format_args!("{path}.mode.manual.until_s"))
        }
    }
}

pub(super) fn check_experiment(experiment: &Experiment, sampling_time_s: f64, path: &str) -> Checked {
    within(experiment.duration_s, limits::duration_s(sampling_time_s), format_args!("{path}.duration_s"))?;
    let set_points = format!("{path}.set_point_steps");
    at_most(limits::MAX_STEPS, experiment.set_point_steps.len(), &set_points)?;
    each(&experiment.set_point_steps, set_points, check_set_point_step)?;
    let loads = format!("{path}.load_steps");
    at_most(limits::MAX_STEPS, experiment.load_steps.len(), &loads)?;
    each(&experiment.load_steps, loads, check_load_step)?;

    let Measurement { noise_std, .. } = experiment.measurement;
    within(noise_std, limits::NOISE_STD, format_args!("{path}.measurement.noise_std"))
}

fn check_set_point_step(step: &SetPointStep, path: &str) -> Checked {
    index_below(2, step.level, format_args!("{path}.level"))?;
    within(step.time_s, limits::TIME_S, format_args!("{path}.time_s"))?;
    within(step.size, limits::SET_POINT_STEP, format_args!("{path}.size"))
}

fn check_load_step(step: &LoadStep, path: &str) -> Checked {
    within(step.time_s, limits::TIME_S, format_args!("{path}.time_s"))?;
    match step.load {
        Load::PumpFlow { pump, flow } => {
            index_below(2, pump, format_args!("{path}.load.pump_flow.pump"))?;
            within(flow, limits::LOAD_FLOW, format_args!("{path}.load.pump_flow.flow"))
        }
        Load::Leak { tank, area } => {
            index_below(4, tank, format_args!("{path}.load.leak.tank"))?;
            within(area, limits::LEAK_AREA, format_args!("{path}.load.leak.area"))
        }
    }
}

fn check_view(view: &View, path: &str) -> Checked {
    if let Some(cursor) = view.cursor_s {
        within(cursor, limits::TIME_S, format_args!("{path}.cursor_s"))?;
    }
    if let Some([from, to]) = view.zoom_s {
        within(from, limits::TIME_S, format_args!("{path}.zoom_s[0]"))?;
        within(to, Limits { min: from, ..limits::TIME_S }, format_args!("{path}.zoom_s[1]"))?;
    }
    Ok(())
}

/// `value` lies within `limits`, which also means that it is a finite number.
pub(super) fn within(value: f64, limits: Limits, field: impl Display) -> Checked {
    if limits.contains(value) {
        return Ok(());
    }
    Err(ScenarioError::OutOfRange { field: field.to_string(), value, min: limits.min, max: limits.max })
}

pub(super) fn pair(values: [f64; 2], limits: Limits, field: impl Display) -> Checked {
    each(&values, field, |value, path| within(*value, limits, path))
}

fn index_below(count: usize, index: usize, field: impl Display) -> Checked {
    within(index as f64, Limits::new(0.0, (count - 1) as f64), field)
}

fn at_most(max: usize, count: usize, field: impl Display) -> Checked {
    if count <= max { Ok(()) } else { Err(ScenarioError::TooMany { field: field.to_string(), count, max }) }
}

/// Checks the entries of a list, each under its own path.
pub(super) fn each<T>(entries: &[T], field: impl Display, check: impl Fn(&T, &str) -> Checked) -> Checked {
    entries.iter().enumerate().try_for_each(|(index, entry)| check(entry, &format!("{field}[{index}]")))
}
