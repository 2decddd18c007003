//! Random valid scenarios: any number within its limits, with all its digits.
#![allow(dead_code, reason = "each test file uses its own part")]

use proptest::collection::vec;
use proptest::prelude::*;
use quadtank::control::{
    AntiWindup, DecentralisedPi, EstimatorSettings, FedWith, LoopMode, ModelFree, ModelFreeAntiWindup,
    ModelFreeSettings, Pairing, PiSettings, Quadrature, Window,
};
use quadtank::literature::{DisplayUnit, PresetId};
use quadtank::plant::{CrossSection, OperatingPoint, Outlet, Pump, QuadrupleTank, Sensor, Tank, ValveSchedule};
use quadtank::sim::{Experiment, InflowStep, Load, LoadStep, Measurement, PumpVoltageStep, SetPointStep};
use quadtank::study::model_free::{ModelFreeSetup, StartSpec};
use quadtank::study::quadruple_tank::{OperatingPointSpec, PlantSpec, Setup};
use quadtank_scenario::model_free::ModelFreeScenario;
use quadtank_scenario::{Label, Limits, Scenario, View, limits};

/// One of the published rigs.
pub fn preset() -> impl Strategy<Value = PresetId> {
    prop::sample::select(PresetId::ALL.to_vec())
}

/// A number within its limits, quite often one of them.
pub fn corner_or_within(limits: Limits) -> impl Strategy<Value = f64> {
    prop_oneof![Just(limits.min), Just(limits.max), within(limits)]
}

pub fn within(limits: Limits) -> impl Strategy<Value = f64> {
    limits.min..=limits.max
}

fn pair(limits: Limits) -> impl Strategy<Value = [f64; 2]> {
    [corner_or_within(limits), corner_or_within(limits)]
}

fn tank() -> impl Strategy<Value = Tank> {
    let section = (1e-4..=limits::TANK_AREA.max, 0.0..=limits::TANK_AREA_SLOPE.max, within(limits::TANK_HEIGHT));
    (section, 0.0..=1.0, within(limits::LOSS_COEFFICIENT)).prop_map(
        |((area, slope, height), share, loss_coefficient)| {
            let widest = limits::OUTLET_AREA.max.min(limits::OUTLET_SHARE * area);
            let area_of_outlet = f64::max(share * widest, limits::OUTLET_AREA.min);
            Tank {
                section: CrossSection { area_at_empty: area, area_slope: slope },
                outlet: Outlet { area: area_of_outlet, loss_coefficient },
                height,
            }
        },
    )
}

fn pump() -> impl Strategy<Value = Pump> {
    let curve = (0.0..1.0_f64, 0.0..1.0_f64, prop::option::of(0.0..1.0_f64));
    let delay = prop_oneof![Just(0.0), within(limits::PUMP_DELAY_S)];
    (within(limits::PUMP_GAIN), pair(limits::PUMP_VOLTAGE), prop::option::of(curve), delay).prop_map(
        |(gain, [one, other], curve, delay_s)| {
            let straight = Pump { delay_s, ..Pump::proportional(gain, one.min(other), one.max(other)) };
            let Some((start, lost, most)) = curve else { return straight };
            let start_voltage = start * straight.voltage_max;
            let offset = -lost * gain * start_voltage;
            let [least, end] =
                [start_voltage.max(straight.voltage_min), straight.voltage_max].map(|v| gain * v + offset);
            let flow_max = |share: f64| limits::PUMP_FLOW_MAX.clamp(least + share * (end - least));
            Pump { offset, start_voltage, flow_max: most.map(flow_max), ..straight }
        },
    )
}

fn rig() -> impl Strategy<Value = QuadrupleTank> {
    let sensor = (within(limits::SENSOR_GAIN), within(limits::SENSOR_RANGE), within(limits::SENSOR_RESOLUTION))
        .prop_map(|(gain, range, resolution)| Sensor { gain, range, resolution });
    let parts = ([tank(), tank(), tank(), tank()], [pump(), pump()], pair(limits::VALVE), sensor);
    let inflow = prop_oneof![Just([0.0; 4]), prop::array::uniform4(within(limits::INFLOW))];
    let valve_slopes = prop_oneof![Just([0.0; 2]), pair(limits::VALVE_SLOPE)];
    (parts, within(limits::POWER_GAIN), within(limits::GRAVITY), inflow, valve_slopes).prop_map(
        |((tanks, pumps, valves, sensor), power_gain, gravity, inflow, valve_slopes)| QuadrupleTank {
            tanks,
            pumps,
            valves,
            valve_slopes,
            power_gain,
            sensor,
            gravity,
            inflow,
        },
    )
}

fn plant() -> impl Strategy<Value = PlantSpec> {
    prop_oneof![
        preset().prop_map(PlantSpec::Preset),
        (rig(), prop_oneof![Just(DisplayUnit::Cm), Just(DisplayUnit::Mm)])
            .prop_map(|(rig, display_unit)| PlantSpec::Parameters { rig, display_unit }),
    ]
}

fn settings() -> impl Strategy<Value = PiSettings> {
    let anti_windup = prop_oneof![
        Just(AntiWindup::Off),
        within(limits::TRACKING_RATIO).prop_map(|tracking_ratio| AntiWindup::BackCalculation { tracking_ratio }),
    ];
    let mode = prop_oneof![
        Just(LoopMode::Automatic),
        (within(limits::MANUAL_OUTPUT), within(limits::TIME_S))
            .prop_map(|(output, until_s)| LoopMode::Manual { output, until_s }),
    ];
    let gain = (within(limits::GAIN_MAGNITUDE), prop::bool::ANY).prop_map(|(size, up)| if up { size } else { -size });
    (gain, within(limits::INTEGRAL_TIME_S), within(limits::SET_POINT_WEIGHT), anti_windup, mode).prop_map(
        |(gain, integral_time_s, set_point_weight, anti_windup, mode)| PiSettings {
            gain,
            integral_time_s,
            set_point_weight,
            anti_windup,
            mode,
        },
    )
}

fn controller() -> impl Strategy<Value = DecentralisedPi> {
    let pairing = prop_oneof![Just(Pairing::Diagonal), Just(Pairing::Swapped)];
    // From 1 s on any duration is few enough samples.
    (pairing, [settings(), settings()], 1.0..=limits::SAMPLING_TIME_S.max)
        .prop_map(|(pairing, loops, sampling_time_s)| DecentralisedPi { pairing, loops, sampling_time_s })
}

fn experiment(steps: usize) -> impl Strategy<Value = Experiment> {
    let set_point = (0..2_usize, within(limits::TIME_S), within(limits::SET_POINT_STEP))
        .prop_map(|(level, time_s, size)| SetPointStep { level, time_s, size });
    let load = prop_oneof![
        (0..2_usize, within(limits::LOAD_FLOW)).prop_map(|(pump, flow)| Load::PumpFlow { pump, flow }),
        (0..4_usize, within(limits::LEAK_AREA)).prop_map(|(tank, area)| Load::Leak { tank, area }),
        (0..4_usize, within(limits::LOAD_FLOW)).prop_map(|(tank, flow)| Load::TankFlow { tank, flow }),
        (0..2_usize, within(limits::LOAD_SHARE)).prop_map(|(pump, change)| Load::PumpGain { pump, change }),
        (0..2_usize, within(limits::LOAD_SHARE)).prop_map(|(valve, change)| Load::Valve { valve, change }),
        (0..4_usize, within(limits::LOAD_SHARE)).prop_map(|(tank, change)| Load::Outlet { tank, change }),
    ];
    let by_hand = (0..2_usize, within(limits::TIME_S), within(limits::PUMP_VOLTAGE))
        .prop_map(|(pump, time_s, voltage)| PumpVoltageStep { pump, time_s, voltage });
    // Every tank is that high.
    let level = Limits { max: limits::TANK_HEIGHT.min, ..limits::LEVEL };
    let flow_noise = prop_oneof![Just(0.0), within(limits::PUMP_FLOW_NOISE_STD)];
    let inflow = (0..4_usize, within(limits::TIME_S), within(limits::INFLOW))
        .prop_map(|(tank, time_s, flow)| InflowStep { tank, time_s, flow });
    let own_levels = prop::option::of(prop::array::uniform4(within(level)));
    let start = (own_levels, vec(by_hand, 0..=steps), vec(inflow, 0..=steps), flow_noise);
    let load = (within(limits::TIME_S), load).prop_map(|(time_s, load)| LoadStep { time_s, load });
    let measurement = (within(limits::NOISE_STD), any::<u32>(), any::<bool>())
        .prop_map(|(noise_std, seed, quantised)| Measurement { noise_std, seed, quantised });
    (within(limits::DURATION_S), vec(set_point, 0..=steps), vec(load, 0..=steps), measurement, start).prop_map(
        |(duration_s, set_point_steps, load_steps, measurement, start)| {
            let (initial_levels, pump_voltage_steps, inflow_steps, pump_flow_noise_std) = start;
            Experiment {
                duration_s,
                set_point_steps,
                load_steps,
                measurement,
                initial_levels,
                pump_voltage_steps,
                inflow_steps,
                pump_flow_noise_std,
            }
        },
    )
}

pub fn setup(steps: usize) -> impl Strategy<Value = Setup> {
    let operating_point = prop_oneof![
        pair(limits::PUMP_VOLTAGE).prop_map(OperatingPointSpec::PumpVoltage),
        pair(limits::LEVEL).prop_map(OperatingPointSpec::Levels),
        (pair(limits::LEVEL), pair(limits::LEVEL), pair(limits::PUMP_VOLTAGE)).prop_map(
            |(lower, upper, pump_voltage)| {
                let levels = [lower[0], lower[1], upper[0], upper[1]];
                OperatingPointSpec::State(OperatingPoint { levels, pump_voltage })
            }
        ),
    ];
    (plant(), pair(limits::VALVE), operating_point, controller(), experiment(steps)).prop_map(
        |(plant, valves, operating_point, controller, experiment)| Setup {
            plant,
            valves,
            operating_point,
            controller,
            experiment,
        },
    )
}

pub fn view() -> impl Strategy<Value = View> {
    let zoom = pair(limits::TIME_S).prop_map(|[one, other]| [one.min(other), one.max(other)]);
    (prop::option::of(within(limits::TIME_S)), prop::option::of(zoom), any::<bool>())
        .prop_map(|(cursor_s, zoom_s, hide_linear)| View { cursor_s, zoom_s, hide_linear })
}

/// Any characters, of at most the lengths that are allowed.
fn label() -> impl Strategy<Value = Label> {
    (vec(any::<char>(), 0..=Label::MAX_NAME), vec(any::<char>(), 0..20))
        .prop_map(|(name, note)| Label { name: name.into_iter().collect(), note: note.into_iter().collect() })
}

pub fn scenario(steps: usize, pinned: usize) -> impl Strategy<Value = Scenario> {
    let parts = (setup(steps), vec(setup(steps), 0..=pinned), view(), label());
    parts.prop_map(|(setup, pinned, view, label)| Scenario {
        // Any name is one of a rig, too.
        rig_name: label.name.clone(),
        label,
        pinned,
        view,
        ..Scenario::from(setup)
    })
}

fn valve() -> impl Strategy<Value = ValveSchedule> {
    let valve = || within(limits::VALVE);
    prop_oneof![
        valve().prop_map(|gamma| ValveSchedule::Constant { gamma }),
        (valve(), valve(), within(limits::TIME_S)).prop_map(|(from, to, at_s)| ValveSchedule::Step { from, to, at_s }),
        (valve(), valve(), pair(limits::TIME_S)).prop_map(|(from, to, [one, other])| ValveSchedule::Ramp {
            from,
            to,
            begin_s: one.min(other),
            end_s: one.max(other),
        }),
        (valve(), -1.0..=1.0, within(limits::VALVE_FREQUENCY), within(limits::VALVE_PHASE)).prop_map(
            |(mean, share, frequency, phase): (f64, f64, f64, f64)| {
                // A little less than what touches 0 or 1.
                let amplitude = 0.999 * share * mean.min(1.0 - mean);
                ValveSchedule::Sine { mean, amplitude, frequency, phase }
            }
        ),
    ]
}

fn turning_within(valve: ValveSchedule, limits: Limits) -> ValveSchedule {
    match valve {
        ValveSchedule::Sine { mean, amplitude, frequency, phase } => {
            ValveSchedule::Sine { mean, amplitude, frequency: limits.clamp(frequency), phase }
        }
        other => other,
    }
}

fn law() -> impl Strategy<Value = ModelFree> {
    let settings = || {
        let windup = prop_oneof![
            Just(ModelFreeAntiWindup::Off),
            Just(ModelFreeAntiWindup::Conditional),
            within(limits::INTEGRAL_TIME_S)
                .prop_map(|tracking_time_s| ModelFreeAntiWindup::BackCalculation { tracking_time_s }),
        ];
        let feedback = || within(limits::MODEL_FREE_FEEDBACK);
        (within(limits::MODEL_GAIN), feedback(), feedback(), windup).prop_map(
            |(model_gain, proportional, integral, anti_windup)| ModelFreeSettings {
                model_gain,
                proportional,
                integral,
                anti_windup,
            },
        )
    };
    let estimator = (
        prop::sample::select(vec![Window::Block, Window::Sliding]),
        prop::sample::select(vec![Quadrature::Rectangular, Quadrature::Trapezoidal]),
        prop::sample::select(vec![FedWith::Applied, FedWith::Commanded]),
        2..=1000_u32,
    );
    let pairing = prop_oneof![Just(Pairing::Diagonal), Just(Pairing::Swapped)];
    // From 1 s on any duration is few enough samples.
    (pairing, [settings(), settings()], prop::option::of(estimator), 1.0..=limits::SAMPLING_TIME_S.max).prop_map(
        |(pairing, loops, estimator, sampling_time_s)| ModelFree {
            pairing,
            loops,
            estimator: estimator.map(|(window, quadrature, fed_with, samples)| EstimatorSettings {
                window_s: f64::from(samples) * sampling_time_s,
                window,
                quadrature,
                fed_with,
            }),
            sampling_time_s,
        },
    )
}

/// Without hoses that delay, which the model-free bench does not know.
fn without_delay(plant: &PlantSpec) -> PlantSpec {
    let PlantSpec::Parameters { rig, display_unit } = *plant else { return *plant };
    let pumps = rig.pumps.map(|pump| Pump { delay_s: 0.0, ..pump });
    PlantSpec::Parameters { rig: QuadrupleTank { pumps, ..rig }, display_unit }
}

pub fn model_free_setup(steps: usize) -> impl Strategy<Value = ModelFreeSetup> {
    let start = prop_oneof![Just(StartSpec::Empty), pair(limits::LEVEL).prop_map(StartSpec::Rest)];
    (plant(), [valve(), valve()], start, law(), prop::option::of(controller()), experiment(steps)).prop_map(
        |(plant, valves, start, controller, compare, experiment)| ModelFreeSetup {
            plant: without_delay(&plant),
            valves: valves.map(|valve| turning_within(valve, limits::valve_frequency(experiment.duration_s))),
            start,
            controller,
            compare,
            experiment,
        },
    )
}

pub fn model_free(steps: usize) -> impl Strategy<Value = ModelFreeScenario> {
    (model_free_setup(steps), prop::option::of(within(limits::TIME_S)))
        .prop_map(|(model_free, cursor_s)| ModelFreeScenario { cursor_s, ..ModelFreeScenario::from(model_free) })
}
