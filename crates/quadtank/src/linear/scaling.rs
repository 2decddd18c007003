//! Units out of the way: a model scaled so that its entries can be compared with each other.

use nalgebra::linalg::balancing::balance_parlett_reinsch;

use super::{LinearError, StateSpace};
use crate::numeric::nearest_power_of_two;

/// Sweeps over all rows and columns; two or three settle an ordinary model.
const SWEEPS: usize = 8;

/// A model in scaled states, inputs, outputs and time, `Ĝ(s/rate) = L G(s) R` with diagonal L and R.
///
/// All factors are powers of two, so that scaling itself rounds nothing and an exact zero stays one.
pub(super) struct Scaled {
    /// The scaled model.
    pub model: StateSpace,
    /// Unit of s (1/s).
    pub rate: f64,
    /// Diagonal of R: `u = R û`.
    pub inputs: Vec<f64>,
    /// Diagonal of L: `ŷ = L y`.
    pub outputs: Vec<f64>,
}

impl Scaled {
    /// Scales time by the largest rate in A, each input and output by its largest coefficient, and each state so that
    /// what drives it is as large as what it drives.
    ///
    /// # Errors
    /// [`LinearError::NoConvergence`] when the entries are too far apart for f64.
    pub fn new(model: &StateSpace) -> Result<Self, LinearError> {
        let mut scaled = Self {
            model: model.clone(),
            rate: 1.0,
            inputs: vec![1.0; model.inputs()],
            outputs: vec![1.0; model.outputs()],
        };
        scaled.scale_time();
        for _ in 0..SWEEPS {
            let mut settled = scaled.scale_inputs();
            settled &= scaled.scale_outputs();
            settled &= scaled.balance_states();
            if settled {
                break;
            }
        }
        let factors = scaled.inputs.iter().chain(&scaled.outputs).chain(std::iter::once(&scaled.rate));
        let usable = factors.clone().all(|factor| factor.is_normal()) && scaled.model.check().is_ok();
        if usable { Ok(scaled) } else { Err(LinearError::NoConvergence { size: model.order() }) }
    }

    fn scale_time(&mut self) {
        let mut balanced = self.model.a.clone();
        let size = largest(balanced.iter());
        if size > 0.0 {
            balanced.unscale_mut(size);
            balance_parlett_reinsch(&mut balanced);
            self.rate = power_of_two(size) * power_of_two(largest(balanced.iter()));
            self.model.a.unscale_mut(self.rate);
            self.model.b.unscale_mut(self.rate);
        }
    }

    fn scale_inputs(&mut self) -> bool {
        let mut settled = true;
        for (j, scale) in self.inputs.iter_mut().enumerate() {
            let (mut b, mut d) = (self.model.b.column_mut(j), self.model.d.column_mut(j));
            let factor = power_of_two(largest(b.iter().chain(d.iter())));
            b.unscale_mut(factor);
            d.unscale_mut(factor);
            *scale /= factor;
            settled &= factor == 1.0;
        }
        settled
    }

    fn scale_outputs(&mut self) -> bool {
        let mut settled = true;
        for (i, scale) in self.outputs.iter_mut().enumerate() {
            let (mut c, mut d) = (self.model.c.row_mut(i), self.model.d.row_mut(i));
            let factor = power_of_two(largest(c.iter().chain(d.iter())));
            c.unscale_mut(factor);
            d.unscale_mut(factor);
            *scale /= factor;
            settled &= factor == 1.0;
        }
        settled
    }

    fn balance_states(&mut self) -> bool {
        let StateSpace { a, b, c, .. } = &mut self.model;
        let mut settled = true;
        for i in 0..a.nrows() {
            let off_diagonal = |j: &usize| *j != i;
            let drives = (0..a.nrows()).filter(off_diagonal).map(|j| a[(j, i)].abs()).sum::<f64>()
                + c.column(i).iter().map(|c| c.abs()).sum::<f64>();
            let driven = (0..a.nrows()).filter(off_diagonal).map(|j| a[(i, j)].abs()).sum::<f64>()
                + b.row(i).iter().map(|b| b.abs()).sum::<f64>();
            if drives == 0.0 || driven == 0.0 {
                continue;
            }
            let factor = power_of_two((drives / driven).sqrt());
            a.row_mut(i).scale_mut(factor);
            b.row_mut(i).scale_mut(factor);
            a.column_mut(i).unscale_mut(factor);
            c.column_mut(i).unscale_mut(factor);
            settled &= factor == 1.0;
        }
        settled
    }
}

fn largest<'a>(entries: impl Iterator<Item = &'a f64>) -> f64 {
    entries.fold(0.0, |max, x| max.max(x.abs()))
}

/// The power of two nearest to `size`; 1 for zero, so that an empty row is left alone.
fn power_of_two(size: f64) -> f64 {
    if size == 0.0 { 1.0 } else { nearest_power_of_two(size) }
}

#[cfg(test)]
mod tests {
    use nalgebra::dmatrix;

    use super::super::Complex;
    use super::*;

    #[test]
    fn the_scaled_model_is_the_same_model() {
        let model = StateSpace::new(
            dmatrix![-3e5, 2e-4, 0.0; 1e7, -5e2, 3.0; 0.0, 1e-9, -2.0],
            dmatrix![1e-6, 0.0; 0.0, 2e-8; 1e3, 1.0],
            dmatrix![1e4, 0.0, 1e-3; 0.0, 7e5, 0.0],
            dmatrix![0.0, 1e-5; 0.0, 0.0],
        )
        .unwrap();
        let scaled = Scaled::new(&model).unwrap();
        let s = Complex::new(3.0, 17.0);
        let gain = model.gain_at(s).unwrap();
        let scaled_gain = scaled.model.gain_at(s / scaled.rate).unwrap();
        for (i, output) in scaled.outputs.iter().enumerate() {
            for (j, input) in scaled.inputs.iter().enumerate() {
                let expected = gain[(i, j)] * *output * *input;
                assert!((scaled_gain[(i, j)] - expected).norm() <= 1e-12 * expected.norm());
            }
        }
        for matrix in [&scaled.model.a, &scaled.model.b, &scaled.model.c, &scaled.model.d] {
            assert!(matrix.amax() <= 4.0, "{matrix}");
        }
    }

    #[test]
    fn entries_too_far_apart_are_an_error() {
        let model = StateSpace::strictly_proper(dmatrix![-1e-300], dmatrix![1e300], dmatrix![1e300]).unwrap();
        assert_eq!(Scaled::new(&model).err(), Some(LinearError::NoConvergence { size: 1 }));
    }
}
