use quadtank::control::{AntiWindup, LoopMode, PiSettings};
use quadtank::literature::LevelPresetId;
use quadtank::plant::level::{
    Actuator, ActuatorCurve, Characteristic, ControlValve, Converter, LevelPlant, LevelTank, Outflow, OutputStage,
    SignalRange, SignalUnit, Transmitter, ValvePlace,
};
use quadtank::sim::level::{
    InflowDisturbance, InflowSignal, LevelController, LevelExperiment, SetPointScale, SignalStep,
};
use quadtank::study::level_loop::{
    Harris, LevelLoopSetup, LevelPlantSpec, ModelError, ModelSource, Objective, PiTuning, SearchSpec, StepTestSpec,
};
use quadtank::tuning::{CostMeasure, ReactionMethod};
use quadtank_scenario::level_loop::LevelLoopScenario;
use quadtank_scenario::{Limits, limits};

use super::Draw;

impl Draw {
    fn range(&mut self) -> SignalRange {
        if self.one_in(2) {
            return self.choose(&[SignalRange::CURRENT, SignalRange::PNEUMATIC, SignalRange::PNEUMATIC_FROM_ZERO]);
        }
        let high = self.number(Limits::new(1.0, limits::SIGNAL.max));
        let unit = self.choose(&[SignalUnit::Milliampere, SignalUnit::Psi]);
        SignalRange { low: high * self.share() - 0.01, high, unit }
    }

    fn lag(&mut self) -> f64 {
        if self.one_in(3) { 0.0 } else { self.number(Limits { min: limits::MIN_LAG_S, ..limits::LAG_S }) }
    }

    /// A curve over a range, often with turns of its slope.
    fn curve(&mut self, range: SignalRange) -> ActuatorCurve {
        let count = 2 + self.index(4);
        let falls = self.one_in(2);
        let point = |k: usize| {
            let share = k as f64 / (count - 1) as f64;
            let travel = share * share;
            [range.low + share * (range.high - range.low), if falls { 1.0 - travel } else { travel }]
        };
        ActuatorCurve((0..count).map(point).collect())
    }

    fn level_plant(&mut self) -> LevelPlantSpec {
        if self.one_in(3) {
            return LevelPlantSpec::Preset(self.choose(&LevelPresetId::ALL));
        }
        let height = self.number(limits::LEVEL_TANK_HEIGHT);
        let outflow = match self.index(3) {
            0 => Outflow::Linear { resistance: self.number(limits::RESISTANCE) },
            1 => Outflow::SquareRoot { coefficient: self.number(limits::FLOW_COEFFICIENT) },
            _ => Outflow::Pumped { flow: self.number(limits::FLOW) },
        };
        let output = self.range();
        let converter = self.one_in(2).then(|| Converter { input: output, output: self.range() });
        let lowest = self.choose(&[0.0, -0.2 * height, 0.3 * height]);
        LevelPlantSpec::Parameters(LevelPlant {
            tank: LevelTank { area: self.number(limits::LEVEL_TANK_AREA), height, outflow },
            transmitter: Transmitter {
                level_range: [lowest, lowest + height],
                signal: self.range(),
                lag_s: self.lag(),
                clips: self.one_in(2),
            },
            output: OutputStage { signal: output, clips: !self.one_in(4) },
            actuator: Actuator {
                lag_s: self.lag(),
                curve: self.curve(converter.map_or(output, |converter| converter.output)),
            },
            converter,
            valve: ControlValve {
                characteristic: match self.index(3) {
                    0 => Characteristic::Linear,
                    1 => Characteristic::EqualPercentage { rangeability: self.number(limits::RANGEABILITY) },
                    _ => Characteristic::QuickOpening,
                },
                place: if self.one_in(2) {
                    ValvePlace::Outlet
                } else {
                    ValvePlace::Inlet { full_flow: self.number(limits::FULL_FLOW) }
                },
            },
        })
    }

    /// A level and an inflow that a plant can often hold.
    fn rest(&mut self, plant: &LevelPlant) -> [f64; 2] {
        if self.one_in(8) {
            return [self.number(limits::TANK_LEVEL), self.number(limits::FLOW)];
        }
        let level = self.share() * plant.tank.height;
        let open = plant.tank.outflow.flow(level);
        let opening = plant.valve.characteristic.opening(self.share());
        let inflow = match plant.valve.place {
            ValvePlace::Outlet => open * opening,
            ValvePlace::Inlet { full_flow } => open - full_flow * opening,
        };
        [level, limits::FLOW.clamp(inflow)]
    }

    fn steps(&mut self, sizes: Limits, duration_s: f64) -> Vec<SignalStep> {
        let count = self.index(limits::MAX_STEPS + 1);
        (0..count).map(|_| SignalStep { time_s: self.share() * duration_s, size: self.number(sizes) }).collect()
    }

    fn anti_windup(&mut self) -> AntiWindup {
        if self.one_in(2) {
            AntiWindup::Off
        } else {
            AntiWindup::BackCalculation { tracking_ratio: self.number(limits::TRACKING_RATIO) }
        }
    }

    fn level_gain(&mut self) -> f64 {
        let size = self.number(limits::LEVEL_GAIN_MAGNITUDE);
        match self.index(8) {
            0 => 0.0,
            1..=3 => -size,
            _ => size,
        }
    }

    fn level_controller(&mut self, duration_s: f64) -> LevelController {
        match self.index(4) {
            0 => LevelController::Manual { steps: self.steps(limits::SIGNAL, duration_s) },
            1 => LevelController::Pi {
                gain: self.level_gain(),
                integral_time_s: self.number(limits::LEVEL_TIME_S),
                anti_windup: self.anti_windup(),
            },
            2 => LevelController::Pid {
                proportional: self.level_gain(),
                integral: self.level_gain(),
                derivative: self.level_gain(),
                filter_time_s: self.number(limits::LEVEL_TIME_S),
            },
            _ => LevelController::Sampled {
                settings: PiSettings {
                    gain: self.level_gain(),
                    integral_time_s: self.number(limits::LEVEL_TIME_S),
                    set_point_weight: self.share(),
                    anti_windup: self.anti_windup(),
                    mode: if self.one_in(4) {
                        LoopMode::Manual { output: self.number(limits::SIGNAL), until_s: self.share() * duration_s }
                    } else {
                        LoopMode::Automatic
                    },
                },
                sampling_time_s: self.number(limits::LEVEL_STEP_S),
            },
        }
    }

    fn inflow(&mut self, duration_s: f64) -> InflowDisturbance {
        let signal = match self.index(5) {
            0 => InflowSignal::None,
            1 => InflowSignal::Step { size: self.number(limits::FLOW_CHANGE) },
            2 => InflowSignal::Sine {
                amplitude: self.number(limits::FLOW_CHANGE),
                period_s: self.number(limits::LEVEL_STEP_S),
            },
            3 => InflowSignal::SimulinkNormal {
                std: self.number(limits::FLOW),
                sample_time_s: self.number(limits::LEVEL_STEP_S),
                seed: 0,
            },
            _ => InflowSignal::Normal {
                std: self.number(limits::FLOW),
                sample_time_s: self.number(limits::LEVEL_STEP_S),
                seed: 7,
            },
        };
        let [one, other] = [self.share() * duration_s, self.share() * duration_s];
        InflowDisturbance { signal, from_s: one.min(other), until_s: one.max(other) }
    }

    /// A low and a high number in this order.
    fn low_and_high(&mut self, limits: Limits) -> [f64; 2] {
        let [one, other] = self.pair(limits);
        [one.min(other), one.max(other)]
    }

    /// A level loop of any kind.
    pub fn level_loop(&mut self) -> LevelLoopScenario {
        let spec = self.level_plant();
        let plant = spec.plant();
        let ([level, inflow], [test_level, test_inflow]) = (self.rest(&plant), self.rest(&plant));
        let (duration_s, test_s) = (self.number(limits::LEVEL_DURATION_S), self.number(limits::LEVEL_DURATION_S));
        let back = self.one_in(2).then(|| test_s * (0.5 + 0.5 * self.share()));
        let setup = LevelLoopSetup {
            plant: spec,
            test: StepTestSpec {
                level: test_level,
                inflow: test_inflow,
                step: self.number(limits::SIGNAL),
                step_time_s: 0.5 * self.share() * test_s,
                return_time_s: back,
                duration_s: test_s,
                method: match self.index(3) {
                    0 => ReactionMethod::OnePoint { dead_time_s: self.number(limits::TIME_S) },
                    1 => ReactionMethod::TwoPoint,
                    _ => ReactionMethod::Ramp,
                },
            },
            objective: if self.one_in(2) {
                Objective::Tight
            } else {
                Objective::Averaging { band: self.low_and_high(Limits::new(0.0, plant.tank.height)) }
            },
            model_source: self.choose(&[ModelSource::Test, ModelSource::Local]),
            closed_loop_time_s: self.number(limits::LEVEL_TIME_S),
            controller: self.level_controller(duration_s),
            reference: PiTuning { gain: self.level_gain(), integral_time_s: self.number(limits::LEVEL_TIME_S) },
            model_error: ModelError {
                area_factor: self.number(limits::MODEL_FACTOR),
                flow_factor: self.number(limits::MODEL_FACTOR),
            },
            experiment: LevelExperiment {
                level,
                inflow,
                duration_s,
                log_step_s: self.number(limits::log_step_s(duration_s)),
                disturbance: self.inflow(duration_s),
                set_point_steps: self.steps(limits::SIGNAL, duration_s),
                set_point_scale: self.choose(&[SetPointScale::Level, SetPointScale::Signal]),
            },
            search: SearchSpec {
                gain: self.low_and_high(limits::LEVEL_GAIN_MAGNITUDE),
                integral_time_s: self.low_and_high(limits::LEVEL_TIME_S),
                measure: self.choose(&[
                    CostMeasure::LevelVariance,
                    CostMeasure::OutflowVariance,
                    CostMeasure::Iae,
                    CostMeasure::Ise,
                    CostMeasure::Itae,
                ]),
                move_penalty: self.number(limits::MOVE_PENALTY),
                largest_sensitivity: self.one_in(2).then(|| self.number(limits::SENSITIVITY_PEAK)),
                keep_band: self.one_in(2),
            },
            harris: Harris { dead_time_rows: 1 + self.index(1000), order: 1 + self.index(50) },
        };
        LevelLoopScenario::from(setup)
    }
}
