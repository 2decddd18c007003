//! Integration of the nonlinear plant over stretches of time in which its inputs stand still.
//!
//! The plant is written in volumes, `dV/dt = inflow − drain √h`, and each tank is fed only by the pumps and by the tank
//! above it. An implicit Runge–Kutta stage is then one tank after the other, from the top, and each is an equation in
//! √h with a closed solution. So an L-stable method costs no more than an explicit one, and a tank that is almost dry,
//! whose time constant goes to 0 with √h, needs no special care. Volumes also make the water balance exact.
//!
//! Where the step is short against every time constant, which is the ordinary case, the classical Runge–Kutta method does
//! the same at a fraction of the cost.

use std::array::from_fn;

use crate::plant::{CrossSection, Disturbance, QuadrupleTank};
use crate::scalar::{larger, smaller};

use super::implicit::{ImplicitStep, STAGES};

/// Error constant of the implicit method: a step of length x T leaves about `x⁴/1200` of a transient that decays with T.
const ERROR_CONSTANT: f64 = 1.0 / 1200.0;

/// Error allowed to a transient of one tank, as a fraction of the water in the plant; this keeps trajectories within
/// 1e-6 of a step.
const TOLERANCE: f64 = 5e-9;

/// A step shorter than this share of every time constant is taken explicitly: what the method then leaves of a transient,
/// `x⁵/120`, is about 1e-8.
const EXPLICIT_SHARE: f64 = 1.0 / 15.0;

/// With more explicit steps than this the implicit method is cheaper.
const MOST_EXPLICIT_STEPS: f64 = 8.0;

/// Most sub-steps between two rows of a trajectory. The method is stable with any.
const MAX_STEPS: u32 = 8;

/// What touched a wall or the bottom, and when, as seen by [`Hydraulics::advance`].
pub(super) trait Watch {
    /// The level of `tank` reached the top of its walls at `time`.
    fn overflow(&mut self, tank: usize, time: f64);
    /// `tank` ran dry at `time`.
    fn empty(&mut self, tank: usize, time: f64);
}

/// √h at which a tank that held water has run dry: h = 1e-6 m.
pub(super) const EMPTY_ROOT_LEVEL: f64 = 1e-3;

/// The water in the plant, and the inputs that hold for the time being.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hydraulics {
    sections: [CrossSection; 4],
    /// √h at the top of the walls.
    root_height: [f64; 4],
    /// √(2 g), the speed of a free fall per √level.
    root_gravity: f64,
    /// Flow per √level through the outlets (m^2.5/s).
    outlet: [f64; 4],
    /// Flow per √level through outlets and leaks (m^2.5/s).
    drain: [f64; 4],
    /// Flow from the pumps into each tank (m³/s).
    pumped: [f64; 4],
    /// √h of each tank.
    root_level: [f64; 4],
    /// Steps of the integration so far.
    steps: u64,
}

impl Hydraulics {
    /// The plant with given levels (m), clipped to its walls, and all inputs zero.
    pub(super) fn new(plant: &QuadrupleTank, levels: &[f64; 4]) -> Self {
        let root_gravity = (2.0 * plant.gravity).sqrt();
        let outlet = plant.tanks.map(|tank| tank.outlet.effective_area() * root_gravity);
        let root_height = plant.tanks.map(|tank| tank.height.max(0.0).sqrt());
        Self {
            sections: plant.tanks.map(|tank| tank.section),
            root_height,
            root_gravity,
            outlet,
            drain: outlet,
            pumped: [0.0; 4],
            root_level: from_fn(|i| levels[i].max(0.0).sqrt().min(root_height[i])),
            steps: 0,
        }
    }

    /// Steps of the integration so far.
    pub(super) fn steps_taken(&self) -> u64 {
        self.steps
    }

    /// Sets the inputs that hold from now on.
    pub(super) fn set_inputs(&mut self, plant: &QuadrupleTank, pump_voltage: &[f64; 2], disturbance: &Disturbance) {
        self.pumped = plant.valve_flows(pump_voltage, disturbance);
        self.drain = from_fn(|i| self.outlet[i] + disturbance.leak_area[i] * self.root_gravity);
    }

    /// Levels (m).
    pub(super) fn levels(&self) -> [f64; 4] {
        let [root_1, root_2, root_3, root_4] = self.root_level;
        [root_1 * root_1, root_2 * root_2, root_3 * root_3, root_4 * root_4]
    }

    /// Lets `duration` seconds pass from `time` on.
    pub(super) fn advance(&mut self, time: f64, duration: f64, watch: &mut dyn Watch) {
        // In units of the longest explicit step.
        let length = duration * self.fastest_rate() / EXPLICIT_SHARE;
        if length <= MOST_EXPLICIT_STEPS {
            let steps = larger(length.ceil(), 1.0);
            let step = duration / steps;
            let pumped = self.pumped;
            let mut done = 0.0;
            while done < steps {
                self.explicit_step(time + done * step, step, [&pumped; 3], watch);
                done += 1.0;
            }
            return;
        }
        let steps = self.steps(duration);
        if steps == 1 {
            return self.step(time, duration, watch);
        }
        let step = duration / f64::from(steps);
        for k in 0..steps {
            self.step(time + f64::from(k) * step, step, watch);
        }
    }

    /// The same with flows from the pumps that move with time, in steps of at most `longest` seconds. An explicit step sees
    /// them at its stages; an implicit one, which only a tank that is almost dry asks for, holds those of its middle.
    pub(super) fn advance_with(
        &mut self,
        time: f64,
        duration: f64,
        longest: f64,
        pumped: impl Fn(f64) -> [f64; 4],
        watch: &mut dyn Watch,
    ) {
        let pieces = larger((duration / longest).ceil(), 1.0);
        let piece = duration / pieces;
        let mut at_end = pumped(time);
        let mut done = 0.0;
        while done < pieces {
            let begin = time + done * piece;
            self.pumped = pumped(begin + piece / 2.0);
            let length = piece * self.fastest_rate() / EXPLICIT_SHARE;
            let is_explicit = length <= MOST_EXPLICIT_STEPS;
            let steps = if is_explicit { larger(length.ceil(), 1.0) } else { f64::from(MAX_STEPS) };
            let step = piece / steps;
            let mut taken = 0.0;
            while taken < steps {
                let now = begin + taken * step;
                if steps > 1.0 {
                    self.pumped = pumped(now + step / 2.0);
                }
                let (at_begin, middle) = (at_end, self.pumped);
                at_end = pumped(now + step);
                if is_explicit {
                    self.explicit_step(now, step, [&at_begin, &middle, &at_end], watch);
                } else {
                    self.step(now, step, watch);
                }
                taken += 1.0;
            }
            done += 1.0;
        }
    }

    /// The largest 1/T of the tanks (1/s); unbounded where one is dry.
    fn fastest_rate(&self) -> f64 {
        larger(larger(self.rate(0), self.rate(1)), larger(self.rate(2), self.rate(3)))
    }

    /// 1/T of a tank (1/s), `T = 2 A √h/drain`; 0 for one that is dry and receives nothing.
    #[expect(clippy::inline_always, reason = "as above")]
    #[inline(always)]
    fn rate(&self, i: usize) -> f64 {
        let root = self.root_level[i];
        if root == 0.0 && self.receives_nothing(i) {
            return 0.0;
        }
        self.drain[i] / (2.0 * self.sections[i].area(root * root) * root)
    }

    /// Whether no water comes into a tank at the moment.
    fn receives_nothing(&self, i: usize) -> bool {
        self.pumped[i] == 0.0 && (i >= 2 || self.root_level[i + 2] == 0.0)
    }

    /// Whether a tank that receives nothing is empty after a step: its √h falls by at least `drain/2A` in a second, with A
    /// the widest surface on the way (Torricelli). The stages of the implicit method only come close to that.
    fn runs_dry(&self, i: usize, step: f64) -> bool {
        let (root, section) = (self.root_level[i], self.sections[i]);
        let widest = larger(section.area(root * root), section.area_at_empty);
        self.receives_nothing(i) && 2.0 * widest * root <= self.drain[i] * step
    }

    /// Slopes of the levels (m/s) at given levels (m).
    #[expect(clippy::inline_always, reason = "measured: written out like this it is fast at any optimisation level")]
    #[inline(always)]
    fn slopes(&self, [h1, h2, h3, h4]: [f64; 4], pumped: &[f64; 4]) -> [f64; 4] {
        let root = |level: f64| larger(level, 0.0).sqrt();
        let (root_1, root_2, root_3, root_4) = (root(h1), root(h2), root(h3), root(h4));
        let [drain_1, drain_2, drain_3, drain_4] = self.drain;
        let [pumped_1, pumped_2, pumped_3, pumped_4] = *pumped;
        [
            (pumped_1 + self.outlet[2] * root_3 - drain_1 * root_1) / self.sections[0].area(h1),
            (pumped_2 + self.outlet[3] * root_4 - drain_2 * root_2) / self.sections[1].area(h2),
            (pumped_3 - drain_3 * root_3) / self.sections[2].area(h3),
            (pumped_4 - drain_4 * root_4) / self.sections[3].area(h4),
        ]
    }

    /// The classical Runge–Kutta step of order 4, with the flows from the pumps at its beginning, middle and end.
    #[expect(clippy::inline_always, reason = "measured, as above: three equal flows then cost nothing")]
    #[inline(always)]
    fn explicit_step(&mut self, time: f64, step: f64, pumped: [&[f64; 4]; 3], watch: &mut dyn Watch) {
        self.steps += 1;
        let h = self.levels();
        let from_here = |k: [f64; 4], by: f64| [h[0] + by * k[0], h[1] + by * k[1], h[2] + by * k[2], h[3] + by * k[3]];
        let k1 = self.slopes(h, pumped[0]);
        let k2 = self.slopes(from_here(k1, step / 2.0), pumped[1]);
        let k3 = self.slopes(from_here(k2, step / 2.0), pumped[1]);
        let k4 = self.slopes(from_here(k3, step), pumped[2]);
        for tank in 0..4 {
            let end = h[tank] + step / 6.0 * (k1[tank] + 2.0 * (k2[tank] + k3[tank]) + k4[tank]);
            self.settle(tank, larger(end, 0.0).sqrt(), time, step, watch);
        }
    }

    /// Number of sub-steps for a stretch of time: as many as the transients need that are large enough to matter.
    ///
    /// The error of a step to be expected in a tank is, of its distance from the level at which its outflow would equal
    /// its inflow, the share `c x⁴/(1 + c x⁴)` with `x = step/T`, `T = 2 A √h/drain`, which is right for small x and for
    /// large. So neither an almost dry tank that follows its inflow nor a plant at rest asks for short steps.
    fn steps(&self, duration: f64) -> u32 {
        let [root_1, root_2, root_3, root_4] = self.root_level;
        let allowed = TOLERANCE * (root_1 * root_1 + root_2 * root_2 + root_3 * root_3 + root_4 * root_4);
        let above = [self.outlet[2] * root_3, self.outlet[3] * root_4, 0.0, 0.0];
        let mut steps = 1.0;
        for (i, (root, above)) in self.root_level.into_iter().zip(above).enumerate() {
            let root_at_rest = (self.pumped[i] + above) / self.drain[i];
            let distance = (root_at_rest - root).abs() * (root_at_rest + root);
            if distance > allowed {
                let x = duration * self.rate(i);
                let needed = (ERROR_CONSTANT * (distance - allowed) / allowed).sqrt().sqrt() * x;
                steps = larger(steps, needed.ceil());
            }
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 1 and MAX_STEPS")]
        let steps = smaller(steps, f64::from(MAX_STEPS)) as u32;
        steps
    }

    fn step(&mut self, time: f64, step: f64, watch: &mut dyn Watch) {
        self.steps += 1;
        let start = |i: usize| ImplicitStep::new(self.sections[i], self.root_level[i], self.drain[i], step);
        let upper = |i: usize| start(i).root_levels(self.pumped[i], &[0.0; STAGES]);
        let lower = |i: usize, above: &[f64; STAGES]| {
            let flow = above.map(|root| self.outlet[i + 2] * root);
            start(i).root_levels(self.pumped[i], &flow)[STAGES - 1]
        };
        let (third, fourth) = (upper(2), upper(3));
        let ends = [lower(0, &third), lower(1, &fourth), third[STAGES - 1], fourth[STAGES - 1]];
        let dry = [0, 1, 2, 3].map(|i| self.runs_dry(i, step));
        for (tank, end) in ends.into_iter().enumerate() {
            let end = if dry[tank] { 0.0 } else { end };
            self.settle(tank, end, time, step, watch);
        }
    }

    /// Takes over the result of a step, kept within the walls, and tells when it met them.
    #[expect(clippy::inline_always, reason = "measured, as above; what is rare is apart")]
    #[inline(always)]
    fn settle(&mut self, tank: usize, end: f64, time: f64, step: f64, watch: &mut dyn Watch) {
        let top = self.root_height[tank];
        if end > top || end <= EMPTY_ROOT_LEVEL {
            self.tell(tank, end, time, step, watch);
        }
        self.root_level[tank] = smaller(end, top);
    }

    /// Tells when, on the way to `end`, the level met wall or bottom.
    #[inline(never)]
    fn tell(&self, tank: usize, end: f64, time: f64, step: f64, watch: &mut dyn Watch) {
        let start = self.root_level[tank];
        let reached = |root: f64| time + step * ((root - start) / (end - start)).clamp(0.0, 1.0);
        let (top, bottom) = (self.root_height[tank], EMPTY_ROOT_LEVEL);
        if end > top {
            watch.overflow(tank, reached(top));
        }
        if end <= bottom && start > bottom {
            watch.empty(tank, reached(bottom));
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::plant::PresetId;

    use super::*;

    struct Nobody;

    impl Watch for Nobody {
        fn overflow(&mut self, _: usize, _: f64) {}
        fn empty(&mut self, _: usize, _: f64) {}
    }

    const LOADS: Disturbance = Disturbance { pump_flow: [1e-6, -1e-6], leak_area: [1e-6, 0.0, 2e-6, 1e-7] };

    fn follows_the_equations(take: fn(&mut Hydraulics, f64)) {
        for id in PresetId::ALL {
            let preset = id.preset();
            let levels = [0.1, 0.12, 0.03, 0.05];
            let voltage = preset.pump_voltage;
            let mut water = Hydraulics::new(&preset.plant, &levels);
            water.set_inputs(&preset.plant, &voltage, &LOADS);
            let short = 1e-4;
            take(&mut water, short);
            let expected = preset.plant.derivative(&levels, &voltage, &LOADS);
            for i in 0..4 {
                let slope = (water.levels()[i] - levels[i]) / short;
                // Second order in the step, and what rounding leaves of a difference of levels.
                assert!(
                    (slope - expected[i]).abs() <= 1e-5 * expected[i].abs() + 1e-11,
                    "{id:?} {i}: {slope} {expected:?}"
                );
            }
        }
    }

    #[test]
    fn a_short_step_of_either_method_follows_the_equations_of_the_plant() {
        follows_the_equations(|water, duration| water.advance(0.0, duration, &mut Nobody));
        follows_the_equations(|water, duration| water.step(0.0, duration, &mut Nobody));
        follows_the_equations(|water, duration| {
            let pumped = water.pumped;
            water.explicit_step(0.0, duration, [&pumped; 3], &mut Nobody);
        });
        follows_the_equations(|water, duration| {
            let pumped = water.pumped;
            water.advance_with(0.0, duration, 1.0, |_| pumped, &mut Nobody);
        });
    }

    #[test]
    fn a_tank_that_is_wide_below_takes_its_time_to_run_dry() {
        let mut plant = PresetId::JohanssonMinimumPhase.preset().plant;
        plant.tanks[2].section = CrossSection { area_at_empty: 0.01, area_slope: -0.04 };
        let mut water = Hydraulics::new(&plant, &[0.0, 0.0, 0.1, 0.0]);
        // Torricelli: 2 A √h + ⅔ A′ h√h, over the drain. With the area at the surface alone it would be 0.0038.
        let takes = (2.0 * 0.01 * 0.1_f64.sqrt() - 2.0 / 3.0 * 0.04 * 0.1_f64.powf(1.5)) / water.outlet[2];
        water.step(0.0, 0.8 * takes, &mut Nobody);
        assert!(water.levels()[2] > 1e-4);
        water.step(0.0, 0.4 * takes, &mut Nobody);
        assert!(water.levels()[2] < 1e-4);
    }

    /// Worst error of the lower levels (m) against steps 64 times as short, when the pumps move every sample.
    fn error_at(valves: [f64; 2], sampling_time_s: f64) -> f64 {
        let preset = PresetId::JohanssonMinimumPhase.preset();
        let plant = preset.plant.with_valves(valves);
        let op = plant.free_equilibrium(preset.pump_voltage);
        let mut coarse = Hydraulics::new(&plant, &op.levels);
        let mut fine = coarse;
        let mut worst = 0.0_f64;
        for k in 0..500 {
            let time = f64::from(k) * sampling_time_s;
            let swing = 1.0 + 0.05 * (time / 37.0).sin() + if k % 60 < 30 { 0.05 } else { 0.0 };
            let voltage = op.pump_voltage.map(|voltage| swing * voltage);
            for water in [&mut coarse, &mut fine] {
                water.set_inputs(&plant, &voltage, &Disturbance::default());
            }
            coarse.advance(time, sampling_time_s, &mut Nobody);
            for _ in 0..64 {
                fine.step(time, sampling_time_s / 64.0, &mut Nobody);
            }
            worst = (0..2).map(|i| (coarse.levels()[i] - fine.levels()[i]).abs()).fold(worst, f64::max);
        }
        worst
    }

    #[test]
    fn every_corner_of_the_valve_plane_is_within_the_bar() {
        // 1e-6 of a step of 5 % of the level, on the same plant.
        let bar = 1e-6 * 0.05 * 0.12;
        for gamma in [0.1, 0.5, 0.8, 0.95, 0.99, 0.999, 0.99999, 1.0] {
            for sampling_time_s in [1.0, 5.0, 20.0] {
                let error = error_at([gamma, gamma], sampling_time_s);
                assert!(error <= bar, "gamma {gamma}, Ts {sampling_time_s} s: {error} m");
            }
        }
    }

    #[test]
    fn at_rest_one_step_is_enough_even_if_a_tank_is_almost_dry() {
        for gamma in [0.5, 0.99, 0.999_99, 1.0] {
            let preset = PresetId::JohanssonMinimumPhase.preset();
            let plant = preset.plant.with_valves([gamma, gamma]);
            let op = plant.free_equilibrium(preset.pump_voltage);
            let mut water = Hydraulics::new(&plant, &op.levels);
            water.set_inputs(&plant, &op.pump_voltage, &Disturbance::default());
            assert_eq!(water.steps(1.0), 1);
            water.advance(0.0, 1.0, &mut Nobody);
            for i in 0..4 {
                assert!((water.levels()[i] - op.levels[i]).abs() <= 1e-14);
            }
        }
    }

    #[test]
    fn a_tank_without_inflow_is_dry_when_torricelli_says_so_and_stays_dry() {
        let plant = PresetId::JohanssonMinimumPhase.preset().plant;
        // A step that ends above nothing by rounding alone was once held for ever from some of these.
        for at in 0..200 {
            let start = 0.19 * 0.9_f64.powi(at);
            let mut water = Hydraulics::new(&plant, &[0.1, 0.1, start, 0.0]);
            water.set_inputs(&plant, &[3.0, 0.0], &Disturbance::default());
            let dry_after = start.sqrt() * 2.0 * plant.tanks[2].section.area_at_empty / water.outlet[2];
            let mut time = 0.0;
            // One sample more for the error of the steps before.
            while time < dry_after + 1.0 {
                water.advance(time, 1.0, &mut Nobody);
                time += 1.0;
            }
            assert_eq!(water.levels()[2], 0.0, "from {start} m");
        }
    }

    #[test]
    fn a_tank_without_inflow_drains_by_torricelli() {
        // Johansson's tank 3 alone: √h falls linearly, whatever the size of the steps.
        let plant = PresetId::JohanssonMinimumPhase.preset().plant;
        let start = 0.1_f64;
        let mut water = Hydraulics::new(&plant, &[0.0, 0.0, start, 0.0]);
        water.advance(0.0, 20.0, &mut Nobody);
        let rate = water.outlet[2] / (2.0 * plant.tanks[2].section.area_at_empty);
        let expected = (start.sqrt() - 20.0 * rate).powi(2);
        assert!((water.levels()[2] - expected).abs() <= 1e-7 * start, "{} instead of {expected}", water.levels()[2]);
        water.advance(20.0, 1e4, &mut Nobody);
        assert!(water.levels()[2] < 1e-6);
    }
}
