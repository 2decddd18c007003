//! The water of the nonlinear plant: its state, its inputs and the equations of its tanks.
//!
//! Each tank is in one of three modes, each with its own equation:
//!
//! - *free*: `A(h) dh/dt = inflow − drain √h`;
//! - *full*: the level stays at the top of the wall while the inflow is at least the drain at that level. The excess
//!   overflows and leaves the plant; the flow through the outlet is constant;
//! - *dry*: the level is 0 as long as nothing comes in. This is the free equation at level 0.

use std::array::from_fn;

use crate::numeric::{larger, smaller};
use crate::plant::{CrossSection, Disturbance, QuadrupleTank};

/// What rounding leaves of the flow balance of a tank at rest, as a share of the flow.
const REST: f64 = 8.0 * f64::EPSILON;

/// The water in the plant, and the inputs that hold for the time being.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hydraulics {
    pub(super) sections: [CrossSection; 4],
    /// Height of the walls (m).
    height: [f64; 4],
    /// √h at the top of the walls.
    pub(super) root_height: [f64; 4],
    /// Water in each tank when it is full (m³).
    pub(super) full_volume: [f64; 4],
    /// √(2 g), the speed of a free fall per √level.
    root_gravity: f64,
    /// Flow per √level through the outlets as they are without loads (m^2.5/s).
    own_outlet: [f64; 4],
    /// Flow per √level through the outlets under the loads (m^2.5/s).
    pub(super) outlet: [f64; 4],
    /// Flow per √level through outlets and leaks (m^2.5/s).
    pub(super) drain: [f64; 4],
    /// Flow from the pumps and from outside into each tank (m³/s).
    pub(super) pumped: [f64; 4],
    /// Level of each tank (m).
    level: [f64; 4],
    /// √h of each tank.
    pub(super) root_level: [f64; 4],
    /// Tanks in the mode *full*.
    pub(super) is_full: [bool; 4],
    /// Work of the integration so far, in explicit steps: those tried in vain and those of the search for events count too.
    pub(super) work: u64,
}

impl Hydraulics {
    /// The plant with given levels (m), clipped to its walls, and all inputs zero.
    pub(super) fn new(plant: &QuadrupleTank, levels: &[f64; 4]) -> Self {
        let root_gravity = (2.0 * plant.gravity).sqrt();
        let outlet = plant.tanks.map(|tank| tank.outlet.effective_area() * root_gravity);
        let height = plant.tanks.map(|tank| tank.height.max(0.0));
        let level: [f64; 4] = from_fn(|i| levels[i].max(0.0).min(height[i]));
        Self {
            sections: plant.tanks.map(|tank| tank.section),
            height,
            root_height: height.map(f64::sqrt),
            full_volume: from_fn(|i| plant.tanks[i].section.volume(height[i])),
            root_gravity,
            own_outlet: outlet,
            outlet,
            drain: outlet,
            pumped: [0.0; 4],
            level,
            root_level: level.map(f64::sqrt),
            is_full: [false; 4],
            work: 0,
        }
    }

    /// Sets the inputs that hold from now on.
    pub(super) fn set_inputs(&mut self, plant: &QuadrupleTank, pump_voltage: &[f64; 2], disturbance: &Disturbance) {
        self.pumped = plant.feed_flows(pump_voltage, disturbance);
        let share = disturbance.outlet_share();
        self.outlet = from_fn(|i| share[i] * self.own_outlet[i]);
        self.drain = from_fn(|i| self.outlet[i] + disturbance.leak_area[i] * self.root_gravity);
    }

    /// Levels (m).
    pub(super) fn levels(&self) -> [f64; 4] {
        self.level
    }

    /// Flow into a tank (m³/s), at given √h and flows from the pumps.
    #[inline]
    pub(super) fn inflow(&self, i: usize, root_level: &[f64; 4], pumped: &[f64; 4]) -> f64 {
        if i < 2 { pumped[i] + self.outlet[i + 2] * root_level[i + 2] } else { pumped[i] }
    }

    /// Flow into a tank less the flow out of it (m³/s), at given √h and flows from the pumps, as if it had no wall.
    #[inline]
    pub(super) fn net_inflow(&self, i: usize, root_level: &[f64; 4], pumped: &[f64; 4]) -> f64 {
        self.inflow(i, root_level, pumped) - self.drain[i] * root_level[i]
    }

    /// Slopes of the levels (m/s) at given levels (m).
    #[expect(clippy::inline_always, reason = "measured: written out like this it is fast at any optimisation level")]
    #[inline(always)]
    pub(super) fn slopes(&self, levels: [f64; 4], pumped: &[f64; 4]) -> [f64; 4] {
        let [h1, h2, h3, h4] = levels;
        let root = |level: f64| larger(level, 0.0).sqrt();
        let roots = [root(h1), root(h2), root(h3), root(h4)];
        let slope = |i: usize| {
            if self.is_full[i] { 0.0 } else { self.net_inflow(i, &roots, pumped) / self.sections[i].area(levels[i]) }
        };
        [slope(0), slope(1), slope(2), slope(3)]
    }

    /// The largest [`rate`](Self::rate) of the tanks (1/s); unbounded where one is empty but receives water.
    pub(super) fn fastest_rate(&self) -> f64 {
        larger(larger(self.rate(0), self.rate(1)), larger(self.rate(2), self.rate(3)))
    }

    /// How fast √h of a tank may change, as a share of itself (1/s): `max(inflow, outflow)/(2 A h)`, which is 1/T of its
    /// linear model at rest. 0 for a tank whose level cannot move, full or dry.
    #[expect(clippy::inline_always, reason = "measured: part of every integration step")]
    #[inline(always)]
    fn rate(&self, i: usize) -> f64 {
        let root = self.root_level[i];
        let flow = larger(self.inflow(i, &self.root_level, &self.pumped), self.drain[i] * root);
        if self.is_full[i] || flow == 0.0 {
            return 0.0;
        }
        let level = root * root;
        flow / (2.0 * self.sections[i].area(level) * level)
    }

    /// Whether no water comes into a tank as long as the pumps give what they do.
    pub(super) fn is_cut_off(&self, i: usize, pumped: &[f64; 4]) -> bool {
        pumped[i] == 0.0 && (i >= 2 || self.root_level[i + 2] == 0.0 && pumped[i + 2] == 0.0)
    }

    /// Time (s) in which a tank that receives nothing runs dry.
    pub(super) fn emptying_time(&self, i: usize) -> f64 {
        emptying_volume(self.sections[i], self.root_level[i]) / self.drain[i]
    }

    /// Takes over the √h at the end of a step, without what rounding has left above a wall.
    #[expect(clippy::inline_always, reason = "measured: part of every integration step")]
    #[inline(always)]
    pub(super) fn take(&mut self, ends: [f64; 4]) {
        for (i, end) in ends.into_iter().enumerate() {
            if !self.is_full[i] {
                self.root_level[i] = smaller(end, self.root_height[i]);
                self.level[i] = smaller(end * end, self.height[i]);
            }
        }
    }

    /// Makes a tank full, at exactly the height of its wall, or ends that.
    pub(super) fn set_full(&mut self, i: usize, is_full: bool) {
        self.is_full[i] = is_full;
        (self.root_level[i], self.level[i]) = (self.root_height[i], self.height[i]);
    }

    /// Makes a tank dry.
    pub(super) fn set_dry(&mut self, i: usize) {
        (self.root_level[i], self.level[i]) = (0.0, 0.0);
    }

    /// Whether the inflow of each tank equals its outflow to rounding.
    pub(super) fn is_at_rest(&self) -> bool {
        (0..4).all(|i| {
            let (inflow, outflow) =
                (self.inflow(i, &self.root_level, &self.pumped), self.drain[i] * self.root_level[i]);
            (inflow - outflow).abs() <= REST * inflow
        })
    }
}

/// `∫ A(h)/√h dh` from 0 to the level (m^2.5), which over the drain is the time in which a tank empties (Torricelli).
pub(super) fn emptying_volume(section: CrossSection, root_level: f64) -> f64 {
    root_level * (2.0 * section.area_at_empty + 2.0 / 3.0 * section.area_slope * root_level * root_level)
}
