use super::experiment::{LevelController, LevelExperiment, LevelRunError, SetPointScale, SignalStep};
use super::kernel::{Kernel, Law, LoopState, share_of};
use super::log::LevelLog;
use crate::control::{AntiWindup, Pi};
use crate::plant::level::{LevelGains, LevelPlant, LevelSignals};

/// Most integration steps of a run, those included that are made anew where an element changes its branch: at most some 50 ms in
/// WebAssembly, of which the page needs two.
pub const MAX_LEVEL_STEPS: f64 = 1.2e5;

/// Longest step of integration as a share of the quickest lag of the plant.
const LAG_SHARE: f64 = 0.7;
/// Longest step as a share of the quickest motion of the closed loop.
const LOOP_SHARE: f64 = 0.2;
/// Longest step (s) as a share of the run. What changes more quickly within it is the disturbance, which bounds it too.
const LONGEST_SHARE: f64 = 2e-3;

/// A plant and an experiment, prepared for runs with any number of controllers.
///
/// ```
/// use quadtank::literature::andreis;
/// use quadtank::sim::level::{InflowDisturbance, InflowSignal, LevelController, LevelExperiment, LevelSimulation};
///
/// let sine = InflowSignal::Sine { amplitude: 0.0085, period_s: 50.0 };
/// let experiment = LevelExperiment {
///     level: 1.0,
///     inflow: 0.017,
///     duration_s: 300.0,
///     log_step_s: 1.0,
///     disturbance: InflowDisturbance { signal: sine, from_s: 50.0, until_s: 150.0 },
///     set_point_steps: Vec::new(),
///     set_point_scale: Default::default(),
/// };
/// let log = LevelSimulation::new(&andreis::plant(), &experiment)?.run(&LevelController::pi(10.0, 2500.0))?;
/// let [level, _] = log.statistics(0..log.len()).expect("more than two rows");
/// assert!((level.variance - 3.5016e-4).abs() < 5e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct LevelSimulation {
    kernel: Kernel,
    rest: LevelSignals,
    gains: LevelGains,
    rows: usize,
    log_step_s: f64,
    /// Integration steps between rows, and the length of one (s).
    steps_per_row: usize,
    step_s: f64,
    /// Inflow (m³/s) at the beginning, in the middle and at the end of each step.
    inflows: Vec<[f64; 3]>,
    /// Reference signal at rest, and steps of it.
    reference: f64,
    reference_steps: Vec<SignalStep>,
}

/// Whole steps of at most a length (s) in a row of the log (s). A rounding error is no reason for one more.
fn steps_per_row(row_s: f64, longest_s: f64) -> f64 {
    (row_s / longest_s * (1.0 - 1e-9)).max(1.0).ceil()
}

/// Refuses a run of more steps than any is given, for the sake of a number of the experiment or the controller.
fn within_bound(field: &'static str, steps: f64) -> Result<(), LevelRunError> {
    // NaN as well.
    if steps <= MAX_LEVEL_STEPS {
        Ok(())
    } else {
        Err(LevelRunError::TooMuchWork { field, steps, max: MAX_LEVEL_STEPS })
    }
}

/// The smallest whole number from a positive one on, 1 at least.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the cast saturates")]
fn whole(number: f64) -> usize {
    (number.ceil() as usize).max(1)
}

impl LevelSimulation {
    /// Finds the rest and prepares the inflow.
    ///
    /// A step of integration is at most 0.7 of the quickest lag and 0.002 of the run, and a whole part of a row; a quick
    /// controller has it divided. For the loop of Andreis (2017) it is ⅓ s, which gives variances to 3e-5 and takes 0.15 ms for a
    /// run of 300 s (0.28 ms at gains above 24; Xeon at 2.5 GHz).
    ///
    /// # Errors
    /// [`LevelRunError`] for a rest that does not exist, numbers without meaning, no log or too much work.
    pub fn new(plant: &LevelPlant, experiment: &LevelExperiment) -> Result<Self, LevelRunError> {
        Self::with_step_factor(plant, experiment, 1.0)
    }

    /// The same with all steps shorter by a factor.
    fn with_step_factor(plant: &LevelPlant, experiment: &LevelExperiment, factor: f64) -> Result<Self, LevelRunError> {
        experiment.check()?;
        let rest = plant.rest(experiment.level, experiment.inflow)?;
        let kernel = Kernel::new(plant);
        let log_step_s = experiment.log_step_s;
        let longest = LONGEST_SHARE * experiment.duration_s;
        let quickest = kernel.quickest_lag();
        let longest = if quickest > 0.0 { longest.min(LAG_SHARE / quickest) } else { longest };
        let rows = (experiment.duration_s / log_step_s * (1.0 + 1e-12)).floor();
        let mut per_row = steps_per_row(factor * log_step_s, longest);
        within_bound("duration_s", rows * per_row)?;
        if let Some((field, longest)) = experiment.disturbance.longest_step() {
            per_row = per_row.max(steps_per_row(factor * log_step_s, longest));
            within_bound(field, rows * per_row)?;
        }
        let (rows, steps_per_row) = (whole(rows), whole(per_row));
        let step_s = log_step_s / steps_per_row as f64;
        let mut inflows = experiment.disturbance.over_steps(step_s, rows * steps_per_row);
        for value in inflows.as_flattened_mut() {
            *value = (experiment.inflow + *value).max(0.0);
        }
        let scale = match experiment.set_point_scale {
            SetPointScale::Level => plant.transmitter.gain(),
            SetPointScale::Signal => 1.0,
        };
        let reference_steps = experiment
            .set_point_steps
            .iter()
            .map(|step| SignalStep { time_s: step.time_s, size: scale * step.size })
            .collect();
        Ok(Self {
            reference: plant.transmitter.signal_of(experiment.level),
            gains: plant.gains(&rest),
            kernel,
            rest,
            rows,
            log_step_s,
            steps_per_row,
            step_s,
            inflows,
            reference_steps,
        })
    }

    /// Steps of integration of a run, before a quick controller has them divided.
    pub fn steps(&self) -> usize {
        self.rows * self.steps_per_row
    }

    /// The signals at rest, from which a run starts.
    pub fn rest(&self) -> &LevelSignals {
        &self.rest
    }

    /// The linear model around that rest.
    pub fn gains(&self) -> &LevelGains {
        &self.gains
    }

    /// Runs with a controller.
    ///
    /// # Errors
    /// [`LevelRunError::OutOfRange`] for a controller without meaning, [`LevelRunError::TooMuchWork`] for one that is much quicker
    /// than its plant.
    pub fn run(&self, controller: &LevelController) -> Result<LevelLog, LevelRunError> {
        let mut log = LevelLog::default();
        self.run_into(controller, &mut log)?;
        Ok(log)
    }

    /// Runs with a controller and writes a log that is there already, so that many runs take no memory.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn run_into(&self, controller: &LevelController, log: &mut LevelLog) -> Result<(), LevelRunError> {
        controller.check()?;
        log.clear();
        let mut running = Running::new(self, controller)?;
        for row in 0..self.rows {
            running.log_row(log, row);
            for step in row * self.steps_per_row..(row + 1) * self.steps_per_row {
                running.advance(step, log);
                within_bound("duration_s", log.steps as f64)?;
            }
        }
        running.log_row(log, self.rows);
        let rows = log.level.iter().zip(&log.outflow).zip(&log.output);
        let broken = rows.map(|((level, flow), output)| level + flow + output).position(|sum| !sum.is_finite());
        broken.map_or(Ok(()), |row| Err(LevelRunError::NotFinite { time_s: log.time_s[row] }))
    }

    /// Time (s) of the beginning of a step.
    fn time(&self, step: usize) -> f64 {
        step as f64 * self.step_s
    }

    /// The reference signal during a step, or the output by hand: a value with its steps up to the middle of it.
    fn stepped(&self, value: f64, steps: &[SignalStep], step: usize) -> f64 {
        let middle = self.time(step) + 0.5 * self.step_s;
        steps.iter().filter(|change| change.time_s < middle).fold(value, |sum, change| sum + change.size)
    }

    /// Pieces of one step that a continuous law needs. Its quickest pole is about that of the filter, or the gain that the slope
    /// of the signal leaves with the lags of the plant.
    fn pieces(&self, law: &Law) -> Result<usize, LevelRunError> {
        let lags = [self.gains.actuator_lag_s, self.gains.transmitter_lag_s];
        let (product, count) = lags.iter().filter(|&&lag| lag > 0.0).fold((1.0, 1_i32), |(p, n), lag| (p * lag, n + 1));
        let gain = (law.proportional.abs() + law.derivative.abs()) * self.gains.slope_gain().abs() / product;
        let quickest = law.filter_rate + law.tracking_rate + gain.powf(f64::from(count).recip());
        let pieces = (quickest * self.step_s / LOOP_SHARE * (1.0 - 1e-9)).max(1.0).ceil();
        let steps = pieces * self.inflows.len() as f64;
        within_bound("controller", steps)?;
        Ok(whole(pieces))
    }
}

/// What sets the output during a run.
enum Actor<'a> {
    Manual(&'a [SignalStep]),
    Continuous,
    Sampled { pi: Pi, steps: usize },
}

/// A run under way.
struct Running<'a> {
    simulation: &'a LevelSimulation,
    actor: Actor<'a>,
    law: Law,
    /// Pieces of a step of integration.
    pieces: usize,
    moving: LoopState,
    reference: f64,
}

impl<'a> Running<'a> {
    fn new(simulation: &'a LevelSimulation, controller: &'a LevelController) -> Result<Self, LevelRunError> {
        let bias = simulation.rest.output;
        let mut pieces = 1;
        let (actor, law) = match controller {
            LevelController::Manual { steps } => (Actor::Manual(steps), Law::held(bias)),
            LevelController::Pi { gain, integral_time_s, anti_windup } => {
                let tracking_rate = match anti_windup {
                    AntiWindup::Off => 0.0,
                    AntiWindup::BackCalculation { tracking_ratio } => (tracking_ratio * integral_time_s).recip(),
                };
                let law = Law {
                    bias,
                    proportional: *gain,
                    integral: gain / integral_time_s,
                    derivative: 0.0,
                    filter_rate: 0.0,
                    tracking_rate,
                };
                pieces = simulation.pieces(&law)?;
                (Actor::Continuous, law)
            }
            LevelController::Pid { proportional, integral, derivative, filter_time_s } => {
                let filter_rate = if *derivative == 0.0 { 0.0 } else { filter_time_s.recip() };
                let law = Law {
                    bias,
                    proportional: *proportional,
                    integral: *integral,
                    derivative: derivative * filter_rate,
                    filter_rate,
                    tracking_rate: 0.0,
                };
                pieces = simulation.pieces(&law)?;
                (Actor::Continuous, law)
            }
            LevelController::Sampled { settings, sampling_time_s } => {
                let ratio = sampling_time_s / simulation.step_s;
                // A sampling time below a step shortens the step instead.
                let steps = whole(ratio.round());
                let limits = simulation.kernel.output_limits();
                let sampling_time_s = steps as f64 * simulation.step_s;
                let pi = Pi::new(*settings, limits, sampling_time_s, bias, simulation.reference);
                (Actor::Sampled { pi, steps }, Law::held(bias))
            }
        };
        let moving = simulation.kernel.start(&simulation.rest);
        let mut running = Self { simulation, actor, law, pieces, moving, reference: simulation.reference };
        running.act(0);
        Ok(running)
    }

    /// Sets reference and held output at the beginning of a step.
    fn act(&mut self, step: usize) {
        let simulation = self.simulation;
        if !simulation.reference_steps.is_empty() {
            self.reference = simulation.stepped(simulation.reference, &simulation.reference_steps, step);
            self.moving.renew();
        }
        match &mut self.actor {
            Actor::Continuous => {}
            Actor::Manual(steps) => {
                if !steps.is_empty() {
                    self.law = Law::held(simulation.stepped(simulation.rest.output, steps, step));
                    self.moving.renew();
                }
            }
            Actor::Sampled { pi, steps } => {
                if step.is_multiple_of(*steps) {
                    let measured = simulation.kernel.measured(&self.moving.state);
                    self.law = Law::held(pi.step(simulation.time(step), self.reference, measured));
                    self.moving.renew();
                }
            }
        }
    }

    fn advance(&mut self, step: usize, log: &mut LevelLog) {
        let simulation = self.simulation;
        let kernel = &simulation.kernel;
        let inflow = simulation.inflows[step];
        if self.pieces == 1 {
            log.steps += kernel.step(&self.law, self.reference, simulation.step_s, inflow, &mut self.moving);
        } else {
            let share = (self.pieces as f64).recip();
            for piece in 0..self.pieces {
                let inflow = share_of(inflow, piece as f64 * share, share);
                log.steps +=
                    kernel.step(&self.law, self.reference, share * simulation.step_s, inflow, &mut self.moving);
            }
        }
        if kernel.is_full(self.moving.state[0]) {
            log.full_s += simulation.step_s;
        } else if self.moving.state[0] <= 0.0 {
            log.empty_s += simulation.step_s;
        }
        self.act(step + 1);
    }

    fn log_row(&self, log: &mut LevelLog, row: usize) {
        let simulation = self.simulation;
        let (kernel, state) = (&simulation.kernel, &self.moving.state);
        let output = kernel.output(&self.law, self.reference, state);
        let pressure = kernel.pressure(output, state);
        let (travel, _) = kernel.travel(pressure);
        let [valve_flow, outflow] = kernel.flows(state[0], travel);
        let step = row * simulation.steps_per_row;
        let inflow = simulation.inflows.get(step).map_or_else(|| simulation.inflows[step - 1][2], |values| values[0]);
        log.time_s.push(row as f64 * simulation.log_step_s);
        log.reference.push(self.reference);
        log.inflow.push(inflow);
        log.level.push(state[0]);
        log.transmitted.push(kernel.transmitted(state));
        log.output.push(output);
        log.actuator_pressure.push(pressure);
        log.travel.push(travel);
        log.valve_flow.push(valve_flow);
        log.outflow.push(outflow);
    }
}

#[cfg(test)]
mod tests;
