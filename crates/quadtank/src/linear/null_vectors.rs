//! Null vectors of a matrix that is known to be singular, to rounding.

use nalgebra::{ComplexField, DMatrix, DVector};

/// A pivot this small beside the largest is a rounding error. Each further one is a further dimension of the null space.
const NULL_PIVOT: f64 = 1e-13;

/// A right and a left null vector, `M v = 0` and `wᵀ M = 0` (transposed, not conjugated), from an LU decomposition with
/// full pivoting.
///
/// The smallest pivot is taken as zero, whatever it is. Where the null space has more dimensions, `index` 0, 1, … gives
/// independent vectors of it; beyond its dimension the last one again.
pub(super) fn null_vectors<T>(matrix: DMatrix<T>, index: usize) -> Option<(DVector<T>, DVector<T>)>
where
    T: ComplexField<RealField = f64>,
{
    let size = matrix.nrows();
    let lu = matrix.full_piv_lu();
    let (upper, lower) = (lu.u(), lu.l());
    let largest = upper.get(0)?.clone().abs();
    let null_pivot = |i: &usize| upper[(*i, *i)].clone().abs() <= NULL_PIVOT * largest;
    let nullity = (0..size).rev().take_while(null_pivot).count().max(1);
    let rank = size - nullity;
    let chosen = size - 1 - index.min(nullity - 1);

    let mut right = DVector::zeros(size);
    if rank > 0 {
        let known = -upper.view((0, chosen), (rank, 1)).into_owned();
        let solved = upper.view((0, 0), (rank, rank)).solve_upper_triangular(&known)?;
        right.rows_mut(0, rank).copy_from(&solved);
    }
    right[chosen] = T::one();
    lu.q().inv_permute_rows(&mut right);

    let mut left = DVector::zeros(size);
    left[chosen] = T::one();
    let mut left = lower.tr_solve_lower_triangular(&left)?;
    lu.p().inv_permute_rows(&mut left);
    Some((right, left))
}

#[cfg(test)]
mod tests {
    use nalgebra::{Complex, dmatrix};

    use super::*;

    #[test]
    fn both_null_vectors_of_a_matrix_of_rank_two() {
        let m = dmatrix![1.0, 2.0, 3.0; 4.0, 5.0, 6.0; 7.0, 8.0, 9.0];
        let (right, left) = null_vectors(m.clone(), 0).unwrap();
        assert!((&m * &right).norm() < 1e-14 * right.norm());
        assert!((m.transpose() * &left).norm() < 1e-14 * left.norm());
    }

    #[test]
    fn left_vectors_are_transposed_not_conjugated() {
        let (one, j) = (Complex::new(1.0, 0.0), Complex::new(0.0, 1.0));
        let m = dmatrix![one, j; j, -one];
        let (right, left) = null_vectors(m.clone(), 0).unwrap();
        assert!((&m * &right).norm() < 1e-15);
        assert!((m.transpose() * &left).norm() < 1e-15);
    }

    #[test]
    fn a_plane_of_null_vectors_gives_independent_ones() {
        let m = dmatrix![1.0, 2.0, -1.0; 2.0, 4.0, -2.0; 3.0, 6.0, -3.0];
        let (first, second) = (null_vectors(m.clone(), 0).unwrap(), null_vectors(m.clone(), 1).unwrap());
        for (right, left) in [&first, &second] {
            assert!((&m * right).norm() < 1e-14 && (m.transpose() * left).norm() < 1e-14);
        }
        assert!(first.0.cross_norm(&second.0) > 0.5 && first.1.cross_norm(&second.1) > 0.5);
    }

    trait CrossNorm {
        fn cross_norm(&self, other: &Self) -> f64;
    }

    impl CrossNorm for DVector<f64> {
        /// Area of the parallelogram of two vectors, scaled to unit sides.
        fn cross_norm(&self, other: &Self) -> f64 {
            let cosine = self.normalize().dot(&other.normalize());
            (1.0 - cosine * cosine).max(0.0).sqrt()
        }
    }
}
