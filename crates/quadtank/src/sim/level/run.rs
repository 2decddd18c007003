use super::experiment::{LevelController, LevelExperiment, LevelRunError, SetPointScale, SignalStep};
use super::kernel::{Kernel, Law, Moving, share_of};
use super::log::LevelLog;
use crate::control::{AntiWindup, Pi};
use crate::plant::level::{LevelGains, LevelPlant, LevelSignals};

/// Most integration steps of a run, some 10 ms in WebAssembly.
pub const MAX_LEVEL_STEPS: f64 = 2e5;

/// Longest step of integration as a share of the quickest lag of the plant.
const LAG_SHARE: f64 = 0.7;
/// Longest step as a share of the quickest motion of the closed loop.
const LOOP_SHARE: f64 = 0.2;
/// Longest step (s) as a share of the run.
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
        // A rounding error is no reason for one more step or row less.
        let per_row = (factor * log_step_s / longest * (1.0 - 1e-9)).max(1.0).ceil();
        let rows = (experiment.duration_s / log_step_s * (1.0 + 1e-12)).floor();
        let steps = rows * per_row;
        if steps.is_nan() || steps > MAX_LEVEL_STEPS {
            return Err(LevelRunError::TooMuchWork { steps, max: MAX_LEVEL_STEPS });
        }
        let held = experiment.duration_s / experiment.disturbance.numbers()[1].1;
        if held > MAX_LEVEL_STEPS {
            return Err(LevelRunError::TooMuchWork { steps: held, max: MAX_LEVEL_STEPS });
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
            }
        }
        running.log_row(log, self.rows);
        Ok(())
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
        if steps.is_nan() || steps > MAX_LEVEL_STEPS {
            return Err(LevelRunError::TooMuchWork { steps, max: MAX_LEVEL_STEPS });
        }
        Ok(whole(pieces))
    }
}

/// Who moves the output while a run goes on.
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
    moving: Moving,
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
            kernel.step(&self.law, self.reference, simulation.step_s, inflow, &mut self.moving);
        } else {
            let share = (self.pieces as f64).recip();
            for piece in 0..self.pieces {
                let inflow = share_of(inflow, piece as f64 * share, share);
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
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::control::{LoopMode, PiSettings};
    use crate::literature::andreis::{self, PublishedDisturbance};
    use crate::literature::level_slides;
    use crate::plant::level::Outflow;
    use crate::sim::level::{InflowDisturbance, InflowSignal, SampleStatistics};

    fn variances(log: &LevelLog) -> [f64; 2] {
        log.statistics(0..log.len()).unwrap().map(|of: SampleStatistics| of.variance)
    }

    /// The longest step gives the variances of steps twenty times shorter.
    #[test]
    fn the_step_of_integration_is_short_enough() {
        let plant = andreis::plant();
        for disturbance in PublishedDisturbance::ALL {
            let experiment = disturbance.experiment();
            let [coarse, fine] =
                [1.0, 20.0].map(|by| LevelSimulation::with_step_factor(&plant, &experiment, by).unwrap());
            assert_relative_eq!(coarse.step_s, 1.0 / 3.0);
            for (gain, integral_time) in [(10.0, 2500.0), (0.2, 588.0), (17.4, 23.5), (100.0, 588.0)] {
                let controller = LevelController::pi(gain, integral_time);
                let [found, exact] = [&coarse, &fine].map(|run| variances(&run.run(&controller).unwrap()));
                for k in 0..2 {
                    assert_relative_eq!(found[k], exact[k], max_relative = 3e-5);
                }
            }
        }
    }

    #[test]
    fn rest_stays_and_a_held_output_ends_at_its_level() {
        let quiet =
            LevelExperiment { disturbance: InflowDisturbance::NONE, ..PublishedDisturbance::SineL.experiment() };
        for plant in [andreis::plant(), andreis::uncertain_plant()] {
            let simulation = LevelSimulation::new(&plant, &quiet).unwrap();
            let log = simulation.run(&LevelController::pi(10.0, 2500.0)).unwrap();
            assert!(log.level.iter().all(|level| (level - 1.0).abs() < 1e-13));
            let long = LevelExperiment { duration_s: 5000.0, log_step_s: 10.0, ..quiet.clone() };
            let steps = vec![SignalStep { time_s: 100.0, size: 0.32 }];
            let log = LevelSimulation::new(&plant, &long).unwrap().run(&LevelController::Manual { steps }).unwrap();
            let expected = plant.level_at_output(simulation.rest().output + 0.32, 0.017).unwrap();
            assert_relative_eq!(*log.level.last().unwrap(), expected, max_relative = 1e-9);
            assert_eq!(log.level[10], 1.0);
        }
    }

    #[test]
    fn a_quick_sampled_controller_is_nearly_the_continuous_one() {
        let simulation = LevelSimulation::new(&andreis::plant(), &PublishedDisturbance::SineL.experiment()).unwrap();
        let settings = PiSettings {
            gain: 10.0,
            integral_time_s: 100.0,
            set_point_weight: 1.0,
            anti_windup: AntiWindup::Off,
            mode: LoopMode::Automatic,
        };
        let sampled = |sampling_time_s| {
            variances(&simulation.run(&LevelController::Sampled { settings, sampling_time_s }).unwrap())[0]
        };
        let continuous = variances(&simulation.run(&LevelController::pi(10.0, 100.0)).unwrap())[0];
        let [quick, slow] = [1.0 / 3.0, 2.0].map(|time| (sampled(time) / continuous - 1.0).abs());
        assert!(quick < 0.06 && slow > 4.0 * quick, "{quick} {slow}");
        // A sampling time below the step of integration counts as that step.
        assert_eq!(sampled(0.01), sampled(0.3));
    }

    #[test]
    fn back_calculation_ends_what_windup_does() {
        let experiment = LevelExperiment {
            set_point_steps: vec![SignalStep { time_s: 10.0, size: 0.4 }],
            disturbance: InflowDisturbance::NONE,
            duration_s: 600.0,
            ..PublishedDisturbance::SineL.experiment()
        };
        let simulation = LevelSimulation::new(&andreis::plant(), &experiment).unwrap();
        let highest = |anti_windup| {
            let log = simulation.run(&LevelController::Pi { gain: 5.0, integral_time_s: 30.0, anti_windup }).unwrap();
            log.level.iter().copied().fold(0.0, f64::max)
        };
        let (wound, free) = (highest(AntiWindup::Off), highest(AntiWindup::BackCalculation { tracking_ratio: 0.5 }));
        assert!(free < wound - 1e-3, "{free} {wound}");
    }

    #[test]
    fn a_pump_fills_its_tank_to_the_brim_and_empties_it() {
        let mut plant = andreis::plant();
        plant.tank.outflow = Outflow::Pumped { flow: 0.03 };
        let run = |size: f64| {
            let signal = InflowSignal::Step { size };
            let disturbance = InflowDisturbance { signal, from_s: 0.0, until_s: 1e9 };
            let experiment = LevelExperiment { disturbance, ..PublishedDisturbance::SineL.experiment() };
            LevelSimulation::new(&plant, &experiment).unwrap().run(&LevelController::off()).unwrap()
        };
        let (full, empty) = (run(0.01), run(-0.02));
        assert_relative_eq!(full.level[50], 1.5, max_relative = 1e-12);
        assert_eq!((full.level[200], empty.level[200]), (2.0, 0.0));
        assert!((full.full_s - 200.0).abs() < 0.5 && empty.empty_s > 200.0, "{} {}", full.full_s, empty.empty_s);
        // No more is fed than nothing.
        assert_eq!(empty.inflow[10], 0.0);
    }

    #[test]
    fn a_set_point_in_signals_is_not_one_in_metres() {
        let plant = level_slides::plant();
        let mut experiment = LevelExperiment {
            level: 0.0,
            inflow: 0.0,
            duration_s: 3600.0,
            log_step_s: 6.0,
            disturbance: InflowDisturbance::NONE,
            set_point_steps: vec![SignalStep { time_s: 0.0, size: 0.5 }],
            set_point_scale: SetPointScale::Level,
        };
        let end = |experiment: &LevelExperiment| {
            let log = LevelSimulation::new(&plant, experiment).unwrap().run(&LevelController::pi(2.0, 120.0)).unwrap();
            *log.level.last().unwrap()
        };
        assert_relative_eq!(end(&experiment), 0.5, max_relative = 1e-3);
        experiment.set_point_scale = SetPointScale::Signal;
        assert_relative_eq!(end(&experiment), 0.1, max_relative = 1e-3);
    }

    #[test]
    fn what_makes_no_run_is_refused_with_its_value() {
        let plant = andreis::plant();
        let good = PublishedDisturbance::Random.experiment();
        let refused = |change: &dyn Fn(&mut LevelExperiment)| {
            let mut experiment = good.clone();
            change(&mut experiment);
            LevelSimulation::new(&plant, &experiment).map(|_| ()).unwrap_err()
        };
        assert!(matches!(refused(&|e| e.duration_s = 0.5), LevelRunError::EmptyLog { .. }));
        assert!(matches!(refused(&|e| e.duration_s = 0.0), LevelRunError::OutOfRange { field: "duration_s", .. }));
        assert!(matches!(refused(&|e| e.duration_s = 1e9), LevelRunError::TooMuchWork { .. }));
        assert!(matches!(refused(&|e| e.log_step_s = f64::NAN), LevelRunError::OutOfRange { field: "log_step_s", .. }));
        assert!(matches!(refused(&|e| e.inflow = -1.0), LevelRunError::Plant(_)));
        assert!(matches!(refused(&|e| e.level = 3.0), LevelRunError::Plant(_)));
        let held = |sample_time_s| InflowSignal::Normal { std: 1e-3, sample_time_s, seed: 1 };
        assert!(matches!(
            refused(&|e| e.disturbance.signal = held(0.0)),
            LevelRunError::OutOfRange { field: "sample_time_s", .. }
        ));
        assert!(matches!(refused(&|e| e.disturbance.signal = held(1e-9)), LevelRunError::TooMuchWork { .. }));
        let simulation = LevelSimulation::new(&plant, &good).unwrap();
        for (gain, integral_time) in [(10.0, 0.0), (10.0, -1.0), (f64::NAN, 10.0), (f64::INFINITY, 10.0)] {
            assert!(matches!(
                simulation.run(&LevelController::pi(gain, integral_time)),
                Err(LevelRunError::OutOfRange { .. })
            ));
        }
        assert!(matches!(simulation.run(&LevelController::pi(1e30, 10.0)), Err(LevelRunError::TooMuchWork { .. })));
        // A gain of 0 is a controller that is off.
        let idle = simulation.run(&LevelController::pi(0.0, 10.0)).unwrap();
        assert_eq!(idle, simulation.run(&LevelController::off()).unwrap());
    }
}
