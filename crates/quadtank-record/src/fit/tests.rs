use quadtank::literature::PresetId;
use quadtank::sim::binary_moves;
use quadtank::study::quadruple_tank::{PlantSpec, Setup, run, setup_of};

use super::*;

/// A record of a rig whose parameters are known, moved by pseudo-random steps, and what is believed of the rig.
fn recorded(change: impl Fn(&mut quadtank::plant::QuadrupleTank), noise_std: f64) -> (Record, Setup) {
    let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
    setup.experiment.duration_s = 1500.0;
    setup.experiment.set_point_steps.clear();
    setup.experiment.pump_voltage_steps = binary_moves([2.5, 2.5], [3.5, 3.5], 40.0, 1500.0);
    let mut truth = setup.clone();
    let mut rig = truth.plant();
    change(&mut rig);
    truth.valves = rig.valves;
    truth.plant = PlantSpec::Parameters { rig, display_unit: setup.plant.display_unit() };
    let run = run(&truth).unwrap().nonlinear;
    // Noise by a fixed sequence of signs, which is white enough.
    let signs: Vec<bool> = quadtank::sim::BinarySequence::from_bit(11).take(127).collect();
    let noisy = |tank: usize| -> Vec<f64> {
        let noise = |row: usize| if signs[(7 * row + 31 * tank) % 127] { noise_std } else { -noise_std };
        run.levels[tank].iter().enumerate().map(|(row, level)| level + noise(row)).collect()
    };
    let record = Record {
        levels: [noisy(0), noisy(1), vec![], vec![]],
        pump_voltage: run.pump_voltage.clone(),
        time_s: run.time_s.clone(),
        ..Record::default()
    };
    (record, setup)
}

fn fitted(record: &Record, setup: &Setup, names: &[&str]) -> FitReport {
    let parameters: Vec<Parameter> = names.iter().map(|name| Parameter::of_name(name).unwrap()).collect();
    let mut fit = Fit::new(setup, record, &parameters).unwrap();
    while !fit.is_over() {
        fit.advance();
    }
    fit.report()
}

#[test]
fn valves_and_pump_gains_are_found_within_two_percent() {
    let (record, setup) = recorded(
        |rig| {
            rig.valves = [0.55, 0.68];
            rig.pumps[0].gain *= 1.2;
            rig.pumps[1].gain *= 0.85;
        },
        5e-4,
    );
    let report = fitted(&record, &setup, &["gamma1", "gamma2", "k1", "k2"]);
    assert!(report.converged && report.alike.is_empty() && report.vague.is_empty(), "{report:?}");
    let rig = setup.plant();
    let truth = [0.55, 0.68, 1.2 * rig.pumps[0].gain, 0.85 * rig.pumps[1].gain];
    for (estimate, truth) in report.estimates.iter().zip(truth) {
        assert!((estimate.value / truth - 1.0).abs() < 0.02, "{estimate:?} {truth}");
        let error = estimate.standard_error.unwrap();
        assert!((estimate.value - truth).abs() < 5.0 * error + 1e-4 * truth, "{estimate:?} {truth}");
        assert!(!estimate.is_at_bound);
    }
    assert!(report.rmse[0] > 0.005 && report.rmse[1] < 6e-4, "{:?}", report.rmse);
}

#[test]
fn a_fitted_rig_does_the_experiment_of_the_record_as_the_rig_did() {
    let (record, mut setup) = recorded(|rig| rig.valves = [0.55, 0.68], 0.0);
    setup = replay(&record, &setup).unwrap();
    let mut fit = Fit::new(&setup, &record, &[Parameter::Valve(0), Parameter::Valve(1)]).unwrap();
    while !fit.is_over() {
        fit.advance();
    }
    let found = fit.setup(&setup);
    let agrees = crate::agreement(&record, &run(&found).unwrap().nonlinear);
    assert!(agrees.levels[0].unwrap().fit_percent.unwrap() > 99.5, "{agrees:?}");
    // A setup with another experiment than that of the record keeps its own.
    let other = setup_of(PresetId::JohanssonMinimumPhase);
    assert_eq!(fit.setup(&other).experiment, other.experiment);
}

#[test]
fn outlets_and_offsets_are_found_too() {
    let (mut record, setup) = recorded(|rig| rig.tanks[0].outlet.area *= 1.1, 0.0);
    record.levels[1].iter_mut().for_each(|level| *level += 0.004);
    let report = fitted(&record, &setup, &["a1", "offset2"]);
    let area = 1.1 * setup.plant().tanks[0].outlet.area;
    assert!((report.estimates[0].value / area - 1.0).abs() < 1e-3, "{report:?}");
    assert!((report.estimates[1].value - 0.004).abs() < 1e-4, "{report:?}");
}

#[test]
fn what_a_record_cannot_tell_is_said() {
    // At rest the flow into tank 1 is γ1 k1 v1 alone: neither factor can be told from the other where nothing moves.
    let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
    let rest = setup.operating_point().unwrap();
    setup.experiment.set_point_steps.clear();
    let rows = 100;
    let record = Record {
        time_s: (0..rows).map(f64::from).collect(),
        levels: [vec![rest.levels[0]; 100], vec![], vec![], vec![]],
        pump_voltage: rest.pump_voltage.map(|voltage| vec![voltage; 100]),
        ..Record::default()
    };
    let report = fitted(&record, &setup, &["gamma1", "k1"]);
    assert!(report.correlation.is_none() || report.alike == [[0, 1]], "{report:?}");
}

#[test]
fn without_levels_or_parameters_there_is_nothing_to_fit() {
    let (record, setup) = recorded(|_| (), 0.0);
    assert_eq!(Fit::new(&setup, &record, &[]).unwrap_err(), RecordError::NothingToFit);
    let bare = Record { levels: Default::default(), ..record.clone() };
    assert_eq!(Fit::new(&setup, &bare, &[Parameter::Valve(0)]).unwrap_err(), RecordError::NothingToFit);
    let short =
        Record { time_s: vec![0.0, 20.0], levels: [vec![0.1, 0.1], vec![], vec![], vec![]], ..Record::default() };
    let error = Fit::new(&setup, &short, &[Parameter::Valve(0), Parameter::Valve(1)]).unwrap_err();
    assert_eq!(error, RecordError::TooFewValues { values: 2, parameters: 2 });
}

/// A number from −1 to 1 for each place, by a sequence that is fixed.
fn drawn(place: u32) -> f64 {
    2.0 * (f64::from(place) * 0.618_033_988_749_895).fract() - 1.0
}

#[test]
fn dead_times_and_first_levels_are_found_with_their_errors() {
    for trial in 0..2 {
        let draw = |k: u32| drawn(10 * trial + k + 1);
        let delays = [12.0 + 8.0 * draw(0), 9.0 + 7.0 * draw(1)];
        let starts = [0.03 + 0.02 * draw(2), 0.035 + 0.02 * draw(3)];
        let valve = 0.65 + 0.1 * draw(4);
        let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
        setup.experiment.duration_s = 800.0;
        setup.experiment.set_point_steps.clear();
        setup.experiment.pump_voltage_steps = binary_moves([2.5, 2.5], [3.5, 3.5], 40.0, 800.0);
        let mut truth = setup.clone();
        let mut rig = truth.plant();
        for (pump, delay) in rig.pumps.iter_mut().zip(delays) {
            pump.delay_s = delay;
        }
        truth.valves[0] = valve;
        truth.plant = PlantSpec::Parameters { rig, display_unit: setup.plant.display_unit() };
        truth.experiment.initial_levels = Some([0.11, 0.14, starts[0], starts[1]]);
        let run = run(&truth).unwrap().nonlinear;
        let signs: Vec<bool> = quadtank::sim::BinarySequence::from_bit(11).take(127).collect();
        let noisy = |tank: usize| -> Vec<f64> {
            let sign = |row: usize| if signs[(7 * row + 31 * tank) % 127] { 1.0 } else { -1.0 };
            run.levels[tank].iter().enumerate().map(|(row, level)| level + 2e-4 * sign(row)).collect()
        };
        let record = Record {
            levels: [noisy(0), noisy(1), vec![], vec![]],
            pump_voltage: run.pump_voltage.clone(),
            time_s: run.time_s.clone(),
            ..Record::default()
        };
        let names = ["gamma1", "delay1", "delay2", "start3", "start4"];
        let report = fitted(&record, &setup, &names);
        assert!(report.converged && report.vague.is_empty() && report.alike.is_empty(), "{report:?}");
        let truths = [valve, delays[0], delays[1], starts[0], starts[1]];
        for (estimate, truth) in report.estimates.iter().zip(truths) {
            let error = estimate.standard_error.unwrap();
            // The first recorded levels are noisy, and the run begins at them: what that moves is not in the standard errors.
            let slack = if matches!(estimate.parameter, Parameter::PumpDelay(_)) { 0.3 } else { 1.5e-3 };
            assert!((estimate.value - truth).abs() < 4.0 * error + slack, "{truth}: {report:?}");
        }
        assert!(report.rmse[1] < 3e-4 && report.rmse[0] > 10.0 * report.rmse[1], "{:?}", report.rmse);
    }
}

#[test]
fn first_levels_that_were_found_are_those_of_the_experiment() {
    let (record, setup) = recorded(|_| (), 0.0);
    let setup = replay(&record, &setup).unwrap();
    let mut fit = Fit::new(&setup, &record, &[Parameter::StartLevel(2)]).unwrap();
    fit.advance();
    let found = fit.setup(&setup).experiment.initial_levels.unwrap();
    assert_eq!(found[2], fit.report().estimates[0].value);
    assert_eq!(found[3], setup.operating_point().unwrap().levels[3]);
}

#[test]
fn a_search_stays_within_given_bounds_and_begins_where_it_is_told() {
    let (record, setup) = recorded(|rig| rig.valves[0] = 0.55, 0.0);
    let sought = |start: f64, bounds: [f64; 2]| Sought { parameter: Parameter::Valve(0), start, bounds };
    let run = |sought: Sought| {
        let mut fit = Fit::within(&setup, &record, &[sought]).unwrap();
        while !fit.is_over() {
            fit.advance();
        }
        fit.report().estimates[0].clone()
    };
    assert!((run(sought(0.9, [0.3, 0.95])).value - 0.55).abs() < 1e-4);
    let at_bound = run(sought(0.7, [0.6, 0.9]));
    assert!(at_bound.is_at_bound && at_bound.value >= 0.6, "{at_bound:?}");
    for bounds in [[0.9, 0.3], [0.5, 0.5], [-0.1, 0.9], [0.1, 1.1], [f64::NAN, 0.9]] {
        let error = Fit::within(&setup, &record, &[sought(0.5, bounds)]).unwrap_err();
        assert!(
            matches!(error, RecordError::WrongBounds { parameter: Parameter::Valve(0), .. }),
            "{bounds:?}: {error}"
        );
    }
}
