//! Transmission zeros: the frequencies at which some combination of inputs does not reach the outputs.

use nalgebra::{ComplexField, DMatrix, DVector};

use super::null_vectors::null_vectors;
use super::reduction::{minimal, reduce};
use super::scaling::Scaled;
use super::{Complex, LinearError, StateSpace, eigenvalues};

/// Rounding errors allowed for, in units of the last place of the largest entry, before a number counts as zero.
const ROUNDINGS: f64 = 64.0;

/// Two zeros closer than this, relative to the larger, are one zero twice when directions are looked for.
const SAME_ZERO: f64 = 1e-7;

/// A null vector of the pencil with a smaller share of inputs (or outputs) than this belongs to a hidden mode.
const HIDDEN: f64 = 1e-12;

/// Entries of a direction within this of the largest count as equally large when its sign is chosen.
const SAME_SIZE: f64 = 1e-9;

/// A finite transmission zero `z` of a square model and the directions that belong to it: `G(z) u = 0`, `yᵀ G(z) = 0`.
///
/// An input `u e^{zt}`, with the right initial state, leaves every output at zero; no control can move the combination
/// `yᵀ y(t)` at `s = z`. A zero in the right half-plane limits every controller (Johansson 2000).
#[derive(Clone, Debug, PartialEq)]
pub struct TransmissionZero {
    /// Its place in the s-plane (1/s).
    pub value: Complex,
    /// Input direction `u`, unit length, its (first) largest entry real and positive.
    pub input_direction: DVector<Complex>,
    /// Output direction `y` (η in the sources), unit length, its (first) largest entry real and positive.
    pub output_direction: DVector<Complex>,
}

/// Puts the zero nearest to the origin exactly there. A model with a singular G(0) and no pole at the origin has a zero at the
/// origin, which is computed with a rounding error.
pub fn place_nearest_at_origin(zeros: &mut [TransmissionZero]) {
    if let Some(nearest) = zeros.iter_mut().min_by(|x, y| x.value.norm().total_cmp(&y.value.norm())) {
        nearest.value = Complex::ZERO;
    }
}

/// Finite transmission zeros of a square model, by rising real part, each as often as its multiplicity.
///
/// The model is scaled, reduced to its controllable and observable part (modes that cancel are no zeros of G), then
/// reduced by orthogonal transformations until its feedthrough is invertible; the zeros are the eigenvalues of
/// `A − B D⁻¹ C` of what is left (Emami-Naeini and Van Dooren 1982). Directions are null vectors of the pencil
/// `[A − zI, B; C, D]`, which exist at a pole too.
///
/// # Errors
/// [`LinearError::NotSquare`]; [`LinearError::DegenerateRank`] when det G(s) ≡ 0;
/// [`LinearError::NoConvergence`] when an entry is not finite, or too far from the others for f64.
///
/// # Examples
/// The rig of Johansson (2000) in its non-minimum-phase setting has a zero in the right half-plane, at 0.013 1/s.
/// ```
/// use quadtank::linear::{StateSpace, transmission_zeros};
/// use quadtank::literature::PresetId;
///
/// let rig = PresetId::JohanssonNonMinimumPhase.preset();
/// let rest = rig.plant.equilibrium(rig.pump_voltage)?;
/// let (a, b, c) = rig.plant.linearise(&rest).reduced();
/// let model = StateSpace::strictly_proper(a, b, c)?;
/// let zeros = transmission_zeros(&model)?;
/// assert!((zeros[1].value.re - 0.013).abs() < 5e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn transmission_zeros(model: &StateSpace) -> Result<Vec<TransmissionZero>, LinearError> {
    model.check()?;
    model.check_square()?;
    let scaled = Scaled::new(model)?;
    let tolerance = tolerance(&scaled.model);
    let system = minimal(scaled.model.clone(), tolerance);
    let reduced = reduce(system.clone(), tolerance);
    let (rank, size) = (reduced.outputs(), model.inputs());
    if rank < size {
        return Err(LinearError::DegenerateRank { rank, size });
    }
    let failure = LinearError::NoConvergence { size: model.order() };
    let dynamics = zero_dynamics(reduced).ok_or(failure)?;
    let values = eigenvalues(&dynamics)?;
    let mut zeros: Vec<TransmissionZero> = Vec::with_capacity(values.len());
    for (i, &value) in values.iter().enumerate().filter(|(_, value)| value.im <= 0.0) {
        let repetition = values.iter().take(i).filter(|&&other| are_same(other, value)).count();
        let Some(zero) = scaled.zero(&system, value, repetition)? else { continue };
        if value.im < 0.0 {
            zeros.push(zero.conjugate());
        }
        zeros.push(zero);
    }
    zeros.sort_by(|x, y| x.value.re.total_cmp(&y.value.re).then(x.value.im.total_cmp(&y.value.im)));
    Ok(zeros)
}

impl StateSpace {
    /// Normal rank of G(s): its rank at almost every s. Inputs and outputs need not be equal in number.
    ///
    /// # Errors
    /// [`LinearError::Dimension`]; [`LinearError::NoConvergence`] when an entry is not finite, or too far from the
    /// others for f64.
    pub fn normal_rank(&self) -> Result<usize, LinearError> {
        self.check()?;
        let scaled = Scaled::new(self)?.model;
        let tolerance = tolerance(&scaled);
        Ok(reduce(scaled, tolerance).outputs())
    }
}

impl TransmissionZero {
    fn conjugate(&self) -> Self {
        Self {
            value: self.value.conj(),
            input_direction: self.input_direction.conjugate(),
            output_direction: self.output_direction.conjugate(),
        }
    }
}

impl Scaled {
    /// The zero of the unscaled model that belongs to the zero `value` of `system`, the minimal part of the scaled one;
    /// `None` where inputs or outputs have no part in it, a mode that is hidden after all.
    fn zero(
        &self,
        system: &StateSpace,
        value: Complex,
        repetition: usize,
    ) -> Result<Option<TransmissionZero>, LinearError> {
        let failure = LinearError::NoConvergence { size: self.model.order() };
        let (value, right, left) = if value.im == 0.0 {
            let (value, right, left) = polish(system, value.re, repetition).ok_or(failure)?;
            (Complex::from(value), right.map(Complex::from), left.map(Complex::from))
        } else {
            polish(system, value, repetition).ok_or(failure)?
        };
        let value = value * self.rate;
        let direction = |null_vector: &DVector<Complex>, scales: &[f64]| {
            if is_hidden(null_vector, system.order()) {
                Ok(None)
            } else {
                let part = null_vector.rows_range(system.order()..);
                unit(part.zip_map(&DVector::from_column_slice(scales), |x, scale| x * scale)).map(Some).ok_or(failure)
            }
        };
        let directions = (direction(&right, &self.inputs)?, direction(&left, &self.outputs)?);
        let (Some(input_direction), Some(output_direction)) = directions else { return Ok(None) };
        if value.is_finite() {
            Ok(Some(TransmissionZero { value, input_direction, output_direction }))
        } else {
            Err(failure)
        }
    }
}

/// Whether two zeros are one zero twice.
fn are_same(one: Complex, other: Complex) -> bool {
    (one - other).norm() <= SAME_ZERO * other.norm()
}

/// Whether inputs (or outputs), which stand behind the states in a null vector of the pencil, have no part in it.
fn is_hidden(null_vector: &DVector<Complex>, order: usize) -> bool {
    null_vector.rows_range(order..).norm() <= HIDDEN * null_vector.norm()
}

/// Sizes below this are rounding errors of the (scaled) model.
fn tolerance(model: &StateSpace) -> f64 {
    let squares: f64 = [&model.a, &model.b, &model.c, &model.d].iter().map(|m| m.norm_squared()).sum();
    ROUNDINGS * f64::EPSILON * squares.sqrt()
}

/// `A − B D⁻¹ C`.
fn zero_dynamics(reduced: StateSpace) -> Option<DMatrix<f64>> {
    let StateSpace { a, b, c, d } = reduced;
    if d.is_empty() { Some(a) } else { d.full_piv_lu().solve(&c).map(|x| a - b * x) }
}

/// A zero brought to full accuracy, with the right and left null vector of its pencil.
///
/// The reduction may have divided by a small number. The model itself has not: with the null vectors v, w of the pencil
/// `M − zE = [A − zI, B; C, D]`, the zero is off by `wᵀ(M − zE)v / wᵀEv`, to second order.
fn polish<T>(system: &StateSpace, z: T, repetition: usize) -> Option<(T, DVector<T>, DVector<T>)>
where
    T: ComplexField<RealField = f64>,
{
    let n = system.order();
    let at = pencil(system, &z);
    let (mut right, mut left) = null_vectors(at.clone(), repetition)?;
    let slope = left.rows(0, n).dot(&right.rows(0, n));
    let correction = left.dot(&(at * &right)) / slope;
    let small = correction.clone().abs() <= SAME_ZERO * (1.0 + z.clone().abs());
    let z = if small { z + correction } else { z };
    if small {
        (right, left) = null_vectors(pencil(system, &z), repetition)?;
    }
    Some((z, right, left))
}

/// `[A − zI, B; C, D]`.
fn pencil<T>(system: &StateSpace, z: &T) -> DMatrix<T>
where
    T: ComplexField<RealField = f64>,
{
    let (n, m) = (system.order(), system.inputs());
    let mut pencil = DMatrix::zeros(n + m, n + m);
    let blocks = [(&system.a, 0, 0), (&system.b, 0, n), (&system.c, n, 0), (&system.d, n, n)];
    for (block, row, column) in blocks {
        for (j, entries) in block.column_iter().enumerate() {
            for (i, entry) in entries.iter().enumerate() {
                pencil[(row + i, column + j)] = T::from_real(*entry);
            }
        }
    }
    for i in 0..n {
        pencil[(i, i)] -= z.clone();
    }
    pencil
}

/// The vector brought to unit length, its largest entry (the first of equals) real and positive.
fn unit(mut vector: DVector<Complex>) -> Option<DVector<Complex>> {
    // A vector that is zero or infinite has no entry of size 1 after the scaling.
    vector.unscale_mut(vector.iter().map(|x| x.norm()).fold(0.0, f64::max));
    let leading = vector.iter().find(|x| x.norm() >= 1.0 - SAME_SIZE)?;
    let turn = leading.conj() / (leading.norm() * vector.norm());
    Some(vector * turn)
}

#[cfg(test)]
mod tests {
    use nalgebra::dmatrix;

    use super::*;

    fn real(vector: &DVector<Complex>) -> Vec<f64> {
        assert!(vector.iter().all(|entry| entry.im == 0.0));
        vector.iter().map(|entry| entry.re).collect()
    }

    fn static_gain(d: DMatrix<f64>) -> StateSpace {
        let (p, m) = d.shape();
        StateSpace::new(DMatrix::zeros(0, 0), DMatrix::zeros(0, m), DMatrix::zeros(p, 0), d).unwrap()
    }

    #[test]
    fn one_input_one_output() {
        // (s − 2)/((s + 1)(s + 3)) in controllable form.
        let a = dmatrix![0.0, 1.0; -3.0, -4.0];
        let model = StateSpace::strictly_proper(a, dmatrix![0.0; 1.0], dmatrix![-2.0, 1.0]).unwrap();
        let zeros = transmission_zeros(&model).unwrap();
        assert_eq!(zeros.len(), 1);
        assert!((zeros[0].value - 2.0).norm() < 1e-14);
        assert_eq!(real(&zeros[0].input_direction), [1.0]);
        assert_eq!(real(&zeros[0].output_direction), [1.0]);
    }

    #[test]
    fn a_pair_of_complex_zeros_with_conjugate_directions() {
        // (s² + 1)/(s + 1)³ beside 1/(s + 2), coupled from input 1 to output 2.
        let a = dmatrix![
            0.0, 1.0, 0.0, 0.0;
            0.0, 0.0, 1.0, 0.0;
            -1.0, -3.0, -3.0, 0.0;
            0.0, 0.0, 0.0, -2.0
        ];
        let b = dmatrix![0.0, 0.0; 0.0, 0.0; 1.0, 0.0; 1.0, 1.0];
        let c = dmatrix![1.0, 0.0, 1.0, 0.0; 0.0, 0.0, 0.0, 1.0];
        let model = StateSpace::strictly_proper(a, b, c).unwrap();
        let zeros = transmission_zeros(&model).unwrap();
        assert_eq!(zeros.len(), 2);
        assert_eq!(zeros[0].value, zeros[1].value.conj());
        assert_eq!(zeros[0].input_direction, zeros[1].input_direction.conjugate());
        for zero in &zeros {
            assert!((zero.value.norm() - 1.0).abs() < 1e-14 && zero.value.re.abs() < 1e-14);
            let gain = model.gain_at(zero.value).unwrap();
            assert!((&gain * &zero.input_direction).norm() < 1e-14);
            assert!((gain.transpose() * &zero.output_direction).norm() < 1e-14);
        }
    }

    #[test]
    fn a_zero_at_a_pole_has_directions_too() {
        // G = [1, 0; 1/s, 1]: det G = 1, yet both a pole and a zero at the origin.
        let model =
            StateSpace::new(dmatrix![0.0], dmatrix![1.0, 0.0], dmatrix![0.0; 1.0], DMatrix::identity(2, 2)).unwrap();
        let zeros = transmission_zeros(&model).unwrap();
        assert_eq!(zeros.len(), 1);
        assert!(zeros[0].value.norm() < 1e-15);
        let (input, output) = (real(&zeros[0].input_direction), real(&zeros[0].output_direction));
        assert!(input[0].abs() < 1e-15 && (input[1] - 1.0).abs() < 1e-15, "{input:?}");
        assert!(output[1].abs() < 1e-15 && (output[0] - 1.0).abs() < 1e-15, "{output:?}");
    }

    #[test]
    fn a_zero_of_both_channels_has_two_directions() {
        // (s − 1)/(s + 1) twice.
        let identity = DMatrix::identity(2, 2);
        let model = StateSpace::new(-&identity, identity.clone(), &identity * -2.0, identity).unwrap();
        let zeros = transmission_zeros(&model).unwrap();
        assert_eq!(zeros.len(), 2);
        assert!(zeros.iter().all(|zero| (zero.value - 1.0).norm() < 1e-14));
        let (first, second) = (&zeros[0], &zeros[1]);
        assert!(first.input_direction.dotc(&second.input_direction).norm() < 0.5);
        assert!(first.output_direction.dotc(&second.output_direction).norm() < 0.5);
    }

    /// A zero of `c [1, s, s²]ᵀ/((s + 1)(s + 2)(s + 3))`, in controllable form, after the polish from `z`.
    fn polished<T: ComplexField<RealField = f64>>(c: [f64; 3], z: T) -> T {
        let a = dmatrix![0.0, 1.0, 0.0; 0.0, 0.0, 1.0; -6.0, -11.0, -6.0];
        let model = StateSpace::strictly_proper(a, dmatrix![0.0; 0.0; 1.0], DMatrix::from_row_slice(1, 3, &c)).unwrap();
        let (value, right, left) = polish(&model, z, 0).unwrap();
        let at = pencil(&model, &value);
        // Of the place that is given back, not of the one before.
        assert!((&at * &right).norm() <= 1e-6 * right.norm() && (at.transpose() * &left).norm() <= 1e-6 * left.norm());
        value
    }

    #[test]
    fn a_zero_that_is_a_little_off_is_brought_to_full_accuracy() {
        // (s − 2)(s + 5) and s² + 4 over (s + 1)(s + 2)(s + 3): within 1e-7 (1 + |z|) the correction is of second order.
        let real = [-10.0, 3.0, 1.0];
        for off in [2.9e-7, -2.9e-7, 1e-9] {
            let left = 10.0 * off * off + 1e-14;
            assert!((polished(real, 2.0 + off) - 2.0).abs() <= left, "{off}");
            assert!((polished(real, -5.0 + off) + 5.0).abs() <= left, "{off}");
            let pair = polished([4.0, 0.0, 1.0], Complex::new(-off / 2.0, 2.0 + off / 2.0));
            assert!((pair - Complex::new(0.0, 2.0)).norm() <= left, "{off}");
        }
        // What is further away is no rounding error and stays.
        for off in [3.1e-7, 1e-5, -1e-3] {
            let model =
                StateSpace::strictly_proper(dmatrix![0.0, 1.0; -3.0, -4.0], dmatrix![0.0; 1.0], dmatrix![-2.0, 1.0]);
            assert_eq!(polish(&model.unwrap(), 2.0 + off, 0).unwrap().0, 2.0 + off);
        }
    }

    #[test]
    fn zeros_are_the_same_relative_to_their_size() {
        for size in [1e-6, 1.0, 1e6] {
            let at = |share: f64| Complex::new(0.6, 0.8 + share) * size;
            assert!(are_same(at(0.9e-7), at(0.0)) && !are_same(at(1.1e-7), at(0.0)));
        }
    }

    #[test]
    fn a_mode_is_hidden_relative_to_its_size() {
        for size in [1e-6, 1.0, 1e6] {
            let vector = |share: f64| DVector::from_vec([0.6, 0.8, share].map(|x| Complex::from(x * size)).to_vec());
            assert!(is_hidden(&vector(0.9e-12), 2) && !is_hidden(&vector(1.1e-12), 2));
        }
    }

    #[test]
    fn the_zero_nearest_to_the_origin_is_placed_there() {
        let a = dmatrix![0.0, 1.0, 0.0; 0.0, 0.0, 1.0; -6.0, -11.0, -6.0];
        let (b, c) = (dmatrix![0.0; 0.0; 1.0], dmatrix![1e-14, 1.0, 0.25]);
        let mut zeros = transmission_zeros(&StateSpace::strictly_proper(a, b, c).unwrap()).unwrap();
        place_nearest_at_origin(&mut zeros);
        assert!(zeros.len() == 2 && (zeros[0].value + 4.0).norm() < 1e-13 && zeros[1].value == Complex::ZERO);
        place_nearest_at_origin(&mut []);
    }

    #[test]
    fn the_tolerance_is_64_roundings_of_the_size_of_the_model() {
        let model =
            StateSpace::new(dmatrix![1.0], dmatrix![2.0, 4.0], dmatrix![6.0; 2.0], dmatrix![8.0, 0.0; 0.0, -10.0]);
        assert_eq!(tolerance(&model.unwrap()), 64.0 * f64::EPSILON * 15.0);
    }

    #[test]
    fn static_gains() {
        assert_eq!(transmission_zeros(&static_gain(dmatrix![1.0, 2.0; 3.0, 4.0])), Ok(vec![]));
        let singular = static_gain(dmatrix![1.0, 2.0; 3.0, 6.0]);
        assert_eq!(transmission_zeros(&singular), Err(LinearError::DegenerateRank { rank: 1, size: 2 }));
        assert_eq!(static_gain(dmatrix![1.0, 2.0, 3.0; 2.0, 4.0, 6.5]).normal_rank(), Ok(2));
        assert_eq!(transmission_zeros(&static_gain(DMatrix::zeros(0, 0))), Ok(vec![]));
    }

    #[test]
    fn more_inputs_than_outputs_are_refused() {
        let wide = static_gain(dmatrix![1.0, 2.0]);
        assert_eq!(transmission_zeros(&wide), Err(LinearError::NotSquare { inputs: 2, outputs: 1 }));
    }

    #[test]
    fn a_direction_has_unit_length_and_a_real_largest_entry() {
        let phase = Complex::from_polar(1.0, 2.0);
        let direction = unit(DVector::from_vec(vec![phase * 3.0, phase * -4.0])).unwrap();
        for (found, expected) in direction.iter().zip([-0.6, 0.8]) {
            assert!((found - expected).norm() < 1e-15, "{direction}");
        }
    }

    #[test]
    fn equally_large_entries_do_not_turn_a_direction_by_rounding() {
        let almost = |first: f64, second: f64| {
            unit(DVector::from_vec(vec![Complex::from(first), Complex::from(second)])).unwrap()
        };
        assert!(real(&almost(-1.0, 1.0 + 1e-15))[0] > 0.0);
        assert!(real(&almost(-1.0 - 1e-15, 1.0))[0] > 0.0);
        assert!(unit(DVector::zeros(2)).is_none());
        assert!(unit(DVector::from_vec(vec![Complex::from(f64::INFINITY), Complex::ONE])).is_none());
    }
}
