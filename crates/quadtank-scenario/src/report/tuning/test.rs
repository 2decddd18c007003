use quadtank::control::IsaPid;
use quadtank::study::relay_tuning::{FoundPoint, PlantStudy, RecoveredResponse, TestSpec, Tested};
use quadtank::tuning::{
    CurveDistance, LimitCycle, Oscillation, RelayReading, RelayVerdict, SequentialStep, TestAndSettings, TuningError,
};
use serde::Serialize;

use super::{RootReport, TOO_MUCH_WORK};
use crate::report::{ComplexNumber, rows};

/// What a relay test finds.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum TestReport {
    /// A relay on one element of the diagonal alone.
    Single {
        /// What the record says.
        reading: ReadingReport,
        /// The point of the frequency response; null where the test did not oscillate.
        found: Option<Found>,
        /// The exact limit cycle; null with a dead time, hysteresis or bias, for which its equations do not hold, and where
        /// there is none.
        exact_limit_cycle: Option<LimitCycleReport>,
    },
    /// Relays in both loops at once.
    Simultaneous {
        /// What the record says.
        reading: ReadingReport,
        /// Where the gains by peaks are beside the critical curve; null where the test did not oscillate, and where the curve
        /// has no point in that direction.
        distance_by_peak: Option<DistanceReport>,
        /// The same of the gains by first harmonics.
        distance_by_harmonic: Option<DistanceReport>,
        /// G(jω) at the frequency of the oscillation from a sine and the relays, by rows (outputs per input); null where the
        /// test did not oscillate.
        recovered_g: Option<[[ComplexNumber; 2]; 2]>,
        /// The same of the model (outputs per input).
        exact_g: Option<[[ComplexNumber; 2]; 2]>,
    },
    /// A relay in each loop alone.
    Independent {
        /// Tests of loops 1 and 2.
        loops: [LoopTestReport; 2],
        /// The loop with the settings of both tests; null where a test leaves a loop without.
        pair: Option<Box<RootReport>>,
    },
    /// A relay in one loop after the other, those before closed by the rule.
    Sequential {
        /// Its steps, in order.
        steps: Vec<SequentialStepReport>,
        /// The loop with the settings that the last test of each loop ends in; null where one leaves a loop without.
        pair: Option<Box<RootReport>>,
    },
}

/// A test of one loop alone.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LoopTestReport {
    /// What the record says.
    pub reading: ReadingReport,
    /// Settings by the rule; null where the test did not end periodically.
    pub settings: Option<Settings>,
}

/// One step of a sequential test.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SequentialStepReport {
    /// Number of the pass, from 1.
    pub pass: usize,
    /// Number of the loop with the relay, 1 or 2.
    #[serde(rename = "loop")]
    pub number: usize,
    /// What the record says.
    pub reading: ReadingReport,
    /// Settings by the rule; null where the test did not end periodically.
    pub settings: Option<Settings>,
}

/// What the record of a relay test says.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ReadingReport {
    /// The kind of oscillation.
    pub verdict: Verdict,
    /// More about it; null for a kind that needs no more.
    pub detail: Option<VerdictDetail>,
    /// The oscillation; null for a record that does not end in one.
    pub oscillation: Option<OscillationReport>,
}

/// The kind of oscillation that a record ends in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Periodic, every relay with two switches in a period.
    Unimodal,
    /// Periodic, with more switches.
    Multimodal,
    /// The last periods are not alike.
    NotPeriodic,
    /// A relay switches as fast as it can.
    Chattering,
    /// A relay hardly ever switched.
    None,
    /// An output left all bounds.
    Diverged,
    /// The record ends before its time, and its last periods are not alike.
    Unfinished,
}

/// What belongs to a verdict.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
pub enum VerdictDetail {
    /// Of a multimodal record.
    Multimodal {
        /// Switches of each relay in a period; 0 where there is no relay.
        switches_per_period: [usize; 2],
    },
    /// Of one that chatters.
    Chattering {
        /// Number of the loop, 1 or 2.
        #[serde(rename = "loop")]
        number: usize,
    },
    /// Of an unfinished one.
    Unfinished {
        /// When it ends (units of time).
        time: f64,
        /// Why, in words.
        reason: &'static str,
    },
}

/// A periodic oscillation. Of each loop: null where it has no relay.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct OscillationReport {
    /// Its period (units of time).
    pub period: f64,
    /// Half of what each output moves from peak to peak (units of the output).
    pub amplitudes: [f64; 2],
    /// Kc = 4 d/(π a) of each loop, with its sign (inputs per output).
    pub gains_by_peak: [Option<f64>; 2],
    /// Kc of each loop by the first harmonics, with its sign (inputs per output).
    pub gains_by_harmonic: [Option<f64>; 2],
    /// Angle by which each loop differs from a proportional one (rad).
    pub turn_rad: [Option<f64>; 2],
    /// Whether both loops act like proportional ones, as a critical point asks.
    pub is_proportional: bool,
}

/// A point of a frequency response as a relay found it, and as it is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Found {
    /// Frequency of the oscillation (rad per unit of time).
    pub frequency: f64,
    /// Modulus by the describing function (outputs per input).
    pub modulus: f64,
    /// The response of the element there (outputs per input).
    pub response: ComplexNumber,
}

/// The exact limit cycle of a relay and a linear plant.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LimitCycleReport {
    /// Its period (units of time).
    pub period: f64,
    /// Peak of the output (units of the output).
    pub amplitude: f64,
    /// Whether small disturbances die out.
    pub stable: bool,
}

/// How far the gains of a test are from the critical curve, in their own direction.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DistanceReport {
    /// By which share the gains are too large: 0 on the curve, negative inside the stable region (no unit).
    pub excess: f64,
    /// Period of the curve there (units of time).
    pub curve_period: f64,
    /// Whether the test oscillated on the branch of the curve that bounds the stable gains.
    pub same_branch: bool,
}

/// Settings of a PID controller without interaction, K (1 + 1/(Ti s) + Td s).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Settings {
    /// K (inputs per output).
    pub gain: f64,
    /// Ti (units of time); null without integral action.
    pub integral_time: Option<f64>,
    /// Td (units of time); 0 without derivative action.
    pub derivative_time: f64,
}

impl TestReport {
    pub(super) fn of(study: &PlantStudy, test: &Tested, spec: &TestSpec) -> Result<Self, TuningError> {
        let pair = study.pair_of_test(test)?;
        let pair = pair.map(|pair| RootReport::of(study, &pair).map(Box::new)).transpose()?;
        Ok(match test {
            Tested::Single(test, found) => {
                let cycle = match test.reading.oscillation {
                    Some(oscillation) => study.exact_limit_cycle(spec, oscillation.period)?,
                    None => None,
                };
                Self::Single {
                    reading: test.reading.into(),
                    found: found.map(Found::from),
                    exact_limit_cycle: cycle.as_ref().map(LimitCycleReport::from),
                }
            }
            Tested::Simultaneous(test, distances) => {
                let recovered = test.reading.oscillation.map(|of| study.recover(&of)).transpose()?;
                let [distance_by_peak, distance_by_harmonic] = distances.map(|of| of.map(DistanceReport::from));
                Self::Simultaneous {
                    reading: test.reading.into(),
                    distance_by_peak,
                    distance_by_harmonic,
                    recovered_g: recovered.map(|RecoveredResponse { measured, .. }| rows(&measured)),
                    exact_g: recovered.map(|RecoveredResponse { exact, .. }| rows(&exact)),
                }
            }
            Tested::Independent(loops) => Self::Independent { loops: loops.each_ref().map(LoopTestReport::from), pair },
            Tested::Sequential(steps) => {
                Self::Sequential { steps: steps.iter().map(SequentialStepReport::from).collect(), pair }
            }
        })
    }
}

impl From<&TestAndSettings> for LoopTestReport {
    fn from((test, settings): &TestAndSettings) -> Self {
        Self { reading: test.reading.into(), settings: settings.map(Settings::from) }
    }
}

impl From<&SequentialStep> for SequentialStepReport {
    fn from(step: &SequentialStep) -> Self {
        Self {
            pass: step.pass,
            number: step.index + 1,
            reading: step.test.reading.into(),
            settings: step.settings.map(Settings::from),
        }
    }
}

impl From<RelayReading> for ReadingReport {
    fn from(reading: RelayReading) -> Self {
        let (verdict, detail) = match reading.verdict {
            RelayVerdict::Unimodal => (Verdict::Unimodal, None),
            RelayVerdict::Multimodal { switches } => {
                (Verdict::Multimodal, Some(VerdictDetail::Multimodal { switches_per_period: switches }))
            }
            RelayVerdict::NotPeriodic => (Verdict::NotPeriodic, None),
            RelayVerdict::Chattering { relay } => {
                (Verdict::Chattering, Some(VerdictDetail::Chattering { number: relay + 1 }))
            }
            RelayVerdict::NoOscillation => (Verdict::None, None),
            RelayVerdict::Diverged => (Verdict::Diverged, None),
            RelayVerdict::Unfinished { time } => {
                (Verdict::Unfinished, Some(VerdictDetail::Unfinished { time, reason: TOO_MUCH_WORK }))
            }
        };
        Self { verdict, detail, oscillation: reading.oscillation.map(OscillationReport::from) }
    }
}

impl From<Oscillation> for OscillationReport {
    fn from(oscillation: Oscillation) -> Self {
        Self {
            period: oscillation.period,
            amplitudes: oscillation.loops.map(|of| of.amplitude),
            gains_by_peak: oscillation.loops.map(|of| of.gain_by_peak),
            gains_by_harmonic: oscillation.loops.map(|of| of.gain_by_harmonic),
            turn_rad: oscillation.loops.map(|of| of.turn),
            is_proportional: oscillation.is_proportional(),
        }
    }
}

impl From<FoundPoint> for Found {
    fn from(point: FoundPoint) -> Self {
        Self { frequency: point.frequency, modulus: point.modulus, response: point.response.into() }
    }
}

impl From<&LimitCycle> for LimitCycleReport {
    fn from(cycle: &LimitCycle) -> Self {
        Self { period: cycle.period, amplitude: cycle.amplitude, stable: cycle.is_stable() }
    }
}

impl From<CurveDistance> for DistanceReport {
    fn from(distance: CurveDistance) -> Self {
        Self { excess: distance.excess, curve_period: distance.period, same_branch: distance.same_branch }
    }
}

impl From<IsaPid> for Settings {
    fn from(pid: IsaPid) -> Self {
        let integral_time = pid.integral_time.is_finite().then_some(pid.integral_time);
        Self { gain: pid.gain, integral_time, derivative_time: pid.derivative_time }
    }
}
