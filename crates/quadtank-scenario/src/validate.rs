//! What has to hold between the numbers of a document, each of which is already within the limits of its [row](super::params).
//!
//! `at` is the path of the checked value within the document, such as `setup.controller`; an error names the field at fault by it.

use quadtank::control::{DecentralisedPi, ModelFree, PiSettings};
use quadtank::plant::{Pump, QuadrupleTank, Sensor, Tank, ValveSchedule};
use quadtank::sim::Experiment;

use super::limits::{self, Limits};
use super::{ScenarioError, View};
use quadtank::study::quadruple_tank::{PlantSpec, Setup};

type Checked = Result<(), ScenarioError>;

/// Checks every part of a list, each at its own path.
pub fn each<T>(items: &[T], at: &str, check: impl Fn(&T, &str) -> Checked) -> Checked {
    items.iter().enumerate().try_for_each(|(index, item)| check(item, &format!("{at}[{index}]")))
}

/// The version of a document is that of its type.
pub fn version(found: u32, expected: u32) -> Checked {
    Limits::new(expected.into(), expected.into()).check("version", found.into())
}

pub fn setup(setup: &Setup, at: &str) -> Checked {
    plant(&setup.plant, &format!("{at}.plant"))?;
    pi_loops(&setup.controller, &format!("{at}.controller"))?;
    initial_levels(&setup.experiment, &setup.plant, at)?;
    duration(&setup.experiment, setup.controller.sampling_time_s, at)
}

/// No tank of the setup at a path is higher filled at the start than it has walls.
pub fn initial_levels(experiment: &Experiment, plant: &PlantSpec, at: &str) -> Checked {
    let Some(levels) = experiment.initial_levels else { return Ok(()) };
    levels.iter().zip(plant.rig().tanks).enumerate().try_for_each(|(tank, (&level, Tank { height, .. }))| {
        Limits { max: height, ..limits::LEVEL }.check(&format!("{at}.experiment.initial_levels[{tank}]"), level)
    })
}

/// The shown part of the time axis does not end before it begins.
pub fn view(view: &View, at: &str) -> Checked {
    if let Some(time_s) = view.cursor_s {
        // One that is not finite is `null` where rows are checked.
        limits::TIME_S.check(&format!("{at}.cursor_s"), time_s)?;
    }
    view.zoom_s
        .map_or(Ok(()), |[begin, end]| Limits { min: begin, ..limits::TIME_S }.check(&format!("{at}.zoom_s[1]"), end))
}

pub fn plant(plant: &PlantSpec, at: &str) -> Checked {
    match plant {
        PlantSpec::Preset(_) => Ok(()),
        PlantSpec::Parameters { rig: parameters, .. } => rig(parameters, &format!("{at}.parameters.rig")),
    }
}

pub fn rig(rig: &QuadrupleTank, at: &str) -> Checked {
    each(&rig.tanks, &format!("{at}.tanks"), tank)?;
    each(&rig.pumps, &format!("{at}.pumps"), pump)?;
    sensor(&rig.sensor, &format!("{at}.sensor"))
}

/// A tank does not close above its bottom, nor is it all outlet.
fn tank(tank: &Tank, at: &str) -> Checked {
    let (area, slope) = (tank.section.area_at_empty, tank.section.area_slope);
    let narrowest = (limits::TANK_AREA.min - area) / tank.height;
    Limits { min: narrowest, ..limits::TANK_AREA_SLOPE }.check(&format!("{at}.section.area_slope"), slope)?;
    let widest_outlet = limits::OUTLET_SHARE * area.min(area + slope * tank.height);
    let outlet = Limits { max: limits::OUTLET_AREA.max.min(widest_outlet), ..limits::OUTLET_AREA };
    outlet.check(&format!("{at}.outlet.area"), tank.outlet.area)
}

/// There is a voltage within the limits from which on the flow follows the voltage.
fn pump(pump: &Pump, at: &str) -> Checked {
    Limits { min: pump.voltage_min, ..limits::PUMP_VOLTAGE }.check(&format!("{at}.voltage_max"), pump.voltage_max)?;
    let start = Limits { max: pump.voltage_max, ..limits::PUMP_VOLTAGE };
    start.check(&format!("{at}.start_voltage"), pump.start_voltage)?;
    let lifts = Limits { min: -pump.gain * pump.voltage_max, ..limits::PUMP_OFFSET };
    lifts.check(&format!("{at}.offset"), pump.offset)?;
    let Some(flow_max) = pump.flow_max else { return Ok(()) };
    let unlimited = Pump { flow_max: None, ..*pump };
    let least = limits::PUMP_FLOW_MAX.clamp(unlimited.flow(unlimited.acting_range().0));
    Limits { min: least, ..limits::PUMP_FLOW_MAX }.check(&format!("{at}.flow_max"), flow_max)
}

/// A sensor is ideal, or its signal can be counted in steps.
fn sensor(sensor: &Sensor, at: &str) -> Checked {
    if sensor.resolution == 0.0 {
        return Ok(());
    }
    let least = Limits { min: limits::MIN_SENSOR_RESOLUTION, ..limits::SENSOR_RESOLUTION };
    least.check(&format!("{at}.resolution"), sensor.resolution)
}

pub fn pi_loops(controller: &DecentralisedPi, at: &str) -> Checked {
    each(&controller.loops, &format!("{at}.loops"), pi)
}

/// A loop does something that can be seen, or nothing at all: a gain of 0 leaves it open.
fn pi(settings: &PiSettings, at: &str) -> Checked {
    if settings.gain == 0.0 {
        return Ok(());
    }
    limits::gain_like(settings.gain).check(&format!("{at}.gain"), settings.gain)
}

/// The window of the estimator is a whole number of samples.
pub fn law(law: &ModelFree, at: &str) -> Checked {
    match law.estimator.map(|estimator| estimator.samples(law.sampling_time_s)) {
        Some(Err(error)) => Err(ScenarioError::Law { field: format!("{at}.estimator.window_s"), error }),
        _ => Ok(()),
    }
}

/// A ramp does not end before it begins, and γ stays from 0 to 1 whatever the time.
pub fn valve(valve: &ValveSchedule, at: &str) -> Checked {
    if let ValveSchedule::Ramp { begin_s, end_s, .. } = *valve {
        Limits { min: begin_s, ..limits::TIME_S }.check(&format!("{at}.ramp.end_s"), end_s)?;
    }
    let (lowest, highest) = valve.extremes();
    limits::VALVE.check(at, lowest)?;
    limits::VALVE.check(at, highest)
}

/// The experiment of the setup at a path, sampled every `sampling_time_s` (s), is no more samples than a run may have.
pub fn duration(experiment: &Experiment, sampling_time_s: f64, at: &str) -> Checked {
    let (field, duration_s) = (format!("{at}.experiment.duration_s"), experiment.duration_s);
    limits::DURATION_S.check(&field, duration_s)?;
    if limits::duration_s(sampling_time_s).contains(duration_s) {
        return Ok(());
    }
    Err(ScenarioError::TooManySamples { field, duration_s, sampling_time_s, max: limits::MAX_SAMPLES })
}
