//! What was computed, for the views that show it.

use std::sync::Arc;

use leptos::prelude::*;

use quadtank::study::StudyError;
use quadtank::study::quadruple_tank::{Analysis, Run, Setup};
use quadtank_scenario::Scenario;

/// A result that a panel may show, or why there is none.
pub type Outcome<T> = Arc<Computed<T>>;
/// The same, not shared.
pub type Computed<T> = Result<T, StudyError>;

/// Takes over what is newer in `newest`. Views of `told` that nothing new is shown to are left alone.
pub fn catch_up<T: Send + Sync + 'static>(told: RwSignal<Arc<T>>, newest: RwSignal<Arc<T>>) {
    let newest = newest.get_untracked();
    if !told.with_untracked(|old| Arc::ptr_eq(old, &newest)) {
        told.set(newest);
    }
}

/// A signal of its own that holds the same result.
pub fn shared<T: Send + Sync + 'static>(result: RwSignal<Arc<T>>) -> RwSignal<Arc<T>> {
    RwSignal::new(result.get_untracked())
}

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
            analysis: RwSignal::new(Arc::new(quadtank::study::quadruple_tank::analyse(&scenario.setup))),
            run: RwSignal::new(Arc::new(quadtank::study::quadruple_tank::run(&scenario.setup))),
            pinned: RwSignal::new(run_all(&scenario.pinned)),
        }
    }

    /// Signals of their own that hold the same results.
    pub(super) fn shared(self) -> Self {
        Self {
            setup: shared(self.setup),
            analysis: shared(self.analysis),
            run: shared(self.run),
            pinned: shared(self.pinned),
        }
    }

    /// Takes over what is newer in `other`.
    pub(super) fn follow(self, other: Self) {
        catch_up(self.setup, other.setup);
        catch_up(self.analysis, other.analysis);
        catch_up(self.run, other.run);
        catch_up(self.pinned, other.pinned);
    }

    /// What `read` makes of the analysis, if there is one.
    pub fn with_analysis<T>(self, read: impl FnOnce(&Analysis) -> T) -> Option<T> {
        self.analysis.with(|outcome| outcome.as_ref().as_ref().ok().map(read))
    }
}

/// Runs every setup.
pub(super) fn run_all(setups: &[Setup]) -> Arc<Vec<Outcome<Run>>> {
    Arc::new(setups.iter().map(|s| Arc::new(quadtank::study::quadruple_tank::run(s))).collect())
}
