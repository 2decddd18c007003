//! Poles and zeros of a transfer matrix whose dead times leave its determinant as a whole, by its minors.

use super::repeated_roots::{Polynomial, Root};
use super::transfer::degree;
use super::{Complex, LinearError, TransferFunction, TransferMatrix};

/// Poles of two elements that are nearer to each other than this, relative to their size, are the same.
const SAME: f64 = 1e-7;
/// Dead times that differ by less than this share are the same, up to the rounding of their sums.
const SAME_DEAD_TIME: f64 = 1e-12;

/// Poles and zeros of a transfer matrix with two inputs and outputs, each as often as it counts, by rising real part.
#[derive(Clone, Debug, PartialEq)]
pub struct MatrixPolesAndZeros {
    /// Poles of a minimal realisation.
    pub poles: Vec<Complex>,
    /// Zeros; `None` where det G is zero at every frequency.
    pub zeros: Option<Vec<Complex>>,
}

impl MatrixPolesAndZeros {
    /// By the Smith-McMillan form of G at each place where an element has a pole (Skogestad and Postlethwaite 2005, §§4.4.3 and 4.5.2),
    /// and the roots of det G elsewhere. Factors that are known are taken out before roots are sought: of a root that is one m times
    /// rounding makes m roots that are some `ε^(1/m)` apart. `None` where dead times do not leave det G as a whole: it then has zeros
    /// without number.
    ///
    /// # Errors
    /// [`LinearError::NoConvergence`] where the roots of a polynomial are not found.
    pub fn of(matrix: &TransferMatrix) -> Result<Option<Self>, LinearError> {
        if !is_whole(matrix) {
            return Ok(None);
        }
        let elements = matrix.0.as_flattened();
        let mut of_elements = Vec::with_capacity(elements.len());
        for element in elements {
            of_elements.push(if is_zero(element) {
                Vec::new()
            } else {
                Polynomial::of(element.denominator()).roots()?
            });
        }
        let places = Place::all(&of_elements);
        let determinant = reduced_determinant(elements, &places);
        let (mut poles, mut zeros) = (Vec::new(), Vec::new());
        let mut rest = determinant.clone();
        for place in &places {
            let own = if determinant.is_zero() { None } else { Some(determinant.multiplicity_at(place.at)) };
            rest = rest.over_factor(place.at, own.unwrap_or(0));
            for index in place.structural_indices(elements, own) {
                let (count, of) = if index < 0 { (-index, &mut poles) } else { (index, &mut zeros) };
                of.extend((0..count).map(|_| place.at));
            }
        }
        if determinant.is_zero() {
            return Ok(Some(Self { poles: sorted(poles), zeros: None }));
        }
        for root in rest.roots()? {
            zeros.extend((0..root.multiplicity).map(|_| root.place));
        }
        Ok(Some(Self { poles: sorted(poles), zeros: Some(sorted(zeros)) }))
    }
}

impl MatrixPolesAndZeros {
    /// Whether a zero is in the right half-plane, where it limits every controller.
    pub fn has_right_half_plane_zero(&self) -> bool {
        self.zeros.iter().flatten().any(|zero| zero.re > 0.0)
    }
}

/// Whether both products of det G have the same dead time, or one of them is zero.
fn is_whole(TransferMatrix([[a, b], [c, d]]): &TransferMatrix) -> bool {
    let [main, cross] = [(a, d), (b, c)].map(|(one, other)| one.dead_time() + other.dead_time());
    let has_zero = [(a, d), (b, c)].iter().any(|(one, other)| is_zero(one) || is_zero(other));
    has_zero || (main - cross).abs() <= SAME_DEAD_TIME * main.max(cross)
}

fn is_zero(element: &TransferFunction) -> bool {
    element.numerator().iter().all(|&coefficient| coefficient == 0.0)
}

/// A pole of an element of G.
struct Place {
    at: Complex,
    /// Multiplicity in the denominators of g11, g12, g21 and g22.
    denominators: [usize; 4],
}

impl Place {
    /// The distinct roots of all denominators.
    fn all(of_elements: &[Vec<Root>]) -> Vec<Self> {
        let mut places: Vec<Self> = Vec::new();
        for (k, roots) in of_elements.iter().enumerate() {
            for root in roots {
                let is_same = |place: &Self| {
                    place.denominators[k] == 0
                        && (place.at - root.place).norm() <= SAME * place.at.norm().max(root.place.norm())
                };
                let known = places.iter().position(is_same);
                let place = known.unwrap_or_else(|| {
                    places.push(Self { at: root.place, denominators: [0; 4] });
                    places.len() - 1
                });
                places[place].denominators[k] = root.multiplicity;
            }
        }
        places
    }

    /// Multiplicity in the denominators of `g11 g22` and `g12 g21`.
    fn of_products(&self) -> [usize; 2] {
        let [a, b, c, d] = self.denominators;
        [a + d, b + c]
    }

    /// The powers of the local Smith-McMillan form, of poles negative, from the root that the reduced determinant has here; only the
    /// first one where det G is zero at every frequency.
    fn structural_indices(&self, elements: &[TransferFunction], determinant: Option<usize>) -> Vec<isize> {
        let power = |k: usize| {
            let zeros = Polynomial::of(elements[k].numerator()).multiplicity_at(self.at);
            zeros.cast_signed() - self.denominators[k].cast_signed()
        };
        let Some(first) = (0..4).filter(|&k| !is_zero(&elements[k])).map(power).min() else { return Vec::new() };
        let [main, cross] = self.of_products();
        let both = determinant.map(|zeros| zeros.cast_signed() - main.max(cross).cast_signed());
        std::iter::once(first).chain(both.map(|both| both - first)).collect()
    }
}

/// det G times the least common multiple of the denominators of `g11 g22` and `g12 g21`.
fn reduced_determinant(elements: &[TransferFunction], places: &[Place]) -> Polynomial {
    let numerator = |k: usize| {
        let leading = degree(elements[k].denominator()).map_or(1.0, |last| elements[k].denominator()[last]);
        Polynomial::of(&elements[k].numerator().iter().map(|c| c / leading).collect::<Vec<_>>())
    };
    let [main, cross] = [(0, 3), (1, 2)].map(|(one, other)| numerator(one).times(&numerator(other)));
    let expanded = |product: Polynomial, which: usize| {
        places.iter().fold(product, |so_far, place| {
            let counts = place.of_products();
            so_far.times_factor(place.at, counts[0].max(counts[1]) - counts[which])
        })
    };
    expanded(main, 0).minus(&expanded(cross, 1))
}

fn sorted(mut roots: Vec<Complex>) -> Vec<Complex> {
    roots.sort_by(|x, y| x.re.total_cmp(&y.re).then(x.im.total_cmp(&y.im)));
    roots
}

#[cfg(test)]
mod tests {
    use proptest::array::uniform4;
    use proptest::proptest;

    use super::*;
    use crate::linear::transfer::product;
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

    /// `n1/p1` and `n2/p2` between constant matrices: it has the poles of both and the zeros of both.
    fn between_constants(
        [n1, p1]: [&[f64]; 2],
        [n2, p2]: [&[f64]; 2],
        a: [[f64; 2]; 2],
        b: [[f64; 2]; 2],
    ) -> TransferMatrix {
        let of_roots = |roots: &[f64]| roots.iter().fold(vec![1.0], |so_far, root| product(&so_far, &[-root, 1.0]));
        let [first, second] = [product(&of_roots(n1), &of_roots(p2)), product(&of_roots(n2), &of_roots(p1))];
        let both = product(&of_roots(p1), &of_roots(p2));
        let entry = |row: usize, column: usize| {
            let at = |of: &[f64], k: usize| of.get(k).copied().unwrap_or(0.0);
            let shares = [a[row][0] * b[0][column], a[row][1] * b[1][column]];
            let sum =
                (0..both.len()).map(|k| shares[0] * at(&first, k) + shares[1] * at(&second, k)).collect::<Vec<_>>();
            element(&sum, &both, 0.0)
        };
        TransferMatrix([[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]])
    }

    #[test]
    fn a_double_pole_of_all_elements_counts_twice_for_each_input() {
        let of = |gain: f64| element(&[gain], &[1.0, 2.0, 1.0], 0.0);
        let found =
            MatrixPolesAndZeros::of(&TransferMatrix([[of(1.0), of(0.5)], [of(0.5), of(1.0)]])).unwrap().unwrap();
        assert_roots(&found.poles, &[-1.0; 4], 1e-6);
        assert_eq!(found.zeros, Some(vec![]));
    }

    #[test]
    fn repeated_factors_of_published_process_two_are_no_zeros() {
        let plant = PublishedPlant::ProcessTwo.transfer_matrix().unwrap();
        let found = MatrixPolesAndZeros::of(&plant).unwrap().unwrap();
        assert_roots(&found.poles, &[-10.0, -10.0, -10.0, -5.0, -5.0, -5.0, -5.0, -2.0], 1e-9);
        let zeros = found.zeros.unwrap();
        assert_eq!(zeros.len(), 2, "{zeros:?}");
        for (zero, sign) in zeros.iter().zip([-1.0, 1.0]) {
            assert!((zero - Complex::new(-6.0, sign * 8.0_f64.sqrt())).norm() < 1e-6, "{zero}");
        }
    }

    #[test]
    fn dead_times_of_signals_leave_the_determinant_whole() {
        // diag(e^(−0.1 s), e^(−0.2 s)) G diag(1, e^(−0.3 s)): the sums of dead times differ by rounding.
        let of = |gain: f64, dead_time: f64| element(&[gain], &[1.0, 2.0, 1.0], dead_time);
        let found =
            MatrixPolesAndZeros::of(&TransferMatrix([[of(1.0, 0.1), of(0.5, 0.4)], [of(0.5, 0.2), of(1.0, 0.5)]]));
        assert_roots(&found.unwrap().unwrap().poles, &[-1.0; 4], 1e-9);
    }

    #[test]
    fn repeated_complex_poles_stay_conjugate() {
        // 1/(s² + 0.4 s + 1)² in all elements of a regular matrix.
        let of = |gain: f64| element(&[gain], &[1.0, 0.8, 2.16, 0.8, 1.0], 0.0);
        let found =
            MatrixPolesAndZeros::of(&TransferMatrix([[of(1.0), of(0.5)], [of(0.5), of(1.0)]])).unwrap().unwrap();
        let expected = [-1.0, 1.0].map(|sign| Complex::new(-0.2, sign * 0.96_f64.sqrt()));
        assert_eq!((found.poles.len(), found.zeros), (8, Some(vec![])));
        for place in expected {
            let near = found.poles.iter().filter(|pole| (*pole - place).norm() < 1e-9).count();
            assert_eq!(near, 4, "{:?}", found.poles);
        }
    }

    proptest! {
        #[test]
        fn repeated_factors_count_as_often_as_they_are_there(
            first in (1_usize..=3, 1_usize..=4, 0_usize..=2),
            second in (1_usize..=3, 1_usize..=4, 0_usize..=2),
            gains in uniform4(0.3..2.0_f64),
        ) {
            let repeated = |(place, count, zeros): (usize, usize, usize), beside: f64| {
                (vec![2.5 * beside; zeros.min(count)], vec![-(place as f64); count])
            };
            let ((n1, p1), (n2, p2)) = (repeated(first, 1.0), repeated(second, -1.0));
            let [a, b, c, d] = gains;
            let plant = between_constants([&n1, &p1], [&n2, &p2], [[1.0, a], [-b, 1.0]], [[1.0, -c], [d, 1.0]]);
            let found = MatrixPolesAndZeros::of(&plant).unwrap().unwrap();
            let expect = |mut roots: Vec<f64>| {
                roots.sort_by(f64::total_cmp);
                roots
            };
            assert_roots(&found.poles, &expect([p1, p2].concat()), 1e-6);
            assert_roots(&found.zeros.unwrap(), &expect([n1, n2].concat()), 1e-6);
        }
    }
}
