use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::InflowDisturbance;
use crate::control::{AntiWindup, ParallelPid, PiSettings};
use crate::plant::level::{LevelError, Transmitter};

/// In which unit set-point steps are entered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum SetPointScale {
    /// Metres, multiplied by the gain of the transmitter before they are compared with its signal.
    #[default]
    Level,
    /// The unit of the transmitter signal.
    Signal,
}

/// A step at a time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SignalStep {
    /// When (s).
    pub time_s: f64,
    /// By how much.
    pub size: f64,
}

/// What is done to a level loop that starts at rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct LevelExperiment {
    /// Level at the start, which is the set-point (m).
    pub level: f64,
    /// Inflow at the start (m³/s).
    pub inflow: f64,
    /// Length of the run (s).
    pub duration_s: f64,
    /// Time between rows of the log (s).
    pub log_step_s: f64,
    /// What is added to the inflow. An inflow below zero counts as none.
    pub disturbance: InflowDisturbance,
    /// Steps of the set-point, in the unit of `set_point_scale`.
    pub set_point_steps: Vec<SignalStep>,
    /// Unit of these steps.
    #[serde(default)]
    pub set_point_scale: SetPointScale,
}

/// What sets the output of a level loop. The bias is the output at rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum LevelController {
    /// Manual: the output is the bias plus steps, in its unit.
    Manual {
        /// The steps.
        steps: Vec<SignalStep>,
    },
    /// A continuous PI controller, `m = m0 + Kp (e + (1/Ti) ∫ e dt)` within the range of the output (Andreis 2017, Eqs. 74, 75).
    Pi {
        /// Gain Kp, signal per signal.
        gain: f64,
        /// Integral time Ti (s).
        integral_time_s: f64,
        /// What keeps the integral from winding up; nothing in the source.
        anti_windup: AntiWindup,
    },
    /// A continuous parallel PID controller, `m = m0 + P e + I ∫ e dt + D de/dt` with a filtered derivative, without anti-windup.
    Pid {
        /// P, signal per signal.
        proportional: f64,
        /// I (1/s).
        integral: f64,
        /// D (s).
        derivative: f64,
        /// Time constant of the derivative filter (s).
        filter_time_s: f64,
    },
    /// The sampled PI controller of the other benches, on the signals of this loop.
    Sampled {
        /// Its settings, volts standing for signals.
        settings: PiSettings,
        /// Sampling time (s); it counts as the nearest multiple or whole part of an integration step.
        sampling_time_s: f64,
    },
}

impl LevelController {
    /// A continuous PI controller without anti-windup.
    pub const fn pi(gain: f64, integral_time_s: f64) -> Self {
        Self::Pi { gain, integral_time_s, anti_windup: AntiWindup::Off }
    }

    /// A parallel PID with its own filter.
    pub const fn pid(pid: ParallelPid, filter_time_s: f64) -> Self {
        Self::Pid { proportional: pid.proportional, integral: pid.integral, derivative: pid.derivative, filter_time_s }
    }

    /// A controller that leaves the output at its bias.
    pub const fn off() -> Self {
        Self::Manual { steps: Vec::new() }
    }
}

/// Why a level loop has no run.
#[derive(Clone, Copy, Debug, PartialEq, Error, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "error", rename_all = "kebab-case")]
pub enum LevelRunError {
    /// A number of experiment or controller without meaning, such as an integral time of 0.
    #[error("{field} = {value} is out of range")]
    OutOfRange {
        /// Its name.
        field: &'static str,
        /// Its value.
        value: f64,
    },
    /// A run with fewer than two rows.
    #[error("a run of {duration_s} s with a row every {log_step_s} s has no log")]
    EmptyLog {
        /// Length of the run (s).
        duration_s: f64,
        /// Time between rows (s).
        log_step_s: f64,
    },
    /// A run whose numbers become too large, as without limits on the output.
    #[error("the numbers of the run are too large from {time_s} s on")]
    NotFinite {
        /// The first row for which they are (s).
        time_s: f64,
    },
    /// More integration steps than any run is given.
    #[error("{field}: the run would take {steps} steps of integration, more than {max}")]
    TooMuchWork {
        /// The field that causes the number of steps: a number of the experiment, or the controller.
        field: &'static str,
        /// Steps that it would take.
        #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
        steps: f64,
        /// Most steps of a run.
        max: f64,
    },
    /// The loop has no such rest.
    #[error(transparent)]
    #[serde(untagged)]
    Plant(#[from] LevelError),
}

fn finite(field: &'static str, value: f64) -> Result<(), LevelRunError> {
    if value.is_finite() { Ok(()) } else { Err(LevelRunError::OutOfRange { field, value }) }
}

fn positive(field: &'static str, value: f64) -> Result<(), LevelRunError> {
    if value > 0.0 && value.is_finite() { Ok(()) } else { Err(LevelRunError::OutOfRange { field, value }) }
}

impl LevelExperiment {
    /// Refuses numbers without meaning; level and inflow are those of the plant to refuse.
    pub(super) fn check(&self) -> Result<(), LevelRunError> {
        positive("duration_s", self.duration_s)?;
        positive("log_step_s", self.log_step_s)?;
        let [size, time] = self.disturbance.numbers();
        finite(size.0, size.1)?;
        positive(time.0, time.1)?;
        finite("from_s", self.disturbance.from_s)?;
        finite("until_s", self.disturbance.until_s)?;
        for step in &self.set_point_steps {
            finite("time_s", step.time_s)?;
            finite("size", step.size)?;
        }
        if self.duration_s < self.log_step_s {
            return Err(self.empty_log());
        }
        Ok(())
    }

    /// Size (m) of a step of the set-point, whatever unit it is entered in.
    pub fn step_in_metres(&self, step: &SignalStep, transmitter: &Transmitter) -> f64 {
        match self.set_point_scale {
            SetPointScale::Level => step.size,
            SetPointScale::Signal => step.size / transmitter.gain(),
        }
    }

    /// The error for a run with fewer than two rows.
    pub fn empty_log(&self) -> LevelRunError {
        LevelRunError::EmptyLog { duration_s: self.duration_s, log_step_s: self.log_step_s }
    }
}

impl LevelController {
    /// Refuses numbers without meaning. A gain of 0 is one that leaves the level alone and is allowed.
    ///
    /// # Errors
    /// [`LevelRunError::OutOfRange`] with the first of them.
    pub fn check(&self) -> Result<(), LevelRunError> {
        let windup = |anti_windup: AntiWindup| match anti_windup {
            AntiWindup::Off => Ok(()),
            AntiWindup::BackCalculation { tracking_ratio } => positive("tracking_ratio", tracking_ratio),
        };
        match self {
            Self::Manual { steps } => steps.iter().try_for_each(|step| {
                finite("time_s", step.time_s)?;
                finite("size", step.size)
            }),
            Self::Pi { gain, integral_time_s, anti_windup } => {
                finite("gain", *gain)?;
                positive("integral_time_s", *integral_time_s)?;
                windup(*anti_windup)
            }
            Self::Pid { proportional, integral, derivative, filter_time_s } => {
                finite("proportional", *proportional)?;
                finite("integral", *integral)?;
                finite("derivative", *derivative)?;
                if *derivative == 0.0 { Ok(()) } else { positive("filter_time_s", *filter_time_s) }
            }
            Self::Sampled { settings, sampling_time_s } => {
                finite("gain", settings.gain)?;
                positive("integral_time_s", settings.integral_time_s)?;
                finite("set_point_weight", settings.set_point_weight)?;
                windup(settings.anti_windup)?;
                positive("sampling_time_s", *sampling_time_s)
            }
        }
    }
}
