use std::f64::consts::FRAC_PI_2;

use super::critical::{CriticalPoint, CriticalSearch, GainLimit};
use crate::linear::TransferMatrix;

/// Ratio of the frequencies of neighbours on the curve beyond which there is a corner between them.
const JUMP: f64 = 1.25;
/// Halvings of the angle that locate a corner, and most corners that are located.
const HALVINGS: u32 = 30;
const MAX_CORNERS: usize = 4;

/// Cells in which one direction is solved for at most.
const MAX_EFFORT: u32 = 30;

/// One direction of the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// Angle in the plane of the normalised gains k1 g11(0), k2 g22(0) (rad, 0 to π/2); its tangent is the importance r2.
    pub angle: f64,
    /// What bounds the gains there.
    pub limit: GainLimit,
}

/// Where both loci pass −1 at different frequencies: the curve has a corner, and the loop two frequencies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Importance r2 of loop 2.
    pub importance: f64,
    /// The two points, which have the same gains; the slower one first.
    pub points: [CriticalPoint; 2],
}

/// The boundary of the stable gains of two proportional loops (Campestrini 2006, §4.2).
#[derive(Clone, Debug, PartialEq)]
pub struct CriticalCurve {
    /// Directions from loop 1 alone to loop 2 alone.
    pub points: Vec<CurvePoint>,
    /// Corners, in the same order, up to four.
    pub corners: Vec<Corner>,
}

impl CriticalCurve {
    /// The curve in at least two directions, at equal angles in the plane of the normalised gains. The diagonal gains of the
    /// plant must not be zero.
    pub fn of(plant: &TransferMatrix, search: &CriticalSearch, directions: usize) -> Self {
        let gain = plant.rest_gain();
        let direction = |angle: f64| {
            let (sine, cosine) = angle.sin_cos();
            [cosine / gain[(0, 0)], sine / gain[(1, 1)]]
        };
        let last = directions.max(2) - 1;
        let points: Vec<CurvePoint> = (0..=last)
            .map(|k| {
                let angle = FRAC_PI_2 * k as f64 / last as f64;
                // Exactly one loop at the ends, whatever the cosine of π/2 is.
                let along = match k {
                    0 => [direction(0.0)[0], 0.0],
                    k if k == last => [0.0, direction(FRAC_PI_2)[1]],
                    _ => direction(angle),
                };
                CurvePoint { angle, limit: search.limit_within(along, MAX_EFFORT) }
            })
            .collect();
        let corners = points
            .windows(2)
            .filter_map(|pair| match (pair[0].limit, pair[1].limit) {
                (GainLimit::Oscillation(one), GainLimit::Oscillation(other)) if jumps(&one, &other) => {
                    corner(search, direction, [pair[0].angle, pair[1].angle], one)
                }
                _ => None,
            })
            .take(MAX_CORNERS)
            .collect();
        Self { points, corners }
    }
}

fn jumps(one: &CriticalPoint, other: &CriticalPoint) -> bool {
    let ratio = one.frequency / other.frequency;
    !(JUMP.recip()..=JUMP).contains(&ratio)
}

/// The corner between two angles, the first of which has the nearest point `first`.
fn corner(
    search: &CriticalSearch,
    direction: impl Fn(f64) -> [f64; 2],
    [mut low, mut high]: [f64; 2],
    mut first: CriticalPoint,
) -> Option<Corner> {
    let mut last = None;
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        let point = search.nearest_within(direction(middle), MAX_EFFORT)?;
        if jumps(&first, &point) {
            (high, last) = (middle, Some(point));
        } else {
            (low, first) = (middle, point);
        }
    }
    // A steep but smooth change of frequency ends in one point, not in two.
    let last = last.filter(|last| jumps(&first, last))?;
    let (sine, cosine) = low.sin_cos();
    let points = if first.frequency < last.frequency { [first, last] } else { [last, first] };
    Some(Corner { importance: sine / cosine, points })
}
