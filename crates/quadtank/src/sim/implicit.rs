//! One step of the implicit method for one tank.

use std::array::from_fn;

use crate::numeric::larger;
use crate::plant::CrossSection;

use super::hydraulics::{Hydraulics, emptying_volume};

/// Stages of the method.
pub(super) const STAGES: usize = 5;

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

/// Weights of the embedded method of order 3 in the same table less those of the result.
const EMBEDDED_DIFFERENCE: [f64; STAGES] = [3.0 / 16.0, 27.0 / 32.0, -25.0 / 32.0, 0.0, -1.0 / 4.0];

/// Where in the step each stage is: the sums of the rows of the tableau.
pub(super) const NODES: [f64; STAGES] = [1.0 / 4.0, 3.0 / 4.0, 11.0 / 20.0, 1.0 / 2.0, 1.0];

/// A tank nearly empties in a step that leaves less than this share of its level.
const NEARLY_EMPTY: f64 = 1.0 / 16.0;
/// Error of the level after such a step, as a share of it. Measured: 0.24, for a step of 8.03 s from 2.3 mm to 10 µm (see the tests of
/// `integrate.rs`).
const NEARLY_EMPTY_ERROR: f64 = 0.25;

/// A correction of √h this small, as a fraction, leaves an error below rounding.
const NEWTON_TOLERANCE: f64 = 1e-8;

/// Newton's iteration needs three or four; this only bounds it when numbers are not sane.
const MAX_ITERATIONS: u32 = 30;

/// The result of a step for one tank.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stages {
    /// √h at the stages, the last of which is the end of the step.
    pub(super) root_level: [f64; STAGES],
    /// Distance of the level at the end of the step from that of the embedded method of order 3 (m).
    pub(super) error: f64,
}

impl Stages {
    /// A level that does not move.
    pub(super) fn standing(root_level: f64) -> Self {
        Self { root_level: [root_level; STAGES], error: 0.0 }
    }

    /// A tank that receives nothing, exactly, by Torricelli's law.
    pub(super) fn emptying(section: CrossSection, root_level: f64, drain: f64, step: f64) -> Self {
        let there = emptying_volume(section, root_level);
        Self { root_level: NODES.map(|node| root_of_emptying(section, there - node * step * drain)), error: 0.0 }
    }
}

/// The √h at which [`emptying_volume`] has a given value; 0 where that is not positive.
fn root_of_emptying(section: CrossSection, volume: f64) -> f64 {
    if volume <= 0.0 {
        return 0.0;
    }
    // Newton's iteration is monotone from here: beyond the solution of a convex function where the tank widens upwards,
    // short of that of a concave one where it narrows.
    let mut root = volume / (2.0 * section.area_at_empty);
    for _ in 0..MAX_ITERATIONS {
        let correction = (emptying_volume(section, root) - volume) / (2.0 * section.area(root * root));
        root -= correction;
        if correction.abs() <= NEWTON_TOLERANCE * root {
            break;
        }
    }
    root
}

/// A tank during a step of the integration.
///
/// Stage i asks for the √h that solves `V(h) + passed √h = available`. With V replaced by its tangent of slope A that
/// is a quadratic equation, `(2 A √h + passed)² = passed² + 4 A available`: a prismatic tank is solved at once.
#[derive(Clone, Copy, Debug)]
pub(super) struct ImplicitStep {
    section: CrossSection,
    /// Level at the start of the step (m).
    level: f64,
    /// Diagonal × step × drain (m^2.5).
    passed: f64,
    passed_squared: f64,
    /// 4 A with the area of the surface at the start of the step (m²).
    four_areas: f64,
    /// What the tangent of V lacks at level 0 (m³).
    offset: f64,
    /// `passed² + 4 A available` of the water that is there at the start (m^5).
    start: f64,
    /// 4 A × step: makes of a flow its share of `passed² + 4 A available`.
    scale: f64,
    /// Scaled flow per √level that leaves the tank.
    drain: f64,
}

impl ImplicitStep {
    /// A tank with its √h and its drain (flow per √level, m^2.5/s) at the start of a step (s).
    pub(super) fn new(section: CrossSection, root_level: f64, drain: f64, step: f64) -> Self {
        let level = root_level * root_level;
        let passed = DIAGONAL * step * drain;
        let passed_squared = passed * passed;
        let four_areas = 4.0 * larger(section.area(level), f64::MIN_POSITIVE);
        let offset = section.area_slope / 2.0 * level * level;
        let start = passed_squared + four_areas * (section.volume(level) + offset);
        let scale = four_areas * step;
        Self { section, level, passed, passed_squared, four_areas, offset, start, scale, drain: scale * drain }
    }

    /// The step with the flow into the tank at the stages (m³/s). A result beyond the wall is that of a tank without.
    pub(super) fn stages(&self, inflow: &[f64; STAGES]) -> Stages {
        let half_over_area = 2.0 / self.four_areas;
        let mut root_level = [0.0; STAGES];
        let mut net = [0.0; STAGES];
        let mut slope = 0.0;
        for stage in 0..STAGES {
            let inflow = self.scale * inflow[stage];
            let mut square = self.start + DIAGONAL * inflow;
            for past in 0..stage {
                square += BELOW_DIAGONAL[stage][past] * net[past];
            }
            slope = larger(square, self.passed_squared).sqrt();
            root_level[stage] = self.leave_tangent((slope - self.passed) * half_over_area, slope);
            net[stage] = inflow - self.drain * root_level[stage];
        }
        let difference: f64 = (0..STAGES).map(|stage| EMBEDDED_DIFFERENCE[stage] * net[stage]).sum();
        // As an implicit stage would damp it, which a stiff tank needs (Hairer and Wanner 1996, section IV.8); from `4 A × volume` to
        // a level.
        let damping = 1.0 - self.passed / slope;
        let estimate = 4.0 * (damping * difference / (self.four_areas * self.four_areas)).abs();
        Stages { root_level, error: larger(estimate, self.nearly_empty_error(root_level[STAGES - 1])) }
    }

    /// Least error (m) to assume of a step in which the tank nearly empties, 0 of any other step. The estimate by the embedded method is a
    /// difference that passes through 0 at some lengths of step, where it says nothing of the error.
    fn nearly_empty_error(&self, root_at_end: f64) -> f64 {
        let left = root_at_end * root_at_end;
        if left < NEARLY_EMPTY * self.level { NEARLY_EMPTY_ERROR * left } else { 0.0 }
    }

    /// From the solution on the tangent, where the left-hand side rises by `slope` per √h, to that on V, which is
    /// `A′/2` times the squared distance from the start of the step above its tangent: by one step of Newton, or more
    /// when the level moves far.
    fn leave_tangent(&self, on_tangent: f64, slope: f64) -> f64 {
        let half_slope = self.section.area_slope / 2.0;
        if half_slope == 0.0 {
            return on_tangent;
        }
        let moved = on_tangent * on_tangent - self.level;
        let correction = half_slope * moved * moved / (slope + 4.0 * half_slope * moved * on_tangent);
        let root = on_tangent - correction;
        if correction.abs() <= NEWTON_TOLERANCE * root {
            return root;
        }
        self.solve(larger(root, 0.0), slope * slope)
    }

    /// Newton's iteration on V itself; it falls monotonically when the start is to the right of the solution.
    fn solve(&self, start: f64, square: f64) -> f64 {
        let available = (square - self.passed_squared) / self.four_areas - self.offset;
        let mut root = start;
        for _ in 0..MAX_ITERATIONS {
            let level = root * root;
            let excess = self.section.volume(level) + self.passed * root - available;
            let correction = excess / (2.0 * self.section.area(level) * root + self.passed);
            root = larger(root - correction, 0.0);
            if correction.abs() <= NEWTON_TOLERANCE * root {
                break;
            }
        }
        root
    }
}

impl Hydraulics {
    /// √h after a step (s), with the flows from the pumps (m³/s) at its [`NODES`], and the largest
    /// [`error`](Stages::error) (m). A tank that meets its wall goes on as if it were higher.
    pub(super) fn implicit_step(&self, step: f64, pumped: &[[f64; 4]; STAGES]) -> ([f64; 4], f64) {
        let stages = |i: usize, inflow: [f64; STAGES]| {
            let (section, root, drain) = (self.sections[i], self.root_level[i], self.drain[i]);
            if self.is_full[i] {
                Stages::standing(root)
            } else if inflow == [0.0; STAGES] {
                Stages::emptying(section, root, drain, step)
            } else {
                ImplicitStep::new(section, root, drain, step).stages(&inflow)
            }
        };
        let upper = |i: usize| stages(i, from_fn(|stage| pumped[stage][i]));
        let lower = |i: usize, above: &Stages| {
            stages(i, from_fn(|stage| pumped[stage][i] + self.outlet[i + 2] * above.root_level[stage]))
        };
        let (third, fourth) = (upper(2), upper(3));
        let tanks = [lower(0, &third), lower(1, &fourth), third, fourth];
        let error = tanks.iter().fold(0.0, |largest, tank| larger(tank.error, largest));
        (tanks.map(|tank| tank.root_level[STAGES - 1]), error)
    }
}
