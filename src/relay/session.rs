//! The results of a tuning session and how they follow its document.

use std::ops::Deref;
use std::sync::Arc;

use leptos::prelude::*;

use crate::lab::{Lab, use_lab};
use crate::results::{catch_up, shared};
use crate::start::Control;
use quadtank::literature::campestrini::PublishedCase;
use quadtank::literature::campestrini::PublishedPlant;
use quadtank::study::relay_tuning::{Designed, PlantStudy, Tested, TuningPlant, TuningSetup};
use quadtank::tuning::TuningError;
use quadtank_scenario::tuning::TuningScenario;

/// A result that a panel may show, or why there is none.
pub type Outcome<T> = Arc<Computed<T>>;
/// The same, not shared.
type Computed<T> = Result<T, TuningError>;

/// What was found, for the views that show it. A handle: copying it copies nothing.
#[derive(Clone, Copy)]
pub struct Found {
    /// The setup that the results are of.
    pub setup: RwSignal<Arc<TuningSetup>>,
    /// What follows from the plant.
    pub study: RwSignal<Outcome<PlantStudy>>,
    /// The relay test.
    pub test: RwSignal<Outcome<Tested>>,
    /// The placement with its response.
    pub design: RwSignal<Outcome<Option<Designed>>>,
    /// The pinned sessions, in the order of the document.
    pub pinned: RwSignal<Arc<Vec<Outcome<Option<Designed>>>>>,
}

impl Found {
    /// All of a session, computed.
    fn of(scenario: &TuningScenario) -> Self {
        let setup = &scenario.tuning;
        let study = Arc::new(PlantStudy::of(&setup.plant));
        Self {
            test: RwSignal::new(tested(&study, setup)),
            design: RwSignal::new(designed(&study, setup)),
            study: RwSignal::new(study),
            setup: RwSignal::new(Arc::new(setup.clone())),
            pinned: RwSignal::new(design_all(&scenario.pinned)),
        }
    }

    /// Signals of their own that hold the same results.
    fn shared(self) -> Self {
        Self {
            setup: shared(self.setup),
            study: shared(self.study),
            test: shared(self.test),
            design: shared(self.design),
            pinned: shared(self.pinned),
        }
    }

    /// Takes over what is newer in `other`.
    fn follow(self, other: Self) {
        catch_up(self.setup, other.setup);
        catch_up(self.study, other.study);
        catch_up(self.test, other.test);
        catch_up(self.design, other.design);
        catch_up(self.pinned, other.pinned);
    }

    /// What `read` makes of the design, if there is one.
    pub fn with_design<T>(self, read: impl FnOnce(&Designed) -> T) -> Option<T> {
        self.design.with(|outcome| outcome.as_ref().as_ref().ok()?.as_ref().map(read))
    }
}

fn tested(study: &Outcome<PlantStudy>, setup: &TuningSetup) -> Outcome<Tested> {
    Arc::new(study.as_ref().as_ref().map_err(|&error| error).and_then(|study| study.test(setup)))
}

fn designed(study: &Outcome<PlantStudy>, setup: &TuningSetup) -> Outcome<Option<Designed>> {
    Arc::new(study.as_ref().as_ref().map_err(|&error| error).and_then(|study| study.design(setup)))
}

fn design_all(setups: &[TuningSetup]) -> Arc<Vec<Outcome<Option<Designed>>>> {
    Arc::new(setups.iter().map(|setup| designed(&Arc::new(PlantStudy::of(&setup.plant)), setup)).collect())
}

/// The relay-tuning bench. A handle of one pointer, as [`Lab`].
#[derive(Clone, Copy)]
pub struct Session(&'static State);

impl Deref for Session {
    type Target = State;

    fn deref(&self) -> &State {
        self.0
    }
}

/// The results of the document and what the bench remembers besides.
pub struct State {
    /// What all benches share.
    pub lab: Lab,
    /// The results for the charts, new in every frame.
    pub charts: Found,
    /// The same for words and numbers, once the charts are on the screen.
    pub words: Found,
    /// The published case that is shown.
    pub case: RwSignal<Option<PublishedCase>>,
    /// The pinned sessions that are computed.
    pinned: StoredValue<Vec<TuningSetup>>,
}

/// The session of this page.
pub fn use_session() -> Session {
    use_lab().kept(Session::start)
}

impl Session {
    /// The session of the document, computed at once.
    fn start(lab: Lab) -> Self {
        let (charts, pinned) = lab.tuning.with_untracked(|s| (Found::of(s), s.pinned.clone()));
        let case = RwSignal::new(lab.tuning.with_untracked(|s| case_of(&s.tuning)));
        let state = State { lab, charts, words: charts.shared(), case, pinned: StoredValue::new(pinned) };
        let session = Self(Box::leak(Box::new(state)));
        lab.follow(lab.tuning, move || session.compute(), move || session.words.follow(charts));
        session
    }

    /// Changes the session.
    pub fn edit(self, change: impl FnOnce(&mut TuningSetup)) {
        self.lab.tuning.update(|s| change(&mut s.tuning));
    }

    /// Begins another session.
    pub fn load(self, setup: TuningSetup, case: Option<PublishedCase>) {
        self.case.set(case);
        self.edit(|s| *s = setup);
    }

    /// A number of the setup, for controls.
    pub fn part(self, read: fn(&TuningSetup) -> f64) -> Signal<f64> {
        let scenario = self.lab.tuning;
        Memo::new(move |_| scenario.with(|s| read(&s.tuning))).into()
    }

    /// Something that is or is not so in the setup, as the page shows it.
    pub fn flag(self, read: fn(&TuningSetup) -> bool) -> Signal<bool> {
        Signal::derive(move || self.words.setup.with(|setup| read(setup)))
    }

    /// Whether a group of controls is disabled.
    pub fn locks(self, control: Control) -> bool {
        self.lab.locks(control)
    }

    /// Computes what changed; what it returns hands that to the panels.
    fn compute(self) -> Option<Box<dyn FnOnce()>> {
        let after = self.lab.tuning.try_get_untracked()?;
        let before = self.charts.setup.get_untracked();
        let setup = &after.tuning;
        let study = (before.plant != setup.plant).then(|| Arc::new(PlantStudy::of(&setup.plant)));
        let known = study.clone().unwrap_or_else(|| self.charts.study.get_untracked());
        let test = (study.is_some() || before.test != setup.test).then(|| tested(&known, setup));
        let same_design = before.design == setup.design && before.response == setup.response;
        let design = (study.is_some() || !same_design).then(|| designed(&known, setup));
        let pinned = self.pinned.with_value(|pinned| *pinned != after.pinned).then(|| design_all(&after.pinned));
        Some(Box::new(move || {
            self.charts.setup.set(Arc::new(after.tuning));
            set_if_some(self.charts.study, study);
            set_if_some(self.charts.test, test);
            set_if_some(self.charts.design, design);
            if pinned.is_some() {
                self.pinned.set_value(after.pinned);
            }
            set_if_some(self.charts.pinned, pinned);
        }))
    }
}

fn set_if_some<T: Send + Sync + 'static>(signal: RwSignal<Arc<T>>, value: Option<Arc<T>>) {
    if let Some(value) = value {
        signal.set(value);
    }
}

/// The case whose session this is; of several that begin alike, the one with controllers.
fn case_of(setup: &TuningSetup) -> Option<PublishedCase> {
    PublishedCase::all().filter(|case| case.is_placement()).find(|&case| TuningSetup::published(case) == *setup)
}

/// The unit of time of a plant; nothing where the document does not say.
pub fn time_unit(plant: &TuningPlant) -> &'static str {
    match plant {
        TuningPlant::Published(PublishedPlant::WoodBerry) => "min",
        TuningPlant::Published(PublishedPlant::ProcessTwo) | TuningPlant::QuadrupleTank { .. } => "s",
        TuningPlant::Elements(_) => "",
    }
}
