//! Eigenvalues of a real matrix, without ever hanging.

use nalgebra::linalg::{Schur, balancing::balance_parlett_reinsch};
use nalgebra::{DMatrix, DVector};

use super::Complex;

/// QR iterations allowed per row; two to four are usual.
const ITERATIONS_PER_ROW: usize = 60;

/// Eigenvalues of a square matrix, by rising real part, then rising imaginary part.
///
/// The matrix is balanced first. A conjugate pair is exactly conjugate.
///
/// `None` when an entry is not finite or the QR iteration does not end.
pub fn eigenvalues(matrix: &DMatrix<f64>) -> Option<Vec<Complex>> {
    let size = matrix.nrows();
    let largest = matrix.iter().fold(0.0_f64, |max, x| max.max(x.abs()));
    if !matrix.iter().all(|x| x.is_finite()) {
        return None;
    }
    if largest == 0.0 {
        return Some(vec![Complex::ZERO; size]);
    }
    let mut balanced = matrix / largest;
    balance_parlett_reinsch(&mut balanced);
    let quasi_triangular = schur_form(balanced)?;
    let mut values: Vec<Complex> = diagonal_blocks(&quasi_triangular).map(|value| value * largest).collect();
    if !values.iter().all(|value| value.is_finite()) {
        return None;
    }
    values.sort_by(|x, y| x.re.total_cmp(&y.re).then(x.im.total_cmp(&y.im)));
    Some(values)
}

/// The real Schur form. The double-shift QR iteration stalls on a few matrices (a cyclic permutation is one); seen
/// from a basis turned by a reflection, these too converge.
fn schur_form(matrix: DMatrix<f64>) -> Option<DMatrix<f64>> {
    let size = matrix.nrows();
    let limit = ITERATIONS_PER_ROW * size;
    let iterate = |m: DMatrix<f64>| Schur::try_new(m, f64::EPSILON, limit).map(|schur| schur.unpack().1);
    iterate(matrix.clone()).or_else(|| {
        let axis = DVector::from_fn(size, |i, _| 1.0 / (i as f64 + 1.5)).normalize();
        let reflection = DMatrix::identity(size, size) - &axis * axis.transpose() * 2.0;
        iterate(&reflection * matrix * &reflection)
    })
}

/// Eigenvalues of the 1 × 1 and 2 × 2 blocks on the diagonal of a quasi-triangular matrix.
fn diagonal_blocks(t: &DMatrix<f64>) -> impl Iterator<Item = Complex> {
    let size = t.nrows();
    let mut row = 0;
    std::iter::from_fn(move || {
        if row >= size {
            return None;
        }
        let block = if row + 1 < size && t[(row + 1, row)] != 0.0 {
            let (a, b, c, d) = (t[(row, row)], t[(row, row + 1)], t[(row + 1, row)], t[(row + 1, row + 1)]);
            row += 2;
            two_by_two(a, b, c, d).into_iter().take(2)
        } else {
            let value = Complex::from(t[(row, row)]);
            row += 1;
            [value, value].into_iter().take(1)
        };
        Some(block)
    })
    .flatten()
}

/// Eigenvalues of `[a b; c d]`, without cancellation in the smaller of two real ones.
fn two_by_two(a: f64, b: f64, c: f64, d: f64) -> [Complex; 2] {
    let half_difference = 0.5 * (a - d);
    let product = b * c;
    let discriminant = half_difference * half_difference + product;
    if discriminant < 0.0 {
        let centre = 0.5 * (a + d);
        let height = (-discriminant).sqrt();
        [Complex::new(centre, -height), Complex::new(centre, height)]
    } else {
        let offset = half_difference + discriminant.sqrt().copysign(half_difference);
        let other = if offset == 0.0 { 0.0 } else { product / offset };
        [Complex::from(d + offset), Complex::from(d - other)]
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::dmatrix;

    use super::*;

    #[test]
    fn a_cyclic_permutation_does_not_stall() {
        let values = eigenvalues(&dmatrix![0.0, 0.0, 1.0; 1.0, 0.0, 0.0; 0.0, 1.0, 0.0]).unwrap();
        let height = 0.75_f64.sqrt();
        let expected = [Complex::new(-0.5, -height), Complex::new(-0.5, height), Complex::from(1.0)];
        for (value, expected) in values.iter().zip(expected) {
            assert!((value - expected).norm() < 1e-14, "{values:?}");
        }
    }

    #[test]
    fn badly_scaled_matrices_keep_their_small_eigenvalues() {
        // det = 1e-3 − 1e-4 and trace = 1.001: the units of the two states differ by 1e9.
        let values = eigenvalues(&dmatrix![1.0, 1e5; 1e-9, 1e-3]).unwrap();
        let small = 9e-4 / values[1].re;
        approx::assert_relative_eq!(values[0].re, small, max_relative = 1e-12);
    }

    #[test]
    fn nilpotent_and_empty_matrices() {
        assert_eq!(eigenvalues(&DMatrix::zeros(0, 0)), Some(vec![]));
        assert_eq!(eigenvalues(&DMatrix::zeros(2, 2)), Some(vec![Complex::ZERO; 2]));
        let chain = dmatrix![0.0, 1.0, 0.0; 0.0, 0.0, 1.0; 0.0, 0.0, 0.0];
        assert_eq!(eigenvalues(&chain), Some(vec![Complex::ZERO; 3]));
    }

    #[test]
    fn entries_that_are_not_finite_are_refused() {
        for bad in [f64::NAN, f64::INFINITY] {
            assert_eq!(eigenvalues(&dmatrix![bad, 1.0; 1.0, 0.0]), None);
        }
    }
}
