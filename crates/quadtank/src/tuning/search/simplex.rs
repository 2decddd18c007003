use super::{Axis, AxisError, Evaluated, Record, Search};

/// The simplex of Nelder and Mead (1965) in a box, with the coefficients 1, 2, ½, ½ of `fminsearch`; points outside are moved to the
/// border.
#[derive(Clone, Debug)]
pub struct NelderMead<const N: usize> {
    record: Record<N>,
    /// Vertices in shares of the axes with their costs, best first once it is full.
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

/// Edge of the first simplex as a share of the axes.
const EDGE: f64 = 0.1;
/// Size of a simplex that is a point, in shares of the axes.
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
        let first = record.shares(&start);
        Ok(Self { record, simplex: Vec::with_capacity(N + 1), stage: Stage::Fill(first) })
    }

    /// The vertex that follows `count` others: the first with one coordinate moved, inwards where it is near the border.
    fn vertex(&self, count: usize) -> [f64; N] {
        let mut point = self.simplex[0].0;
        let axis = count - 1;
        point[axis] += if point[axis] + EDGE <= 1.0 { EDGE } else { -EDGE };
        point
    }

    /// `centroid + by (centroid − worst)` within the box.
    fn along(&self, by: f64) -> [f64; N] {
        let worst = self.simplex[N].0;
        std::array::from_fn(|i| {
            let centroid = self.simplex[..N].iter().map(|vertex| vertex.0[i]).sum::<f64>() / N as f64;
            (centroid + by * (centroid - worst[i])).clamp(0.0, 1.0)
        })
    }

    fn is_done(&self) -> bool {
        let (best, worst) = (self.simplex[0], self.simplex[N]);
        let size = self.simplex[1..].iter().map(|vertex| distance(&vertex.0, &best.0)).fold(0.0, f64::max);
        let flat = (worst.1 - best.1).abs() <= FLAT * best.1.abs();
        size < SMALL || (flat && size < 1e-3) || self.record.evaluations >= MOST
    }

    /// Sorts the vertices and begins the next step.
    fn next_step(&mut self) {
        self.simplex.sort_by(|a, b| a.1.total_cmp(&b.1));
        let (best, cost) = self.simplex[0];
        self.record.pass(&best, cost);
        self.stage = if self.is_done() { Stage::Done } else { Stage::Reflect(self.along(1.0)) };
    }

    fn replace_worst(&mut self, vertex: ([f64; N], f64)) {
        self.simplex[N] = vertex;
        self.next_step();
    }

    fn shrunk(&self, index: usize) -> [f64; N] {
        std::array::from_fn(|i| f64::midpoint(self.simplex[0].0[i], self.simplex[index].0[i]))
    }
}

fn distance<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    (0..N).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max)
}

impl<const N: usize> Search<N> for NelderMead<N> {
    fn ask(&mut self) -> Option<[f64; N]> {
        let shares = match self.stage {
            Stage::Fill(point)
            | Stage::Reflect(point)
            | Stage::Expand { point, .. }
            | Stage::Contract { point, .. } => point,
            Stage::Shrink(index) => self.shrunk(index),
            Stage::Done => return None,
        };
        Some(self.record.point(&shares))
    }

    fn tell(&mut self, cost: f64) {
        match self.stage {
            Stage::Fill(point) => {
                let cost = self.record.note(&point, cost);
                self.simplex.push((point, cost));
                if self.simplex.len() <= N {
                    self.stage = Stage::Fill(self.vertex(self.simplex.len()));
                } else {
                    self.next_step();
                }
            }
            Stage::Reflect(point) => {
                let cost = self.record.note(&point, cost);
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
                let cost = self.record.note(&point, cost);
                self.replace_worst(if cost < reflected.1 { (point, cost) } else { reflected });
            }
            Stage::Contract { point, limit } => {
                let cost = self.record.note(&point, cost);
                if cost < limit {
                    self.replace_worst((point, cost));
                } else {
                    self.stage = Stage::Shrink(1);
                }
            }
            Stage::Shrink(index) => {
                let point = self.shrunk(index);
                let cost = self.record.note(&point, cost);
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
