use nalgebra::{ComplexField, DMatrix};

use super::{Complex, LinearError, error::expect_shape};
use crate::numeric;

/// Eigenvalues of a square matrix, by rising real part, then rising imaginary part. A conjugate pair is exactly conjugate.
///
/// # Errors
/// [`LinearError::Dimension`] when the matrix is not square; [`LinearError::NoConvergence`] when an entry is not finite
/// or the QR iteration does not end.
pub fn eigenvalues(matrix: &DMatrix<f64>) -> Result<Vec<Complex>, LinearError> {
    let size = matrix.nrows();
    expect_shape("A", matrix, size, size)?;
    numeric::eigenvalues(matrix).ok_or(LinearError::NoConvergence { size })
}

/// Singular values of a real or complex matrix, largest first.
///
/// # Errors
/// [`LinearError::NoConvergence`] when an entry or a value is not finite.
pub fn singular_values<T>(matrix: &DMatrix<T>) -> Result<Vec<f64>, LinearError>
where
    T: ComplexField<RealField = f64>,
{
    let size = matrix.nrows().min(matrix.ncols());
    numeric::singular_values(matrix).ok_or(LinearError::NoConvergence { size })
}
