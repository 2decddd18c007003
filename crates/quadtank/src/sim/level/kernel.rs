//! The differential equations of a level loop, prepared for many fast steps.

use crate::plant::level::{Characteristic, LevelPlant, LevelSignals, Outflow, ValvePlace};

/// A piece of the actuator curve: `X = offset + slope p` for pressures from `from` on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Segment {
    from: f64,
    offset: f64,
    slope: f64,
}

/// Opening of the valve over travel, with the logarithm of the rangeability computed once.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Opening {
    Linear,
    Exponential(f64),
    Root,
}

/// Outflow over level: a factor and a power of ½, 1 or 0.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Drain {
    Root(f64),
    Linear(f64),
    Constant(f64),
}

/// State of a loop: level, signal of the transmitter, pressure of the actuator, integral part and filtered error.
pub(super) type State = [f64; 5];

/// Which branch of each piecewise element a state is on: limits of transmitter and output, segment of the actuator, walls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Mode {
    measured: i8,
    output: i8,
    segment: usize,
    wall: i8,
}

/// A travel with its opening.
#[derive(Clone, Copy, Debug)]
struct ValvePoint {
    travel: f64,
    opening: f64,
}

/// Derivatives of a state without inflow, its branches, and the travel of its valve.
#[derive(Clone, Copy, Debug)]
struct Slopes {
    rates: State,
    mode: Mode,
    travel: f64,
}

/// A state with its derivatives, where they are known under the present law and reference.
#[derive(Clone, Copy, Debug)]
pub(super) struct LoopState {
    pub state: State,
    slopes: Option<Slopes>,
    /// A valve near that of the state.
    valve: ValvePoint,
}

impl LoopState {
    /// Forgets the derivatives, after law or reference have changed.
    pub fn renew(&mut self) {
        self.slopes = None;
    }
}

/// Largest exponent for which an opening is found by a series from a known one; the rest is below 1e-10 of it.
const SERIES_REACH: f64 = 0.12;
/// Pieces of a step in which an element changes its branch.
const PIECES_AT_KINKS: usize = 8;

/// `m = bias + P e + I-part + D de/dt`, the derivative through a filter. Without gains it is a held output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Law {
    pub bias: f64,
    pub proportional: f64,
    /// I (1/s).
    pub integral: f64,
    /// D/Tf.
    pub derivative: f64,
    /// 1/Tf (1/s).
    pub filter_rate: f64,
    /// 1/Tt of back-calculation (1/s); 0 without.
    pub tracking_rate: f64,
}

impl Law {
    /// An output that does not move.
    pub const fn held(output: f64) -> Self {
        Self { bias: output, proportional: 0.0, integral: 0.0, derivative: 0.0, filter_rate: 0.0, tracking_rate: 0.0 }
    }

    /// What it asks for, before limits.
    #[inline]
    fn asked(&self, error: f64, state: &State) -> f64 {
        self.bias + self.proportional * error + state[3] + self.derivative * (error - state[4])
    }
}

/// A level loop without its controller.
#[derive(Clone, Debug)]
pub(super) struct Kernel {
    height: f64,
    per_area: f64,
    drain: Drain,
    /// Flow of the open valve in a feed; `None` for a valve in the outlet.
    feed: Option<f64>,
    opening: Opening,
    segments: Vec<Segment>,
    /// Pressure = `offset + gain · output`.
    converter: [f64; 2],
    actuator_rate: f64,
    transmitter_rate: f64,
    /// Signal = `offset + gain · level`.
    transmitter: [f64; 2],
    transmitter_limits: [f64; 2],
    output_limits: [f64; 2],
}

/// Rate of a lag (1/s); 0 stands for none.
fn rate(lag_s: f64) -> f64 {
    if lag_s > 0.0 { lag_s.recip() } else { 0.0 }
}

/// A value within limits, and on which side it was.
#[inline]
fn limited(value: f64, [low, high]: [f64; 2]) -> (f64, i8) {
    if value < low {
        (low, -1)
    } else if value > high {
        (high, 1)
    } else {
        (value, 0)
    }
}

/// `e^x` for small x by its series to the sixth power.
#[inline]
fn exponential_near_zero(x: f64) -> f64 {
    let square = x * x;
    let low = (1.0 + x) + square * (0.5 + x * (1.0 / 6.0));
    let high = (1.0 / 24.0 + x * (1.0 / 120.0)) + square * (1.0 / 720.0);
    low + square * square * high
}

impl Kernel {
    pub(super) fn new(plant: &LevelPlant) -> Self {
        let points = &plant.actuator.curve.0;
        let mut segments = Vec::with_capacity(points.len() + 1);
        segments.push(Segment { from: f64::NEG_INFINITY, offset: points[0][1], slope: 0.0 });
        for pair in points.windows(2) {
            let slope = (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0]);
            segments.push(Segment { from: pair[0][0], offset: pair[0][1] - slope * pair[0][0], slope });
        }
        let last = points[points.len() - 1];
        segments.push(Segment { from: last[0], offset: last[1], slope: 0.0 });
        let unlimited = [f64::NEG_INFINITY, f64::INFINITY];
        let (sensor, output) = (plant.transmitter.signal, plant.output.signal);
        Self {
            height: plant.tank.height,
            per_area: plant.tank.area.recip(),
            drain: match plant.tank.outflow {
                Outflow::SquareRoot { coefficient } => Drain::Root(coefficient),
                Outflow::Linear { resistance } => Drain::Linear(resistance.recip()),
                Outflow::Pumped { flow } => Drain::Constant(flow),
            },
            feed: match plant.valve.place {
                ValvePlace::Outlet => None,
                ValvePlace::Inlet { full_flow } => Some(full_flow),
            },
            opening: match plant.valve.characteristic {
                Characteristic::Linear => Opening::Linear,
                Characteristic::EqualPercentage { rangeability } => Opening::Exponential(rangeability.ln()),
                Characteristic::QuickOpening => Opening::Root,
            },
            segments,
            converter: plant.converter.map_or([0.0, 1.0], |converter| [converter.convert(0.0), converter.gain()]),
            actuator_rate: rate(plant.actuator.lag_s),
            transmitter_rate: rate(plant.transmitter.lag_s),
            transmitter: [plant.transmitter.signal_of(0.0), plant.transmitter.gain()],
            transmitter_limits: if plant.transmitter.clips { [sensor.low, sensor.high] } else { unlimited },
            output_limits: if plant.output.clips { [output.low, output.high] } else { unlimited },
        }
    }

    pub(super) fn start(&self, rest: &LevelSignals) -> LoopState {
        let state = [rest.level, self.static_signal(rest.level), rest.actuator_pressure, 0.0, 0.0];
        let valve = ValvePoint { travel: rest.travel, opening: self.opening(rest.travel) };
        LoopState { state, slopes: None, valve }
    }

    #[inline]
    fn static_signal(&self, level: f64) -> f64 {
        self.transmitter[0] + self.transmitter[1] * level
    }

    /// The signal behind the lag of the transmitter, before it is clipped.
    #[inline]
    pub(super) fn transmitted(&self, state: &State) -> f64 {
        if self.transmitter_rate > 0.0 { state[1] } else { self.static_signal(state[0]) }
    }

    /// The signal that the controller gets.
    pub(super) fn measured(&self, state: &State) -> f64 {
        limited(self.transmitted(state), self.transmitter_limits).0
    }

    /// The output within its limits.
    pub(super) fn output(&self, law: &Law, reference: f64, state: &State) -> f64 {
        limited(law.asked(reference - self.measured(state), state), self.output_limits).0
    }

    /// Pressure that acts in the actuator.
    #[inline]
    pub(super) fn pressure(&self, output: f64, state: &State) -> f64 {
        if self.actuator_rate > 0.0 { state[2] } else { self.converter[0] + self.converter[1] * output }
    }

    /// Travel at a pressure, and the segment of the curve.
    #[inline]
    pub(super) fn travel(&self, pressure: f64) -> (f64, usize) {
        let mut index = 0;
        while let Some(next) = self.segments.get(index + 1) {
            if pressure < next.from {
                break;
            }
            index += 1;
        }
        let segment = &self.segments[index];
        (segment.offset + segment.slope * pressure, index)
    }

    /// Opening at a travel.
    #[inline]
    fn opening(&self, travel: f64) -> f64 {
        match self.opening {
            Opening::Linear => travel,
            Opening::Exponential(logarithm) => (logarithm * (travel - 1.0)).exp(),
            Opening::Root => travel.max(0.0).sqrt(),
        }
    }

    /// The same beside a known point. In WebAssembly four exponentials for each step were 44 % of a run.
    #[inline]
    fn opening_near(&self, travel: f64, known: ValvePoint) -> f64 {
        if let Opening::Exponential(logarithm) = self.opening {
            let exponent = logarithm * (travel - known.travel);
            if exponent.abs() < SERIES_REACH {
                return known.opening * exponential_near_zero(exponent);
            }
        }
        self.opening(travel)
    }

    /// A known point that is near a travel: the same one, or that of the travel where it is too far away.
    #[inline]
    fn known_near(&self, travel: f64, known: ValvePoint) -> ValvePoint {
        match self.opening {
            Opening::Exponential(logarithm) if (logarithm * (travel - known.travel)).abs() >= SERIES_REACH => {
                ValvePoint { travel, opening: self.opening(travel) }
            }
            _ => known,
        }
    }

    /// Flows through the valve and out of the tank (m³/s) at a travel.
    pub(super) fn flows(&self, level: f64, travel: f64) -> [f64; 2] {
        self.flows_through(level, self.opening(travel))
    }

    #[inline]
    fn flows_through(&self, level: f64, opening: f64) -> [f64; 2] {
        let open = if level > 0.0 {
            match self.drain {
                Drain::Root(coefficient) => coefficient * level.sqrt(),
                Drain::Linear(conductance) => conductance * level,
                Drain::Constant(flow) => flow,
            }
        } else {
            0.0
        };
        match self.feed {
            None => [open * opening; 2],
            Some(full) => [full * opening, open],
        }
    }

    /// Derivatives of the state without inflow, its valve being near a known point.
    #[inline]
    fn slopes(&self, law: &Law, reference: f64, state: &State, known: ValvePoint) -> Slopes {
        let (measured, at_measured) = limited(self.transmitted(state), self.transmitter_limits);
        let error = reference - measured;
        let asked = law.asked(error, state);
        let (output, at_output) = limited(asked, self.output_limits);
        let (travel, segment) = self.travel(self.pressure(output, state));
        let [valve_flow, outflow] = self.flows_through(state[0], self.opening_near(travel, known));
        let net = if self.feed.is_some() { valve_flow - outflow } else { -outflow };
        let wall = if state[0] <= 0.0 { -1 } else { i8::from(state[0] >= self.height) };
        let rates = [
            net * self.per_area,
            (self.static_signal(state[0]) - state[1]) * self.transmitter_rate,
            (self.converter[0] + self.converter[1] * output - state[2]) * self.actuator_rate,
            law.integral * error + law.tracking_rate * (output - asked),
            law.filter_rate * (error - state[4]),
        ];
        let mode = Mode { measured: at_measured, output: at_output, segment, wall };
        Slopes { rates, mode, travel }
    }

    /// One step (s) with the inflow (m³/s) at its beginning, middle and end. One in which an element changes its branch is made
    /// anew in pieces, which brings runs at their limits from 1e-3 to 2e-5 of the exact ones. Gives back how many steps of the
    /// method it took.
    #[inline]
    pub(super) fn step(&self, law: &Law, reference: f64, step: f64, inflow: [f64; 3], moving: &mut LoopState) -> usize {
        let begin = moving.state;
        let known = moving.valve;
        let first = moving.slopes.unwrap_or_else(|| self.slopes(law, reference, &begin, known));
        let (mut end, mut last) = self.runge_kutta(law, reference, step, inflow, (&begin, first), known);
        let mut steps = 1;
        if last.mode != first.mode {
            (end, last) = (begin, first);
            let share = (PIECES_AT_KINKS as f64).recip();
            for piece in 0..PIECES_AT_KINKS {
                let inflow = share_of(inflow, piece as f64 * share, share);
                (end, last) = self.runge_kutta(law, reference, share * step, inflow, (&end, last), known);
            }
            steps += PIECES_AT_KINKS;
        }
        *moving = LoopState { state: end, slopes: Some(last), valve: self.known_near(last.travel, known) };
        steps
    }

    /// A step of the classical method of order 4; the level ends at the bottom and at the brim. The derivatives at the end are
    /// those that the next step begins with.
    #[inline]
    fn runge_kutta(
        &self,
        law: &Law,
        reference: f64,
        step: f64,
        inflow: [f64; 3],
        (x, first): (&State, Slopes),
        known: ValvePoint,
    ) -> (State, Slopes) {
        let fed = inflow.map(|flow| flow * self.per_area);
        let ahead = |k: &State, by: f64| -> State { std::array::from_fn(|i| x[i] + by * k[i]) };
        let rates = |state: &State, fed: f64| {
            let mut rates = self.slopes(law, reference, state, known).rates;
            rates[0] += fed;
            rates
        };
        let mut k1 = first.rates;
        k1[0] += fed[0];
        let k2 = rates(&ahead(&k1, 0.5 * step), fed[1]);
        let k3 = rates(&ahead(&k2, 0.5 * step), fed[1]);
        let k4 = rates(&ahead(&k3, step), fed[2]);
        let sixth = step / 6.0;
        let mut end: State = std::array::from_fn(|i| x[i] + sixth * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
        end[0] = limited(end[0], [0.0, self.height]).0;
        (end, self.slopes(law, reference, &end, known))
    }

    /// Limits of the output; infinite where it does not clip.
    pub(super) fn output_limits(&self) -> (f64, f64) {
        self.output_limits.into()
    }

    pub(super) fn is_full(&self, level: f64) -> bool {
        level >= self.height
    }

    /// Rate (1/s) of the quickest lag of the plant; 0 without lags.
    pub(super) fn quickest_lag(&self) -> f64 {
        self.actuator_rate.max(self.transmitter_rate)
    }
}

/// The inflow over a part of a step, by a parabola through its values at 0, ½ and 1.
#[inline]
pub(super) fn share_of([begin, middle, end]: [f64; 3], from: f64, share: f64) -> [f64; 3] {
    [from, from + 0.5 * share, from + share]
        .map(|at| begin + at * (4.0 * middle - 3.0 * begin - end) + at * at * 2.0 * (begin + end - 2.0 * middle))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_is_exact_to_its_reach() {
        for k in -100..=100 {
            let x = SERIES_REACH * f64::from(k) / 100.0;
            assert!((exponential_near_zero(x) / x.exp() - 1.0).abs() < 1e-10, "{x}");
        }
    }

    #[test]
    fn a_part_of_a_step_is_on_the_parabola_of_all_of_it() {
        let parabola = |t: f64| 2.0 - 3.0 * t + 5.0 * t * t;
        let part = share_of([0.0, 0.5, 1.0].map(parabola), 0.25, 0.125);
        for (found, at) in part.into_iter().zip([0.25, 0.3125, 0.375]) {
            assert!((found - parabola(at)).abs() < 1e-14);
        }
    }
}
