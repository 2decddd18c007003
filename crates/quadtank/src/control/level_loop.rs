//! The linear loop of a level controller.

use crate::linear::{LinearError, SingleLoop, TransferFunction};
use crate::plant::level::LevelGains;

use super::ParallelPid;

/// The transfer function from controller output to transmitter signal, `K/((τ s + 1)(τ_a s + 1)(τ_t s + 1))`, or `K'/s` in the place
/// of the tank where it integrates.
///
/// # Errors
/// [`LinearError::OutOfRange`] for gains that are not finite, as around an empty tank.
pub fn level_transfer_function(gains: &LevelGains) -> Result<TransferFunction, LinearError> {
    let tank = match (gains.process_gain(), gains.time_constant()) {
        (Some(gain), Some(time_constant)) => TransferFunction::lags(gain, &[time_constant], 0.0)?,
        _ => TransferFunction::new(vec![gains.slope_gain()], vec![0.0, 1.0], 0.0)?,
    };
    let lags: Vec<f64> = [gains.actuator_lag_s, gains.transmitter_lag_s].into_iter().filter(|&lag| lag > 0.0).collect();
    Ok(tank.times(&TransferFunction::lags(1.0, &lags, 0.0)?))
}

/// The loop of a level with a continuous PID controller whose derivative has a filter (time constant in s). A controller that is
/// sampled is one with half of its sampling time as dead time (s).
///
/// # Errors
/// As [`level_transfer_function`].
pub fn level_loop(
    gains: &LevelGains,
    pid: &ParallelPid,
    filter_time_s: f64,
    dead_time_s: f64,
) -> Result<SingleLoop, LinearError> {
    let plant = level_transfer_function(gains)?.times(&TransferFunction::lags(1.0, &[], dead_time_s)?);
    let controller = ParallelPid { filter: Some(filter_time_s), ..*pid }.transfer_function()?;
    let integrators = u32::from(pid.integral != 0.0) + u32::from(gains.resistance.is_none());
    Ok(SingleLoop::new(plant, controller, integrators))
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::linear::{Complex, LoopStability};
    use crate::literature::andreis;
    use crate::plant::level::Outflow;

    #[test]
    fn the_loop_is_stable_up_to_its_gain_margin() {
        for outflow in [andreis::plant().tank.outflow, Outflow::Pumped { flow: 0.03 }] {
            let mut plant = andreis::plant();
            plant.tank.outflow = outflow;
            let gains = plant.gains(&plant.rest(1.0, 0.017).unwrap());
            let of = |gain: f64| {
                let pid = ParallelPid { proportional: gain, integral: gain / 500.0, ..ParallelPid::default() };
                level_loop(&gains, &pid, 0.0, 0.0).unwrap()
            };
            let margin = of(10.0).margins().unwrap().gain_up.unwrap();
            assert_eq!(of(9.9 * margin).stability(), LoopStability::Stable);
            assert!(matches!(of(10.1 * margin).stability(), LoopStability::Unstable { poles: 2 }));
        }
    }

    #[test]
    fn the_model_is_that_of_all_its_elements() {
        let plant = andreis::plant();
        let gains = plant.gains(&plant.rest(1.0, 0.017).unwrap());
        let s = Complex::new(0.0, 0.1);
        let one = |lag: f64| (s * lag + 1.0).inv();
        let expected = one(gains.time_constant().unwrap()) * one(5.0) * one(0.5) * gains.process_gain().unwrap();
        let found = level_transfer_function(&gains).unwrap().at(s);
        assert_relative_eq!((found - expected).norm(), 0.0, epsilon = 1e-14);
    }
}
