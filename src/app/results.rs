//! What was computed, for the views that show it.

use std::sync::Arc;

use leptos::prelude::*;

use crate::scenario::{self, Analysis, Run, Scenario, ScenarioError, Setup};

/// A result that a panel may show, or why there is none.
pub type Outcome<T> = Arc<Result<T, ScenarioError>>;

/// The results that a kind of view shows. A handle: copying it copies nothing.
#[derive(Clone, Copy)]
pub struct Results {
    /// The setup that the results are of. Views read this one, so that they change when results come, not before.
    pub setup: RwSignal<Arc<Setup>>,
    /// What theory says.
    pub analysis: RwSignal<Outcome<Analysis>>,
    /// What happens.
    pub run: RwSignal<Outcome<Run>>,
    /// The pinned runs, in the order of the scenario.
    pub pinned: RwSignal<Arc<Vec<Outcome<Run>>>>,
}

impl Results {
    /// All of a document, computed.
    pub(super) fn of(scenario: &Scenario) -> Self {
        Self {
            setup: RwSignal::new(Arc::new(scenario.setup.clone())),
            analysis: RwSignal::new(Arc::new(scenario::analyse(&scenario.setup))),
            run: RwSignal::new(Arc::new(scenario::run(&scenario.setup))),
            pinned: RwSignal::new(run_all(&scenario.pinned)),
        }
    }

    /// Signals of their own that hold the same results.
    pub(super) fn shared(self) -> Self {
        Self {
            setup: RwSignal::new(self.setup.get_untracked()),
            analysis: RwSignal::new(self.analysis.get_untracked()),
            run: RwSignal::new(self.run.get_untracked()),
            pinned: RwSignal::new(self.pinned.get_untracked()),
        }
    }

    /// Takes over what is newer in `other`.
    pub(super) fn follow(self, other: Self) {
        share(self.setup, other.setup);
        share(self.analysis, other.analysis);
        share(self.run, other.run);
        share(self.pinned, other.pinned);
    }

    /// What `read` makes of the analysis, if there is one.
    pub fn with_analysis<T>(self, read: impl FnOnce(&Analysis) -> T) -> Option<T> {
        self.analysis.with(|outcome| outcome.as_ref().as_ref().ok().map(read))
    }
}

/// Takes over a result if it is another one.
pub(super) fn share<T: Send + Sync + 'static>(to: RwSignal<Arc<T>>, from: RwSignal<Arc<T>>) {
    let newest = from.get_untracked();
    if !to.with_untracked(|old| Arc::ptr_eq(old, &newest)) {
        to.set(newest);
    }
}

/// Runs every setup.
pub(super) fn run_all(setups: &[Setup]) -> Arc<Vec<Outcome<Run>>> {
    Arc::new(setups.iter().map(|s| Arc::new(scenario::run(s))).collect())
}
