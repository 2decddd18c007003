//! The results of a model-free run and how they follow its document.

use std::ops::Deref;
use std::sync::Arc;

use leptos::prelude::*;

use super::moment::Shown;
use crate::controls::Document;
use crate::lab::{Lab, use_lab};
use crate::results::{Outcome, catch_up, shared};
use quadtank::study::model_free::{
    ModelFreeAnalysis, ModelFreeAnswer, ModelFreeSetup, analyse_model_free, run_model_free,
};
use quadtank_scenario::model_free::ModelFreeScenario;

/// What was found, for the views that show it. A handle: copying it copies nothing.
#[derive(Clone, Copy)]
pub struct Found {
    /// The setup that the results are of.
    pub setup: RwSignal<Arc<ModelFreeSetup>>,
    /// The run with its figures.
    pub answer: RwSignal<Outcome<ModelFreeAnswer>>,
    /// What theory says.
    pub analysis: RwSignal<Arc<ModelFreeAnalysis>>,
}

impl Found {
    fn of(setup: &ModelFreeSetup) -> Self {
        Self {
            answer: RwSignal::new(Arc::new(run_model_free(setup))),
            analysis: RwSignal::new(Arc::new(analyse_model_free(setup))),
            setup: RwSignal::new(Arc::new(setup.clone())),
        }
    }

    fn shared(self) -> Self {
        Self { setup: shared(self.setup), answer: shared(self.answer), analysis: shared(self.analysis) }
    }

    fn follow(self, other: Self) {
        catch_up(self.setup, other.setup);
        catch_up(self.answer, other.answer);
        catch_up(self.analysis, other.analysis);
    }

    /// What `read` makes of the run, if there is one.
    pub fn with_answer<T>(self, read: impl FnOnce(&ModelFreeAnswer) -> T) -> Option<T> {
        self.answer.with(|outcome| outcome.as_ref().as_ref().ok().map(read))
    }
}

/// The model-free bench. A handle of one pointer, as [`Lab`].
#[derive(Clone, Copy)]
pub struct Session(&'static State);

impl Deref for Session {
    type Target = State;

    fn deref(&self) -> &State {
        self.0
    }
}

/// The results of the document and what the bench shows of them.
pub struct State {
    /// What all benches share.
    pub lab: Lab,
    /// The results for the charts, new in every frame.
    pub charts: Found,
    /// The same for words, numbers and the drawing, once the charts are on the screen.
    pub words: Found,
    /// Where the cursor stands (s), inside the run.
    pub cursor: Signal<Option<f64>>,
}

impl Document for Session {
    type Setup = ModelFreeSetup;

    fn lab(self) -> Lab {
        self.lab
    }

    fn read<T>(self, read: impl FnOnce(&ModelFreeSetup) -> T) -> T {
        self.lab.model_free.with(|s| read(&s.model_free))
    }

    fn write(self, change: impl FnOnce(&mut ModelFreeSetup)) {
        self.edit(change);
    }
}

/// The session of this page.
pub fn use_session() -> Session {
    use_lab().kept(Session::start)
}

impl Session {
    /// The session of the document, computed at once.
    fn start(lab: Lab) -> Self {
        let charts = lab.model_free.with_untracked(|s| Found::of(&s.model_free));
        let words = charts.shared();
        let inside = |s: &ModelFreeScenario| s.cursor_s.filter(|time| *time <= s.model_free.experiment.duration_s);
        let cursor = Memo::new(move |_| lab.model_free.with(inside)).into();
        let session = Self(Box::leak(Box::new(State { lab, charts, words, cursor })));
        lab.follow(lab.model_free, move || session.compute(), move || words.follow(charts));
        session
    }

    /// Changes the run.
    pub fn edit(self, change: impl FnOnce(&mut ModelFreeSetup)) {
        self.lab.model_free.update(|s| change(&mut s.model_free));
    }

    /// Begins another run; the cursor goes to its end.
    pub fn load(self, setup: ModelFreeSetup) {
        self.lab.model_free.set(ModelFreeScenario::from(setup));
    }

    /// A number of the setup, for controls.
    pub fn part(self, read: fn(&ModelFreeSetup) -> f64) -> Signal<f64> {
        let scenario = self.lab.model_free;
        Memo::new(move |_| scenario.with(|s| read(&s.model_free))).into()
    }

    /// Something that is or is not so in the setup, as the page shows it.
    pub fn flag(self, read: fn(&ModelFreeSetup) -> bool) -> Signal<bool> {
        Signal::derive(move || self.words.setup.with(|setup| read(setup)))
    }

    /// The moment at the cursor, or at the end where there is none.
    pub fn shown(self) -> Option<Shown> {
        let cursor = self.cursor.get();
        let setup = self.words.setup.get();
        self.words.with_answer(|answer| Shown::of(&setup, answer, cursor)).flatten()
    }

    /// Puts the cursor somewhere, or away.
    pub fn set_cursor(self, time: Option<f64>) {
        self.lab.model_free.update(|s| s.cursor_s = time);
    }

    /// Computes what changed; what it returns hands that to the panels.
    fn compute(self) -> Option<Box<dyn FnOnce()>> {
        let after = self.lab.model_free.try_with_untracked(|s| s.model_free.clone())?;
        let before = self.charts.setup.get_untracked();
        let found = (*before != after).then(|| (run_model_free(&after), analyse_model_free(&after)));
        Some(Box::new(move || {
            if let Some((answer, analysis)) = found {
                self.charts.setup.set(Arc::new(after));
                self.charts.analysis.set(Arc::new(analysis));
                self.charts.answer.set(Arc::new(answer));
            }
        }))
    }
}
