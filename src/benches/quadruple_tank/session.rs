//! The home bench: its document, its results as signals, and the unit of its levels.

use std::sync::Arc;

use leptos::prelude::*;
use quadtank::literature::DisplayUnit;
use quadtank::study::quadruple_tank::{Analysis, QuadrupleTankStudy, Results, Run, Setup};
use quadtank::study::{PinnedResults, StudyError};
use quadtank_scenario::Scenario;

use super::flags::{locks, panels};
use crate::lab::Lab;
use crate::session::{self, Bench, Lock, Outcome, Panel, part_of};
use crate::texts::tr;

/// The home bench: from two valves to the step response.
pub struct QuadrupleTank;

/// The session of the home bench.
pub type Session = session::Session<QuadrupleTank>;

/// The results, for the views that show them.
#[derive(Clone, Copy)]
pub struct Found {
    /// The setup that the results are of. Views read this one, so that they change when results come, not before.
    pub setup: Memo<Arc<Setup>>,
    /// What theory says.
    pub analysis: Memo<Outcome<Analysis, StudyError>>,
    /// What happens.
    pub run: Memo<Outcome<Run, StudyError>>,
    /// The pinned runs, in the order of the document.
    pub pinned: Memo<PinnedResults<Setup, Result<Run, StudyError>>>,
}

impl Found {
    /// What `read` makes of the analysis, if there is one.
    pub fn with_analysis<T>(self, read: impl FnOnce(&Analysis) -> T) -> Option<T> {
        self.analysis.with(|outcome| outcome.as_ref().as_ref().ok().map(read))
    }
}

/// What follows from the document alone.
#[derive(Clone, Copy)]
pub struct Own {
    /// The unit in which levels are shown.
    pub unit: Memo<DisplayUnit>,
}

impl Bench for QuadrupleTank {
    const ID: &'static str = "quadruple-tank";
    const CLASS: &'static str = "bench";
    const PANELS: &'static [Panel] = panels::ALL;
    const LOCKS: &'static [Lock] = locks::ALL;
    type Document = Scenario;
    type Study = QuadrupleTankStudy;
    type Found = Found;
    type Own = Own;

    fn found(results: RwSignal<Results>) -> Found {
        Found {
            setup: part_of(results, |results| &results.setup),
            analysis: part_of(results, |results| &results.analysis),
            run: part_of(results, |results| &results.run),
            pinned: part_of(results, |results| &results.pinned),
        }
    }

    fn own(document: RwSignal<Scenario>) -> Own {
        Own { unit: Memo::new(move |_| document.with(|document| document.setup.plant.display_unit())) }
    }

    fn title(lab: Lab) -> String {
        tr!(lab, app.quadruple_tank)
    }

    fn cards(session: Session) -> AnyView {
        super::cards(session).into_any()
    }
}

/// The session of this page.
pub fn use_session() -> Session {
    session::use_session()
}
