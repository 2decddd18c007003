//! Properties of level loops over random tanks and instruments.

use proptest::prelude::*;
use quadtank::assess::LoopQuality;
use quadtank::control::{IntegralDial, PiDials, PiForm, ProportionalDial};
use quadtank::linear::LoopStability;
use quadtank::plant::level::{
    Actuator, ActuatorCurve, Characteristic, ControlValve, Converter, LevelPlant, LevelTank, Outflow, OutputStage,
    SignalRange, Transmitter, ValvePlace,
};
use quadtank::sim::level::{
    InflowDisturbance, InflowSignal, LevelController, LevelExperiment, LevelSimulation, SetPointScale, SignalStep,
};
use quadtank::tuning::search::{Axis, AxisScale, Genetic, GeneticSettings, Gradient, NelderMead, Search, advance};

fn characteristic() -> impl Strategy<Value = Characteristic> {
    prop_oneof![
        Just(Characteristic::Linear),
        (5.0..60.0_f64).prop_map(|rangeability| Characteristic::EqualPercentage { rangeability }),
        Just(Characteristic::QuickOpening),
    ]
}

fn lag(longest: f64) -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), 0.3..longest]
}

/// A plant of 1 m at rest at 0.5 m with about half of the flow of its valve, whose outflow law is one of three.
fn plant() -> impl Strategy<Value = (LevelPlant, f64)> {
    let tank = (0.3..3.0_f64, 0..3_usize, 1e-3..2e-2_f64);
    let instruments = (characteristic(), lag(2.0), lag(8.0), any::<bool>(), any::<bool>());
    (tank, instruments, 0.35..0.75_f64).prop_map(
        |((area, law, flow), (characteristic, sensor, valve, closes, outlet), opening)| {
            // The law carries `flow` at half a metre with an open valve.
            let outflow = match law {
                0 => Outflow::Linear { resistance: 0.5 / flow },
                1 => Outflow::SquareRoot { coefficient: flow / 0.5_f64.sqrt() },
                _ => Outflow::Pumped { flow },
            };
            let ends = if closes { [1.0, 0.0] } else { [0.0, 1.0] };
            let plant = LevelPlant {
                tank: LevelTank { area, height: 1.0, outflow },
                transmitter: Transmitter {
                    level_range: [0.0, 1.0],
                    signal: SignalRange::CURRENT,
                    lag_s: sensor,
                    clips: true,
                },
                output: OutputStage { signal: SignalRange::CURRENT, clips: true },
                converter: Some(Converter { input: SignalRange::CURRENT, output: SignalRange::PNEUMATIC }),
                actuator: Actuator { lag_s: valve, curve: ActuatorCurve(vec![[3.0, ends[0]], [15.0, ends[1]]]) },
                valve: ControlValve {
                    characteristic,
                    place: if outlet { ValvePlace::Outlet } else { ValvePlace::Inlet { full_flow: flow } },
                },
            };
            let inflow = if outlet { opening * flow } else { (1.0 - opening) * flow };
            (plant, inflow)
        },
    )
}

fn experiment(inflow: f64, duration_s: f64) -> LevelExperiment {
    LevelExperiment {
        level: 0.5,
        inflow,
        duration_s,
        log_step_s: duration_s / 300.0,
        disturbance: InflowDisturbance::NONE,
        set_point_steps: Vec::new(),
        set_point_scale: SetPointScale::Level,
    }
}

/// The sign that a gain needs: positive where more output raises the level.
fn sign(plant: &LevelPlant, inflow: f64) -> f64 {
    plant.gains(&plant.rest(0.5, inflow).unwrap()).slope_gain().signum()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn rest_is_rest_under_every_controller((plant, inflow) in plant(), gain in 0.1..20.0_f64, time in 5.0..500.0_f64) {
        let simulation = LevelSimulation::new(&plant, &experiment(inflow, 300.0)).unwrap();
        let gain = gain * sign(&plant, inflow);
        for controller in [LevelController::off(), LevelController::pi(gain, time)] {
            let log = simulation.run(&controller).unwrap();
            let away = log.level.iter().map(|level| (level - 0.5).abs()).fold(0.0, f64::max);
            // Rounding of the balance, which an integrating tank adds up.
            prop_assert!(away < 1e-11, "{away}");
        }
    }

    #[test]
    fn water_is_neither_made_nor_lost((plant, inflow) in plant(), share in 0.05..0.3_f64, gain in 0.1..5.0_f64) {
        let signal = InflowSignal::Sine { amplitude: share * inflow, period_s: 80.0 };
        let disturbance = InflowDisturbance { signal, from_s: 40.0, until_s: 200.0 };
        let run = LevelExperiment { disturbance, log_step_s: 0.1, ..experiment(inflow, 300.0) };
        let controller = LevelController::pi(gain * sign(&plant, inflow), 100.0);
        let log = LevelSimulation::new(&plant, &run).unwrap().run(&controller).unwrap();
        prop_assume!(log.full_s == 0.0 && log.empty_s == 0.0);
        let feeds = matches!(plant.valve.place, ValvePlace::Inlet { .. });
        let net = |row: usize| log.inflow[row] - log.outflow[row] + if feeds { log.valve_flow[row] } else { 0.0 };
        let kept: f64 = (1..log.len()).map(|row| 0.05 * (net(row - 1) + net(row))).sum();
        let risen = plant.tank.area * (log.level[log.len() - 1] - 0.5);
        // Trapezia of 0.1 s, with one jump of the sine at neither end of its gate.
        prop_assert!((kept - risen).abs() < 1e-4 * inflow * 300.0, "{kept} {risen}");
    }

    #[test]
    fn a_small_step_of_the_output_ends_where_the_linear_model_says((plant, inflow) in plant()) {
        let gains = plant.gains(&plant.rest(0.5, inflow).unwrap());
        let step = 1e-4;
        let settle = gains.time_constant().map_or(300.0, |time| 12.0 * time + 200.0);
        let simulation = LevelSimulation::new(&plant, &experiment(inflow, settle));
        let Ok(simulation) = simulation else { return Ok(()) };
        let log = simulation.run(&LevelController::Manual { steps: vec![SignalStep { time_s: 0.0, size: step }] }).unwrap();
        let moved = log.transmitted[log.len() - 1] - log.transmitted[0];
        let expected = match gains.process_gain() {
            Some(gain) => gain * step,
            None => gains.slope_gain() * step * (settle - gains.actuator_lag_s - gains.transmitter_lag_s),
        };
        prop_assert!((moved / expected - 1.0).abs() < 5e-3, "{moved} {expected}");
    }

    /// The count of encirclements, and a run that starts a little away from its set-point.
    #[test]
    fn a_loop_with_a_gain_margin_settles((plant, inflow) in plant(), gain in 0.2..30.0_f64, time in 20.0..300.0_f64) {
        let gain = gain * sign(&plant, inflow);
        let controller = LevelController::pi(gain, time);
        let run = LevelExperiment {
            set_point_steps: vec![SignalStep { time_s: 0.0, size: 1e-5 }],
            ..experiment(inflow, 6000.0)
        };
        let Ok(simulation) = LevelSimulation::new(&plant, &run) else { return Ok(()) };
        let quality = LoopQuality::of(simulation.gains(), &controller).unwrap().unwrap();
        let Some(peak) = quality.sensitivity_peak() else {
            prop_assert!(!matches!(quality.stability, LoopStability::Stable));
            return Ok(());
        };
        prop_assume!(peak < 3.0);
        let Ok(log) = simulation.run(&controller) else { return Ok(()) };
        // The slowest pole of a PI loop around a lag or an integrator takes a few integral times, more at small gains.
        let gains = simulation.gains();
        let slow = time * (1.0 + gains.process_gain().map_or(0.0, |k| 1.0 / (k * gain)));
        prop_assume!(8.0 * slow < 6000.0);
        let end = log.level[log.len() - 1];
        prop_assert!((end - 0.500_01).abs() < 2e-6, "{end} {quality:?}");
    }

    #[test]
    fn dials_invert(gain in 0.01..500.0_f64, time in 0.1..1e5_f64, parallel: bool, band: bool, rate: bool) {
        let dials = PiDials {
            form: if parallel { PiForm::Parallel } else { PiForm::Series },
            proportional: if band { ProportionalDial::Band } else { ProportionalDial::Gain },
            integral: if rate { IntegralDial::RepeatsPerMinute } else { IntegralDial::Time },
        };
        let [back_gain, back_time] = dials.settings(dials.of(gain, time));
        prop_assert!((back_gain / gain - 1.0).abs() < 1e-13 && (back_time / time - 1.0).abs() < 1e-13);
    }

    /// A bowl anywhere in the box, or with its bottom beyond the border: every search finds its lowest point.
    #[test]
    fn searches_find_the_bottom_of_a_bowl(
        bottom in [-0.3..1.3_f64, -0.3..1.3_f64],
        start in [0.05..0.95_f64, 0.05..0.95_f64],
        tilt in 0.3..3.0_f64,
    ) {
        let axes = [Axis { low: 0.0, high: 1.0, scale: AxisScale::Linear }; 2];
        let cost = |[x, y]: [f64; 2]| (x - bottom[0]).powi(2) + tilt * (y - bottom[1]).powi(2);
        let lowest = bottom.map(|b| b.clamp(0.0, 1.0));
        let run = |search: &mut dyn FnMut() -> bool| while search() {};
        let mut simplex = NelderMead::new(axes, start).unwrap();
        run(&mut || advance(&mut simplex, 17, cost));
        let mut gradient = Gradient::new(axes, start).unwrap();
        run(&mut || advance(&mut gradient, 17, cost));
        let mut genetic = Genetic::new(axes, GeneticSettings::default()).unwrap();
        run(&mut || advance(&mut genetic, 17, cost));
        for best in [simplex.best(), gradient.best(), genetic.best()] {
            let best = best.unwrap();
            prop_assert!(best.cost - cost(lowest) < 2e-4, "{best:?} {lowest:?}");
            prop_assert!(best.point.iter().all(|x| (0.0..=1.0).contains(x)));
        }
    }
}
