//! Runs of level loops: rest, sampled controllers, windup, walls, and what makes no run.

use approx::assert_relative_eq;
use quadtank::control::{AntiWindup, LoopMode, PiSettings};
use quadtank::literature::andreis::{self, PublishedDisturbance};
use quadtank::literature::level_slides;
use quadtank::plant::level::Outflow;
use quadtank::sim::level::{
    InflowDisturbance, InflowSignal, LevelController, LevelExperiment, LevelLog, LevelRunError, LevelSimulation,
    SampleStatistics, SetPointScale, SignalStep,
};

fn variances(log: &LevelLog) -> [f64; 2] {
    log.statistics(0..log.len()).unwrap().map(|of: SampleStatistics| of.variance)
}

#[test]
fn rest_stays_and_a_held_output_ends_at_its_level() {
    let quiet = LevelExperiment { disturbance: InflowDisturbance::NONE, ..PublishedDisturbance::SineL.experiment() };
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
    // An output without limits that takes the actuator beyond all numbers.
    let mut wild = plant.clone();
    (wild.output.clips, wild.actuator.lag_s) = (false, 0.01);
    let steps = vec![SignalStep { time_s: 5.0, size: 1e308 }];
    let run = LevelSimulation::new(&wild, &good).unwrap().run(&LevelController::Manual { steps });
    assert_eq!(run, Err(LevelRunError::NotFinite { time_s: 6.0 }));
    // A gain of 0 is a controller that is off.
    let idle = simulation.run(&LevelController::pi(0.0, 10.0)).unwrap();
    assert_eq!(idle, simulation.run(&LevelController::off()).unwrap());
}
