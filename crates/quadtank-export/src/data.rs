//! The parameters of an experiment, by the names that all templates give them.

use std::array::from_fn;

use quadtank::control::{AntiWindup, LoopMode, PiSettings};
use quadtank::plant::{OperatingPoint, Pump, Tank};
use quadtank::sim::Load;
use quadtank::study::quadruple_tank::{OperatingPointSpec, Setup};

/// Something that a script gives a name.
pub struct Item {
    /// In snake case; Python and Julia write it in capitals.
    pub name: &'static str,
    pub value: Value,
    /// What it is, with its unit.
    pub comment: &'static str,
}

/// A value that every language can write.
pub enum Value {
    Number(f64),
    Numbers(Vec<f64>),
    Matrix {
        rows: Vec<Vec<f64>>,
        columns: usize,
    },
    /// Indices from 0, which a language may count from 1.
    Indices([usize; 2]),
    /// Changes by time (s), index from 0 of what changes, and size.
    Changes(Vec<(f64, usize, f64)>),
    Flag(bool),
    Flags([bool; 2]),
    Missing,
}

/// Items that belong together.
pub struct Section {
    pub title: &'static str,
    pub items: Vec<Item>,
}

/// A parameter of a script: its name, its value, and the comment with its unit.
pub fn item(name: &'static str, value: Value, comment: &'static str) -> Item {
    Item { name, value, comment }
}

/// Flow that no pump has (m³/s), for a pump without a largest flow.
const NO_LIMIT: f64 = 1e9;

/// Rig, operating point, controller and experiment of a setup.
pub fn sections(setup: &Setup) -> [Section; 4] {
    [rig(setup), operating_point(setup), controller(setup), experiment(setup)]
}

fn rig(setup: &Setup) -> Section {
    let plant = setup.plant();
    let tanks = |of: fn(&Tank) -> f64| Value::Numbers(plant.tanks.iter().map(of).collect());
    let pumps = |of: fn(&Pump) -> f64| Value::Numbers(plant.pumps.iter().map(of).collect());
    Section {
        title: "The rig: tanks 1 to 4, pumps 1 and 2.",
        items: vec![
            item("tank_area", tanks(|tank| tank.section.area_at_empty), "cross-section at the bottom (m^2)"),
            item("tank_area_slope", tanks(|tank| tank.section.area_slope), "its growth with the level (m^2/m)"),
            item("outlet_area", tanks(|tank| tank.outlet.area), "a (m^2)"),
            item("loss_coefficient", tanks(|tank| tank.outlet.loss_coefficient), "k_l"),
            item("tank_height", tanks(|tank| tank.height), "top of the walls (m)"),
            item("pump_gain", pumps(|pump| pump.gain), "k (m^3/(s V))"),
            item("pump_min", pumps(|pump| pump.voltage_min), "lowest voltage (V)"),
            item("pump_max", pumps(|pump| pump.voltage_max), "highest voltage (V)"),
            item("pump_offset", pumps(|pump| pump.offset), "flow of the straight line of the curve at 0 V (m^3/s)"),
            item("pump_start", pumps(|pump| pump.start_voltage), "voltage below which the pump gives nothing (V)"),
            item(
                "pump_flow_max",
                pumps(|pump| pump.flow_max.unwrap_or(NO_LIMIT)),
                "largest flow (m^3/s); 1e9 for none",
            ),
            item("pump_delay", pumps(|pump| pump.delay_s), "transport delay of the hose behind the pump (s)"),
            item(
                "gamma",
                Value::Numbers(plant.valves.to_vec()),
                "share of each pump that goes to its lower tank, as its flow goes to 0",
            ),
            item(
                "gamma_slope",
                Value::Numbers(plant.valve_slopes.to_vec()),
                "growth of gamma with the flow through the valve (s/m^3)",
            ),
            item("power_gain", Value::Number(plant.power_gain), "pump voltage per controller output"),
            item("sensor_gain", Value::Number(plant.sensor.gain), "k_c (V/m)"),
            item("sensor_range", Value::Number(plant.sensor.range), "highest level that is measured (m)"),
            item("sensor_resolution", Value::Number(plant.sensor.resolution), "smallest change of the signal (V)"),
            item("gravity", Value::Number(plant.gravity), "g (m/s^2)"),
            item("inflow", Value::Numbers(plant.inflow.to_vec()), "constant flow into each tank from outside (m^3/s)"),
        ],
    }
}

fn operating_point(setup: &Setup) -> Section {
    let (mut rest_voltage, mut rest_level, mut state_level, mut state_voltage) = (None, None, None, None);
    match setup.operating_point {
        OperatingPointSpec::PumpVoltage(voltage) => rest_voltage = Some(voltage.to_vec()),
        OperatingPointSpec::Levels(level) => rest_level = Some(level.to_vec()),
        OperatingPointSpec::State(OperatingPoint { levels, pump_voltage }) => {
            (state_level, state_voltage) = (Some(levels.to_vec()), Some(pump_voltage.to_vec()));
        }
    }
    let given = |numbers: Option<Vec<f64>>| numbers.map_or(Value::Missing, Value::Numbers);
    Section {
        title: "The operating point: voltages or levels at rest are given and the others follow, or a state that may not be at rest.",
        items: vec![
            item("rest_voltage", given(rest_voltage), "voltages of pumps 1 and 2 at rest (V)"),
            item("rest_level", given(rest_level), "levels of tanks 1 and 2 at rest (m)"),
            item("state_level", given(state_level), "levels of tanks 1 to 4 of a given state (m)"),
            item("state_voltage", given(state_voltage), "voltages of pumps 1 and 2 that belong to it (V)"),
        ],
    }
}

fn controller(setup: &Setup) -> Section {
    let controller = &setup.controller;
    let loops = |of: &dyn Fn(&PiSettings) -> f64| Value::Numbers(controller.loops.iter().map(of).collect());
    let manual = |settings: &PiSettings| match settings.mode {
        LoopMode::Automatic => (0.0, 0.0),
        LoopMode::Manual { output, until_s } => (output, until_s),
    };
    let acts = |settings: PiSettings| settings.anti_windup != AntiWindup::Off;
    let ratio = |settings: &PiSettings| match settings.anti_windup {
        AntiWindup::Off => 0.0,
        AntiWindup::BackCalculation { tracking_ratio } => tracking_ratio,
    };
    Section {
        title: "The controller: PI loops of levels 1 and 2, and the pump that each of them drives.",
        items: vec![
            item("pump_of_loop", Value::Indices(from_fn(|i| controller.pairing.pump_of(i))), "the pairing"),
            item("gain", loops(&|pi| pi.gain), "K (V/V)"),
            item("integral_time", loops(&|pi| pi.integral_time_s), "Ti (s)"),
            item("set_point_weight", loops(&|pi| pi.set_point_weight), "b"),
            item("anti_windup", Value::Flags(controller.loops.map(acts)), "back-calculation, or nothing"),
            item("tracking_ratio", loops(&ratio), "Tt/Ti"),
            item("manual_output", loops(&|pi| manual(pi).0), "controller output in manual mode (V)"),
            item("manual_until", loops(&|pi| manual(pi).1), "end of manual mode (s); 0 for none"),
            item("sampling_time", Value::Number(controller.sampling_time_s), "Ts (s)"),
        ],
    }
}

fn experiment(setup: &Setup) -> Section {
    let experiment = &setup.experiment;
    let moves = experiment.pump_voltage_steps.iter().map(|step| (step.time_s, step.pump, step.voltage)).collect();
    let initial_level = experiment.initial_levels.map_or(Value::Missing, |levels| Value::Numbers(levels.to_vec()));
    let steps = experiment.set_point_steps.iter().map(|step| (step.time_s, step.level, step.size)).collect();
    let acting = experiment.all_loads(setup.plant().inflow);
    let loads = |of: &dyn Fn(Load) -> Option<(usize, f64)>| {
        let kind = acting.iter().filter_map(|step| of(step.load).map(|(index, size)| (step.time_s, index, size)));
        Value::Changes(in_order(kind.collect()))
    };
    Section {
        title: "The experiment: steps and loads in the order of their times, each of which stays.",
        items: vec![
            item("set_point_steps", Value::Changes(in_order(steps)), "time (s), loop, change of its reference (m)"),
            item("pump_loads", loads(&pump_flow), "time (s), pump, additional flow (m^3/s)"),
            item("tank_flows", loads(&tank_flow), "time (s), tank, additional flow from outside (m^3/s)"),
            item("leaks", loads(&leak), "time (s), tank, area of the hole (m^2)"),
            item("pump_gain_changes", loads(&pump_gain), "time (s), pump, share by which its flow grows"),
            item("valve_changes", loads(&valve), "time (s), valve, change of gamma"),
            item("outlet_changes", loads(&outlet), "time (s), tank, share by which its outlet widens"),
            item("initial_level", initial_level, "levels at the start (m); none for those at rest"),
            item(
                "pump_moves",
                Value::Changes(in_order(moves)),
                "time (s), pump that is moved by hand, its voltage from then on (V)",
            ),
            item(
                "quantised",
                Value::Flag(experiment.measurement.quantised),
                "whether sensors have range and resolution",
            ),
        ],
    }
}

fn pump_flow(load: Load) -> Option<(usize, f64)> {
    if let Load::PumpFlow { pump, flow } = load { Some((pump, flow)) } else { None }
}

fn tank_flow(load: Load) -> Option<(usize, f64)> {
    if let Load::TankFlow { tank, flow } = load { Some((tank, flow)) } else { None }
}

fn leak(load: Load) -> Option<(usize, f64)> {
    if let Load::Leak { tank, area } = load { Some((tank, area)) } else { None }
}

fn pump_gain(load: Load) -> Option<(usize, f64)> {
    if let Load::PumpGain { pump, change } = load { Some((pump, change)) } else { None }
}

fn valve(load: Load) -> Option<(usize, f64)> {
    if let Load::Valve { valve, change } = load { Some((valve, change)) } else { None }
}

fn outlet(load: Load) -> Option<(usize, f64)> {
    if let Load::Outlet { tank, change } = load { Some((tank, change)) } else { None }
}

fn in_order(mut changes: Vec<(f64, usize, f64)>) -> Vec<(f64, usize, f64)> {
    changes.sort_by(|one, other| one.0.total_cmp(&other.0));
    changes
}
