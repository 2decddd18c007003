//! What a bench computes: from a setup, which its document holds, to results. One module per bench.

mod error;
pub mod handover;
pub mod level_loop;
mod linear_plant;
pub mod model_free;
pub mod quadruple_tank;
mod quantity;
pub mod relay_tuning;

pub use error::{StudyError, StudyErrorKind};
pub use linear_plant::LinearPlant;
pub use quantity::{Quantity, UNITS};

use std::sync::Arc;

use crate::sim::Trajectory;

/// What a bench computes from the setup of its document.
///
/// [`update`](Self::update) decides what a change invalidates: a part of the results that cannot have changed is taken over from
/// the last ones, as the same [`Arc`], so that what shows it can leave it alone.
pub trait Study {
    /// What the results follow from.
    type Setup: Clone + PartialEq;
    /// All results, in parts that are shared.
    type Results: Clone + 'static;
    /// The numbers that follow from results, by their names.
    const QUANTITIES: &'static [Quantity<Self::Results>];

    /// The setup that results are of.
    fn setup_of(results: &Self::Results) -> &Arc<Self::Setup>;

    /// The results of a setup and of those pinned to compare with, given the last results.
    fn update(setup: &Self::Setup, pinned: &[Self::Setup], last: Option<&Self::Results>) -> Self::Results;
}

/// A setup that is pinned, with its result.
#[derive(Clone, Debug)]
pub struct Pinned<S, R> {
    /// The setup.
    pub setup: S,
    /// What it gives.
    pub result: Arc<R>,
}

/// Pinned setups with their results, in the same order.
pub type PinnedResults<S, R> = Arc<Vec<Pinned<S, R>>>;

/// The results of pinned setups; those known already are taken over, and if all are, their list is.
fn update_pinned<S: Clone + PartialEq, R>(
    setups: &[S],
    last: Option<&PinnedResults<S, R>>,
    compute: impl Fn(&S) -> R,
) -> PinnedResults<S, R> {
    if let Some(last) = last.filter(|last| last.iter().map(|pinned| &pinned.setup).eq(setups)) {
        return Arc::clone(last);
    }
    let known = |setup: &S| last?.iter().find(|pinned| pinned.setup == *setup).map(|pinned| Arc::clone(&pinned.result));
    let pin =
        |setup: &S| Pinned { setup: setup.clone(), result: known(setup).unwrap_or_else(|| Arc::new(compute(setup))) };
    Arc::new(setups.iter().map(pin).collect())
}

/// A run that went to its end.
fn whole(run: Trajectory) -> Result<Trajectory, StudyError> {
    match run.halted_at_s {
        None => Ok(run),
        Some(time_s) => {
            Err(StudyError { field: "experiment.duration_s", fault: StudyErrorKind::TooMuchWork { time_s } })
        }
    }
}
