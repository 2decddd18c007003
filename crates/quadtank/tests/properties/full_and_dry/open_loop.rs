//! Runs with pumps, loads and valves that follow a plan, beside the reference.

use approx::assert_abs_diff_eq;
use quadtank::control::{AntiWindup, DecentralisedPi, LoopMode, Pairing, PiSettings};
use quadtank::literature::PresetId;
use quadtank::plant::{OperatingPoint, QuadrupleTank, ValveSchedule};
use quadtank::sim::{EventKind, Experiment, Load, LoadStep, Trajectory, simulate, simulate_with_valves};

use super::reference::{Reference, pumped};

/// Allowed deviation, as a fraction of the largest excursion of a level.
pub const BAR: f64 = 1e-6;
/// Allowed deviation of the time of an event (s), beside the time in which the level moves by its own allowed deviation.
const TIME_BAR: f64 = 1e-6;

/// Pumps at fixed voltages from given levels on, with loads at their times.
#[derive(Clone, Debug)]
pub struct OpenLoop {
    pub plant: QuadrupleTank,
    start: OperatingPoint,
    loads: Vec<LoadStep>,
    duration_s: f64,
}

impl OpenLoop {
    pub fn new(plant: &QuadrupleTank, levels: [f64; 4], pump_voltage: [f64; 2], duration_s: f64) -> Self {
        Self { plant: *plant, start: OperatingPoint { levels, pump_voltage }, loads: vec![], duration_s }
    }

    pub fn pump_flow(mut self, time_s: f64, flow: [f64; 2]) -> Self {
        let step = |pump: usize| LoadStep { time_s, load: Load::PumpFlow { pump, flow: flow[pump] } };
        self.loads.extend([step(0), step(1)]);
        self
    }

    pub fn leak(mut self, time_s: f64, tank: usize, area: f64) -> Self {
        self.loads.push(LoadStep { time_s, load: Load::Leak { tank, area } });
        self
    }

    pub fn tank_flow(mut self, time_s: f64, tank: usize, flow: f64) -> Self {
        self.loads.push(LoadStep { time_s, load: Load::TankFlow { tank, flow } });
        self
    }

    pub fn load(mut self, time_s: f64, load: Load) -> Self {
        self.loads.push(LoadStep { time_s, load });
        self
    }

    fn experiment(&self) -> Experiment {
        Experiment { load_steps: self.loads.clone(), ..Experiment::at_rest(self.duration_s) }
    }

    fn by_hand(&self, sampling_time_s: f64) -> DecentralisedPi {
        let by_hand = |pump: usize| PiSettings {
            gain: 1.0,
            integral_time_s: 100.0,
            set_point_weight: 1.0,
            anti_windup: AntiWindup::Off,
            mode: LoopMode::Manual {
                output: self.start.pump_voltage[pump] / self.plant.power_gain,
                until_s: f64::INFINITY,
            },
        };
        DecentralisedPi { pairing: Pairing::Diagonal, loops: [by_hand(0), by_hand(1)], sampling_time_s }
    }

    pub fn run(&self, sampling_time_s: f64) -> Trajectory {
        simulate(&self.plant, &self.start, &self.by_hand(sampling_time_s), &self.experiment())
    }

    /// The largest excursion of a level (m).
    pub fn excursion(&self, sampling_time_s: f64) -> f64 {
        let run = self.run(sampling_time_s);
        run.levels.iter().flat_map(|h| h.iter().map(|level| (level - h[0]).abs())).fold(0.0, f64::max)
    }

    pub fn run_with(&self, valves: &[ValveSchedule; 2], sampling_time_s: f64) -> Trajectory {
        simulate_with_valves(&self.plant, valves, &self.start, &self.by_hand(sampling_time_s), &self.experiment()).0
    }

    /// The reference at given times, over every load at its time and every break of the valves.
    pub fn reference(&self, valves: &[ValveSchedule; 2], times: &[f64]) -> (Vec<[f64; 4]>, Reference) {
        let mut water = Reference::new(&self.plant, self.start.levels);
        let mut rows = vec![];
        for &time in times {
            while water.time < time {
                let breaks = valves.iter().flat_map(ValveSchedule::breaks_s).flatten();
                let begins = self.loads.iter().map(|load| load.time_s).chain(breaks);
                let next = begins.filter(|&at| at > water.time).fold(time, f64::min);
                let (flow, leaks, outside) = self.acting(water.time);
                let (changed, turned) = self.changed(water.time);
                water.set_plant(&changed);
                let last = next.next_down();
                let flows = |t: f64| {
                    let gamma = |i: usize| (valves[i].at(t.min(last)) + turned[i]).clamp(0.0, 1.0);
                    let plant = changed.with_valves([gamma(0), gamma(1)]);
                    let pumped = pumped(&plant, self.start.pump_voltage, flow);
                    std::array::from_fn(|tank| pumped[tank] + outside[tank].max(0.0))
                };
                water.run_until(next, flows, &leaks);
            }
            rows.push(water.levels);
        }
        (rows, water)
    }

    /// Flows added to the pumps, leaks, and flows from outside from a time on.
    fn acting(&self, time: f64) -> ([f64; 2], [f64; 4], [f64; 4]) {
        let (mut flow, mut leaks, mut outside) = ([0.0; 2], [0.0; 4], self.plant.inflow);
        for step in self.loads.iter().filter(|step| step.time_s <= time) {
            match step.load {
                Load::PumpFlow { pump, flow: size } => flow[pump] += size,
                Load::Leak { tank, area } => leaks[tank] += area,
                Load::TankFlow { tank, flow } => outside[tank] += flow,
                Load::PumpGain { .. } | Load::Valve { .. } | Load::Outlet { .. } => (),
            }
        }
        (flow, leaks, outside)
    }

    /// The plant with the pumps and outlets that it has from a time on, and by how much each valve is turned. Nothing here changes
    /// twice.
    fn changed(&self, time: f64) -> (QuadrupleTank, [f64; 2]) {
        let (mut plant, mut turned) = (self.plant, [0.0; 2]);
        for step in self.loads.iter().filter(|step| step.time_s <= time) {
            match step.load {
                Load::PumpGain { pump, change } => plant.pumps[pump].gain *= 1.0 + change,
                Load::Valve { valve, change } => turned[valve] = change,
                Load::Outlet { tank, change } => plant.tanks[tank].outlet.area *= 1.0 + change,
                Load::PumpFlow { .. } | Load::Leak { .. } | Load::TankFlow { .. } => (),
            }
        }
        (plant, turned)
    }

    pub fn standing_valves(&self) -> [ValveSchedule; 2] {
        self.plant.valves.map(|gamma| ValveSchedule::Constant { gamma })
    }

    /// Compares all levels and the times of all events; gives back the reference at the end.
    pub fn check(&self, name: &str, sampling_time_s: f64) -> Reference {
        self.compare(name, &self.standing_valves(), &self.run(sampling_time_s))
    }

    pub fn compare(&self, name: &str, valves: &[ValveSchedule; 2], run: &Trajectory) -> Reference {
        let (rows, end) = self.reference(valves, &run.time_s);
        let start = rows[0];
        let excursion = rows.iter().flat_map(|h| (0..4).map(|i| (h[i] - start[i]).abs())).fold(0.0, f64::max);
        let mut worst = (0.0, 0, 0.0);
        for (row, expected) in rows.iter().enumerate() {
            for (tank, (column, expected)) in run.levels.iter().zip(expected).enumerate() {
                let error = (column[row] - expected).abs() / excursion;
                if error > worst.0 {
                    worst = (error, tank, run.time_s[row]);
                }
            }
        }
        for i in 0..4 {
            for (kind, expected) in [
                (EventKind::Overflow { tank: i }, end.first_overflow[i]),
                (EventKind::Empty { tank: i }, end.first_empty[i]),
            ] {
                let found = run.events.iter().find(|event| event.kind == kind).map(|event| event.time_s);
                assert_eq!(found.is_some(), expected.is_some(), "{name}: {kind:?} at {found:?}, not {expected:?}");
                if let (Some(found), Some((expected, slope))) = (found, expected) {
                    assert_abs_diff_eq!(found, expected, epsilon = TIME_BAR + BAR * excursion / slope);
                }
            }
        }
        let (error, tank, time) = worst;
        assert!(error <= BAR, "{name}: {error:.1e} of {excursion:.3} m in tank {} at {time} s", tank + 1);
        end
    }
}

pub fn johansson(valves: [f64; 2], heights: [f64; 4]) -> QuadrupleTank {
    with_heights(PresetId::JohanssonMinimumPhase.preset().plant.with_valves(valves), heights)
}

pub fn with_heights(mut plant: QuadrupleTank, heights: [f64; 4]) -> QuadrupleTank {
    for (tank, height) in plant.tanks.iter_mut().zip(heights) {
        tank.height = height;
    }
    plant
}
