use crate::plant::level::LevelError;
use crate::sim::level::{
    InflowDisturbance, LevelController, LevelExperiment, LevelRunError, LevelSimulation, SetPointScale, SignalStep,
};
use crate::tuning::{Regulation, RegulationError, SetPointStretch, proportional_regulation};

use super::LevelLoopSetup;

/// Steps of the set-point, each from the one before it, in shares of the range of the transmitter: up twice, then down twice.
const STAIRCASE: [f64; 4] = [0.03, 0.03, -0.03, -0.03];
/// Length of a stretch in time constants of the closed loop.
const TIME_CONSTANTS: f64 = 12.0;
/// Rows of a stretch.
const ROWS: f64 = 60.0;
/// Integral time (s) that stands for no integral action, over the length of the test.
const NO_INTEGRAL: f64 = 1e9;

/// A staircase of set-points under proportional control, and what it says of the tank (Rice and Cooper 2015; Andreis 2017, §2.1).
///
/// # Errors
/// [`LevelRunError`] for a loop without a run.
pub fn run_proportional_test(
    setup: &LevelLoopSetup,
    gain: f64,
) -> Result<Result<Regulation, RegulationError>, LevelRunError> {
    let plant = setup.plant();
    let rest = plant.rest(setup.experiment.level, setup.experiment.inflow)?;
    let gains = plant.gains(&rest);
    // The closed loop of a first-order process or an integrator, and the lags of the instruments.
    let slope = gains.slope_gain() * gain;
    let rate = slope.abs() + gains.time_constant().map_or(0.0, f64::recip);
    let lags = gains.actuator_lag_s + gains.transmitter_lag_s;
    let stretch_s = TIME_CONSTANTS * (rate.recip() + lags);
    if !(stretch_s > 0.0 && stretch_s.is_finite()) {
        return Err(LevelRunError::OutOfRange { field: "gain", value: gain });
    }
    let [low, high] = plant.transmitter.level_range;
    let sizes = STAIRCASE.map(|share| share * (high - low));
    let steps = sizes.iter().zip(1_u8..).map(|(&size, k)| SignalStep { time_s: f64::from(k) * stretch_s, size });
    let experiment = LevelExperiment {
        duration_s: (STAIRCASE.len() as f64 + 1.0) * stretch_s,
        log_step_s: stretch_s / ROWS,
        disturbance: InflowDisturbance::NONE,
        set_point_steps: steps.collect(),
        set_point_scale: SetPointScale::Level,
        ..setup.experiment.clone()
    };
    let highest = setup.experiment.level + sizes[0] + sizes[1];
    if highest > plant.tank.height {
        return Err(LevelError::LevelOutsideTank { value: highest, height: plant.tank.height }.into());
    }
    let controller = LevelController::pi(gain, NO_INTEGRAL * experiment.duration_s);
    let log = LevelSimulation::new(&plant, &experiment)?.run(&controller)?;
    let stretches: Vec<SetPointStretch> = (0..=STAIRCASE.len())
        .map(|k| {
            let begin = k as f64 * stretch_s;
            // Without the row of the next step, which has its set-point already.
            let rows = log.rows(begin + 0.5 * experiment.log_step_s, begin + stretch_s - 0.5 * experiment.log_step_s);
            SetPointStretch { set_point: log.reference[rows.start], signal: &log.transmitted[rows] }
        })
        .collect();
    Ok(proportional_regulation(&stretches))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::level::OutflowLaw;
    use crate::tuning::RegulationReason;

    #[test]
    fn the_offset_of_proportional_control_tells_a_valve_from_a_pump() {
        let mut setup = LevelLoopSetup::default();
        for gain in [2.0, 10.0] {
            setup.set_outflow_law(OutflowLaw::SquareRoot);
            let found = run_proportional_test(&setup, gain).unwrap().unwrap();
            let Regulation::SelfRegulating(RegulationReason::OffsetFollows { share }) = found else {
                panic!("{found:?}")
            };
            // 1/(1 + K Kp) with the gain K = 2.72 around the rest.
            assert!((share - 1.0 / (1.0 + 2.72 * gain)).abs() < 0.02, "{share}");
            setup.set_outflow_law(OutflowLaw::Pumped);
            let found = run_proportional_test(&setup, gain).unwrap().unwrap();
            assert!(matches!(found, Regulation::Integrating(RegulationReason::NoOffset { .. })), "{found:?}");
        }
    }

    #[test]
    fn a_staircase_above_the_brim_is_refused() {
        let mut setup = LevelLoopSetup::default();
        setup.experiment.level = 1.95;
        assert!(matches!(
            run_proportional_test(&setup, 10.0),
            Err(LevelRunError::Plant(LevelError::LevelOutsideTank { .. }))
        ));
        assert!(run_proportional_test(&setup, f64::NAN).is_err());
    }
}
