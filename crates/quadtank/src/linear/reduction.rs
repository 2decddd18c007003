//! Orthogonal reductions of a (scaled) model: to a minimal one, and to one whose feedthrough has full row rank.

use nalgebra::{DMatrix, Dyn};

use super::StateSpace;

/// The size below which a number is taken for a rounding error, in a model scaled to entries of about 1.
///
/// Rank decisions become less sure as they build on each other: a space spanned by pivots of size p is known to within
/// the rounding error over p.
struct RankTolerance {
    tolerance: f64,
    smallest_pivot: f64,
}

impl RankTolerance {
    /// The tolerance before the first decision.
    fn new(tolerance: f64) -> Self {
        Self { tolerance, smallest_pivot: 1.0 }
    }

    fn threshold(&self) -> f64 {
        self.tolerance / self.smallest_pivot
    }
}

/// A pivoted QR decomposition with the rank that it revealed.
struct Compression {
    qr: nalgebra::ColPivQR<f64, Dyn, Dyn>,
    rank: usize,
}

impl Compression {
    /// Finds an orthogonal Q so that only the first `rank` rows of `Qᵀ m` differ from zero by more than rounding.
    fn of(m: DMatrix<f64>, rank_tolerance: &mut RankTolerance) -> Self {
        let qr = m.col_piv_qr();
        let r = qr.r();
        let threshold = rank_tolerance.threshold();
        let mut rank = 0;
        for pivot in (0..r.nrows()).map(|i| r[(i, i)].abs()).take_while(|pivot| *pivot > threshold) {
            rank += 1;
            rank_tolerance.smallest_pivot = rank_tolerance.smallest_pivot.min(pivot);
        }
        Self { qr, rank }
    }

    /// `Qᵀ m`.
    fn rows(&self, mut m: DMatrix<f64>) -> DMatrix<f64> {
        self.qr.q_tr_mul(&mut m);
        m
    }

    /// `m Q`.
    fn columns(&self, m: &DMatrix<f64>) -> DMatrix<f64> {
        self.rows(m.transpose()).transpose()
    }

    /// `Qᵀ m Q`.
    fn similar(&self, m: DMatrix<f64>) -> DMatrix<f64> {
        self.columns(&self.rows(m))
    }
}

/// The controllable and observable part: the same transfer matrix from the fewest states.
///
/// What is left out are the decoupling zeros, modes that G(s) does not show.
pub(super) fn minimal(model: StateSpace, tolerance: f64) -> StateSpace {
    observable(observable(model, RankTolerance::new(tolerance)).dual(), RankTolerance::new(tolerance)).dual()
}

/// The observable part, by the staircase algorithm: first the states that the outputs see, then those that these
/// states see, until nothing new is seen.
fn observable(model: StateSpace, mut rank_tolerance: RankTolerance) -> StateSpace {
    let n = model.order();
    let StateSpace { mut a, mut b, mut c, d } = model;
    let mut seen = 0;
    let mut view = c.clone();
    while seen < n && view.nrows() > 0 {
        let step = Compression::of(view.transpose(), &mut rank_tolerance);
        if step.rank == 0 {
            break;
        }
        let unseen = n - seen;
        let corner = step.similar(a.view((seen, seen), (unseen, unseen)).into_owned());
        a.view_mut((seen, seen), (unseen, unseen)).copy_from(&corner);
        let above = step.columns(&a.view((0, seen), (seen, unseen)).into_owned());
        a.view_mut((0, seen), (seen, unseen)).copy_from(&above);
        let left = step.rows(a.view((seen, 0), (unseen, seen)).into_owned());
        a.view_mut((seen, 0), (unseen, seen)).copy_from(&left);
        let driven = step.rows(b.rows(seen, unseen).into_owned());
        b.rows_mut(seen, unseen).copy_from(&driven);
        let driving = step.columns(&c.columns(seen, unseen).into_owned());
        c.columns_mut(seen, unseen).copy_from(&driving);
        view = a.view((seen, seen + step.rank), (step.rank, unseen - step.rank)).into_owned();
        seen += step.rank;
    }
    let a = a.view((0, 0), (seen, seen)).into_owned();
    StateSpace { a, b: b.rows(0, seen).into_owned(), c: c.columns(0, seen).into_owned(), d }
}

/// Reduces the pencil `[A − sI, B; C, D]` to one with the same finite zeros whose D has full row rank (Emami-Naeini and
/// Van Dooren 1982, algorithm REDUCE).
///
/// Each round turns the outputs so that some of them have no feedthrough. The zero dynamics hold these at zero, hence
/// the states that they see too, hence the derivatives of those states, which become outputs in their place. An output
/// that depends on the others drops out; the number of outputs left is the normal rank of G.
pub(super) fn reduce(mut model: StateSpace, tolerance: f64) -> StateSpace {
    let mut rank_tolerance = RankTolerance::new(tolerance);
    while model.outputs() > 0 {
        let StateSpace { a, b, c, d } = model;
        let direct = Compression::of(d.clone(), &mut rank_tolerance);
        let sigma = direct.rank;
        if sigma == d.nrows() {
            return StateSpace { a, b, c, d };
        }
        let (c, d) = (direct.rows(c), direct.rows(d).rows(0, sigma).into_owned());
        let indirect = Compression::of(c.rows_range(sigma..).transpose(), &mut rank_tolerance);
        let c = c.rows(0, sigma).into_owned();
        let tau = indirect.rank;
        if tau == 0 {
            return StateSpace { a, b, c, d };
        }
        let (a, b, c) = (indirect.similar(a), indirect.rows(b), indirect.columns(&c));
        model = StateSpace {
            a: a.view_range(tau.., tau..).into_owned(),
            b: b.rows_range(tau..).into_owned(),
            c: stack(&c.columns_range(tau..).into_owned(), &a.view_range(..tau, tau..).into_owned()),
            d: stack(&d, &b.rows_range(..tau).into_owned()),
        };
    }
    model
}

/// `[top; bottom]`.
fn stack(top: &DMatrix<f64>, bottom: &DMatrix<f64>) -> DMatrix<f64> {
    let mut both = DMatrix::zeros(top.nrows() + bottom.nrows(), top.ncols());
    both.rows_mut(0, top.nrows()).copy_from(top);
    both.rows_mut(top.nrows(), bottom.nrows()).copy_from(bottom);
    both
}

#[cfg(test)]
mod tests {
    use nalgebra::dmatrix;

    use super::*;

    const TOLERANCE: f64 = 1e-13;

    #[test]
    fn the_doubt_grows_with_the_smallest_pivot_so_far() {
        let mut rank_tolerance = RankTolerance::new(TOLERANCE);
        assert_eq!(rank_tolerance.threshold(), TOLERANCE);
        assert_eq!(Compression::of(dmatrix![1.0, 0.0; 0.0, 0.125], &mut rank_tolerance).rank, 2);
        assert_eq!(rank_tolerance.threshold(), 8.0 * TOLERANCE);
        // A larger pivot later does not lower the threshold.
        assert_eq!(Compression::of(dmatrix![0.5], &mut rank_tolerance).rank, 1);
        assert_eq!(rank_tolerance.threshold(), 8.0 * TOLERANCE);
        // What counts in a first decision is a rounding error in a later one; the limit itself is one.
        for (size, rank) in [(7.9 * TOLERANCE, 0), (8.0 * TOLERANCE, 0), (8.1 * TOLERANCE, 1)] {
            let mut rank_tolerance = RankTolerance { ..rank_tolerance };
            assert_eq!(Compression::of(dmatrix![size], &mut rank_tolerance).rank, rank);
        }
        assert_eq!(Compression::of(dmatrix![7.9 * TOLERANCE], &mut RankTolerance::new(TOLERANCE)).rank, 1);
    }

    /// 1/(s+1) in parallel with a lag that the output does not see and one that the input does not move.
    fn with_hidden_modes() -> StateSpace {
        let a = dmatrix![-1.0, 0.0, 0.3; 0.7, -2.0, 0.1; 0.0, 0.0, -3.0];
        StateSpace::strictly_proper(a, dmatrix![1.0; 1.0; 0.0], dmatrix![1.0, 0.0, 1.0]).unwrap()
    }

    #[test]
    fn hidden_modes_are_left_out() {
        let small = minimal(with_hidden_modes(), TOLERANCE);
        assert_eq!(small.order(), 1);
        approx::assert_relative_eq!(small.poles().unwrap()[0].re, -1.0, max_relative = 1e-14);
        approx::assert_relative_eq!(small.dc_gain().unwrap()[0], 1.0, max_relative = 1e-14);
    }

    #[test]
    fn a_minimal_model_keeps_its_states_and_its_gain() {
        let model = StateSpace::strictly_proper(
            dmatrix![-1.0, 2.0, 0.0; 0.5, -3.0, 1.0; 0.0, 0.4, -2.0],
            dmatrix![0.0; 0.0; 1.0],
            dmatrix![1.0, 0.0, 0.0],
        )
        .unwrap();
        let same = minimal(model.clone(), TOLERANCE);
        assert_eq!(same.order(), 3);
        approx::assert_relative_eq!(same.dc_gain().unwrap(), model.dc_gain().unwrap(), max_relative = 1e-13);
    }

    #[test]
    fn no_outputs_or_a_static_gain_reduce_to_nothing() {
        let blind = StateSpace::strictly_proper(dmatrix![-1.0], dmatrix![1.0], DMatrix::zeros(0, 1)).unwrap();
        assert_eq!(minimal(blind.clone(), TOLERANCE).order(), 0);
        assert_eq!(reduce(blind, TOLERANCE).outputs(), 0);
        let rank_one = dmatrix![1.0, 2.0; 2.0, 4.0];
        let gain = StateSpace::new(DMatrix::zeros(0, 0), DMatrix::zeros(0, 2), DMatrix::zeros(2, 0), rank_one).unwrap();
        assert_eq!(reduce(gain, TOLERANCE).outputs(), 1);
    }

    #[test]
    fn a_chain_of_integrators_has_a_feedthrough_after_as_many_rounds() {
        let chain = StateSpace::strictly_proper(
            dmatrix![0.0, 1.0, 0.0; 0.0, 0.0, 1.0; 0.0, 0.0, 0.0],
            dmatrix![0.0; 0.0; 2.0],
            dmatrix![1.0, 0.0, 0.0],
        )
        .unwrap();
        let reduced = reduce(chain, TOLERANCE);
        assert_eq!((reduced.order(), reduced.outputs()), (0, 1));
        assert_eq!(reduced.d[0].abs(), 2.0);
    }
}
