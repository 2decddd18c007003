use quadtank::plant::level::{LevelError, LevelPlant, SignalRange};
use quadtank::sim::level::{LevelController, LevelExperiment};
use quadtank::study::level_loop::{LevelLoopSetup, LevelPlantSpec, Objective, SearchSpec, StepTestSpec};

use crate::ScenarioError;
use crate::limits::{self, Limits};

type Checked = Result<(), ScenarioError>;

/// How much larger the upper limit of a search is at least, as a factor.
const MIN_RATIO: f64 = 1.001;

/// Checks what has to hold between the numbers of the setup at a path.
pub fn setup(setup: &LevelLoopSetup, at: &str) -> Checked {
    if let LevelPlantSpec::Parameters(parameters) = &setup.plant {
        plant(parameters, &format!("{at}.plant.parameters"))?;
    }
    test(&setup.test, &format!("{at}.test"))?;
    if let Objective::Averaging { band: [low, high] } = setup.objective {
        let above = Limits::new(low + limits::MIN_SPAN, setup.plant().tank.height);
        above.check(&format!("{at}.objective.averaging.band[1]"), high)?;
    }
    controller(&setup.controller, &format!("{at}.controller"))?;
    gain(setup.reference.gain, &format!("{at}.reference.gain"))?;
    experiment(&setup.experiment, &format!("{at}.experiment"))?;
    search(&setup.search, &format!("{at}.search"))
}

fn plant(plant: &LevelPlant, at: &str) -> Checked {
    let transmitter = format!("{at}.transmitter");
    let [low, high] = plant.transmitter.level_range;
    let above = Limits { min: low + limits::MIN_SPAN, ..limits::TRANSMITTER_LEVEL };
    above.check(&format!("{transmitter}.level_range[1]"), high)?;
    range(&plant.transmitter.signal, &format!("{transmitter}.signal"))?;
    lag(plant.transmitter.lag_s, &format!("{transmitter}.lag_s"))?;
    range(&plant.output.signal, &format!("{at}.output.signal"))?;
    if let Some(converter) = &plant.converter {
        range(&converter.input, &format!("{at}.converter.input"))?;
        range(&converter.output, &format!("{at}.converter.output"))?;
    }
    lag(plant.actuator.lag_s, &format!("{at}.actuator.lag_s"))?;
    let curve = format!("{at}.actuator.curve");
    let mut lowest = limits::SIGNAL.min;
    for (index, &[pressure, travel]) in plant.actuator.curve.0.iter().enumerate() {
        let at = format!("{curve}[{index}]");
        Limits { min: lowest, ..limits::SIGNAL }.check(&format!("{at}[0]"), pressure)?;
        Limits::new(0.0, 1.0).check(&format!("{at}[1]"), travel)?;
        lowest = pressure + limits::MIN_SPAN;
    }
    plant.check().map_err(|error| {
        let field = match error {
            LevelError::ActuatorCurve { index } if index < plant.actuator.curve.0.len() => format!("{curve}[{index}]"),
            LevelError::ActuatorCurve { .. } => curve,
            _ => at.to_owned(),
        };
        ScenarioError::Level { field, error }
    })
}

/// A range has a width, and its upper end is positive.
fn range(range: &SignalRange, at: &str) -> Checked {
    let least = (range.low + limits::MIN_SPAN).max(limits::MIN_SPAN);
    Limits { min: least, ..limits::SIGNAL }.check(&format!("{at}.high"), range.high)
}

/// An instrument follows at once, or with a lag that can be followed.
fn lag(lag_s: f64, at: &str) -> Checked {
    if lag_s == 0.0 { Ok(()) } else { Limits { min: limits::MIN_LAG_S, ..limits::LAG_S }.check(at, lag_s) }
}

/// The output steps within the test, and steps back after it has stepped.
fn test(test: &StepTestSpec, at: &str) -> Checked {
    if let Some(return_time_s) = test.return_time_s {
        Limits::new(0.0, test.duration_s).check(&format!("{at}.return_time_s"), return_time_s)?;
    }
    let end = test.return_time_s.unwrap_or(test.duration_s);
    Limits::new(0.0, end).check(&format!("{at}.step_time_s"), test.step_time_s)
}

fn controller(controller: &LevelController, at: &str) -> Checked {
    match controller {
        LevelController::Manual { .. } => Ok(()),
        LevelController::Pi { gain: of, .. } => gain(*of, &format!("{at}.pi.gain")),
        LevelController::Pid { proportional, integral, derivative, .. } => {
            gain(*proportional, &format!("{at}.pid.proportional"))?;
            gain(*integral, &format!("{at}.pid.integral"))?;
            gain(*derivative, &format!("{at}.pid.derivative"))
        }
        LevelController::Sampled { settings, .. } => gain(settings.gain, &format!("{at}.sampled.settings.gain")),
    }
}

/// A gain does something that can be seen, or nothing at all.
fn gain(gain: f64, at: &str) -> Checked {
    if gain == 0.0 { Ok(()) } else { limits::with_sign_of(gain, limits::LEVEL_GAIN_MAGNITUDE).check(at, gain) }
}

fn experiment(experiment: &LevelExperiment, at: &str) -> Checked {
    limits::log_step_s(experiment.duration_s).check(&format!("{at}.log_step_s"), experiment.log_step_s)?;
    let until = Limits { min: experiment.disturbance.from_s, ..limits::TIME_S };
    until.check(&format!("{at}.disturbance.until_s"), experiment.disturbance.until_s)
}

fn search(search: &SearchSpec, at: &str) -> Checked {
    let above = |[low, _]: [f64; 2], limits: Limits| Limits { min: MIN_RATIO * low, ..limits };
    above(search.gain, limits::LEVEL_GAIN_MAGNITUDE).check(&format!("{at}.gain[1]"), search.gain[1])?;
    let time = above(search.integral_time_s, limits::LEVEL_TIME_S);
    time.check(&format!("{at}.integral_time_s[1]"), search.integral_time_s[1])
}
