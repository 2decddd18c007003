use std::f64::consts::FRAC_PI_4;

use super::{Axis, AxisError, Evaluated, Record, Search};

/// The simplex of Nelder and Mead (1965) in a box, with the coefficients 1, 2, ½, ½ of `fminsearch`; it moves in angles z with the
/// shares sin² z of the axes, so that it meets no border and loses no dimension there (D'Errico 2006).
#[derive(Clone, Debug)]
pub struct NelderMead<const N: usize> {
    record: Record<N>,
    /// Vertices in angles (rad) with their costs, best first once it is full.
    simplex: Vec<([f64; N], f64)>,
    stage: Stage<N>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Stage<const N: usize> {
    /// The vertices are being evaluated, this is the next.
    Fill([f64; N]),
    Reflect([f64; N]),
    Expand {
        point: [f64; N],
        reflected: ([f64; N], f64),
    },
    Contract {
        point: [f64; N],
        limit: f64,
    },
    /// All vertices but the best move towards it; this one is next.
    Shrink(usize),
    Done,
}

/// Edge of the first simplex (rad).
const EDGE: f64 = 0.15;
/// Size of a simplex that is a point (rad).
const SMALL: f64 = 1e-6;
/// Relative difference of costs that are equal.
const FLAT: f64 = 1e-10;
/// Most evaluations.
const MOST: usize = 2_000;

impl<const N: usize> NelderMead<N> {
    /// A search from a start.
    ///
    /// # Errors
    /// [`AxisError`] for a box that cannot be searched.
    pub fn new(axes: [Axis; N], start: [f64; N]) -> Result<Self, AxisError> {
        let record = Record::new(axes)?;
        let first = record.shares(&start).map(|share| share.sqrt().asin());
        Ok(Self { record, simplex: Vec::with_capacity(N + 1), stage: Stage::Fill(first) })
    }

    /// The vertex that follows `count` others: the first with one coordinate moved, towards the middle of the box.
    fn vertex(&self, count: usize) -> [f64; N] {
        let mut point = self.simplex[0].0;
        let axis = count - 1;
        point[axis] += if point[axis] < FRAC_PI_4 { EDGE } else { -EDGE };
        point
    }

    /// `centroid + by (centroid − worst)`.
    fn along(&self, by: f64) -> [f64; N] {
        let worst = self.simplex[N].0;
        std::array::from_fn(|i| {
            let centroid = self.simplex[..N].iter().map(|vertex| vertex.0[i]).sum::<f64>() / N as f64;
            centroid + by * (centroid - worst[i])
        })
    }

    /// Whether the simplex is a point, or flat.
    fn is_small(&self) -> bool {
        let (best, worst) = (self.simplex[0], self.simplex[N]);
        let size = self.simplex[1..].iter().map(|vertex| distance(&vertex.0, &best.0)).fold(0.0, f64::max);
        let flat = (worst.1 - best.1).abs() <= FLAT * best.1.abs();
        size < SMALL || (flat && size < 1e-3)
    }

    /// Sorts the vertices and begins the next step.
    fn next_step(&mut self) {
        self.simplex.sort_by(|a, b| a.1.total_cmp(&b.1));
        let (best, cost) = self.simplex[0];
        self.record.pass(&shares_at(&best), cost);
        let ends = self.is_small() || self.record.evaluations >= MOST;
        self.stage = if ends { Stage::Done } else { Stage::Reflect(self.along(1.0)) };
    }

    fn replace_worst(&mut self, vertex: ([f64; N], f64)) {
        self.simplex[N] = vertex;
        self.next_step();
    }

    fn shrunk(&self, index: usize) -> [f64; N] {
        std::array::from_fn(|i| f64::midpoint(self.simplex[0].0[i], self.simplex[index].0[i]))
    }
}

/// Shares of the axes at angles.
fn shares_at<const N: usize>(angles: &[f64; N]) -> [f64; N] {
    angles.map(|z| z.sin().powi(2))
}

fn distance<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    (0..N).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max)
}

impl<const N: usize> Search<N> for NelderMead<N> {
    fn ask(&mut self) -> Option<[f64; N]> {
        let angles = match self.stage {
            Stage::Fill(point)
            | Stage::Reflect(point)
            | Stage::Expand { point, .. }
            | Stage::Contract { point, .. } => point,
            Stage::Shrink(index) => self.shrunk(index),
            Stage::Done => return None,
        };
        Some(self.record.point(&shares_at(&angles)))
    }

    fn tell(&mut self, cost: f64) {
        match self.stage {
            Stage::Fill(point) => {
                let cost = self.record.note(&shares_at(&point), cost);
                self.simplex.push((point, cost));
                if self.simplex.len() <= N {
                    self.stage = Stage::Fill(self.vertex(self.simplex.len()));
                } else {
                    self.next_step();
                }
            }
            Stage::Reflect(point) => {
                let cost = self.record.note(&shares_at(&point), cost);
                if cost < self.simplex[0].1 {
                    self.stage = Stage::Expand { point: self.along(2.0), reflected: (point, cost) };
                } else if cost < self.simplex[N - 1].1 {
                    self.replace_worst((point, cost));
                } else if cost < self.simplex[N].1 {
                    self.stage = Stage::Contract { point: self.along(0.5), limit: cost };
                } else {
                    self.stage = Stage::Contract { point: self.along(-0.5), limit: self.simplex[N].1 };
                }
            }
            Stage::Expand { point, reflected } => {
                let cost = self.record.note(&shares_at(&point), cost);
                self.replace_worst(if cost < reflected.1 { (point, cost) } else { reflected });
            }
            Stage::Contract { point, limit } => {
                let cost = self.record.note(&shares_at(&point), cost);
                if cost < limit {
                    self.replace_worst((point, cost));
                } else {
                    self.stage = Stage::Shrink(1);
                }
            }
            Stage::Shrink(index) => {
                let point = self.shrunk(index);
                let cost = self.record.note(&shares_at(&point), cost);
                self.simplex[index] = (point, cost);
                if index < N {
                    self.stage = Stage::Shrink(index + 1);
                } else {
                    self.next_step();
                }
            }
            Stage::Done => {}
        }
    }

    fn best(&self) -> Option<Evaluated<N>> {
        self.record.best
    }

    fn path(&self) -> &[Evaluated<N>] {
        &self.record.path
    }
}
