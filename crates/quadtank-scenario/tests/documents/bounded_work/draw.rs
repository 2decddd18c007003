//! Random valid documents of every version: numbers over the whole of their ranges, often at a limit.

mod level_loop;

use quadtank::control::{
    AntiWindup, DecentralisedPi, EstimatorSettings, FedWith, LoopMode, ModelFree, ModelFreeAntiWindup,
    ModelFreeSettings, Pairing, PiSettings, Quadrature, Window,
};
use quadtank::linear::TransferFunction;
use quadtank::literature::campestrini::PublishedPlant;
use quadtank::literature::{DisplayUnit, PresetId};
use quadtank::plant::{CrossSection, Outlet, Pump, QuadrupleTank, Sensor, Tank, ValveSchedule};
use quadtank::sim::{Experiment, InflowStep, Load, LoadStep, Measurement, PumpVoltageStep, SetPointStep};
use quadtank::study::model_free::{ModelFreeSetup, StartSpec};
use quadtank::study::quadruple_tank::{OperatingPointSpec, PlantSpec, Setup};
use quadtank::study::relay_tuning::{
    CompareSpec, CriticalSpec, DecouplerSpec, DesignSpec, Element, GivenPid, ResponseSpec, SeriesElement, TestKind,
    TestSpec, TuningPlant, TuningSetup,
};
use quadtank::tuning::{Action, PlacementMethod, TuningRule};
use quadtank_scenario::model_free::ModelFreeScenario;
use quadtank_scenario::tuning::TuningScenario;
use quadtank_scenario::{Limits, Scenario, limits};

/// Farthest target of a placement, the limit of the document.
const FARTHEST_TARGET: f64 = 1e6;

/// Random numbers (Steele, Lea and Flood 2014, SplitMix64): the same documents everywhere.
pub struct Draw(pub u64);

impl Draw {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Even in [0, 1).
    fn share(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn one_in(&mut self, count: u32) -> bool {
        self.share() < 1.0 / f64::from(count)
    }

    fn index(&mut self, count: usize) -> usize {
        usize::try_from(self.bits() % count as u64).unwrap()
    }

    fn choose<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.index(from.len())]
    }

    /// Over the whole interval on a logarithmic scale, and now and then one of its ends. What may be zero or negative goes
    /// down to 1e-6 of its largest value.
    fn number(&mut self, limits: Limits) -> f64 {
        if self.one_in(8) {
            return self.choose(&[limits.min, limits.max]);
        }
        let largest = limits.max.abs().max(limits.min.abs());
        let least = if limits.min > 0.0 { limits.min } else { 1e-6 * largest };
        let size = least * (largest / least).powf(self.share());
        limits.clamp(if limits.min < 0.0 && self.one_in(2) { -size } else { size })
    }

    fn pair(&mut self, limits: Limits) -> [f64; 2] {
        [self.number(limits), self.number(limits)]
    }

    fn tank(&mut self) -> Tank {
        let area = self.number(limits::TANK_AREA);
        let section =
            CrossSection { area_at_empty: area, area_slope: if self.one_in(2) { 0.0 } else { area * self.share() } };
        let widest = limits::OUTLET_AREA.max.min(limits::OUTLET_SHARE * area);
        let outlet = Outlet {
            area: self.number(Limits::new(limits::OUTLET_AREA.min, widest)),
            loss_coefficient: self.number(limits::LOSS_COEFFICIENT),
        };
        Tank { section, outlet, height: self.number(limits::TANK_HEIGHT) }
    }

    fn pump(&mut self) -> Pump {
        let [one, other] = self.pair(limits::PUMP_VOLTAGE);
        let mut straight = Pump::proportional(self.number(limits::PUMP_GAIN), one.min(other), one.max(other));
        if self.one_in(4) {
            straight.delay_s = self.number(limits::PUMP_DELAY_S);
        }
        if !self.one_in(4) {
            return straight;
        }
        let start_voltage = self.number(Limits { max: straight.voltage_max, ..limits::PUMP_VOLTAGE });
        let most = straight.gain * straight.voltage_max;
        let offset = -0.5 * self.share() * straight.gain * start_voltage;
        // More than the pump gives where its dead zone ends.
        let flow_max = self.one_in(2).then(|| limits::PUMP_FLOW_MAX.clamp(most));
        Pump { offset, start_voltage, flow_max, ..straight }
    }

    fn plant(&mut self) -> PlantSpec {
        if self.one_in(2) {
            return PlantSpec::Preset(self.choose(&PresetId::ALL));
        }
        let rig = QuadrupleTank {
            tanks: [self.tank(), self.tank(), self.tank(), self.tank()],
            pumps: [self.pump(), self.pump()],
            valves: self.pair(limits::VALVE),
            valve_slopes: if self.one_in(4) { self.pair(limits::VALVE_SLOPE) } else { [0.0; 2] },
            power_gain: self.number(limits::POWER_GAIN),
            sensor: Sensor {
                gain: self.number(limits::SENSOR_GAIN),
                range: self.number(limits::SENSOR_RANGE),
                resolution: self.number(limits::SENSOR_RESOLUTION),
            },
            gravity: self.number(limits::GRAVITY),
            inflow: if self.one_in(2) { [0.0; 4] } else { std::array::from_fn(|_| self.number(limits::INFLOW)) },
        };
        PlantSpec::Parameters { rig, display_unit: DisplayUnit::Cm }
    }

    fn pi(&mut self) -> PiSettings {
        let gain = self.number(limits::GAIN_MAGNITUDE);
        PiSettings {
            gain: if self.one_in(4) { -gain } else { gain },
            integral_time_s: self.number(limits::INTEGRAL_TIME_S),
            set_point_weight: self.share(),
            anti_windup: if self.one_in(2) {
                AntiWindup::Off
            } else {
                AntiWindup::BackCalculation { tracking_ratio: self.number(limits::TRACKING_RATIO) }
            },
            mode: if self.one_in(4) {
                LoopMode::Manual { output: self.number(limits::MANUAL_OUTPUT), until_s: self.number(limits::TIME_S) }
            } else {
                LoopMode::Automatic
            },
        }
    }

    /// A controller of a relay-tuning session.
    fn given(&mut self, size: Limits) -> GivenPid {
        let gain = self.number(size);
        GivenPid {
            gain: if self.one_in(4) { -gain } else { gain },
            integral_time: (!self.one_in(4)).then(|| self.number(size)),
            derivative_time: if self.one_in(2) { 0.0 } else { self.number(size) },
            filter_time: self.one_in(2).then(|| self.number(size)),
            ..GivenPid::default()
        }
    }

    fn loops(&mut self, sampling_time_s: f64) -> DecentralisedPi {
        let pairing = self.choose(&[Pairing::Diagonal, Pairing::Swapped]);
        DecentralisedPi { pairing, loops: [self.pi(), self.pi()], sampling_time_s }
    }

    fn experiment(&mut self, duration_s: f64) -> Experiment {
        let set_point = |draw: &mut Self| SetPointStep {
            level: draw.index(2),
            time_s: draw.number(limits::TIME_S),
            size: draw.number(limits::SET_POINT_STEP),
        };
        let load = |draw: &mut Self| LoadStep {
            time_s: draw.number(limits::TIME_S),
            load: match draw.index(6) {
                0 => Load::PumpFlow { pump: draw.index(2), flow: draw.number(limits::LOAD_FLOW) },
                1 => Load::Leak { tank: draw.index(4), area: draw.number(limits::LEAK_AREA) },
                2 => Load::TankFlow { tank: draw.index(4), flow: draw.number(limits::LOAD_FLOW) },
                3 => Load::PumpGain { pump: draw.index(2), change: draw.number(limits::LOAD_SHARE) },
                4 => Load::Valve { valve: draw.index(2), change: draw.number(limits::LOAD_SHARE) },
                _ => Load::Outlet { tank: draw.index(4), change: draw.number(limits::LOAD_SHARE) },
            },
        };
        let by_hand = |draw: &mut Self| PumpVoltageStep {
            pump: draw.index(2),
            time_s: draw.number(limits::TIME_S),
            voltage: draw.number(limits::PUMP_VOLTAGE),
        };
        let inflow = |draw: &mut Self| InflowStep {
            tank: draw.index(4),
            time_s: draw.number(limits::TIME_S),
            flow: draw.number(limits::INFLOW),
        };
        // Every tank is that high.
        let level = Limits { max: limits::TANK_HEIGHT.min, ..limits::LEVEL };
        let most_by_hand = if self.one_in(50) { limits::MAX_PUMP_STEPS } else { 40 };
        let steps_by_hand = if self.one_in(2) { 0 } else { self.index(most_by_hand) };
        let inflows = if self.one_in(2) { 0 } else { self.index(most_by_hand) };
        let most_set_points = if self.one_in(20) { limits::MAX_SET_POINT_STEPS } else { limits::MAX_STEPS };
        let [set_points, loads] = [self.index(most_set_points + 1), self.index(limits::MAX_STEPS + 1)];
        Experiment {
            duration_s,
            set_point_steps: (0..set_points).map(|_| set_point(self)).collect(),
            load_steps: (0..loads).map(|_| load(self)).collect(),
            measurement: Measurement {
                noise_std: if self.one_in(2) { 0.0 } else { self.number(limits::NOISE_STD) },
                seed: 1,
                quantised: self.one_in(2),
            },
            initial_levels: self.one_in(4).then(|| std::array::from_fn(|_| self.number(level))),
            pump_voltage_steps: (0..steps_by_hand).map(|_| by_hand(self)).collect(),
            inflow_steps: (0..inflows).map(|_| inflow(self)).collect(),
            pump_flow_noise_std: if self.one_in(4) { self.number(limits::PUMP_FLOW_NOISE_STD) } else { 0.0 },
        }
    }

    /// A duration and a sampling time that go together.
    fn times(&mut self) -> (f64, f64) {
        let sampling_time_s = self.number(limits::SAMPLING_TIME_S);
        (self.number(limits::duration_s(sampling_time_s)), sampling_time_s)
    }

    pub fn quadruple(&mut self) -> Scenario {
        let (duration_s, sampling_time_s) = self.times();
        let setup = Setup {
            plant: self.plant(),
            valves: self.pair(limits::VALVE),
            operating_point: if self.one_in(2) {
                OperatingPointSpec::PumpVoltage(self.pair(limits::PUMP_VOLTAGE))
            } else {
                OperatingPointSpec::Levels(self.pair(limits::LEVEL))
            },
            controller: self.loops(sampling_time_s),
            experiment: self.experiment(duration_s),
        };
        Scenario::from(setup)
    }

    fn valve(&mut self, duration_s: f64) -> ValveSchedule {
        match self.index(4) {
            0 => ValveSchedule::Constant { gamma: self.number(limits::VALVE) },
            1 => ValveSchedule::Step {
                from: self.number(limits::VALVE),
                to: self.number(limits::VALVE),
                at_s: self.number(limits::TIME_S),
            },
            2 => {
                let [one, other] = self.pair(limits::TIME_S);
                let [from, to] = self.pair(limits::VALVE);
                ValveSchedule::Ramp { from, to, begin_s: one.min(other), end_s: one.max(other) }
            }
            _ => {
                let mean = self.number(limits::VALVE);
                ValveSchedule::Sine {
                    mean,
                    amplitude: 0.999 * self.share() * mean.min(1.0 - mean),
                    frequency: self.number(limits::valve_frequency(duration_s)),
                    phase: self.number(limits::VALVE_PHASE),
                }
            }
        }
    }

    fn law(&mut self, sampling_time_s: f64) -> ModelFree {
        let settings = |draw: &mut Self| ModelFreeSettings {
            model_gain: draw.number(limits::MODEL_GAIN),
            proportional: draw.number(limits::MODEL_FREE_FEEDBACK),
            integral: draw.number(limits::MODEL_FREE_FEEDBACK),
            anti_windup: draw.choose(&[ModelFreeAntiWindup::Off, ModelFreeAntiWindup::Conditional]),
        };
        let samples = self.number(Limits::new(2.0, 1000.0)).round();
        let estimator = EstimatorSettings {
            window_s: samples * sampling_time_s,
            window: self.choose(&[Window::Block, Window::Sliding]),
            quadrature: self.choose(&[Quadrature::Rectangular, Quadrature::Trapezoidal]),
            fed_with: self.choose(&[FedWith::Applied, FedWith::Commanded]),
        };
        ModelFree {
            pairing: self.choose(&[Pairing::Diagonal, Pairing::Swapped]),
            loops: [settings(self), settings(self)],
            estimator: (!self.one_in(4)).then_some(estimator),
            sampling_time_s,
        }
    }

    pub fn model_free(&mut self) -> ModelFreeScenario {
        let (duration_s, sampling_time_s) = self.times();
        let setup = ModelFreeSetup {
            plant: self.plant(),
            valves: [self.valve(duration_s), self.valve(duration_s)],
            start: if self.one_in(4) { StartSpec::Empty } else { StartSpec::Rest(self.pair(limits::LEVEL)) },
            controller: self.law(sampling_time_s),
            compare: self.one_in(4).then(|| self.loops(sampling_time_s.max(1.0))),
            experiment: self.experiment(duration_s),
        };
        ModelFreeScenario::from(setup)
    }

    /// An element of up to six lags and lightly damped pairs, so that most plants are stable.
    fn element(&mut self) -> Element {
        let times = Limits::new(1e-6, 1e6);
        let gain = self.number(Limits::new(-1e6, 1e6));
        let mut whole = TransferFunction::lags(gain, &[], 0.0).unwrap();
        for _ in 0..=self.index(3) {
            let time = self.number(times);
            let damping = self.number(Limits::new(1e-4, 2.0));
            let denominator =
                if self.one_in(2) { vec![1.0, time] } else { vec![1.0, 2.0 * damping * time, time * time] };
            whole = whole.times(&TransferFunction::new(vec![1.0], denominator, 0.0).unwrap());
        }
        Element {
            numerator: whole.numerator().to_vec(),
            denominator: whole.denominator().to_vec(),
            dead_time: if self.one_in(2) { 0.0 } else { self.number(Limits::new(0.0, 1e6)) },
        }
    }

    pub fn tuning_plant(&mut self) -> TuningPlant {
        match self.index(4) {
            0 => TuningPlant::Published(self.choose(&[PublishedPlant::WoodBerry, PublishedPlant::ProcessTwo])),
            1 => {
                let nonlinear = self.one_in(2);
                let time = |draw: &mut Self| if nonlinear { 0.0 } else { draw.number(Limits::new(0.0, 1e6)) };
                let pairing = self.choose(&[Pairing::Diagonal, Pairing::Swapped]);
                let (dead_time_s, lag_s) = (time(self), time(self));
                match self.plant() {
                    PlantSpec::Preset(preset) => {
                        let valves = self.one_in(2).then(|| self.pair(limits::VALVE));
                        TuningPlant::QuadrupleTank { preset, valves, pairing, dead_time_s, lag_s, nonlinear }
                    }
                    PlantSpec::Parameters { mut rig, .. } => {
                        if nonlinear {
                            rig.pumps = rig.pumps.map(|pump| Pump { delay_s: 0.0, ..pump });
                        }
                        let pump_voltage = rig.pumps.map(|pump| f64::midpoint(pump.voltage_min, pump.voltage_max));
                        let rig = Box::new(rig);
                        TuningPlant::Parameters { rig, pump_voltage, pairing, dead_time_s, lag_s, nonlinear }
                    }
                }
            }
            _ => TuningPlant::Elements([[self.element(), self.element()], [self.element(), self.element()]]),
        }
    }

    /// A duration and a step that go together.
    fn record(&mut self) -> (f64, f64) {
        let duration = self.number(Limits::new(1e-6, 1e6));
        (duration, duration / self.number(Limits::new(1.0, 1e5)))
    }

    /// A session with any plant; its targets reach as far as a document allows.
    pub fn tuning(&mut self, plant: TuningPlant) -> TuningScenario {
        let size = Limits::new(1e-6, 1e6);
        let ((test_duration, test_step), (duration, step)) = (self.record(), self.record());
        let target = Limits::new(-FARTHEST_TARGET, FARTHEST_TARGET);
        let not_negative = Limits::new(0.0, 1e6);
        let mut pair_or_none = |limits: Limits| if self.one_in(2) { [0.0; 2] } else { self.pair(limits) };
        let (hysteresis, bias) = (pair_or_none(not_negative), pair_or_none(Limits::new(-1e6, 1e6)));
        let setup = TuningSetup {
            plant,
            test: TestSpec {
                kind: self.choose(&[
                    TestKind::Single,
                    TestKind::Independent,
                    TestKind::Sequential,
                    TestKind::Simultaneous,
                ]),
                number: 1 + self.index(2),
                behind: match self.index(3) {
                    0 => SeriesElement::Nothing,
                    1 => SeriesElement::Integrator,
                    _ => SeriesElement::Modulus(self.number(size)),
                },
                amplitudes: self.pair(size),
                hysteresis,
                bias,
                rule: self.choose(&TuningRule::ALL),
                detuning: self.pair(size),
                passes: 1 + self.index(20),
                duration: test_duration,
                release: test_duration * self.share(),
                step: test_step,
            },
            design: DesignSpec {
                critical: if self.one_in(2) {
                    CriticalSpec::Importance(self.number(size))
                } else {
                    CriticalSpec::Point { gains: self.pair(Limits::new(-1e6, 1e6)), period: self.number(size) }
                },
                method: self.choose(&[PlacementMethod::OneLocus, PlacementMethod::BothLoci]),
                action: self.choose(&[Action::Pi, Action::Pid]),
                target: self.pair(target),
                root: 1 + self.index(2),
                decoupler: self.choose(&[
                    DecouplerSpec::None,
                    DecouplerSpec::Static,
                    DecouplerSpec::Dynamic,
                    DecouplerSpec::FirstOutput,
                    DecouplerSpec::SecondOutput,
                ]),
                controllers: self.one_in(3).then(|| [self.given(size), self.given(size)]),
                pairing: self.choose(&Pairing::ALL),
            },
            response: ResponseSpec {
                references: self.pair(Limits::new(-1e6, 1e6)),
                duration,
                step,
                compare: self.choose(&[
                    CompareSpec::Nothing,
                    CompareSpec::ZieglerNichols,
                    CompareSpec::TyreusLuyben,
                    CompareSpec::Full,
                ]),
            },
        };
        TuningScenario::from(setup)
    }
}
