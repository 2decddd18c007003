//! Relays and PID controllers around a plant with two inputs and outputs, with every switch at its exact instant.

use std::cell::Cell;

use nalgebra::{Matrix2, Vector2};

use crate::control::{PidMatrix, Relay};
use crate::linear::{DelayedPlant, least_real_part};
use crate::numeric::root;

use super::course::MAX_ROWS;

/// A plant whose inputs are held between changes, in deviations from its rest.
pub trait HeldPlant {
    /// Both outputs now.
    fn outputs(&self) -> [f64; 2];
    /// Both inputs from now on. Returns the inputs that the plant applies, which its limits may reduce.
    fn set_inputs(&mut self, inputs: [f64; 2]) -> [f64; 2];
    /// What each output does at once when an input jumps, row by output; zero for a plant without direct feedthrough.
    fn instant_gain(&self) -> Matrix2<f64> {
        Matrix2::zeros()
    }
    /// Time for which the outputs stay smooth without a change of the inputs: until the next delayed change arrives.
    fn time_to_arrival(&self) -> f64;
    /// Both outputs `duration` from now, at most [`time_to_arrival`](Self::time_to_arrival).
    fn outputs_after(&self, duration: f64) -> [f64; 2];
    /// Advances the plant by `duration`, at most [`time_to_arrival`](Self::time_to_arrival).
    fn advance(&mut self, duration: f64);
    /// Time within which an output has at most one extremum, for the search for switches.
    fn search_step(&self) -> f64;
    /// Multiplications, at most, of [`outputs_after`](Self::outputs_after) and of [`advance`](Self::advance) over a smooth piece
    /// of at most `duration`.
    fn multiplications(&self, duration: f64) -> f64;
}

impl HeldPlant for DelayedPlant {
    fn outputs(&self) -> [f64; 2] {
        self.outputs()
    }

    fn set_inputs(&mut self, inputs: [f64; 2]) -> [f64; 2] {
        self.set_inputs(inputs);
        inputs
    }

    fn instant_gain(&self) -> Matrix2<f64> {
        self.instant_gain()
    }

    fn time_to_arrival(&self) -> f64 {
        self.time_to_arrival()
    }

    fn outputs_after(&self, duration: f64) -> [f64; 2] {
        self.outputs_after(duration)
    }

    fn advance(&mut self, duration: f64) {
        self.advance(duration);
    }

    fn search_step(&self) -> f64 {
        self.search_step()
    }

    fn multiplications(&self, duration: f64) -> f64 {
        self.multiplications(duration)
    }
}

/// Two loops with relays, PID controllers or both around a plant, and the experiment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoLoops {
    /// A relay in loop 1, in loop 2, or none.
    pub relays: [Option<Relay>; 2],
    /// Sampled controllers, added to the relays.
    pub controllers: PidMatrix,
    /// References from the start on (unit of the outputs).
    pub references: [f64; 2],
    /// When relays begin to switch (unit of time of the plant). Until then they hold their first value: at rest every
    /// relay stands exactly on its threshold, and where the paths across are the quicker ones they would switch each
    /// other for ever.
    pub release: f64,
    /// Duration (unit of time of the plant).
    pub duration: f64,
    /// Time between rows, which is the sampling time of the controllers (unit of time of the plant).
    pub step: f64,
}

impl TwoLoops {
    /// Size of all that moves the plant.
    fn excitation(&self) -> f64 {
        let relays = self.relays.iter().flatten().map(|relay| relay.amplitude + relay.bias.abs());
        self.references.iter().map(|r| r.abs()).chain(relays).sum()
    }
}

/// Why a run ended before its time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Halt {
    /// A relay switched again and again at once: it slides, or would switch as fast as it can.
    Chattering {
        /// Index of the loop.
        relay: usize,
        /// When.
        time: f64,
    },
    /// An output left all bounds.
    Diverged {
        /// When.
        time: f64,
    },
    /// The record has as many rows as it may have, or the run took as much work as it may, [`MAX_WORK`].
    Full {
        /// When.
        time: f64,
    },
}

/// What a run of [`TwoLoops`] left behind. Rows are at multiples of the step, at switches and at arrivals of what a dead
/// time had held back; inputs hold from their row to the next.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LoopTrace {
    /// Times of the rows.
    pub time: Vec<f64>,
    /// Inputs from the rows on, as the plant took them.
    pub inputs: [Vec<f64>; 2],
    /// Whether the plant ever took less of an input than was asked for.
    pub limited: [bool; 2],
    /// Outputs at the rows.
    pub outputs: [Vec<f64>; 2],
    /// When each relay switched, and whether its error had become positive.
    pub switches: [Vec<(f64, bool)>; 2],
    /// Why it ended early.
    pub halt: Option<Halt>,
    /// Work of the run, in multiplications: an upper bound, the same on every machine.
    pub work: f64,
}

/// Switches in a row, each after next to nothing, that are taken for chattering, and what is next to nothing, as a share of the
/// search step of the plant.
const HASTY_SWITCHES: u32 = 12;
const HASTY: f64 = 1e-6;
/// Outputs beyond this many times the excitation have diverged.
const DIVERGED: f64 = 1e12;
/// Most work of one run, in multiplications: about 30 ms in WebAssembly, three times what a published relay test takes.
pub const MAX_WORK: f64 = 1e7;
/// What a motion takes besides those of the plant, controllers and rows included; measured.
const WORK_PER_MOTION: f64 = 100.0;

/// Runs the loops from rest. Relays start with the sign of their first error, and a positive one where that is zero.
pub fn run_two_loops(plant: &mut dyn HeldPlant, loops: &TwoLoops) -> LoopTrace {
    run_two_loops_within(plant, loops, MAX_WORK)
}

/// The same with another bound on the work than [`MAX_WORK`].
pub fn run_two_loops_within(plant: &mut dyn HeldPlant, loops: &TwoLoops, most_work: f64) -> LoopTrace {
    let mut run = Run::new(plant, loops, most_work);
    let mut sample = 0_u32;
    while run.trace.halt.is_none() && run.time < loops.duration {
        run.take_sample();
        sample += 1;
        run.pass_until((f64::from(sample) * loops.step).min(loops.duration));
    }
    run.row();
    run.trace.work = run.work.get();
    run.trace
}

struct Run<'a> {
    plant: &'a mut dyn HeldPlant,
    loops: &'a TwoLoops,
    controllers: crate::control::RunningPidMatrix,
    instant: Matrix2<f64>,
    /// Output of the controllers, held between samples.
    held: [f64; 2],
    /// What each relay takes the sign of its error to be.
    positive: [bool; 2],
    inputs: [f64; 2],
    time: f64,
    /// Switches in a row that came at once after the one before.
    hasty: u32,
    /// Work at most and so far, in multiplications.
    most_work: f64,
    work: Cell<f64>,
    trace: LoopTrace,
}

impl<'a> Run<'a> {
    fn new(plant: &'a mut dyn HeldPlant, loops: &'a TwoLoops, most_work: f64) -> Self {
        let outputs = plant.outputs();
        let positive = [0, 1].map(|i| loops.references[i] - outputs[i] >= 0.0);
        let controllers = loops.controllers.start(loops.step);
        let instant = plant.instant_gain();
        Self {
            plant,
            loops,
            controllers,
            instant,
            held: [0.0; 2],
            positive,
            inputs: [0.0; 2],
            time: 0.0,
            hasty: 0,
            most_work,
            work: Cell::new(0.0),
            trace: LoopTrace::default(),
        }
    }

    fn count_work(&self, duration: f64) {
        self.work.set(self.work.get() + WORK_PER_MOTION + self.plant.multiplications(duration));
    }

    /// Outputs after a smooth piece.
    fn look_ahead(&self, duration: f64) -> [f64; 2] {
        self.count_work(duration);
        self.plant.outputs_after(duration)
    }

    fn advance(&mut self, duration: f64) {
        self.count_work(duration);
        self.plant.advance(duration);
    }

    /// Whether the run may not go on.
    fn is_full(&self) -> bool {
        self.trace.time.len() >= MAX_ROWS || self.work.get() >= self.most_work
    }

    fn errors(&self, outputs: [f64; 2]) -> [f64; 2] {
        [self.loops.references[0] - outputs[0], self.loops.references[1] - outputs[1]]
    }

    fn take_sample(&mut self) {
        // Samples that follow each other at once, with a step of 0, would never come to the check between them.
        if self.is_full() {
            self.trace.halt = Some(Halt::Full { time: self.time });
            return;
        }
        let outputs = self.plant.outputs();
        let bound = DIVERGED * self.loops.excitation();
        if outputs.iter().any(|y| y.is_nan() || y.abs() > bound) {
            self.trace.halt = Some(Halt::Diverged { time: self.time });
            return;
        }
        let Some(errors) = self.errors_with_feedthrough(outputs) else {
            self.trace.halt = Some(Halt::Diverged { time: self.time });
            return;
        };
        self.held = self.controllers.step(errors);
        self.act();
        self.row();
    }

    /// The errors that a sample finds. Behind direct feedthrough they depend on what the controllers make of them at once, as they do
    /// in a loop without sampling: `e = r − y₀ − D (u₀ + K e)`, with the output y₀ that the plant has without inputs. `None` where no
    /// error fulfils it, or none that any lag would not lead away from: an eigenvalue of D K is −1 or beyond.
    fn errors_with_feedthrough(&self, outputs: [f64; 2]) -> Option<[f64; 2]> {
        let errors = self.errors(outputs);
        if self.instant == Matrix2::zeros() {
            return Some(errors);
        }
        let (offset, gain) = self.controllers.at_once();
        let relays = [0, 1].map(|i| self.loops.relays[i].map_or(0.0, |relay| relay.output(self.positive[i])));
        let change = Vector2::from(offset) + Vector2::from(relays) - Vector2::from(self.inputs);
        let through = self.instant * gain;
        let solved = (Matrix2::identity() + through).try_inverse().filter(|_| least_real_part(&through) > -1.0)?;
        let errors = solved * (Vector2::from(errors) - self.instant * change);
        Some([errors[0], errors[1]])
    }

    /// Sends what controllers and relays want to the plant.
    fn act(&mut self) {
        let relay = |i: usize| self.loops.relays[i].map_or(0.0, |relay| relay.output(self.positive[i]));
        let wanted = [self.held[0] + relay(0), self.held[1] + relay(1)];
        self.inputs = self.plant.set_inputs(wanted);
        for ((limited, taken), wanted) in self.trace.limited.iter_mut().zip(self.inputs).zip(wanted) {
            *limited |= taken != wanted;
        }
    }

    fn row(&mut self) {
        let outputs = self.plant.outputs();
        self.trace.time.push(self.time);
        for (i, output) in outputs.into_iter().enumerate() {
            self.trace.inputs[i].push(self.inputs[i]);
            self.trace.outputs[i].push(output);
        }
    }

    /// Until the next sample, over switches and arrivals.
    fn pass_until(&mut self, end: f64) {
        while self.time < end && self.trace.halt.is_none() {
            if self.is_full() {
                self.trace.halt = Some(Halt::Full { time: self.time });
                return;
            }
            let (left, time_to_arrival) = (end - self.time, self.plant.time_to_arrival());
            let piece = time_to_arrival.min(self.watched()).min(left);
            if let Some((relay, instant)) = self.first_switch(piece) {
                self.switch(relay, instant);
                continue;
            }
            self.advance(piece);
            // Exactly, or the last piece would leave a rounding error to go.
            self.time = if piece == left { end } else { self.time + piece };
            if piece == time_to_arrival && piece < left {
                self.row();
            }
        }
    }

    /// The longest piece in which no switch is passed over: without relays, and until they are released, there is none.
    fn watched(&self) -> f64 {
        if self.loops.relays.iter().all(Option::is_none) {
            f64::INFINITY
        } else if self.time < self.loops.release {
            self.loops.release - self.time
        } else {
            self.plant.search_step()
        }
    }

    fn switch(&mut self, relay: usize, instant: f64) {
        self.advance(instant);
        self.time += instant;
        self.positive[relay] = !self.positive[relay];
        self.hasty = if instant <= HASTY * self.plant.search_step() { self.hasty + 1 } else { 0 };
        self.trace.switches[relay].push((self.time, self.positive[relay]));
        self.act();
        self.row();
        if self.hasty >= HASTY_SWITCHES {
            self.trace.halt = Some(Halt::Chattering { relay, time: self.time });
        }
    }

    /// The relay that switches first within a smooth piece, and after how long.
    fn first_switch(&self, piece: f64) -> Option<(usize, f64)> {
        if self.time < self.loops.release || self.loops.relays.iter().all(Option::is_none) {
            return None;
        }
        let ends = self.look_ahead(piece);
        let mut first: Option<(usize, f64)> = None;
        for i in 0..2 {
            let Some(relay) = self.loops.relays[i] else { continue };
            let threshold = relay.threshold(self.positive[i]);
            // Positive as long as the relay stays what it is.
            let sign = if self.positive[i] { 1.0 } else { -1.0 };
            let stay = |outputs: [f64; 2]| sign * (self.errors(outputs)[i] - threshold);
            if stay(ends) < 0.0 {
                let now = stay(self.plant.outputs());
                // At once, where it is past its threshold already.
                let instant =
                    if now <= 0.0 { 0.0 } else { root(|h| stay(self.look_ahead(h)), (0.0, now), (piece, stay(ends))) };
                if first.is_none_or(|(_, earlier)| instant < earlier) {
                    first = Some((i, instant));
                }
            }
        }
        first
    }
}

#[cfg(test)]
mod tests;
