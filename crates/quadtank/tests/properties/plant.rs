//! Properties of plant and controller over random parameters.

use std::array::from_fn;

use proptest::prelude::*;
use quadtank::control::{AntiWindup, DecentralisedPi, LoopMode, Pairing, Pi, PiSettings};
use quadtank::linear::{StateSpace, quadruple, transmission_zeros};
use quadtank::literature::PresetId;
use quadtank::plant::{
    CrossSection, Disturbance, OperatingPoint, Outlet, PlantError, Pump, QuadrupleTank, SINGULAR_MARGIN, Sensor, Tank,
};

fn tank() -> impl Strategy<Value = Tank> {
    let section = (1e-3..2e-2, prop_oneof![Just(0.0), 0.0..0.1])
        .prop_map(|(area_at_empty, area_slope)| CrossSection { area_at_empty, area_slope });
    let outlet = (4e-6..4e-5, 0.5..1.0).prop_map(|(area, loss_coefficient)| Outlet { area, loss_coefficient });
    (section, outlet).prop_map(|(section, outlet)| Tank { section, outlet, height: 1e3 })
}

fn pump() -> impl Strategy<Value = Pump> {
    (1e-6..6e-6).prop_map(|gain| Pump::proportional(gain, 0.0, 1e3))
}

fn valve() -> impl Strategy<Value = f64> {
    prop_oneof![1 => Just(0.0), 1 => Just(1.0), 8 => 0.0..1.0]
}

/// Growth of the valve fractions with the flow, which is up to 6e-5 m³/s here; none on half of the rigs.
fn valve_slopes() -> impl Strategy<Value = [f64; 2]> {
    prop_oneof![Just([0.0; 2]), [-5e3..5e3, -5e3..5e3]]
}

fn plant() -> impl Strategy<Value = QuadrupleTank> {
    let valves = [valve(), valve()];
    ([tank(), tank(), tank(), tank()], [pump(), pump()], valves, valve_slopes(), 9.7..9.9).prop_map(
        |(tanks, pumps, valves, valve_slopes, gravity)| {
            let sensor = Sensor { gain: 50.0, range: 0.3, resolution: 0.0 };
            let inflow = [0.0; 4];
            QuadrupleTank { tanks, pumps, valves, valve_slopes, power_gain: 1.0, sensor, gravity, inflow }
        },
    )
}

fn voltages() -> impl Strategy<Value = [f64; 2]> {
    [0.5..10.0, 0.5..10.0]
}

fn levels() -> impl Strategy<Value = [f64; 4]> {
    [0.01..0.5, 0.01..0.5, 0.01..0.5, 0.01..0.5]
}

fn relative_difference(value: f64, expected: f64, scale: f64) -> f64 {
    (value - expected).abs() / scale.abs().max(expected.abs()).max(f64::MIN_POSITIVE)
}

proptest! {
    /// What the tanks store is what the pumps bring less what tanks 1 and 2 and the leaks let out.
    #[test]
    fn water_balance(
        plant in plant(), levels in levels(), voltage in voltages(),
        flow in [0.0..1e-5, 0.0..1e-5], leak_area in [0.0..1e-5, 0.0..1e-5, 0.0..1e-5, 0.0..1e-5],
    ) {
        let load = Disturbance { pump_flow: flow, leak_area, ..Disturbance::default() };
        let rates = plant.derivative(&levels, &voltage, &load);
        let stored: f64 = (0..4).map(|j| plant.tanks[j].section.area(levels[j]) * rates[j]).sum();
        let pumped: f64 = (0..2).map(|i| plant.pumps[i].gain * voltage[i] + flow[i]).sum();
        let drained: f64 = (0..2).map(|j| plant.tanks[j].outflow(levels[j], plant.gravity)).sum();
        let leaked: f64 = (0..4).map(|j| leak_area[j] * (2.0 * plant.gravity * levels[j]).sqrt()).sum();
        prop_assert!(relative_difference(stored, pumped - drained - leaked, pumped + drained + leaked) < 1e-13);
    }

    #[test]
    fn levels_stand_still_at_equilibrium(plant in plant(), voltage in voltages()) {
        let point = plant.free_equilibrium(voltage);
        let rates = plant.derivative(&point.levels, &voltage, &Disturbance::default());
        let pumped = plant.pumps[0].gain * voltage[0] + plant.pumps[1].gain * voltage[1];
        for (tank, rate) in plant.tanks.iter().zip(rates) {
            prop_assert!((tank.section.area_at_empty * rate).abs() < 1e-14 * pumped);
        }
    }

    #[test]
    fn inputs_and_levels_determine_each_other(plant in plant(), voltage in voltages()) {
        let plant = QuadrupleTank { valve_slopes: [0.0; 2], ..plant };
        let point = plant.equilibrium(voltage).unwrap();
        let gamma_sum = plant.valves[0] + plant.valves[1];
        let back = plant.inputs_for_levels([point.levels[0], point.levels[1]]);
        if (gamma_sum - 1.0).abs() < SINGULAR_MARGIN {
            prop_assert_eq!(back, Err(PlantError::SingularPlant { gamma_sum }));
        } else {
            // Rounding grows with the condition number of the balance: the flows over the determinant.
            let tolerance = 1e-13 / (gamma_sum - 1.0).abs();
            let scale = (0..2).map(|i| plant.pumps[i].gain * voltage[i]).fold(0.0, f64::max);
            let back = back.unwrap();
            for (pump, (found, given)) in plant.pumps.iter().zip(back.pump_voltage.into_iter().zip(voltage)) {
                let error = pump.gain * (found - given).abs();
                prop_assert!(error < tolerance * scale, "{error} against {}", tolerance * scale);
            }
        }
    }

    /// Where fractions depend on the flow two pairs of voltages may hold the same levels, or none may that pump water.
    #[test]
    fn inputs_that_are_found_hold_their_levels(plant in plant(), voltage in voltages()) {
        let levels = plant.equilibrium(voltage).unwrap().levels;
        if let Ok(found) = plant.inputs_for_levels([levels[0], levels[1]]) {
            let [gamma_1, gamma_2] = plant.incremental_fractions(found.pump_voltage);
            let tolerance = 1e-12 / (gamma_1 + gamma_2 - 1.0).abs();
            let held = plant.free_equilibrium(found.pump_voltage).levels;
            for (tank, (held, level)) in held.into_iter().zip(levels).take(2).enumerate() {
                prop_assert!((held - level).abs() <= tolerance * level.abs(), "tank {}: {held} {level}", tank + 1);
            }
        }
    }

    /// At any point, at rest or not.
    #[test]
    fn jacobian_is_the_derivative_of_the_rates(plant in plant(), levels in levels(), voltage in voltages()) {
        let model = plant.linearise(&OperatingPoint { levels, pump_voltage: voltage });
        let rates = |levels, voltage| plant.derivative(&levels, &voltage, &Disturbance::default());
        let check = |exact: f64, above: f64, below: f64, width: f64, scale: f64| {
            relative_difference((above - below) / width, exact, scale) < 1e-6
        };
        let scale = model.a.amax();
        for j in 0..4 {
            let half_width = 1e-5 * levels[j];
            let moved = |by: f64| rates(from_fn(|i| if i == j { levels[i] + by } else { levels[i] }), voltage);
            let (above, below) = (moved(half_width), moved(-half_width));
            for i in 0..4 {
                prop_assert!(check(model.a[(i, j)], above[i], below[i], 2.0 * half_width, scale), "a[{i}, {j}]");
            }
        }
        let scale = model.b.amax();
        // At the ends of a fraction its slope jumps.
        let is_between_ends = |by: f64| plant.fractions_at(voltage.map(|v| v + by)).map(|gamma| gamma % 1.0 > 0.0);
        prop_assume!(is_between_ends(1e-3) == is_between_ends(-1e-3));
        for j in 0..2 {
            let moved = |by: f64| rates(levels, from_fn(|i| if i == j { voltage[i] + by } else { voltage[i] }));
            let (above, below) = (moved(1e-3), moved(-1e-3));
            for i in 0..4 {
                prop_assert!(check(model.b[(i, j)], above[i], below[i], 2e-3, scale), "b[{i}, {j}]");
            }
        }
    }

    #[test]
    fn time_constants_are_the_poles(plant in plant(), voltage in voltages()) {
        let point = plant.free_equilibrium(voltage);
        let model = plant.linearise(&point);
        for (j, time_constant) in plant.time_constants_s(&point).into_iter().enumerate() {
            match time_constant {
                Some(value) => prop_assert!((value * model.a[(j, j)] + 1.0).abs() < 1e-12 && value > 0.0),
                None => prop_assert!(model.quasi_steady[j] && model.a[(j, j)] == 0.0),
            }
        }
        let (a, b, c) = model.reduced();
        prop_assert!(a.iter().chain(&b).chain(&c).all(|entry| entry.is_finite()));
    }

    #[test]
    fn wild_inputs_give_numbers_or_errors(
        plant in plant(),
        levels in [-1e6..1e6, -1e6..1e6, -1e-12..1e-12, -1.0..1.0],
        voltage in [-1e6..1e6, -1.0..1.0],
        flow in [-1.0..1.0, -1e-6..1e-6],
    ) {
        let load = Disturbance { pump_flow: flow, ..Disturbance::default() };
        prop_assert!(plant.derivative(&levels, &voltage, &load).iter().all(|rate| rate.is_finite()));
        let point = plant.free_equilibrium(voltage);
        prop_assert!(point.levels.iter().all(|level| level.is_finite() && *level >= 0.0));
        prop_assert_eq!(plant.equilibrium(voltage).is_ok(), plant.violations(&point).is_empty());
        match plant.inputs_for_levels([levels[0], levels[1]]) {
            Ok(point) => prop_assert!(plant.violations(&point).is_empty()),
            Err(error) => prop_assert!(!error.to_string().is_empty()),
        }
        let (a, b, c) = plant.linearise(&OperatingPoint { levels, pump_voltage: voltage }).reduced();
        prop_assert!(a.iter().chain(&b).chain(&c).all(|entry| entry.is_finite()));
    }

    #[test]
    fn no_number_at_all_panics(
        plant in plant(),
        levels in [prop::num::f64::ANY, prop::num::f64::ANY, prop::num::f64::ANY, prop::num::f64::ANY],
        voltage in [prop::num::f64::ANY, prop::num::f64::ANY],
        valves in [prop::num::f64::ANY, prop::num::f64::ANY],
    ) {
        let plant = plant.with_valves(valves);
        let _ = plant.derivative(&levels, &voltage, &Disturbance::default());
        let _ = plant.equilibrium(voltage);
        let _ = plant.inputs_for_levels([levels[0], levels[1]]);
        let _ = plant.linearise(&OperatingPoint { levels, pump_voltage: voltage }).reduced();
        let _ = plant.time_constants_s(&OperatingPoint { levels, pump_voltage: voltage });
    }
}

proptest! {
    /// The theory of the paths in the valve plane against the matrices, with incremental fractions in the place of γ.
    #[test]
    fn zeros_and_relative_gain_follow_the_incremental_fractions(plant in plant(), voltage in voltages()) {
        let [gamma_1, gamma_2] = plant.incremental_fractions(voltage);
        let inside = |gamma: f64| (0.05..0.95).contains(&gamma) || gamma > 1.05;
        prop_assume!(inside(gamma_1) && inside(gamma_2) && (gamma_1 + gamma_2 - 1.0).abs() > 0.05);
        let point = plant.free_equilibrium(voltage);
        let [_, _, Some(t3), Some(t4)] = plant.time_constants_s(&point) else { return Ok(()) };
        let (a, b, c) = plant.linearise(&point).reduced();
        let model = StateSpace::strictly_proper(a, b, c).unwrap();
        let found = transmission_zeros(&model).unwrap();
        let expected = quadruple::zeros_off_rest(t3, t4, [gamma_1, gamma_2], 1.0).unwrap().pair().unwrap();
        // Where both zeros nearly meet they move by the root of what rounding changes.
        let scale = 1.0 / t3.min(t4);
        let nearest = |zero: quadtank::linear::Complex| {
            found.iter().map(|found| (found.value - zero).norm()).fold(f64::INFINITY, f64::min)
        };
        for zero in expected {
            prop_assert!(nearest(zero) < 1e-6 * scale.max(zero.norm()), "{zero}: {:?}", found.iter().map(|z| z.value).collect::<Vec<_>>());
        }
        let gain = model.dc_gain().unwrap();
        let lambda = quadtank::interaction::relative_gain_array(&gain).unwrap()[(0, 0)];
        let by_fractions = gamma_1 * gamma_2 / (gamma_1 + gamma_2 - 1.0);
        prop_assert!((lambda - by_fractions).abs() < 1e-9 * by_fractions.abs().max(1.0), "{lambda} {by_fractions}");
    }
}

/// The model without its dry tanks has the zeros of the closed form in which a dry tank has no time constant.
#[test]
fn dry_tanks_leave_the_zeros_of_the_closed_form() {
    for (valves, voltage, count) in [
        ([0.7, 1.0], [3.0, 3.0], 1),
        ([1.0, 0.6], [3.0, 3.0], 1),
        ([1.0, 1.0], [3.0, 3.0], 0),
        ([0.7, 0.6], [3.0, 0.0], 1),
        ([0.4, 0.3], [0.0, 3.0], 1),
    ] {
        let plant = PresetId::JohanssonMinimumPhase.preset().plant.with_valves(valves);
        let point = plant.free_equilibrium(voltage);
        let [_, _, t3, t4] = plant.time_constants_s(&point).map(Option::unwrap_or_default);
        let expected = quadruple::zeros(t3, t4, valves).unwrap();
        let (a, b, c) = plant.linearise(&point).reduced();
        let found = transmission_zeros(&StateSpace::strictly_proper(a, b, c).unwrap()).unwrap();
        assert_eq!((found.len(), expected.as_slice().len()), (count, count), "{valves:?} {voltage:?}");
        for (found, expected) in found.iter().zip(expected.as_slice()) {
            assert!((found.value.re - expected).abs() < 1e-9 * expected.abs(), "{valves:?} {voltage:?}");
        }
    }
}

fn settings() -> impl Strategy<Value = PiSettings> {
    let anti_windup = prop_oneof![
        Just(AntiWindup::Off),
        (0.0..2.0).prop_map(|tracking_ratio| AntiWindup::BackCalculation { tracking_ratio })
    ];
    (-20.0..20.0, 1.0..500.0, 0.0..1.5, anti_windup).prop_map(
        |(gain, integral_time_s, set_point_weight, anti_windup)| PiSettings {
            gain,
            integral_time_s,
            set_point_weight,
            anti_windup,
            mode: LoopMode::Automatic,
        },
    )
}

/// The algorithm of the reference values, written down once more as it stands there, with the absolute `b r − y`.
struct Textbook {
    integral: f64,
    previous_error: Option<f64>,
}

impl Textbook {
    fn step(&mut self, s: &PiSettings, (low, high): (f64, f64), ts: f64, reference: f64, measured: f64) -> f64 {
        let error = reference - measured;
        let previous = self.previous_error.replace(error).unwrap_or(error);
        self.integral += s.gain * ts / (2.0 * s.integral_time_s) * (error + previous);
        let v = s.gain * (s.set_point_weight * reference - measured) + self.integral;
        let c = if v < low {
            low
        } else if v > high {
            high
        } else {
            v
        };
        if let AntiWindup::BackCalculation { tracking_ratio } = s.anti_windup {
            self.integral += (ts / (tracking_ratio * s.integral_time_s)).min(1.0) * (c - v);
        }
        c
    }
}

proptest! {
    #[test]
    fn pi_is_the_algorithm_of_the_reference(
        settings in settings(),
        rest in 0.0..10.0, output in 0.0..10.0, ts in 0.1..5.0,
        signals in prop::collection::vec((0.0..10.0, 0.0..10.0), 1..200),
    ) {
        let limits = (0.0, 10.0);
        let mut pi = Pi::new(settings, limits, ts, output, rest);
        let at_rest = output - settings.gain * (settings.set_point_weight - 1.0) * rest;
        let mut textbook = Textbook { integral: at_rest, previous_error: None };
        for (k, (reference, measured)) in signals.into_iter().enumerate() {
            let expected = textbook.step(&settings, limits, ts, reference, measured);
            let found = pi.step(ts * k as f64, reference, measured);
            prop_assert!((found - expected).abs() < 1e-8, "{found} against {expected}");
        }
    }

    /// Integral action leaves no error behind a first-order plant, whatever the weight, the rest and the sign.
    #[test]
    fn pi_brings_the_output_to_the_reference(
        gain in 0.1..2.0, sign in prop_oneof![Just(-1.0), Just(1.0_f64)], set_point_weight in 0.0..1.0,
        rest in 1.0..9.0, step in -0.5..0.5_f64,
    ) {
        let (time_constant, output) = (20.0_f64, 5.0);
        let settings = PiSettings {
            gain: sign * gain, integral_time_s: time_constant, set_point_weight,
            anti_windup: AntiWindup::BackCalculation { tracking_ratio: 0.5 }, mode: LoopMode::Automatic,
        };
        let mut pi = Pi::new(settings, (0.0, 10.0), 1.0, output, rest);
        let decay = (-1.0 / time_constant).exp();
        let mut deviation = 0.0_f64;
        for k in 0..4000 {
            let control = pi.step(f64::from(k), rest + step, rest + deviation);
            deviation = decay * deviation + (1.0 - decay) * sign * (control - output);
        }
        prop_assert!((deviation - step).abs() < 1e-9, "{deviation} against {step}");
    }

    /// Also for signals that are no numbers, and in either mode.
    #[test]
    fn pi_keeps_its_limits(
        settings in settings(), until_s in 0.0..50.0, manual in prop::num::f64::ANY,
        signals in prop::collection::vec((prop::num::f64::ANY, prop::num::f64::ANY), 100),
    ) {
        for mode in [LoopMode::Automatic, LoopMode::Manual { output: manual, until_s }] {
            let mut pi = Pi::new(PiSettings { mode, ..settings }, (1.0, 9.0), 1.0, 5.0, 6.0);
            for (k, (reference, measured)) in signals.iter().enumerate() {
                let output = pi.step(k as f64, *reference, *measured);
                prop_assert!((1.0..=9.0).contains(&output));
            }
        }
    }

    #[test]
    fn hand_over_is_bumpless(
        settings in settings(), manual in 1.0..9.0, rest in 1.0..9.0,
        signals in prop::collection::vec((5.0..6.0, 5.0..6.0), 20),
    ) {
        let until_s = 20.0;
        let mode = LoopMode::Manual { output: manual, until_s };
        let mut pi = Pi::new(PiSettings { mode, ..settings }, (-1e6, 1e6), 1.0, 5.0, rest);
        let mut last = (0.0, 0.0);
        for (k, (reference, measured)) in signals.into_iter().enumerate() {
            prop_assert_eq!(pi.step(k as f64, reference, measured), manual);
            last = (reference, measured);
        }
        let one_sample = settings.gain / settings.integral_time_s * (last.0 - last.1);
        let first = pi.step(until_s, last.0, last.1);
        prop_assert!((first - manual - one_sample).abs() < 1e-9);
    }

    /// A swapped controller is a diagonal one on a plant whose pumps have changed names.
    #[test]
    fn swapping_is_renaming_the_pumps(
        first in settings(), second in settings(), output in [0.0..10.0, 0.0..10.0],
        signals in prop::collection::vec(([0.0..10.0, 0.0..10.0], [0.0..10.0, 0.0..10.0]), 1..50),
    ) {
        let limits = [(0.0, 10.0), (2.0, 8.0)];
        let diagonal = DecentralisedPi { pairing: Pairing::Diagonal, loops: [first, second], sampling_time_s: 1.0 };
        let swapped = DecentralisedPi { pairing: Pairing::Swapped, ..diagonal };
        let mut one = diagonal.start(limits, output, [5.0, 6.0]);
        let mut other = swapped.start([limits[1], limits[0]], [output[1], output[0]], [5.0, 6.0]);
        for (k, (reference, measured)) in signals.into_iter().enumerate() {
            prop_assert_eq!(one.step(k as f64, reference, measured), other.step(k as f64, reference, measured));
        }
    }
}
