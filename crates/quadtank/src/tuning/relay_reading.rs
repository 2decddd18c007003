//! What a relay test says: its verdict, period, amplitudes, and the ultimate gains that follow.

use std::f64::consts::{PI, TAU};

use crate::control::Relay;
use crate::linear::Complex;
use crate::sim::{Halt, LoopTrace};

use super::critical::CriticalSearch;

/// Most periods of a relay that are taken together as one period of a multimodal oscillation.
const MODES: usize = 8;
/// Periods at the end of a record that have to be alike.
const ALIKE: f64 = 3.0;
/// Share of the period by which alike switches may differ.
const TOLERANCE: f64 = 1e-3;
/// Angle between input and output (rad) up to which a relay counts as a proportional loop. On the plants of the source a
/// test within it is within 3 % of the critical curve.
const PROPORTIONAL: f64 = 0.1;
/// Share by which periods of the same branch may differ: between branches they differ several times.
const SAME_BRANCH: f64 = 0.15;

/// What kind of oscillation a record ends in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RelayVerdict {
    /// Periodic, every relay with two switches in a period.
    Unimodal,
    /// Periodic, with more switches.
    Multimodal {
        /// Switches of each relay in a period; 0 where there is no relay.
        switches: [usize; 2],
    },
    /// The last periods are not alike: quasi-periodic, chaotic, or not settled in the time of the test.
    NotPeriodic,
    /// A relay switches as fast as it can.
    Chattering {
        /// Index of its loop.
        relay: usize,
    },
    /// A relay hardly ever switched: there is nothing to measure.
    NoOscillation,
    /// An output left all bounds.
    Diverged,
    /// The record ends before its time, see [`Halt::Full`], and its last periods are not alike.
    Unfinished {
        /// When (units of time of the plant).
        time: f64,
    },
}

/// Measurements of one loop over the last whole periods.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopMeasurement {
    /// Half of what the output moves from peak to peak, a (unit of the output).
    pub amplitude: f64,
    /// First harmonic of the input, a complex amplitude in the unit of the plant input.
    pub input: Complex,
    /// First harmonic of the output, a complex amplitude in the unit of the plant output.
    pub output: Complex,
    /// `Kc = 4 d/(π a)` with the sign of the loop (Campestrini 2006, eqs. 48 and 95); `None` without a relay in the loop.
    pub gain_by_peak: Option<f64>,
    /// `Kc = |U1|/|Y1|` of the first harmonics, with the sign of the loop.
    pub gain_by_harmonic: Option<f64>,
    /// Angle of −U1/Y1, for a loop with positive gain (rad). A proportional loop would have 0: the further from it, the less
    /// the relay is one, and the less the gains are a critical point.
    pub turn: Option<f64>,
}

/// A periodic oscillation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oscillation {
    /// Period (unit of time of the plant).
    pub period: f64,
    /// Both loops.
    pub loops: [LoopMeasurement; 2],
}

impl Oscillation {
    /// Frequency (rad per unit of time).
    pub fn frequency(&self) -> f64 {
        TAU / self.period
    }

    /// Whether both loops act like proportional ones, as a critical point asks, see [`LoopMeasurement::turn`].
    pub fn is_proportional(&self) -> bool {
        self.loops.iter().filter_map(|of| of.turn).all(|turn| turn.abs() <= PROPORTIONAL)
    }

    /// Both ultimate gains by peaks, where both loops have a relay.
    pub fn gains_by_peak(&self) -> Option<[f64; 2]> {
        Some([self.loops[0].gain_by_peak?, self.loops[1].gain_by_peak?])
    }

    /// Both ultimate gains by first harmonics.
    pub fn gains_by_harmonic(&self) -> Option<[f64; 2]> {
        Some([self.loops[0].gain_by_harmonic?, self.loops[1].gain_by_harmonic?])
    }
}

/// A verdict and, where the record ends periodically, what was measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RelayReading {
    /// The kind of oscillation.
    pub verdict: RelayVerdict,
    /// The oscillation, for unimodal and multimodal records.
    pub oscillation: Option<Oscillation>,
}

/// Reads a record of relays.
pub fn read_relay_test(trace: &LoopTrace, relays: [Option<Relay>; 2]) -> RelayReading {
    let nothing = |verdict| RelayReading { verdict, oscillation: None };
    let otherwise = |verdict| match trace.halt {
        Some(Halt::Full { time }) => nothing(RelayVerdict::Unfinished { time }),
        _ => nothing(verdict),
    };
    match trace.halt {
        Some(Halt::Chattering { relay, .. }) => return nothing(RelayVerdict::Chattering { relay }),
        Some(Halt::Diverged { .. }) => return nothing(RelayVerdict::Diverged),
        Some(Halt::Full { .. }) | None => (),
    }
    let active: Vec<usize> = (0..2).filter(|&i| relays[i].is_some()).collect();
    if active.is_empty() || active.iter().any(|&i| trace.switches[i].len() < 4) {
        return otherwise(RelayVerdict::NoOscillation);
    }
    let Some((period, end)) = common_period(trace, &active) else { return otherwise(RelayVerdict::NotPeriodic) };
    let in_period = |i: usize| {
        let slack = period * TOLERANCE;
        trace.switches[i].iter().filter(|(time, _)| *time > end - period + slack && *time <= end + slack).count()
    };
    let switches = [0, 1].map(|i| if relays[i].is_some() { in_period(i) } else { 0 });
    let verdict = if active.iter().all(|&i| switches[i] == 2) {
        RelayVerdict::Unimodal
    } else {
        RelayVerdict::Multimodal { switches }
    };
    let loops = [0, 1].map(|i| measure(trace, i, relays[i], period, end));
    RelayReading { verdict, oscillation: Some(Oscillation { period, loops }) }
}

/// The shortest period after which the switches of all relays come again, and the last switch up of the first of them.
fn common_period(trace: &LoopTrace, active: &[usize]) -> Option<(f64, f64)> {
    let ups: Vec<f64> = trace.switches[active[0]].iter().filter(|(_, up)| *up).map(|(time, _)| *time).collect();
    let (&end, &begin, &close) = (ups.last()?, trace.time.first()?, trace.time.last()?);
    (1..=MODES).find_map(|modes| {
        let period = end - ups[ups.len().checked_sub(1 + modes)?];
        let first = end - ALIKE * period;
        // A relay that has stuck for longer than a period does not oscillate any more.
        let goes_on = close - end <= period * (1.0 + TOLERANCE);
        let again =
            first >= begin && goes_on && active.iter().all(|&i| comes_again(&trace.switches[i], period, first, end));
        again.then_some((period, end))
    })
}

/// Whether every switch of the last periods has one like it a period earlier and a period later, as far as the window goes, and
/// there is at least one.
fn comes_again(switches: &[(f64, bool)], period: f64, first: f64, end: f64) -> bool {
    let slack = TOLERANCE * period;
    let like = |time: f64, up: bool| switches.iter().any(|&(at, other)| other == up && (time - at).abs() <= slack);
    let within = |from: f64, to: f64| switches.iter().filter(move |(at, _)| *at >= from + slack && *at <= to + slack);
    let mut late = within(first + period, end).peekable();
    late.peek().is_some()
        && late.all(|&(at, up)| like(at - period, up))
        && within(first, end - period - 2.0 * slack).all(|&(at, up)| like(at + period, up))
}

/// Amplitude and first harmonics of one loop over the last three periods.
fn measure(trace: &LoopTrace, index: usize, relay: Option<Relay>, period: f64, end: f64) -> LoopMeasurement {
    let begin = end - ALIKE * period;
    let w = TAU / period;
    let (times, inputs, outputs) = (&trace.time, &trace.inputs[index], &trace.outputs[index]);
    let (mut input, mut output) = (Complex::ZERO, Complex::ZERO);
    let first = times.partition_point(|&time| time < begin).max(1);
    for k in first..times.len() {
        if times[k - 1] >= end {
            break;
        }
        // The part of the row within the window; the output is taken as straight between rows.
        let (from, to) = (times[k - 1].max(begin), times[k].min(end));
        let whole = times[k] - times[k - 1];
        if whole <= 0.0 || to <= from {
            continue;
        }
        let at = |time: f64| outputs[k - 1] + (outputs[k] - outputs[k - 1]) * ((time - times[k - 1]) / whole);
        let (turn_from, turn_to) = (Complex::cis(-w * from), Complex::cis(-w * to));
        let held = (turn_from - turn_to) / Complex::new(0.0, w);
        input += held * inputs[k - 1];
        let slope = (at(to) - at(from)) / (to - from);
        output += (turn_from * at(from) - turn_to * at(to) + held * slope) / Complex::new(0.0, w);
    }
    let scale = 2.0 / (ALIKE * period);
    (input, output) = (input * scale, output * scale);
    let window =
        &outputs[times.partition_point(|&time| time < end - period)..times.partition_point(|&time| time <= end)];
    let high = window.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let low = window.iter().copied().fold(f64::INFINITY, f64::min);
    let amplitude = 0.5 * (high - low);
    let signed = |gain: f64, of: Relay| if of.reversed { -gain } else { gain };
    LoopMeasurement {
        amplitude,
        input,
        output,
        gain_by_peak: relay.map(|of| signed(4.0 * of.amplitude / (PI * amplitude), of)),
        gain_by_harmonic: relay.map(|of| signed(input.norm() / output.norm(), of)),
        turn: relay.map(|of| (input / output * signed(-1.0, of)).arg()),
    }
}

/// How far an estimated point is from the critical curve of a model, in its own direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveDistance {
    /// By how much the estimate is too large: 0 on the curve, negative inside the stable region.
    pub excess: f64,
    /// Period of the curve there.
    pub period: f64,
    /// Whether the test oscillated on the branch of the curve that bounds the stable gains. Where not, even a unimodal test
    /// is no critical point.
    pub same_branch: bool,
}

/// Compares gains and period of a test with the curve; `None` where the curve has no point in that direction.
pub fn distance_from_curve(search: &CriticalSearch, gains: [f64; 2], period: f64) -> Option<CurveDistance> {
    let point = search.nearest(gains)?;
    Some(CurveDistance {
        excess: 1.0 / point.factor - 1.0,
        period: point.period(),
        same_branch: (period / point.period() - 1.0).abs() <= SAME_BRANCH,
    })
}
