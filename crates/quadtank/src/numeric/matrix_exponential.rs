//! The matrix exponential.

use nalgebra::DMatrix;

/// Coefficients of the Padé approximant of order 13 (Higham 2005, table 2.1 and algorithm 2.3).
const PADE: [f64; 14] = [
    64_764_752_532_480_000.0,
    32_382_376_266_240_000.0,
    7_771_770_303_897_600.0,
    1_187_353_796_428_800.0,
    129_060_195_264_000.0,
    10_559_470_521_600.0,
    670_442_572_800.0,
    33_522_128_640.0,
    1_323_241_920.0,
    40_840_800.0,
    960_960.0,
    16_380.0,
    182.0,
    1.0,
];

/// 1-norm up to which the approximant is exact to rounding (θ13 of Higham 2005, table 2.3).
const PADE_REACH: f64 = 5.371_920_351_148_152;

/// `e^M` by scaling and squaring; `None` when M or the result is not finite.
///
/// The exponential of nalgebra panics on overflow, hence this one.
pub fn matrix_exponential(matrix: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let size = matrix.nrows();
    let norm = matrix.column_iter().map(|column| column.lp_norm(1)).fold(0.0, f64::max);
    if !norm.is_finite() || !matrix.iter().all(|x| x.is_finite()) {
        return None;
    }
    let mut halvings = 0_u32;
    let mut scale = 1.0;
    while norm * scale > PADE_REACH {
        halvings += 1;
        scale *= 0.5;
    }
    let m = matrix * scale;
    let identity = DMatrix::identity(size, size);
    let m2 = &m * &m;
    let m4 = &m2 * &m2;
    let m6 = &m4 * &m2;
    let [b0, b1, b2, b3, b4, b5, b6, b7, b8, b9, b10, b11, b12, b13] = PADE;
    let odd = &m6 * (&m6 * b13 + &m4 * b11 + &m2 * b9) + &m6 * b7 + &m4 * b5 + &m2 * b3 + &identity * b1;
    let odd = &m * odd;
    let even = &m6 * (&m6 * b12 + &m4 * b10 + &m2 * b8) + &m6 * b6 + &m4 * b4 + &m2 * b2 + &identity * b0;
    let mut result = (&even - &odd).lu().solve(&(even + odd))?;
    for _ in 0..halvings {
        result = &result * &result;
    }
    result.iter().all(|x| x.is_finite()).then_some(result)
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use nalgebra::dmatrix;

    use super::*;

    #[test]
    fn rotations_shears_and_decays() {
        let turn = matrix_exponential(&dmatrix![0.0, -100.0; 100.0, 0.0]).unwrap();
        let (sine, cosine) = 100.0_f64.sin_cos();
        assert_relative_eq!(turn, dmatrix![cosine, -sine; sine, cosine], epsilon = 1e-13);
        let shear = matrix_exponential(&dmatrix![0.0, 7.0, 0.0; 0.0, 0.0, 3.0; 0.0, 0.0, 0.0]).unwrap();
        assert_relative_eq!(shear, dmatrix![1.0, 7.0, 10.5; 0.0, 1.0, 3.0; 0.0, 0.0, 1.0], epsilon = 1e-14);
        let decay = matrix_exponential(&dmatrix![-1e6]).unwrap();
        assert_eq!(decay, dmatrix![0.0]);
    }

    #[test]
    fn overflow_and_nan_are_none() {
        assert_eq!(matrix_exponential(&dmatrix![1e3, 0.0; 0.0, 0.0]), None);
        assert_eq!(matrix_exponential(&dmatrix![1e300, 1e300; 1e300, 1e300]), None);
        assert_eq!(matrix_exponential(&dmatrix![f64::NAN]), None);
        assert_eq!(matrix_exponential(&dmatrix![f64::INFINITY]), None);
    }
}
