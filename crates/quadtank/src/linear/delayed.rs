//! Exact simulation of transfer functions with dead time, for inputs that are constant between switches.

use std::f64::consts::FRAC_PI_2;

use nalgebra::Matrix2;

use super::lag_chain::{Leap, MAX_ORDER, Motion, State};
use super::{LinearError, TransferFunction, TransferMatrix};

/// One way from an input to an output; several between the same two add up.
#[derive(Clone, Debug, PartialEq)]
pub struct SignalPath {
    /// Index of the input, 0 or 1.
    pub input: usize,
    /// Index of the output, 0 or 1.
    pub output: usize,
    /// What the way does.
    pub element: TransferFunction,
}

/// A path with its state.
#[derive(Clone, Debug)]
struct PathState {
    input: usize,
    output: usize,
    dead_time: f64,
    motion: Motion,
    state: State,
    /// What the input was one dead time ago.
    acting: f64,
    /// Index of the next change of the input that has not arrived.
    awaited: usize,
}

/// A plant with two inputs and two outputs as a sum of paths, each with any dead time, started at rest.
///
/// Inputs change only through [`set_inputs`](Self::set_inputs); between changes, and between their delayed arrivals,
/// every path moves exactly (to rounding). The unit of time is that of the plant.
#[derive(Clone, Debug)]
pub struct DelayedPlant {
    paths: Vec<PathState>,
    inputs: [f64; 2],
    /// Changes of each input: time and new value.
    changes: [Vec<(f64, f64)>; 2],
    time: f64,
    search_step: f64,
    /// The latest durations of a motion, oldest first.
    regular: Vec<Regular>,
}

/// A duration that may come again, as those between samples and arrivals do.
#[derive(Clone, Debug)]
struct Regular {
    duration: f64,
    /// The leap of each path; none until the duration comes for the second time.
    leaps: Vec<Leap>,
}

/// Durations that are remembered: more than there are pieces between two samples.
const REGULAR: usize = 16;
/// Durations that differ by less than this share of the time are the same, up to the rounding of times.
const SAME_DURATION: f64 = 4.0 * f64::EPSILON;

impl DelayedPlant {
    /// At rest, with both inputs zero.
    ///
    /// # Errors
    /// [`LinearError::OutOfRange`] for a path that is not proper, of an order above [`MAX_ORDER`], or with an index of
    /// input or output above 1.
    pub fn new(paths: &[SignalPath]) -> Result<Self, LinearError> {
        if let Some(path) = paths.iter().find(|path| path.input > 1 || path.output > 1) {
            return Err(LinearError::OutOfRange { field: "path", value: path.input.max(path.output) as f64 });
        }
        let moving = |path: &SignalPath| {
            let motion = Motion::new(&path.element)?;
            let dead_time = path.element.dead_time();
            let (input, output) = (path.input, path.output);
            Ok(PathState { input, output, dead_time, motion, state: [0.0; MAX_ORDER], acting: 0.0, awaited: 0 })
        };
        let states = paths.iter().map(moving).collect::<Result<Vec<_>, LinearError>>()?;
        let swings = paths.iter().map(|path| quarter_of_quickest_swing(&path.element));
        let search_step =
            states.iter().map(|path| 0.5 * path.motion.unit()).chain(swings).fold(f64::INFINITY, f64::min);
        Ok(Self {
            paths: states,
            inputs: [0.0; 2],
            changes: [Vec::new(), Vec::new()],
            time: 0.0,
            search_step,
            regular: Vec::new(),
        })
    }

    /// Time since the start.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Both inputs from now on.
    pub fn set_inputs(&mut self, inputs: [f64; 2]) {
        for (i, input) in inputs.into_iter().enumerate() {
            if input != self.inputs[i] {
                self.changes[i].push((self.time, input));
            }
        }
        self.inputs = inputs;
        self.take_arrivals();
    }

    /// Both outputs now.
    pub fn outputs(&self) -> [f64; 2] {
        self.sum(|path| path.motion.output(&path.state, path.acting))
    }

    /// Both outputs `duration` from now, which must be no longer than [`time_to_arrival`](Self::time_to_arrival).
    pub fn outputs_after(&self, duration: f64) -> [f64; 2] {
        match self.leaps(duration) {
            Some(leaps) => {
                let mut leaps = leaps.iter();
                self.sum(|path| {
                    leaps
                        .next()
                        .map_or(0.0, |leap| path.motion.output(&leap.after(&path.state, path.acting), path.acting))
                })
            }
            None => {
                self.sum(|path| path.motion.output(&path.motion.after(&path.state, path.acting, duration), path.acting))
            }
        }
    }

    /// What each output does at once when an input jumps, row by output.
    pub fn instant_gain(&self) -> Matrix2<f64> {
        let mut gain = Matrix2::zeros();
        for path in self.paths.iter().filter(|path| path.dead_time == 0.0) {
            gain[(path.output, path.input)] += path.motion.through();
        }
        gain
    }

    /// Time until the next delayed change of an input arrives; infinite where none is pending.
    pub fn time_to_arrival(&self) -> f64 {
        self.paths.iter().filter_map(|path| self.arrival(path)).fold(f64::INFINITY, f64::min) - self.time
    }

    /// Time within which no path has more than one extremum: half of the shortest mean time constant, or a quarter of the period of the
    /// quickest swing, which may be far shorter.
    pub fn search_step(&self) -> f64 {
        self.search_step
    }

    /// Multiplications, at most, of a motion over a `duration` without arrivals.
    pub fn multiplications(&self, duration: f64) -> f64 {
        match self.leaps(duration) {
            Some(leaps) => leaps.iter().map(Leap::multiplications).sum(),
            None => self.paths.iter().map(|path| path.motion.multiplications(duration)).sum(),
        }
    }

    /// Advances by `duration`, across any number of arrivals.
    pub fn advance(&mut self, duration: f64) {
        let end = self.time + duration;
        loop {
            let time_to_arrival = self.time_to_arrival();
            if self.time + time_to_arrival >= end {
                break;
            }
            let arrival = self.time + time_to_arrival;
            self.glide(time_to_arrival);
            self.time = arrival;
            self.take_arrivals();
        }
        self.glide(end - self.time);
        self.time = end;
        self.take_arrivals();
    }

    fn glide(&mut self, duration: f64) {
        if let Some(k) = self.regular.iter().position(|known| self.is_same(known.duration, duration)) {
            let known = &mut self.regular[k];
            if known.leaps.is_empty() {
                known.leaps = self.paths.iter().map(|path| path.motion.leap(duration)).collect();
            }
            for (path, leap) in self.paths.iter_mut().zip(&known.leaps) {
                path.state = leap.after(&path.state, path.acting);
            }
            return;
        }
        if self.regular.len() == REGULAR {
            self.regular.remove(0);
        }
        self.regular.push(Regular { duration, leaps: Vec::new() });
        for path in &mut self.paths {
            path.state = path.motion.after(&path.state, path.acting, duration);
        }
    }

    /// The leap of each path for a duration that has come more than once.
    fn leaps(&self, duration: f64) -> Option<&[Leap]> {
        let known = self.regular.iter().find(|known| self.is_same(known.duration, duration))?;
        (!known.leaps.is_empty()).then_some(&known.leaps)
    }

    fn is_same(&self, one: f64, other: f64) -> bool {
        (one - other).abs() <= SAME_DURATION * (self.time + other)
    }

    /// When the awaited change arrives at the end of a path.
    fn arrival(&self, path: &PathState) -> Option<f64> {
        self.changes[path.input].get(path.awaited).map(|(time, _)| time + path.dead_time)
    }

    fn take_arrivals(&mut self) {
        let Self { paths, changes, time, .. } = self;
        for path in paths {
            while let Some(&(begun, value)) = changes[path.input].get(path.awaited) {
                if begun + path.dead_time > *time {
                    break;
                }
                path.acting = value;
                path.awaited += 1;
            }
        }
    }

    fn sum(&self, mut of_path: impl FnMut(&PathState) -> f64) -> [f64; 2] {
        let mut outputs = [0.0; 2];
        for path in &self.paths {
            outputs[path.output] += of_path(path);
        }
        outputs
    }
}

/// A quarter of the period of the quickest oscillation of an element (s); infinite without complex poles.
fn quarter_of_quickest_swing(element: &TransferFunction) -> f64 {
    let quickest = element.poles().unwrap_or_default().iter().map(|pole| pole.im).fold(0.0, f64::max);
    FRAC_PI_2 / quickest
}

impl TransferMatrix {
    /// The four elements as paths.
    pub fn paths(&self) -> Vec<SignalPath> {
        let path = |output: usize, input: usize| SignalPath { input, output, element: self.0[output][input].clone() };
        vec![path(0, 0), path(0, 1), path(1, 0), path(1, 1)]
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    fn one(dead_time: f64) -> SignalPath {
        SignalPath { input: 0, output: 0, element: TransferFunction::lags(2.0, &[3.0], dead_time).unwrap() }
    }

    /// Response of `2/(3 s + 1)` to a unit step.
    fn step(t: f64) -> f64 {
        if t > 0.0 { 2.0 * (1.0 - (-t / 3.0).exp()) } else { 0.0 }
    }

    #[test]
    fn a_dead_time_that_is_no_multiple_of_anything() {
        let dead_time = std::f64::consts::SQRT_2;
        let mut plant = DelayedPlant::new(&[one(dead_time)]).unwrap();
        let mut t = 0.0;
        for k in 0..40 {
            // A step at 0 and one back at 2.1.
            plant.set_inputs([if k < 3 { 1.0 } else { 0.0 }, 0.0]);
            plant.advance(0.7);
            t += 0.7;
            let expected = step(t - dead_time) - step(t - 3.0 * 0.7 - dead_time);
            assert_relative_eq!(plant.outputs()[0], expected, epsilon = 1e-13);
        }
        assert_eq!(plant.time_to_arrival(), f64::INFINITY);
    }

    #[test]
    fn looking_ahead_is_what_happens() {
        let mut plant = DelayedPlant::new(&[one(1.0), one(0.25)]).unwrap();
        plant.set_inputs([1.0, 0.0]);
        assert_relative_eq!(plant.time_to_arrival(), 0.25);
        plant.advance(0.5);
        assert_relative_eq!(plant.time_to_arrival(), 0.5);
        let ahead = plant.outputs_after(0.3)[0];
        plant.advance(0.3);
        assert_relative_eq!(plant.outputs()[0], ahead, max_relative = 1e-14);
        assert_relative_eq!(ahead, step(0.55), max_relative = 1e-13);
    }

    #[test]
    fn a_path_of_a_third_signal_is_refused() {
        let refused = Some(LinearError::OutOfRange { field: "path", value: 2.0 });
        for path in [SignalPath { input: 2, ..one(0.0) }, SignalPath { output: 2, ..one(0.0) }] {
            assert_eq!(DelayedPlant::new(&[one(0.0), path]).err(), refused);
        }
    }

    #[test]
    fn paths_between_the_same_two_add_up() {
        let mut plant = DelayedPlant::new(&[one(0.0), one(2.0)]).unwrap();
        plant.set_inputs([1.0, 5.0]);
        plant.advance(3.0);
        assert_relative_eq!(plant.outputs()[0], step(3.0) + step(1.0), max_relative = 1e-13);
        assert_eq!(plant.outputs()[1], 0.0);
    }
}
