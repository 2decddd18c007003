use approx::assert_relative_eq;

use super::*;
use crate::literature::andreis::{self, PublishedDisturbance};
use crate::sim::level::{InflowDisturbance, InflowSignal};

/// The longest step gives the variances of steps twenty times shorter.
#[test]
fn the_step_of_integration_is_short_enough() {
    let plant = andreis::plant();
    for disturbance in PublishedDisturbance::ALL {
        let experiment = disturbance.experiment();
        let [coarse, fine] = [1.0, 20.0].map(|by| LevelSimulation::with_step_factor(&plant, &experiment, by).unwrap());
        assert_relative_eq!(coarse.step_s, 1.0 / 3.0);
        for (gain, integral_time) in [(10.0, 2500.0), (0.2, 588.0), (17.4, 23.5), (100.0, 588.0)] {
            let controller = LevelController::pi(gain, integral_time);
            let [found, exact] = [&coarse, &fine].map(|run| {
                let log = run.run(&controller).unwrap();
                log.statistics(0..log.len()).unwrap().map(|of| of.variance)
            });
            for k in 0..2 {
                assert_relative_eq!(found[k], exact[k], max_relative = 3e-5);
            }
        }
    }
}
fn disturbed(signal: InflowSignal) -> Result<LevelSimulation, LevelRunError> {
    let experiment = LevelExperiment {
        disturbance: InflowDisturbance { signal, from_s: 0.0, until_s: 300.0 },
        ..PublishedDisturbance::SineL.experiment()
    };
    LevelSimulation::new(&andreis::plant(), &experiment)
}

#[test]
fn a_quick_disturbance_is_followed() {
    // With steps of 1/3 s this sine would be sampled where it is zero.
    let sine = disturbed(InflowSignal::Sine { amplitude: 1e-3, period_s: 1.0 / 3.0 }).unwrap();
    assert!(sine.step_s <= 1.0 / 48.0 * (1.0 + 1e-8), "{}", sine.step_s);
    let highest = sine.inflows.as_flattened().iter().copied().fold(0.0, f64::max);
    assert!(highest > 0.99e-3 + PublishedDisturbance::SineL.experiment().inflow, "{highest}");
    let held = disturbed(InflowSignal::Normal { std: 1e-3, sample_time_s: 0.1, seed: 1 }).unwrap();
    assert_relative_eq!(held.step_s, 0.1, max_relative = 1e-12);
    let values: Vec<f64> = held.inflows[..10].iter().map(|inflow| inflow[0]).collect();
    assert!(values.windows(2).all(|pair| pair[0] != pair[1]), "{values:?}");
    // What does not act is not followed.
    let silent = disturbed(InflowSignal::Sine { amplitude: 0.0, period_s: 1e-3 }).unwrap();
    assert_relative_eq!(silent.step_s, 1.0 / 3.0);
}

#[test]
fn a_disturbance_that_is_too_quick_is_named() {
    let field = |signal| match disturbed(signal) {
        Err(LevelRunError::TooMuchWork { field, .. }) => Some(field),
        _ => None,
    };
    assert_eq!(field(InflowSignal::Sine { amplitude: 1e-3, period_s: 1e-3 }), Some("period_s"));
    let held = InflowSignal::SimulinkNormal { std: 1e-3, sample_time_s: 1e-3, seed: 0 };
    assert_eq!(field(held), Some("sample_time_s"));
}
