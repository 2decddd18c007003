//! Where within a step a tank reaches the top of its wall, comes down from it or runs dry.

use crate::numeric::root;

use super::hydraulics::Hydraulics;

/// What touched a wall or the bottom, and when, as seen by [`Hydraulics::advance`].
pub(super) trait Watch {
    /// The level of `tank` reached the top of its walls at `time`.
    fn overflow(&mut self, tank: usize, time: f64);
    /// `tank` ran dry at `time`.
    fn empty(&mut self, tank: usize, time: f64);
}

/// √h at which a tank that held water has run dry: h = 1e-6 m.
pub(super) const EMPTY_ROOT_LEVEL: f64 = 1e-3;

/// A share of the height by which rounding may lift a level that rests at the wall.
const ROUNDING: f64 = 1e-12;

/// A step that has been computed but not yet taken, as functions of the time from its beginning (s).
pub(super) struct Attempt<'a> {
    pub(super) begin: f64,
    pub(super) step: f64,
    /// √h at the end of the step.
    pub(super) ends: [f64; 4],
    /// √h after a part of the step.
    pub(super) root_levels: &'a dyn Fn(f64) -> [f64; 4],
    /// Flows from the pumps (m³/s).
    pub(super) pumped: &'a dyn Fn(f64) -> [f64; 4],
}

impl Hydraulics {
    /// Whether a step to the √h `ends` may meet a wall or the bottom, or begins with a full tank.
    #[expect(clippy::inline_always, reason = "on the way of every step")]
    #[inline(always)]
    pub(super) fn may_meet_walls(&self, step: f64, pumped_at_begin: &[f64; 4], ends: &[f64; 4]) -> bool {
        (0..4).any(|i| {
            let (start, end) = (self.root_level[i], ends[i]);
            self.is_full[i]
                || end > self.root_height[i]
                || end <= EMPTY_ROOT_LEVEL && start > EMPTY_ROOT_LEVEL
                || self.rises_to_wall(i, step, pumped_at_begin)
        })
    }

    /// Whether a tank that goes on as it begins is full within a step, even if it falls again before the end.
    #[expect(clippy::inline_always, reason = "measured: part of every integration step")]
    #[inline(always)]
    fn rises_to_wall(&self, i: usize, step: f64, pumped_at_begin: &[f64; 4]) -> bool {
        let level = self.levels()[i];
        step * self.net_inflow(i, &self.root_level, pumped_at_begin)
            > self.full_volume[i] - self.sections[i].volume(level)
    }

    /// Takes a step up to its end or to the first change of a mode, which it makes. Gives back the time that passed (s).
    #[inline(never)]
    pub(super) fn take_to_event(&mut self, attempt: &Attempt, watch: &mut dyn Watch) -> f64 {
        let event = self.first_event(attempt);
        let (passed, ends) = event.map_or((attempt.step, attempt.ends), |(at, _)| (at, (attempt.root_levels)(at)));
        for (tank, end) in ends.into_iter().enumerate() {
            let above = |root_level: f64| root_level - EMPTY_ROOT_LEVEL;
            let start = self.root_level[tank];
            if above(start) > 0.0 && above(end) <= 0.0 {
                let level = |at: f64| above((attempt.root_levels)(at)[tank]);
                watch.empty(tank, attempt.begin + root(level, (0.0, above(start)), (passed, above(end))));
            }
        }
        self.take(ends);
        if let Some((_, tank)) = event {
            self.set_full(tank, !self.is_full[tank]);
            if self.is_full[tank] {
                watch.overflow(tank, attempt.begin + passed);
            }
        }
        passed
    }

    /// The first tank that becomes full or leaves its wall within a step, and when from its beginning (s).
    fn first_event(&self, attempt: &Attempt) -> Option<(f64, usize)> {
        let events = (0..4).filter_map(|i| self.change_of_mode(i, attempt).map(|at| (at, i)));
        events.min_by(|(one, _), (other, _)| one.total_cmp(other))
    }

    fn change_of_mode(&self, i: usize, attempt: &Attempt) -> Option<f64> {
        let Attempt { step, ends, root_levels, pumped, .. } = attempt;
        let net = |at: f64, roots: &[f64; 4]| self.net_inflow(i, roots, &pumped(at));
        let net_at_start = net(0.0, &self.root_level);
        if self.is_full[i] {
            let is_steady = [0.5, 1.0].into_iter().all(|share| pumped(share * step) == pumped(0.0));
            // The level of the tank above then moves in one direction.
            if is_steady && net_at_start >= 0.0 && net(*step, ends) >= 0.0 {
                return None;
            }
            return first_below_zero(|at| net(at, &root_levels(at)), *step);
        }
        let brim = self.root_height[i] * (1.0 + ROUNDING);
        if ends[i] <= brim && !self.rises_to_wall(i, *step, &pumped(0.0)) {
            return None;
        }
        let is_at_wall = self.root_level[i] == self.root_height[i];
        if is_at_wall && net_at_start > ROUNDING * self.drain[i] * self.root_height[i] {
            return Some(0.0);
        }
        first_below_zero(|at| brim - root_levels(at)[i], *step)
    }
}

/// When a smooth function first falls below 0 within a step, be it that it only dips there.
fn first_below_zero(function: impl Fn(f64) -> f64, step: f64) -> Option<f64> {
    let [start, middle, end] = [0.0, 0.5, 1.0].map(|share| function(share * step));
    if start < 0.0 {
        return Some(0.0);
    }
    // The lowest point of the parabola through the three.
    let bend = start - 2.0 * middle + end;
    let lowest = if end < 0.0 {
        step
    } else if bend > 0.0 {
        step * ((3.0 * start - 4.0 * middle + end) / (4.0 * bend)).clamp(0.0, 1.0)
    } else {
        return None;
    };
    let at_lowest = function(lowest);
    if at_lowest >= 0.0 {
        None
    } else if start == 0.0 {
        Some(0.0)
    } else {
        Some(root(function, (0.0, start), (lowest, at_lowest)))
    }
}
