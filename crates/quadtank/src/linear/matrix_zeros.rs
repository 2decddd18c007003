//! Poles and zeros of a transfer matrix, by its minors.

use super::transfer::product;
use super::{Complex, LinearError, TransferFunction, TransferMatrix};

/// Roots that are nearer to each other than this, relative to their size, are the same: what rounding makes of a double root.
const SAME: f64 = 1e-6;
/// A coefficient of a difference of polynomials below this share of what is subtracted is rounding.
const ROUNDING: f64 = 1e-13;

/// Poles and zeros of a transfer matrix with two inputs and outputs, each as often as it counts, by rising real part.
#[derive(Clone, Debug, PartialEq)]
pub struct MatrixPolesAndZeros {
    /// Poles of a minimal realisation.
    pub poles: Vec<Complex>,
    /// Zeros; `None` where det G is zero at every frequency.
    pub zeros: Option<Vec<Complex>>,
}

impl MatrixPolesAndZeros {
    /// By the minors of G: the pole polynomial is the least common denominator of all of them, the zero polynomial the numerator of
    /// det G over it (Skogestad and Postlethwaite 2005, §§4.4.3 and 4.5.2). `None` where dead times do not leave det G as a whole: it
    /// then has zeros without number.
    ///
    /// # Errors
    /// [`LinearError::NoConvergence`] where the roots of a polynomial are not found.
    pub fn of(matrix: &TransferMatrix) -> Result<Option<Self>, LinearError> {
        let TransferMatrix([[a, b], [c, d]]) = matrix;
        let [main, cross] = [a.times(d), b.times(c)];
        let has_cross = cross.numerator().iter().any(|&coefficient| coefficient != 0.0);
        let has_main = main.numerator().iter().any(|&coefficient| coefficient != 0.0);
        if has_cross && has_main && main.dead_time() != cross.dead_time() {
            return Ok(None);
        }
        let mut poles = Vec::new();
        for element in [a, b, c, d] {
            let mut zeros = roots(element.numerator())?;
            let own = if zeros.is_none() { Vec::new() } else { poles_of(element)? };
            join(&mut poles, &without_common(own, zeros.get_or_insert_default()));
        }
        let numerator = difference(
            &product(main.numerator(), cross.denominator()),
            &product(cross.numerator(), main.denominator()),
        );
        let Some(mut zeros) = roots(&numerator)? else {
            return Ok(Some(Self { poles: sorted(poles), zeros: None }));
        };
        let of_determinant = [poles_of(a)?, poles_of(b)?, poles_of(c)?, poles_of(d)?].concat();
        let of_determinant = without_common(of_determinant, &mut zeros);
        join(&mut poles, &of_determinant);
        // Over all poles the numerator of the determinant has those too that it lacks.
        let mut lacking = poles.clone();
        for &pole in &of_determinant {
            take(&mut lacking, pole);
        }
        zeros.extend(lacking);
        Ok(Some(Self { poles: sorted(poles), zeros: Some(sorted(zeros)) }))
    }
}

/// Roots of a polynomial by rising powers, those at the origin exactly; `None` where it is zero.
fn roots(coefficients: &[f64]) -> Result<Option<Vec<Complex>>, LinearError> {
    let Some(at_origin) = coefficients.iter().position(|&coefficient| coefficient != 0.0) else { return Ok(None) };
    let mut roots = TransferFunction::new(vec![1.0], coefficients[at_origin..].to_vec(), 0.0)?.poles()?;
    roots.resize(roots.len() + at_origin, Complex::ZERO);
    Ok(Some(roots))
}

fn poles_of(element: &TransferFunction) -> Result<Vec<Complex>, LinearError> {
    Ok(roots(element.denominator())?.unwrap_or_default())
}

/// `one − other` without what rounding leaves where they are the same.
fn difference(one: &[f64], other: &[f64]) -> Vec<f64> {
    let at = |coefficients: &[f64], k: usize| coefficients.get(k).copied().unwrap_or(0.0);
    let pairs = (0..one.len().max(other.len())).map(|k| (at(one, k), at(other, k)));
    pairs.map(|(x, y)| if (x - y).abs() <= ROUNDING * (x.abs() + y.abs()) { 0.0 } else { x - y }).collect()
}

/// Takes the root out that is the same as the given one.
fn take(roots: &mut Vec<Complex>, root: Complex) -> Option<Complex> {
    let near = |other: &Complex| (other - root).norm();
    let nearest = (0..roots.len()).min_by(|&i, &j| near(&roots[i]).total_cmp(&near(&roots[j])))?;
    let is_same = near(&roots[nearest]) <= SAME * root.norm().max(roots[nearest].norm());
    is_same.then(|| roots.swap_remove(nearest))
}

/// The poles that no zero cancels; such zeros go too.
fn without_common(poles: Vec<Complex>, zeros: &mut Vec<Complex>) -> Vec<Complex> {
    poles.into_iter().filter(|&pole| take(zeros, pole).is_none()).collect()
}

/// Adds to the poles what they lack of others: each then counts as often as where it counts most.
fn join(poles: &mut Vec<Complex>, others: &[Complex]) {
    let mut known = poles.clone();
    for &other in others {
        if take(&mut known, other).is_none() {
            poles.push(other);
        }
    }
}

fn sorted(mut roots: Vec<Complex>) -> Vec<Complex> {
    roots.sort_by(|x, y| x.re.total_cmp(&y.re).then(x.im.total_cmp(&y.im)));
    roots
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::literature::PresetId;
    use crate::literature::campestrini::PublishedPlant;

    fn element(numerator: &[f64], denominator: &[f64], dead_time: f64) -> TransferFunction {
        TransferFunction::new(numerator.to_vec(), denominator.to_vec(), dead_time).unwrap()
    }

    fn assert_roots(found: &[Complex], expected: &[f64], tolerance: f64) {
        assert_eq!(found.len(), expected.len(), "{found:?}");
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).norm() < tolerance, "{found} {expected}");
        }
    }

    #[test]
    fn a_rig_that_was_identified_as_four_elements() {
        // A quadruple tank in a public exercise of KTH; digits as its case prints them.
        let g = TransferMatrix([
            [
                element(&[0.408_926_154_304_168_34], &[1.0, 19.585_417_190_977_324], 0.0),
                element(&[0.590_040_052_892_588_7], &[1.0, 31.237_197_388_414_6, 228.204_976_184_377_2], 0.0),
            ],
            [
                element(&[0.741_653_790_447_897], &[1.0, 32.314_565_008_956_81, 234.478_467_791_830_44], 0.0),
                element(&[0.385_247_941_149_325_8], &[1.0, 21.312_795_101_465_593], 0.0),
            ],
        ]);
        let found = MatrixPolesAndZeros::of(&g).unwrap().unwrap();
        assert_roots(&found.poles, &[-0.09089, -0.08582, -0.05106, -0.04692], 5e-6);
        assert_roots(&found.zeros.unwrap(), &[-0.23559, 0.05887], 5e-6);
    }

    #[test]
    fn elements_have_the_zeros_of_the_rig_that_they_are_of() {
        for id in PresetId::ALL {
            let preset = id.preset();
            let op = preset.plant.free_equilibrium(preset.pump_voltage);
            let [t1, t2, t3, t4] = preset.plant.time_constants_s(&op).map(Option::unwrap);
            let [gamma_1, gamma_2] = preset.plant.valves;
            let lags = |gain: f64, times: &[f64]| TransferFunction::lags(gain, times, 0.0).unwrap();
            // Johansson (2000), eq. 5, up to factors of rows and columns.
            let g = TransferMatrix([
                [lags(gamma_1 * t1, &[t1]), lags((1.0 - gamma_2) * t1, &[t3, t1])],
                [lags((1.0 - gamma_1) * t2, &[t4, t2]), lags(gamma_2 * t2, &[t2])],
            ]);
            let found = MatrixPolesAndZeros::of(&g).unwrap().unwrap();
            // Eq. 6: (1 + s T3)(1 + s T4) = (1 − γ1)(1 − γ2)/(γ1 γ2).
            let eta = (1.0 - gamma_1) * (1.0 - gamma_2) / (gamma_1 * gamma_2);
            let (half, product) = ((t3 + t4) / (2.0 * t3 * t4), (1.0 - eta) / (t3 * t4));
            let spread = (half * half - product).sqrt();
            assert_roots(&found.zeros.unwrap(), &[-half - spread, -half + spread], 1e-9);
            assert_eq!(found.poles.len(), 4, "{id:?}");
        }
    }

    #[test]
    fn a_pole_that_two_elements_share_counts_as_often_as_it_has_to() {
        // I/(s + 1) needs two states; a matrix of equal elements needs one, and has no determinant.
        let one = element(&[1.0], &[1.0, 1.0], 0.0);
        let none = element(&[0.0], &[1.0], 0.0);
        let diagonal = TransferMatrix([[one.clone(), none.clone()], [none, one.clone()]]);
        let found = MatrixPolesAndZeros::of(&diagonal).unwrap().unwrap();
        assert_roots(&found.poles, &[-1.0, -1.0], 1e-9);
        assert_eq!(found.zeros, Some(vec![]));
        let equal = TransferMatrix([[one.clone(), one.clone()], [one.clone(), one]]);
        let found = MatrixPolesAndZeros::of(&equal).unwrap().unwrap();
        assert_roots(&found.poles, &[-1.0], 1e-9);
        assert_eq!(found.zeros, None);
    }

    #[test]
    fn biproper_and_integrating_elements_have_their_poles_and_zeros() {
        let one = element(&[1.0], &[1.0], 0.0);
        let biproper = |pole: f64| element(&[1.0, 1.0], &[pole, 1.0], 0.0);
        let g = TransferMatrix([[biproper(5.0), one.clone()], [biproper(2.0), one]]);
        let found = MatrixPolesAndZeros::of(&g).unwrap().unwrap();
        assert_roots(&found.poles, &[-5.0, -2.0], 1e-9);
        assert_roots(&found.zeros.unwrap(), &[-1.0], 1e-9);
        // 1/s, 1/(s (s + 2)); 0.5/s, 1/s: det G = (s + 1.5)/(s² (s + 2)).
        let integrator = |rate: f64| element(&[rate], &[0.0, 1.0], 0.0);
        let g = TransferMatrix([
            [integrator(1.0), element(&[1.0], &[0.0, 2.0, 1.0], 0.0)],
            [integrator(0.5), integrator(1.0)],
        ]);
        let found = MatrixPolesAndZeros::of(&g).unwrap().unwrap();
        assert_roots(&found.poles, &[-2.0, 0.0, 0.0], 1e-9);
        assert_roots(&found.zeros.unwrap(), &[-1.5], 1e-9);
    }

    #[test]
    fn what_an_element_cancels_counts_for_nothing() {
        let cancelled = element(&[2.0, 2.0], &[2.0, 3.0, 1.0], 0.0);
        let none = element(&[0.0], &[1.0], 0.0);
        let g = TransferMatrix([[cancelled, none.clone()], [none, element(&[1.0], &[1.0, 4.0], 0.0)]]);
        let found = MatrixPolesAndZeros::of(&g).unwrap().unwrap();
        assert_roots(&found.poles, &[-2.0, -0.25], 1e-9);
        assert_eq!(found.zeros, Some(vec![]));
    }

    #[test]
    fn dead_times_that_do_not_leave_the_determinant_have_zeros_without_number() {
        assert_eq!(MatrixPolesAndZeros::of(&PublishedPlant::WoodBerry.transfer_matrix().unwrap()), Ok(None));
    }
}
