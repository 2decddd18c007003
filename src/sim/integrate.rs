//! Integration of the nonlinear plant over stretches of time in which its inputs stand still.
//!
//! The plant is written in volumes, `dV/dt = inflow − drain √h`, and each tank is fed only by the pumps and by the tank
//! above it. An implicit Runge–Kutta stage is then one tank after the other, from the top, and each is an equation in
//! √h with a closed solution. So an L-stable method costs no more than an explicit one, and a tank that is almost dry,
//! whose time constant goes to 0 with √h, needs no special care. Volumes also make the water balance exact.

use crate::plant::{CrossSection, Disturbance, QuadrupleTank, Tank};

/// Stages of the method.
const STAGES: usize = 5;

/// Diagonal of the tableau.
const DIAGONAL: f64 = 0.25;

/// Singly diagonally implicit method of order 4, L-stable and stiffly accurate: the last stage is the result
/// (Hairer and Wanner 1996, *Solving Ordinary Differential Equations II*, Table IV.6.5).
const BELOW_DIAGONAL: [[f64; STAGES - 1]; STAGES] = [
    [0.0, 0.0, 0.0, 0.0],
    [1.0 / 2.0, 0.0, 0.0, 0.0],
    [17.0 / 50.0, -1.0 / 25.0, 0.0, 0.0],
    [371.0 / 1360.0, -137.0 / 2720.0, 15.0 / 544.0, 0.0],
    [25.0 / 24.0, -49.0 / 48.0, 125.0 / 16.0, -85.0 / 12.0],
];

/// Sub-steps per fastest time constant: with it the error of the method stays below 1e-6 of a transient.
const STEPS_PER_TIME_CONSTANT: f64 = 8.0;

/// Most sub-steps between two rows of a trajectory. A tank for which this is too few is so shallow that its water, and
/// with it the error, does not matter to the tank below; the method is stable with any step.
const MAX_STEPS: f64 = 4.0;

/// A Newton correction this small, as a fraction, leaves an error below rounding.
const NEWTON_TOLERANCE: f64 = 1e-9;

/// One tank, its walls in terms of √h and volume.
#[derive(Clone, Copy, Debug)]
struct Basin {
    section: CrossSection,
    root_height: f64,
    full_volume: f64,
}

impl Basin {
    fn new(tank: &Tank) -> Self {
        let section = tank.section;
        Self { section, root_height: tank.height.max(0.0).sqrt(), full_volume: section.volume(tank.height) }
    }

    /// The implicit equation of a stage for steps that start at `level`; `passed` as in [`Stage`].
    fn stage(&self, level: f64, passed: f64) -> Stage {
        let area = self.section.area(level).max(f64::MIN_POSITIVE);
        let half_slope = self.section.area_slope / 2.0;
        Stage {
            section: self.section,
            passed,
            passed_squared: passed * passed,
            four_areas: 4.0 * area,
            half_over_area: 0.5 / area,
            offset: half_slope * level * level,
        }
    }
}

/// `V(h) + passed √h = available`, the equation of a stage for one tank, prepared for many right-hand sides.
#[derive(Clone, Copy, Debug)]
struct Stage {
    section: CrossSection,
    /// Diagonal × step × drain (m^2.5).
    passed: f64,
    passed_squared: f64,
    four_areas: f64,
    half_over_area: f64,
    /// What the tangent of V at the start of the step lacks at level 0 (m³).
    offset: f64,
}

impl Stage {
    /// The √h that solves the equation: 0 for an empty tank, beyond the wall for one that is about to overflow.
    #[inline]
    fn root_level(&self, available: f64) -> f64 {
        let on_tangent = (available + self.offset).max(0.0);
        let root = ((self.passed_squared + self.four_areas * on_tangent).sqrt() - self.passed) * self.half_over_area;
        if self.section.area_slope == 0.0 { root } else { self.refine(root, available.max(0.0)) }
    }

    /// Newton's iteration from the solution with V replaced by its tangent.
    fn refine(&self, start: f64, available: f64) -> f64 {
        let mut root = start;
        for _ in 0..20 {
            let level = root * root;
            let excess = self.section.volume(level) + self.passed * root - available;
            let slope = 2.0 * self.section.area(level) * root + self.passed;
            let correction = excess / slope;
            root = (root - correction).max(0.0);
            if correction.abs() <= NEWTON_TOLERANCE * root {
                break;
            }
        }
        root
    }
}

/// What touched a wall or the bottom, and when, as seen by [`Hydraulics::advance`].
pub(super) trait Watch {
    /// The level of `tank` reached the top of its walls at `time`.
    fn overflow(&mut self, tank: usize, time: f64);
    /// `tank` ran dry at `time`.
    fn empty(&mut self, tank: usize, time: f64);
}

/// Level at which a tank that held water has run dry (m).
pub(super) const EMPTY_LEVEL: f64 = 1e-6;

/// The water in the plant, and the inputs that hold for the time being.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hydraulics {
    basins: [Basin; 4],
    /// Flow per √level through the outlets, into the tank below (m^2.5/s).
    outlet: [f64; 4],
    /// Flow per √level through outlets and leaks (m^2.5/s).
    drain: [f64; 4],
    /// Flow from the pumps into each tank (m³/s).
    inflow: [f64; 4],
    /// Water in each tank (m³).
    volume: [f64; 4],
    /// √h of each tank.
    root_level: [f64; 4],
}

impl Hydraulics {
    /// The plant with given levels (m), clipped to its walls, and all inputs zero.
    pub(super) fn new(plant: &QuadrupleTank, levels: &[f64; 4]) -> Self {
        let basins = plant.tanks.map(|tank| Basin::new(&tank));
        let root_gravity = (2.0 * plant.gravity).sqrt();
        let outlet = plant.tanks.map(|tank| tank.outlet.effective_area() * root_gravity);
        let mut volume = [0.0; 4];
        let mut root_level = [0.0; 4];
        for i in 0..4 {
            root_level[i] = levels[i].max(0.0).sqrt().min(basins[i].root_height);
            volume[i] = basins[i].section.volume(root_level[i] * root_level[i]);
        }
        Self { basins, outlet, drain: outlet, inflow: [0.0; 4], volume, root_level }
    }

    /// Sets the inputs that hold from now on.
    pub(super) fn set_inputs(&mut self, plant: &QuadrupleTank, pump_voltage: &[f64; 2], disturbance: &Disturbance) {
        self.inflow = plant.valve_flows(pump_voltage, disturbance);
        let root_gravity = (2.0 * plant.gravity).sqrt();
        for i in 0..4 {
            self.drain[i] = self.outlet[i] + disturbance.leak_area[i] * root_gravity;
        }
    }

    /// Levels (m).
    pub(super) fn levels(&self) -> [f64; 4] {
        self.root_level.map(|root| root * root)
    }

    /// Lets `duration` seconds pass from `time` on.
    pub(super) fn advance(&mut self, time: f64, duration: f64, watch: &mut impl Watch) {
        let steps = self.steps(duration);
        let step = duration / steps;
        let mut passed = 0.0;
        while passed < steps {
            self.step(time + passed * step, step, watch);
            passed += 1.0;
        }
    }

    /// Number of sub-steps for a stretch of time, as a whole `f64`.
    fn steps(&self, duration: f64) -> f64 {
        let fastest = (0..4).map(|i| self.time_constant(i)).fold(f64::INFINITY, f64::min);
        (STEPS_PER_TIME_CONSTANT * duration / fastest).ceil().clamp(1.0, MAX_STEPS)
    }

    /// How fast a tank forgets at its present level: `T = 2 A √h / drain` (s).
    fn time_constant(&self, i: usize) -> f64 {
        let root = self.root_level[i];
        2.0 * self.basins[i].section.area(root * root) * root / self.drain[i]
    }

    fn step(&mut self, time: f64, step: f64, watch: &mut impl Watch) {
        let levels = self.levels();
        let stages: [Stage; 4] =
            std::array::from_fn(|i| self.basins[i].stage(levels[i], DIAGONAL * step * self.drain[i]));
        let mut gain = [[0.0; 4]; STAGES];
        let mut root = [0.0; 4];
        let mut end = [0.0; 4];
        for (stage, weights) in BELOW_DIAGONAL.iter().enumerate() {
            let mut inflow = self.inflow;
            for tank in [2, 3, 0, 1] {
                if tank < 2 {
                    inflow[tank] += self.outlet[tank + 2] * root[tank + 2];
                }
                let past: f64 = (0..stage).map(|j| weights[j] * gain[j][tank]).sum();
                let available = self.volume[tank] + step * (past + DIAGONAL * inflow[tank]);
                root[tank] = stages[tank].root_level(available);
                gain[stage][tank] = inflow[tank] - self.drain[tank] * root[tank];
                end[tank] = available - stages[tank].passed * root[tank];
            }
        }
        for tank in 0..4 {
            self.settle(tank, end[tank], root[tank], time, step, watch);
        }
    }

    /// Takes over the result of a step, kept within the walls, and tells when it met them.
    fn settle(&mut self, tank: usize, end: f64, root: f64, time: f64, step: f64, watch: &mut impl Watch) {
        let basin = self.basins[tank];
        let start = self.volume[tank];
        let reached = |volume: f64| time + step * ((volume - start) / (end - start)).clamp(0.0, 1.0);
        if end > basin.full_volume {
            watch.overflow(tank, reached(basin.full_volume));
        }
        let was_wet = self.root_level[tank] * self.root_level[tank] > EMPTY_LEVEL;
        if was_wet && root * root <= EMPTY_LEVEL {
            watch.empty(tank, reached(basin.section.volume(EMPTY_LEVEL)));
        }
        self.volume[tank] = end.clamp(0.0, basin.full_volume);
        self.root_level[tank] = root.min(basin.root_height);
    }
}
