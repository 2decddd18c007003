//! What was computed, for the views that show it.

use std::any::Any;
use std::marker::PhantomData;
use std::sync::Arc;

use leptos::prelude::*;

use quadtank_scenario::{Analysis, Run, Scenario, ScenarioError, Setup};

/// A result that a panel may show, or why there is none.
pub type Outcome<T> = Arc<Computed<T>>;
/// The same, not shared.
pub type Computed<T> = Result<T, ScenarioError>;

/// A shared result that views follow. A handle: copying it copies nothing. What it holds has no type for the signal below it,
/// so that Leptos compiles its machinery once, not once for each kind of result.
pub struct Held<T> {
    signal: RwSignal<Arc<dyn Any + Send + Sync>>,
    kind: PhantomData<fn() -> T>,
}

impl<T> Clone for Held<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Held<T> {}

impl<T: Send + Sync + 'static> Held<T> {
    /// Holds a result.
    pub fn new(value: Arc<T>) -> Self {
        Self { signal: RwSignal::new(value), kind: PhantomData }
    }

    /// The result, which the caller follows from now on.
    pub fn get(self) -> Arc<T> {
        Self::typed(self.signal.get())
    }

    /// The result, once.
    pub fn get_untracked(self) -> Arc<T> {
        Self::typed(self.signal.get_untracked())
    }

    /// What `read` makes of the result, which the caller follows from now on.
    pub fn with<R>(self, read: impl FnOnce(&Arc<T>) -> R) -> R {
        read(&self.get())
    }

    /// What `read` makes of the result, once.
    pub fn with_untracked<R>(self, read: impl FnOnce(&Arc<T>) -> R) -> R {
        read(&self.get_untracked())
    }

    /// Holds another result from now on.
    pub fn set(self, value: Arc<T>) {
        self.signal.set(value);
    }

    /// The same without telling anybody.
    pub fn set_untracked(self, value: Arc<T>) {
        self.signal.update_untracked(|held| *held = value);
    }

    /// Takes over what is newer in `other`.
    pub fn follow(self, other: Self) {
        let newest = other.signal.get_untracked();
        if !self.signal.with_untracked(|old| Arc::ptr_eq(old, &newest)) {
            self.signal.set(newest);
        }
    }

    fn typed(value: Arc<dyn Any + Send + Sync>) -> Arc<T> {
        // Nothing else can be put in.
        value.downcast().unwrap_or_else(|_| unreachable!())
    }
}

/// The results that a kind of view shows. A handle: copying it copies nothing.
#[derive(Clone, Copy)]
pub struct Results {
    /// The setup that the results are of. Views read this one, so that they change when results come, not before.
    pub setup: Held<Setup>,
    /// What theory says.
    pub analysis: Held<Computed<Analysis>>,
    /// What happens.
    pub run: Held<Computed<Run>>,
    /// The pinned runs, in the order of the scenario.
    pub pinned: Held<Vec<Outcome<Run>>>,
}

impl Results {
    /// All of a document, computed.
    pub(super) fn of(scenario: &Scenario) -> Self {
        Self {
            setup: Held::new(Arc::new(scenario.setup.clone())),
            analysis: Held::new(Arc::new(quadtank_scenario::analyse(&scenario.setup))),
            run: Held::new(Arc::new(quadtank_scenario::run(&scenario.setup))),
            pinned: Held::new(run_all(&scenario.pinned)),
        }
    }

    /// Signals of their own that hold the same results.
    pub(super) fn shared(self) -> Self {
        Self {
            setup: Held::new(self.setup.get_untracked()),
            analysis: Held::new(self.analysis.get_untracked()),
            run: Held::new(self.run.get_untracked()),
            pinned: Held::new(self.pinned.get_untracked()),
        }
    }

    /// Takes over what is newer in `other`.
    pub(super) fn follow(self, other: Self) {
        self.setup.follow(other.setup);
        self.analysis.follow(other.analysis);
        self.run.follow(other.run);
        self.pinned.follow(other.pinned);
    }

    /// What `read` makes of the analysis, if there is one.
    pub fn with_analysis<T>(self, read: impl FnOnce(&Analysis) -> T) -> Option<T> {
        self.analysis.with(|outcome| outcome.as_ref().as_ref().ok().map(read))
    }
}

/// Runs every setup.
pub(super) fn run_all(setups: &[Setup]) -> Arc<Vec<Outcome<Run>>> {
    Arc::new(setups.iter().map(|s| Arc::new(quadtank_scenario::run(s))).collect())
}
