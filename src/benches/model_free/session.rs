//! The model-free bench: its document, its results as signals, and its cursor.

use std::sync::Arc;

use leptos::prelude::*;
use quadtank::study::StudyError;
use quadtank::study::model_free::{ModelFreeAnalysis, ModelFreeAnswer, ModelFreeSetup, ModelFreeStudy, Results};
use quadtank_scenario::model_free::ModelFreeScenario;

use super::flags::{self, locks, panels};
use super::moment::Shown;
use crate::depth::Depth;
use crate::lab::Lab;
use crate::session::{self, Bench, Lock, Outcome, Panel, part_of};
use crate::texts::tr;

/// The model-free bench: ultra-local model, estimator, still and moving valves.
pub struct ModelFree;

/// The session of the model-free bench.
pub type Session = session::Session<ModelFree>;

/// The results, for the views that show them.
#[derive(Clone, Copy)]
pub struct Found {
    /// The setup that the results are of.
    pub setup: Memo<Arc<ModelFreeSetup>>,
    /// The run with its figures.
    pub answer: Memo<Outcome<ModelFreeAnswer, StudyError>>,
    /// What theory says.
    pub analysis: Memo<Arc<ModelFreeAnalysis>>,
}

impl Found {
    /// What `read` makes of the run, if there is one.
    pub fn with_answer<T>(self, read: impl FnOnce(&ModelFreeAnswer) -> T) -> Option<T> {
        self.answer.with(|outcome| outcome.as_ref().as_ref().ok().map(read))
    }
}

/// What follows from the document alone.
#[derive(Clone, Copy)]
pub struct Own {
    /// Where the cursor stands (s), inside the run.
    pub cursor: Memo<Option<f64>>,
}

impl Bench for ModelFree {
    const ID: &'static str = "model-free";
    const PICTURE: &'static str = "M4 26C12 26 10 8 20 8S30 8 44 8M4 8H44M6 28H44";
    const CLASS: &'static str = "bench free";
    const DEPTHS: &'static [Depth] = &[Depth::Explore, Depth::Full];
    const PANELS: &'static [Panel] = panels::ALL;
    const LOCKS: &'static [Lock] = locks::ALL;
    type Document = ModelFreeScenario;
    type Study = ModelFreeStudy;
    type Found = Found;
    type Own = Own;

    fn found(results: RwSignal<Results>) -> Found {
        Found {
            setup: part_of(results, |results| &results.setup),
            answer: part_of(results, |results| &results.answer),
            analysis: part_of(results, |results| &results.analysis),
        }
    }

    fn panel_title(lab: Lab, panel: Panel) -> String {
        flags::panel_title(lab, panel)
    }

    fn own(document: RwSignal<ModelFreeScenario>) -> Own {
        let inside = |s: &ModelFreeScenario| s.cursor_s.filter(|time| *time <= s.model_free.experiment.duration_s);
        Own { cursor: Memo::new(move |_| document.with(inside)) }
    }

    fn title(lab: Lab) -> String {
        tr!(lab, app.model_free)
    }

    fn about(lab: Lab) -> String {
        tr!(lab, app.model_free_about)
    }

    fn cards(session: Session) -> AnyView {
        super::cards(session).into_any()
    }
}

/// The session of this page.
pub fn use_session() -> Session {
    session::use_session()
}

/// Begins another run; the cursor goes to its end.
pub fn load(session: Session, setup: ModelFreeSetup) {
    session.document.set(ModelFreeScenario::from(setup));
}

/// The moment at the cursor, or at the end where there is none.
pub fn shown(session: Session) -> Option<Shown> {
    let cursor = session.own.cursor.get();
    let setup = session.throttled.setup.get();
    session.throttled.with_answer(|answer| Shown::of(&setup, answer, cursor)).flatten()
}

/// Puts the cursor somewhere, or away.
pub fn set_cursor(session: Session, time: Option<f64>) {
    session.document.update(|document| document.cursor_s = time);
}
