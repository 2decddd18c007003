//! Junqueira, Neves and Angelico: the numbers that a second program found for the published cases.
#![cfg(not(target_arch = "wasm32"))]

use quadtank::control::{ModelFree, Pairing};
use quadtank::plant::{OperatingPoint, PresetId, QuadrupleTank, ValveSchedule};
use quadtank::sim::{
    Experiment, Measurement, ModelFreeRun, SetPointStep, TrackingFigures, simulate_model_free, tracking_figures,
};

const CM: f64 = 0.01;

fn case(name: char) -> [ValveSchedule; 2] {
    let sine = |frequency| ValveSchedule::Sine { mean: 0.5, amplitude: 0.1, frequency, phase: 0.0 };
    match name {
        'a' => [ValveSchedule::Constant { gamma: 0.6 }; 2],
        'b' => [ValveSchedule::Constant { gamma: 0.4 }; 2],
        _ => [sine(0.2), sine(0.5)],
    }
}

fn plant() -> QuadrupleTank {
    PresetId::JunqueiraA.preset().plant
}

fn experiment(duration_s: f64, steps: &[(usize, f64, f64)]) -> Experiment {
    Experiment {
        duration_s,
        set_point_steps: steps
            .iter()
            .map(|&(level, time_s, cm)| SetPointStep { level, time_s, size: cm * CM })
            .collect(),
        load_steps: Vec::new(),
        measurement: Measurement { noise_std: 0.0, seed: 1, quantised: false },
    }
}

const EMPTY: OperatingPoint = OperatingPoint { levels: [0.0; 4], pump_voltage: [0.0; 2] };

fn s1(valves: &[ValveSchedule; 2], law: &ModelFree) -> (ModelFreeRun, [TrackingFigures; 2]) {
    let experiment = experiment(300.0, &[(0, 0.0, 10.0), (1, 0.0, 10.0)]);
    let run = simulate_model_free(&plant(), valves, &EMPTY, law, &experiment).unwrap();
    let figures = tracking_figures(&run.trajectory, run.rows_per_sample, &plant(), Pairing::Diagonal);
    (run, figures)
}

#[test]
fn probe() {
    for name in ['a', 'b', 'c'] {
        for estimator in [true, false] {
            let mut law = ModelFree::PUBLISHED;
            if !estimator { law.estimator = None; }
            let (_, f) = s1(&case(name), &law);
            for f in f {
                println!("{name} {estimator} IAE {:.2} ISE {:.2} OS {:.2} settle {:?} TV {:.2} sat {:.2}% lost {:?}", f.iae*100.0, f.ise*1e4, f.overshoot.unwrap()*100.0, f.settling_s, f.total_variation, f.saturated_s/3.0, f.lost_at_s);
            }
        }
    }
    for name in ['a', 'b'] {
        let op = plant().with_valves(case(name).map(|v| v.at(0.0))).inputs_for_levels([0.1, 0.1]).unwrap();
        let run = simulate_model_free(&plant(), &case(name), &op, &ModelFree::PUBLISHED, &experiment(320.0, &[(0, 20.0, 5.0), (1, 20.0, 5.0)])).unwrap();
        for t in [20.0, 30.0, 40.0, 50.0, 100.0, 320.0] {
            let row = run.trajectory.row_at(t).unwrap();
            println!("{t} {:.4?} {:.4?}", run.trajectory.levels.each_ref().map(|c| c[row]*100.0), run.trajectory.pump_voltage.each_ref().map(|c| c[row]));
        }
        println!("{:?}", tracking_figures(&run.trajectory, run.rows_per_sample, &plant(), Pairing::Diagonal));
        let run = simulate_model_free(&plant(), &case(name), &op, &ModelFree::PUBLISHED, &experiment(2000.0, &[(0, 20.0, 1.0)])).unwrap();
        println!("S3 1cm {:?}", tracking_figures(&run.trajectory, run.rows_per_sample, &plant(), Pairing::Diagonal).map(|f| f.lost_at_s));
        let run = simulate_model_free(&plant(), &case(name), &op, &ModelFree::PUBLISHED, &experiment(2000.0, &[(0, 20.0, 2.0)])).unwrap();
        println!("S3 2cm {:?} {:?}", tracking_figures(&run.trajectory, run.rows_per_sample, &plant(), Pairing::Diagonal).map(|f| f.lost_at_s), run.trajectory.events);
        for row in (0..2001).step_by(20).take(16) { println!("   {} {:.3?} {:.2?}", run.trajectory.time_s[row], run.trajectory.levels.each_ref().map(|c| c[row]*100.0), run.trajectory.pump_voltage.each_ref().map(|c| c[row])); }
        let run = simulate_model_free(&plant(), &case(name), &op, &ModelFree::PUBLISHED, &experiment(2000.0, &[(0, 20.0, 5.0), (1, 20.0, 5.0)])).unwrap();
        println!("S2 long {:?} {:?}", tracking_figures(&run.trajectory, run.rows_per_sample, &plant(), Pairing::Diagonal).map(|f| f.lost_at_s), run.trajectory.events);
    }
}
