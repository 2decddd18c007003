use super::Scale::{Linear, Logarithmic};
use super::{List, Param, Scale};
use crate::Scenario;
use crate::codec::NEWEST;
use crate::level_loop::LevelLoopScenario;
use crate::limits::{self, Limits};
use crate::tuning::TuningScenario;

const fn row(path: &'static str, unit: &'static str, limits: Limits, scale: Scale, description: &'static str) -> Param {
    Param { path, unit, limits, scale, description }
}

/// Indices count from 0.
const INDEX_OF_PAIR: Limits = Limits::new(0.0, 1.0);
const INDEX_OF_TANK: Limits = Limits::new(0.0, 3.0);
const VERSION: Limits = Limits::new(1.0, NEWEST as f64);

/// Unit of a time of a session: that of its plant.
const OWN_TIME: &str = "unit of time of the plant";
/// Unit of a signal of a level loop: that of its range.
const OWN_SIGNAL: &str = "unit of the signal";
/// Unit of a gain of a level controller.
const PER_SIGNAL: &str = "signal per signal";

/// Every number of every document. Where the same path means something else in a level loop, the row of the level loop begins with
/// `level_loop.`.
#[rustfmt::skip]
pub const PARAMS: &[Param] = &[
    row("version", "", VERSION, Linear, "Version of the document: which bench it is for"),

    // The rig.
    row("plant.parameters.rig.tanks[].section.area_at_empty", "m²", limits::TANK_AREA, Logarithmic, "Cross-section of the tank at its bottom"),
    row("plant.parameters.rig.tanks[].section.area_slope", "m²/m", limits::TANK_AREA_SLOPE, Linear, "Growth of the cross-section with the level; 0 for straight walls"),
    row("plant.parameters.rig.tanks[].outlet.area", "m²", limits::OUTLET_AREA, Logarithmic, "Area of the outlet of the tank"),
    row("plant.parameters.rig.tanks[].outlet.loss_coefficient", "", limits::LOSS_COEFFICIENT, Linear, "Share of Torricelli's flow that the outlet lets through; 1 for an ideal outlet"),
    row("plant.parameters.rig.tanks[].height", "m", limits::TANK_HEIGHT, Linear, "Height of the walls; water above them overflows"),
    row("plant.parameters.rig.pumps[].gain", "m³/(s V)", limits::PUMP_GAIN, Logarithmic, "Flow of the pump for each volt"),
    row("plant.parameters.rig.pumps[].voltage_min", "V", limits::PUMP_VOLTAGE, Linear, "Lowest voltage of the pump"),
    row("plant.parameters.rig.pumps[].voltage_max", "V", limits::PUMP_VOLTAGE, Linear, "Highest voltage of the pump"),
    row("plant.parameters.rig.pumps[].offset", "m³/s", limits::PUMP_OFFSET, Linear, "Flow that the straight line of the pump curve has at 0 V; absent for 0"),
    row("plant.parameters.rig.pumps[].start_voltage", "V", limits::PUMP_VOLTAGE, Linear, "Dead zone: voltage below which the pump gives nothing; absent for 0"),
    row("plant.parameters.rig.pumps[].flow_max", "m³/s", limits::PUMP_FLOW_MAX, Logarithmic, "Largest flow of the pump; absent where the voltage alone limits it"),
    row("plant.parameters.rig.pumps[].delay_s", "s", limits::PUMP_DELAY_S, Linear, "Transport delay of the hose behind the pump: what its voltage does reaches the tanks that much later; absent for 0, and refused on the model-free bench"),
    row("plant.parameters.rig.valves[]", "", limits::VALVE, Linear, "Valve fractions γ1, γ2 of the rig; those of the setup take their place"),
    row("plant.parameters.rig.valve_slopes[]", "s/m³", limits::VALVE_SLOPE, Linear, "Growth of the valve fraction with the flow through the valve, from γ as that goes to 0, within 0 to 1; absent for none"),
    row("plant.parameters.rig.power_gain", "", limits::POWER_GAIN, Logarithmic, "Gain between controller output and pump voltage; 1 without a power module"),
    row("plant.parameters.rig.sensor.gain", "V/m", limits::SENSOR_GAIN, Logarithmic, "Signal of a level sensor for each metre"),
    row("plant.parameters.rig.sensor.range", "m", limits::SENSOR_RANGE, Linear, "Level above which a quantised signal saturates"),
    row("plant.parameters.rig.sensor.resolution", "V", limits::SENSOR_RESOLUTION, Linear, "Smallest difference of a quantised signal; 0 for an ideal sensor"),
    row("plant.parameters.rig.gravity", "m/s²", limits::GRAVITY, Linear, "Acceleration of gravity"),

    row("plant.parameters.rig.inflow[]", "m³/s", limits::INFLOW, Linear, "Constant flow that the tank receives from outside of the rig; absent for none"),

    // Where it stands.
    row("valves[]", "", limits::VALVE, Linear, "Valve fractions γ1, γ2: the share of the flow of each pump that goes to the lower tank"),
    row("operating_point.pump_voltage[]", "V", limits::PUMP_VOLTAGE, Linear, "Voltages of pumps 1 and 2 at rest; the levels follow"),
    row("operating_point.levels[]", "m", limits::LEVEL, Linear, "Levels of tanks 1 and 2 at rest; the voltages follow"),
    row("operating_point.state.levels[]", "m", limits::LEVEL, Linear, "Levels of tanks 1 to 4 that the run begins at and the linear model is taken around, at rest or not"),
    row("operating_point.state.pump_voltage[]", "V", limits::PUMP_VOLTAGE, Linear, "Voltages of pumps 1 and 2 that belong to these levels"),

    // Two PI loops.
    row("controller.loops[].gain", "V/V", limits::GAIN, Logarithmic, "Gain K of the loop, of either sign but not 0"),
    row("controller.loops[].integral_time_s", "s", limits::INTEGRAL_TIME_S, Logarithmic, "Integral time Ti of the loop"),
    row("controller.loops[].set_point_weight", "", limits::SET_POINT_WEIGHT, Linear, "Set-point weight b in the proportional part"),
    row("controller.loops[].anti_windup.back_calculation.tracking_ratio", "", limits::TRACKING_RATIO, Logarithmic, "Tracking time over integral time, Tt/Ti"),
    row("controller.loops[].mode.manual.output", "V", limits::MANUAL_OUTPUT, Linear, "Controller output in manual mode"),
    row("controller.loops[].mode.manual.until_s", "s", limits::TIME_S, Linear, "Time at which the controller takes over"),
    row("controller.sampling_time_s", "s", limits::SAMPLING_TIME_S, Logarithmic, "Sampling time Ts of both loops"),

    // The model-free law.
    row("controller.loops[].model_gain", "m/(s V)", limits::MODEL_GAIN, Logarithmic, "Gain α̂ of the ultra-local model"),
    row("controller.loops[].proportional", "1/s", limits::MODEL_FREE_FEEDBACK, Logarithmic, "Proportional gain Kp of the law"),
    row("controller.loops[].integral", "1/s²", limits::MODEL_FREE_FEEDBACK, Logarithmic, "Integral gain Ki of the law"),
    row("controller.loops[].anti_windup.back_calculation.tracking_time_s", "s", limits::INTEGRAL_TIME_S, Logarithmic, "Tracking time Tt of the anti-windup"),
    row("controller.estimator.window_s", "s", limits::WINDOW_S, Linear, "Length T of the window of the estimator: a whole number of samples, two at least"),
    row("start.rest[]", "m", limits::LEVEL, Linear, "Levels of tanks 1 and 2 at which the run begins at rest"),
    row("valves[].constant.gamma", "", limits::VALVE, Linear, "Valve fraction γ"),
    row("valves[].step.from", "", limits::VALVE, Linear, "Valve fraction γ before the step"),
    row("valves[].step.to", "", limits::VALVE, Linear, "Valve fraction γ after the step"),
    row("valves[].step.at_s", "s", limits::TIME_S, Linear, "Time of the step"),
    row("valves[].ramp.from", "", limits::VALVE, Linear, "Valve fraction γ before the ramp"),
    row("valves[].ramp.to", "", limits::VALVE, Linear, "Valve fraction γ after the ramp"),
    row("valves[].ramp.begin_s", "s", limits::TIME_S, Linear, "Time at which the ramp begins"),
    row("valves[].ramp.end_s", "s", limits::TIME_S, Linear, "Time at which the ramp ends, not before it begins"),
    row("valves[].sine.mean", "", limits::VALVE, Linear, "Mean of the valve fraction γ"),
    row("valves[].sine.amplitude", "", limits::VALVE_AMPLITUDE, Linear, "Amplitude of the valve fraction γ, which stays from 0 to 1"),
    row("valves[].sine.frequency", "rad/s", limits::VALVE_FREQUENCY, Linear, "Angular frequency ω of the swing"),
    row("valves[].sine.phase", "rad", limits::VALVE_PHASE, Linear, "Phase of the swing at the beginning"),

    // The experiment.
    row("experiment.duration_s", "s", limits::DURATION_S, Logarithmic, "Duration of the experiment: at most 20 000 samples"),
    row("experiment.set_point_steps[].level", "", INDEX_OF_PAIR, Linear, "Index of the level whose reference steps: 0 for tank 1, 1 for tank 2"),
    row("experiment.set_point_steps[].time_s", "s", limits::TIME_S, Linear, "Time of the step"),
    row("experiment.set_point_steps[].size", "m", limits::SET_POINT_STEP, Linear, "How far the reference steps, of either sign"),
    row("experiment.load_steps[].time_s", "s", limits::TIME_S, Linear, "Time from which the load acts"),
    row("experiment.load_steps[].load.pump_flow.pump", "", INDEX_OF_PAIR, Linear, "Index of the pump: 0 for pump 1, 1 for pump 2"),
    row("experiment.load_steps[].load.pump_flow.flow", "m³/s", limits::LOAD_FLOW, Linear, "Flow added to that of the pump, ahead of its valve"),
    row("experiment.load_steps[].load.leak.tank", "", INDEX_OF_TANK, Linear, "Index of the tank, 0 to 3 for tanks 1 to 4"),
    row("experiment.load_steps[].load.leak.area", "m²", limits::LEAK_AREA, Linear, "Area of the hole in the bottom of the tank"),
    row("experiment.load_steps[].load.tank_flow.tank", "", INDEX_OF_TANK, Linear, "Index of the tank, 0 to 3 for tanks 1 to 4"),
    row("experiment.load_steps[].load.tank_flow.flow", "m³/s", limits::LOAD_FLOW, Linear, "Flow into the tank from outside of the rig, added to its constant inflow"),
    row("experiment.load_steps[].load.pump_gain.pump", "", INDEX_OF_PAIR, Linear, "Index of the pump: 0 for pump 1, 1 for pump 2"),
    row("experiment.load_steps[].load.pump_gain.change", "", limits::LOAD_SHARE, Linear, "Share by which the flow of the pump grows at any voltage; -1 stops it"),
    row("experiment.load_steps[].load.valve.valve", "", INDEX_OF_PAIR, Linear, "Index of the valve: 0 for valve 1, 1 for valve 2"),
    row("experiment.load_steps[].load.valve.change", "", limits::LOAD_SHARE, Linear, "Change of the valve fraction γ, which stays from 0 to 1"),
    row("experiment.load_steps[].load.outlet.tank", "", INDEX_OF_TANK, Linear, "Index of the tank, 0 to 3 for tanks 1 to 4"),
    row("experiment.load_steps[].load.outlet.change", "", limits::LOAD_SHARE, Linear, "Share by which the outlet of the tank widens; -1 closes it"),
    row("experiment.initial_levels[]", "m", limits::LEVEL, Linear, "Levels of tanks 1 to 4 that the run begins at, within the walls; absent for those of the operating point"),
    row("experiment.pump_voltage_steps[].pump", "", INDEX_OF_PAIR, Linear, "Index of the pump that is moved by hand: 0 for pump 1, 1 for pump 2. A pump with a step here follows no controller"),
    row("experiment.pump_voltage_steps[].time_s", "s", limits::TIME_S, Linear, "Time of the step: the first sample at or after it"),
    row("experiment.pump_voltage_steps[].voltage", "V", limits::PUMP_VOLTAGE, Linear, "Voltage of the pump from then on, held within its limits"),
    row("experiment.inflow_steps[].tank", "", INDEX_OF_TANK, Linear, "Index of the tank that receives water from outside, 0 to 3 for tanks 1 to 4"),
    row("experiment.inflow_steps[].time_s", "s", limits::TIME_S, Linear, "Time from which it receives this flow"),
    row("experiment.inflow_steps[].flow", "m³/s", limits::INFLOW, Linear, "Flow from then on, in the place of the constant inflow of the rig: a measured disturbance"),
    row("experiment.pump_flow_noise_std", "m³/s", limits::PUMP_FLOW_NOISE_STD, Linear, "Process noise: standard deviation of the white noise on the flow of each pump, held from sample to sample; absent for none"),
    row("experiment.measurement.noise_std", "m", limits::NOISE_STD, Linear, "Standard deviation of the white noise at each sample; 0 for none"),
    row("experiment.measurement.seed", "", limits::SEED, Linear, "Seed of the noise: the same seed gives the same run"),

    // What is shown.
    row("view.cursor_s", "s", limits::TIME_S, Linear, "Time at which the cursor stands; null at rest"),
    row("view.zoom_s[]", "s", limits::TIME_S, Linear, "Begin and end of the shown part of the time axis; null for all of it"),
    row("cursor_s", "s", limits::TIME_S, Linear, "Time at which the cursor stands; absent at the end"),

    // The plant of a relay-tuning session.
    row("plant.quadruple_tank.valves[]", "", limits::VALVE, Linear, "Valve fractions γ1, γ2; null for those of the rig"),
    row("plant.quadruple_tank.dead_time_s", "s", limits::TUNING_NOT_NEGATIVE, Linear, "Dead time of every element; 0 on the nonlinear plant"),
    row("plant.quadruple_tank.lag_s", "s", limits::TUNING_NOT_NEGATIVE, Linear, "Time constant of a lag in every element; 0 on the nonlinear plant"),
    row("plant.parameters.pump_voltage[]", "V", limits::PUMP_VOLTAGE, Linear, "Voltages of pumps 1 and 2 at rest"),
    row("plant.parameters.dead_time_s", "s", limits::TUNING_NOT_NEGATIVE, Linear, "Dead time of every element, besides that of the hoses; 0 on the nonlinear plant"),
    row("plant.parameters.lag_s", "s", limits::TUNING_NOT_NEGATIVE, Linear, "Time constant of a lag in every element; 0 on the nonlinear plant"),
    row("plant.elements[][].numerator[]", "", limits::COEFFICIENT, Linear, "Coefficients of the numerator by rising powers of s: [2, 1] is 2 + s"),
    row("plant.elements[][].denominator[]", "", limits::COEFFICIENT, Linear, "Coefficients of the denominator by rising powers of s: [1, 10] is 1 + 10 s"),
    row("plant.elements[][].dead_time", OWN_TIME, limits::TUNING_NOT_NEGATIVE, Linear, "Dead time of the element"),

    // The relay test.
    row("test.number", "", limits::ONE_OR_TWO, Linear, "Number of the loop of a single test, 1 or 2"),
    row("test.behind.modulus", "", limits::TUNING_POSITIVE, Logarithmic, "Modulus r of the point of the frequency response that the test finds"),
    row("test.amplitudes[]", "unit of the inputs", limits::TUNING_POSITIVE, Logarithmic, "Amplitudes d1, d2 of the relays"),
    row("test.hysteresis[]", "unit of the outputs", limits::TUNING_NOT_NEGATIVE, Linear, "Half widths ε1, ε2 of the hysteresis of the relays"),
    row("test.bias[]", "unit of the inputs", limits::TUNING_VALUE, Linear, "Means of the relay outputs"),
    row("test.detuning[]", "", limits::TUNING_POSITIVE, Logarithmic, "Factors f1, f2 by which the loops of independent tests are made weaker"),
    row("test.passes", "", limits::PASSES, Linear, "Passes of a sequential test"),
    row("test.duration", OWN_TIME, limits::TUNING_POSITIVE, Logarithmic, "Duration of the record"),
    row("test.release", OWN_TIME, limits::TUNING_NOT_NEGATIVE, Linear, "Time at which the relays begin to switch, within the record"),
    row("test.step", OWN_TIME, limits::TUNING_NOT_NEGATIVE, Linear, "Time between the rows of the record: at most 100 000 rows"),

    // The design and its response.
    row("design.critical.importance", "", limits::TUNING_POSITIVE, Logarithmic, "Importance r2 of loop 2 at the critical point"),
    row("design.critical.point.gains[]", "", limits::TUNING_VALUE, Linear, "Critical gains kc1, kc2"),
    row("design.critical.point.period", OWN_TIME, limits::TUNING_POSITIVE, Logarithmic, "Critical period Tc"),
    row("design.target[]", "", limits::TUNING_VALUE, Linear, "Target λ of the placement: real and imaginary part"),
    row("design.root", "", limits::ONE_OR_TWO, Linear, "Root of the placement, 1 or 2; root 1 has the larger controller in loop 1"),
    row("design.controllers[].gain", "unit of an input per unit of an output", limits::TUNING_VALUE, Logarithmic, "Gain K of the given controller, of either sign; 0 leaves its loop open; kp in the parallel form"),
    row("design.controllers[].integral_time", OWN_TIME, limits::TUNING_POSITIVE, Logarithmic, "Integral time Ti of the given controller; absent without integral action, and in the parallel form"),
    row("design.controllers[].derivative_time", OWN_TIME, limits::TUNING_NOT_NEGATIVE, Linear, "Derivative time Td of the given controller; 0 for PI, and in the parallel form"),
    row("design.controllers[].integral_gain", "unit of an input per unit of an output and of time", limits::TUNING_VALUE, Logarithmic, "Integral gain ki of the given controller in the parallel form"),
    row("design.controllers[].derivative_gain", "unit of an input and of time per unit of an output", limits::TUNING_VALUE, Logarithmic, "Derivative gain kd of the given controller in the parallel form"),
    row("design.controllers[].filter_time", OWN_TIME, limits::TUNING_POSITIVE, Logarithmic, "Time constant Tf of its derivative filter; a hundredth of the derivative time where it is absent"),
    row("response.references[]", "unit of the outputs", limits::TUNING_VALUE, Linear, "References of both loops, from the start on"),
    row("response.duration", OWN_TIME, limits::TUNING_POSITIVE, Logarithmic, "Duration of the response"),
    row("response.step", OWN_TIME, limits::TUNING_NOT_NEGATIVE, Linear, "Sampling time of the controllers: at most 100 000 samples"),

    // The plant of a level loop.
    row("plant.parameters.tank.area", "m²", limits::LEVEL_TANK_AREA, Logarithmic, "Cross-section A of the tank"),
    row("plant.parameters.tank.height", "m", limits::LEVEL_TANK_HEIGHT, Linear, "Height of the walls; what comes in above them is lost"),
    row("plant.parameters.tank.outflow.linear.resistance", "s/m²", limits::RESISTANCE, Logarithmic, "Resistance R of a laminar outlet, q = h/R"),
    row("plant.parameters.tank.outflow.square_root.coefficient", "m^2.5/s", limits::FLOW_COEFFICIENT, Logarithmic, "Coefficient k of a turbulent outlet, q = k √h"),
    row("plant.parameters.tank.outflow.pumped.flow", "m³/s", limits::FLOW, Linear, "Flow that a pump draws at every level"),
    row("plant.parameters.transmitter.level_range[]", "m", limits::TRANSMITTER_LEVEL, Linear, "Levels at the lower and at the upper end of the transmitter signal"),
    row("plant.parameters.transmitter.signal.low", OWN_SIGNAL, limits::SIGNAL, Linear, "Lower end of the transmitter signal"),
    row("plant.parameters.transmitter.signal.high", OWN_SIGNAL, limits::SIGNAL, Linear, "Upper end of the transmitter signal"),
    row("plant.parameters.transmitter.lag_s", "s", limits::LAG_S, Linear, "Time constant of the transmitter; 0 for one that follows at once"),
    row("plant.parameters.output.signal.low", OWN_SIGNAL, limits::SIGNAL, Linear, "Lower end of the controller output"),
    row("plant.parameters.output.signal.high", OWN_SIGNAL, limits::SIGNAL, Linear, "Upper end of the controller output"),
    row("plant.parameters.converter.input.low", OWN_SIGNAL, limits::SIGNAL, Linear, "Lower end of what goes into the converter"),
    row("plant.parameters.converter.input.high", OWN_SIGNAL, limits::SIGNAL, Linear, "Upper end of what goes into the converter"),
    row("plant.parameters.converter.output.low", OWN_SIGNAL, limits::SIGNAL, Linear, "Lower end of what comes out of the converter"),
    row("plant.parameters.converter.output.high", OWN_SIGNAL, limits::SIGNAL, Linear, "Upper end of what comes out of the converter"),
    row("plant.parameters.actuator.lag_s", "s", limits::LAG_S, Linear, "Time constant of the actuator; 0 for one that follows at once"),
    row("plant.parameters.actuator.curve[][]", "", limits::SIGNAL, Linear, "Points of the actuator curve by rising pressure, each the pressure in the unit of the converter output (of the controller output without a converter), then the travel from 0 to 1; travel rises or falls all along"),
    row("plant.parameters.valve.characteristic.equal_percentage.rangeability", "", limits::RANGEABILITY, Logarithmic, "Rangeability R of the valve, f = R^(X − 1)"),
    row("plant.parameters.valve.place.inlet.full_flow", "m³/s", limits::FULL_FLOW, Logarithmic, "Flow of the open valve in the feed"),

    // Its step test, objective and rules.
    row("test.level", "m", limits::TANK_LEVEL, Linear, "Level at which the step test begins at rest"),
    row("test.inflow", "m³/s", limits::FLOW, Linear, "Inflow during the step test"),
    row("level_loop.test.step", OWN_SIGNAL, limits::SIGNAL, Linear, "Step of the controller output, of either sign"),
    row("test.step_time_s", "s", limits::TIME_S, Linear, "Time of the step"),
    row("test.return_time_s", "s", limits::TIME_S, Linear, "Time at which the output steps back; absent for one step"),
    row("test.duration_s", "s", limits::LEVEL_DURATION_S, Logarithmic, "Duration of the step test"),
    row("test.method.one_point.dead_time_s", "s", limits::TIME_S, Linear, "Dead time as it is read by eye"),
    row("objective.averaging.band[]", "m", limits::TANK_LEVEL, Linear, "Lowest and highest level of averaging control"),
    row("closed_loop_time_s", "s", limits::LEVEL_TIME_S, Logarithmic, "Closed-loop time constant that is asked of SIMC (τc) and of Lambda tuning (λ)"),

    // Its controller, and the tuning that it is held against.
    row("controller.manual.steps[].time_s", "s", limits::TIME_S, Linear, "Time of the step of the output"),
    row("controller.manual.steps[].size", OWN_SIGNAL, limits::SIGNAL, Linear, "How far the output steps, of either sign"),
    row("controller.pi.gain", PER_SIGNAL, limits::LEVEL_GAIN, Logarithmic, "Gain Kp of either sign; 0 leaves the level alone"),
    row("controller.pi.integral_time_s", "s", limits::LEVEL_TIME_S, Logarithmic, "Integral time Ti"),
    row("controller.pi.anti_windup.back_calculation.tracking_ratio", "", limits::TRACKING_RATIO, Logarithmic, "Tracking time over integral time, Tt/Ti"),
    row("controller.pid.proportional", PER_SIGNAL, limits::LEVEL_GAIN, Logarithmic, "P of the parallel PID controller, of either sign"),
    row("controller.pid.integral", "1/s", limits::LEVEL_GAIN, Logarithmic, "I of the parallel PID controller, of either sign; 0 for none"),
    row("controller.pid.derivative", "s", limits::LEVEL_GAIN, Logarithmic, "D of the parallel PID controller, of either sign; 0 for none"),
    row("controller.pid.filter_time_s", "s", limits::LEVEL_TIME_S, Logarithmic, "Time constant of the derivative filter"),
    row("controller.sampled.settings.gain", PER_SIGNAL, limits::LEVEL_GAIN, Logarithmic, "Gain K of the sampled controller, of either sign; 0 leaves the level alone"),
    row("controller.sampled.settings.integral_time_s", "s", limits::LEVEL_TIME_S, Logarithmic, "Integral time Ti of the sampled controller"),
    row("controller.sampled.settings.set_point_weight", "", limits::SET_POINT_WEIGHT, Linear, "Set-point weight b in the proportional part"),
    row("controller.sampled.settings.anti_windup.back_calculation.tracking_ratio", "", limits::TRACKING_RATIO, Logarithmic, "Tracking time over integral time, Tt/Ti"),
    row("controller.sampled.settings.mode.manual.output", OWN_SIGNAL, limits::SIGNAL, Linear, "Controller output in manual mode"),
    row("controller.sampled.settings.mode.manual.until_s", "s", limits::TIME_S, Linear, "Time at which the controller takes over"),
    row("controller.sampled.sampling_time_s", "s", limits::LEVEL_STEP_S, Logarithmic, "Sampling time Ts; the nearest multiple of a step of the integration is meant"),
    row("reference.gain", PER_SIGNAL, limits::LEVEL_GAIN, Logarithmic, "Gain Kp of the tuning that the controller is held against"),
    row("reference.integral_time_s", "s", limits::LEVEL_TIME_S, Logarithmic, "Integral time Ti of that tuning"),
    row("model_error.area_factor", "", limits::MODEL_FACTOR, Logarithmic, "Area of the model, on which that tuning is run, over that of the plant"),
    row("model_error.flow_factor", "", limits::MODEL_FACTOR, Logarithmic, "Flows of that model over those of the plant, the ratio of the valve coefficients"),

    // Its experiment.
    row("experiment.level", "m", limits::TANK_LEVEL, Linear, "Level at which the run begins at rest, and its set-point"),
    row("experiment.inflow", "m³/s", limits::FLOW, Linear, "Inflow at the start"),
    row("level_loop.experiment.duration_s", "s", limits::LEVEL_DURATION_S, Logarithmic, "Duration of the experiment"),
    row("experiment.log_step_s", "s", limits::LEVEL_STEP_S, Logarithmic, "Time between the rows of the log: at most 20 000 rows"),
    row("experiment.disturbance.from_s", "s", limits::TIME_S, Linear, "Time at which the disturbance of the inflow begins"),
    row("experiment.disturbance.until_s", "s", limits::TIME_S, Linear, "Time at which it ends, not before it begins"),
    row("experiment.disturbance.signal.step.size", "m³/s", limits::FLOW_CHANGE, Linear, "How far the inflow steps, of either sign; an inflow below 0 counts as none"),
    row("experiment.disturbance.signal.sine.amplitude", "m³/s", limits::FLOW_CHANGE, Linear, "Amplitude of the sine on the inflow"),
    row("experiment.disturbance.signal.sine.period_s", "s", limits::LEVEL_STEP_S, Logarithmic, "Period of the sine"),
    row("experiment.disturbance.signal.simulink_normal.std", "m³/s", limits::FLOW, Linear, "Standard deviation of the random values"),
    row("experiment.disturbance.signal.simulink_normal.sample_time_s", "s", limits::LEVEL_STEP_S, Logarithmic, "How long a random value is held"),
    row("experiment.disturbance.signal.simulink_normal.seed", "", limits::SEED, Linear, "Seed of the block: the same seed gives the same run"),
    row("experiment.disturbance.signal.normal.std", "m³/s", limits::FLOW, Linear, "Standard deviation of the random values"),
    row("experiment.disturbance.signal.normal.sample_time_s", "s", limits::LEVEL_STEP_S, Logarithmic, "How long a random value is held"),
    row("experiment.disturbance.signal.normal.seed", "", limits::SEED, Linear, "Seed of the random values: the same seed gives the same run"),
    row("level_loop.experiment.set_point_steps[].size", "m, or unit of the signal", limits::SIGNAL, Linear, "How far the set-point steps, of either sign: the level, or with the scale `signal` the transmitter signal that it stands for"),

    // Its search and its Harris index.
    row("search.gain[]", PER_SIGNAL, limits::LEVEL_GAIN_MAGNITUDE, Logarithmic, "Smallest and largest gain of the search"),
    row("search.integral_time_s[]", "s", limits::LEVEL_TIME_S, Logarithmic, "Smallest and largest integral time of the search"),
    row("search.move_penalty", "unit of the cost per squared signal", limits::MOVE_PENALTY, Linear, "What is added to the cost for each square of a move of the output from row to row"),
    row("search.largest_sensitivity", "", limits::SENSITIVITY_PEAK, Linear, "Largest sensitivity peak Ms of the linear loop; absent for any"),
    row("harris.dead_time_rows", "", limits::DEAD_TIME_ROWS, Linear, "Dead time of the Harris index in rows of the log, that of the sampling included"),
    row("harris.order", "", limits::MODEL_ORDER, Linear, "Order of the autoregressive model of the Harris index"),
];

const _: () = assert!(Scenario::MAX_PINNED == TuningScenario::MAX_PINNED, "documents of both versions share a row");

/// Every list of any length.
pub const LISTS: &[List] = &[
    List { path: "pinned", max: Scenario::MAX_PINNED },
    List { path: "pinned_loops", max: LevelLoopScenario::MAX_PINNED },
    List { path: "experiment.set_point_steps", max: limits::MAX_SET_POINT_STEPS },
    List { path: "level_loop.experiment.set_point_steps", max: limits::MAX_STEPS },
    List { path: "experiment.load_steps", max: limits::MAX_STEPS },
    List { path: "experiment.pump_voltage_steps", max: limits::MAX_PUMP_STEPS },
    List { path: "experiment.inflow_steps", max: limits::MAX_PUMP_STEPS },
    List { path: "plant.elements[][].numerator", max: limits::MAX_COEFFICIENTS },
    List { path: "plant.elements[][].denominator", max: limits::MAX_COEFFICIENTS },
    List { path: "plant.parameters.actuator.curve", max: limits::MAX_CURVE_POINTS },
    List { path: "controller.manual.steps", max: limits::MAX_STEPS },
];
