//! Polynomials with a bound on their rounding errors, and their roots with multiplicities.

use super::{Complex, LinearError, TransferFunction};

/// A value below this share of the sum of absolute terms that make it is rounding.
const ROUNDING: f64 = 1e-12;
/// An imaginary part below this share of a root is rounding.
const REAL: f64 = 1e-9;

/// A root with its multiplicity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Root {
    pub place: Complex,
    pub multiplicity: usize,
}

/// A polynomial by rising powers.
#[derive(Clone, Debug)]
pub(super) struct Polynomial {
    coefficients: Vec<Complex>,
    /// For each coefficient, the sum of absolute values of the products it was computed from, which bounds its rounding error.
    sizes: Vec<f64>,
}

impl Polynomial {
    pub(super) fn of(coefficients: &[f64]) -> Self {
        let sizes = coefficients.iter().map(|c| c.abs()).collect();
        Self { coefficients: coefficients.iter().copied().map(Complex::from).collect(), sizes }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.coefficients.iter().all(|&c| c == Complex::ZERO)
    }

    pub(super) fn times(&self, other: &Self) -> Self {
        let length = (self.sizes.len() + other.sizes.len()).saturating_sub(1);
        let mut product = Self { coefficients: vec![Complex::ZERO; length], sizes: vec![0.0; length] };
        for i in 0..self.sizes.len() {
            for k in 0..other.sizes.len() {
                product.coefficients[i + k] += self.coefficients[i] * other.coefficients[k];
                product.sizes[i + k] += self.sizes[i] * other.sizes[k];
            }
        }
        product
    }

    /// The product with `(s − root)^count`.
    pub(super) fn times_factor(&self, root: Complex, count: usize) -> Self {
        let factor = Self { coefficients: vec![-root, Complex::ONE], sizes: vec![root.norm(), 1.0] };
        (0..count).fold(self.clone(), |so_far, _| so_far.times(&factor))
    }

    /// `self − other`, with coefficients that are zero but for rounding set to zero.
    pub(super) fn minus(&self, other: &Self) -> Self {
        let at = |of: &Self, k: usize| {
            of.coefficients.get(k).copied().zip(of.sizes.get(k).copied()).unwrap_or((Complex::ZERO, 0.0))
        };
        let difference = |k: usize| {
            let ((one, size), (two, other_size)) = (at(self, k), at(other, k));
            let size = size + other_size;
            (if (one - two).norm() <= ROUNDING * size { Complex::ZERO } else { one - two }, size)
        };
        let (coefficients, sizes) = (0..self.sizes.len().max(other.sizes.len())).map(difference).unzip();
        Self { coefficients, sizes }
    }

    /// Multiplicity of `place` as a root, up to rounding.
    pub(super) fn multiplicity_at(&self, place: Complex) -> usize {
        let mut rest = self.clone();
        let mut count = 0;
        while rest.sizes.len() > 1 && !rest.is_zero() {
            let (quotient, (value, size)) = rest.divided(place);
            if value.norm() > ROUNDING * size {
                break;
            }
            count += 1;
            rest = quotient;
        }
        count
    }

    /// The quotient by `(s − root)^count`, which divides the polynomial.
    pub(super) fn over_factor(&self, root: Complex, count: usize) -> Self {
        (0..count).fold(self.clone(), |so_far, _| so_far.divided(root).0)
    }

    /// The quotient by `s − root`, and the remainder, which is the value there, with its size.
    fn divided(&self, root: Complex) -> (Self, (Complex, f64)) {
        let (mut value, mut size) = (Complex::ZERO, 0.0);
        let mut quotient = Self { coefficients: Vec::new(), sizes: Vec::new() };
        for (&c, &of) in self.coefficients.iter().zip(&self.sizes).rev() {
            (value, size) = (value * root + c, size * root.norm() + of);
            quotient.coefficients.push(value);
            quotient.sizes.push(size);
        }
        quotient.coefficients.pop();
        quotient.sizes.pop();
        quotient.coefficients.reverse();
        quotient.sizes.reverse();
        (quotient, (value, size))
    }

    /// Roots of a nonzero polynomial that is real up to rounding, without regard to multiplicity; those at the origin are exact.
    ///
    /// # Errors
    /// [`LinearError::NoConvergence`].
    fn simple_roots(&self) -> Result<Vec<Complex>, LinearError> {
        let real: Vec<f64> = self.coefficients.iter().map(|c| c.re).collect();
        let Some(at_origin) = real.iter().position(|&c| c != 0.0) else { return Ok(Vec::new()) };
        let mut roots = TransferFunction::new(vec![1.0], real[at_origin..].to_vec(), 0.0)?.poles()?;
        roots.resize(roots.len() + at_origin, Complex::ZERO);
        Ok(roots)
    }

    /// Distinct roots of a real polynomial that is not zero. A root that is one m times is computed as m roots some `ε^(1/m)` apart,
    /// whose mean is as accurate as a simple root; roots are one where the polynomial has their mean as a root so often, to rounding.
    ///
    /// # Errors
    /// [`LinearError::NoConvergence`].
    pub(super) fn roots(&self) -> Result<Vec<Root>, LinearError> {
        let mut left = self.simple_roots()?;
        let mut found = Vec::new();
        while let Some(&first) = left.first() {
            let root = self.largest_cluster(&left, first);
            take_nearest(&mut left, root);
            found.push(root);
            if root.place.im != 0.0 {
                let conjugate = Root { place: root.place.conj(), ..root };
                take_nearest(&mut left, conjugate);
                found.push(conjugate);
            }
        }
        Ok(found)
    }

    /// The largest cluster of roots about `first` that is one multiple root: its mean and multiplicity.
    fn largest_cluster(&self, roots: &[Complex], first: Complex) -> Root {
        let mut by_distance = roots.to_vec();
        by_distance.sort_by(|x, y| (x - first).norm().total_cmp(&(y - first).norm()));
        let cluster = |count: usize| {
            let mean = by_distance[..count].iter().sum::<Complex>() / count as f64;
            let is_real = mean.im.abs() <= REAL * mean.norm();
            Root { place: if is_real { mean.re.into() } else { mean }, multiplicity: count }
        };
        let is_one = |root: &Root| self.multiplicity_at(root.place) >= root.multiplicity;
        (2..=by_distance.len()).rev().map(cluster).find(is_one).unwrap_or(Root { place: first, multiplicity: 1 })
    }
}

/// Removes the computed roots that `root` stands for: the nearest ones, as many as its multiplicity.
fn take_nearest(roots: &mut Vec<Complex>, root: Root) {
    roots.sort_by(|x, y| (x - root.place).norm().total_cmp(&(y - root.place).norm()));
    roots.drain(..root.multiplicity.min(roots.len()));
}
