//! Between which values the numbers of a document lie. Which number has which is said in the table of
//! [parameters](super::params); what depends on other numbers is a function here.
//!
//! The limits are wide on purpose: they keep a document computable (no overflow, no endless run), not sensible. What a
//! rig can really do is a matter of its walls and pumps, which [`quadtank::plant::QuadrupleTank::violations`] checks.

use quadtank::study::model_free::ModelFreeSetup;

/// A closed interval of allowed values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Smallest allowed value.
    pub min: f64,
    /// Largest allowed value.
    pub max: f64,
}

impl Limits {
    /// The interval from `min` to `max`.
    pub const fn new(min: f64, max: f64) -> Self {
        Self { min, max }
    }

    /// All numbers.
    pub const NONE: Self = Self::new(f64::NEG_INFINITY, f64::INFINITY);

    /// What both allow; the smallest value of the second where they have none in common.
    #[must_use]
    pub fn intersection(self, other: Self) -> Self {
        let min = self.min.max(other.min);
        Self { min, max: self.max.min(other.max).max(min) }
    }

    /// Whether `value` is allowed; never true of NaN.
    pub fn contains(self, value: f64) -> bool {
        self.min <= value && value <= self.max
    }

    /// The allowed value nearest to `value`; the smallest one for NaN.
    pub fn clamp(self, value: f64) -> f64 {
        if value.is_nan() { self.min } else { value.max(self.min).min(self.max) }
    }
}

/// Valve fraction γ.
pub const VALVE: Limits = Limits::new(0.0, 1.0);
/// Growth of a valve fraction γ with the flow through the valve (s/m³).
pub const VALVE_SLOPE: Limits = Limits::new(-1e7, 1e7);
/// Pump voltage at the operating point (V), and the voltage limits of a pump.
pub const PUMP_VOLTAGE: Limits = Limits::new(0.0, 1000.0);
/// Level at the operating point (m).
pub const LEVEL: Limits = Limits::new(0.0, 10.0);

/// A loop gain K (V/V) of either sign; see also [`gain_like`].
pub const GAIN: Limits = Limits::new(-GAIN_MAGNITUDE.max, GAIN_MAGNITUDE.max);
/// Magnitude of a loop gain K (V/V); its sign is free.
pub const GAIN_MAGNITUDE: Limits = Limits::new(1e-3, 1e3);
/// Integral time Ti (s).
pub const INTEGRAL_TIME_S: Limits = Limits::new(0.1, 1e5);
/// Set-point weight b.
pub const SET_POINT_WEIGHT: Limits = Limits::new(0.0, 1.0);
/// Tracking time of the anti-windup over the integral time, Tt/Ti.
pub const TRACKING_RATIO: Limits = Limits::new(0.01, 100.0);
/// Controller output in manual mode (V).
pub const MANUAL_OUTPUT: Limits = Limits::new(0.0, 1000.0);
/// Sampling time Ts (s).
pub const SAMPLING_TIME_S: Limits = Limits::new(0.001, 60.0);

/// Gain α̂ of the ultra-local model (m/(s V)).
pub const MODEL_GAIN: Limits = Limits::new(1e-7, 1.0);
/// Kp (1/s) and Ki (1/s²) of the model-free law.
pub const MODEL_FREE_FEEDBACK: Limits = Limits::new(0.0, 1e3);
/// Length T of the window of the estimator (s); how many samples it has is limited too.
pub const WINDOW_S: Limits = Limits::new(0.0, 1e5);
/// Amplitude of a valve fraction that swings; see also [`VALVE`].
pub const VALVE_AMPLITUDE: Limits = Limits::new(-1.0, 1.0);
/// Angular frequency of a valve that swings (rad/s).
pub const VALVE_FREQUENCY: Limits = Limits::new(0.0, 10.0);
/// How far a valve may turn within one run (rad), ω times the duration: the integration takes four steps for each radian.
pub const MAX_VALVE_TURN: f64 = 10_000.0;
/// Phase of a valve that swings (rad).
pub const VALVE_PHASE: Limits = Limits::new(-100.0, 100.0);

/// Duration of an experiment (s).
pub const DURATION_S: Limits = Limits::new(10.0, 20_000.0);
/// Samples of one run; see [`duration_s`].
pub const MAX_SAMPLES: f64 = 20_000.0;
/// Time of a step, of the hand-over to automatic, or of the cursor (s).
pub const TIME_S: Limits = Limits::new(0.0, DURATION_S.max);
/// Size of a set-point step (m).
pub const SET_POINT_STEP: Limits = Limits::new(-LEVEL.max, LEVEL.max);
/// Flow added to that of a pump (m³/s).
pub const LOAD_FLOW: Limits = Limits::new(-0.01, 0.01);
/// Constant flow that a tank receives from outside (m³/s).
pub const INFLOW: Limits = Limits::new(0.0, 0.01);
/// Change of a valve fraction γ; or relative change of the flow of a pump, or of the area of an outlet (1 is 100 %).
pub const LOAD_SHARE: Limits = Limits::new(-1.0, 1.0);
/// Standard deviation of the noise on the flow of a pump (m³/s).
pub const PUMP_FLOW_NOISE_STD: Limits = Limits::new(0.0, LOAD_FLOW.max);
/// Area of a leak (m²).
pub const LEAK_AREA: Limits = Limits::new(0.0, 0.01);
/// Standard deviation of the measurement noise (m).
pub const NOISE_STD: Limits = Limits::new(0.0, 1.0);
/// Seed of the measurement noise: any whole number of 32 bits.
pub const SEED: Limits = Limits::new(0.0, u32::MAX as f64);
/// Loads of an experiment, and steps of the output of a level loop in manual.
pub const MAX_STEPS: usize = 8;
/// Steps of the references of an experiment: those of a record in which a level was held here and there for a while.
pub const MAX_SET_POINT_STEPS: usize = 100;
/// Steps of pumps that are moved by hand, and of measured inflows: two of them that move at each of [`MAX_SAMPLES`]. Such a run takes
/// 10 ms, and its document, which has 4.4 MB, 0.1 s to read (both native).
pub const MAX_PUMP_STEPS: usize = 40_000;

/// Cross-section of a tank at any level (m²).
pub const TANK_AREA: Limits = Limits::new(1e-5, 10.0);
/// Growth of the cross-section per metre of level (m²/m).
pub const TANK_AREA_SLOPE: Limits = Limits::new(-10.0, 10.0);
/// Height of the walls (m).
pub const TANK_HEIGHT: Limits = Limits::new(0.01, 10.0);
/// Outlet area (m²); see also [`OUTLET_SHARE`].
pub const OUTLET_AREA: Limits = Limits::new(1e-8, 0.01);
/// Largest outlet area as a share of the cross-section of its tank, so that Torricelli's law holds (Cocota 2009, eq. 2.22).
pub const OUTLET_SHARE: f64 = 0.1;
/// Loss coefficient of an outlet.
pub const LOSS_COEFFICIENT: Limits = Limits::new(0.01, 1.0);
/// Flow of a pump per volt (m³/(s V)).
pub const PUMP_GAIN: Limits = Limits::new(1e-9, 1e-3);
/// Flow of the straight line of a pump curve at 0 V (m³/s).
pub const PUMP_OFFSET: Limits = Limits::new(-1.0, 1.0);
/// Largest flow of a pump (m³/s): up to that of the largest gain at the highest voltage.
pub const PUMP_FLOW_MAX: Limits = Limits::new(1e-9, 1.0);
/// Transport delay of the hose behind a pump (s).
pub const PUMP_DELAY_S: Limits = Limits::new(0.0, 600.0);
/// Gain of the power module.
pub const POWER_GAIN: Limits = Limits::new(0.01, 100.0);
/// Sensor gain (V/m).
pub const SENSOR_GAIN: Limits = Limits::new(0.01, 1e4);
/// Range of a sensor (m).
pub const SENSOR_RANGE: Limits = Limits::new(0.01, 10.0);
/// Resolution of a sensor (V), 0 for an ideal one; see also [`MIN_SENSOR_RESOLUTION`].
pub const SENSOR_RESOLUTION: Limits = Limits::new(0.0, 10.0);
/// Least resolution of a sensor that is not ideal (V), far below that of any converter: the largest signal,
/// [`SENSOR_GAIN`] times [`SENSOR_RANGE`], is then 10¹⁴ steps, which a number of 53 bits still counts.
pub const MIN_SENSOR_RESOLUTION: f64 = 1e-9;
/// Acceleration of gravity (m/s²).
pub const GRAVITY: Limits = Limits::new(0.1, 100.0);

/// A number of a relay-tuning session: a gain, a signal or a time in the unit of its plant.
pub const TUNING_VALUE: Limits = Limits::new(-1e6, 1e6);
/// A number of a session that is not negative.
pub const TUNING_NOT_NEGATIVE: Limits = Limits::new(0.0, TUNING_VALUE.max);
/// A number of a session where only positive ones make sense.
pub const TUNING_POSITIVE: Limits = Limits::new(1e-6, TUNING_VALUE.max);
/// Number of a loop or of a root.
pub const ONE_OR_TWO: Limits = Limits::new(1.0, 2.0);
/// Passes of a sequential relay test.
pub const PASSES: Limits = Limits::new(1.0, 20.0);
/// Rows of one record.
pub const MAX_RECORD_ROWS: f64 = 100_000.0;
/// Rows of all records of a sequential relay test together.
pub const ROWS_OF_ALL: Limits = Limits::new(0.0, 500_000.0);
/// Coefficient of a transfer function; see also [`COEFFICIENT_MAGNITUDE`].
pub const COEFFICIENT: Limits = Limits::new(-COEFFICIENT_MAGNITUDE.max, COEFFICIENT_MAGNITUDE.max);
/// Magnitude of a coefficient that is not zero: products of such coefficients stay numbers.
pub const COEFFICIENT_MAGNITUDE: Limits = Limits::new(1e-12, 1e12);
/// Coefficients of one polynomial.
pub const MAX_COEFFICIENTS: usize = 8;
/// How much quicker than a record the quickest pole of a plant may be: it asks for more steps than anyone waits for.
pub const QUICKEST_IN_RECORD: Limits = Limits::new(0.0, 2e6);
/// How much quicker than a dead time the quickest pole of a plant may be.
pub const QUICKEST_IN_DEAD_TIME: Limits = Limits::new(0.0, 1e4);

/// Cross-section of the tank of a level loop (m²).
pub const LEVEL_TANK_AREA: Limits = Limits::new(1e-4, 1e4);
/// Height of its walls, and levels in it (m).
pub const LEVEL_TANK_HEIGHT: Limits = Limits::new(0.01, 100.0);
/// A level in it (m).
pub const TANK_LEVEL: Limits = Limits::new(0.0, LEVEL_TANK_HEIGHT.max);
/// Ends of the range of a level transmitter (m), which may be mounted below the bottom.
pub const TRANSMITTER_LEVEL: Limits = Limits::new(-LEVEL_TANK_HEIGHT.max, LEVEL_TANK_HEIGHT.max);
/// Resistance of a laminar outlet (s/m²).
pub const RESISTANCE: Limits = Limits::new(1e-3, 1e8);
/// Coefficient k of a turbulent outlet (m^2.5/s).
pub const FLOW_COEFFICIENT: Limits = Limits::new(1e-8, 100.0);
/// A flow of a level loop (m³/s).
pub const FLOW: Limits = Limits::new(0.0, 100.0);
/// Flow of the open valve in a feed (m³/s).
pub const FULL_FLOW: Limits = Limits::new(1e-9, FLOW.max);
/// What is added to the inflow of a level loop (m³/s).
pub const FLOW_CHANGE: Limits = Limits::new(-FLOW.max, FLOW.max);
/// A signal or pressure in its unit (mA, psi), or a step of one.
pub const SIGNAL: Limits = Limits::new(-1000.0, 1000.0);
/// Least width of a range of signals (mA, psi) or levels (m), and least distance between two points of an actuator curve.
pub const MIN_SPAN: f64 = 1e-3;
/// Lag of an instrument (s), 0 for one that follows at once; see also [`MIN_LAG_S`].
pub const LAG_S: Limits = Limits::new(0.0, 1e4);
/// Least lag of an instrument that has one (s).
pub const MIN_LAG_S: f64 = 1e-3;
/// Rangeability of an equal-percentage valve.
pub const RANGEABILITY: Limits = Limits::new(1.01, 1e4);
/// Points of an actuator curve.
pub const MAX_CURVE_POINTS: usize = 32;
/// A gain of a level controller (signal per signal), of either sign; see also [`LEVEL_GAIN_MAGNITUDE`].
pub const LEVEL_GAIN: Limits = Limits::new(-LEVEL_GAIN_MAGNITUDE.max, LEVEL_GAIN_MAGNITUDE.max);
/// Magnitude of such a gain that is not 0, and the gains of a search.
pub const LEVEL_GAIN_MAGNITUDE: Limits = Limits::new(1e-9, 1e4);
/// Integral time of a level controller, and other times of its settings (s).
pub const LEVEL_TIME_S: Limits = Limits::new(1e-3, 1e6);
/// Area or flows of a model as multiples of those of the plant.
pub const MODEL_FACTOR: Limits = Limits::new(0.1, 10.0);
/// Length of a run or a step test of a level loop (s).
pub const LEVEL_DURATION_S: Limits = Limits::new(1.0, DURATION_S.max);
/// Time between the rows of a log, period of a sine, or how long a random value is held (s); see also [`log_step_s`].
pub const LEVEL_STEP_S: Limits = Limits::new(1e-3, DURATION_S.max);
/// What a square of a move of the output costs.
pub const MOVE_PENALTY: Limits = Limits::new(0.0, 1e6);
/// Largest sensitivity peak that a search allows; every loop has more than 1.
pub const SENSITIVITY_PEAK: Limits = Limits::new(1.01, 1000.0);
/// Dead time of the Harris index (rows).
pub const DEAD_TIME_ROWS: Limits = Limits::new(1.0, 1000.0);
/// Order of the autoregressive model of the Harris index.
pub const MODEL_ORDER: Limits = Limits::new(1.0, 50.0);

/// Allowed times between the rows of the log of a level loop (s) in a run of a duration (s): at least one row after the first, at
/// most [`MAX_SAMPLES`].
pub fn log_step_s(duration_s: f64) -> Limits {
    Limits { min: LEVEL_STEP_S.min.max(duration_s / MAX_SAMPLES), max: LEVEL_STEP_S.max.min(duration_s) }
}

/// Allowed times between the rows of a record of a duration (any unit): at least one row, at most [`MAX_RECORD_ROWS`].
pub fn row_step(duration: f64) -> Limits {
    Limits::new(duration / MAX_RECORD_ROWS, duration)
}

/// Allowed sampling times (s) in an experiment of a duration (s): those of [`SAMPLING_TIME_S`] with at most [`MAX_SAMPLES`]
/// samples.
pub fn sampling_time_s(duration_s: f64) -> Limits {
    Limits { min: SAMPLING_TIME_S.min.max(duration_s / MAX_SAMPLES), ..SAMPLING_TIME_S }
}

/// Allowed durations of an experiment (s) at a sampling time (s): those of [`DURATION_S`] with at most [`MAX_SAMPLES`] samples.
pub fn duration_s(sampling_time_s: f64) -> Limits {
    Limits { max: DURATION_S.max.min(MAX_SAMPLES * sampling_time_s), ..DURATION_S }
}

/// The same of a run under the model-free law, whose valves turn by at most [`MAX_VALVE_TURN`].
pub fn model_free_duration_s(setup: &ModelFreeSetup) -> Limits {
    let Limits { min, max } = duration_s(setup.controller.sampling_time_s);
    let frequency = setup.valves[0].angular_frequency().max(setup.valves[1].angular_frequency());
    Limits { min, max: max.min(MAX_VALVE_TURN / frequency) }
}

/// Allowed angular frequencies of a swinging valve (rad/s) in an experiment of a duration (s): those of [`VALVE_FREQUENCY`] at
/// which the phase grows by at most [`MAX_VALVE_TURN`].
pub fn valve_frequency(duration_s: f64) -> Limits {
    Limits { max: VALVE_FREQUENCY.max.min(MAX_VALVE_TURN / duration_s), ..VALVE_FREQUENCY }
}

/// A gain K (V/V) of the same sign as the given one: [`GAIN_MAGNITUDE`] with that sign.
pub fn gain_like(gain: f64) -> Limits {
    with_sign_of(gain, GAIN_MAGNITUDE)
}

/// Limits of a magnitude with the sign of a number.
pub fn with_sign_of(number: f64, magnitude: Limits) -> Limits {
    if number < 0.0 { Limits::new(-magnitude.max, -magnitude.min) } else { magnitude }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_sampling_times_make_short_experiments() {
        assert_eq!(duration_s(SAMPLING_TIME_S.min), Limits::new(10.0, 20.0));
        assert_eq!(duration_s(SAMPLING_TIME_S.max), DURATION_S);
    }

    #[test]
    fn bounds_belong_to_the_interval_and_nan_never_does() {
        assert!(VALVE.contains(0.0) && VALVE.contains(1.0));
        assert!(!VALVE.contains(-1e-300) && !VALVE.contains(1.0 + f64::EPSILON) && !VALVE.contains(f64::NAN));
    }

    #[test]
    fn clamping_ends_inside_whatever_comes_in() {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.3, -2.0, 7.0] {
            assert!(VALVE.contains(VALVE.clamp(value)), "{value}");
        }
        assert_eq!(VALVE.clamp(0.3), 0.3);
    }
}
