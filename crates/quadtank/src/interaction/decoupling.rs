//! Simplified decoupling of two loops: `u1 = v1 + g_I1 v2`, `u2 = v2 + g_I2 v1` (Campestrini 2006, eq. 72).

use std::cmp::Ordering;

use crate::linear::{LinearError, SignalPath, TransferFunction, TransferMatrix};

/// Which cross paths a dynamic decoupler removes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Decoupling {
    /// From v2 to y1 and from v1 to y2.
    Both,
    /// Only from v2 to y1: partial.
    FirstOutput,
    /// Only from v1 to y2: partial.
    SecondOutput,
}

/// Gains of the static decoupler, `K_I1 = −K12/K11` and `K_I2 = −K21/K22` with K = G(0) (Campestrini 2006, eqs. 79, 80); in the limit
/// s → 0 for integrating elements.
///
/// # Errors
/// [`LinearError::SingularGain`] when a diagonal gain is zero or not finite.
pub fn static_decoupler(plant: &TransferMatrix) -> Result<[f64; 2], LinearError> {
    let [[g11, g12], [g21, g22]] = &plant.0;
    let gains = [-ratio_at_rest(g12, g11), -ratio_at_rest(g21, g22)];
    if gains.iter().all(|g| g.is_finite()) {
        Ok(gains)
    } else {
        Err(LinearError::SingularGain { reciprocal_condition: 0.0 })
    }
}

/// `lim g(s)/h(s)` for s → 0.
fn ratio_at_rest(g: &TransferFunction, h: &TransferFunction) -> f64 {
    match g.integrators().cmp(&h.integrators()) {
        Ordering::Less => 0.0,
        Ordering::Equal => g.rest_gain() / h.rest_gain(),
        Ordering::Greater => f64::INFINITY,
    }
}

/// The plant behind a dynamic decoupler, as paths from v to y (Campestrini 2006, eqs. 76 to 78).
///
/// With `g_I1 = −g12/g11` and `g_I2 = −g21/g22` the cross paths vanish and what is left of loop 1 is
/// `g11 − g12 g21/g22`. The decoupler itself need not be strictly proper; only what it makes of the plant is computed.
///
/// # Errors
/// [`LinearError::OutOfRange`] for `dead_time` when the decoupler would have to know the future, and for a diagonal element
/// that is zero.
pub fn decoupled_paths(plant: &TransferMatrix, decoupling: Decoupling) -> Result<Vec<SignalPath>, LinearError> {
    let g = &plant.0;
    // The element that takes the input of loop `other` to output `own`, divided by what undoes it.
    let element =
        |own: usize| -> Result<TransferFunction, LinearError> { Ok(g[own][1 - own].over(&g[own][own])?.scaled(-1.0)) };
    let removes = |own: usize| match decoupling {
        Decoupling::Both => true,
        Decoupling::FirstOutput => own == 0,
        Decoupling::SecondOutput => own == 1,
    };
    let mut paths = Vec::new();
    for output in [0, 1] {
        let other = 1 - output;
        paths.push(SignalPath { input: output, output, element: g[output][output].clone() });
        if removes(output) {
            // Refused here when it knows the future, though its path is gone from the sum.
            element(output)?;
        } else {
            paths.push(SignalPath { input: other, output, element: g[output][other].clone() });
        }
        if removes(other) {
            // v of this loop reaches this output also through the other input.
            paths.push(SignalPath { input: output, output, element: g[output][other].times(&element(other)?) });
        }
    }
    Ok(paths)
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::linear::Complex;

    fn wood_berry() -> TransferMatrix {
        let g = |k: f64, t: f64, d: f64| TransferFunction::lags(k, &[t], d).unwrap();
        TransferMatrix([[g(12.8, 16.7, 1.0), g(-18.9, 21.0, 3.0)], [g(6.6, 10.9, 7.0), g(-19.4, 14.4, 3.0)]])
    }

    fn at(paths: &[SignalPath], output: usize, input: usize, s: Complex) -> Complex {
        let between = paths.iter().filter(|path| (path.output, path.input) == (output, input));
        between.map(|path| path.element.at(s)).sum()
    }

    #[test]
    fn static_gains_of_wood_and_berry() {
        // Recomputed from eq. 86: K_I1 = 1.4766, K_I2 = 0.3402.
        let [one, two] = static_decoupler(&wood_berry()).unwrap();
        assert_relative_eq!(one, 1.4766, epsilon = 5e-5);
        assert_relative_eq!(two, 0.3402, epsilon = 5e-5);
    }

    #[test]
    fn a_decoupled_plant_has_no_cross_paths_left() {
        let (plant, s) = (wood_berry(), Complex::new(0.01, 0.3));
        let g = plant.at(s);
        let paths = decoupled_paths(&plant, Decoupling::Both).unwrap();
        assert_eq!(at(&paths, 0, 1, s) + at(&paths, 1, 0, s), Complex::ZERO);
        let expected = g[(0, 0)] - g[(0, 1)] * g[(1, 0)] / g[(1, 1)];
        assert_relative_eq!((at(&paths, 0, 0, s) - expected).norm(), 0.0, epsilon = 1e-13);
    }

    #[test]
    fn a_partial_decoupler_leaves_one_path_and_the_other_loop_as_they_are() {
        let (plant, s) = (wood_berry(), Complex::new(0.01, 0.3));
        let g = plant.at(s);
        // D = [1, g_I1; 0, 1]: y2 sees v2 through g22 + g21 g_I1.
        let paths = decoupled_paths(&plant, Decoupling::FirstOutput).unwrap();
        assert_eq!(at(&paths, 0, 1, s), Complex::ZERO);
        assert_eq!((at(&paths, 0, 0, s), at(&paths, 1, 0, s)), (g[(0, 0)], g[(1, 0)]));
        let expected = g[(1, 1)] - g[(1, 0)] * g[(0, 1)] / g[(0, 0)];
        assert_relative_eq!((at(&paths, 1, 1, s) - expected).norm(), 0.0, epsilon = 1e-13);
    }

    #[test]
    fn a_partial_decoupler_of_the_second_output_is_the_mirror_of_that_of_the_first() {
        let (plant, s) = (wood_berry(), Complex::new(0.01, 0.3));
        let g = plant.at(s);
        // D = [1, 0; g_I2, 1]: y1 sees v1 through g11 + g12 g_I2.
        let paths = decoupled_paths(&plant, Decoupling::SecondOutput).unwrap();
        assert_eq!(at(&paths, 1, 0, s), Complex::ZERO);
        assert_eq!((at(&paths, 1, 1, s), at(&paths, 0, 1, s)), (g[(1, 1)], g[(0, 1)]));
        let expected = g[(0, 0)] - g[(0, 1)] * g[(1, 0)] / g[(1, 1)];
        assert_relative_eq!((at(&paths, 0, 0, s) - expected).norm(), 0.0, epsilon = 1e-13);
    }

    #[test]
    fn what_knows_the_future_is_refused() {
        let mut plant = wood_berry();
        plant.0[0].swap(0, 1);
        let refused = LinearError::OutOfRange { field: "dead_time", value: -2.0 };
        assert_eq!(decoupled_paths(&plant, Decoupling::Both), Err(refused));
    }
}
