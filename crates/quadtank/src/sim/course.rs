//! The course of a run: two sampled loops around any process, step by step along the time axis of the experiment.

use crate::control::{DecentralisedPi, Pairing, RunningPi};
use crate::plant::{Disturbance, OperatingPoint, QuadrupleTank};

use super::experiment::{Experiment, Load, LoadStep, PumpVoltageStep, SetPointStep};
use super::hoses::Hoses;
use super::noise::{FlowNoise, Noise};
use super::trajectory::{Event, EventKind, Trajectory};
use super::walls::Watch;

/// What the loops act on: the nonlinear plant or its linear model.
pub(super) trait Process {
    /// Levels (m).
    fn levels(&self) -> [f64; 4];
    /// Sets the inputs that hold from now on.
    fn set_inputs(&mut self, pump_voltage: &[f64; 2], disturbance: &Disturbance);
    /// Lets `duration` seconds pass from `time` on.
    fn advance(&mut self, time: f64, duration: f64, events: &mut Events);
    /// Work of the integration so far, in explicit steps.
    fn work(&self) -> u64;
}

/// Events of a run, each kind once, in order of time.
#[derive(Debug, Default)]
pub(super) struct Events(Vec<Event>);

impl Events {
    fn note(&mut self, time_s: f64, kind: EventKind) {
        if self.0.iter().all(|event| event.kind != kind) {
            let place = self.0.partition_point(|earlier| earlier.time_s <= time_s);
            self.0.insert(place, Event { time_s, kind });
        }
    }
}

impl Watch for Events {
    fn overflow(&mut self, tank: usize, time: f64) {
        self.note(time, EventKind::Overflow { tank });
    }

    fn empty(&mut self, tank: usize, time: f64) {
        self.note(time, EventKind::Empty { tank });
    }
}

/// Most rows of a trajectory; a longer run is cut there. It keeps a hostile document from filling the memory.
pub const MAX_ROWS: usize = 200_000;

/// Most work of one run, in explicit steps of the integration; a run that needs more is cut there. The longest ordinary run, of
/// 20,000 samples, takes 160,000 at most; tanks that are almost dry while pumps or valves swing may ask for any number.
pub const MAX_RUN_WORK: u64 = 200_000;

/// Most work of a noisy experiment whose twin without noise is run as well, to judge its responses: beyond it the two together
/// might take more than [`MAX_RUN_WORK`].
pub const MAX_JUDGED_WORK: u64 = MAX_RUN_WORK / 2;

/// Rows that a plot needs to look smooth: between coarse samples there are rows in between.
const SMOOTH_ROWS: f64 = 1500.0;

/// Slack by which rounding may make a sample come early, in sampling times.
pub(super) const TIME_SLACK: f64 = 1e-9;

/// When the rows of a trajectory are, and which of them are samples.
#[derive(Clone, Copy, Debug)]
struct TimeAxis {
    sampling_time_s: f64,
    rows_per_sample: usize,
    rows: usize,
}

impl TimeAxis {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a float to integer cast saturates")]
    fn new(duration_s: f64, sampling_time_s: f64) -> Self {
        let samples = duration_s / sampling_time_s;
        let rows_per_sample = (SMOOTH_ROWS / samples - TIME_SLACK).ceil().clamp(1.0, SMOOTH_ROWS);
        let rows = (samples * rows_per_sample + TIME_SLACK).floor() as usize;
        Self { sampling_time_s, rows_per_sample: rows_per_sample as usize, rows: rows.saturating_add(1).min(MAX_ROWS) }
    }

    fn time(&self, row: usize) -> f64 {
        row as f64 * self.sampling_time_s / self.rows_per_sample as f64
    }

    fn is_sample(&self, row: usize) -> bool {
        row.is_multiple_of(self.rows_per_sample)
    }
}

/// Time between rows of a trajectory (s).
pub(super) fn row_spacing(experiment: &Experiment, sampling_time_s: f64) -> f64 {
    TimeAxis::new(experiment.duration_s, sampling_time_s).time(1)
}

/// Rows of a trajectory from one sample to the next.
pub(super) fn rows_per_sample(experiment: &Experiment, sampling_time_s: f64) -> usize {
    TimeAxis::new(experiment.duration_s, sampling_time_s).rows_per_sample
}

/// The steps of an experiment, the next one last; those at the same time keep their order.
fn latest_first<'a, T>(steps: impl Iterator<Item = &'a T>, time_s: impl Fn(&T) -> f64) -> Vec<&'a T> {
    let mut pending: Vec<&T> = steps.collect();
    pending.sort_by(|one, other| time_s(one).total_cmp(&time_s(other)));
    pending.reverse();
    pending
}

/// References that step at the first sample at or after the given times.
struct References<'a> {
    value: [f64; 2],
    pending: Vec<&'a SetPointStep>,
}

impl<'a> References<'a> {
    fn new(start: [f64; 2], steps: &'a [SetPointStep]) -> Self {
        let steps = steps.iter().filter(|step| step.level < 2);
        Self { value: start, pending: latest_first(steps, |step| step.time_s) }
    }

    fn at(&mut self, time: f64) -> [f64; 2] {
        while let Some(step) = self.pending.pop_if(|step| step.time_s <= time) {
            self.value[step.level] += step.size;
        }
        self.value
    }
}

/// Pumps that are moved by hand, at the first sample at or after the given times.
struct HandMoved<'a> {
    /// Voltage (V) of a pump that is moved by hand; `None` for one that follows its controller.
    voltage: [Option<f64>; 2],
    pending: Vec<&'a PumpVoltageStep>,
}

impl<'a> HandMoved<'a> {
    fn new(experiment: &'a Experiment, op: &OperatingPoint) -> Self {
        let voltage = [0, 1].map(|pump| experiment.is_by_hand(pump).then_some(op.pump_voltage[pump]));
        let steps = experiment.pump_voltage_steps.iter().filter(|step| step.pump < 2);
        Self { voltage, pending: latest_first(steps, |step| step.time_s) }
    }

    fn at(&mut self, time: f64) -> [Option<f64>; 2] {
        while let Some(step) = self.pending.pop_if(|step| step.time_s <= time) {
            self.voltage[step.pump] = Some(step.voltage);
        }
        self.voltage
    }
}

/// Loads that begin at their exact times.
pub(super) struct Loads<'a> {
    acting: Disturbance,
    pending: Vec<&'a LoadStep>,
}

impl<'a> Loads<'a> {
    pub(super) fn new(steps: &'a [LoadStep]) -> Self {
        Self { acting: Disturbance::default(), pending: latest_first(steps.iter(), |step| step.time_s) }
    }

    fn next_before(&self, time: f64) -> Option<f64> {
        self.pending.last().map(|step| step.time_s).filter(|&begin| begin < time)
    }

    pub(super) fn at(&mut self, time: f64) -> &Disturbance {
        while let Some(step) = self.pending.pop_if(|step| step.time_s <= time) {
            match step.load {
                Load::PumpFlow { pump, flow } if pump < 2 => self.acting.pump_flow[pump] += flow,
                Load::Leak { tank, area } if tank < 4 => self.acting.leak_area[tank] += area,
                Load::TankFlow { tank, flow } if tank < 4 => self.acting.tank_flow[tank] += flow,
                Load::PumpGain { pump, change } if pump < 2 => self.acting.pump_gain_change[pump] += change,
                Load::Valve { valve, change } if valve < 2 => self.acting.valve_change[valve] += change,
                Load::Outlet { tank, change } if tank < 4 => self.acting.outlet_change[tank] += change,
                // An index that the rig does not have; documents with one are refused.
                _ => (),
            }
        }
        &self.acting
    }
}

/// What gives the outputs of both loops at a sample.
pub(super) trait Law {
    /// One sample at `time` (s): takes references and measured signals of levels 1 and 2 (V), returns the limited outputs of
    /// loops 1 and 2 (V).
    fn step(&mut self, time: f64, reference: [f64; 2], measured: [f64; 2]) -> [f64; 2];
}

impl Law for RunningPi {
    fn step(&mut self, time: f64, reference: [f64; 2], measured: [f64; 2]) -> [f64; 2] {
        RunningPi::step(self, time, reference, measured)
    }
}

/// Runs an experiment with two PI loops that rest at the operating point.
pub(super) fn run_pi(
    process: &mut dyn Process,
    plant: &QuadrupleTank,
    op: &OperatingPoint,
    controller: &DecentralisedPi,
    experiment: &Experiment,
) -> Trajectory {
    let rest_signal = [op.levels[0], op.levels[1]].map(|level| plant.sensor.measure(level));
    let mut law = controller.start(plant.controller_limits(), output_at_rest(plant, op), rest_signal);
    let DecentralisedPi { pairing, sampling_time_s, .. } = *controller;
    run(process, plant, op, Sampled { law: &mut law, pairing, sampling_time_s }, experiment)
}

/// Controller output at rest (V), by pump.
pub(super) fn output_at_rest(plant: &QuadrupleTank, op: &OperatingPoint) -> [f64; 2] {
    op.pump_voltage.map(|voltage| voltage / plant.power_gain)
}

/// What a law sees: time (s), references and measured signals of levels 1 and 2 (V).
#[derive(Clone, Copy)]
struct Sample {
    time: f64,
    reference: [f64; 2],
    measured: [f64; 2],
}

/// A law with the limits of the pumps that its loops drive.
struct Loops<'a> {
    pairing: Pairing,
    law: &'a mut dyn Law,
    limits: [(f64, f64); 2],
    power_gain: f64,
}

impl<'a> Loops<'a> {
    fn new(plant: &QuadrupleTank, pairing: Pairing, law: &'a mut dyn Law) -> Self {
        let limits = pairing.by_loop(plant.controller_limits());
        Self { pairing, law, limits, power_gain: plant.power_gain }
    }

    /// One sample: new outputs from references and measured signals (V), and those of pumps that are moved by hand. Notes the
    /// pumps that are at a limit.
    fn step(&mut self, at: Sample, by_hand: [Option<f64>; 2], events: &mut Events) -> [f64; 2] {
        let Sample { time, reference, measured } = at;
        let mut output = self.law.step(time, reference, measured);
        for (i, (output, (min, max))) in output.iter_mut().zip(self.limits).enumerate() {
            if let Some(voltage) = by_hand[self.pairing.pump_of(i)] {
                *output = (voltage / self.power_gain).max(min).min(max);
            }
            if *output <= min || *output >= max {
                events.note(time, EventKind::Saturated { pump: self.pairing.pump_of(i) });
            }
        }
        output
    }

    fn pump_voltage(&self, output: [f64; 2]) -> [f64; 2] {
        let [first, second] = self.pairing.by_pump(output);
        [self.power_gain * first, self.power_gain * second]
    }
}

/// A law with the pumps that its loops drive and its sampling time Ts (s).
pub(super) struct Sampled<'a> {
    pub(super) law: &'a mut dyn Law,
    pub(super) pairing: Pairing,
    pub(super) sampling_time_s: f64,
}

/// The earlier of two times, where there is any.
fn earlier(one: Option<f64>, other: Option<f64>) -> Option<f64> {
    one.into_iter().chain(other).min_by(f64::total_cmp)
}

/// Runs an experiment from the operating point on; see [`super::simulate`] for what happens when.
pub(super) fn run(
    process: &mut dyn Process,
    plant: &QuadrupleTank,
    op: &OperatingPoint,
    sampled: Sampled,
    experiment: &Experiment,
) -> Trajectory {
    let Sampled { law, pairing, sampling_time_s } = sampled;
    let axis = TimeAxis::new(experiment.duration_s, sampling_time_s);
    let slack = TIME_SLACK * axis.sampling_time_s;
    let mut references = References::new([op.levels[0], op.levels[1]], &experiment.set_point_steps);
    let steps = experiment.all_loads(plant.inflow);
    let mut loads = Loads::new(&steps);
    let mut hand_moved = HandMoved::new(experiment, op);
    let mut loops = Loops::new(plant, pairing, law);
    let mut noise = Noise::new(&experiment.measurement);
    let mut flow_noise = FlowNoise::new(experiment);
    let mut hoses = Hoses::new(plant, op, experiment);
    let mut events = Events::default();
    let mut trajectory = Trajectory::with_rows(axis.rows);
    let (mut output, mut voltage) = ([0.0; 2], [0.0; 2]);
    for row in 0..axis.rows {
        let time = axis.time(row);
        loads.at(time + slack);
        if axis.is_sample(row) {
            let levels = process.levels();
            let [r1, r2] = references.at(time + slack);
            let reference = [plant.sensor.measure(r1), plant.sensor.measure(r2)];
            let measured = noise.measure(&plant.sensor, [levels[0], levels[1]]);
            let by_hand = hand_moved.at(time + slack);
            output = loops.step(Sample { time, reference, measured }, by_hand, &mut events);
            voltage = loops.pump_voltage(output);
            hoses.send(time, voltage);
            flow_noise.draw();
        }
        process.set_inputs(&hoses.at(time + slack), &flow_noise.on(&loads.acting));
        trajectory.set(row, time, process.levels(), references.value, output, voltage);
        if row + 1 == axis.rows {
            break;
        }
        if process.work() > MAX_RUN_WORK {
            trajectory.truncate(row + 1);
            trajectory.halted_at_s = Some(time);
            break;
        }
        let end = axis.time(row + 1);
        let mut now = time;
        while let Some(begin) = earlier(loads.next_before(end - slack), hoses.next_before(end - slack)) {
            process.advance(now, begin - now, &mut events);
            process.set_inputs(&hoses.at(begin), &flow_noise.on(loads.at(begin)));
            now = begin;
        }
        process.advance(now, end - now, &mut events);
    }
    trajectory.events = events.0;
    trajectory.work = process.work();
    trajectory
}
