//! Integration of the nonlinear plant in time.
//!
//! The plant is written in volumes, `dV/dt = inflow − drain √h`, and each tank is fed only by the pumps and by the tank
//! above it. An implicit Runge–Kutta stage is then one tank after the other, from the top, and each is an equation in
//! √h with a closed solution. So an L-stable method costs no more than an explicit one, and a tank that is almost dry,
//! whose time constant goes to 0 with √h, needs no special care. Volumes also make the water balance exact.
//!
//! Where the step is short against every time constant, which is the ordinary case, the classical Runge–Kutta method does
//! the same at a fraction of the cost.
//!
//! A step ends where a tank becomes full, leaves its wall or runs dry; the next one begins there in the new mode.

use std::cell::Cell;

use crate::numeric::{larger, smaller};

use super::hydraulics::Hydraulics;
use super::implicit::NODES;
use super::walls::{Attempt, Watch};

/// Error of one implicit step, as a fraction of the levels; this keeps trajectories within 1e-6 of a step.
const TOLERANCE: f64 = 2e-8;
/// A plant with less water than this counts as one with so much (m).
const MIN_LEVEL: f64 = 1e-6;

/// Of the step that should just meet the tolerance, the share that is taken.
const SAFETY: f64 = 0.9;
/// By how much an implicit step is longer or shorter than the one before at most.
const MAX_GROWTH: f64 = 4.0;
const MAX_SHRINKAGE: f64 = 0.1;
/// Implicit steps of one stretch of time that may be tried in vain. A tank that begins to fill takes about 10; beyond
/// this steps are as long as they can be, with which the method is still stable.
const MAX_SPARE_TRIES: u32 = 100;

/// A step shorter than this share of every time constant is taken explicitly: what the method then leaves of a transient,
/// `x⁵/120`, is about 1e-8.
const EXPLICIT_SHARE: f64 = 1.0 / 15.0;

/// With more explicit steps than this the implicit method is cheaper.
const MAX_EXPLICIT_STEPS: f64 = 8.0;
/// Work of an implicit step, in explicit ones.
const IMPLICIT_WORK: u64 = 8;

/// How the implicit steps of a stretch of time go on.
struct Pace {
    /// Length with which the next step is tried first (s).
    next_step: f64,
    /// Tries in vain that are left.
    spare_tries: u32,
}

impl Pace {
    fn new(first_step: f64) -> Self {
        Self { next_step: first_step, spare_tries: MAX_SPARE_TRIES }
    }
}

impl Hydraulics {
    /// Lets `duration` seconds pass from `time` on. A plant at rest stays there exactly: a loop of high gain would make an
    /// oscillation of what rounding moves.
    pub(super) fn advance(&mut self, time: f64, duration: f64, watch: &mut dyn Watch) {
        if self.is_at_rest() {
            return;
        }
        let pumped = self.pumped;
        self.advance_with(time, duration, f64::INFINITY, |_| pumped, watch);
    }

    /// The same with flows from the pumps (m³/s) that move with time, in steps of at most `longest` seconds.
    pub(super) fn advance_with(
        &mut self,
        time: f64,
        duration: f64,
        longest: f64,
        pumped: impl Fn(f64) -> [f64; 4],
        watch: &mut dyn Watch,
    ) {
        let mut left = duration;
        let mut pace = Pace::new(longest);
        while left > 0.0 {
            let begin = time + (duration - left);
            left -= self.pass(begin, smaller(left, longest), &mut pace, &pumped, watch);
        }
    }

    /// Takes a step of at most `longest` seconds from `begin` on, up to the first event. Gives back its length.
    fn pass(
        &mut self,
        begin: f64,
        longest: f64,
        pace: &mut Pace,
        pumped: &impl Fn(f64) -> [f64; 4],
        watch: &mut dyn Watch,
    ) -> f64 {
        let flows = [0.0, 0.5, 1.0].map(|share| pumped(begin + share * longest));
        self.pumped = flows[1];
        let length = longest * self.fastest_rate() / EXPLICIT_SHARE;
        let (dry_after, drying) = self.first_dry(&flows);
        if length <= MAX_EXPLICIT_STEPS && longest < dry_after {
            let steps = larger(length.ceil(), 1.0);
            let step = longest / steps;
            let at_stages =
                if steps == 1.0 { flows } else { [0.0, 0.5, 1.0].map(|share| pumped(begin + share * step)) };
            return self.pass_explicitly(begin, step, &at_stages, pumped, watch);
        }
        let longest = smaller(longest, dry_after);
        let passed = self.pass_implicitly(begin, longest, pace, pumped, watch);
        if passed == dry_after {
            self.set_dry(drying);
        }
        passed
    }

    /// When the first tank runs dry (s), and which; never, where none does that receives nothing.
    fn first_dry(&self, pumped: &[[f64; 4]; 3]) -> (f64, usize) {
        let mut first = (f64::INFINITY, 0);
        for i in 0..4 {
            if self.root_level[i] > 0.0 && pumped.iter().all(|pumped| self.is_cut_off(i, pumped)) {
                let after = self.emptying_time(i);
                if after < first.0 {
                    first = (after, i);
                }
            }
        }
        first
    }

    fn pass_explicitly(
        &mut self,
        begin: f64,
        step: f64,
        at_stages: &[[f64; 4]; 3],
        pumped: &impl Fn(f64) -> [f64; 4],
        watch: &mut dyn Watch,
    ) -> f64 {
        let ends = self.explicit_step(step, at_stages);
        self.work += 1;
        if self.may_meet_walls(step, &at_stages[0], &ends) {
            let (water, tries) = (*self, Cell::new(0));
            let flows = |length: f64| [0.0, 0.5, 1.0].map(|share| pumped(begin + share * length));
            let root_levels = |length: f64| {
                tries.update(|tries| tries + 1);
                water.explicit_step(length, &flows(length))
            };
            let pumped = |at: f64| pumped(begin + at);
            let attempt = Attempt { begin, step, ends, root_levels: &root_levels, pumped: &pumped };
            let passed = self.take_to_event(&attempt, watch);
            self.work += tries.get();
            return passed;
        }
        self.take(ends);
        step
    }

    fn pass_implicitly(
        &mut self,
        begin: f64,
        longest: f64,
        pace: &mut Pace,
        pumped: &impl Fn(f64) -> [f64; 4],
        watch: &mut dyn Watch,
    ) -> f64 {
        let spare_tries = pace.spare_tries;
        let (step, ends) = self.controlled_step(begin, longest, pace, pumped);
        self.work += IMPLICIT_WORK * (1 + u64::from(spare_tries - pace.spare_tries));
        if self.may_meet_walls(step, &pumped(begin), &ends) {
            let (water, tries) = (*self, Cell::new(0));
            let root_levels = |length: f64| {
                tries.update(|tries| tries + 1);
                water.implicit_course(begin, length, pumped)
            };
            let pumped = |at: f64| pumped(begin + at);
            let attempt = Attempt { begin, step, ends, root_levels: &root_levels, pumped: &pumped };
            let passed = self.take_to_event(&attempt, watch);
            self.work += IMPLICIT_WORK * tries.get();
            return passed;
        }
        self.take(ends);
        step
    }

    /// √h after a duration (s) of implicit steps, as if no mode changed.
    fn implicit_course(&self, begin: f64, duration: f64, pumped: &impl Fn(f64) -> [f64; 4]) -> [f64; 4] {
        let mut water = *self;
        let (mut left, mut pace) = (duration, Pace::new(duration));
        while left > 0.0 {
            let (step, ends) = water.controlled_step(begin + (duration - left), left, &mut pace, pumped);
            water.root_level = ends;
            left -= step;
        }
        water.root_level
    }

    /// An implicit step of at most `longest` seconds, as short as its error asks for: its length and √h at its end.
    fn controlled_step(
        &self,
        begin: f64,
        longest: f64,
        pace: &mut Pace,
        pumped: &impl Fn(f64) -> [f64; 4],
    ) -> (f64, [f64; 4]) {
        let try_step = |step: f64| self.implicit_step(step, &NODES.map(|node| pumped(begin + node * step)));
        let allowed = self.allowed_error();
        let mut step = smaller(longest, pace.next_step);
        let (mut ends, mut error) = try_step(step);
        // Of order 3, its error grows with the fourth power of the step.
        let change = |error: f64| SAFETY * (allowed / error).sqrt().sqrt();
        while error > allowed && pace.spare_tries > 0 {
            pace.spare_tries -= 1;
            step *= larger(change(error), MAX_SHRINKAGE);
            (ends, error) = try_step(step);
        }
        pace.next_step = if pace.spare_tries > 0 { step * smaller(change(error), MAX_GROWTH) } else { f64::INFINITY };
        (step, ends)
    }

    /// Error allowed to a step (m): a share of the levels, or of those that the inflows would come to rest at.
    fn allowed_error(&self) -> f64 {
        let level = |i: usize| {
            let at_rest = self.inflow(i, &self.root_level, &self.pumped) / self.drain[i];
            let at_rest = smaller(at_rest, self.root_height[i]);
            let root = larger(at_rest, self.root_level[i]);
            root * root
        };
        TOLERANCE * (MIN_LEVEL + level(0) + level(1) + level(2) + level(3))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::literature::PresetId;
    use crate::plant::{CrossSection, Disturbance, Tank};
    use crate::sim::implicit::STAGES;

    struct Nobody;

    impl Watch for Nobody {
        fn overflow(&mut self, _: usize, _: f64) {}
        fn empty(&mut self, _: usize, _: f64) {}
    }

    const LOADS: Disturbance = Disturbance {
        pump_flow: [1e-6, -1e-6],
        leak_area: [1e-6, 0.0, 2e-6, 1e-7],
        tank_flow: [0.0, 0.0, 5e-7, -1e-6],
        pump_gain_change: [-0.25, 0.125],
        valve_change: [0.125, -0.25],
        outlet_change: [-0.5, 0.0, 0.25, -1.0],
    };

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
            let fastest = expected.iter().fold(0.0, |most: f64, slope| most.max(slope.abs()));
            for i in 0..4 {
                let slope = (water.levels()[i] - levels[i]) / short;
                // Second order in the step, and what rounding leaves of a difference of levels.
                assert!((slope - expected[i]).abs() <= 1e-5 * fastest + 1e-11, "{id:?} {i}: {slope} {expected:?}");
            }
        }
    }

    #[test]
    fn a_short_step_of_either_method_follows_the_equations_of_the_plant() {
        follows_the_equations(|water, duration| water.advance(0.0, duration, &mut Nobody));
        follows_the_equations(|water, duration| {
            let (ends, _) = water.implicit_step(duration, &[water.pumped; STAGES]);
            water.take(ends);
        });
        follows_the_equations(|water, duration| {
            let ends = water.explicit_step(duration, &[water.pumped; 3]);
            water.take(ends);
        });
        follows_the_equations(|water, duration| {
            let pumped = water.pumped;
            water.advance_with(0.0, duration, 1.0, |_| pumped, &mut Nobody);
        });
    }

    #[test]
    fn a_tank_of_any_shape_empties_by_torricelli() {
        for (area_at_empty, area_slope) in [(28e-4, 0.0), (0.01, -0.04), (1e-4, 0.03)] {
            let mut plant = PresetId::JohanssonMinimumPhase.preset().plant;
            plant.tanks[2].section = CrossSection { area_at_empty, area_slope };
            let emptying = |level: f64| 2.0 * area_at_empty * level.sqrt() + 2.0 / 3.0 * area_slope * level.powf(1.5);
            let start = Hydraulics::new(&plant, &[0.0, 0.0, 0.1, 0.0]);
            let takes = emptying(0.1) / start.outlet[2];
            for share in [0.5, 0.9, 0.999, 0.999_999] {
                let mut water = start;
                water.advance(0.0, share * takes, &mut Nobody);
                let left = 1.0 - emptying(water.levels()[2]) / emptying(0.1);
                assert!((left - share).abs() <= 1e-6, "{area_slope}: {left} instead of {share}");
            }
            let mut water = start;
            water.advance(0.0, takes * (1.0 + 1e-12), &mut Nobody);
            assert_eq!(water.levels()[2], 0.0);
        }
    }

    /// Without inflow a tank empties by Torricelli's law; with any, however little, it is integrated in steps. A step that ends with the
    /// tank nearly empty must not pass with a wrong estimate of its error.
    #[test]
    fn a_tank_with_a_trace_of_inflow_empties_as_one_without() {
        let mut plant = PresetId::JohanssonMinimumPhase.preset().plant;
        plant.tanks[0].section.area_slope = 0.019_138_9;
        plant.tanks = plant.tanks.map(|tank| Tank { height: 2.0, ..tank });
        let start = [0.002_311_715, 1.189_479, 0.0, 0.832_699_7];
        let after = |duration: f64, voltage: f64| {
            let mut water = Hydraulics::new(&plant, &start);
            water.set_inputs(&plant, &[voltage, 0.0], &Disturbance::default());
            water.advance(0.0, duration, &mut Nobody);
            water.levels()[0]
        };
        for hundredths in 1..=875 {
            let duration = 0.01 * f64::from(hundredths);
            let [trace, without] = [after(duration, 1e-15), after(duration, 0.0)];
            // The error that ten steps allow themselves.
            let bar = 10.0 * TOLERANCE * (start[1] + start[3]);
            assert!((trace - without).abs() <= bar, "{duration} s: {trace:e} instead of {without:e}");
        }
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
                fine.advance(time, sampling_time_s / 64.0, &mut Nobody);
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
            let (_, error) = water.implicit_step(1.0, &[water.pumped; STAGES]);
            assert!(error <= water.allowed_error());
            water.advance(0.0, 1.0, &mut Nobody);
            for i in 0..4 {
                assert!((water.levels()[i] - op.levels[i]).abs() <= 1e-14);
            }
        }
    }
}
