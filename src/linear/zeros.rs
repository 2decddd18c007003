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
    for (i, &value) in values.iter().enumerate() {
        let zero = match zeros.last().filter(|last| value.im > 0.0 && last.value == value.conj() * scaled.rate) {
            Some(conjugate) => conjugate.conjugate(),
            None => {
                let close = |other: &&Complex| (*other - value).norm() <= SAME_ZERO * value.norm();
                let repetition = values.iter().take(i).filter(close).count();
                scaled.zero(&system, value, repetition).ok_or(failure)?
            }
        };
        zeros.push(zero);
    }
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
    /// The zero of the unscaled model that belongs to the zero `value` of `system`, the minimal part of the scaled one.
    fn zero(&self, system: &StateSpace, value: Complex, repetition: usize) -> Option<TransmissionZero> {
        let (input, output) = if value.im == 0.0 {
            let (input, output) = directions(system, value.re, repetition)?;
            (input.map(Complex::from), output.map(Complex::from))
        } else {
            directions(system, value, repetition)?
        };
        let input = input.zip_map(&DVector::from_column_slice(&self.inputs), |u, scale| u * scale);
        let output = output.zip_map(&DVector::from_column_slice(&self.outputs), |y, scale| y * scale);
        let value = value * self.rate;
        let zero = TransmissionZero { value, input_direction: unit(input)?, output_direction: unit(output)? };
        value.is_finite().then_some(zero)
    }
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

/// Input and output direction from the null vectors of `[A − zI, B; C, D]`, not yet of unit length.
fn directions<T>(system: &StateSpace, z: T, repetition: usize) -> Option<(DVector<T>, DVector<T>)>
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
    let (right, left) = null_vectors(pencil, repetition)?;
    Some((right.rows(n, m).into_owned(), left.rows(n, m).into_owned()))
}

/// The vector brought to unit length, its largest entry (the first of equals) real and positive.
fn unit(mut vector: DVector<Complex>) -> Option<DVector<Complex>> {
    let largest = vector.iter().map(|x| x.norm()).fold(0.0, f64::max);
    if largest == 0.0 || !largest.is_finite() {
        return None;
    }
    vector.unscale_mut(largest);
    let leading = vector.iter().find(|x| x.norm() >= 1.0 - SAME_SIZE)?;
    let turn = leading.conj() / (leading.norm() * vector.norm());
    Some(vector * turn)
}
