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
    /// The case that was chosen.
    chosen: RwSignal<ChosenCase>,
    /// The published case that is shown.
    pub case: Memo<Option<PublishedCase>>,
    /// How far the steps are open.
    pub guide: Guide,
}

impl Own {
    /// Shows no case for the session as it is.
    pub fn hide_case(self, document: RwSignal<TuningScenario>) {
        self.chosen.set(ChosenCase { case: None, setup: document.with_untracked(|s| s.tuning.clone()) });
    }
}

/// A choice among the cases, or of none, and the session that it was made for.
#[derive(Clone, Debug)]
struct ChosenCase {
    case: Option<PublishedCase>,
    setup: TuningSetup,
}

impl ChosenCase {
    /// The case to show beside a session, which undo, a link or a file may have put in the place of the one that the choice was made
    /// for: the case that the session is, else the chosen one as long as the plant is its own.
    fn shown(&self, setup: &TuningSetup) -> Option<PublishedCase> {
        if self.setup == *setup {
            return self.case;
        }
        case_of(setup).or(self.case.filter(|&case| TuningSetup::published(case).plant == setup.plant))
    }
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
        let begun = document.with_untracked(|document| document.tuning.clone());
        let chosen = RwSignal::new(ChosenCase { case: case_of(&begun), setup: begun });
        let case = Memo::new(move |_| chosen.with(|chosen| document.with(|document| chosen.shown(&document.tuning))));
        Own { chosen, case, guide: Guide::new() }
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
    session.own.chosen.set(ChosenCase { case, setup: setup.clone() });
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_case_that_is_shown_is_that_of_the_session() {
        let [a, b] = [PublishedCase { table: 12, row: 2 }, PublishedCase { table: 12, row: 1 }];
        let chosen =
            |case: Option<PublishedCase>| ChosenCase { case, setup: TuningSetup::published(case.unwrap_or(a)) };
        assert_eq!(chosen(Some(a)).shown(&TuningSetup::published(a)), Some(a));
        // Undo brings another case back.
        assert_eq!(chosen(Some(a)).shown(&TuningSetup::published(b)), Some(b));
        // A change of the controllers stays with the case, another plant does not.
        let mut changed = TuningSetup::published(a);
        changed.design.target = [-0.3, 0.0];
        assert_eq!(chosen(Some(a)).shown(&changed), Some(a));
        changed.plant = TuningPlant::Published(PublishedPlant::ProcessTwo);
        assert_eq!(chosen(Some(a)).shown(&changed), None);
        // None is a choice too.
        assert_eq!(chosen(None).shown(&TuningSetup::published(a)), None);
        assert_eq!(chosen(None).shown(&TuningSetup::published(b)), Some(b));
    }
}
