//! Relay tests on a plant with two loops: single, independent, sequential and simultaneous (Campestrini 2006, §3.5 to 3.7).

use crate::control::{IsaPid, ParallelPid, PidMatrix, Relay};
use crate::linear::{Complex, DelayedPlant, LinearError, SignalPath, TransferFunction, TransferMatrix, lowest_power};
use crate::sim::{HeldPlant, LoopTrace, MAX_WORK, TwoLoops, run_two_loops_within};

use super::error::positive;
use super::relay_reading::{RelayReading, read_relay_test};
use super::{TuningError, TuningRule, UltimatePoint};

/// Length and fineness of a test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TestTime {
    /// Duration (unit of time of the plant).
    pub duration: f64,
    /// When relays begin to switch (unit of time of the plant), see [`TwoLoops::release`].
    pub release: f64,
    /// Time between rows, and sampling time of controllers in the other loop (unit of time of the plant).
    pub step: f64,
}

/// A record and what it says.
#[derive(Clone, Debug, PartialEq)]
pub struct RelayTest {
    /// The record.
    pub trace: LoopTrace,
    /// What it says.
    pub reading: RelayReading,
}

/// Runs relays, in one loop or both, on a plant at rest; `controllers` act beside them.
///
/// # Errors
/// [`TuningError::OutOfRange`] for an amplitude, a duration or a step that is not positive, or a hysteresis below zero.
pub fn relay_test(
    plant: &mut dyn HeldPlant,
    relays: [Option<Relay>; 2],
    controllers: PidMatrix,
    time: TestTime,
) -> Result<RelayTest, TuningError> {
    relay_test_within(plant, relays, controllers, time, MAX_WORK)
}

/// The same with another bound on the work.
fn relay_test_within(
    plant: &mut dyn HeldPlant,
    relays: [Option<Relay>; 2],
    controllers: PidMatrix,
    time: TestTime,
    most_work: f64,
) -> Result<RelayTest, TuningError> {
    positive("duration", time.duration)?;
    positive("step", time.step)?;
    for relay in relays.iter().flatten() {
        positive("amplitude", relay.amplitude)?;
        if !(relay.hysteresis >= 0.0 && relay.hysteresis.is_finite()) {
            return Err(TuningError::OutOfRange { field: "hysteresis", value: relay.hysteresis });
        }
        if !relay.bias.is_finite() {
            return Err(TuningError::OutOfRange { field: "bias", value: relay.bias });
        }
    }
    let TestTime { duration, release, step } = time;
    let loops = TwoLoops { relays, controllers, references: [0.0; 2], release, duration, step };
    let trace = run_two_loops_within(plant, &loops, most_work);
    let reading = read_relay_test(&trace, relays);
    Ok(RelayTest { trace, reading })
}

/// Refuses a plant with a pole that is neither in the left half-plane nor at the origin, where integrating elements have theirs.
///
/// # Errors
/// [`TuningError::UnstablePlant`] with the real part of that pole.
pub fn check_stable(plant: &TransferMatrix) -> Result<(), TuningError> {
    for element in plant.0.as_flattened() {
        if let Some(pole) = poles_off_the_origin(element)?.last().filter(|pole| pole.re >= 0.0) {
            return Err(TuningError::UnstablePlant { real_part: pole.re });
        }
    }
    Ok(())
}

/// Poles without those at the origin, which are exact zeros of the coefficients. Rounding would move them to either side.
///
/// # Errors
/// As [`TransferFunction::poles`].
pub fn poles_off_the_origin(element: &TransferFunction) -> Result<Vec<Complex>, LinearError> {
    let first = lowest_power(element.denominator()).unwrap_or(0);
    TransferFunction::new(vec![1.0], element.denominator()[first..].to_vec(), 0.0)?.poles()
}

/// Ideal relays of the given amplitudes with the signs of the diagonal gains, together (DRF, Campestrini 2006, §3.7).
///
/// # Errors
/// As [`relay_test`]; [`TuningError::UnstablePlant`].
pub fn simultaneous_test(
    plant: &TransferMatrix,
    amplitudes: [f64; 2],
    time: TestTime,
) -> Result<RelayTest, TuningError> {
    check_stable(plant)?;
    let gain = plant.rest_gain();
    let relays = [0, 1].map(|i| Some(Relay::ideal(amplitudes[i], gain[(i, i)])));
    relay_test(&mut DelayedPlant::new(&plant.paths())?, relays, PidMatrix::default(), time)
}

/// A relay in one loop, the input of the other at rest (IRF, Campestrini 2006, §3.5).
///
/// # Errors
/// As [`simultaneous_test`].
pub fn independent_test(
    plant: &TransferMatrix,
    index: usize,
    relay: Relay,
    time: TestTime,
) -> Result<RelayTest, TuningError> {
    with_one_relay(plant, index, relay, ParallelPid::default(), time, MAX_WORK)
}

/// A relay in one loop, a controller in the other.
fn with_one_relay(
    plant: &TransferMatrix,
    index: usize,
    relay: Relay,
    other: ParallelPid,
    time: TestTime,
    most_work: f64,
) -> Result<RelayTest, TuningError> {
    check_stable(plant)?;
    let mut relays = [None; 2];
    relays[index] = Some(relay);
    let mut controllers = [other; 2];
    controllers[index] = ParallelPid::default();
    let controllers = PidMatrix::decentralised(controllers);
    relay_test_within(&mut DelayedPlant::new(&plant.paths())?, relays, controllers, time, most_work)
}

/// Ultimate point of the loop with the relay, by first harmonics; `None` where the test did not end periodically.
pub fn ultimate_point(test: &RelayTest, index: usize) -> Option<UltimatePoint> {
    let oscillation = test.reading.oscillation?;
    Some(UltimatePoint { gain: oscillation.loops[index].gain_by_harmonic?, period: oscillation.period })
}

/// A test with the settings that a rule makes of it; `None` where it did not end periodically.
pub type TestAndSettings = (RelayTest, Option<IsaPid>);

/// Independent tests of both loops and a rule, detuned by a factor f for each loop (Campestrini 2006, eqs. 92, 93).
///
/// # Errors
/// As [`simultaneous_test`]; [`TuningError::OutOfRange`] for a factor that is not positive.
pub fn independent_tuning(
    plant: &TransferMatrix,
    relays: [Relay; 2],
    rule: TuningRule,
    detuning: [f64; 2],
    time: TestTime,
) -> Result<[TestAndSettings; 2], TuningError> {
    let of_loop = |index: usize| {
        positive("detuning", detuning[index])?;
        let test = independent_test(plant, index, relays[index], time)?;
        let settings = ultimate_point(&test, index).map(|point| rule.settings(point).detuned(detuning[index]));
        Ok::<_, TuningError>((test, settings))
    };
    Ok([of_loop(0)?, of_loop(1)?])
}

/// One step of a sequential tuning.
#[derive(Clone, Debug, PartialEq)]
pub struct SequentialStep {
    /// Pass, from 1.
    pub pass: usize,
    /// Index of the loop with the relay.
    pub index: usize,
    /// The test.
    pub test: RelayTest,
    /// What it found; `None` where it did not end periodically, and the sequence with it.
    pub point: Option<UltimatePoint>,
    /// The settings by the rule.
    pub settings: Option<IsaPid>,
}

/// Sequential tests (SRF, Campestrini 2006, §3.6): a relay in loop 1, the loop closed by the rule, a relay in loop 2 and so
/// on, any number of passes. It need not converge; the steps show it. All tests together take at most four times
/// the work of one: the test in which it is spent is the last, and unfinished.
///
/// # Errors
/// As [`simultaneous_test`].
pub fn sequential_tuning(
    plant: &TransferMatrix,
    relays: [Relay; 2],
    rule: TuningRule,
    passes: usize,
    time: TestTime,
) -> Result<Vec<SequentialStep>, TuningError> {
    let mut steps = Vec::new();
    let mut controllers = [ParallelPid::default(); 2];
    let mut left = 4.0 * MAX_WORK;
    for pass in 1..=passes {
        for index in [0, 1] {
            let most = left.min(MAX_WORK);
            let test = with_one_relay(plant, index, relays[index], controllers[1 - index], time, most)?;
            left -= test.trace.work;
            let point = ultimate_point(&test, index);
            let settings = point.map(|point| rule.settings(point));
            steps.push(SequentialStep { pass, index, test, point, settings });
            let Some(settings) = settings else { return Ok(steps) };
            controllers[index] = settings.into();
        }
    }
    Ok(steps)
}

/// An element with an integrator behind it, for the relay test that finds the point with −90° (Campestrini 2006, eqs. 51
/// to 55): relay and integrator together oscillate where ∠F = −90°, with |F| = ω π a/(4 d) and a the swing at the relay.
#[must_use]
pub fn with_integrator(element: &TransferFunction) -> TransferFunction {
    TransferFunction::new(vec![1.0], vec![0.0, 1.0], 0.0).map_or_else(|_| element.clone(), |i| element.times(&i))
}

/// The loop of the estimator that oscillates where `|H(jω)| = r`: `F/s` with `F = (H − r)/(H + r)` (Campestrini 2006,
/// eqs. 56 to 59); for an element with negative gain, of −H. The gain of the loop is positive.
///
/// It rests on the describing function although F does not fall at high frequency: good while r is small beside |H(0)|
/// (1.2 % at 0.2 on three equal lags), useless above 0.4 of it.
///
/// # Errors
/// [`TuningError::OutOfRange`] for an r that is not positive, or a dead time, with which F is not rational;
/// [`TuningError::UnstablePlant`] where F is not stable.
pub fn modulus_estimator(element: &TransferFunction, r: f64) -> Result<TransferFunction, TuningError> {
    positive("r", r)?;
    if element.dead_time() != 0.0 {
        return Err(TuningError::OutOfRange { field: "dead_time", value: element.dead_time() });
    }
    let r = r.copysign(element.rest_gain());
    let combined = |sign: f64| -> Vec<f64> {
        let (b, a) = (element.numerator(), element.denominator());
        let at = |c: &[f64], k: usize| c.get(k).copied().unwrap_or(0.0);
        (0..a.len().max(b.len())).map(|k| at(b, k) + sign * r * at(a, k)).collect()
    };
    let f = TransferFunction::new(combined(-1.0), combined(1.0), 0.0)?;
    if let Some(pole) = f.poles()?.last().filter(|pole| pole.re >= 0.0) {
        return Err(TuningError::UnstablePlant { real_part: pole.re });
    }
    Ok(with_integrator(&f))
}

/// A relay test of one element alone.
///
/// # Errors
/// As [`relay_test`].
///
/// # Examples
/// 1/(s + 1)³ oscillates at ω = √3 rad/s under a gain of 8; the relay finds both to a few percent.
/// ```
/// use quadtank::control::Relay;
/// use quadtank::linear::TransferFunction;
/// use quadtank::tuning::{TestTime, single_loop_test, ultimate_point};
///
/// let plant = TransferFunction::lags(1.0, &[1.0; 3], 0.0)?;
/// let time = TestTime { duration: 200.0, release: 2.0, step: 0.02 };
/// let test = single_loop_test(&plant, Relay::ideal(1.0, 1.0), time)?;
/// let point = ultimate_point(&test, 0).expect("the oscillation settles");
/// assert!((point.gain / 8.0 - 1.0).abs() < 0.05);
/// assert!((point.period * 3.0_f64.sqrt() / std::f64::consts::TAU - 1.0).abs() < 0.05);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn single_loop_test(element: &TransferFunction, relay: Relay, time: TestTime) -> Result<RelayTest, TuningError> {
    let path = SignalPath { input: 0, output: 0, element: element.clone() };
    relay_test(&mut DelayedPlant::new(&[path])?, [Some(relay), None], PidMatrix::default(), time)
}
