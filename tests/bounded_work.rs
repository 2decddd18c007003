//! The work that any valid document asks for has a bound. Work is counted, not timed: steps of the integration, and
//! multiplications of exact motions.
#![cfg(not(target_arch = "wasm32"))]

use quadtank::control::{
    AntiWindup, DecentralisedPi, EstimatorSettings, FedWith, LoopMode, ModelFree, ModelFreeSettings, ModelFreeWindup,
    Pairing, PiSettings, Quadrature, Window,
};
use quadtank::linear::TransferFunction;
use quadtank::plant::{CrossSection, DisplayUnit, Outlet, PresetId, Pump, QuadrupleTank, Sensor, Tank, ValveSchedule};
use quadtank::scenario::model_free::{
    ModelFreeScenario, ModelFreeSetup, StartSpec, analyse_model_free, run_model_free,
};
use quadtank::scenario::tuning::{
    Behind, CompareSpec, CriticalSpec, DecouplerSpec, DesignSpec, Element, ResponseSpec, StepResponse, Study, TestKind,
    TestSpec, Tested, TuningPlant, TuningScenario, TuningSetup,
};
use quadtank::scenario::{
    Document, Limits, OperatingPointSpec, PlantSpec, Scenario, Setup, View, analyse, document_from_json, limits, run,
};
use quadtank::sim::{Experiment, Halt, Load, LoadStep, LoopTrace, MAX_WORK, Measurement, SetPointStep};
use quadtank::tuning::{Action, PlacementMethod, PublishedPlant, RelayVerdict, TuningRule};

/// Documents of each version.
const DOCUMENTS: usize = 2000;
/// Sessions with the same plant, whose critical curve takes longest.
const SESSIONS: usize = 40;
/// Most steps of the integration in one run: eight for each row, and for each quarter of a radian that a valve turns.
const MOST_STEPS: f64 = 8.0 * (limits::MAX_SAMPLES + 2.0 * 1500.0 + 4.0 * limits::MAX_VALVE_TURN);
/// Work of the last motion of a run, which may begin just within the bound.
const LAST_MOTION: f64 = 1e5;
/// Farthest target of a placement, the limit of the document.
const FARTHEST_TARGET: f64 = 1e6;

/// Random numbers (Steele, Lea and Flood 2014, SplitMix64): the same documents everywhere.
struct Draw(u64);

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
        Pump { gain: self.number(limits::PUMP_GAIN), voltage_min: one.min(other), voltage_max: one.max(other) }
    }

    fn plant(&mut self) -> PlantSpec {
        if self.one_in(2) {
            return PlantSpec::Preset(self.choose(&PresetId::ALL));
        }
        let rig = QuadrupleTank {
            tanks: [self.tank(), self.tank(), self.tank(), self.tank()],
            pumps: [self.pump(), self.pump()],
            valves: self.pair(limits::VALVE),
            power_gain: self.number(limits::POWER_GAIN),
            sensor: Sensor {
                gain: self.number(limits::SENSOR_GAIN),
                range: self.number(limits::SENSOR_RANGE),
                resolution: self.number(limits::SENSOR_RESOLUTION),
            },
            gravity: self.number(limits::GRAVITY),
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
            load: if draw.one_in(2) {
                Load::PumpFlow { pump: draw.index(2), flow: draw.number(limits::LOAD_FLOW) }
            } else {
                Load::Leak { tank: draw.index(4), area: draw.number(limits::LEAK_AREA) }
            },
        };
        let [set_points, loads] = [self.index(limits::MAX_STEPS + 1), self.index(limits::MAX_STEPS + 1)];
        Experiment {
            duration_s,
            set_point_steps: (0..set_points).map(|_| set_point(self)).collect(),
            load_steps: (0..loads).map(|_| load(self)).collect(),
            measurement: Measurement {
                noise_std: if self.one_in(2) { 0.0 } else { self.number(limits::NOISE_STD) },
                seed: 1,
                quantised: self.one_in(2),
            },
        }
    }

    /// A duration and a sampling time that go together.
    fn times(&mut self) -> (f64, f64) {
        let sampling_time_s = self.number(limits::SAMPLING_TIME_S);
        (self.number(limits::duration_s(sampling_time_s)), sampling_time_s)
    }

    fn quadruple(&mut self) -> Scenario {
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
        Scenario { version: Scenario::VERSION, setup, pinned: Vec::new(), view: View::default() }
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
            anti_windup: draw.choose(&[ModelFreeWindup::Off, ModelFreeWindup::Conditional]),
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

    fn model_free(&mut self) -> ModelFreeScenario {
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

    fn tuning_plant(&mut self) -> TuningPlant {
        match self.index(4) {
            0 => TuningPlant::Published(self.choose(&[PublishedPlant::WoodBerry, PublishedPlant::ProcessTwo])),
            1 => {
                let nonlinear = self.one_in(2);
                let time = |draw: &mut Self| if nonlinear { 0.0 } else { draw.number(Limits::new(0.0, 1e6)) };
                TuningPlant::QuadrupleTank {
                    preset: self.choose(&PresetId::ALL),
                    valves: self.one_in(2).then(|| self.pair(limits::VALVE)),
                    pairing: self.choose(&[Pairing::Diagonal, Pairing::Swapped]),
                    dead_time_s: time(self),
                    lag_s: time(self),
                    nonlinear,
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
    fn tuning(&mut self, plant: TuningPlant) -> TuningScenario {
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
                    0 => Behind::Nothing,
                    1 => Behind::Integrator,
                    _ => Behind::Modulus(self.number(size)),
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
        TuningScenario { version: TuningScenario::VERSION, tuning: setup, pinned: Vec::new() }
    }
}

fn assert_bounded(steps: u64, document: &impl std::fmt::Debug) {
    assert!(steps as f64 <= MOST_STEPS, "{steps} steps: {document:?}");
}

#[test]
fn runs_of_the_quadruple_tank_have_a_bound() {
    let mut draw = Draw(1);
    let valid = std::iter::repeat_with(|| draw.quadruple()).filter(|scenario| scenario.validate().is_ok());
    for scenario in valid.take(DOCUMENTS) {
        let _ = analyse(&scenario.setup);
        if let Ok(run) = run(&scenario.setup) {
            assert_bounded(run.nonlinear.steps, &scenario);
        }
    }
}

#[test]
fn model_free_runs_have_a_bound() {
    let mut draw = Draw(3);
    let valid = std::iter::repeat_with(|| draw.model_free()).filter(|scenario| scenario.validate().is_ok());
    for scenario in valid.take(DOCUMENTS) {
        let _ = analyse_model_free(&scenario.model_free);
        if let Ok(answer) = run_model_free(&scenario.model_free) {
            assert_bounded(answer.run.trajectory.steps, &scenario);
            if let Some((comparison, _)) = &answer.comparison {
                assert_bounded(comparison.steps, &scenario);
            }
        }
    }
}

fn traces(test: &Tested) -> Vec<&LoopTrace> {
    match test {
        Tested::Single(test, _) | Tested::Simultaneous(test, _) => vec![&test.trace],
        Tested::Independent(loops) => loops.iter().map(|(test, _)| &test.trace).collect(),
        Tested::Sequential(steps) => steps.iter().map(|step| &step.test.trace).collect(),
    }
}

#[test]
fn relay_tests_and_responses_have_a_bound() {
    let mut draw = Draw(2);
    let mut left = DOCUMENTS;
    while left > 0 {
        let plant = draw.tuning_plant();
        let study = Study::of(&plant);
        for _ in 0..SESSIONS {
            let scenario = draw.tuning(plant.clone());
            if scenario.validate().is_err() {
                continue;
            }
            left = left.saturating_sub(1);
            let Ok(study) = &study else { continue };
            if let Ok(test) = study.test(&scenario.tuning) {
                let work: f64 = traces(&test).iter().map(|trace| trace.work).sum();
                assert!(work <= 3.0 * MAX_WORK + LAST_MOTION, "{work}: {scenario:?}");
            }
            if let Ok(Some(design)) = study.design(&scenario.tuning) {
                let compared = design.comparison.as_ref().map(|comparison| &comparison.response);
                for StepResponse { trace, .. } in [Some(&design.response), compared].into_iter().flatten() {
                    assert!(trace.work <= MAX_WORK + LAST_MOTION, "{}: {scenario:?}", trace.work);
                }
            }
        }
    }
}

/// Poles from 1e-7 to 8.7e3 in four elements of degree 7: once 65 s of steps of the quickest pole.
#[test]
fn a_response_of_stiff_elements_goes_to_its_end() {
    let Ok(Document::Tuning(scenario)) = document_from_json(include_str!("data/stiff-elements.json")) else {
        panic!("a session within its limits")
    };
    let design = Study::of(&scenario.tuning.plant).unwrap().design(&scenario.tuning).unwrap().unwrap();
    let trace = &design.response.trace;
    assert_eq!((trace.halt, trace.time.len()), (None, 6001));
    assert!(trace.work < 0.1 * MAX_WORK, "{}", trace.work);
}

/// A relay on lags that are a million times quicker than the record is long.
#[test]
fn a_relay_test_that_is_too_much_work_says_so() {
    let mut scenario = TuningScenario::default();
    scenario.tuning.plant = TuningPlant::Published(PublishedPlant::ProcessTwo);
    (scenario.tuning.test.duration, scenario.tuning.test.step) = (1e5, 1.0);
    let study = Study::of(&scenario.tuning.plant).unwrap();
    let Ok(Tested::Simultaneous(test, _)) = study.test(&scenario.tuning) else { panic!("a simultaneous test") };
    let Some(Halt::Full { time }) = test.trace.halt else { panic!("{:?}", test.trace.halt) };
    assert!(time > 100.0 && test.trace.work <= MAX_WORK + LAST_MOTION);
}

#[test]
fn a_sequence_that_is_too_much_work_ends_with_an_unfinished_test() {
    let mut scenario = TuningScenario::default();
    let test = &mut scenario.tuning.test;
    (test.kind, test.passes, test.step) = (TestKind::Sequential, 20, 0.016);
    assert_eq!(scenario.validate(), Ok(()));
    let study = Study::of(&scenario.tuning.plant).unwrap();
    let Ok(Tested::Sequential(steps)) = study.test(&scenario.tuning) else { panic!("a sequence") };
    let (last, before) = steps.split_last().unwrap();
    assert!(steps.len() < 40 && before.iter().all(|step| step.settings.is_some()));
    assert!(matches!(last.test.reading.verdict, RelayVerdict::Unfinished { time } if time < 400.0), "{last:?}");
}

#[test]
fn a_valve_that_turns_too_often_is_named() {
    let text = |frequency: f64| {
        let mut scenario = ModelFreeScenario::default();
        scenario.model_free.experiment.duration_s = 20_000.0;
        scenario.model_free.valves[1] = ValveSchedule::Sine { mean: 0.5, amplitude: 0.1, frequency, phase: 0.0 };
        scenario.validate().map_err(|error| error.to_string())
    };
    assert_eq!(text(0.5), Ok(()));
    assert_eq!(text(10.0), Err("model_free.valves[1].sine.frequency: 10 is outside 0 to 0.5".to_owned()));
}
