//! The relay-tuning bench: its document, its results as signals, and the published case that is shown.

use std::sync::Arc;

use leptos::prelude::*;
use quadtank::literature::campestrini::{PublishedCase, PublishedPlant};
use quadtank::study::PinnedResults;
use quadtank::study::relay_tuning::{
    CriticalReading, DesignOutcome, Designed, PlantStudy, RelayTuningStudy, Results, Tested, TuningPlant, TuningSetup,
};
use quadtank::tuning::TuningError;
use quadtank_scenario::tuning::TuningScenario;

use super::flags::{self, locks, panels};
use super::guide::Guide;
use crate::depth::Depth;
use crate::lab::Lab;
use crate::session::{self, Bench, Lock, Outcome, Panel, part_of};
use crate::texts::tr;

/// The relay-tuning bench: relay tests and ultimate-point placement.
pub struct RelayTuning;

/// The session of the relay-tuning bench.
pub type Session = session::Session<RelayTuning>;

/// The results, for the views that show them.
#[derive(Clone, Copy)]
pub struct Found {
    /// The setup that the results are of.
    pub setup: Memo<Arc<TuningSetup>>,
    /// What follows from the plant.
    pub study: Memo<Outcome<PlantStudy, TuningError>>,
    /// The relay test.
    pub test: Memo<Outcome<Tested, TuningError>>,
    /// The placement with its response.
    pub design: Memo<Arc<DesignOutcome>>,
    /// The pinned sessions, in the order of the document.
    pub pinned: Memo<PinnedResults<TuningSetup, DesignOutcome>>,
    /// What is sought for texts: computed only where it is read.
    pub critical: Memo<Result<CriticalReading, TuningError>>,
}

impl Found {
    /// What `read` makes of the design, if there is one.
    pub fn with_design<T>(self, read: impl FnOnce(&Designed) -> T) -> Option<T> {
        self.design.with(|outcome| outcome.as_ref().as_ref().ok()?.as_ref().map(read))
    }
}

/// What the bench remembers besides its document.
#[derive(Clone, Copy)]
pub struct Own {
    /// The published case that is shown.
    pub case: RwSignal<Option<PublishedCase>>,
    /// How far the steps are open.
    pub guide: Guide,
}

impl Bench for RelayTuning {
    const ID: &'static str = "relay-tuning";
    const PICTURE: &'static str = "M4 20V10H12V24H20V10H28V24H36V10H44M4 17q4-9 8 0t8 0 8 0 8 0 8 0";
    const CLASS: &'static str = "bench relay";
    const DEPTHS: &'static [Depth] = &[Depth::Explore, Depth::Full];
    const PANELS: &'static [Panel] = panels::ALL;
    const LOCKS: &'static [Lock] = locks::ALL;
    type Document = TuningScenario;
    type Study = RelayTuningStudy;
    type Found = Found;
    type Own = Own;

    fn found(results: RwSignal<Results>) -> Found {
        Found {
            setup: part_of(results, |results| &results.setup),
            study: part_of(results, |results| &results.study),
            test: part_of(results, |results| &results.test),
            design: part_of(results, |results| &results.design),
            pinned: part_of(results, |results| &results.pinned),
            critical: Memo::new(move |_| results.with(CriticalReading::of)),
        }
    }

    fn panel_title(lab: Lab, panel: Panel) -> String {
        flags::panel_title(lab, panel)
    }

    fn own(document: RwSignal<TuningScenario>) -> Own {
        let case = RwSignal::new(document.with_untracked(|document| case_of(&document.tuning)));
        Own { case, guide: Guide::new() }
    }

    /// Units of time are those of the plant; those of input and output are the plant's own and have no name.
    fn unit_name(session: Session, unit: &str) -> String {
        let time = session.throttled.setup.with(|setup| time_unit(&setup.plant));
        match unit {
            "time" | "output time" => time.to_owned(),
            "rad/time" => format!("rad/{time}"),
            "input" | "output" | "input/output" | "output/input" => String::new(),
            other => other.to_owned(),
        }
    }

    fn title(lab: Lab) -> String {
        tr!(lab, app.relay_tuning)
    }

    fn about(lab: Lab) -> String {
        tr!(lab, app.relay_tuning_about)
    }

    fn cards(session: Session) -> AnyView {
        super::cards(session).into_any()
    }
}

/// The session of this page.
pub fn use_session() -> Session {
    session::use_session()
}

/// Begins another session.
pub fn load(session: Session, setup: TuningSetup, case: Option<PublishedCase>) {
    session.own.case.set(case);
    session.edit(|s| *s = setup);
}

/// The case whose session this is; of several that begin alike, the one with controllers.
fn case_of(setup: &TuningSetup) -> Option<PublishedCase> {
    PublishedCase::all().filter(|case| case.is_placement()).find(|&case| TuningSetup::published(case) == *setup)
}

/// The unit of time of a plant; nothing where the document does not say.
pub fn time_unit(plant: &TuningPlant) -> &'static str {
    match plant {
        TuningPlant::Published(PublishedPlant::WoodBerry) => "min",
        TuningPlant::Elements(_) => "",
        _ => "s",
    }
}
