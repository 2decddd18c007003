//! The relative gain array.

use nalgebra::{ComplexField, DMatrix};

use crate::linear::{Complex, LinearError, StateSpace, singular_values};

/// Reciprocal condition below which a gain counts as singular. Rounding in an operating point and its linear model
/// leaves about 1e-15 where theory has 0; a relative gain is then good to three digits at the limit.
const SINGULAR: f64 = 1e-12;

/// Relative gain array `Λ = G ∘ (G⁻¹)ᵀ` of a square gain (Bristol 1966; Cocota 2009, eq. 4.6).
///
/// λij compares the gain from input j to output i with all other loops open to the same gain with them closed and
/// perfect: near 1 the loop hardly notices the others, large it is hard to control, negative it changes sign when they
/// close. Rows and columns sum to 1, and scaling an input or an output changes nothing. For the quadruple tank
/// λ11 = γ1γ2/(γ1+γ2−1) (eq. 4.10).
///
/// # Errors
/// [`LinearError::NotSquare`]; [`LinearError::SingularGain`] when G, with rows and columns scaled to size 1, has a
/// reciprocal condition below 1e-12; [`LinearError::NoConvergence`] when an entry is not finite.
///
/// # Examples
/// The distillation column of Wood and Berry: λ11 = 2.01, so each loop is paired with the product that it steers most.
/// ```
/// use nalgebra::dmatrix;
/// use quadtank::interaction::relative_gain_array;
///
/// let lambda = relative_gain_array(&dmatrix![12.8, -18.9; 6.6, -19.4])?;
/// assert!((lambda[(0, 0)] - 2.01).abs() < 5e-3);
/// # Ok::<(), quadtank::linear::LinearError>(())
/// ```
pub fn relative_gain_array(gain: &DMatrix<f64>) -> Result<DMatrix<f64>, LinearError> {
    relative_gains(gain.clone())
}

/// Relative gain array of G(jω), complex; `w` is ω (rad/s). Its modulus near the bandwidth decides how much loops that
/// fast interact.
///
/// # Errors
/// As [`relative_gain_array`] and [`StateSpace::frequency_response`].
pub fn relative_gain_array_at(model: &StateSpace, w: f64) -> Result<DMatrix<Complex>, LinearError> {
    relative_gains(model.frequency_response(w)?)
}

fn relative_gains<T>(mut gain: DMatrix<T>) -> Result<DMatrix<T>, LinearError>
where
    T: ComplexField<RealField = f64>,
{
    let (outputs, inputs) = gain.shape();
    if inputs != outputs {
        return Err(LinearError::NotSquare { inputs, outputs });
    }
    equilibrate(&mut gain);
    let values = singular_values(&gain)?;
    let reciprocal_condition = match (values.first(), values.last()) {
        (Some(largest), Some(smallest)) if *largest > 0.0 => smallest / largest,
        (None, None) => return Ok(gain),
        _ => 0.0,
    };
    let singular = LinearError::SingularGain { reciprocal_condition };
    if reciprocal_condition < SINGULAR {
        return Err(singular);
    }
    // The LU solve is as accurate as `try_inverse`, whose closed formulas for each small size add 3 KB to the
    // WebAssembly module.
    let inverse = gain.clone().full_piv_lu().solve(&DMatrix::identity(inputs, inputs)).ok_or(singular)?;
    Ok(gain.component_mul(&inverse.transpose()))
}

/// Scales rows, then columns, then rows again to a largest entry of 1: the relative gain array does not see units, and
/// its condition should not either.
fn equilibrate<T>(gain: &mut DMatrix<T>)
where
    T: ComplexField<RealField = f64>,
{
    let size = |entries: &mut dyn Iterator<Item = &T>| {
        let largest = entries.fold(0.0, |max: f64, g| max.max(g.clone().abs()));
        if largest > 0.0 { largest } else { 1.0 }
    };
    let scale_rows = |gain: &mut DMatrix<T>| {
        for mut row in gain.row_iter_mut() {
            let size = size(&mut row.iter());
            row.iter_mut().for_each(|g| *g = g.clone().unscale(size));
        }
    };
    scale_rows(gain);
    for mut column in gain.column_iter_mut() {
        let size = size(&mut column.iter());
        column.iter_mut().for_each(|g| *g = g.clone().unscale(size));
    }
    scale_rows(gain);
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use nalgebra::dmatrix;

    use super::*;

    #[test]
    fn two_by_two_by_hand() {
        // λ11 = g11 g22 / det = 2·3 / (6 − 2)
        let array = relative_gain_array(&dmatrix![2.0, 1.0; 2.0, 3.0]).unwrap();
        assert_relative_eq!(array, dmatrix![1.5, -0.5; -0.5, 1.5], max_relative = 1e-15);
    }

    #[test]
    fn three_by_three_of_the_literature() {
        // A permuted diagonal matrix pairs along its entries, whatever their units.
        let array = relative_gain_array(&dmatrix![0.0, 1e9, 0.0; 1e-9, 0.0, 0.0; 0.0, 0.0, -7.0]).unwrap();
        assert_relative_eq!(array, dmatrix![0.0, 1.0, 0.0; 1.0, 0.0, 0.0; 0.0, 0.0, 1.0], epsilon = 1e-15);
    }

    #[test]
    fn singular_gains_are_found_in_any_units() {
        for gain in [
            dmatrix![1.0, 2.0; 2.0, 4.0],
            dmatrix![0.0, 0.0; 2.0, 4.0],
            dmatrix![1e-9, 2e3; 3e-9, 6e3 * (1.0 + 1e-15)],
            DMatrix::zeros(2, 2),
        ] {
            let result = relative_gain_array(&gain);
            assert!(
                matches!(result, Err(LinearError::SingularGain { reciprocal_condition }) if reciprocal_condition < 1e-12)
            );
        }
        assert!(relative_gain_array(&dmatrix![1e-9, 0.0; 0.0, 1e9]).is_ok());
        // Singular values 2 and δ/2 of a matrix of ones but for one δ.
        let Err(LinearError::SingularGain { reciprocal_condition }) =
            relative_gain_array(&dmatrix![1.0, 1.0; 1.0, 1.0 - 2.0_f64.powi(-42)])
        else {
            panic!("a singular gain expected")
        };
        assert_relative_eq!(reciprocal_condition, 2.0_f64.powi(-44), max_relative = 1e-3);
    }

    #[test]
    fn no_loops_have_no_relative_gains() {
        assert_eq!(relative_gain_array(&DMatrix::zeros(0, 0)), Ok(DMatrix::zeros(0, 0)));
    }

    #[test]
    fn gains_that_are_not_square_or_not_finite() {
        let error = LinearError::NotSquare { inputs: 2, outputs: 1 };
        assert_eq!(relative_gain_array(&dmatrix![1.0, 2.0]), Err(error));
        for bad in [f64::NAN, f64::INFINITY] {
            assert_eq!(relative_gain_array(&dmatrix![bad, 1.0; 1.0, 2.0]), Err(LinearError::NoConvergence { size: 2 }));
        }
    }

    #[test]
    fn over_frequency_it_starts_at_the_static_array() {
        let model = StateSpace::strictly_proper(
            dmatrix![-1.0, 0.0, 0.0; 0.0, -2.0, 0.0; 1.0, 0.0, -3.0],
            dmatrix![1.0, 0.5; 0.2, 1.0; 0.0, 1.0],
            dmatrix![1.0, 0.0, 1.0; 0.0, 1.0, 0.5],
        )
        .unwrap();
        let at_rest = relative_gain_array(&model.dc_gain().unwrap()).unwrap();
        let slow = relative_gain_array_at(&model, 1e-9).unwrap();
        assert!((slow - at_rest.map(Complex::from)).norm() < 1e-8);
    }
}
