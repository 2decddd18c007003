//! Singular values by one-sided Jacobi rotations.
//!
//! They are accurate to rounding even where small beside the largest, which the SVD of nalgebra 0.35 is not: it loses up
//! to six digits of some well-conditioned 4 × 3 matrices.

use nalgebra::{ComplexField, DMatrix};

/// Sweeps over all pairs of columns; a 2 × 2 matrix takes two, ten are rare.
const SWEEPS: usize = 60;

/// Singular values of a real or complex matrix, largest first; `None` when an entry or a value is not finite.
pub fn singular_values<T>(matrix: &DMatrix<T>) -> Option<Vec<f64>>
where
    T: ComplexField<RealField = f64>,
{
    let size = matrix.nrows().min(matrix.ncols());
    if !matrix.iter().all(ComplexField::is_finite) {
        return None;
    }
    let largest = matrix.iter().fold(0.0, |max: f64, x| max.max(x.clone().abs()));
    if size == 0 || largest == 0.0 {
        return Some(vec![0.0; size]);
    }
    let tall = if matrix.nrows() < matrix.ncols() { matrix.transpose() } else { matrix.clone() };
    let mut columns = tall.unscale(largest);
    for _ in 0..SWEEPS {
        if !rotate_all_pairs(&mut columns) {
            break;
        }
    }
    let mut values: Vec<f64> = columns.column_iter().map(|column| column.norm() * largest).collect();
    values.sort_by(f64::total_cmp);
    values.reverse();
    values.iter().all(ComplexField::is_finite).then_some(values)
}

/// Turns each pair of columns within its plane until they are orthogonal; says whether any was not.
fn rotate_all_pairs<T>(columns: &mut DMatrix<T>) -> bool
where
    T: ComplexField<RealField = f64>,
{
    let mut turned = false;
    for j in 1..columns.ncols() {
        for i in 0..j {
            let (first, second) = (columns.column(i), columns.column(j));
            let product = first.dotc(&second);
            let (alpha, beta, size) = (first.norm_squared(), second.norm_squared(), product.clone().abs());
            if size <= f64::EPSILON * (alpha * beta).sqrt() {
                continue;
            }
            turned = true;
            let zeta = (beta - alpha) / (2.0 * size);
            let tangent = 1.0_f64.copysign(zeta) / (zeta.abs() + zeta.hypot(1.0));
            let cosine = tangent.hypot(1.0).recip();
            let sine = cosine * tangent;
            let phase = product.unscale(size).conjugate();
            for row in 0..columns.nrows() {
                let x = columns[(row, i)].clone();
                let y = columns[(row, j)].clone() * phase.clone();
                columns[(row, i)] = x.clone().scale(cosine) - y.clone().scale(sine);
                columns[(row, j)] = x.scale(sine) + y.scale(cosine);
            }
        }
    }
    turned
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use nalgebra::{Complex, dmatrix};

    use super::*;

    #[test]
    fn known_matrices() {
        let values = singular_values(&dmatrix![3.0, 0.0; 4.0, 5.0]).unwrap();
        assert_relative_eq!(values[0], 45.0_f64.sqrt(), max_relative = 1e-15);
        assert_relative_eq!(values[1], 5.0_f64.sqrt(), max_relative = 1e-15);
        let j = Complex::new(0.0, 1.0);
        let unitary = dmatrix![j, j * -1.0; j * j, j * j].unscale(2.0_f64.sqrt());
        for value in singular_values(&unitary).unwrap() {
            assert_relative_eq!(value, 1.0, max_relative = 1e-15);
        }
        assert_eq!(singular_values(&dmatrix![3.0, 4.0]), Some(vec![5.0]));
        assert_eq!(singular_values(&DMatrix::<f64>::zeros(2, 3)), Some(vec![0.0, 0.0]));
        assert_eq!(singular_values(&DMatrix::<f64>::zeros(0, 3)), Some(vec![]));
    }

    #[test]
    fn a_small_value_beside_a_large_one_keeps_its_digits() {
        // det = 1e-13 exactly, largest value √(2 + 2e10) to 1e-10.
        let values = singular_values(&dmatrix![1.0, 1e5; 0.0, 1e-13]).unwrap();
        assert_relative_eq!(values[0] * values[1], 1e-13, max_relative = 1e-15);
    }

    #[test]
    fn numbers_that_are_none() {
        assert_eq!(singular_values(&dmatrix![1.0, f64::NAN]), None);
        let overflow = dmatrix![f64::MAX, f64::MAX; f64::MAX, f64::MAX];
        assert_eq!(singular_values(&overflow), None);
    }
}
