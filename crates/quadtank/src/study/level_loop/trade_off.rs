use crate::sim::level::{LevelController, LevelLog, LevelSimulation};

use super::{LevelLoopSetup, PiTuning};

/// A tuning with the variances that it gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TradeOffPoint {
    /// The tuning.
    pub tuning: PiTuning,
    /// Variance of the level (m²).
    pub level: f64,
    /// Variance of the outflow ((m³/s)²).
    pub outflow: f64,
}

/// Variance of the level against that of the outflow: tight control is at one end, averaging control at the other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TradeOff {
    /// Gains of the box, evenly in the logarithm, with the integral time of the controller, or the largest of the box.
    pub curve: Vec<TradeOffPoint>,
    /// The tunings asked for, in their order; `None` for one without a run.
    pub points: Vec<Option<TradeOffPoint>>,
}

/// Points of the curve.
const POINTS: usize = 17;

/// The trade-off on the plant of a setup, with some tunings of which the variances are wanted. Empty where the loop has no run.
pub fn trade_off(setup: &LevelLoopSetup, tunings: &[PiTuning]) -> TradeOff {
    let [gains, times] = setup.search.axes();
    let Ok(simulation) = LevelSimulation::new(&setup.plant(), &setup.experiment) else { return TradeOff::default() };
    let integral_time_s = setup.integral_time_s().unwrap_or(times.high);
    let mut log = LevelLog::default();
    let mut point = |tuning: PiTuning| {
        let controller = LevelController::Pi {
            gain: tuning.gain,
            integral_time_s: tuning.integral_time_s,
            anti_windup: setup.anti_windup(),
        };
        simulation.run_into(&controller, &mut log).ok()?;
        let [level, outflow] = log.statistics(0..log.len())?;
        Some(TradeOffPoint { tuning, level: level.variance, outflow: outflow.variance })
    };
    let share = |k: usize| k as f64 / (POINTS - 1) as f64;
    TradeOff {
        curve: (0..POINTS).filter_map(|k| point(PiTuning { gain: gains.at(share(k)), integral_time_s })).collect(),
        points: tunings.iter().map(|&tuning| point(tuning)).collect(),
    }
}
