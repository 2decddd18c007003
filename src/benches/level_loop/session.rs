//! The level-loop bench: its document, its results as signals, its cursor, and what is computed in slices.

use std::sync::Arc;

use leptos::prelude::*;
use quadtank::plant::level::{LevelError, LevelPlant, LevelSignals};
use quadtank::study::PinnedResults;
use quadtank::study::level_loop::{
    Element, LevelLoopAnswer, LevelLoopError, LevelLoopSetup, LevelLoopStudy, PlantAnswer, Results, StepTestAnswer,
    StepTestError, Suggestion,
};
use quadtank_scenario::level_loop::LevelLoopScenario;

use super::exploration::Exploration;
use super::flags::{self, locks, panels};
use crate::depth::Depth;
use crate::lab::Lab;
use crate::session::{self, Bench, Lock, Outcome, Panel, part_of};
use crate::texts::tr;

/// The level-loop bench: one tank with all its instruments.
pub struct LevelLoop;

/// The session of the level-loop bench.
pub type Session = session::Session<LevelLoop>;

/// The results, for the views that show them.
#[derive(Clone, Copy)]
pub struct Found {
    /// The setup that the results are of.
    pub setup: Memo<Arc<LevelLoopSetup>>,
    /// The plant at rest.
    pub plant: Memo<Outcome<PlantAnswer, LevelError>>,
    /// The step test.
    pub test: Memo<Outcome<StepTestAnswer, StepTestError>>,
    /// What the rules suggest.
    pub suggestions: Memo<Arc<Vec<Suggestion>>>,
    /// The run with its figures.
    pub answer: Memo<Outcome<LevelLoopAnswer, LevelLoopError>>,
    /// Pinned tunings in the present experiment.
    pub pinned: Memo<PinnedResults<LevelLoopSetup, Result<LevelLoopAnswer, LevelLoopError>>>,
}

impl Found {
    /// What `read` makes of the run, if there is one.
    pub fn with_answer<T>(self, read: impl FnOnce(&LevelLoopAnswer) -> T) -> Option<T> {
        self.answer.with(|outcome| outcome.as_ref().as_ref().ok().map(read))
    }
}

/// What the bench remembers besides its document.
#[derive(Clone, Copy)]
pub struct Own {
    /// Where the cursor stands (s), inside the run.
    pub cursor: Memo<Option<f64>>,
    /// The element whose curve is shown, if one is.
    pub element: RwSignal<Option<Element>>,
    /// The map of the cost and the last search in it.
    pub exploration: Exploration,
}

impl Bench for LevelLoop {
    const ID: &'static str = "level-loop";
    const PICTURE: &'static str = "M8 4V26H30V4M8 12H30M30 22H44M34 18L40 26M40 18L34 26M19 12V8H40V14";
    const CLASS: &'static str = "bench level";
    const DEPTHS: &'static [Depth] = &[Depth::Explore, Depth::Full];
    const PANELS: &'static [Panel] = panels::ALL;
    const LOCKS: &'static [Lock] = locks::ALL;
    type Document = LevelLoopScenario;
    type Study = LevelLoopStudy;
    type Found = Found;
    type Own = Own;

    fn found(results: RwSignal<Results>) -> Found {
        Found {
            setup: part_of(results, |results| &results.setup),
            plant: part_of(results, |results| &results.plant),
            test: part_of(results, |results| &results.test),
            suggestions: part_of(results, |results| &results.suggestions),
            answer: part_of(results, |results| &results.answer),
            pinned: part_of(results, |results| &results.pinned),
        }
    }

    fn panel_title(lab: Lab, panel: Panel) -> String {
        flags::panel_title(lab, panel)
    }

    fn own(document: RwSignal<LevelLoopScenario>) -> Own {
        let inside = |s: &LevelLoopScenario| s.cursor_s.filter(|time| *time <= s.level_loop.experiment.duration_s);
        Own {
            cursor: Memo::new(move |_| document.with(inside)),
            element: RwSignal::new(None),
            exploration: Exploration::new(),
        }
    }

    fn title(lab: Lab) -> String {
        tr!(lab, app.level_loop)
    }

    fn about(lab: Lab) -> String {
        tr!(lab, app.level_loop_about)
    }

    fn cards(session: Session) -> AnyView {
        super::cards(session).into_any()
    }
}

/// The session of this page.
pub fn use_session() -> Session {
    session::use_session()
}

/// Begins with another loop; what is pinned goes.
pub fn load(session: Session, setup: LevelLoopSetup) {
    session.document.set(LevelLoopScenario::from(setup));
}

/// Puts the cursor somewhere, or away.
pub fn set_cursor(session: Session, time: Option<f64>) {
    session.document.update(|document| document.cursor_s = time);
}

/// The moment at the cursor, or at the end of the run: its time (s), the plant and all signals.
pub fn shown(session: Session) -> Option<(f64, LevelPlant, LevelSignals)> {
    let cursor = session.own.cursor.get();
    let plant = session.throttled.setup.with(|setup| setup.plant());
    session.throttled.with_answer(|answer| {
        let log = &answer.log;
        let until = log.time_s.partition_point(|&time| time <= cursor.unwrap_or(f64::INFINITY));
        let row = until.saturating_sub(1);
        let signals = log.signals(&plant, row)?;
        Some((log.time_s[row], plant, signals))
    })?
}
